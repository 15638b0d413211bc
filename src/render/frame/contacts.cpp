// Leaks at contacts, from the reference formulas of any filter.
#include "gnomon/render/contacts.hpp"

#include <cmath>

namespace gnomon::render {

double light_behind(const FilterSettings& settings, double occluder, double behind) {
  const FilterReference& reference = settings.filter->reference;
  FilterLookup lookup;
  lookup.map_depth = [occluder](int, int) { return occluder; };
  lookup.depth_max = occluder;
  lookup.position = {8.5, 8.5};
  lookup.depth = occluder + behind;
  lookup.box = glm::dvec2(settings.radius + 0.5);
  lookup.disc = glm::dmat2(settings.radius + 0.5);
  StoredTexel texel{};
  if (reference.store != nullptr) {
    texel = reference.store(occluder, glm::dvec2(0.0), settings);
    for (double& channel : texel) channel = rounded_to(settings.format, channel);
    if (reference.pack != nullptr) {
      StoredTexel read = reference.nothing(settings);
      reference.join(read, texel, 1.0, settings);
      texel = read;
    }
  }
  return reference.visibility(texel, lookup, settings);
}

double contact_reach_world(const FilterSettings& settings, const MapDepths& depths) {
  constexpr double kLittle = 0.05, kOccluder = 0.5, kLeast = 1e-5, kMost = 0.5;
  if (!(depths.range_world > 0.0)) return 0.0;
  const FilterSettings fitted = settings_for_map(settings, depths);
  const auto leaks = [&](double behind) { return light_behind(fitted, kOccluder, behind) > kLittle; };
  if (!leaks(kLeast)) return 0.0;
  // Light falls with the distance: halve the interval, of which ratios count.
  double low = kLeast, high = kMost;
  constexpr int kHalvings = 12;  // to a percent or so
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(low * high);
    (leaks(middle) ? low : high) = middle;
  }
  return high * depths.range_world;
}

}  // namespace gnomon::render
