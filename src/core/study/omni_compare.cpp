// Which way of mapping all directions is best for what a camera sees?
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "gnomon/study/omni.hpp"
#include "lanes/elementary.hpp"
#include "measure/log_histogram.hpp"

namespace gnomon {
namespace {

/// Statistics of one mapping in the making.
struct Tally {
  LogHistogram<6> histogram;  // three of them stand on the stack
  std::array<double, 6> s{}, t{};
  std::uint64_t undersampled = 0;

  void add(int map, const PointAliasing& a) noexcept {
    histogram.add(a.m_max);
    if (a.m_max > 1.0) ++undersampled;
    const auto k = static_cast<std::size_t>(map);
    s[k] = max_of(s[k], a.m_s);
    t[k] = max_of(t[k], a.m_t);
  }
  [[nodiscard]] AliasingStats finished(double texels_per_map, double pixels) const noexcept {
    AliasingStats stats;
    stats.samples = histogram.count();
    if (stats.samples == 0) return stats;
    stats.p50 = histogram.percentile(0.50);
    stats.p95 = histogram.percentile(0.95);
    stats.max = histogram.largest();
    stats.share_undersampled = static_cast<double>(undersampled) / static_cast<double>(stats.samples);
    for (std::size_t k = 0; k < s.size(); ++k) stats.storage += s[k] * t[k] * texels_per_map / pixels;
    return stats;
  }
};

}  // namespace

OmniComparison compare_omni(const PointLight& light, const Camera& any_camera, const SceneBounds& bounds,
                            double texels, const MeasureGrid& grid) noexcept {
  constexpr std::array kMappings = {OmniMapping::cube, OmniMapping::dual_paraboloid,
                                    OmniMapping::tetrahedron};
  std::array<Tally, 3> tally;
  const Camera camera = with_finite_far(any_camera, bounds.receivers);
  const CameraAxes axes = camera_axes(camera);
  const double n = camera.near_depth, f = camera.far_depth;
  const int rays = grid.columns * grid.rows;
  for (int k = 0; k < grid.depths; ++k) {
    const double along = (k + 0.5) / grid.depths;
    const double depth = n > 0.0 ? n * elementary::pow(f / n, along) : n + (f - n) * along;
    const double scale = camera.orthographic ? 1.0 : depth;
    for (int i = 0; i < rays; ++i) {
      const double x = camera.left + (camera.right - camera.left) * (i % grid.columns + 0.5) / grid.columns;
      const double y = camera.bottom + (camera.top - camera.bottom) * (i / grid.columns + 0.5) / grid.rows;
      const glm::dvec3 p = camera.position + axes.forward * depth + (axes.right * x + axes.up * y) * scale;
      const glm::dvec3 offset = p - light.position;
      if (!(glm::dot(offset, offset) <= light.range * light.range) || !in_some_box(bounds.receivers, p))
        continue;
      for (std::size_t m = 0; m < kMappings.size(); ++m) {
        const PointAliasing a = omni_aliasing(kMappings[m], texels, light.position, camera, p);
        if (a.status != PointAliasing::Status::ok) continue;
        tally[m].add(omni_from_direction(kMappings[m], offset).map, a);
      }
    }
  }
  const double pixels = static_cast<double>(camera.width) * camera.height;
  const auto finished = [&](std::size_t m) {
    return tally[m].finished(texels / omni_map_count(kMappings[m]), pixels);
  };
  return {finished(0), finished(1), finished(2)};
}

}  // namespace gnomon
