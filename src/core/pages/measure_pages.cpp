// How good is a page plan? The error at visible points, each in the page that serves it.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "geometry/vector.hpp"
#include "gnomon/pages.hpp"
#include "measure/log_histogram.hpp"
#include "measure/measure_grid.hpp"
#include "measure/metric_lanes.hpp"

namespace gnomon {
namespace {

constexpr std::array<double, 2> kShares = {0.50, 0.95};

class PageTally {
 public:
  PageTally(const PagePlan& plan, const Camera& camera) noexcept
      : plan_(plan), camera_(camera), axes_(camera_axes(camera)) {}

  void add(const glm::dvec3& point, const glm::dvec3* normal) noexcept {
    const int page = page_serving(plan_, point);
    if (page < 0) {
      ++outside_;
      return;
    }
    const std::uint32_t level = plan_.pages[static_cast<std::size_t>(page)].level;
    if (count_ == kMetricLanes || (count_ > 0 && level != level_)) judge();
    if (!frame_ || level != level_) frame_.emplace(plan_.levels[level], camera_, axes_);
    level_ = level;
    has_normals_ = normal != nullptr;
    block_.point.set(count_, point);
    if (normal != nullptr) block_.normal.set(count_, *normal);
    ++count_;
  }
  /// True where the same points are to be added once more.
  [[nodiscard]] bool needs_again() noexcept;
  [[nodiscard]] PageStats stats() noexcept;

 private:
  void judge() noexcept;

  const PagePlan& plan_;
  const Camera& camera_;
  CameraAxes axes_;
  MetricBlock block_;
  std::optional<MetricFrame> frame_;  // of level_
  std::size_t count_ = 0;
  std::uint32_t level_ = 0;
  bool has_normals_ = false;
  LogHistogram<10, 128> histogram_;  // eight octaves
  LogHistogram<8, 48> sides_;        // twelve
  double sum_ = 0.0;
  std::uint64_t undersampled_ = 0, outside_ = 0;
};

void PageTally::judge() noexcept {
  judge_perspective(*frame_, block_, count_);
  if (has_normals_) judge_surface(*frame_, block_, count_);
  const ExtentLanes& e = has_normals_ ? block_.surface : block_.perspective;
  for (std::size_t i = 0; i < count_; ++i) {
    if (has_normals_ && !(block_.cos_eye[i] > 0.0 && block_.cos_light[i] > 0.0)) continue;
    histogram_.add(e.longest[i]);
    sides_.add(max_of(e.s[i], e.t[i]));
    sum_ += e.longest[i];
    if (e.longest[i] > 1.0) ++undersampled_;
  }
  count_ = 0;
}

bool PageTally::needs_again() noexcept {
  if (count_ > 0) judge();
  // Both or none: each counts what the other does.
  const auto of_sides = std::span(kShares).last(1);
  if (histogram_.knows(kShares) && sides_.knows(of_sides)) return false;
  histogram_.count_again(kShares);
  sides_.count_again(of_sides);
  sum_ = 0.0;
  undersampled_ = outside_ = 0;
  return true;
}

PageStats PageTally::stats() noexcept {
  PageStats stats;
  const double pixels = static_cast<double>(camera_.width) * camera_.height;
  const double pages = static_cast<double>(plan_.pages.size());
  const double inside = static_cast<double>(plan_.page_texels) * plan_.page_texels;
  const double whole = static_cast<double>(plan_.slot_texels()) * plan_.slot_texels();
  stats.texels_per_pixel = pages * inside / pixels;
  stats.border_share = (whole - inside) / inside;
  stats.m.storage = pages * whole / pixels;
  stats.m.outside = outside_;
  stats.m.samples = histogram_.count();
  if (stats.m.samples == 0) return stats;
  stats.m.p50 = histogram_.percentile(kShares[0]);
  stats.m.p95 = histogram_.percentile(kShares[1]);
  stats.m.max = histogram_.largest();
  stats.m.mean = sum_ / static_cast<double>(stats.m.samples);
  stats.m.share_undersampled = static_cast<double>(undersampled_) / static_cast<double>(stats.m.samples);
  stats.worst_side = sides_.largest();
  stats.p95_side = sides_.percentile(kShares[1]);
  return stats;
}

}  // namespace

PageStats measure(const PagePlan& plan, const View& view, const SceneBounds& bounds,
                  const MeasureOptions& options) noexcept {
  if (plan.pages.empty()) return {};
  if (!view.points_world.empty()) {
    PageTally tally(plan, view.camera);
    do {
      for (std::size_t i = 0; i < view.points_world.size(); ++i)
        tally.add(view.points_world[i], view.normals_world.empty() ? nullptr : &view.normals_world[i]);
    } while (tally.needs_again());
    return tally.stats();
  }
  const Camera finite = with_finite_far(view.camera, bounds.receivers);
  PageTally tally(plan, finite);
  do {
    for_each_visible(finite, camera_axes(finite), bounds.receivers, options,
                     [&](const glm::dvec3& point, double) { tally.add(point, nullptr); });
  } while (tally.needs_again());
  return tally.stats();
}

}  // namespace gnomon
