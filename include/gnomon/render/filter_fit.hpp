// What a filter can do without on the maps at hand: fewer terms or layers, narrower texels, a simpler filter
// of its kind, found by asking its CPU reference about the maps' own depths.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gnomon/render/filter.hpp"

namespace gnomon::render {

/// One map as it was drawn: Renderer::drawn_depths.
struct DrawnDepths {
  std::vector<float> depths;  ///< row by row, 0 near the light .. 1 where nothing is; even in distance
  int width = 0, height = 0;
  double half_side = 1.5;  ///< of the kernel as a box, texels
  double bias = 0.0;       ///< what lookups take off a receiver's depth, of the map's depth range
};

struct FilterFitOptions {
  /// Answers (1 lit .. 0 in shadow) may differ by this much from those of the settings asked for, at every
  /// receiver tried. Default: half a step of 8 bits. Larger: more is left out.
  double bound = 0.5 / 255.0;
  /// Share of the receivers that may differ by more, 0..1. Half of them lie at edges and a third on the
  /// surface that shadows itself, where formats differ most: a picture has far fewer such pixels.
  double exceptions = 0.0;
  /// Places tried per map, half of them at edges of depth, with three receivers each. More take longer, and
  /// miss less.
  int places = 192;
  std::uint64_t seed = 1;  ///< of the places
};

struct FilterFit {
  FilterSettings settings;  ///< that take the fewest bytes within the bound; those asked for, if none do
  double error = 0.0;       ///< largest difference that was measured between both answers
  double exceeding = 0.0;   ///< share of the receivers where it is above the bound
  double bytes = 0.0, full_bytes = 0.0;  ///< a texel of everything that is kept, now and as asked for
  int channels = 0, full_channels = 0;   ///< a texel stores
  int receivers = 0;                     ///< tried; 0: the maps hold no depth, and nothing was decided
  [[nodiscard]] bool saves() const noexcept { return bytes < full_bytes; }
};

/// The least settings whose answers agree. Pure: the same input gives the same settings. Filters that store
/// nothing, and sums (MapRead::summed), come back as they are. Takes about 0.1 s for a dozen maps: to be
/// asked once for a scene or after a cut, not for every frame. The bound holds at the receivers tried, which
/// are drawn from these maps: where the view or the light moves on, ask again.
[[nodiscard]] FilterFit fit_filter(const FilterSettings& full, std::span<const DrawnDepths> maps,
                                   const FilterFitOptions& options = {});

/// What was left out and why, in one line; empty where nothing was.
[[nodiscard]] std::string describe(const FilterFit& fit, const FilterSettings& full);

}  // namespace gnomon::render
