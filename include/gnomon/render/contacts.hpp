// How much light does a filter leave close behind a caster, and how far behind it?
#pragma once

#include "gnomon/render/filter.hpp"

namespace gnomon::render {

/// The light that is left behind a flat occluder that fills the kernel, by the filter's formulas and what its
/// format rounds: 0 .. 1. `occluder`: its depth, 0..1; `behind`: from it to the receiver, as a share of the
/// map's depth range. The options are taken as they are (settings_for_map).
[[nodiscard]] double light_behind(const FilterSettings& settings, double occluder, double behind);

/// How far behind a caster more than a twentieth of the light is left in a map, world units. 0 for filters
/// that compare depths, and where the map's range is unknown: they leak by the bias alone.
[[nodiscard]] double contact_reach_world(const FilterSettings& settings, const MapDepths& depths);

}  // namespace gnomon::render
