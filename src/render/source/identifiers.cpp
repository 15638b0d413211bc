// A frame whose shadows are found by identifiers: maps and pixels hold who is nearest, and a pixel is lit
// where both name the same.
#include <algorithm>

#include "frame/renderer_impl.hpp"

namespace gnomon::render {

PreparedFilter Renderer::prepare_identifiers(const IdentifierTest& test) {
  PreparedFilter prepared = prepare(filters::hard);
  if (!impl_->identifiers) impl_->identifiers.emplace(impl_->scene);
  prepared.identifiers = test;
  prepared.identifiers->neighbours = std::clamp(test.neighbours, 0, kMostIdentifierNeighbours);
  return prepared;
}

bool Renderer::Impl::takes_identifiers(const ShadowPlan& plan, const PreparedFilter& filter) const noexcept {
  const auto planned = plan.maps();
  return filter.identifiers && identifiers &&
         std::all_of(planned.begin(), planned.end(), [](const ShadowMap& map) { return map.shape->affine; });
}

void Renderer::Impl::take_identifiers(std::optional<IdentifierOf> of) noexcept {
  if (of && of != drawn_identifiers) lists.forget_maps();
  drawn_identifiers = of;
}

void Renderer::Impl::draw_identified_maps(const DrawnMaps& drawn, bool alpha_test_where_masked) noexcept {
  glBindVertexArray(scene.vertex_array());
  scene.use(SceneBuffers::Placed::for_maps);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  for (int i = 0; i < map_count; ++i) {
    if (lists.parts(i).empty()) continue;
    const DrawnMap& map = drawn.map[static_cast<std::size_t>(i)];
    identifiers->attach(maps, i);
    glViewport(0, 0, map.width, map.height);
    // A map that changes is drawn whole, in one part.
    for (const DrawnPart& part : lists.parts(i)) {
      glDisable(GL_SCISSOR_TEST);
      if (part.clear) identifiers->clear();
      draw_identified_casters(part, map.clip_from_position, alpha_test_where_masked);
    }
  }
}

FrameStats Renderer::Impl::draw_identified(const ShadowPlan& plan, const Camera& camera,
                                           const PreparedFilter& filter,
                                           const FrameOptions& options) noexcept {
  FrameStats stats;
  const PassTimer timed{stats, options.time_passes};
  const IdentifierTest& test = *filter.identifiers;
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  targets.resize(camera.width, camera.height);
  targets.add_identifiers();
  history.forget();  // the mask is this frame's alone
  fit_maps(plan);
  if (identifiers->fit(maps)) lists.forget_maps();
  identifiers->use(test.of);
  const BlurSides blur{};
  const FrameBlock block =
      frame_block(plan, camera, options, maps.width, maps.height, blur, depth_curves(plan));
  // A receiver that is not drawn leaves its texels to what lies behind it. Parts of large casters come in an
  // order of their own, and triangles are numbered by the scene's.
  PruneRules prune = options.prune.without(PruneRule::small_casters);
  if (test.of == IdentifierOf::triangle) prune = prune.without(PruneRule::caster_clusters);
  constexpr bool kReadsEverywhere = true, kDrawnWhole = true;
  DrawnMaps drawn;
  timed(Pass::shadow_maps, [&] {
    upload(block, filter_block(filter.settings, blur));
    drawn = place_scene(plan, camera.position);
    lists.build({plan, prune, 0.0, kReadsEverywhere, kDrawnWhole, movers.changed_world(),
                 movers.static_changed_world()},
                drawn, camera);
    if (plan.map_count > 0) movers.finish_frame();
    draw_identified_maps(drawn, options.prune.has(PruneRule::alpha_test));
  });
  timed(Pass::surfaces, [&] { draw_surfaces(targets.identified_fbo.name(), identifiers->surfaces()); });
  timed(Pass::mask, [&] {
    bind_noise(options.noise);
    identifiers->bind(targets.identifier.name(), test.neighbours);
    fullscreen(targets.mask_fbo.name(), identifiers->mask());
  });
  if (panes) timed(Pass::panes, [&] { draw_transmittance(plan, drawn, camera, options, stats); });
  draw_pictures(timed, options, [&] { draw_shade(block, camera.position); });
  count_work(plan, stats);
  stats.identified = true;
  stats.map_bytes = maps.bytes() + identifiers->bytes() + (panes ? panes->bytes() : 0);
  return stats;
}

}  // namespace gnomon::render
