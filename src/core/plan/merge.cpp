// How results of stages become parts of the plan.
#include "plan/merge.hpp"

namespace gnomon {

void omit(ShadowPlan& plan, const Omission& omission) noexcept {
  if (plan.omission_count < kMaxOmissions)
    plan.omission[static_cast<std::size_t>(plan.omission_count)] = omission;
  ++plan.omission_count;
}

void omit(ShadowPlan& plan, const Ignored& options) noexcept {
  for (const Omission& o : options.entries()) omit(plan, o);
}

const PlanHistory::Map* last_map(const PlanHistory* history, int cascade) noexcept {
  if (history == nullptr) return nullptr;
  const PlanHistory::Map& last = history->map[static_cast<std::size_t>(cascade)];
  return last.frame >= 0 && last.frame == history->frame - 1 ? &last : nullptr;
}

void merge(const MapResult& result, const Omission& missing, PlanHistory* history,
           ShadowPlan& plan) noexcept {
  if (!result.drawn) {
    omit(plan, missing);
    return;
  }
  const ShadowMap& map = result.map;
  ++plan.map_count;
  for (const Omission& o : result.omissions()) omit(plan, o);
  if (history == nullptr) return;
  if (result.has_event && history->event_count < kMaxMaps)
    history->event[static_cast<std::size_t>(history->event_count++)] = result.event;
  history->map[static_cast<std::size_t>(map.cascade)] = {
      history->frame, result.gl_from_world, map.width, map.height, map.filter_margin_texels, result.searched};
}

std::int64_t texels_asked(const PlanOptions& options) noexcept {
  return std::int64_t{options.resolution.max_size} * options.resolution.max_size;
}

}  // namespace gnomon
