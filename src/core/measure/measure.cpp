// The error over everything the camera sees: percentiles, share of undersampled points, storage.
#include <array>
#include <glm/geometric.hpp>
#include <optional>

#include "geometry/vector.hpp"
#include "gnomon/measure.hpp"
#include "measure/log_histogram.hpp"
#include "measure/measure_grid.hpp"
#include "measure/metric_lanes.hpp"

namespace gnomon {
namespace {

constexpr std::array<double, 2> kShares = {0.50, 0.95};

/// Points on their way to their maps' blocks, and what came out so far.
class Tally {
 public:
  Tally(const ShadowPlan& plan, const Camera& camera, const CameraAxes& axes) noexcept
      : plan_(plan), camera_(camera), axes_(axes) {}

  void add(int map, const glm::dvec3& point) noexcept {
    const auto index = static_cast<std::size_t>(map);
    waiting_[index].point.set(waiting_[index].count++, point);
    if (waiting_[index].count == kMetricLanes) judge(index);
  }
  void add_outside() noexcept { ++outside_; }
  /// True where the same points are to be added once more.
  [[nodiscard]] bool needs_again() noexcept;
  [[nodiscard]] AliasingStats stats() noexcept;

 private:
  struct Waiting {
    VectorLanes point;
    std::size_t count = 0;
  };
  void judge(std::size_t index) noexcept;

  const ShadowPlan& plan_;
  const Camera& camera_;
  const CameraAxes& axes_;
  std::array<Waiting, kMaxMaps> waiting_;
  std::array<std::optional<MetricFrame>, kMaxMaps> frame_;
  MetricBlock block_;
  LogHistogram<10, 96> histogram_;  // six octaves
  double sum_ = 0.0;
  std::array<double, kMaxMaps> s_max_{}, t_max_{};
  std::uint64_t undersampled_ = 0, outside_ = 0;
};

void Tally::judge(std::size_t index) noexcept {
  Waiting& waiting = waiting_[index];
  block_.point = waiting.point;
  if (waiting.count == 0) return;
  if (!frame_[index]) frame_[index].emplace(plan_.map[index], camera_, axes_);
  judge_perspective(*frame_[index], block_, waiting.count);
  const ExtentLanes& e = block_.perspective;
  for (std::size_t i = 0; i < waiting.count; ++i) {
    if (!(block_.inside[i] > 0.0)) {
      ++outside_;
      continue;
    }
    histogram_.add(e.longest[i]);
    sum_ += e.longest[i];
    if (e.longest[i] > 1.0) ++undersampled_;
    s_max_[index] = max_of(s_max_[index], e.s[i]);
    t_max_[index] = max_of(t_max_[index], e.t[i]);
  }
  waiting.count = 0;
}

bool Tally::needs_again() noexcept {
  for (std::size_t i = 0; i < static_cast<std::size_t>(plan_.map_count); ++i) judge(i);
  if (histogram_.knows(kShares)) return false;
  histogram_.count_again(kShares);
  sum_ = 0.0;
  undersampled_ = outside_ = 0;
  return true;
}

AliasingStats Tally::stats() noexcept {
  AliasingStats stats;
  for (std::size_t i = 0; i < static_cast<std::size_t>(plan_.map_count); ++i) {
    const double texels = static_cast<double>(plan_.map[i].width) * plan_.map[i].height;
    stats.storage += s_max_[i] * t_max_[i] * texels / (static_cast<double>(camera_.width) * camera_.height);
  }
  stats.outside = outside_;
  stats.samples = histogram_.count();
  if (stats.samples > 0) {
    stats.p50 = histogram_.percentile(kShares[0]);
    stats.p95 = histogram_.percentile(kShares[1]);
    stats.max = histogram_.largest();
    stats.mean = sum_ / static_cast<double>(stats.samples);
    stats.share_undersampled = static_cast<double>(undersampled_) / static_cast<double>(stats.samples);
  }
  return stats;
}

}  // namespace

AliasingStats measure(const ShadowPlan& plan, const View& view, const SceneBounds& bounds,
                      const MeasureOptions& options) noexcept {
  if (plan.map_count == 0) return {};
  const Camera camera =
      view.points_world.empty() ? with_finite_far(view.camera, bounds.receivers) : view.camera;
  const CameraAxes axes = camera_axes(camera);
  Tally tally(plan, camera, axes);
  const auto sample = [&](const glm::dvec3& point, double depth) {
    const int map = map_serving(plan, point, depth);
    if (map < 0) tally.add_outside();
    if (map >= 0 && (options.map < 0 || map == options.map)) tally.add(map, point);
  };
  do {
    if (view.points_world.empty()) {
      for_each_visible(camera, axes, bounds.receivers, options, sample);
      continue;
    }
    for (const glm::dvec3& point : view.points_world)
      sample(point, glm::dot(point - camera.position, axes.forward));
  } while (tally.needs_again());
  return tally.stats();
}

}  // namespace gnomon
