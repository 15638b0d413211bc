// What several sources do alike.
#include "source/frame_source.hpp"

#include <algorithm>

namespace gnomon::render {

bool bends_lines(const ShadowPlan& plan) noexcept {
  const auto planned = plan.maps();
  return std::any_of(planned.begin(), planned.end(), [](const ShadowMap& map) { return !map.shape->affine; });
}

bool composes(const FrameOptions& options) noexcept {
  return options.prune.has(PruneRule::static_casters) && options.prune.has(PruneRule::held_maps) &&
         !info_of(options.depth_layer).peels;
}

void tint_from_maps(const Screen& screen, PanePass& panes, const ShadowPlan& plan, const DrawnMaps& drawn,
                    const Camera& camera, const TexelRect& part, const PanePass::MapDraw& how) {
  panes.resize(camera.width, camera.height);
  panes.draw_maps(plan, drawn, how);
  panes.bind_maps(camera.position);
  screen.bind_mask();
  glEnable(GL_SCISSOR_TEST);
  glScissor(part.x, part.y, part.width, part.height);
  screen.fullscreen(panes.fbo(), panes.transmittance_program());
  glDisable(GL_SCISSOR_TEST);
}

void draw_mask(const Screen& screen, const Program& program, GLuint fbo) noexcept {
  screen.fullscreen(fbo, program);
  glBindSampler(kDepthMaxUnit, 0);  // shared with other images
}

MapStats work_of_map(const DrawLists& lists, int map, DepthLayer layer) noexcept {
  MapStats work = lists.map_stats(map);
  if (!info_of(layer).peels) return work;
  work.draws *= 2;
  work.triangles *= 2;
  return work;
}

void count_lists(const DrawLists& lists, FrameStats& stats) noexcept {
  stats.saved = lists.saved();
  stats.camera = lists.camera_stats();
}

}  // namespace gnomon::render
