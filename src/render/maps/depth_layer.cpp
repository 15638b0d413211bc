// The registry of depth layers, and what each stores of two surfaces.
#include "gnomon/render/depth_layer.hpp"

#include <algorithm>
#include <array>

#include "filter/filter_block.hpp"

namespace gnomon::render {
namespace {

constexpr std::array<DepthLayerInfo, kDepthLayerCount> kLayers{{
#define GNOMON_DEPTH_LAYER(name, peels, what, source) {DepthLayer::name, #name, peels, what, source},
#include "gnomon/render/depth_layers.def"
#undef GNOMON_DEPTH_LAYER
}};

}  // namespace

std::span<const DepthLayerInfo, kDepthLayerCount> depth_layers() noexcept {
  return kLayers;
}

const DepthLayerInfo& info_of(DepthLayer layer) noexcept {
  const auto place = static_cast<std::size_t>(layer);
  return kLayers[place < kLayers.size() ? place : 0];
}

const DepthLayerInfo* find_depth_layer(std::string_view name) noexcept {
  const auto found = std::find_if(kLayers.begin(), kLayers.end(),
                                  [name](const DepthLayerInfo& info) { return info.name == name; });
  return found == kLayers.end() ? nullptr : &*found;
}

double depth_of_layer(DepthLayer layer, double first, double second, double curve, double limit) noexcept {
  if (!info_of(layer).peels || !(first < 1.0)) return first;
  const bool has_second = second < 1.0;
  if (layer == DepthLayer::second) return has_second ? second : first;
  if (layer == DepthLayer::midpoint && !has_second) return first;
  const double near_end = linear_depth(first, curve);
  double stored = has_second ? 0.5 * (near_end + linear_depth(second, curve)) : 1.0;
  if (layer == DepthLayer::dual) stored = std::min(stored, near_end + limit);
  return depth_from_linear(std::min(stored, 1.0), curve);
}

}  // namespace gnomon::render
