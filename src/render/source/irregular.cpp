// A frame whose shadows are exact: pixels are listed by the texels that they look into, and casters are
// tested against the lists (irregular z-buffer).
#include <algorithm>

#include "gnomon/render/context.hpp"
#include "frame/renderer_impl.hpp"

namespace gnomon::render {

PreparedFilter Renderer::prepare_irregular(int samples) {
  PreparedFilter prepared = prepare(filters::hard);
  if (!impl_->pixel_lists) impl_->pixel_lists.emplace();
  if (impl_->panes) impl_->panes->prepare_listed();
  prepared.irregular = true;
  prepared.samples = std::clamp(samples, 1, kMostFacetSamples);
  return prepared;
}

std::vector<std::uint32_t> Renderer::list_lengths() const {
  if (!impl_->pixel_lists) return {};
  std::vector<std::uint32_t> lengths = impl_->pixel_lists->lengths();
  check_context();
  return lengths;
}

FrameStats Renderer::Impl::draw_irregular(const ShadowPlan& plan, const Camera& camera,
                                          const PreparedFilter& filter,
                                          const FrameOptions& options) noexcept {
  FrameStats stats;
  const PassTimer timed{stats, options.time_passes};
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  targets.resize(camera.width, camera.height);
  history.forget();  // the mask is this frame's alone
  map_count = 0;     // no depths are drawn
  glm::ivec2 size(1);
  for (const ShadowMap& map : plan.maps()) size = glm::max(size, glm::ivec2(map.width, map.height));
  const BlurSides blur{};
  const FrameBlock block = frame_block(plan, camera, options, size.x, size.y, blur, DepthCurves{});
  upload(block, filter_block(filter.settings, blur));
  scene.place(SceneBuffers::Placed::for_camera, camera.position);
  // The rule that loses small casters is the only one that an exact mask would show.
  lists.build_uncached({plan, options.prune.without(PruneRule::small_casters)}, camera);
  targets.add_off_plane();
  timed(Pass::surfaces, [&] { draw_surfaces(targets.off_plane_fbo.name(), pixel_lists->surfaces()); });
  timed(Pass::mask, [&] {
    pixel_lists->clear({camera.width, camera.height}, filter.samples, size, std::max(plan.map_count, 1));
    bind_surfaces();
    pixel_lists->list(light_frames(plan, camera, scene.diagonal()), targets.off_plane.name(),
                      targets.mask.name());
  });
  timed(Pass::shadow_maps, [&] { draw_casters_on_lists(plan, options.prune.has(PruneRule::alpha_test)); });
  if (panes) timed(Pass::panes, [&] { draw_listed_transmittance(plan, camera); });
  draw_pictures(timed, options, [&] { draw_shade(block, camera.position); });
  count_work(plan, stats);
  stats.irregular = true;
  stats.map_bytes = pixel_lists->bytes() + (panes ? panes->bytes() : 0);
  return stats;
}

}  // namespace gnomon::render
