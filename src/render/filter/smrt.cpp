// Shadow-map ray tracing: soft shadows by several rays a pixel, marched through the depth map towards the
// light. Based on: Epic Games, "Virtual Shadow Maps", Unreal Engine 5 documentation, 2021: shadow map ray
// tracing.
//
// The map's front faces are a height field. A ray is cut into stretches that get longer towards the light;
// each reads one texel, and what that stores blocks where it lies in the stretch, or up to the thickness
// beyond. A thin caster is so met by one stretch, whatever the ray: its penumbra has the width that the
// light's size gives it.
#include <numbers>

#include "filter_parts.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    {"angle_deg", 2.0, 0.01, 60.0, "apparent diameter of a directional light, degrees; the sun has 0.53"},
    {"light_radius", 0.25, 1e-6, 1e6, "radius of a local light, world units"},
    {"rays", 8, 1, 64, "rays to the light: more have less noise, at their price"},
    {"steps", 8, 1, 64, "texels read along a ray: more keep thin casters apart, at their price"},
    {"thickness", 0.0, 0.0, 1e6,
     "depth of casters behind what the map stores, world units: less leaks, darker"},
    {"rotate", 1, 0, 1, "1 turns and shifts the rays per pixel: noise instead of banding; 0 does not"},
};

double penumbra_radius(const FilterSettings& settings, double away, double light_distance) noexcept {
  if (light_distance == 0.0) return std::tan(0.5 * settings.option[0] * std::numbers::pi / 180.0) * away;
  return settings.option[1] * away / std::max(light_distance - away, 0.01 * light_distance);
}

glm::dvec2 within_kernel(const FilterLookup& lookup, const glm::dvec2& offset) noexcept {
  const glm::dmat2& disc = lookup.disc;
  const double widest =
      std::max(std::sqrt(std::max(glm::dot(disc[0], disc[0]), glm::dot(disc[1], disc[1]))), 1.0);
  return offset * std::min(1.0, widest / std::max(glm::length(offset), 1e-6));
}

bool is_blocked(const FilterLookup& lookup, const FilterSettings& settings, const glm::dvec2& aim,
                double inside) {
  const int steps = static_cast<int>(settings.option[3]);
  const double reach = std::max(distance_to_depth(lookup, 0.0), 0.0);
  for (int k = 0; k < steps; ++k) {
    const double from = static_cast<double>(k) / steps, to = static_cast<double>(k + 1) / steps;
    const double begin = reach * from * from, end = reach * to * to;
    const double spread = penumbra_radius(settings, begin + inside * (end - begin), lookup.light_distance);
    const glm::dvec2 texel =
        lookup.position + within_kernel(lookup, lookup.texels_per_world * (spread * aim));
    const glm::dvec2 cell{std::floor(texel.x), std::floor(texel.y)};
    const double stored = lookup.map_depth(static_cast<int>(cell.x), static_cast<int>(cell.y));
    if (plane_depth(lookup, cell + 0.5 - lookup.position) <= stored) continue;
    const double caster = distance_to_depth(lookup, stored);
    if (k > 0 && caster < begin) continue;
    if (k + 1 < steps && caster >= end + settings.option[4]) continue;
    return true;
  }
  return false;
}

double visibility(const StoredTexel&, const FilterLookup& lookup, const FilterSettings& settings) {
  const int rays = static_cast<int>(settings.option[2]);
  const double turn = settings.option[5] > 0.5 ? lookup.rotation : 0.0;
  int blocked = 0;
  for (int i = 0; i < rays; ++i) {
    const double shift = turn * 0.15915494 + 0.5 + 0.41421356 * i;
    blocked += is_blocked(lookup, settings, vogel_point(i, rays, turn), shift - std::floor(shift)) ? 1 : 0;
  }
  return 1.0 - static_cast<double>(blocked) / rays;
}

/// Whole rays and steps.
void settle(FilterSettings& settings) noexcept {
  for (const std::size_t i : {2, 3, 5}) settings.option[i] = std::round(settings.option[i]);
}

}  // namespace

const Filter filters::smrt{
    .info =
        {
            .name = "smrt",
            .summary = "soft shadows by rays through the depth map: penumbras of the light's own width",
            .source = "Epic Games 2021, Virtual shadow maps: shadow map ray tracing",
            .reads = MapRead::depth,
            .bias_class = FilterClass::blocker_search,
            .options = kOptions,
            .default_radius = 12.0,
            .lookup_reach_texels = 1.5,
            .settle = settle,
            .penumbra_radius_world = penumbra_radius,
        },
    .reference =
        {
            .visibility = visibility,
        },
};

}  // namespace gnomon::render
