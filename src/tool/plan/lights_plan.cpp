// A plan of many lights of a case with its memory, and its JSON.
#include "lights_plan.hpp"

#include <algorithm>

namespace gnomon::tool {
namespace {

const char* name_of(LightOutcome outcome) noexcept {
  switch (outcome) {
    case LightOutcome::mapped:
      return "mapped";
    case LightOutcome::below_least_size:
      return "below_least_size";
    case LightOutcome::without_receiver:
      return "without_receiver";
    case LightOutcome::without_caster:
      break;
  }
  return "without_caster";
}

Json light_json(const LightMaps& maps, const LightOptions& options) {
  Json result{{"outcome", name_of(maps.outcome)}};
  if (maps.outcome != LightOutcome::mapped) {
    const OmissionText text = describe(maps, options);
    result["what"] = text.what.data();
    result["why"] = text.why.data();
  }
  result["size"] = maps.size;
  result["places"] = Json::array();
  for (int k = 0; k < maps.map_count; ++k) {
    const TexelRect& r = maps.place[static_cast<std::size_t>(k)];
    result["places"].push_back({r.x, r.y, r.width, r.height});
  }
  result["share"] = number(maps.share);
  result["m"] = number(maps.m);
  result["frames"] = maps.frames;
  return result;
}

}  // namespace

LightsPlanner::LightsPlanner(const Case& input)
    : input_(input),
      options_(input.light_options),
      // More lights are refused, and need no memory.
      memory_(light_memory(std::min(input.lights.size(), kMaxLights), input.seen.size())) {
  options_.plan = input.options;
}

LightPlan LightsPlanner::plan() noexcept {
  return plan_lights({.camera = input_.camera, .points_world = input_.seen}, input_.lights, input_.bounds(),
                     options_, memory_);
}

Json lights_json(const LightPlan& plan, const Case& input) {
  Json result{{"status", std::string(to_string(plan.status))}};
  if (plan.status != PlanStatus::ok) result["reason"] = reason_of(plan.status);
  result["pool"] = {plan.pool_width, plan.pool_height};
  result["texels"] = plan.texels;
  if (plan.pages > 0) result["pages"] = plan.pages;
  if (plan.milliseconds > 0.0) result["milliseconds"] = number(plan.milliseconds);
  result["error"] = number(plan.error);
  result["lights"] = Json::array();
  for (const LightMaps& maps : plan.lights) result["lights"].push_back(light_json(maps, input.light_options));
  return result;
}

std::string refusal_of(const LightPlan& plan) {
  const std::string text = invalid_input_text(plan.invalid_field);
  constexpr std::string_view kLight = "light";
  if (plan.invalid_light < 0 || !text.starts_with(kLight)) return text;
  return "lights[" + std::to_string(plan.invalid_light) + "]" + text.substr(kLight.size());
}

}  // namespace gnomon::tool
