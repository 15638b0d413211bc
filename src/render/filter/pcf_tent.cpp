// Percentage-closer filtering with a tent in place of a box: smoother edges from nearly as many texels.
// Based on: Reeves, Salesin, Cook, "Rendering Antialiased Shadows with Depth Maps", 1987; few weighted
// bilinear comparisons for 3, 5, 7 a side: Castaño, "Shadow Mapping Summary", 2013 (The Witness). The weights
// here are those of a tent at the texels' centres: 3 a side has his weights, 5 and 7 a side are smoother.
#include <numbers>

#include "filter/filter_parts.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    option::footprint,
};
/// `in_world`: 1 where the radius is in world units. Set by settle(), for a lookup has no unit.
constexpr std::string_view kOwnOptions[] = {"in_world"};
constexpr OptionPlaces kPlace(kOptions, kOwnOptions);

glm::dvec2 half_base(const FilterLookup& lookup, const FilterSettings& settings) noexcept {
  const glm::dvec2 base =
      settings.option[kPlace("in_world")] > 0.5 ? std::numbers::sqrt2 * lookup.box : lookup.box + 0.5;
  // Of equal variance with the pixel where the kernel is narrower.
  return glm::max(glm::max(base, 1.0), std::numbers::sqrt2 * lookup.pixel);
}

/// The first texel whose centre lies within `half_base` of the point, and the one behind the last.
struct Span {
  int first, end;
};
Span span_of(double at, double half_base) noexcept {
  return {static_cast<int>(std::floor(at - half_base + 0.5)),
          static_cast<int>(std::ceil(at + half_base - 0.5))};
}

double visibility(const StoredTexel&, const FilterLookup& lookup, const FilterSettings& settings) {
  const glm::dvec2 base = half_base(lookup, settings);
  const Span columns = span_of(lookup.position.x, base.x), rows = span_of(lookup.position.y, base.y);
  double sum = 0.0, weights = 0.0;
  for (int y = rows.first; y < rows.end; ++y) {
    for (int x = columns.first; x < columns.end; ++x) {
      const glm::dvec2 offset = glm::dvec2(x + 0.5, y + 0.5) - lookup.position;
      const double weight =
          std::max(base.x - std::abs(offset.x), 0.0) * std::max(base.y - std::abs(offset.y), 0.0);
      weights += weight;
      if (plane_depth(lookup, offset) <= lookup.map_depth(x, y)) sum += weight;
    }
  }
  return weights > 0.0 ? sum / weights : 1.0;
}

void settle(FilterSettings& settings) noexcept {
  settings.option[kPlace("in_world")] = settings.unit == KernelUnit::world ? 1.0 : 0.0;
}

}  // namespace

const Filter filters::pcf_tent{
    .info =
        {
            .name = "pcf_tent",
            .summary = "soft edges without steps: a tent over 3, 5 or 7 bilinear taps a side",
            .source = "Castaño 2013, Shadow mapping summary (The Witness), after Reeves, Salesin, Cook 1987",
            .reads = MapRead::depth,
            .bias_class = FilterClass::wide_kernel,
            .options = kOptions,
            .own_options = kOwnOptions,
            .lookup_reach_texels = 1.5,
            .settle = settle,
        },
    .reference =
        {
            .visibility = visibility,
        },
};

}  // namespace gnomon::render
