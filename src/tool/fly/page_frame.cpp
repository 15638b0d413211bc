// One frame of a flight that is drawn with pages: its row and its pictures.
#include "page_frame.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "frame_pages.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "page_aliasing.hpp"

namespace gnomon::tool::fly {
namespace {

/// Median over a few plans of the same input.
std::int64_t plan_ns(FramePages& pages) {
  std::array<double, 5> ms{};
  for (double& one : ms) {
    pages.again();
    one = pages.plan_ms();
  }
  std::nth_element(ms.begin(), ms.begin() + ms.size() / 2, ms.end());
  return static_cast<std::int64_t>(1e6 * ms[ms.size() / 2]);
}

}  // namespace

DrawnPages draw_with_pages(const Options& options, const Flight& flight, const Camera& camera,
                           const Light& light, render::Renderer& renderer,
                           const render::PreparedFilter& filter) {
  const auto surfaces =
      std::make_shared<const VisibleSurfaces>(draw_surfaces(renderer, camera, options.layer));
  FramePages pages({light, flight.bounds(), page_options_of(options.pages, options.plan)}, surfaces);
  if (pages.plan().status == PlanStatus::invalid_input)
    throw std::runtime_error(options.scene + ": " + invalid_input_text(pages.plan().invalid_field));
  render::FrameOptions frame;
  frame.depth_layer = options.layer;
  frame.light = &light;
  frame.prune = options.prune;
  const double map_ms = pages.refine(renderer, filter, frame);
  DrawnPages result;
  FrameRow& row = result.row;
  row.plan_ns = plan_ns(pages);
  const PagePlan& plan = pages.plan();
  row.status = plan.status;
  row.stats = pages.draw(renderer, camera, filter, frame);
  row.stats.milliseconds[static_cast<std::size_t>(render::Pass::shadow_maps)] += map_ms;
  const PageFrameImages images{renderer.mask(), renderer.positions(), renderer.normals()};
  const std::vector<float> m = page_aliasing(plan, camera, images);
  row.aliasing = report::pixel_aliasing(m);
  row.m_bound[0] = pages.measure().worst_side;
  row.pages =
      PageCounts{row.stats.pages, row.stats.pages_drawn, static_cast<int>(plan.levels.size()), plan.target_m};
  row.omitted = omitted_text(plan.omitted(), row.stats);
  result.lit = renderer.image();
  result.heat = page_heat_map(plan, m, images);
  result.levels = level_picture(result.lit, images.mask, images.normals, plan);
  result.level_text = level_legend(plan);
  const std::vector<Served> served = served_by(plan, pages.drawn());
  result.cached = cached_picture(images.mask, images.normals, served);
  result.cached_text = cached_legend(served, "pages");
  return result;
}

}  // namespace gnomon::tool::fly
