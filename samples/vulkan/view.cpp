// The camera's pass, with reversed depths and points relative to the eye.
#include "view.hpp"

#include <array>
#include <glm/geometric.hpp>

#include "shaders.hpp"

namespace sample {
namespace {

struct Push {
  glm::mat4 clip_from_point;
  glm::vec4 eye, forward;
};

constexpr VkImageUsageFlags kReadColor =
    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;

VkExtent2D extent(int width, int height) {
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

std::size_t pixels(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

}  // namespace

View::View(Device& device, int width, int height, VkBuffer vertices, std::uint32_t vertex_count,
           const Shadows& shadows)
    : device_(device),
      vertices_(vertices),
      vertex_count_(vertex_count),
      color_(device.make_image(VK_FORMAT_R8G8B8A8_UNORM, extent(width, height), 1, kReadColor)),
      lit_(device.make_image(VK_FORMAT_R32_SFLOAT, extent(width, height), 1, kReadColor)),
      depth_(device.make_image(VK_FORMAT_D32_SFLOAT, extent(width, height), 1,
                               VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT)),
      color_read_(device.make_buffer(4 * pixels(width, height), VK_BUFFER_USAGE_TRANSFER_DST_BIT, true)),
      lit_read_(device.make_buffer(4 * pixels(width, height), VK_BUFFER_USAGE_TRANSFER_DST_BIT, true)),
      pipeline_(device.make_pipeline({kSceneVert, kSceneFrag, {color_.format, lit_.format}, 0})),
      bound_(device.bind(shadows.data(), shadows.maps(), device.make_comparing_sampler())) {}

void View::record(VkCommandBuffer commands, const gnomon::Camera& camera) {
  device_.barrier(commands, color_, {kReadByCopy.stages, VK_ACCESS_2_NONE}, kDrawColor);
  device_.barrier(commands, lit_, {kReadByCopy.stages, VK_ACCESS_2_NONE}, kDrawColor);
  device_.barrier(commands, depth_, {kDrawDepth.stages, kDrawDepth.access}, kDrawDepth);

  std::array<VkRenderingAttachmentInfo, 3> targets{};
  const std::array<VkImageView, 3> views{color_.view, lit_.view, depth_.view};
  for (std::size_t i = 0; i < targets.size(); ++i) {
    targets[i].sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    targets[i].imageView = views[i];
    targets[i].imageLayout = i == 2 ? kDrawDepth.layout : kDrawColor.layout;
    targets[i].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    targets[i].storeOp = i == 2 ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;
  }
  targets[0].clearValue.color = {
      {0.62f, 0.74f, 0.9f, 1.0f}};  // the sky; depths are cleared to 0, the far end
  VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
  info.renderArea.extent = color_.size;
  info.layerCount = 1;
  info.colorAttachmentCount = 2;
  info.pColorAttachments = targets.data();
  info.pDepthAttachment = &targets[2];
  device_.begin_rendering(commands, info);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
  const VkViewport viewport{
      0, 0, static_cast<float>(color_.size.width), static_cast<float>(color_.size.height), 0, 1};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &info.renderArea);
  const VkDeviceSize start = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &vertices_, &start);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, device_.layout(), 0, 1, &bound_, 0,
                          nullptr);

  gnomon::Camera at_origin = camera;
  at_origin.position = glm::dvec3(0.0);
  const Push push{glm::mat4(gnomon::clip_from_gl_clip(kMapClipSpace) * gnomon::clip_from_view(camera) *
                            gnomon::view_from_world(at_origin)),
                  glm::vec4(glm::vec3(camera.position), 0.0f),
                  glm::vec4(glm::vec3(glm::normalize(camera.forward)), 0.0f)};
  vkCmdPushConstants(commands, device_.layout(), VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                     sizeof push, &push);
  vkCmdDraw(commands, vertex_count_, 1, 0, 0);
  device_.end_rendering(commands);

  const auto copy = [&](const Image& image, const Buffer& to) {
    device_.barrier(commands, image, kDrawColor, kReadByCopy);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {image.size.width, image.size.height, 1};
    vkCmdCopyImageToBuffer(commands, image.handle, kReadByCopy.layout, to.handle, 1, &region);
  };
  copy(color_, color_read_);
  copy(lit_, lit_read_);
  device_.barrier(commands, kWriteByCopy, kReadByHost);
}

Drawn View::read() const {
  Drawn out;
  const std::size_t count = lit_read_.bytes / sizeof(float);
  const float* const lit = reinterpret_cast<const float*>(lit_read_.mapped);
  out.lit.assign(lit, lit + count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      out.rgb.push_back(static_cast<std::uint8_t>(color_read_.mapped[4 * i + c]));
  return out;
}

}  // namespace sample
