// Edges are drawn as bands a texel wide; the nearest outline that the map does not hide gives the point.
#include "maps/silhouettes.hpp"

#include <array>

#include "casters/caster_edges.hpp"
#include "filter/stored_maps.hpp"
#include "gl/program.hpp"

namespace gnomon::render {
namespace {

// As the shaders state them.
constexpr GLint kClipLocation = 3, kSizeLocation = 4, kLayerLocation = 5, kEvenScaleLocation = 10;
constexpr std::array<float, 4> kMiddle{127.0f / 255.0f, 127.0f / 255.0f, 0.0f, 0.0f};

}  // namespace

Silhouettes::Silhouettes(const SceneBuffers& scene)
    : program_(
          make_program("pass/depth/depth.vert", "pass/depth/silhouette.geom", "pass/depth/silhouette.frag")) {
  const std::vector<glm::vec3> positions = scene.read_positions();
  std::vector<std::uint32_t> all;
  for (const Primitive& primitive : scene.primitives()) {
    const std::vector<std::uint32_t> edges = caster_edges(positions, scene.read_indices(primitive));
    edges_of_.push_back({static_cast<std::uint32_t>(all.size()), static_cast<std::uint32_t>(edges.size())});
    all.insert(all.end(), edges.begin(), edges.end());
  }
  edges_ = filled_buffer(all);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glSamplerParameteri(sampler_.name(), wrap, GL_CLAMP_TO_BORDER);
  glSamplerParameteri(sampler_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glSamplerParameteri(sampler_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glSamplerParameterfv(sampler_.name(), GL_TEXTURE_BORDER_COLOR, kMiddle.data());
}

bool Silhouettes::fit(const MapTargets& maps) {
  if (width_ == maps.width && height_ == maps.height && layers_ == maps.layers) return false;
  width_ = maps.width;
  height_ = maps.height;
  layers_ = maps.layers;
  points_ = make_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(points_.name(), 1, GL_RG8, width_, height_, layers_);
  depth_ = depth_layers(width_, height_, 1);
  fbo_ = make_framebuffer();
  glNamedFramebufferTextureLayer(fbo_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0, 0);
  return true;
}

std::uint64_t Silhouettes::bytes() const noexcept {
  constexpr std::uint64_t kPointBytes = 2;
  return kPointBytes * static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_) *
         static_cast<std::uint64_t>(layers_);
}

std::uint64_t Silhouettes::scratch_bytes() const noexcept {
  constexpr std::uint64_t kDepthBytes = 4;
  return kDepthBytes * static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_);
}

void Silhouettes::add_commands(const SceneBuffers& scene, const DrawLists& lists, const DrawnPart& part) {
  for (const BatchRange& range : lists.ranges(part)) {
    if (scene.batches()[range.batch].masked) continue;
    std::uint32_t previous = ~0u;
    for (const DrawCommand& triangles : lists.commands().subspan(range.begin, range.end - range.begin)) {
      // Parts of one large caster follow each other.
      if (triangles.base_instance == previous) continue;
      previous = triangles.base_instance;
      const EdgeRange& edges = edges_of_[scene.primitive_index(lists.objects()[previous])];
      if (edges.count > 0)
        commands_.push_back({edges.count, triangles.instance_count, edges.first, 0, previous});
    }
  }
}

void Silhouettes::draw(const SceneBuffers& scene, const DrawLists& lists, const MapTargets& maps,
                       const DrawnMaps& drawn, int map_count) noexcept {
  std::array<std::size_t, kMaxMaps + 1> begin{};
  commands_.clear();
  for (int i = 0; i < map_count; ++i) {
    if (!drawn.map[static_cast<std::size_t>(i)].bent)
      for (const DrawnPart& part : lists.parts(i)) add_commands(scene, lists, part);
    begin[static_cast<std::size_t>(i) + 1] = commands_.size();
  }
  send_growing(command_buffer_, command_capacity_, commands_);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, command_buffer_.name());
  glBindVertexArray(scene.vertex_array());
  glVertexArrayElementBuffer(scene.vertex_array(), edges_.name());
  glBindTextureUnit(kDepthUnit, maps.depth.name());
  glBindSampler(kDepthUnit, maps.plain_sampler.name());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glUseProgram(program_.name());
  for (int i = 0; i < map_count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (lists.parts(i).empty()) continue;
    const DrawnMap& map = drawn.map[at];
    glNamedFramebufferTextureLayer(fbo_.name(), GL_COLOR_ATTACHMENT0, points_.name(), 0, i);
    glBindFramebuffer(GL_FRAMEBUFFER, fbo_.name());
    constexpr float kFarthest = 1.0f;
    glClearNamedFramebufferfv(fbo_.name(), GL_COLOR, 0, kMiddle.data());
    glClearNamedFramebufferfv(fbo_.name(), GL_DEPTH, 0, &kFarthest);
    glViewport(0, 0, map.width, map.height);
    glUniformMatrix4fv(kClipLocation, 1, GL_FALSE, &map.clip_from_position[0][0]);
    glUniform2f(kSizeLocation, static_cast<float>(map.width), static_cast<float>(map.height));
    glUniform1i(kLayerLocation, i);
    glUniform1f(kEvenScaleLocation, map.even_scale);
    glMultiDrawElementsIndirect(GL_LINES_ADJACENCY, GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(begin[at] * sizeof(DrawCommand)),
                                static_cast<GLsizei>(begin[at + 1] - begin[at]), 0);
  }
  glVertexArrayElementBuffer(scene.vertex_array(), scene.index_buffer());
  lists.bind_commands();
}

void Silhouettes::bind() const noexcept {
  glBindTextureUnit(kStoredUnit, points_.name());
  glBindSampler(kStoredUnit, sampler_.name());
}

}  // namespace gnomon::render
