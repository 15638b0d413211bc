// Percentage-closer filtering: comparisons are averaged, not depths.
// Based on: Reeves, Salesin, Cook, "Rendering Antialiased Shadows with Depth Maps", 1987. Each texel is
// compared with the receiver's plane at that texel, so that the kernel's width needs no bias (Isidoro,
// "Shadow Mapping: GPU-based Tips and Techniques", 2006).
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "gnomon/render/filter.hpp"

namespace gnomon::render {
namespace {

constexpr int kMaxRadius = 4;  ///< a 9 x 9 kernel

/// Whole texels to each side of the middle one.
int whole_radius(const FilterParameters& parameters) noexcept {
  return static_cast<int>(std::clamp(std::floor(parameters.radius_texels + 0.5), 0.0, double{kMaxRadius}));
}

/// Radius, and one more for the bilinear weights at the rim.
double reach_texels(const FilterParameters& parameters) noexcept {
  return whole_radius(parameters) + 1.0;
}

StoredTexel store(double depth, const FilterParameters&) noexcept {
  return {depth, 0.0, 0.0, 0.0};
}

/// Weight of texel i of width + 1 texels under a box of `width` texels that starts `fraction` into the first.
double box_weight(int i, int width, double fraction) noexcept {
  if (i == 0) return 1.0 - fraction;
  return i == width ? fraction : 1.0;
}

double visibility(const FilterLookup& lookup, const FilterParameters& parameters) {
  const int radius = whole_radius(parameters);
  const int width = 2 * radius + 1;
  const glm::dvec2 base{std::floor(lookup.position.x - 0.5), std::floor(lookup.position.y - 0.5)};
  const glm::dvec2 fraction = lookup.position - 0.5 - base;
  double sum = 0.0;
  for (int j = 0; j <= width; ++j) {
    for (int i = 0; i <= width; ++i) {
      const int x = static_cast<int>(base.x) - radius + i, y = static_cast<int>(base.y) - radius + j;
      // The bilinear 2 x 2 of the hardware knows one depth only.
      const glm::dvec2 offset =
          radius == 0 ? glm::dvec2(0.0) : glm::dvec2(x + 0.5, y + 0.5) - lookup.position;
      // The plane may go on behind the map's far plane, where nothing is drawn: lit.
      const double depth = std::min(lookup.depth + glm::dot(lookup.depth_gradient, offset), 1.0);
      if (depth <= lookup.texel(x, y)[0]) {
        sum += box_weight(i, width, fraction.x) * box_weight(j, width, fraction.y);
      }
    }
  }
  return sum / (width * width);
}

}  // namespace

const Filter filters::pcf{
    .name = "pcf",
    .summary = "average of comparisons over 2x2 to 9x9 texels",
    .source = "Reeves, Salesin, Cook 1987, Rendering antialiased shadows with depth maps",
    .reach_texels = reach_texels,
    .store = store,
    .visibility = visibility,
};

}  // namespace gnomon::render
