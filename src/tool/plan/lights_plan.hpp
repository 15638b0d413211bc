// A plan of many lights of a case with its memory, and its JSON.
#pragma once

#include <cstddef>
#include <vector>

#include "plan_json.hpp"

namespace gnomon::tool {

/// Plans the lights of one case, again and again into the same memory.
class LightsPlanner {
 public:
  /// `input` must have lights, and outlive the planner.
  explicit LightsPlanner(const Case& input);
  /// The plan lives until the next call.
  [[nodiscard]] LightPlan plan() noexcept;

 private:
  const Case& input_;
  LightOptions options_;
  std::vector<std::byte> memory_;
};

/// As plan_json, of lights: sizes, places and reasons. Their maps' matrices are those of a case with that
/// light alone and its size as map_size.
[[nodiscard]] Json lights_json(const LightPlan& plan, const Case& input);

/// Why a plan is refused, with the light that it is about.
[[nodiscard]] std::string refusal_of(const LightPlan& plan);

}  // namespace gnomon::tool
