// Moment soft shadow maps: penumbras that widen with the blocker's distance, without samples and their noise.
// Based on: Peters, Muenstermann, Wetzstein, Klein, "Beyond Hard Shadows: Moment Shadow Maps for Single
// Scattering, Soft Shadows and Translucent Occluders", 2016; Lauritzen, "Summed-Area Variance Shadow Maps",
// GPU Gems 3, 2007, for the table; Fernando, "Percentage-Closer Soft Shadows", 2005, for the penumbra.
//
// FilterSettings::radius is the widest kernel, over which what blocks is looked for.
#include <glm/common.hpp>

#include "filter/filter_parts.hpp"
#include "filter/moments.hpp"
#include "filter/variance.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    option::angle_deg,
    option::light_radius,
    {"bleed", 0.05, 0.0, 0.95,
     "visibility up to this counts as bleeding and becomes 0: larger bleeds less, hardens edges"},
    // Half a step of the sums, where kernels are 32 texels wide to each side, makes 5e-7 of a moment.
    {"bias", 1e-5, 0.0, 0.1,
     "share of the widest distribution blended in; never below what the format's rounding needs"},
};
constexpr OptionPlaces kPlace(kOptions);
constexpr TexelFormat kFormats[] = {TexelFormat::uint32};

int channels(const FilterSettings&) noexcept {
  return 4;
}

/// Half sides of the box that has the variance of the penumbra's disc, no wider than the widest kernel.
glm::dvec2 penumbra_box(const FilterLookup& lookup, double radius_world) noexcept {
  const glm::dmat2 axes = kBoxOfDisc * radius_world * lookup.texels_per_world;
  const glm::dvec2 box{glm::length(glm::dvec2(axes[0].x, axes[1].x)),
                       glm::length(glm::dvec2(axes[0].y, axes[1].y))};
  const glm::dvec2 over = box / lookup.box;
  return glm::clamp(box / std::max({over.x, over.y, 1.0}), glm::min(glm::dvec2(0.5), lookup.box), lookup.box);
}

double visibility(const StoredTexel& texel, const FilterLookup& lookup, const FilterSettings& settings) {
  const Moments b = moments_of(texel, settings, settings.option[kPlace("bias")]);
  // The receiver's own plane counts as what touches it: a search that left it out would miss contacts.
  const double u = receiver_of_moments(lookup, glm::dvec2(0.0));
  const auto [blocked, others] = share_in_front(b, u);
  // Nothing that blocks for certain: what touches the receiver may, and has no penumbra.
  double away = 0.0;
  if (blocked > 0.0) {
    // The mean of what lies in front of the receiver in the distribution with that share.
    const double blocker = u > others.y ? (b[0] - (1.0 - blocked) * u) / blocked : others.x;
    away = distance_to_depth(lookup, std::clamp(0.5 * blocker + 0.5, 0.0, 1.0));
  }
  const glm::dvec2 box =
      penumbra_box(lookup, penumbra_radius<kPlace>(settings, std::max(0.0, away), lookup.light_distance));
  const StoredTexel mean = lookup.mean_of_box ? lookup.mean_of_box(box) : texel;
  const Moments within = moments_of(mean, settings, settings.option[kPlace("bias")]);
  const double dark = share_in_front(within, receiver_of_moments(lookup, box)).share;
  return without_bleeding(saturate(1.0 - dark), settings.option[kPlace("bleed")]);
}

}  // namespace

const Filter filters::mssm{
    .info =
        {
            .name = "mssm",
            .summary = "soft shadows without noise: penumbra and share from moments in a summed-area table",
            .source = "Peters et al. 2016, Beyond hard shadows",
            .reads = MapRead::summed,
            .bias_class = FilterClass::prefiltered,
            .options = kOptions,
            .formats = kFormats,
            .default_radius = 12.0,
            .channels = channels,
            .penumbra_radius_world = penumbra_radius<kPlace>,
        },
    .reference =
        {
            .tolerance = 0.01,  // what the bias lets through under a contact of a tenth of the depth range
            .contact = 0.1,
            .store = store_four_moments,
            .visibility = visibility,
        },
};

}  // namespace gnomon::render
