// Shadow-map ray tracing: soft shadows by several rays a pixel, marched through the depth map towards the
// light. Based on: Epic Games, "Virtual Shadow Maps", Unreal Engine 5 documentation, 2021: shadow map ray
// tracing.
//
// The map's front faces are a height field. A first search finds between which distances casters stand, or
// that there are none. A ray is cut into stretches there; each reads one texel, and what that stores blocks
// where it lies in the stretch. A ray that leaves the underside of one caster for the upper side of another
// went through what joins them: a wall that the light grazes.
#include "filter/filter_parts.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    kLightAngle,
    kLightRadius,
    {"rays", 16, 1, 64, "rays to the light: more have less noise, at their price"},
    {"steps", 4, 1, 64, "texels read along a ray: more keep thin casters apart, at their price"},
    {"rotate", 1, 0, 1, "1 turns and shifts the rays per pixel: noise instead of banding; 0 does not"},
};

glm::dvec2 within_kernel(const FilterLookup& lookup, const glm::dvec2& offset) noexcept {
  const glm::dmat2& disc = lookup.disc;
  const double widest =
      std::max(std::sqrt(std::max(glm::dot(disc[0], disc[0]), glm::dot(disc[1], disc[1]))), 1.0);
  return offset * std::min(1.0, widest / std::max(glm::length(offset), 1e-6));
}

/// Distance to what the texel under the offset stores; below 0 where that does not stand before the
/// receiver's plane.
double caster_at(const FilterLookup& lookup, const glm::dvec2& offset) {
  const glm::dvec2 texel = lookup.position + within_kernel(lookup, offset);
  const glm::dvec2 cell{std::floor(texel.x), std::floor(texel.y)};
  const double stored = lookup.map_depth(static_cast<int>(cell.x), static_cast<int>(cell.y));
  if (plane_depth(lookup, cell + 0.5 - lookup.position) <= stored) return -1.0;
  return std::max(distance_to_depth(lookup, stored), 0.0);
}

/// Distances between which casters were found.
struct Casters {
  double nearest, farthest;
};

bool is_blocked(const FilterLookup& lookup, const FilterSettings& settings, const Casters& casters,
                const glm::dvec2& aim, double inside) {
  const int steps = static_cast<int>(settings.option[3]);
  bool under = false;
  for (int k = 0; k < steps; ++k) {
    const auto place = [&](int step) {
      return std::lerp(casters.nearest, casters.farthest, static_cast<double>(step) / std::max(steps - 1, 1));
    };
    // The first stretch ends at the nearest caster found, the last has no end.
    const double begin = k == 0 ? 0.0 : place(k - 1);
    const double end = k == 0 && steps > 1 ? casters.nearest : place(k);
    const double away = std::lerp(begin, end, inside);
    const double caster = caster_at(
        lookup, lookup.texels_per_world * (penumbra_radius(settings, away, lookup.light_distance) * aim));
    const bool beyond = k + 1 < steps && caster >= end, before = caster < begin;
    // From under one caster to above another: through what joins them.
    const bool crossed = under && before && caster >= 0.0;
    under = beyond;
    if ((!beyond && !before) || crossed) return true;
  }
  return false;
}

double visibility(const StoredTexel&, const FilterLookup& lookup, const FilterSettings& settings) {
  const int rays = static_cast<int>(settings.option[2]);
  const double turn = settings.option[4] > 0.5 ? lookup.rotation : 0.0;
  // Most points have no caster at all, and casters lie at a few distances.
  constexpr int kSearched = 16;
  const double reach = std::max(distance_to_depth(lookup, 0.0), 0.0);
  const double search = penumbra_radius(settings, reach, lookup.light_distance);
  Casters casters{reach, 0.0};
  bool any = false;
  for (int i = 0; i < kSearched; ++i) {
    const double caster =
        caster_at(lookup, lookup.texels_per_world * (search * vogel_point(i, kSearched, turn)));
    if (caster < 0.0) continue;
    any = true;
    casters = {std::min(casters.nearest, caster), std::max(casters.farthest, caster)};
  }
  if (!any) return 1.0;
  int blocked = 0;
  for (int i = 0; i < rays; ++i) {
    const double shift = turn * 0.15915494 + 0.5 + 0.41421356 * i;
    const double inside = shift - std::floor(shift);
    blocked += is_blocked(lookup, settings, casters, vogel_point(i, rays, turn), inside) ? 1 : 0;
  }
  return 1.0 - static_cast<double>(blocked) / rays;
}

/// Whole rays and steps.
void settle(FilterSettings& settings) noexcept {
  for (const std::size_t i : {2, 3, 4}) settings.option[i] = std::round(settings.option[i]);
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
