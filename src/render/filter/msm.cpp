// Moment shadow maps: four moments of the kernel's depths give the sharpest bound that they allow.
// Based on: Peters, Klein, "Moment Shadow Mapping", 2015; four numbers that 16 bits round without harm, and
// whose means are nothing: Peters, "Non-linearly Quantized Moment Shadow Maps", 2017.
#include "filter/filter_parts.hpp"
#include "filter/moments.hpp"
#include "filter/variance.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    {"bounded", 0.0, 0.0, 1.0,
     "0 Hamburger bound, over all depths; 1 Hausdorff bound, over the map's depth range: darker", true},
    {"bleed", 0.1, 0.0, 0.95,
     "visibility up to this counts as bleeding and becomes 0: larger bleeds less, hardens edges"},
    {"bias", 0.0, 0.0, 0.1,
     "share of the widest distribution blended in; never below what the format's rounding needs"},
};
constexpr OptionPlaces kPlace(kOptions);
constexpr TexelFormat kFormats[] = {TexelFormat::fp32, TexelFormat::unorm16, TexelFormat::nonlinear16};

bool averages(const FilterSettings& settings) noexcept {
  return settings.format != TexelFormat::nonlinear16;
}

int channels(const FilterSettings&) noexcept {
  return 4;
}

StoredTexel store(double depth, const glm::dvec2& slope, const FilterSettings& settings) noexcept {
  return averages(settings) ? store_four_moments(depth, slope, settings)
                            : StoredTexel{depth, depth, 0.5, 0.0};
}

StoredTexel nothing(const FilterSettings&) noexcept {
  return {};
}

void join(StoredTexel& sum, const StoredTexel& texel, double weight,
          const FilterSettings& settings) noexcept {
  const Moments b =
      averages(settings) ? Moments{texel[0], texel[1], texel[2], texel[3]} : unpacked_moments(texel);
  for (std::size_t i = 0; i < b.size(); ++i) sum[i] += weight * b[i];
}

StoredTexel pack(const StoredTexel& sum, const FilterSettings& settings) noexcept {
  return averages(settings) ? sum : packed_moments({sum[0], sum[1], sum[2], sum[3]});
}

Moments read_moments(const StoredTexel& texel, const FilterSettings& settings) noexcept {
  if (averages(settings)) return moments_of(texel, settings, settings.option[kPlace("bias")]);
  // Moments of numbers that were rounded apart are moments all the same: only sums round.
  return spread_by(std::max(settings.option[kPlace("bias")], 64.0 * 0x1p-24),
                   {texel[0], texel[1], texel[2], texel[3]});
}

double visibility(const StoredTexel& texel, const FilterLookup& lookup, const FilterSettings& settings) {
  const Moments b = read_moments(texel, settings);
  const double u = receiver_of_moments(lookup, lookup.box);
  const double dark =
      settings.option[kPlace("bounded")] > 0.5 ? share_in_front_bounded(b, u) : share_in_front(b, u).share;
  return without_bleeding(saturate(1.0 - dark), settings.option[kPlace("bleed")]);
}

}  // namespace

const Filter filters::msm{
    .info =
        {
            .name = "msm",
            .summary = "wide blurs with little light bleeding: the sharpest bound from four moments of depth",
            .source = "Peters, Klein 2015, Moment shadow mapping",
            .reads = MapRead::joined,
            .bias_class = FilterClass::prefiltered,
            .options = kOptions,
            .formats = kFormats,
            .may_mipmap = true,
            .channels = channels,
        },
    .reference =
        {
            .tolerance = 0.01,  // what the bias lets through under a contact of a tenth of the depth range
            .contact = 0.1,
            .store = store,
            .join = join,
            .nothing = nothing,
            .pack = pack,
            .visibility = visibility,
        },
    .hooks =
        {
            .averages = averages,
        },
};

}  // namespace gnomon::render
