// How a plan is uploaded and drawn, and how its bias becomes the rasterizer's.
#include "shadows.hpp"

#include <cstring>
#include <vector>

#include "gnomon/study/engine_bias.hpp"
#include "shaders.hpp"

namespace sample {
namespace {

// The comparing sampler reads the four texels round a point: half a texel beyond the point's own.
constexpr double kKernelRadius = 0.5;

ShadowData data_of(const gnomon::ShadowPlan& plan, const gnomon::BiasOptions& bias) {
  ShadowData data{};
  data.block = gnomon::shader_block(plan);
  // Layers without a map, in a pass over all layers: every vertex is behind the far plane.
  glm::mat4 nowhere(0.0f);
  nowhere[3] = {0.0f, 0.0f, -1.0f, 1.0f};
  data.clip_from_point.fill(nowhere);
  std::size_t i = 0;
  for (const gnomon::ShadowMap& map : plan.maps()) {
    data.clip_from_point[i] = map.clip_from_camera_relative;
    // A rasterizer's constant is in steps that differ from triangle to triangle in float depths, and is one
    // for all views: the look-up takes it instead.
    const gnomon::EngineBias engine =
        gnomon::engine_bias(map, bias, gnomon::BiasWay::rasterizer, kKernelRadius);
    data.depth_bias[i++].x = static_cast<float>(engine.depth);
  }
  return data;
}

// The same for all maps: it counts texels.
float slope_factor(const gnomon::ShadowPlan& plan, const gnomon::BiasOptions& bias) {
  const double factor =
      gnomon::engine_bias(plan.map[0], bias, gnomon::BiasWay::rasterizer, kKernelRadius).slope_factor;
  return static_cast<float>(plan.clip_space.reversed_z ? -factor : factor);  // away from the light
}

}  // namespace

Shadows::Shadows(Device& device, int map_size, int maps, VkBuffer vertices)
    : device_(device),
      data_(device.make_buffer(sizeof(ShadowData),
                               VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                   VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                               false)),
      read_(device.make_buffer(sizeof(ShadowData), VK_BUFFER_USAGE_TRANSFER_DST_BIT, true)),
      maps_(device.make_image(VK_FORMAT_D32_SFLOAT,
                              {static_cast<std::uint32_t>(map_size), static_cast<std::uint32_t>(map_size)},
                              static_cast<std::uint32_t>(maps),
                              VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT)),
      vertices_(vertices) {
  pipelines_[0] = device.make_pipeline({kDepthVert, {}, {}, 0});
  if (device.layer_by_vertex()) pipelines_[1] = device.make_pipeline({kDepthLayeredVert, {}, {}, 0});
  if (device.multiview())
    pipelines_[2] = device.make_pipeline({kDepthMultiviewVert, {}, {}, (1u << maps) - 1});
}

// Clears to the far end, which is 0 in reversed depths.
void Shadows::begin(VkCommandBuffer commands, VkImageView view, Passes passes, float slope) const {
  VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  depth.imageView = view;
  depth.imageLayout = kDrawDepth.layout;
  depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
  info.renderArea.extent = maps_.size;
  const auto layers = static_cast<std::uint32_t>(maps_.layer_views.size());
  info.layerCount = passes == Passes::layered ? layers : 1;
  info.viewMask = passes == Passes::multiview ? (1u << layers) - 1 : 0;
  info.pDepthAttachment = &depth;
  device_.begin_rendering(commands, info);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_[static_cast<std::size_t>(passes)]);
  const VkViewport viewport{0, 0, static_cast<float>(maps_.size.width), static_cast<float>(maps_.size.height),
                            0, 1};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &info.renderArea);
  vkCmdSetDepthBias(commands, 0.0f, 0.0f, slope);
}

void Shadows::record(VkCommandBuffer commands, VkDescriptorSet bound, const gnomon::ShadowPlan& plan,
                     const gnomon::BiasOptions& bias, std::span<const gnomon::Box> casters, Passes passes) {
  const ShadowData data = data_of(plan, bias);
  device_.barrier(commands, kUniform, kWriteByCopy);
  vkCmdUpdateBuffer(commands, data_.handle, 0, sizeof data, &data);
  device_.barrier(commands, kWriteByCopy, kUniform);
  device_.barrier(commands, maps_, {kSample.stages, VK_ACCESS_2_NONE}, kDrawDepth);

  const VkDeviceSize start = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &vertices_, &start);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, device_.layout(), 0, 1, &bound, 0,
                          nullptr);
  const float slope = slope_factor(plan, bias);
  std::vector<bool> in_any(casters.size());
  std::vector<std::uint32_t> drawn(casters.size());
  const std::uint32_t instances = passes == Passes::layered ? static_cast<std::uint32_t>(plan.map_count) : 1;
  const auto draw = [&](std::uint32_t caster) { vkCmdDraw(commands, 36, instances, 36 * caster, 0); };
  const auto push = [&](int map) {
    const DepthPush constants{glm::vec4(glm::vec3(plan.origin_world), 0.0f), map};
    vkCmdPushConstants(commands, device_.layout(), VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
                       0, sizeof constants, &constants);
  };
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    const std::size_t count = gnomon::cull_casters(plan.map[i], casters, drawn);
    if (passes != Passes::one_per_map) {
      for (std::size_t k = 0; k < count; ++k) in_any[drawn[k]] = true;
      continue;
    }
    begin(commands, maps_.layer_views[i], passes, slope);
    push(static_cast<int>(i));
    for (std::size_t k = 0; k < count; ++k) draw(drawn[k]);
    device_.end_rendering(commands);
  }
  if (passes != Passes::one_per_map) {
    begin(commands, maps_.view, passes, slope);
    push(0);
    for (std::uint32_t caster = 0; caster < in_any.size(); ++caster)
      if (in_any[caster]) draw(caster);
    device_.end_rendering(commands);
  }
  device_.barrier(commands, maps_, kDrawDepth, kSample);
}

bool Shadows::holds(const gnomon::ShadowPlan& plan) {
  device_.run([&](VkCommandBuffer commands) {
    device_.barrier(commands, kWriteByCopy, kReadByCopy);
    const VkBufferCopy all{0, 0, sizeof(ShadowData)};
    vkCmdCopyBuffer(commands, data_.handle, read_.handle, 1, &all);
    device_.barrier(commands, kWriteByCopy, kReadByHost);
  });
  const gnomon::ShaderBlock block = gnomon::shader_block(plan);
  bool same = std::memcmp(read_.mapped + offsetof(ShadowData, block), &block, sizeof block) == 0;
  for (std::size_t i = 0; i < plan.maps().size(); ++i)
    same = same && std::memcmp(read_.mapped + i * sizeof(glm::mat4), &plan.map[i].clip_from_camera_relative,
                               sizeof(glm::mat4)) == 0;
  return same;
}

}  // namespace sample
