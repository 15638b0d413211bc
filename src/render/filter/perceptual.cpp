// The filter-size study's rule, for kernels in pixels, texels and world units.
// Based on: a viewers' study of the filter sizes that hide shadow-map artifacts (radius 3.47 times their
// size).
#include "gnomon/render/perceptual.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/measure.hpp"

namespace gnomon::render {
namespace {

/// Not-a-number becomes 0.
double at_least_zero(double value) noexcept {
  return value > 0.0 ? value : 0.0;
}

/// Across the view.
double pixels_per_world(const Camera& camera, double view_depth) noexcept {
  const double per_edge =
      std::max(camera.width / (camera.right - camera.left), camera.height / (camera.top - camera.bottom));
  return camera.orthographic ? per_edge : per_edge / std::max(view_depth, camera.near_depth);
}

/// At the least depth that any map serves.
double most_pixels_per_world(const ShadowPlan& plan, const Camera& camera) noexcept {
  double depth = camera.far_depth;
  for (const ShadowMap& map : plan.maps()) depth = std::min(depth, map.depth_begin);
  return pixels_per_world(camera, depth);
}

/// Texels along a side that make the plan's longest texel this long, world units.
double side_for(const ShadowPlan& plan, double texel_world) noexcept {
  double side = 0.0;
  for (const ShadowMap& map : plan.maps()) {
    side = std::max({side, map.width * map.texel_world_max.x / texel_world,
                     map.height * map.texel_world_max.y / texel_world});
  }
  return side;
}

}  // namespace

double hiding_radius_pixels(double texel_pixels) noexcept {
  return kHidingRadius * at_least_zero(texel_pixels);
}

double hidden_texel_pixels(double radius_pixels) noexcept {
  return at_least_zero(radius_pixels) / kHidingRadius;
}

bool is_kernel_in_world(const FilterSettings& settings) noexcept {
  return settings.filter != nullptr && settings.filter->info.has_kernel &&
         (settings.unit == KernelUnit::world || settings.filter->info.penumbra_radius_world != nullptr);
}

double kernel_radius_world(const FilterSettings& settings, const ShadowDistances& distances) noexcept {
  if (!is_kernel_in_world(settings)) return 0.0;
  const bool in_world = settings.unit == KernelUnit::world;
  const auto penumbra = settings.filter->info.penumbra_radius_world;
  if (penumbra == nullptr) return at_least_zero(settings.radius);
  const double radius = at_least_zero(
      penumbra(settings, at_least_zero(distances.blocker_world), at_least_zero(distances.light_world)));
  return in_world ? std::min(radius, at_least_zero(settings.radius)) : radius;
}

HidingMapSize hiding_map_size(const ShadowPlan& plan, const Camera& camera, const FilterSettings& settings,
                              const ShadowDistances& distances) noexcept {
  HidingMapSize result;
  if (plan.map_count == 0) return {.map_size = kLeastMapSize, .hides = true};
  if (settings.filter == nullptr || !settings.filter->info.has_kernel) return result;
  if (is_kernel_in_world(settings)) {
    result.radius_world = kernel_radius_world(settings, distances);
    result.radius_pixels = result.radius_world * most_pixels_per_world(plan, camera);
  }
  // The kernel is a box of this half side, or no wider than that.
  const double widest_texels = settings.radius + 0.5;
  if (settings.unit == KernelUnit::texels && !(widest_texels >= kHidingRadius)) return result;
  if (!is_kernel_in_world(settings)) return {.map_size = kLeastMapSize, .hides = true};

  constexpr double kRounding = 1e-9;  // a texel of just the right size takes no larger map
  const double side = side_for(plan, result.radius_world / kHidingRadius) * (1.0 - kRounding);
  result.hides = side <= kMaxMapSize;  // false for not-a-number
  if (result.hides) result.map_size = std::max(kLeastMapSize, static_cast<int>(std::ceil(side)));
  return result;
}

HidingMapSize hiding_map_size(const ShadowPlan& plan, const Camera& camera, const FilterSettings& settings,
                              const ShadowDistances& distances,
                              std::span<const glm::dvec3> visible_world) noexcept {
  HidingMapSize result = hiding_map_size(plan, camera, settings, distances);
  if (plan.map_count == 0 || !is_kernel_in_world(settings) || !(result.radius_world > 0.0)) return result;
  constexpr double kPixel = 1.0;  // artifacts of at most a pixel are none
  double side = 0.0;
  result.radius_pixels = 0.0;
  const glm::dvec3 forward = glm::normalize(camera.forward);
  for (const glm::dvec3& point : visible_world) {
    const double view_depth = glm::dot(point - camera.position, forward);
    const int serving = map_serving(plan, point, view_depth);
    if (serving < 0) continue;
    const ShadowMap& map = plan.map[static_cast<std::size_t>(serving)];
    // On the surface that faces the half vector, lengths across the light and across the eye's ray are seen
    // alike: texel and kernel compare there.
    const PointAliasing texel = measure_perspective(map, camera, point);
    if (texel.status != PointAliasing::Status::ok) continue;
    const double radius_pixels = result.radius_world * pixels_per_world(camera, view_depth);
    result.radius_pixels = std::max(result.radius_pixels, radius_pixels);
    const double hidden = std::max(hidden_texel_pixels(radius_pixels), kPixel);
    side = std::max(side, std::max(map.width, map.height) * texel.perspective_max / hidden);
  }
  result.hides = side <= kMaxMapSize;
  result.map_size = result.hides ? std::max(kLeastMapSize, static_cast<int>(std::ceil(side))) : kMaxMapSize;
  return result;
}

}  // namespace gnomon::render
