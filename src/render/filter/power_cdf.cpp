// Power-law shadow maps: the least, mean and largest depth of the kernel make a distribution of its depths,
// which is read at the receiver.
// Based on: Gumbau, Szirmay-Kalos, Sbert, Chover, "Improving Shadow Map Filtering with Statistical Analysis",
// 2011. A receiver that faces the light is the kernel's largest depth itself, where the law is 0 however few
// texels shadow it: shadows would grow by the kernel's width. The offset, not the paper's, undoes that: a
// quarter of the range brings the law under one occluder to within 0.06 of the share that is lit, up to a
// share of 0.6; a fifth, to within 0.1. It costs light close behind an occluder that is one of several, so
// the default is the fifth. Layers are those of layered variance maps (Lauritzen, McCool 2008) under this
// law, which is no bound: the two layers about the receiver are blended, in place of the least of all.
#include "filter/power_cdf.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr int kMaxLayers = 8;
constexpr FilterOption kOptions[] = {
    {"offset", 0.2, 0.0, 0.5,
     "receiver offset towards the light, as a share of the kernel's range of depths"},
    {"falloff_world", 0.0, 0.0, 1e6,
     "longest receiver offset, world units: alike in all maps; 0: no limit but falloff_kernel"},
    {"falloff_kernel", 0.0, 0.0, 1000.0, "the same in half widths of the kernel; the longer of both counts"},
    {"layers", 1, 1, kMaxLayers,
     "layers of depth, four channels each: more of them part occluders behind each other", true},
};
/// `longest`: the longest offset, of the depth range; 0: no limit.
constexpr std::string_view kOwnOptions[] = {"longest"};
constexpr OptionPlaces kPlace(kOptions, kOwnOptions);
constexpr TexelFormat kFormats[] = {TexelFormat::fp32, TexelFormat::fp16, TexelFormat::unorm16};
/// A texel that counts less is in the kernel by the rounding of its place alone.
constexpr double kLeastWeight = 1e-4;

void fit_map(FilterSettings& settings, const MapDepths& depths) noexcept {
  const double longest = falloff_of<kPlace>(settings).length(depths);
  settings.option[kPlace("longest")] = depths.range_world > 0.0 ? longest / depths.range_world : 0.0;
}

int layers_of(const FilterSettings& settings) noexcept {
  return static_cast<int>(settings.option[kPlace("layers")]);
}
/// A layer's least, mean and largest depth have a vector of their own.
int channels(const FilterSettings& settings) noexcept {
  const int layers = layers_of(settings);
  return layers == 1 ? 3 : 4 * layers;
}
std::size_t first_channel(int layer) noexcept {
  return static_cast<std::size_t>(4 * layer);
}

/// Each reaches over half of its neighbours.
struct LayerEnds {
  double begin, end;
};
LayerEnds layer_at(int layer, int layers) noexcept {
  const double count = layers;
  return {std::max(layer - 0.5, 0.0) / count, std::min(layer + 1.5, count) / count};
}

/// Of u = 2 depth - 1 in the layer, whose numbers are the smallest for what they tell, or of the depth in
/// [0, 1]. Beyond the layer's ends: its ends.
double value_in(const LayerEnds& layer, double depth, const FilterSettings& settings) noexcept {
  const double within = std::clamp((depth - layer.begin) / (layer.end - layer.begin), 0.0, 1.0);
  return is_unsigned_unit(settings.format) ? within : 2.0 * within - 1.0;
}

StoredTexel store(double depth, const glm::dvec2&, const FilterSettings& settings) noexcept {
  StoredTexel texel{};
  for (int i = 0; i < layers_of(settings); ++i) {
    const double value = value_in(layer_at(i, layers_of(settings)), depth, settings);
    for (std::size_t k = 0; k < 3; ++k) texel[first_channel(i) + k] = value;
  }
  return texel;
}

StoredTexel nothing(const FilterSettings& settings) noexcept {
  constexpr double kBeyond = 2.0;  // any texel is nearer to 0
  StoredTexel sum{};
  for (int i = 0; i < layers_of(settings); ++i) {
    sum[first_channel(i)] = kBeyond;
    sum[first_channel(i) + 2] = -kBeyond;
  }
  return sum;
}

void join(StoredTexel& sum, const StoredTexel& texel, double weight,
          const FilterSettings& settings) noexcept {
  for (int i = 0; i < layers_of(settings); ++i) {
    const std::size_t least = first_channel(i), mean = least + 1, largest = least + 2;
    sum[mean] += weight * texel[mean];
    if (weight < kLeastWeight) continue;
    sum[least] = std::min(sum[least], texel[least]);
    sum[largest] = std::max(sum[largest], texel[largest]);
  }
}

double lit_in(int layer, const StoredTexel& texel, double depth, const FilterSettings& settings) noexcept {
  constexpr double kRoundings = 4.0;  // of the mean, stored after each half of the blur, read and compared
  const LayerEnds ends = layer_at(layer, layers_of(settings));
  const std::size_t first = first_channel(layer);
  const double least = texel[first], mean = texel[first + 1], largest = texel[first + 2];
  // Values of the texel per depth.
  const double scale = (is_unsigned_unit(settings.format) ? 1.0 : 2.0) / (ends.end - ends.begin);
  const double longest =
      settings.option[kPlace("longest")] > 0.0 ? scale * settings.option[kPlace("longest")] : 2.0;
  const double offset = std::min(settings.option[kPlace("offset")] * (largest - least), longest) +
                        kRoundings * rounding_of(settings.format);
  return saturate(power_lit(least, mean, largest, value_in(ends, depth, settings) - offset));
}

double visibility(const StoredTexel& texel, const FilterLookup& lookup, const FilterSettings& settings) {
  const double depth = std::min(lookup.depth, 1.0);
  // Whole in the middle of a layer, nothing in the middle of the next.
  const int layers = layers_of(settings);
  const double place = std::min(std::max(0.0, depth * layers - 0.5), layers - 1.0);  // not-a-number: 0
  double lit = 0.0;
  for (int i = 0; i < layers; ++i) {
    const double share = std::max(1.0 - std::abs(place - i), 0.0);
    if (share > 0.0) lit += share * lit_in(i, texel, depth, settings);
  }
  return saturate(lit);
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
            .own_options = kOwnOptions,
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
            .interpolates = true,
            .visibility = visibility,
        },
    .hooks =
        {
            .fit_map = fit_map,
        },
};

}  // namespace gnomon::render
