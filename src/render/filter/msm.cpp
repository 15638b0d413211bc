// Moment shadow maps: four moments of the kernel's depths give the sharpest bound that they allow.
// Based on: Peters, Klein, "Moment Shadow Mapping", 2015.
#include "filter_parts.hpp"
#include "moments.hpp"
#include "variance.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    {"bounded", 0.0, 0.0, 1.0,
     "0 Hamburger bound, over all depths; 1 Hausdorff bound, over the map's depth range: darker"},
    {"bleed", 0.1, 0.0, 0.95,
     "visibility up to this counts as bleeding and becomes 0: larger bleeds less, hardens edges"},
    {"bias", 0.0, 0.0, 0.1,
     "share of the widest distribution blended in; never below what the format's rounding needs"},
};
constexpr TexelFormat kFormats[] = {TexelFormat::fp32, TexelFormat::unorm16};

int channels(const FilterSettings&) noexcept {
  return 4;
}

double visibility(const StoredTexel& texel, const FilterLookup& lookup, const FilterSettings& settings) {
  const Moments b = moments_of(texel, settings, settings.option[2]);
  const double u = receiver_of_moments(lookup, lookup.box);
  const double dark = settings.option[0] > 0.5 ? share_in_front_bounded(b, u) : share_in_front(b, u).share;
  return without_bleeding(saturate(1.0 - dark), settings.option[1]);
}

void settle(FilterSettings& settings) noexcept {
  settings.option[0] = std::round(settings.option[0]);
}

}  // namespace

const Filter filters::msm{
    .info =
        {
            .name = "msm",
            .summary = "wide blurs with little light bleeding: the sharpest bound from four moments of depth",
            .source = "Peters, Klein 2015, Moment shadow mapping",
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
            .tolerance = 0.01,  // what the bias lets through under a contact of a tenth of the depth range
            .contact = 0.1,
            .store = store_four_moments,
            .visibility = visibility,
        },
};

}  // namespace gnomon::render
