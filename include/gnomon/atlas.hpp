// One texture for all maps of a plan: where each of them lies in it.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>

#include "gnomon/plan.hpp"

namespace gnomon {

/// Where a plan's maps lie in one texture. Filters stay inside their map: its border holds their kernels.
struct Atlas {
  int width = 0, height = 0;              ///< texels; 0: the plan has no map, or the maps do not fit
  std::array<TexelRect, kMaxMaps> place;  ///< by index of the map in the plan; no two share a texel
  int count = 0;                          ///< of maps placed: all of the plan's, or none
  /// Texels of the maps over texels of the texture, in [0, 1].
  double efficiency = 0.0;
};

/// Packs the maps into the smallest texture whose sides are powers of two, the squarest of equal ones. Any
/// plan fits. The same sizes give the same places.
[[nodiscard]] Atlas pack_atlas(const ShadowPlan& plan) noexcept;
/// The same into a texture of this size; count is 0 where they were not placed. Maps are placed on shelves
/// from the tallest to the flattest; another order might fit where this one does not.
[[nodiscard]] Atlas pack_atlas(const ShadowPlan& plan, int width, int height) noexcept;

/// Share of the texels used where every map has a layer of its own, as large as the largest: what an array
/// costs.
[[nodiscard]] double array_efficiency(const ShadowPlan& plan) noexcept;

/// From the clip space of a map to the atlas. After the division by w, x and y are texture coordinates of the
/// atlas, z is the depth in [0, 1]. It is texture_from_clip with the map's place taken in. Draw the map with
/// its place as the viewport. `map` is below atlas.count.
[[nodiscard]] glm::dmat4 atlas_from_clip(const Atlas& atlas, const ClipSpace& clip_space, int map) noexcept;

}  // namespace gnomon
