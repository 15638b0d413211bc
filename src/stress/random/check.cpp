// What a plan owes its caller, checked in long double against nothing but the case and the plan.
#include "check.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "geometry.hpp"
#include "gnomon/view.hpp"
#include "judge.hpp"

namespace gnomon::stress {

const std::vector<Kind>& all_kinds() {
  static const std::vector<Kind> kKinds{
      {"refused", "legal input is planned"},
      {"not_finite", "every number of a plan is finite"},
      {"floating_point_exception", "no step on the way divides by zero, overflows or is no number"},
      {"wrong_sign", "sizes, depths and errors have their sign and order"},
      {"depth_range_not_positive", "depth_range_world is above 0"},
      {"over_budget", "all maps together have no more texels than texel_budget"},
      {"error_above_prune_m", "a map is made smaller only as far as its error stays at or below prune_m"},
      {"nothing_visible_with_receiver", "nothing_visible means that no receiver is in view and lit"},
      {"no_caster_with_caster", "no_caster means that nothing can shadow a receiver in view"},
      {"no_map_with_caster", "a receiver that no map holds has no caster before it"},
      {"receiver_behind_map", "w is above 0 at every receiver that the map serves"},
      {"receiver_outside_map", "a visible receiver lies inside its map, off the filter margin"},
      {"receiver_outside_depths", "a visible receiver lies between the map's near and far plane"},
      {"caster_culled", "cull planes keep every caster between a visible receiver and the light"},
      {"caster_behind_map", "w is above 0 at every caster between a visible receiver and the light"},
      {"caster_before_near_plane", "such a caster lies behind the map's near plane"},
      {"caster_beyond_far_plane", "such a caster lies before the map's far plane"},
      {"local_nothing_visible_with_receiver", "the same under a spot or point light"},
      {"local_no_caster_with_caster", "the same under a spot or point light"},
      {"local_no_map_with_caster", "the same under a spot or point light"},
      {"local_caster_culled", "the same under a spot or point light"},
      {"local_caster_before_near_plane", "the same under a spot or point light"},
      {"matrices_disagree", "clip_from_world and clip_from_camera_relative show a point at one place"},
      {"metric_wrong", "measure_perspective is the metric's definition, to rounding"},
      {"texel_larger_than_largest", "no texel of a map's receivers is larger than texel_world_max"},
      {"empty_box_counts", "a box with min above max takes no part in anything"},
      {"measure_wrong", "measure() is the metric at the points of its grid"},
      {"pages_refused", "legal input is planned in pages"},
      {"lights_refused", "legal input is planned as one of many lights"},
      {"light_size_wrong",
       "maps of many lights have a size in its range, below the least only where none is above"},
      {"light_moves", "lights that rest keep their sizes and places"},
      {"light_late", "maps of many lights are due at once, and again after as many frames as they say"},
      {"light_plan_differs",
       "the plan of one of many lights has no more and no larger maps than it has places"},
      {"pool_exceeded", "pages and maps of many lights stay within their pool and their budget"},
      {"pool_place_taken", "each page and each map of a light has a place of its own in the pool"},
      {"point_without_page", "every visible point that the light can reach has a page"},
      {"page_stale",
       "an empty pool draws all pages, one that holds them none, and a page is drawn again where a "
       "caster moved"},
      {"page_above_target", "no more points than the plan says have pages that are coarser than its target"},
      {"views_refused", "legal input is planned for several cameras"},
      {"views_of_one_differ", "one camera alone has the plan of make_plan"},
      {"warp_worse_than_none", "a warp that may be dropped is not worse than none by the plan's objective"},
  };
  return kKinds;
}

void Counts::add(const Counts& other) {
  plans += other.plans;
  seen_plans += other.seen_plans;
  pages += other.pages;
  lights += other.lights;
  light_maps += other.light_maps;
  maps += other.maps;
  receivers += other.receivers;
  casters += other.casters;
  unmapped += other.unmapped;
  measured += other.measured;
  texels += other.texels;
  warps += other.warps;
  view_plans += other.view_plans;
  page_points += other.page_points;
}

void add_worst(std::vector<Finding>& findings, const Finding& finding) {
  for (Finding& f : findings) {
    if (f.kind != finding.kind) continue;
    if (finding.amount > f.amount) f = finding;
    return;
  }
  findings.push_back(finding);
}

void Report::add(std::string_view kind, double amount, const std::string& text) {
  add_worst(verdict_.findings, {kind, amount, std::string(words_) + text});
}

namespace {

std::string map_name(const ShadowMap& map) {
  return "map " + std::to_string(map.cascade) + " (" + std::string(map.warp->name) + ", " +
         std::to_string(map.width) + " x " + std::to_string(map.height) + ")";
}

std::string shown_number(double value) {
  std::ostringstream text;
  text.precision(6);
  text << value;
  return text.str();
}

void check_signs(const ShadowMap& map, Report& report) {
  const auto owe = [&](bool holds, const char* what, double value) {
    if (!holds)
      report.add("wrong_sign", std::abs(value), map_name(map) + ": " + what + " " + shown_number(value));
  };
  owe(map.width >= 1 && map.height >= 1, "width or height", map.width);
  owe(map.depth_begin <= map.depth_end, "depth_begin above depth_end", map.depth_begin);
  owe(map.texel_world.x > 0.0 && map.texel_world.y > 0.0, "texel_world", map.texel_world.x);
  // The centre is one of the places that the largest is taken over, but for rounding.
  constexpr double kRounding = 1e-9;
  owe(map.texel_world_max.x >= map.texel_world.x * (1.0 - kRounding), "texel_world_max.x",
      map.texel_world_max.x);
  owe(map.texel_world_max.y >= map.texel_world.y * (1.0 - kRounding), "texel_world_max.y",
      map.texel_world_max.y);
  owe(map.kappa >= 0.0, "kappa", map.kappa);
  owe(map.m_s_max > 0.0 && map.m_t_max > 0.0, "m_s_max", map.m_s_max);
  owe(map.filter_margin_texels >= 0 && 2 * map.filter_margin_texels < std::min(map.width, map.height),
      "filter_margin_texels", map.filter_margin_texels);
  owe(map.cull_plane_count >= 1 && map.cull_plane_count <= kMaxCullPlanes, "cull_plane_count",
      map.cull_plane_count);
}

}  // namespace

void check_numbers(const Case&, const ShadowPlan& plan, Report& report) {
  if (!all_finite(plan)) {
    report.add("not_finite", 1.0, "a plan of " + std::to_string(plan.map_count) + " maps");
    return;
  }
  for (const ShadowMap& map : plan.maps()) {
    check_signs(map, report);
    if (!(map.depth_range_world > 0.0))
      report.add("depth_range_not_positive", std::abs(map.depth_range_world),
                 map_name(map) + ": depth_range_world is " + shown_number(map.depth_range_world));
  }
}

namespace {

/// What the options say of sizes, read from the text: their names there are a contract.
void check_sizes(const nlohmann::ordered_json& value, const PlanOptions& read, const ShadowPlan& plan,
                 Report& report) {
  const auto options = value.find("options");
  if (options == value.end()) return;
  long long texels = 0;
  for (const ShadowMap& map : plan.maps()) texels += static_cast<long long>(map.width) * map.height;
  const long long budget = options->value("texel_budget", 0LL);
  // Other partitions than by depth do not heed a budget (ResolutionOptions::texel_budget).
  if (budget > 0 && texels > budget && !options->contains("partition"))
    report.add("over_budget", static_cast<double>(texels) / static_cast<double>(budget),
               std::to_string(texels) + " texels of " + std::to_string(budget));
  const int size = options->value("map_size", 1024);
  const double target = options->value("target_m", 0.0), prunes = options->value("prune_m", 1.0);
  const bool rule = read.prune.has(PruneRule::metric_resolution);
  const double most = !(target > 0.0) ? prunes : rule ? std::min(target, prunes) : target;
  for (const ShadowMap& map : plan.maps()) {
    // A map that is as large as it may be bounds nothing.
    const bool smaller = map.width < size || map.height < size;
    constexpr double kRounding = 1e-9;
    const bool shortest = std::min(map.width, map.height) <= 16;
    if (budget == 0 && smaller && !shortest && map.m_max > most * (1.0 + kRounding))
      report.add("error_above_prune_m", map.m_max / most,
                 map_name(map) + ": m is " + shown_number(map.m_max) + ", not " + shown_number(most));
  }
}

/// Plans, and reports exceptions and refusals. False where there is nothing to check.
bool planned(const Case& input, const gnomon::View& view, ShadowPlan& plan, double& milliseconds,
             Report& report) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  plan =
      quiet("make_plan", report, [&] { return make_plan(view, input.light, input.bounds(), input.options); });
  milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  report.counts().maps += plan.map_count;
  if (plan.status == PlanStatus::invalid_input) {
    report.add("refused", 1.0, std::string(plan.invalid_field));
    return false;
  }
  check_numbers(input, plan, report);
  return all_finite(plan);
}

/// The same with what a picture of the scene would show: depths, points, or both.
void check_seen(const nlohmann::ordered_json& value, const Case& input, std::span<const glm::dvec3> seen,
                Report& report) {
  // A picture shows no depth at or below 0: VisibleDepths do not count it.
  std::vector<glm::dvec3> points;
  VisibleDepths depths;
  const View camera(input.camera);
  for (const glm::dvec3& point : seen) {
    const auto depth = static_cast<double>(camera.depth(Real3(point) - camera.eye));
    if (!(depth > 0.0)) continue;
    points.push_back(point);
    depths.add(depth);
  }
  if (points.empty()) return;
  struct Variant {
    std::string_view words;
    bool depths, points;
  };
  for (const Variant& variant :
       {Variant{"with visible depths: ", true, false}, Variant{"with visible points: ", false, true},
        Variant{"with visible depths and points: ", true, true}}) {
    report.begin_with(variant.words);
    gnomon::View view{.camera = input.camera};
    if (variant.depths) view.depths = &depths;
    if (variant.points) view.points_world = points;
    ShadowPlan plan;
    double milliseconds = 0.0;
    ++report.counts().seen_plans;
    if (!planned(input, view, plan, milliseconds, report)) continue;
    check_sizes(value, input.options, plan, report);
    check_points(input, plan, points, report);
  }
  report.begin_with({});
}

}  // namespace

Verdict check_case(const nlohmann::ordered_json& value) {
  Verdict verdict;
  Report report(verdict);
  const Case input = read_case(value.dump());
  ShadowPlan plan;
  ++verdict.counts.plans;
  if (!planned(input, input.camera, plan, verdict.plan_ms, report)) return verdict;
  check_sizes(value, input.options, plan, report);
  const std::vector<glm::dvec3> seen = seen_places(input);
  check_points(input, plan, seen, report);
  check_metric(input, plan, report);
  check_warp(value, report);
  check_seen(value, input, seen, report);
  check_views(input, report);
  check_pages(input, seen, report);
  check_lights(input, seen, report);
  return verdict;
}

}  // namespace gnomon::stress
