// The axes along which a plan gets stiff.
#include "axes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace gnomon::stress {
namespace {

// Of the plain camera: 60 degrees up and down.
constexpr double kHalfFov = kPi / 6.0;

/// `count` values from low to high by equal factors, and `more`, ascending.
std::vector<double> by_factors(double low, double high, int count, std::vector<double> more = {}) {
  for (int i = 0; i < count; ++i)
    more.push_back(low * std::pow(high / low, count > 1 ? static_cast<double>(i) / (count - 1) : 0.0));
  std::sort(more.begin(), more.end());
  more.erase(std::unique(more.begin(), more.end()), more.end());
  return more;
}

/// 1 + 1e-12 ... 1e9, a third of them where near and far all but touch.
std::vector<double> depth_ratios(int samples) {
  std::vector<double> above = by_factors(1e-12, 0.5, samples / 3);
  for (double& v : above) v += 1.0;
  return by_factors(2.0, 1e9, samples - samples / 3, above);
}

/// Along the view, across the frustum's edge, overhead, against the view.
std::vector<double> light_angles(int samples) {
  std::vector<double> more{0.0, kHalfFov, 0.5 * kPi, kPi};
  for (double off = 1e-12; off < 0.1; off *= 1e3) {
    for (const double at : {kHalfFov, 0.5 * kPi, kPi}) {
      more.push_back(at * (1.0 - off));
      if (at < kPi) more.push_back(at * (1.0 + off));
    }
  }
  return by_factors(1e-12, 3.0, samples, more);
}

std::vector<double> fields_of_view(int samples) {
  return by_factors(0.01, 179.0, samples, {90.0, 150.0, 170.0, 175.0, 178.0});
}
std::vector<double> extents(int samples) {
  return by_factors(1e-6, 1e9, samples);
}
std::vector<double> distances(int samples) {
  return by_factors(1e-3, 1e9, samples, {0.0});
}
std::vector<double> aspects(int samples) {
  return by_factors(1.0 / 50.0, 50.0, samples);
}
std::vector<double> thicknesses(int samples) {
  return by_factors(1e-18, 1.0, samples, {0.0});
}
std::vector<double> gaps(int samples) {
  std::vector<double> more{0.0};
  for (int i = 0; i < samples / 2; ++i) {
    const double size = std::pow(10.0, -15.0 + 16.0 * i / std::max(1, samples / 2 - 1));
    more.push_back(size);
    more.push_back(-size);
  }
  std::sort(more.begin(), more.end());
  return more;
}
std::vector<double> cones(int samples) {
  return by_factors(1e-6, 359.0, samples, {0.0, 90.0, 169.9, 170.0, 170.1, 180.0, 270.0, 359.999999, 360.0});
}
std::vector<double> cascade_counts(int) {
  std::vector<double> all;
  for (int i = 0; i <= kMaxMaps + 1; ++i) all.push_back(i);
  return all;
}
std::vector<double> map_sizes(int) {
  std::vector<double> all{3, 5, 7, 1000, kMaxMapSize + 1};
  for (int size = 1; size <= kMaxMapSize; size *= 2) all.push_back(size);
  std::sort(all.begin(), all.end());
  return all;
}
std::vector<double> filter_radii(int samples) {
  return by_factors(1e-3, 256.0, samples, {0.0});
}

void apply_depth_ratio(double ratio, double, Input& input) {
  input.camera.near_depth = input.camera.far_depth / ratio;
}
void apply_light_angle(double angle, double turn, Input& input) {
  const glm::dvec3 forward = glm::normalize(input.camera.forward);
  // Through a half angle: 1 - cos would be rounded away at small ones.
  const glm::dvec3 aside = across(forward, 2.0 * kPi * turn);
  input.light = DirectionalLight{forward * std::cos(angle) + aside * std::sin(angle)};
}
void apply_field_of_view(double degrees, double, Input& input) {
  Camera& c = input.camera;
  c = perspective_camera(c.position, c.forward, c.up, degrees * kPi / 180.0, 16.0 / 9.0, c.near_depth,
                         c.far_depth, c.width, c.height);
}
void scale_box(Box& box, double scale) {
  box.min *= scale;
  box.max *= scale;
}
void apply_scale(double scale, double, Input& input) {
  input.camera.position *= scale;
  input.camera.near_depth *= scale;
  input.camera.far_depth *= scale;
  for (Box& box : input.receivers) scale_box(box, scale);
  for (Box& box : input.casters) scale_box(box, scale);
}
/// The camera stays as it is, ten units before the scene's middle.
void apply_extent(double extent, double turn, Input& input) {
  const glm::dvec3 centre = input.camera.position + glm::normalize(input.camera.forward) * 10.0;
  const glm::dvec3 half{0.5 * extent, 0.1 * extent, (0.3 + 0.2 * turn) * extent};
  input.receivers = {{centre - half, centre + half}};
  input.casters = input.receivers;
}
void apply_distance(double distance, double turn, Input& input) {
  const double a = 0.6 + 6.0 * turn;
  const glm::dvec3 away = glm::dvec3(std::cos(a), 0.31, std::sin(a)) * distance;
  input.camera.position += away;
  for (Box& box : input.receivers) box = {box.min + away, box.max + away};
  for (Box& box : input.casters) box = {box.min + away, box.max + away};
}
void apply_aspect(double aspect, double, Input& input) {
  Camera& c = input.camera;
  c.right = c.top * aspect;
  c.left = -c.right;
  c.width = std::max(1, static_cast<int>(c.height * std::min(aspect, 8.0)));
  if (aspect < 1.0) c.width = std::max(1, static_cast<int>(c.height * aspect));
}
/// A plate, a bar or a grain, and a plate above that shades it.
void apply_thickness(double thickness, double turn, Input& input) {
  const glm::dvec3 centre = input.camera.position + glm::normalize(input.camera.forward) * 20.0;
  const int thin = 1 + static_cast<int>(3.0 * turn);
  glm::dvec3 half(10.0);
  for (int i = 0; i < thin; ++i) half[(i + 1) % 3] *= thickness;
  input.receivers = {{centre - half, centre + half}};
  input.casters = input.receivers;
  input.casters.push_back({centre + glm::dvec3(-30, 12, -30), centre + glm::dvec3(30, 12, 30)});
}
/// Two boxes side by side: apart, touching, overlapping; and a third as thick as the gap, inside-out below 0.
void apply_gap(double gap, double turn, Input& input) {
  const glm::dvec3 centre = input.camera.position + glm::normalize(input.camera.forward) * 20.0;
  const Box left{centre - glm::dvec3(8, 2, 5), centre + glm::dvec3(0, 2, 5)};
  const Box right{{left.max.x + gap, left.min.y, left.min.z}, centre + glm::dvec3(12, 2.0 + turn, 5)};
  const Box slab{{left.min.x, left.max.y, left.min.z}, {left.max.x, left.max.y + gap, left.max.z}};
  const Box nested{left.min + glm::dvec3(1.0), left.max - glm::dvec3(1.0)};
  input.receivers = {left, right, slab, nested};
  input.casters = input.receivers;
}
void apply_cone(double degrees, double turn, Input& input) {
  const glm::dvec3 ahead = input.camera.position + glm::normalize(input.camera.forward) * 15.0;
  const glm::dvec3 position = ahead + glm::dvec3(3.0 - 6.0 * turn, 9.0, 2.0);
  const glm::dvec3 down = glm::normalize(ahead - position);
  input.light = SpotLight{position, down, 0.5 * degrees * kPi / 180.0, 100.0};
  input.casters.push_back({ahead + glm::dvec3(-2, 3, -2), ahead + glm::dvec3(2, 4, 2)});
}
void apply_cascades(double count, double, Input& input) {
  input.options.cascades = static_cast<int>(count);
}
void apply_map_size(double size, double, Input& input) {
  input.options.resolution.max_size = static_cast<int>(size);
  input.options.filter.texels = std::min(1.0, 0.25 * size);
}
void apply_filter_radius(double radius, double, Input& input) {
  input.options.filter.texels = radius;
}

constexpr Axis kAxes[] = {
    {"depth_ratio", "far over near", true, depth_ratios, apply_depth_ratio},
    {"light_angle", "angle between light and view, radians (the frustum's edge is at 0.524)", true,
     light_angles, apply_light_angle},
    {"fov", "field of view, degrees", true, fields_of_view, apply_field_of_view},
    {"scale", "size of the world, camera and all", true, extents, apply_scale},
    {"extent", "extent of a scene 10 units away, units", true, extents, apply_extent},
    {"distance", "distance of everything from the origin, units", true, distances, apply_distance},
    {"aspect", "width over height of the image", true, aspects, apply_aspect},
    {"thickness", "thickness of a plate, a bar, a grain over its length", true, thicknesses, apply_thickness},
    {"gap", "gap between boxes, below 0 overlapping and inside-out, units", false, gaps, apply_gap},
    {"cone", "cone of a spot, degrees", true, cones, apply_cone},
    {"cascades", "maps along the view", false, cascade_counts, apply_cascades},
    {"map_size", "texels along a side of a map", true, map_sizes, apply_map_size},
    {"filter_radius", "radius of the filter, texels of 1024", true, filter_radii, apply_filter_radius},
};

constexpr Variant kVariants[] = {
    {"none", [](PlanOptions& o) { o.warp.warp = &warps::none; }},
    {"lispsm", [](PlanOptions& o) { o.warp.warp = &warps::lispsm; }},
    {"optimal", [](PlanOptions& o) { o.warp.warp = &warps::optimal; }},
    {"optimal x4", [](PlanOptions& o) { o.cascades = 4; }},
    {"stable x4",
     [](PlanOptions& o) {
       o.fit = Fit::stable;
       o.cascades = 4;
     }},
};

}  // namespace

std::span<const Axis> all_axes() noexcept {
  return kAxes;
}

const Axis* find_axis(std::string_view name) noexcept {
  for (const Axis& axis : kAxes) {
    if (axis.name == name) return &axis;
  }
  return nullptr;
}

std::span<const Variant> all_variants() noexcept {
  return kVariants;
}

}  // namespace gnomon::stress
