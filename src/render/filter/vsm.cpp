// Variance shadow maps: mean and variance of the kernel's depths bound the share that is lit (Chebyshev).
// Based on: Donnelly, Lauritzen, "Variance Shadow Maps", 2006. Bleeding reduction and the slope's share of
// the second moment: Lauritzen, "Summed-Area Variance Shadow Maps", GPU Gems 3, 2007.
#include "filter/variance.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    {"bleed", 0.15, 0.0, 0.95,
     "visibility up to this counts as bleeding and becomes 0: larger bleeds less, hardens edges"},
    {"floor", 1e-6, 0.0, 0.1,
     "least variance, as a share of the depth range squared; never below the format's rounding"},
    {"slope", 1.0, 0.0, 1.0, "share of the surface's slope within a texel that the second moment includes"},
};
constexpr OptionPlaces kPlace(kOptions);
/// Half floats are not among them: their rounding at the ends of the range is 16 times that of unorm16, and
/// leaves a receiver 0.01 behind a flat occluder 0.75 lit.
constexpr TexelFormat kFormats[] = {TexelFormat::fp32, TexelFormat::unorm16};

int channels(const FilterSettings&) noexcept {
  return 2;
}

}  // namespace

const Filter filters::vsm{
    .info =
        {
            .name = "vsm",
            .summary =
                "wide blurs at low cost: a bound from mean and variance; light bleeds between occluders",
            .source = "Donnelly, Lauritzen 2006, Variance shadow maps",
            .reads = MapRead::filtered,
            .bias_class = FilterClass::prefiltered,
            .options = kOptions,
            .formats = kFormats,
            .may_mipmap = true,
            .channels = channels,
        },
    .reference =
        {
            .tolerance =
                0.01,  // the variance's floor under a contact of a tenth of the depth range, in half floats
            .contact = 0.1,
            .store = store_moments<kPlace>,
            .visibility = variance_visibility<kPlace>,
        },
    .hooks = {.reads_slope = reads_slope<kPlace>},
};

}  // namespace gnomon::render
