// Straight edges in place of stairs, from the depth map alone: for maps whose texels are larger than pixels.
// Based on: Macedo, Apolinario, "Revectorization-Based Shadow Mapping", 2016 (the outline is followed to its
// steps, and texels are cut by a line); Reshetov, "Morphological Antialiasing", 2009 (where the line runs).
// Steps of two texels and more are corners and stay.
#include <glm/common.hpp>

#include "filter/filter_parts.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

/// Runs are followed no farther, which bounds the border that maps need.
constexpr double kLongestRun = 8.0;

constexpr FilterOption kOptions[] = {
    {"run", kLongestRun, 1, kLongestRun,
     "texels that an edge is followed to either side; larger straightens flatter edges, costs reads", true},
};
constexpr OptionPlaces kPlace(kOptions);

/// The texels round the point, as lit or dark.
struct Outline {
  const FilterLookup& lookup;
  glm::dvec2 own;
  bool lit = false;
  int longest = 0;

  [[nodiscard]] bool lit_at(const glm::dvec2& cell) const {
    const glm::dvec2 texel = own + cell;
    return plane_depth(lookup, texel + 0.5 - lookup.position) <=
           lookup.map_depth(static_cast<int>(texel.x), static_cast<int>(texel.y));
  }
  [[nodiscard]] bool same_at(const glm::dvec2& cell) const { return lit_at(cell) == lit; }
};

/// How far an edge runs beyond the own texel, and where the step at its end leads: 1 into the own row, -1 out
/// of it, 0 neither.
struct RunEnd {
  double texels, step;
};

RunEnd end_of_run(const Outline& outline, const glm::dvec2& along, const glm::dvec2& across) {
  for (int i = 1; i <= outline.longest; ++i) {
    const glm::dvec2 cell = static_cast<double>(i) * along;
    const bool near_same = outline.same_at(cell), far_same = outline.same_at(cell + across);
    if (near_same && !far_same) continue;
    if (near_same != far_same) return {i - 1.0, 0.0};
    const glm::dvec2 beyond = near_same ? cell + 2.0 * across : cell - across;
    const bool one_high = outline.same_at(beyond) != near_same;
    return {i - 1.0, one_high ? (near_same ? -1.0 : 1.0) : 0.0};
  }
  return {static_cast<double>(outline.longest), 0.0};
}

bool is_beyond_line(const Outline& outline, const glm::dvec2& along, const glm::dvec2& across,
                    double to_outline, double before) {
  if (outline.same_at(across)) return false;
  const RunEnd back = end_of_run(outline, -along, across), forth = end_of_run(outline, along, across);
  const double a = back.texels + before, b = forth.texels + 1.0 - before;
  const double height = 0.5 * (a < b ? back.step * (b - a) : forth.step * (a - b));
  return height > to_outline * (a + b);
}

double visibility(const StoredTexel&, const FilterLookup& lookup, const FilterSettings& settings) {
  Outline outline{lookup, glm::floor(lookup.position)};
  outline.longest = static_cast<int>(settings.option[kPlace("run")]);
  outline.lit = outline.lit_at(glm::dvec2(0.0));
  const glm::dvec2 part = lookup.position - outline.own;
  const glm::dvec2 to_outline = glm::min(part, 1.0 - part);
  const glm::dvec2 side{part.x < 0.5 ? -1.0 : 1.0, part.y < 0.5 ? -1.0 : 1.0};
  const bool flips = is_beyond_line(outline, {0.0, 1.0}, {side.x, 0.0}, to_outline.x, part.y) ||
                     is_beyond_line(outline, {1.0, 0.0}, {0.0, side.y}, to_outline.y, part.x);
  return outline.lit != flips ? 1.0 : 0.0;
}

}  // namespace

const Filter filters::revectorized{
    .info =
        {
            .name = "revectorized",
            .summary = "straight hard edges from small maps: steps of the shadow's outline become lines",
            .source = "Macedo, Apolinario 2016, Revectorization-based shadow mapping",
            .reads = MapRead::depth,
            .bias_class = FilterClass::wide_kernel,
            .options = kOptions,
            .default_radius = 0.0,
            .has_kernel = false,
            .lookup_reach_texels = kLongestRun + 0.5,
        },
    .reference =
        {
            .visibility = visibility,
        },
};

}  // namespace gnomon::render
