// Exponential variance shadow maps, one warp: two channels.
// Based on: Lauritzen, McCool, "Layered Variance Shadow Maps", 2008, section 5.2.
#include "filter/exponential_variance.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    option::c, option::bleed, option::floor, option::falloff_world, option::falloff_kernel(16.0),
};
constexpr OptionPlaces kPlace(kOptions);

void settle(FilterSettings& settings) noexcept {
  settings.option[kPlace("c")] = std::min(settings.option[kPlace("c")], largest_exponent(settings.format));
}

int channels(const FilterSettings&) noexcept {
  return 2;
}

StoredTexel store(double depth, const glm::dvec2&, const FilterSettings& settings) noexcept {
  const auto [mean, square] = warped_moments(depth, settings.option[kPlace("c")]);
  return {mean, square};
}

double visibility(const StoredTexel& texel, const FilterLookup& lookup, const FilterSettings& settings) {
  const double depth = std::min(lookup.depth, 1.0), rounding = rounding_of(settings.format);
  const double c = settings.option[kPlace("c")], bleed = settings.option[kPlace("bleed")],
               least = settings.option[kPlace("floor")];
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
            .formats = kExponentialFormats,
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
    .hooks = {.fit_map = fit_exponent<kPlace>},
};

}  // namespace gnomon::render
