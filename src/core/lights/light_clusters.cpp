// Which lights can light a pixel? Spheres and cones against boxes round the clusters of the view.
// Based on: Olsson, Billeter, Assarsson, "Clustered Deferred and Forward Shading", 2012.
#include "gnomon/lights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/usable.hpp"
#include "plan/input.hpp"

namespace gnomon {
namespace {

constexpr int kMaxImageSide = 1 << 16;
// Slices span so much of the depths at most.
constexpr double kDepthRatio = 1000.0;
// Shaders take logarithms of float depths: a surface is at home in the slice beside as well.
constexpr double kSliceSlack = 1.0 / 64.0;
// Surfaces are interpolated over triangles: they lie off their pixel by a share of their distance.
constexpr double kSurfaceSlack = 1e-3;

int parts(int side, int each) noexcept {
  return side / each + (side % each != 0 ? 1 : 0);
}

std::size_t count_of(const Camera& camera, int tile, int slices) noexcept {
  return static_cast<std::size_t>(parts(camera.width, tile)) *
         static_cast<std::size_t>(parts(camera.height, tile)) * static_cast<std::size_t>(slices);
}

/// A light in view space: x right, y up, z along the view.
struct ClusterLight {
  glm::dvec3 centre{0.0};
  double range = 0.0;
  double slack = 0.0;  ///< how far a surface may lie off its pixel near the light; part of `range`
  glm::dvec3 axis{0.0};
  double sine = 0.0, cosine = -2.0;  ///< of the cone's half angle; below -1: none, or wider than a half space
  bool everywhere = false;           ///< a sun
};

ClusterLight in_view(const Light& light, const Camera& camera, const CameraAxes& axes) noexcept {
  const auto turned = [&](const glm::dvec3& v) {
    return glm::dvec3(glm::dot(v, axes.right), glm::dot(v, axes.up), glm::dot(v, axes.forward));
  };
  ClusterLight result;
  const auto* spot = std::get_if<SpotLight>(&light);
  const auto* point = std::get_if<PointLight>(&light);
  result.everywhere = spot == nullptr && point == nullptr;
  if (result.everywhere) return result;
  result.centre = turned((spot != nullptr ? spot->position : point->position) - camera.position);
  const double range = spot != nullptr ? spot->range : point->range;
  result.slack = kSurfaceSlack * (glm::length(result.centre) + range);
  result.range = range > 0.0 ? range + result.slack : 0.0;
  constexpr double kHalfSpace = 1.57;
  if (spot == nullptr || !(spot->outer_radians < kHalfSpace)) return result;
  result.axis = turned(glm::normalize(spot->direction));
  result.sine = std::sin(spot->outer_radians);
  result.cosine = std::cos(spot->outer_radians);
  return result;
}

/// Depths of slices, and which slices hold a depth.
struct Slices {
  double scale = 0.0, offset = 0.0;
  int count = 1;
  bool orthographic = false;

  Slices(const Camera& camera, double deepest, int slice_count) noexcept
      : count(slice_count), orthographic(camera.orthographic) {
    const double far_depth = std::min(camera.far_depth, std::max(deepest, camera.near_depth));
    // The last slice is for surfaces beyond all local lights.
    const double steps = std::max(count - 1.0 - 2.0 * kSliceSlack, 0.0);
    if (orthographic) {
      scale = far_depth > camera.near_depth ? steps / (far_depth - camera.near_depth) : 0.0;
      offset = -scale * camera.near_depth;
      return;
    }
    const double first = std::max(camera.near_depth, far_depth / kDepthRatio);
    const double octaves = std::log2(far_depth / first);
    scale = octaves > 1e-6 ? steps / octaves : 0.0;
    offset = -scale * std::log2(first);
  }
  /// Not clamped.
  [[nodiscard]] double at(double depth) const noexcept {
    return scale * (orthographic ? depth : std::log2(depth)) + offset;
  }
  [[nodiscard]] int clamped(double slice) const noexcept {
    return static_cast<int>(std::clamp(std::floor(slice), 0.0, count - 1.0));
  }
  /// Depth where slice `i` begins, i in -inf..inf.
  [[nodiscard]] double depth(double i) const noexcept {
    const double v = (i - offset) / scale;
    return orthographic ? v : std::exp2(v);
  }
};

/// Everything that stays the same from light to light.
class Clusters {
 public:
  Clusters(const Camera& camera, const Slices& slices, int tile) noexcept
      : camera_(camera),
        slices_(slices),
        columns_(parts(camera.width, tile)),
        rows_(parts(camera.height, tile)) {
    step_ = {(camera.right - camera.left) / camera.width * tile,
             (camera.top - camera.bottom) / camera.height * tile};
  }
  [[nodiscard]] int columns() const noexcept { return columns_; }
  [[nodiscard]] int rows() const noexcept { return rows_; }

  /// Calls `found(cluster)` for the clusters that the light may reach into, until it returns false.
  template <class Found>
  [[nodiscard]] bool visit(const ClusterLight& light, Found&& found) const noexcept;

