// A page plan of a case with its memory, and its JSON.
#include "pages_plan.hpp"

namespace gnomon::tool {
namespace {

// Samples of the receivers' boxes where a case names no visible points.
constexpr std::size_t kSamples = std::size_t{1} << 17;

gnomon::View view_of(const Case& input) noexcept {
  return {.camera = input.camera, .points_world = input.seen, .normals_world = input.seen_normals};
}

Json level_json(const ShadowMap& level) {
  return {{"clip_from_world", rows_of(level.clip_from_world)},
          {"size", {level.width, level.height}},
          {"shape", std::string(level.shape->name)},
          {"face", level.cascade},
          {"texel_world", {level.texel_world.x, level.texel_world.y}},
          {"bias_world",
           {{"constant", level.bias_world.constant},
            {"slope", level.bias_world.slope},
            {"normal_offset", level.bias_world.normal_offset}}}};
}

Json stats_json(const PageStats& stats) {
  return {{"p50", number(stats.m.p50)},           {"p95", number(stats.m.p95)},
          {"max", number(stats.m.max)},           {"storage", number(stats.m.storage)},
          {"side_max", number(stats.worst_side)}, {"side_p95", number(stats.p95_side)}};
}

}  // namespace

PagePlanner::PagePlanner(const Case& input)
    : input_(input),
      options_(*input.pages),
      memory_(page_memory(input.pages->capacity, input.seen.empty() ? kSamples : input.seen.size())) {
  options_.plan = input.options;
}

PagePlan PagePlanner::plan() noexcept {
  const PageHistory history{nullptr, input_.seen_feedback};
  return plan_pages(view_of(input_), input_.light, input_.bounds(), options_, memory_, &history);
}

Json pages_json(const PagePlan& plan, const Case& input) {
  Json result{{"status", std::string(to_string(plan.status))}};
  if (plan.status != PlanStatus::ok) result["reason"] = reason_of(plan.status);
  result["policy"] = std::string(plan.policy->name);
  result["levels"] = Json::array();
  for (const ShadowMap& level : plan.levels) result["levels"].push_back(level_json(level));
  result["page_texels"] = plan.page_texels;
  result["border_texels"] = plan.border_texels;
  result["capacity"] = plan.capacity;
  result["target_m"] = plan.target_m;
  result["pages"] = Json::array();
  for (const Page& page : plan.pages) result["pages"].push_back({page.level, page.column, page.row});
  result["points"] = {{"served", plan.points},
                      {"outside", plan.points_outside},
                      {"coarser", plan.points_coarser},
                      {"beyond_levels", plan.points_capped}};
  result["omitted"] = omitted_json(plan.omitted());
  const PageStats stats = measure(plan, view_of(input), input.bounds());
  result["texels_per_pixel"] = number(stats.texels_per_pixel);
  result["border_share"] = number(stats.border_share);
  result["m"] = stats_json(stats);
  return result;
}

}  // namespace gnomon::tool
