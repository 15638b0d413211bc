// Summed-area variance shadow maps: two moments over a box of any size at a constant price.
// Based on: Lauritzen, "Summed-Area Variance Shadow Maps", GPU Gems 3, 2007; Crow, "Summed-Area Tables for
// Texture Mapping", 1984. Sums are integers that may wrap round at 2^32: their differences over a box are
// exact however large the map is, where floats would lose log2(width height) bits.
#include "filter/variance.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    {"bleed", 0.15, 0.0, 0.95,
     "visibility up to this counts as bleeding and becomes 0: larger bleeds less, hardens edges"},
    // Half a step of the sums, where kernels are 32 texels wide to each side, makes 3e-6 of variance.
    {"floor", 1e-6, 0.0, 0.1, "least variance, as a share of the depth range squared"},
    {"slope", 1.0, 0.0, 1.0, "share of the surface's slope within a texel that the second moment includes"},
};
constexpr OptionPlaces kPlace(kOptions);
constexpr TexelFormat kFormats[] = {TexelFormat::uint32};

int channels(const FilterSettings&) noexcept {
  return 2;
}

}  // namespace

const Filter filters::savsm{
    .info =
        {
            .name = "savsm",
            .summary = "blurs of any width at constant cost: variances in a summed-area table; light bleeds",
            .source = "Lauritzen 2007, Summed-area variance shadow maps",
            .reads = MapRead::summed,
            .bias_class = FilterClass::prefiltered,
            .options = kOptions,
            .formats = kFormats,
            .channels = channels,
        },
    .reference =
        {
            .tolerance =
                0.001,  // the variance's floor, four times 1e-6, under a contact of a tenth of the range
            .contact = 0.1,
            .store = store_moments<kPlace>,
            .visibility = variance_visibility<kPlace>,
        },
    .hooks = {.reads_slope = reads_slope<kPlace>},
};

}  // namespace gnomon::render
