// Exponential variance shadow maps, one warp: two channels.
// Based on: Lauritzen, McCool, "Layered Variance Shadow Maps", 2008, section 5.2.
#include "filter/exponential_variance.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    {"c", 40.0, 0.5, 42.0,
     "largest exponent over half the depth range: larger bleeds less; at most 5.54 in half floats"},
    {"bleed", 0.1, 0.0, 0.95,
     "visibility up to this counts as bleeding and becomes 0: larger bleeds less, hardens edges"},
    {"floor", 1e-4, 0.0, 0.1,
     "least standard deviation, as a share of the depth range; never below the format's rounding"},
    kFalloffWorld,
    falloff_kernel(16.0),
};
constexpr TexelFormat kFormats[] = {TexelFormat::fp32, TexelFormat::fp16};

void settle(FilterSettings& settings) noexcept {
  settings.option[0] = std::min(settings.option[0], largest_exponent(settings.format));
}

void fit_map(FilterSettings& settings, const MapDepths& depths) noexcept {
  settings.option[0] = warp_exponent(settings.option[0], {settings.option[3], settings.option[4]}, depths);
}

int channels(const FilterSettings&) noexcept {
  return 2;
}

StoredTexel store(double depth, const glm::dvec2&, const FilterSettings& settings) noexcept {
  const auto [mean, square] = warped_moments(depth, settings.option[0]);
  return {mean, square};
}

double visibility(const StoredTexel& texel, const FilterLookup& lookup, const FilterSettings& settings) {
  const double depth = std::min(lookup.depth, 1.0), rounding = rounding_of(settings.format);
  const double c = settings.option[0], bleed = settings.option[1], least = settings.option[2];
  return without_bleeding(warped_bound(texel[0], texel[1], depth, c, 1.0, least, rounding), bleed);
}

}  // namespace

const Filter filters::evsm2{
    .info =
        {
            .name = "evsm2",
            .summary = "wide blurs that bleed far less light than vsm: variance of an exponential of depth",
            .source = "Lauritzen, McCool 2008, Layered variance shadow maps",
            .reads = MapRead::filtered,
            .bias_class = FilterClass::prefiltered,
            .options = kOptions,
            .formats = kFormats,
            .may_mipmap = true,
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
