// How do the local lights of a view share texels?
#include "texel_shares.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>

namespace gnomon::tool {

TexelShares::TexelShares(const std::vector<Light>& lights) {
  for (const Light& light : lights) requests_.push_back({light});
}

PlanOptions TexelShares::options_of(std::size_t index, const gnomon::View& view, const SceneBounds& bounds,
                                    const SweepEntry& entry) const {
  constexpr int kSteps = 4;  // sizes from a quarter of the entry's to four times that
  LightOptions options;
  options.plan = entry.plan;
  const int side = static_cast<int>(std::bit_floor(static_cast<unsigned>(entry.technique.map_size)));
  // Room for any places: the budget alone decides.
  options.pool_width = options.pool_height = kMaxMapSize;
  options.least_size = options.most_size = side;
  memory_.resize(light_memory(requests_.size(), view.points_world.size()));
  options.texel_budget =
      std::max(plan_lights(view, requests_, bounds, options, memory_).texels, std::int64_t{1});
  options.least_size = std::max(side / kSteps, kLeastMapSize);
  options.most_size = std::min(side * kSteps, kMaxMapSize);
  const LightPlan plan = plan_lights(view, requests_, bounds, options, memory_);
  if (plan.status == PlanStatus::invalid_input)
    throw std::runtime_error(entry.technique.name() + ": plan_lights refuses " +
                             std::string(plan.invalid_field));
  // A light without maps: its own plan states why.
  if (index >= plan.lights.size() || plan.lights[index].size == 0) return entry.plan;
  return light_options(options, plan.lights[index]);
}

}  // namespace gnomon::tool
