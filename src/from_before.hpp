// Which rules draw a frame's maps from those of the frame before? For sweeps, whose frames are drawn alone,
// and for the report, which tells those rules apart.
#pragma once

#include <string_view>

namespace gnomon {

/// `rule`: its name in prune_rules.def.
[[nodiscard]] constexpr bool draws_from_before(std::string_view rule) noexcept {
  return rule == "held_maps" || rule == "scrolled_maps";
}

}  // namespace gnomon
