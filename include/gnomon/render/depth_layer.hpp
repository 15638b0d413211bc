// Which depth does a shadow map store? The first surface needs a bias against itself; others need less, and
// fail elsewhere. One entry of the registry depth_layers.def each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::render {

/// The surface whose depth a map stores. A sheet is a caster without thickness: one whose material is
/// double-sided or alpha-masked. Each of a sheet's surfaces is its own second one, so that every layer stores
/// its depth.
enum class DepthLayer : std::uint8_t {
#define GNOMON_DEPTH_LAYER(name, peels, what, source) name,
#include "gnomon/render/depth_layers.def"
#undef GNOMON_DEPTH_LAYER
};
inline constexpr std::size_t kDepthLayerCount = 0
#define GNOMON_DEPTH_LAYER(name, peels, what, source) +1
#include "gnomon/render/depth_layers.def"
#undef GNOMON_DEPTH_LAYER
    ;

/// One entry of the registry.
struct DepthLayerInfo {
  DepthLayer layer{};       ///< the layer
  std::string_view name;    ///< as on command lines
  bool peels = false;       ///< each map is drawn twice, and is never partly reused from the last frame
  std::string_view what;    ///< the map stores
  std::string_view source;  ///< paper
};
/// All layers, in the order of depth_layers.def.
[[nodiscard]] std::span<const DepthLayerInfo, kDepthLayerCount> depth_layers() noexcept;
/// The entry of a layer; that of `front` for a value that is none.
[[nodiscard]] const DepthLayerInfo& info_of(DepthLayer layer) noexcept;
/// The layer of this name; nullptr where there is none.
[[nodiscard]] const DepthLayerInfo* find_depth_layer(std::string_view name) noexcept;

/// The depth that a layer stores, from the depths of the first and the second surface in a texel: 0 near the
/// light .. 1, where 1 is no surface. Distances are halved and limited in the world, also where perspective
/// crowds depths. `curve`: far over near distance of a local light's map, less 1; 0 for parallel light.
/// `limit`: how far behind the first surface DepthLayer::dual may store, as a share of the map's range.
/// Layers that do not peel store the first depth they are given. shaders/library/depth_layer.glsl is the same
/// on the GPU. (Woo 1992; Weiskopf, Ertl 2003)
[[nodiscard]] double depth_of_layer(DepthLayer layer, double first, double second, double curve,
                                    double limit) noexcept;

}  // namespace gnomon::render
