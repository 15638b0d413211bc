// Layered variance shadow maps: two moments per layer of depth. What stands in front of a layer counts as one
// depth there, and bleeds no light into it.
// Based on: Lauritzen, McCool, "Layered Variance Shadow Maps", 2008. The paper reads the one layer that holds
// the receiver. Each layer's bound is a bound, so the least of them is taken: it is tighter, and does not
// jump from layer to layer. At its beginning a layer's bound says little, and at its end the depths of a
// slanted surface pile up and shadow it; there the overlapping neighbours answer. Where the layers end is
// chosen, when asked, as in the paper from the map's own depths; the paper gets near the least variance
// within layers step by step, here it is found: over so few bins that costs nothing.
#include "filter/lvsm.hpp"
#include "gnomon/study/bias.hpp"

#include <array>
#include <glm/common.hpp>
#include <limits>

#include "filter/variance.hpp"

namespace gnomon::render {
namespace {

constexpr int kMaxLayers = 8;
constexpr FilterOption kOptions[] = {
    {"bleed", 0.15, 0.0, 0.95,
     "visibility up to this counts as bleeding and becomes 0: larger bleeds less, hardens edges"},
    {"floor", 1e-6, 0.0, 0.1,
     "least variance, as a share of a layer's depth squared; never below the format's rounding"},
    {"slope", 1.0, 0.0, 1.0, "share of the surface's slope within a texel that the second moment includes"},
    {"layers", 4, 1, kMaxLayers, "layers of depth, two channels each: more layers bleed less", true},
    {"overlap", 0.5, 0.0, 1.0, "part of the neighbouring layers that a layer also covers, in layers"},
    {"placement", 0, 0, 1,
     "0 even layers; 1 layers fitted to the depths of each map, which are read back to the CPU", true},
};
/// `ends`: the first of the ends of all layers but the last; 0: even layers.
constexpr std::string_view kOwnOptions[] = {"ends"};
constexpr OptionPlaces kPlace(kOptions, kOwnOptions);
static_assert(kPlace("ends") + kMaxLayers - 1 <= kMaxFilterOptions);
constexpr TexelFormat kFormats[] = {TexelFormat::unorm16, TexelFormat::fp16, TexelFormat::fp32};

int layers_of(const FilterSettings& settings) noexcept {
  return static_cast<int>(settings.option[kPlace("layers")]);
}
int channels(const FilterSettings& settings) noexcept {
  return 2 * layers_of(settings);
}

StoredTexel store(double depth, const glm::dvec2& slope, const FilterSettings& settings) noexcept {
  StoredTexel texel{};
  for (int i = 0; i < layers_of(settings); ++i) {
    const DepthBand layer = layer_of(i, settings);
    const bool within = depth > layer.begin && depth < layer.end;
    const glm::dvec2 warped_slope = within ? slope / (layer.end - layer.begin) : glm::dvec2(0.0);
    const StoredTexel moments = store_moments<kPlace>(layer.warped(depth), warped_slope, settings);
    texel[static_cast<std::size_t>(2 * i)] = moments[0];
    texel[static_cast<std::size_t>(2 * i + 1)] = moments[1];
  }
  return texel;
}

double visibility(const StoredTexel& texel, const FilterLookup& lookup, const FilterSettings& settings) {
  const int count = layers_of(settings);
  const double depth = std::min(lookup.depth, 1.0);
  // The receiver's plane under the kernel and the bilinear read.
  const double spread = glm::dot(glm::abs(lookup.depth_gradient), lookup.box + 1.0);
  double lit = 1.0;
  FilterLookup in_layer;
  for (int i = 0; i < count; ++i) {
    in_layer.depth = layer_of(i, settings).warped(depth);
    const StoredTexel moments{texel[static_cast<std::size_t>(2 * i)],
                              texel[static_cast<std::size_t>(2 * i + 1)]};
    const double bound = variance_visibility<kPlace>(moments, in_layer, settings);
    lit = std::min(lit, std::max(bound, beyond_layer(i, settings, depth + spread)));
  }
  return lit;
}

/// Where layer i - 1 ends and layer i begins, without overlap.
double end_before(int i, const FilterSettings& settings) noexcept {
  const int count = layers_of(settings);
  if (i <= 0 || i >= count) return i <= 0 ? 0.0 : 1.0;
  const double placed = settings.option[kPlace("ends") + static_cast<std::size_t>(i - 1)];
  return placed > 0.0 ? placed : 1.0 * i / count;
}

bool adapts(const FilterSettings& settings) noexcept {
  return settings.option[kPlace("placement")] > 0.5 && layers_of(settings) > 1;
}

void adapt(FilterSettings& settings, std::span<const float> depths) noexcept {
  const auto count = static_cast<std::size_t>(layers_of(settings));
  place_layers(depths, std::span(settings.option).subspan(kPlace("ends"), count - 1));
}

}  // namespace

DepthBand layer_of(int i, const FilterSettings& settings) noexcept {
  const double begin = end_before(i, settings), end = end_before(i + 1, settings),
               overlap = settings.option[kPlace("overlap")];
  return {begin - overlap * (begin - end_before(i - 1, settings)),
          end + overlap * (end_before(i + 2, settings) - end)};
}

double beyond_layer(int i, const FilterSettings& settings, double deepest) noexcept {
  constexpr double kLeastOverlap = 1e-6;  // a step where there is none
  const double end = end_before(i + 1, settings), last = layer_of(i, settings).end;
  // Nothing is deeper than the map.
  return std::clamp((std::min(deepest, 1.0) - end) / std::max(last - end, kLeastOverlap), 0.0, 1.0);
}

const Filter filters::lvsm{
    .info =
        {
            .name = "lvsm",
            .summary = "variances in layers of depth: light bleeds within a layer only; needs much memory",
            .source = "Lauritzen, McCool 2008, Layered variance shadow maps",
            .reads = MapRead::filtered,
            .bias_class = FilterClass::prefiltered,
            .options = kOptions,
            .own_options = kOwnOptions,
            .formats = kFormats,
            .may_mipmap = true,
            .terms_option = kPlace("layers"),
            .channels = channels,
        },
    .reference =
        {
            .tolerance =
                0.01,  // the variance's floor in half floats, under a contact of a tenth of the depth range
            .contact = 0.1,
            .store = store,
            .visibility = visibility,
        },
    .hooks =
        {
            .reads_slope = reads_slope<kPlace>,
            .adapts = adapts,
            .adapt = adapt,
        },
};

}  // namespace gnomon::render
