// Percentage-closer filtering: comparisons are averaged, not depths.
// Based on: Reeves, Salesin, Cook, "Rendering Antialiased Shadows with Depth Maps", 1987. Each texel is
// compared with the receiver's plane at that texel, so that the kernel's width needs no bias (Isidoro,
// "Shadow Mapping: GPU-based Tips and Techniques", 2006).
#include "filter/filter_parts.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    {"pattern", 0, 0, 2, "kernel: 0 box of texels, 1 Vogel disc, 2 Poisson disc", true},
    {"samples", 16, 1, 64, "samples of a disc, four comparisons each", true},
    {"rotate", 1, 0, 1, "1 rotates the disc per pixel: noise instead of banding; 0 does not", true},
    option::footprint,
};
constexpr OptionPlaces kPlace(kOptions);

/// Share of texel i that lies in [low, high].
double overlap(int i, double low, double high) noexcept {
  return std::clamp(std::min(high, i + 1.0) - std::max(low, 1.0 * i), 0.0, 1.0);
}

double compare_box(const FilterLookup& lookup) {
  const glm::dvec2 low = lookup.position - lookup.box, high = lookup.position + lookup.box;
  double sum = 0.0;
  for (int y = static_cast<int>(std::floor(low.y)); y < static_cast<int>(std::ceil(high.y)); ++y) {
    for (int x = static_cast<int>(std::floor(low.x)); x < static_cast<int>(std::ceil(high.x)); ++x) {
      const glm::dvec2 offset = glm::dvec2(x + 0.5, y + 0.5) - lookup.position;
      if (plane_depth(lookup, offset) > lookup.map_depth(x, y)) continue;
      sum += overlap(x, low.x, high.x) * overlap(y, low.y, high.y);
    }
  }
  return sum / (4.0 * lookup.box.x * lookup.box.y);
}

/// The hardware's: bilinear 2 x 2 with one depth, in front of the plane at all four texels.
double compare_hardware(FilterLookup lookup) {
  const glm::dvec2 one(1.0),
      farthest = one + glm::max(beyond_piece(lookup, one), -beyond_piece(lookup, -one));
  lookup.depth -= glm::dot(glm::abs(lookup.depth_gradient), farthest);
  lookup.depth_gradient = glm::dvec2(0.0);
  return compare_2x2(lookup, lookup.position);
}

/// The kernel no narrower than the pixel; a disc is stretched along the map's axes.
FilterLookup covering_pixel(FilterLookup lookup) {
  lookup.box = glm::max(lookup.box, lookup.pixel);
  glm::dmat2& disc = lookup.disc;
  const glm::dvec2 reach(std::hypot(disc[0].x, disc[1].x), std::hypot(disc[0].y, disc[1].y));
  const glm::dvec2 stretch = glm::max(glm::dvec2(1.0), lookup.pixel / (kBoxOfDisc * glm::max(reach, 1e-20)));
  disc = glm::dmat2(disc[0] * stretch, disc[1] * stretch);
  return lookup;
}

double visibility(const StoredTexel&, const FilterLookup& asked, const FilterSettings& settings) {
  constexpr double kBox = 0.0, kPoisson = 2.0;
  const FilterLookup lookup = covering_pixel(asked);
  const double pattern = settings.option[kPlace("pattern")];
  const int samples = static_cast<int>(settings.option[kPlace("samples")]);
  if (pattern == kBox) {
    return std::max(lookup.box.x, lookup.box.y) > 0.5 ? compare_box(lookup) : compare_hardware(lookup);
  }
  const double angle = settings.option[kPlace("rotate")] > 0.5 ? lookup.rotation : 0.0;
  double sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    const glm::dvec2 point = pattern == kPoisson ? poisson_point(i, angle) : vogel_point(i, samples, angle);
    sum += compare_2x2(lookup, lookup.position + lookup.disc * point);
  }
  return sum / samples;
}

}  // namespace

const Filter filters::pcf{
    .info =
        {
            .name = "pcf",
            .summary =
                "soft edges of constant width: the average of comparisons over a box or disc of texels",
            .source = "Reeves, Salesin, Cook 1987, Rendering antialiased shadows with depth maps",
            .reads = MapRead::depth,
            .bias_class = FilterClass::wide_kernel,
            .options = kOptions,
            .lookup_reach_texels = 1.5,
        },
    .reference =
        {
            .visibility = visibility,
        },
};

}  // namespace gnomon::render
