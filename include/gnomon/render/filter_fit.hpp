// Which cheaper settings of a filter suffice for the maps at hand? Fewer terms or layers, narrower texels, a
// simpler filter of its kind, found with its CPU reference on the maps' own depths.
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
  int width = 0, height = 0;  ///< texels
  double half_side = 1.5;     ///< of the kernel as a box, texels
  MapDepths world = {};       ///< its lengths in world units; 0: unknown
  double bias = 0.0;          ///< what lookups take off a receiver's depth, of the map's depth range
};

/// How closely fit_filter compares, and at how many places.
struct FilterFitOptions {
  /// Largest difference of visibility (1 lit .. 0 in shadow) from that of the full settings, at every tested
  /// receiver. Default: half a step of 8 bits. Larger: cheaper settings.
  double bound = 0.5 / 255.0;
  /// Share of the receivers that may differ by more, 0..1. Half of them lie at edges and a third on the
  /// surface that shadows itself, where formats differ most. A picture has far fewer such pixels.
  double exceptions = 0.0;
  /// Places tried per map, half of them at edges of depth, with three receivers each. More take longer, and
  /// miss less.
  int places = 192;
  std::uint64_t seed = 1;  ///< of the places
};

/// The result of fit_filter.
struct FilterFit {
  FilterSettings settings;  ///< that take the fewest bytes within the bound; the full settings, if none do
  double error = 0.0;       ///< largest difference of visibility that was measured
  double exceeding = 0.0;   ///< share of the receivers where it is above the bound
  double bytes = 0.0, full_bytes = 0.0;  ///< per texel of everything that is kept: of `settings`, and in full
  int channels = 0, full_channels = 0;   ///< a texel stores
  int receivers = 0;                     ///< tried; 0: the maps hold no depth, and nothing was decided
  /// True where the settings take fewer bytes.
  [[nodiscard]] bool saves() const noexcept { return bytes < full_bytes; }
};

/// The cheapest settings whose results agree. Pure: the same input gives the same settings. Filters that
/// store nothing, and sums (MapRead::summed), come back as they are. Takes about 0.1 s for a dozen maps: call
/// it once for a scene or after a cut, not for every frame. The bound holds at the tested receivers, which
/// come from these maps: call it again after view or light have moved.
[[nodiscard]] FilterFit fit_filter(const FilterSettings& full, std::span<const DrawnDepths> maps,
                                   const FilterFitOptions& options = {});

/// The savings and their reason in one line; empty where there are none.
[[nodiscard]] std::string describe(const FilterFit& fit, const FilterSettings& full);

}  // namespace gnomon::render
