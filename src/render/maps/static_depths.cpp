// The depths of static casters, beneath those of moving ones: what is drawn into them, and what is copied.
#include "frame/renderer_impl.hpp"

namespace gnomon::render {
namespace {

constexpr float kFarthest = 1.0f;
// Locations as shaders/pass/depth/copy.* state them.
constexpr GLint kLayerLocation = 0, kFirstLocation = 1, kSizeLocation = 2;

}  // namespace

void Renderer::Impl::draw_static_maps(const DrawnMaps& drawn, const DepthDraw& how) noexcept {
  const auto each = [&](auto&& act) {
    for (int i = 0; i < map_count; ++i)
      if (lists.beneath(i).used) act(i, lists.beneath(i));
  };
  // Copies and draws by turns would wait for each other, map by map.
  each([&](int i, const DrawLists::Beneath& beneath) {
    maps.add_beneath();
    if (beneath.adopts) maps.copy(MapTargets::Of::static_casters, i, {0, 0, maps.width, maps.height});
    const MapMove& move = beneath.move;
    if (move.any()) maps.move(MapTargets::Of::static_casters, i, move.kept, move.shift_x, move.shift_y);
  });
  glBindVertexArray(scene.vertex_array());
  scene.use(SceneBuffers::Placed::for_maps);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  each([&](int i, const DrawLists::Beneath& beneath) {
    if (beneath.parts().empty()) return;
    const DrawnMap& map = drawn.map[static_cast<std::size_t>(i)];
    glNamedFramebufferTextureLayer(maps.fbo.name(), GL_DEPTH_ATTACHMENT, maps.beneath.name(), 0, i);
    glBindFramebuffer(GL_FRAMEBUFFER, maps.fbo.name());
    glViewport(0, 0, map.width, map.height);
    const DepthDraw of_map = how.of(map);
    for (const DrawnPart& part : beneath.parts()) draw_map_part(part, map, of_map);
  });
  glDisable(GL_SCISSOR_TEST);
  each([&](int i, const DrawLists::Beneath& beneath) {
    if (beneath.copies_whole) maps.copy(MapTargets::Of::all, i, {0, 0, maps.width, maps.height});
  });
}

void Renderer::Impl::copy_static(const DrawLists::Copies& copies, int layer, glm::ivec2 viewport) noexcept {
  if (copies.count == 0) return;
  glDisable(GL_SCISSOR_TEST);
  glViewport(0, 0, viewport.x, viewport.y);
  glBindTextureUnit(kDepthUnit, maps.beneath.name());
  glBindSampler(kDepthUnit, maps.plain_sampler.name());
  glUseProgram(programs.copy_depth.name());
  glUniform1i(kLayerLocation, layer);
  glUniform1i(kFirstLocation, static_cast<GLint>(copies.first));
  glUniform2f(kSizeLocation, static_cast<GLfloat>(viewport.x), static_cast<GLfloat>(viewport.y));
  glBindVertexArray(no_vertices.name());
  glDepthFunc(GL_ALWAYS);
  constexpr GLsizei kCorners = 6;
  glDrawArrays(GL_TRIANGLES, 0, kCorners * static_cast<GLsizei>(copies.count));
  glDepthFunc(GL_LESS);
  glBindVertexArray(scene.vertex_array());
}

}  // namespace gnomon::render
