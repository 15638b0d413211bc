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
    kLightAngle,
    kLightRadius,
    {"search_samples", 16, 1, 64, "depths read by the blocker search"},
    {"samples", 32, 1, 64, "samples of the kernel, four comparisons each"},
    {"rotate", 1, 0, 1, "1 rotates the samples per pixel: noise instead of banding; 0 does not"},
};

double widest_column(const glm::dmat2& m) noexcept {
  return std::sqrt(std::max(glm::dot(m[0], m[0]), glm::dot(m[1], m[1])));
}

glm::dmat2 disc_of(const FilterLookup& lookup, double radius_world) noexcept {
  const glm::dmat2 disc = radius_world * lookup.texels_per_world;
  const double width = widest_column(disc);
  if (width < 1.0) return width > 0.0 ? disc / width : glm::dmat2(1.0);
  return disc * std::min(1.0, std::max(widest_column(lookup.disc), 1.0) / width);
}

double visibility(const StoredTexel&, const FilterLookup& lookup, const FilterSettings& settings) {
  const int search_samples = static_cast<int>(settings.option[2]),
            samples = static_cast<int>(settings.option[3]);
  const double angle = settings.option[4] > 0.5 ? lookup.rotation : 0.0;
  const glm::dmat2 search = disc_of(
      lookup,
      penumbra_radius(settings, std::max(distance_to_depth(lookup, 0.0), 0.0), lookup.light_distance));
  double sum = 0.0;
  int blockers = 0;
  for (int i = 0; i < search_samples; ++i) {
    const glm::dvec2 texel = lookup.position + search * vogel_point(i, search_samples, angle);
    const glm::dvec2 cell{std::floor(texel.x), std::floor(texel.y)};
    const double stored = lookup.map_depth(static_cast<int>(cell.x), static_cast<int>(cell.y));
    if (plane_depth(lookup, cell + 0.5 - lookup.position) <= stored) continue;
    sum += std::max(distance_to_depth(lookup, stored), 0.0);
    ++blockers;
  }
  if (blockers == 0) return 1.0;
  const glm::dmat2 disc = disc_of(lookup, penumbra_radius(settings, sum / blockers, lookup.light_distance));
  double lit = 0.0;
  for (int i = 0; i < samples; ++i) {
    lit += compare_2x2(lookup, lookup.position + disc * vogel_point(i, samples, angle));
  }
  return lit / samples;
}

/// Whole samples.
void settle(FilterSettings& settings) noexcept {
  for (std::size_t i = 2; i < 5; ++i) settings.option[i] = std::round(settings.option[i]);
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
            .settle = settle,
            .penumbra_radius_world = penumbra_radius,
        },
    .reference =
        {
            .visibility = visibility,
        },
};

}  // namespace gnomon::render
