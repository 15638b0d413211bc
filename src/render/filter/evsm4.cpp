// Exponential variance shadow maps, two warps: four channels.
// Based on: Lauritzen, McCool, "Layered Variance Shadow Maps", 2008, section 5.2.
#include "filter/exponential_variance.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    option::c,
    {"c_negative", 5.0, 0.5, 42.0,
     "exponent of the falling warp: larger bleeds less where occluders overlap, leaks sooner"},
    option::bleed,
    option::floor,
    option::falloff_world,
    option::falloff_kernel(16.0),
};
constexpr OptionPlaces kPlace(kOptions);

void settle(FilterSettings& settings) noexcept {
  for (const std::size_t i : {kPlace("c"), kPlace("c_negative")}) {
    settings.option[i] = std::min(settings.option[i], largest_exponent(settings.format));
  }
}

int channels(const FilterSettings&) noexcept {
  return 4;
}

StoredTexel store(double depth, const glm::dvec2&, const FilterSettings& settings) noexcept {
  const auto [mean, square] = warped_moments(depth, settings.option[kPlace("c")]);
  const auto [falling, falling_square] = warped_moments(1.0 - depth, settings.option[kPlace("c_negative")]);
  return {mean, square, falling, falling_square};
}

double visibility(const StoredTexel& texel, const FilterLookup& lookup, const FilterSettings& settings) {
  const double depth = std::min(lookup.depth, 1.0), rounding = rounding_of(settings.format);
  const double c = settings.option[kPlace("c")], c_negative = settings.option[kPlace("c_negative")];
  const double bleed = settings.option[kPlace("bleed")], least = settings.option[kPlace("floor")];
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
            .formats = kExponentialFormats,
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
    .hooks = {.fit_map = fit_exponent<kPlace>},
};

}  // namespace gnomon::render
