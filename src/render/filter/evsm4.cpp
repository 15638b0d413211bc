// Exponential variance shadow maps, two warps: four channels.
// Based on: Lauritzen, McCool, "Layered Variance Shadow Maps", 2008, section 5.2.
#include "filter/exponential_variance.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    {"c", 40.0, 0.5, 42.0,
     "largest exponent over half the depth range: larger bleeds less; at most 5.54 in half floats"},
    {"c_negative", 5.0, 0.5, 42.0,
     "exponent of the falling warp: larger bleeds less where occluders overlap, leaks sooner"},
    {"bleed", 0.1, 0.0, 0.95,
     "visibility up to this counts as bleeding and becomes 0: larger bleeds less, hardens edges"},
    {"floor", 1e-4, 0.0, 0.1,
     "least standard deviation, as a share of the depth range; never below the format's rounding"},
    kFalloffWorld,
    falloff_kernel(16.0),
};
constexpr TexelFormat kFormats[] = {TexelFormat::fp32, TexelFormat::fp16};

void settle(FilterSettings& settings) noexcept {
  for (std::size_t i = 0; i < 2; ++i) {
    settings.option[i] = std::min(settings.option[i], largest_exponent(settings.format));
  }
}

void fit_map(FilterSettings& settings, const MapDepths& depths) noexcept {
  settings.option[0] = warp_exponent(settings.option[0], {settings.option[4], settings.option[5]}, depths);
}

int channels(const FilterSettings&) noexcept {
  return 4;
}

StoredTexel store(double depth, const glm::dvec2&, const FilterSettings& settings) noexcept {
  const auto [mean, square] = warped_moments(depth, settings.option[0]);
  const auto [falling, falling_square] = warped_moments(1.0 - depth, settings.option[1]);
  return {mean, square, falling, falling_square};
}

double visibility(const StoredTexel& texel, const FilterLookup& lookup, const FilterSettings& settings) {
  const double depth = std::min(lookup.depth, 1.0), rounding = rounding_of(settings.format);
  const double c = settings.option[0], c_negative = settings.option[1];
  const double bleed = settings.option[2], least = settings.option[3];
  const double rising = warped_bound(texel[0], texel[1], depth, c, 1.0, least, rounding);
  const double falling = warped_bound(texel[2], texel[3], depth, c_negative, -1.0, least, rounding);
  return without_bleeding(std::min(rising, falling), bleed);
}

}  // namespace

const Filter filters::evsm4{
    .info =
        {
            .name = "evsm4",
            .summary = "least light bleeding of the variance filters: a rising and a falling exponential",
            .source = "Lauritzen, McCool 2008, Layered variance shadow maps",
            .reads = MapRead::filtered,
            .bias_class = FilterClass::prefiltered,
            .options = kOptions,
            .formats = kFormats,
            .may_mipmap = true,
            .leaner = &filters::evsm2,
            .channels = channels,
            .settle = settle,
        },
    .reference =
        {
            .tolerance =
                0.01,  // what rounding leaves under a contact of a tenth of the depth range, in half floats
            .contact = 0.1,
            .store = store,
            .visibility = visibility,
        },
    .hooks =
        {
            .fit_map = fit_map,
        },
};

}  // namespace gnomon::render
