// How results of stages become parts of the plan.
#pragma once

#include "map/context.hpp"

namespace gnomon {

void omit(ShadowPlan& plan, const Omission& omission) noexcept;
/// Lists options that do not hold.
void omit(ShadowPlan& plan, const Ignored& options) noexcept;

/// The last frame's map of this cascade or face for a request; nullptr where there is none.
[[nodiscard]] const PlanHistory::Map* last_map(const PlanHistory* history, int cascade) noexcept;

/// Where the plan's next map goes: below kMaxMaps of them so far.
[[nodiscard]] inline ShadowMap& next_map(ShadowPlan& plan) noexcept {
  return plan.map[static_cast<std::size_t>(plan.map_count)];
}

/// Adds the drawn map in the place of next_map with what happened to it; one that is not drawn leaves
/// `missing` in the list.
void merge(const MapResult& result, const Omission& missing, PlanHistory* history, ShadowPlan& plan) noexcept;

/// Texels of a map at the size asked for.
[[nodiscard]] std::int64_t texels_asked(const PlanOptions& options) noexcept;

}  // namespace gnomon
