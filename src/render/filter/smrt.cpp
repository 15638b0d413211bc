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
    option::angle_deg,
    option::light_radius,
    {"rays", 16, 1, 64, "rays to the light: more have less noise, at their price", true},
    {"steps", 4, 1, 64, "texels read along a ray: more keep thin casters apart, at their price", true},
    {"rotate", 1, 0, 1, "1 turns and shifts the rays per pixel: noise instead of banding; 0 does not", true},
};
constexpr OptionPlaces kPlace(kOptions);

glm::dvec2 within_kernel(const FilterLookup& lookup, const glm::dvec2& offset) noexcept {
  const double widest = std::max(widest_axis(lookup.disc), 1.0);
  return offset * std::min(1.0, widest / std::max(glm::length(offset), 1e-6));
}

/// Distances between which casters were found.
struct Casters {
  double nearest, farthest;
};

bool is_blocked(const FilterLookup& lookup, const FilterSettings& settings, const Casters& casters,
                const glm::dvec2& aim, double inside) {
  const int steps = static_cast<int>(settings.option[kPlace("steps")]);
  bool under = false;
  for (int k = 0; k < steps; ++k) {
    const auto place = [&](int step) {
      return std::lerp(casters.nearest, casters.farthest, static_cast<double>(step) / std::max(steps - 1, 1));
    };
    // The first stretch ends at the nearest caster found, the last has no end.
    const double begin = k == 0 ? 0.0 : place(k - 1);
    const double end = k == 0 && steps > 1 ? casters.nearest : place(k);
    const double away = std::lerp(begin, end, inside);
    const double radius = penumbra_radius<kPlace>(settings, away, lookup.light_distance);
    const double caster = caster_at(lookup, within_kernel(lookup, lookup.texels_per_world * (radius * aim)));
    const bool beyond = k + 1 < steps && caster >= end, before = caster < begin;
    // From under one caster to above another: through what joins them.
    const bool crossed = under && before && caster >= 0.0;
    under = beyond;
    if ((!beyond && !before) || crossed) return true;
  }
  return false;
}

double visibility(const StoredTexel&, const FilterLookup& lookup, const FilterSettings& settings) {
  const int rays = static_cast<int>(settings.option[kPlace("rays")]);
  const double turn = settings.option[kPlace("rotate")] > 0.5 ? lookup.rotation : 0.0;
  // Most points have no caster at all, and casters lie at a few distances.
  constexpr int kSearched = 16;
  const double reach = std::max(distance_to_depth(lookup, 0.0), 0.0);
  const double search = penumbra_radius<kPlace>(settings, reach, lookup.light_distance);
  Casters casters{reach, 0.0};
  bool any = false;
  for (int i = 0; i < kSearched; ++i) {
    const glm::dvec2 offset = lookup.texels_per_world * (search * vogel_point(i, kSearched, turn));
    const double caster = caster_at(lookup, within_kernel(lookup, offset));
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
            .penumbra_radius_world = penumbra_radius<kPlace>,
        },
    .reference =
        {
            .visibility = visibility,
        },
};

}  // namespace gnomon::render
