// One texel, one comparison: the shadow map as it is.
// Based on: Williams, "Casting Curved Shadows on Curved Surfaces", 1978.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/render/filter.hpp"

namespace gnomon::render {
namespace {

double reach_texels(const FilterParameters&) noexcept {
  return 0.5;
}

StoredTexel store(double depth, const FilterParameters&) noexcept {
  return {depth, 0.0, 0.0, 0.0};
}

double visibility(const FilterLookup& lookup, const FilterParameters&) {
  const glm::dvec2 cell{std::floor(lookup.position.x), std::floor(lookup.position.y)};
  const glm::dvec2 to_centre = cell + 0.5 - lookup.position;
  // The plane may go on behind the map's far plane, where nothing is drawn: lit.
  const double depth = std::min(lookup.depth + glm::dot(lookup.depth_gradient, to_centre), 1.0);
  return depth <= lookup.texel(static_cast<int>(cell.x), static_cast<int>(cell.y))[0] ? 1.0 : 0.0;
}

}  // namespace

const Filter filters::hard{
    .name = "hard",
    .summary = "nearest texel, one comparison",
    .source = "Williams 1978, Casting curved shadows on curved surfaces",
    .reach_texels = reach_texels,
    .store = store,
    .visibility = visibility,
};

}  // namespace gnomon::render
