// One texel, one comparison: the shadow map as it is.
// Based on: Williams, "Casting Curved Shadows on Curved Surfaces", 1978.
#include <cmath>
#include <glm/geometric.hpp>

#include "filter/filter_parts.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

double visibility(const StoredTexel&, const FilterLookup& lookup, const FilterSettings&) {
  const glm::dvec2 cell{std::floor(lookup.position.x), std::floor(lookup.position.y)};
  const double depth = plane_depth(lookup, cell + 0.5 - lookup.position);
  return depth <= lookup.map_depth(static_cast<int>(cell.x), static_cast<int>(cell.y)) ? 1.0 : 0.0;
}

}  // namespace

const Filter filters::hard{
    .info =
        {
            .name = "hard",
            .summary = "unfiltered shadow edges: one comparison with the nearest texel; the cheapest filter",
            .source = "Williams 1978, Casting curved shadows on curved surfaces",
            .reads = MapRead::depth,
            .bias_class = FilterClass::single_compare,
            .default_radius = 0.0,
            .has_kernel = false,
            .lookup_reach_texels = 0.5,
        },
    .reference =
        {
            .visibility = visibility,
        },
};

}  // namespace gnomon::render
