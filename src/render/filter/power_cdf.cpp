// Power-law shadow maps: the least, mean and largest depth of the kernel make a distribution of its depths,
// which is read at the receiver.
// Based on: Gumbau, Szirmay-Kalos, Sbert, Chover, "Improving Shadow Map Filtering with Statistical Analysis",
// 2011. A receiver that faces the light is the kernel's largest depth itself, where the law is 0 however few
// texels shadow it: shadows would grow by the kernel's width. The offset, not the paper's, undoes that: a
// quarter of the range brings the law under one occluder to within 0.06 of the share that is lit, up to a
// share of 0.6; a fifth, to within 0.1. It costs light close behind an occluder that is one of several, so
// the default is the fifth.
#include "power_cdf.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    {"offset", 0.2, 0.0, 0.5,
     "receiver offset towards the light, as a share of the kernel's range of depths"},
    {"falloff_world", 0.0, 0.0, 1e6,
     "longest receiver offset, world units: alike in all maps; 0: no limit but falloff_kernel"},
    {"falloff_kernel", 0.0, 0.0, 1000.0, "the same in half widths of the kernel; the longer of both counts"},
};
/// The filter's own option behind them: the longest offset, of the depth range; 0: no limit.
constexpr std::size_t kLongest = 3;
constexpr TexelFormat kFormats[] = {TexelFormat::fp32, TexelFormat::fp16, TexelFormat::unorm16};
/// A texel that counts less is in the kernel by the rounding of its place alone.
constexpr double kLeastWeight = 1e-4;

void fit_map(FilterSettings& settings, const MapDepths& depths) noexcept {
  const double longest = Falloff{settings.option[1], settings.option[2]}.length(depths);
  settings.option[kLongest] = depths.range_world > 0.0 ? longest / depths.range_world : 0.0;
}

int channels(const FilterSettings&) noexcept {
  return 3;
}

/// Of u = 2 depth - 1, whose numbers are the smallest for what they tell, or of the depth in [0, 1].
StoredTexel store(double depth, const glm::dvec2&, const FilterSettings& settings) noexcept {
  const double value = is_unsigned_unit(settings.format) ? depth : 2.0 * depth - 1.0;
  return {value, value, value};
}

StoredTexel nothing(const FilterSettings&) noexcept {
  constexpr double kBeyond = 2.0;  // any texel is nearer to 0
  return {kBeyond, 0.0, -kBeyond};
}

void join(StoredTexel& sum, const StoredTexel& texel, double weight, const FilterSettings&) noexcept {
  sum[1] += weight * texel[1];
  if (weight < kLeastWeight) return;
  sum[0] = std::min(sum[0], texel[0]);
  sum[2] = std::max(sum[2], texel[2]);
}

double visibility(const StoredTexel& texel, const FilterLookup& lookup, const FilterSettings& settings) {
  constexpr double kRoundings = 4.0;  // of the mean, stored after each half of the blur, read and compared
  const double depth = std::min(lookup.depth, 1.0);
  const double value = is_unsigned_unit(settings.format) ? depth : 2.0 * depth - 1.0;
  // Values of the texel per depth.
  const double scale = is_unsigned_unit(settings.format) ? 1.0 : 2.0;
  const double longest = settings.option[kLongest] > 0.0 ? scale * settings.option[kLongest] : 2.0;
  const double offset = std::min(settings.option[0] * (texel[2] - texel[0]), longest) +
                        kRoundings * rounding_of(settings.format);
  return saturate(power_lit(texel[0], texel[1], texel[2], value - offset));
}

}  // namespace

double power_lit(double least, double mean, double largest, double depth) noexcept {
  mean = std::min(std::max(mean, least), largest);
  if (!(depth > mean)) return 1.0;
  if (depth >= largest || mean == least) return 0.0;
  const double range = largest - least;
  const double exponent = (mean - least) / (largest - mean);
  // 1 - t^b without the digits that are lost where t^b is close to 1; so is the logarithm close to 0.
  const auto one_less_power = [&](double at) {
    return -std::expm1(exponent * std::log1p((at - largest) / range));
  };
  return one_less_power(depth) / one_less_power(mean);
}

const Filter filters::power_cdf{
    .info =
        {
            .name = "power_cdf",
            .summary = "wide blurs with little light bleeding: least, mean and largest depth; soft contacts",
            .source =
                "Gumbau, Szirmay-Kalos, Sbert, Chover 2011, Improving shadow map filtering with statistical "
                "analysis",
            .reads = MapRead::joined,
            .bias_class = FilterClass::prefiltered,
            .options = kOptions,
            .formats = kFormats,
            .may_mipmap = true,
            .channels = channels,
        },
    .reference =
        {
            .contact = 0.01,  // four roundings of half floats are 0.001
            .store = store,
            .join = join,
            .nothing = nothing,
            .visibility = visibility,
        },
    .hooks =
        {
            .fit_map = fit_map,
        },
};

}  // namespace gnomon::render
