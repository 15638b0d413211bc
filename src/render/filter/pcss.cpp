// Percentage-closer soft shadows: penumbras that widen with the distance between blocker and receiver.
// Based on: Fernando, "Percentage-Closer Soft Shadows", 2005.
//
// The light's size is an angle for parallel light and a radius for lights with a position. Distances are
// taken along the light in world units and turned back into texels by the map's derivatives at the point, so
// that cascades and warps have the same penumbra. FilterSettings::radius is the widest kernel.
#include "filter/filter_parts.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    option::angle_deg,
    option::light_radius,
    {"search_samples", 16, 1, 64, "depths read by the blocker search", true},
    {"samples", 32, 1, 64, "samples of the kernel, four comparisons each", true},
    {"rotate", 1, 0, 1, "1 rotates the samples per pixel: noise instead of banding; 0 does not", true},
};
constexpr OptionPlaces kPlace(kOptions);

glm::dmat2 disc_of(const FilterLookup& lookup, double radius_world) noexcept {
  const glm::dmat2 disc = radius_world * lookup.texels_per_world;
  const double width = widest_axis(disc);
  if (width < 1.0) return width > 0.0 ? disc / width : glm::dmat2(1.0);
  return disc * std::min(1.0, std::max(widest_axis(lookup.disc), 1.0) / width);
}

double visibility(const StoredTexel&, const FilterLookup& lookup, const FilterSettings& settings) {
  const int search_samples = static_cast<int>(settings.option[kPlace("search_samples")]),
            samples = static_cast<int>(settings.option[kPlace("samples")]);
  const double angle = settings.option[kPlace("rotate")] > 0.5 ? lookup.rotation : 0.0;
  const glm::dmat2 search =
      disc_of(lookup, penumbra_radius<kPlace>(settings, std::max(distance_to_depth(lookup, 0.0), 0.0),
                                              lookup.light_distance));
  double sum = 0.0;
  int blockers = 0;
  for (int i = 0; i < search_samples; ++i) {
    const double blocker = caster_at(lookup, search * vogel_point(i, search_samples, angle));
    if (blocker < 0.0) continue;
    sum += blocker;
    ++blockers;
  }
  if (blockers == 0) return 1.0;
  const glm::dmat2 disc =
      disc_of(lookup, penumbra_radius<kPlace>(settings, sum / blockers, lookup.light_distance));
  double lit = 0.0;
  for (int i = 0; i < samples; ++i) {
    lit += compare_2x2(lookup, lookup.position + disc * vogel_point(i, samples, angle));
  }
  return lit / samples;
}

}  // namespace

const Filter filters::pcss{
    .info =
        {
            .name = "pcss",
            .summary = "contact-hardening soft shadows: penumbras widen with the blocker's distance",
            .source = "Fernando 2005, Percentage-closer soft shadows",
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
