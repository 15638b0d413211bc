// Parts, copies and layers: each map of a plan as if it were drawn whole.
#include "maps/map_pass.hpp"

#include <array>

#include "context/backend.hpp"
#include "filter/stored_maps.hpp"
#include "gl/program.hpp"
#include "gnomon/render/error.hpp"
#include "gnomon/render/probe.hpp"

namespace gnomon::render {
namespace {

constexpr float kFarthest = 1.0f;
// Locations as shaders/pass/depth/layered.vert and shaders/pass/depth/copy.* state them.
constexpr GLint kClipOfMapsLocation = 10, kLayerLocation = 0, kFirstLocation = 1, kSizeLocation = 2;

}  // namespace

MapPass::MapPass(CasterScene& casters, CasterPass& pass, MapTargets& maps)
    : casters_(casters),
      pass_(pass),
      maps_(maps),
      can_layer_(!layer_extension().empty()),
      copy_depth_(make_program("pass/depth/copy.vert", "pass/depth/copy.frag")),
      no_vertices_(make_vertex_array()) {
  const auto* driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  software_ = driver != nullptr && is_software(driver);
}

LayeredRule MapPass::layered_rule(const FrameOptions& options) noexcept {
  const bool wanted =
      options.map_passes == MapPasses::layered || (options.map_passes == MapPasses::automatic && !software_);
  if (!wanted || !can_layer_ || info_of(options.depth_layer).peels) return {};
  if (!layered_) {
    try {
      layered_.emplace();
    } catch (const RenderError&) {
      // The driver names the extension and its compiler refuses it, or the context is lost.
      can_layer_ = false;
      return {};
    }
  }
  return {options.map_passes, options.depth_layer == DepthLayer::back, software_};
}

void MapPass::draw(const ShadowPlan& plan, const DrawnMaps& drawn, const DepthDraw& how) noexcept {
  const DrawLists& lists = casters_.lists;
  // All moves before the first draw: a copy waits for what is being drawn into its image.
  for (int i = 0; i < plan.map_count; ++i) {
    const MapMove& move = lists.move(i);
    if (move.any()) maps_.move(MapTargets::Of::all, i, move.kept, move.shift_x, move.shift_y);
  }
  draw_static(plan.map_count, drawn, how);
  pass_.begin();
  draw_layered(drawn, how);
  for (int i = 0; i < plan.map_count; ++i) {
    const DrawLists::Copies& copies = lists.beneath(i).copies;
    if ((lists.parts(i).empty() && copies.count == 0) || lists.is_layered(i)) continue;
    const DrawnMap& map = drawn.map[static_cast<std::size_t>(i)];
    const DepthDraw of_map = how.of(map);
    maps_.attach(MapTargets::Of::all, i);
    glViewport(0, 0, map.width, map.height);
    copy_static(copies, i, {map.width, map.height});
    for (const DrawnPart& part : lists.parts(i)) {
      draw_part(part, map, of_map);
      if (info_of(how.layer).peels && !map.bent)
        pass_.peel(maps_, i, part.rectangle, part, map.clip_from_position, of_map,
                   of_map.peeled(plan, plan.map[static_cast<std::size_t>(i)]));
    }
  }
  glDisable(GL_SCISSOR_TEST);
}

void MapPass::draw_part(const DrawnPart& part, const DrawnMap& map, const DepthDraw& how) noexcept {
  const TexelRect& at = part.rectangle;
  // Whole maps with all of their layer, which may be larger.
  if (at.width == map.width && at.height == map.height) {
    glDisable(GL_SCISSOR_TEST);
  } else {
    glEnable(GL_SCISSOR_TEST);
    glScissor(at.x, at.y, at.width, at.height);
  }
  if (part.clear) glClearNamedFramebufferfv(maps_.fbo.name(), GL_DEPTH, 0, &kFarthest);
  if (map.bent)
    pass_.draw_bent(part, map, how.alpha_test_where_masked);
  else
    pass_.draw(part, map.clip_from_position, how);
}

void MapPass::draw_layered(const DrawnMaps& drawn, const DepthDraw& how) noexcept {
  const std::span<const int> joined = casters_.lists.layered_maps();
  if (joined.empty()) return;
  std::array<glm::mat4, kMaxMaps> clip_of_maps;
  for (std::size_t i = 0; i < clip_of_maps.size(); ++i) clip_of_maps[i] = drawn.map[i].clip_from_position;
  const DrawnMap& first = drawn.map[static_cast<std::size_t>(joined.front())];
  glDisable(GL_SCISSOR_TEST);
  glViewport(0, 0, first.width, first.height);
  const GLuint fbo = layered_->fbo.name();
  glNamedFramebufferTexture(fbo, GL_DEPTH_ATTACHMENT, maps_.depth.name(), 0);
  glBindFramebuffer(GL_FRAMEBUFFER, fbo);
  if (joined.size() == static_cast<std::size_t>(maps_.layers)) {
    glClearNamedFramebufferfv(fbo, GL_DEPTH, 0, &kFarthest);
  } else {
    // A clear of the framebuffer would take kept maps along.
    for (const int map : joined)
      glClearTexSubImage(maps_.depth.name(), 0, 0, 0, map, maps_.width, maps_.height, 1, GL_DEPTH_COMPONENT,
                         GL_FLOAT, &kFarthest);
  }
  pass_.draw_layer(casters_.lists.layered_part(), CasterPrograms{layered_->opaque, layered_->masked},
                   is_mirrored(first.clip_from_position), how, [&] {
                     glUniformMatrix4fv(kClipOfMapsLocation, static_cast<GLsizei>(clip_of_maps.size()),
                                        GL_FALSE, &clip_of_maps[0][0][0]);
                   });
}

void MapPass::draw_static(int map_count, const DrawnMaps& drawn, const DepthDraw& how) noexcept {
  const DrawLists& lists = casters_.lists;
  const auto each = [&](auto&& act) {
    for (int i = 0; i < map_count; ++i)
      if (lists.beneath(i).used) act(i, lists.beneath(i));
  };
  // Copies and draws by turns would wait for each other, map by map.
  each([&](int i, const DrawLists::Beneath& beneath) {
    maps_.add_beneath();
    if (beneath.adopts) maps_.copy(MapTargets::Of::static_casters, i, {0, 0, maps_.width, maps_.height});
    const MapMove& move = beneath.move;
    if (move.any()) maps_.move(MapTargets::Of::static_casters, i, move.kept, move.shift_x, move.shift_y);
  });
  pass_.begin();
  each([&](int i, const DrawLists::Beneath& beneath) {
    if (beneath.parts().empty()) return;
    const DrawnMap& map = drawn.map[static_cast<std::size_t>(i)];
    maps_.attach(MapTargets::Of::static_casters, i);
    glViewport(0, 0, map.width, map.height);
    const DepthDraw of_map = how.of(map);
    for (const DrawnPart& part : beneath.parts()) draw_part(part, map, of_map);
  });
  glDisable(GL_SCISSOR_TEST);
  each([&](int i, const DrawLists::Beneath& beneath) {
    if (beneath.copies_whole) maps_.copy(MapTargets::Of::all, i, {0, 0, maps_.width, maps_.height});
  });
}

void MapPass::copy_static(const DrawLists::Copies& copies, int layer, glm::ivec2 viewport) noexcept {
  if (copies.count == 0) return;
  glDisable(GL_SCISSOR_TEST);
  glViewport(0, 0, viewport.x, viewport.y);
  glBindTextureUnit(kDepthUnit, maps_.beneath.name());
  glBindSampler(kDepthUnit, maps_.plain_sampler.name());
  glUseProgram(copy_depth_.name());
  glUniform1i(kLayerLocation, layer);
  glUniform1i(kFirstLocation, static_cast<GLint>(copies.first));
  glUniform2f(kSizeLocation, static_cast<GLfloat>(viewport.x), static_cast<GLfloat>(viewport.y));
  glBindVertexArray(no_vertices_.name());
  glDepthFunc(GL_ALWAYS);
  constexpr GLsizei kCorners = 6;
  glDrawArrays(GL_TRIANGLES, 0, kCorners * static_cast<GLsizei>(copies.count));
  glDepthFunc(GL_LESS);
  glBindVertexArray(casters_.buffers.vertex_array());
}

}  // namespace gnomon::render
