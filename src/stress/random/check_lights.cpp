// Do many lights share a pool as promised: budgets, places, sizes, when each is due, and what its maps hold?
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "check.hpp"
#include "gnomon/lights.hpp"

namespace gnomon::stress {
namespace {

// Sums in another order are off by less.
constexpr double kSumRounding = 1e-9;
// Of lights whose own plans are looked at.
constexpr int kMostPlanned = 3;
// The side of the smallest maps under the default filter.
constexpr int kSmallest = 16;

/// The lights of a case, and the options that they share.
struct Pool {
  const Case& input;
  std::span<const glm::dvec3> points;
  std::vector<LightRequest> requests;
  LightOptions options;

  [[nodiscard]] int smallest() const {
    return options.page_budget > 0 ? std::max(kSmallest, options.page_texels) : kSmallest;
  }
  [[nodiscard]] double page_area() const {
    return static_cast<double>(options.page_texels) * options.page_texels;
  }
};

/// The case's own lights, or its light beside a sun.
Pool pool_of(const Case& input, std::span<const glm::dvec3> points) {
  Pool pool{input, points, input.lights, input.light_options};
  if (input.lights.empty()) {
    pool.requests = {{input.light}, {DirectionalLight{{0.25, -1.0, 0.5}}}};
    pool.options.pool_width = pool.options.pool_height = 2048;
    pool.options.most_size = 512;
    pool.options.texel_budget = 1 << 20;
  }
  pool.options.plan = input.options;
  pool.options.plan.filter = {};  // a kernel wider than a map is refused by name
  return pool;
}

/// A plan with the memory that its list lies in.
struct Planned {
  std::vector<std::byte> memory;
  LightPlan plan;
};
Planned planned(const Pool& pool, const LightOptions& options, LightHistory* history) {
  Planned result;
  result.memory.resize(light_memory(pool.requests.size(), pool.points.size()));
  result.plan = plan_lights({.camera = pool.input.camera, .points_world = pool.points}, pool.requests,
                            pool.input.bounds(), options, result.memory, history);
  return result;
}

bool overlap(const TexelRect& a, const TexelRect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

std::string of_light(std::size_t i, const Pool& pool) {
  return "light " + std::to_string(i) + " of " + std::to_string(pool.requests.size()) + ": ";
}

/// Whether a budget is too small for the smallest maps of all lights, by a plan without budgets.
bool too_small(const Pool& pool, std::string_view field) {
  LightOptions free = pool.options;
  free.texel_budget = kWholePool;
  free.page_budget = 0;
  free.millisecond_budget = 0.0;
  free.pool_width = free.pool_height = 1 << 16;
  const Planned all = planned(pool, free, nullptr);
  if (all.plan.status == PlanStatus::invalid_input) return false;
  const LightCosts& costs = pool.options.costs;
  const double square = static_cast<double>(pool.smallest()) * pool.smallest();
  double texels = 0.0, milliseconds = 0.0;
  for (std::size_t i = 0; i < all.plan.lights.size(); ++i) {
    const LightMaps& maps = all.plan.lights[i];
    const LightRequest& request = pool.requests[i];
    if (maps.map_count == 0) continue;
    texels += maps.map_count * square;
    milliseconds +=
        (maps.map_count * (costs.per_map + 1e-6 * costs.per_megatexel * square) +
         1e-3 * costs.per_kilodraw * request.draws + 1e-6 * costs.per_megatriangle * request.triangles) /
        maps.frames;
  }
  if (field == "lights.millisecond_budget")
    return milliseconds > pool.options.millisecond_budget * (1.0 - kSumRounding);
  if (field == "lights.page_budget" && texels > pool.options.page_budget * pool.page_area()) return true;
  const double area = static_cast<double>(pool.options.pool_width) * pool.options.pool_height;
  return (field == "lights.texel_budget" || field == "lights.page_budget") &&
         texels > std::min(area, static_cast<double>(pool.options.texel_budget));
}

/// Each map in the pool and alone there, as large as its light says; sums and budgets.
void check_places(const Pool& pool, const LightPlan& plan, Report& report) {
  const LightOptions& o = pool.options;
  std::vector<TexelRect> places;
  long long texels = 0;
  for (std::size_t i = 0; i < plan.lights.size(); ++i) {
    const LightMaps& maps = plan.lights[i];
    for (int k = 0; k < maps.map_count; ++k) {
      const TexelRect& place = maps.place[static_cast<std::size_t>(k)];
      texels += static_cast<long long>(place.width) * place.height;
      const bool inside = place.x >= 0 && place.y >= 0 && place.x + place.width <= o.pool_width &&
                          place.y + place.height <= o.pool_height && place.width == maps.size &&
                          place.height == maps.size;
      if (!inside || std::any_of(places.begin(), places.end(),
                                 [&](const TexelRect& other) { return overlap(place, other); }))
        report.add("pool_place_taken", place.x,
                   of_light(i, pool) + "its maps overlap others, or lie beside the pool");
      places.push_back(place);
    }
  }
  report.counts().light_maps += static_cast<long long>(places.size());
  const bool within = texels <= o.texel_budget && texels == plan.texels &&
                      (o.page_budget == 0 || static_cast<double>(texels) <= o.page_budget * pool.page_area());
  if (!within)
    report.add("pool_exceeded", static_cast<double>(texels),
               std::to_string(texels) + " texels of lights, said to be " + std::to_string(plan.texels));
  if (o.millisecond_budget > 0.0 && !(plan.milliseconds <= o.millisecond_budget * (1.0 + kSumRounding)))
    report.add("pool_exceeded", plan.milliseconds,
               std::to_string(plan.milliseconds) + " ms of " + std::to_string(o.millisecond_budget));
}

/// Sizes in their range, and below the least only where no light is above it.
void check_sizes(const Pool& pool, const LightPlan& plan, Report& report) {
  const int least = std::max(pool.options.least_size, pool.smallest());
  int smallest = pool.options.most_size, largest = 0, mapped = 0;
  for (std::size_t i = 0; i < plan.lights.size(); ++i) {
    const LightMaps& maps = plan.lights[i];
    const bool has = maps.map_count > 0;
    const bool named =
        (maps.outcome == LightOutcome::mapped || maps.outcome == LightOutcome::below_least_size);
    bool good = has == named && maps.share >= 0.0 && maps.share <= 1.0 && std::isfinite(maps.m);
    if (has) {
      ++mapped;
      smallest = std::min(smallest, maps.size);
      largest = std::max(largest, maps.size);
      good = good && maps.map_count <= kMaxMaps && std::has_single_bit(static_cast<unsigned>(maps.size)) &&
             maps.size >= pool.smallest() && maps.size <= pool.options.most_size && maps.frames >= 1 &&
             maps.frames <= pool.options.most_frames &&
             (maps.outcome == LightOutcome::below_least_size) == (maps.size < least);
    }
    if (!good)
      report.add("light_size_wrong", maps.size,
                 of_light(i, pool) + std::to_string(maps.map_count) + " maps of " +
                     std::to_string(maps.size) + ", every " + std::to_string(maps.frames) + " frames, m " +
                     std::to_string(maps.m));
  }
  if (mapped != plan.mapped || (mapped > 0 && smallest < least && largest > least))
    report.add("light_size_wrong", smallest,
               std::to_string(plan.mapped) + " lights with maps from " + std::to_string(smallest) + " to " +
                   std::to_string(largest) + ", the least size is " + std::to_string(least));
}

bool same(const LightMaps& a, const LightMaps& b) {
  return a.outcome == b.outcome && a.size == b.size && a.map_count == b.map_count && a.place == b.place &&
         a.share == b.share && a.m == b.m && a.frames == b.frames;
}

/// Frames in which nothing moves: all is as it was, but for sizes that lower the error, and each light is due
/// as often as it says.
void check_frames(const Pool& pool, const LightPlan& first, Report& report) {
  std::vector<LightState> states(pool.requests.size());
  LightHistory history{states, 0, {}, 0};
  int frames = 1;
  for (const LightMaps& maps : first.lights) frames = std::max(frames, maps.frames);
  std::vector<int> waited(pool.requests.size(), 0);
  for (int frame = 0; frame <= frames; ++frame) {
    const Planned now = planned(pool, pool.options, &history);
    bool still = now.plan.lights.size() == first.lights.size();
    for (std::size_t i = 0; still && i < first.lights.size(); ++i) {
      const LightMaps& maps = now.plan.lights[i];
      still = same(maps, first.lights[i]);
      waited[i] = maps.due ? 0 : waited[i] + 1;
      if (maps.map_count == 0) continue;
      if (frame == 0 ? !maps.due : waited[i] >= maps.frames)
        report.add("light_late", waited[i],
                   of_light(i, pool) + "not due for " + std::to_string(waited[i]) +
                       " frames, promised every " + std::to_string(maps.frames));
    }
    if (still) continue;
    // A search that ended before it had tried all sizes goes on from its last result.
    if (now.plan.error < first.error) return;
    report.add("light_moves", frame,
               "frame " + std::to_string(frame) + " of lights that rest has other maps than the first");
    return;
  }
}

/// What the light says of itself against what it can light, and its own plan.
void check_light(const Pool& pool, const LightPlan& plan, std::size_t i, Report& report) {
  const LightMaps& maps = plan.lights[i];
  Case own = pool.input;
  own.light = pool.requests[i].light;
  own.options = light_options(pool.options, maps);
  if (maps.map_count == 0) {
    ShadowPlan none;
    none.status =
        maps.outcome == LightOutcome::without_caster ? PlanStatus::no_caster : PlanStatus::nothing_visible;
    return check_points(own, none, pool.points, report);
  }
  const bool rests = maps.frames > 1;
  const Camera camera = rests ? camera_round(own.light, own.camera) : own.camera;
  const ShadowPlan shadows = quiet("make_plan", report, [&] {
    return make_plan({.camera = camera, .points_world = pool.points}, own.light, own.bounds(), own.options);
  });
  if (shadows.status == PlanStatus::invalid_input) {
    report.add("lights_refused", 1.0, std::string(shadows.invalid_field));
    return;
  }
  const bool fits = shadows.map_count <= maps.map_count &&
                    std::all_of(shadows.maps().begin(), shadows.maps().end(), [&](const ShadowMap& map) {
                      return map.width <= maps.size && map.height <= maps.size;
                    });
  if (!fits)
    report.add("light_plan_differs", shadows.map_count,
               std::to_string(shadows.map_count) + " maps, said to be " + std::to_string(maps.map_count) +
                   " of " + std::to_string(maps.size));
  check_points(own, rests ? as_seen_by(shadows, own.camera) : shadows, pool.points, report);
}

}  // namespace

void check_lights(const Case& input, std::span<const glm::dvec3> points, Report& report) {
  const Pool pool = pool_of(input, points);
  const Planned first = quiet("plan_lights", report, [&] { return planned(pool, pool.options, nullptr); });
  const LightPlan& plan = first.plan;
  if (plan.status == PlanStatus::invalid_input) {
    if (!too_small(pool, plan.invalid_field))
      report.add("lights_refused", 1.0, std::string(plan.invalid_field));
    return;
  }
  report.counts().lights += static_cast<long long>(plan.lights.size());
  check_places(pool, plan, report);
  check_sizes(pool, plan, report);
  check_frames(pool, plan, report);
  int shown = 0;
  for (std::size_t i = 0; i < plan.lights.size(); ++i) {
    if (plan.lights[i].map_count > 0 && ++shown > kMostPlanned) continue;
    const std::string words = of_light(i, pool);
    report.begin_with(words);
    check_light(pool, plan, i, report);
    report.begin_with({});
  }
}

}  // namespace gnomon::stress