 private:
  struct Range {
    int first, last;
  };
  /// Tiles along one axis that x in low..high may fall into, at depths near..far.
  [[nodiscard]] Range tiles(double low, double high, double near_depth, double far_depth, double begin,
                            double step, int count) const noexcept;
  [[nodiscard]] bool reaches(const ClusterLight& light, const glm::dvec3& low,
                             const glm::dvec3& high) const noexcept;

  const Camera& camera_;
  const Slices& slices_;
  int columns_, rows_;
  glm::dvec2 step_;
};

Clusters::Range Clusters::tiles(double low, double high, double near_depth, double far_depth, double begin,
                                double step, int count) const noexcept {
  if (!camera_.orthographic) {
    low /= low > 0.0 ? far_depth : near_depth;
    high /= high > 0.0 ? near_depth : far_depth;
  }
  const double last = count - 1.0;
  const double a = std::floor((low - begin) / step), b = std::floor((high - begin) / step);
  if (!(a <= last && b >= 0.0)) return {0, -1};
  return {static_cast<int>(std::max(a, 0.0)), static_cast<int>(std::min(b, last))};
}

bool Clusters::reaches(const ClusterLight& light, const glm::dvec3& low,
                       const glm::dvec3& high) const noexcept {
  const glm::dvec3 off = light.centre - glm::clamp(light.centre, low, high);
  if (glm::dot(off, off) > light.range * light.range) return false;
  if (light.cosine < -1.0) return true;
  // The box's sphere lies outside of the cone: Wronski, "Cull that cone", 2017.
  const glm::dvec3 middle = 0.5 * (low + high) - light.centre;
  const double radius = 0.5 * glm::length(high - low) + light.slack;
  const double along = glm::dot(middle, light.axis);
  const double beside = std::sqrt(std::max(glm::dot(middle, middle) - along * along, 0.0));
  return light.cosine * beside - light.sine * along <= radius && along >= -radius;
}

template <class Found>
bool Clusters::visit(const ClusterLight& light, Found&& found) const noexcept {
  const auto cluster = [&](int x, int y, int z) {
    return static_cast<std::uint32_t>(
        (static_cast<std::size_t>(z) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(y)) *
            static_cast<std::size_t>(columns_) +
        static_cast<std::size_t>(x));
  };
  if (light.everywhere) {
    for (std::uint32_t i = 0, end = cluster(0, 0, slices_.count); i < end; ++i)
      if (!found(i)) return false;
    return true;
  }
  // Nothing is seen nearer than the near plane. Rounding of depths, and of what lies on it:
  const double nearest = camera_.orthographic ? -kLargest : camera_.near_depth * (1.0 - kSurfaceSlack);
  const double begin = std::max(light.centre.z - light.range, nearest), end = light.centre.z + light.range;
  const double farthest = camera_.far_depth + kSurfaceSlack * std::abs(camera_.far_depth);
  if (!(light.range > 0.0 && end > begin && begin <= farthest)) return true;
  const bool one = slices_.count == 1 || slices_.scale == 0.0;
  const int first = one ? 0 : slices_.clamped(slices_.at(begin) - kSliceSlack);
  const int last = one ? 0 : slices_.clamped(slices_.at(end) + kSliceSlack);
  for (int z = first; z <= last; ++z) {
    const double from = z == 0 ? begin : std::max(begin, slices_.depth(z - kSliceSlack));
    const double to = one || z == slices_.count - 1 ? end : std::min(end, slices_.depth(z + 1 + kSliceSlack));
    const double away = light.centre.z - std::clamp(light.centre.z, from, std::max(from, to));
    const double wide = std::sqrt(std::max(light.range * light.range - away * away, 0.0));
    const Range x =
        tiles(light.centre.x - wide, light.centre.x + wide, from, to, camera_.left, step_.x, columns_);
    const Range y =
        tiles(light.centre.y - wide, light.centre.y + wide, from, to, camera_.bottom, step_.y, rows_);
    const glm::dvec2 scale = camera_.orthographic ? glm::dvec2(1.0) : glm::dvec2(from, to);
    for (int row = y.first; row <= y.last; ++row) {
      for (int column = x.first; column <= x.last; ++column) {
        const glm::dvec2 a{camera_.left + step_.x * column, camera_.bottom + step_.y * row}, b = a + step_;
        const glm::dvec2 low = glm::min(a * scale.x, a * scale.y), high = glm::max(b * scale.x, b * scale.y);
        if (reaches(light, {low, from}, {high, to}) && !found(cluster(column, row, z))) return false;
      }
    }
  }
  return true;
}

/// Sorts entries, which are in the order of lights, by cluster.
void fill_lists(std::span<const ClusterEntry> entries, std::size_t clusters,
                const ClusterMemory& memory) noexcept {
  const std::span<std::uint32_t> begin = memory.begin.first(clusters + 1);
  std::fill(begin.begin(), begin.end(), 0u);
  for (const ClusterEntry& entry : entries) ++begin[entry.cluster + 1];
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  for (const ClusterEntry& entry : entries) memory.lights[begin[entry.cluster]++] = entry.light;
  // Each list's begin has moved to its end.
  for (std::size_t i = clusters; i > 0; --i) begin[i] = begin[i - 1];
  begin[0] = 0;
}

bool usable_light(const Light& light) noexcept {
  if (const auto* spot = std::get_if<SpotLight>(&light)) {
    return usable(spot->position) && usable(spot->direction) && glm::length(spot->direction) > 0.0 &&
           spot->outer_radians > 0.0 && spot->outer_radians < 3.15 && usable(spot->range);
  }
  const auto* point = std::get_if<PointLight>(&light);
  return point == nullptr || (usable(point->position) && usable(point->range));
}

std::string_view invalid_input(const Camera& camera, std::span<const Light> lights,
                               const ClusterOptions& options, const ClusterMemory& memory) noexcept {
  const std::string_view field =
      first_invalid_field(camera, DirectionalLight{}, SceneBounds{}, PlanOptions{});
  if (!field.empty()) return field;
  if (camera.width > kMaxImageSide || camera.height > kMaxImageSide) return "camera.width, camera.height";
  if (options.tile_pixels < 1) return "clusters.tile_pixels";
  if (options.depth_slices < 1 || options.depth_slices > kMaxDepthSlices) return "clusters.depth_slices";
  if (lights.size() > std::numeric_limits<std::uint32_t>::max()) return "lights";
  if (!std::all_of(lights.begin(), lights.end(), usable_light)) return "light";
  if (memory.begin.size() < 2) return "memory.begin";
  if (memory.lights.size() < lights.size()) return "memory.lights";
  return memory.work.size() < lights.size() ? "memory.work" : std::string_view{};
}

/// Depth beyond which no local light reaches.
double deepest_of(const Camera& camera, std::span<const Light> lights, const CameraAxes& axes) noexcept {
  double deepest = camera.near_depth;
  for (const Light& light : lights) {
    const ClusterLight seen = in_view(light, camera, axes);
    if (!seen.everywhere) deepest = std::max(deepest, seen.centre.z + seen.range);
  }
  return deepest;
}

}  // namespace

std::size_t cluster_count(const Camera& camera, const ClusterOptions& options) noexcept {
  if (camera.width < 1 || camera.height < 1 || camera.width > kMaxImageSide || camera.height > kMaxImageSide)
    return 0;
  if (options.tile_pixels < 1 || options.depth_slices < 1 || options.depth_slices > kMaxDepthSlices) return 0;
  int tile = options.tile_pixels;
  while (count_of(camera, tile, options.depth_slices) > kMaxClusters) tile *= 2;
  return count_of(camera, tile, options.depth_slices);
}

LightClusters cluster_lights(const Camera& camera, std::span<const Light> lights,
                             const ClusterOptions& options, const ClusterMemory& memory) noexcept {
  LightClusters result;
  result.invalid_field = invalid_input(camera, lights, options, memory);
  if (!result.invalid_field.empty()) return result;
  const CameraAxes axes = camera_axes(camera);
  const double deepest = deepest_of(camera, lights, axes);
  const std::size_t capacity = std::min(memory.lights.size(), memory.work.size());
  int tile = std::min(options.tile_pixels, kMaxImageSide), slice_count = options.depth_slices;
  std::size_t entries = 0, count = 0;
  for (;; tile *= 2, slice_count = std::max(slice_count / 2, 1)) {
    count = count_of(camera, tile, slice_count);
    if (count > kMaxClusters || count + 1 > memory.begin.size()) continue;
    const Slices slices(camera, deepest, slice_count);
    const Clusters clusters(camera, slices, tile);
    entries = 0;
    bool fits = true;
    for (std::size_t i = 0; i < lights.size() && fits; ++i) {
      fits = clusters.visit(in_view(lights[i], camera, axes), [&](std::uint32_t cluster) {
        if (entries == capacity) return false;
        memory.work[entries++] = {cluster, static_cast<std::uint32_t>(i)};
        return true;
      });
    }
    if (!fits) continue;
    result.columns = clusters.columns();
    result.rows = clusters.rows();
    result.depth_scale = slices.scale;
    result.depth_offset = slices.offset;
    break;
  }
  fill_lists(memory.work.first(entries), count, memory);
  result.status = PlanStatus::ok;
  result.slices = slice_count;
  result.tile_pixels = tile;
  result.orthographic = camera.orthographic;
  result.begin = memory.begin.first(count + 1);
  result.lights = memory.lights.first(entries);
  return result;
}

std::size_t cluster_at(const LightClusters& clusters, int pixel_x, int pixel_y, double view_depth) noexcept {
  const auto at = [](double v, int count) {
    return static_cast<std::size_t>(std::clamp(v, 0.0, std::max(count - 1.0, 0.0)));
  };
  const double along = clusters.orthographic ? view_depth : std::log2(std::max(view_depth, 1e-300));
  const std::size_t slice =
      at(std::floor(clusters.depth_scale * along + clusters.depth_offset), clusters.slices);
  const std::size_t row = at(pixel_y / clusters.tile_pixels, clusters.rows);
  return (slice * static_cast<std::size_t>(clusters.rows) + row) *
             static_cast<std::size_t>(clusters.columns) +
         at(pixel_x / clusters.tile_pixels, clusters.columns);
}

}  // namespace gnomon
