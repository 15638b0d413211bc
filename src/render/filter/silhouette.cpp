// Hard shadows with the casters' own edges: for maps whose texels are larger than pixels.
// Based on: Sen, Cammarano, Hanrahan, "Shadow Silhouette Maps", 2003 (points of the outline between four
// comparisons, joined by lines).
#include <glm/common.hpp>

#include "filter/filter_parts.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

glm::dvec2 point_in(const FilterLookup& lookup, const glm::dvec2& texel) {
  if (!lookup.silhouette) return glm::dvec2(0.5);
  return lookup.silhouette(static_cast<int>(texel.x), static_cast<int>(texel.y));
}

bool lit_at_centre(const FilterLookup& lookup, const glm::dvec2& texel) {
  return plane_depth(lookup, texel + 0.5 - lookup.position) <=
         lookup.map_depth(static_cast<int>(texel.x), static_cast<int>(texel.y));
}

double visibility(const StoredTexel&, const FilterLookup& lookup, const FilterSettings&) {
  const glm::dvec2 own = glm::floor(lookup.position - 0.5), part = lookup.position - 0.5 - own;
  bool lit[2][2];
  for (const int y : {0, 1})
    for (const int x : {0, 1}) lit[y][x] = lit_at_centre(lookup, own + glm::dvec2(x, y));
  const glm::dvec2 middle = point_in(lookup, own), away = part - middle;
  const glm::dvec2 across{away.x < 0.0 ? -1.0 : 1.0, 0.0}, along{0.0, away.y < 0.0 ? -1.0 : 1.0};
  const glm::dvec2 beside = point_in(lookup, own + across) + across - middle,
                   beyond = point_in(lookup, own + along) + along - middle;
  const bool upper = away.y * std::abs(beside.x) > beside.y * std::abs(away.x);
  const bool right = away.x * std::abs(beyond.y) > beyond.x * std::abs(away.y);
  return lit[upper ? 1 : 0][right ? 1 : 0] ? 1.0 : 0.0;
}

}  // namespace

const Filter filters::silhouette{
    .info =
        {
            .name = "silhouette",
            .summary = "exact hard edges from small maps: the casters' outlines are drawn beside the depths",
            .source = "Sen, Cammarano, Hanrahan 2003, Shadow silhouette maps",
            .reads = MapRead::depth,
            .bias_class = FilterClass::wide_kernel,
            .default_radius = 0.0,
            .has_kernel = false,
            .lookup_reach_texels = 2.0,  // a texel's centre, and the outline round the neighbouring point
            .draws_silhouettes = true,
        },
    .reference =
        {
            .visibility = visibility,
        },
};

}  // namespace gnomon::render
