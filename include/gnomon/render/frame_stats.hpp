// The work and the time of one frame, and the options that it ignored.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "gnomon/options.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/frame_option.hpp"

namespace gnomon::render {

/// The passes of a frame, in the order of reports. Surfaces are drawn before prefilter, which looks at them.
enum class Pass : std::uint8_t {
  shadow_maps,
  prefilter,
  surfaces,
  mask,
  accumulate,
  shade,
  aliasing,
  heat_map,
  cascade_tint,
  panes
};
inline constexpr std::size_t kPassCount = 10;
[[nodiscard]] std::string_view to_string(Pass pass) noexcept;

/// Work of one map, or of the surfaces pass, in one frame.
struct MapStats {
  std::uint32_t instances = 0;  ///< drawn into this map, after culling
  std::uint32_t draws = 0;      ///< draw commands: runs of instances of one primitive
  std::uint64_t triangles = 0;  ///< drawn
  std::uint64_t texels = 0;     ///< rasterized into: width times height; of cached maps, those redrawn
  std::uint64_t copied = 0;     ///< texels copied from static casters' depths (PruneRule::static_casters)
  bool held = false;            ///< cached from the frame before: nothing drawn, nothing filtered
  bool scrolled = false;        ///< moved by whole texels and drawn where it was not in the map before
  int age = 0;                  ///< frames since all of it was drawn
};

/// Work of one frame.
struct FrameStats {
  std::array<double, kPassCount> milliseconds{};  ///< by Pass; 0 where not drawn or not timed
  /// The time of one pass, milliseconds.
  [[nodiscard]] double ms(Pass pass) const noexcept { return milliseconds[static_cast<std::size_t>(pass)]; }
  /// The time of shadows after their plan: maps, prefilter and look-up, milliseconds.
  [[nodiscard]] double shadow_ms() const noexcept {
    return ms(Pass::shadow_maps) + ms(Pass::prefilter) + ms(Pass::mask);
  }
  std::array<MapStats, kMaxMaps> map{};  ///< by index of the map in the plan
  int map_count = 0;                     ///< entries of `map` that are used
  MapStats camera;           ///< the surfaces pass; its texels are pixels; held while camera and scene rest
  std::uint64_t texels = 0;  ///< over all maps
  std::array<PruneSaving, kPruneRuleCount> saved{};  ///< by PruneRule, the plan's own included
  int layered_maps = 0;                              ///< drawn in one pass (MapPasses)
  std::uint32_t layered_draws = 0;  ///< draw commands of that pass; MapStats::draws are those without it
  int prefilter_passes = 0;         ///< over all maps: what the filter stores, blurs, sums and shrinks
  /// Texels that the filter stored and blurred, in whole tiles; needs FrameOptions::time_passes, else 0.
  std::uint64_t filtered_texels = 0;
  /// Options that the frame requested and the source of its shadows does not honour: it was drawn without.
  FrameOptionSet ignored;
  bool irregular = false;   ///< the mask is exact; false by Source::irregular: too large for lists
  bool identified = false;  ///< the mask is by identifiers; false by Source::identifiers: maps are bent
  int maps_read_back = 0;   ///< by filters that choose for each map from its depths
  int pages = 0;            ///< resident, of a PagePlan
  int lights_drawn = 0;     ///< of a LightPlan: lights whose maps were drawn; the pool kept those of others
  int lights_tinted = 0;    ///< of a LightPlan: lights that panes tint, each added by a pass of its own
  int pages_drawn = 0;      ///< of them; the others were kept from earlier frames (PruneRule::held_maps)
  int pages_composed = 0;   ///< of pages_drawn: only moving casters drawn (PruneRule::static_casters)
  std::uint64_t pane_texels = 0;  ///< of pane maps and pages: cleared and drawn; the others were kept
  /// Depth maps and everything that the filter keeps besides for its look-ups.
  std::uint64_t map_bytes = 0;
  /// Used while maps are filtered, free for other passes after that: images of one layer, lists of tiles.
  std::uint64_t scratch_bytes = 0;
};

}  // namespace gnomon::render
