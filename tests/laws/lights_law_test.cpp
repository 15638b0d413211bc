// Laws of every plan of many lights: places, budgets, errors, and what is due when.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "gnomon/lights.hpp"
#include "lights/sizes.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A case with lights of all kinds about what the camera sees.
struct Scene {
  Case input;
  std::vector<glm::dvec3> points;
  std::vector<LightRequest> lights;
  LightOptions options;

  [[nodiscard]] LightPlan plan(std::span<std::byte> memory, LightHistory* history = nullptr) const {
    return plan_lights(input.camera, lights, input.bounds(), options, memory, history);
  }
};

Light draw_light(const Camera& camera, Random& random) {
  const double depth =
      camera.near_depth + (camera.far_depth - camera.near_depth) * std::pow(random.unit(), 2.0);
  const double extent = camera.orthographic ? camera.top - camera.bottom : depth;
  const glm::dvec3 at = point_at(camera, random.between(-1.2, 1.2), random.between(-1.2, 1.2), depth) +
                        random.direction() * extent * random.between(0.0, 0.3);
  const double range = extent * std::exp2(random.between(-3.0, 1.0));
  if (random.unit() < 0.5) return PointLight{at, range};
  return SpotLight{at, random.direction(), random.between(0.05, 3.0), range};
}

Scene draw_scene(int most_lights) {
  Scene s;
  CaseLimits limits;
  limits.max_depth_ratio = 1e3;
  limits.max_boxes = 12;
  s.input = draw_case(limits);
  Random random(static_cast<std::uint64_t>(pick(1 << 20)));
  s.points = visible_points(s.input, random, 6, 8);
  const int count = 1 + pick(most_lights);
  for (int i = 0; i < count; ++i)
    s.lights.push_back({draw_light(s.input.camera, random), std::exp2(random.between(-2.0, 2.0))});
  if (chance(0.5)) s.lights[0].light = DirectionalLight{s.input.light};
  s.options.pool_width = 1024 << pick(3);
  s.options.pool_height = 1024 << pick(3);
  s.options.most_size = 256 << pick(3);
  s.options.least_size = 16 << pick(4);
  s.options.most_frames = 1 + pick(9);
  if (chance(0.3)) s.options.enough_m = std::exp2(between(-2.0, 3.0));
  s.options.plan.filter.texels = pick(4);
  return s;
}

/// Whether the light lights the point: within its range and cone, by a share that rounding does not decide.
bool lights_point(const Light& light, const glm::dvec3& point) {
  constexpr double kInside = 1.0 - 1e-6;
  if (std::holds_alternative<DirectionalLight>(light)) return true;
  if (const auto* point_light = std::get_if<PointLight>(&light))
    return glm::distance(point_light->position, point) < kInside * point_light->range;
  const SpotLight spot = *std::get_if<SpotLight>(&light);
  const glm::dvec3 offset = point - spot.position;
  const double distance = glm::length(offset);
  if (!(distance < kInside * spot.range && distance > 0.0)) return false;
  const double cosine = glm::dot(offset, spot.direction) / distance / glm::length(spot.direction);
  return std::acos(std::clamp(cosine, -1.0, 1.0)) < kInside * spot.outer_radians;
}

void require_places(const LightPlan& plan, const LightOptions& options) {
  std::vector<TexelRect> all;
  std::int64_t texels = 0;
  for (const LightMaps& maps : plan.lights) {
    require((maps.size > 0) == (maps.map_count > 0), "size without maps", maps.size, maps.map_count);
    for (int k = 0; k < maps.map_count; ++k) {
      const TexelRect& r = maps.place[static_cast<std::size_t>(k)];
      require(r.width == maps.size && r.height == maps.size, "another size", r.width, maps.size);
      require(r.x >= 0 && r.y >= 0 && r.x + r.width <= options.pool_width &&
                  r.y + r.height <= options.pool_height,
              "beside the pool", r.x, r.y, r.width);
      texels += std::int64_t{r.width} * r.height;
      all.push_back(r);
    }
  }
  require(texels == plan.texels, "counted", plan.texels, "placed", texels);
  require(texels <= options.texel_budget, "above the budget", texels);
  std::sort(all.begin(), all.end(), [](const TexelRect& a, const TexelRect& b) { return a.x < b.x; });
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = i + 1; k < all.size() && all[k].x < all[i].x + all[i].width; ++k) {
      require(all[k].y >= all[i].y + all[i].height || all[i].y >= all[k].y + all[k].height, "overlap",
              all[i].x, all[i].y, all[k].x, all[k].y);
    }
  }
}

bool small_budget(const LightPlan& plan) {
  return plan.invalid_field == "lights.texel_budget" || plan.invalid_field == "lights.page_budget" ||
         plan.invalid_field == "lights.millisecond_budget";
}

/// Prices of about a millisecond per map of 1024 texels, in any proportion.
LightCosts draw_costs() {
  return {between(0.0, 0.1), between(0.01, 3.0), between(0.0, 2.0), between(0.0, 2.0)};
}
void draw_work_of_lights(Scene& scene) {
  for (LightRequest& light : scene.lights) {
    light.draws = std::floor(between(0.0, 100.0));
    light.triangles = std::floor(between(0.0, 1e5));
  }
}

/// The price of a plan, light by light, as the header states it.
double milliseconds_of(const Scene& scene, const LightPlan& plan) {
  const LightCosts& costs = scene.options.costs;
  double sum = 0.0;
  for (std::size_t i = 0; i < plan.lights.size(); ++i) {
    const LightMaps& maps = plan.lights[i];
    if (maps.map_count == 0) continue;
    const double texels = static_cast<double>(maps.size) * maps.size * maps.map_count;
    sum += (costs.per_map * maps.map_count + costs.per_megatexel * texels * 1e-6 +
            costs.per_kilodraw * scene.lights[i].draws * 1e-3 +
            costs.per_megatriangle * scene.lights[i].triangles * 1e-6) /
           maps.frames;
  }
  return sum;
}

TEST(LightsLaw, every_light_in_view_has_maps_and_places_never_overlap) {
  int lit = 0, fewer = 0, round = 0;
  for_all(400, [&] {
    Scene scene = draw_scene(60);
    scene.options.texel_budget = static_cast<std::int64_t>(std::exp2(between(16.0, 24.0)));
    std::vector<std::byte> memory(light_memory(scene.lights.size(), 0));
    const LightPlan plan = scene.plan(memory);
    if (small_budget(plan)) return;
    require(plan.status != PlanStatus::invalid_input, "refused", plan.invalid_field);
    require_places(plan, scene.options);
    const bool scarce = std::any_of(plan.lights.begin(), plan.lights.end(), [](const LightMaps& maps) {
      return maps.outcome == LightOutcome::below_least_size;
    });
    std::int64_t least = 0;
    for (const LightMaps& maps : plan.lights) {
      least += std::int64_t{scene.options.least_size} * scene.options.least_size * maps.map_count;
      require(maps.outcome != LightOutcome::mapped || maps.size >= scene.options.least_size, "small",
              maps.size);
    }
    const std::int64_t pool = std::int64_t{scene.options.pool_width} * scene.options.pool_height;
    require(scarce == (least > std::min(scene.options.texel_budget, pool)), "scarce", scarce, least);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
      const LightMaps& maps = plan.lights[i];
      require(!scarce || maps.size <= scene.options.least_size, "above the floor while others are below");
      const Light& light = scene.lights[i].light;
      if (maps.outcome == LightOutcome::below_least_size) ++fewer;
      if (maps.map_count == 0) {
        if (maps.outcome == LightOutcome::without_caster) continue;
        for (const glm::dvec3& point : scene.points) require(!lights_point(light, point), "starves", i);
        continue;
      }
      ++lit;
      require(maps.share >= 0.0 && maps.share <= 1.0 && std::isfinite(maps.m), "share", maps.share, maps.m);
      const PlanOptions options = light_options(scene.options, maps);
      const ShadowPlan own = make_plan(scene.input.camera, light, scene.input.bounds(), options);
      require(own.status != PlanStatus::invalid_input, "own plan refused", own.invalid_field);
      require(maps.frames > 1 || own.map_count <= maps.map_count, "more maps than places", i, own.map_count,
              maps.map_count);
      if (maps.frames == 1) continue;
      ++round;
      const ShadowPlan whole =
          make_plan(camera_round(light, scene.input.camera), light, scene.input.bounds(), options);
      require(whole.status != PlanStatus::invalid_input && whole.map_count <= maps.map_count,
              "more maps than places", whole.map_count, maps.map_count);
    }
  });
  EXPECT_GT(lit, of_all_draws(1000));
  EXPECT_GT(fewer, of_all_draws(10));
  EXPECT_GT(round, of_all_draws(300));
}

TEST(LightsLaw, equal_input_gives_equal_plans_at_any_scale_of_the_world) {
  int compared = 0;
  for_all(150, [&] {
    const Scene scene = draw_scene(40);
    Scene scaled = scene;
    const double scale = std::exp2(pick(41) - 20);
    Camera& camera = scaled.input.camera;
    camera.position *= scale;
    camera.near_depth *= scale;
    camera.far_depth *= scale;
    if (camera.orthographic) {
      for (double* edge : {&camera.left, &camera.right, &camera.bottom, &camera.top}) *edge *= scale;
    }
    for (std::vector<Box>* boxes : {&scaled.input.casters, &scaled.input.receivers}) {
      for (Box& box : *boxes) box = {box.min * scale, box.max * scale};
    }
    for (LightRequest& request : scaled.lights) {
      if (auto* spot = std::get_if<SpotLight>(&request.light)) {
        spot->position *= scale;
        spot->range *= scale;
      } else if (auto* point = std::get_if<PointLight>(&request.light)) {
        point->position *= scale;
        point->range *= scale;
      }
    }
    std::vector<std::byte> memory(light_memory(scene.lights.size(), 0)), other = memory;
    const LightPlan a = scene.plan(memory), b = scaled.plan(other);
    require(a.status == b.status && a.texels == b.texels && a.lights.size() == b.lights.size(), "texels",
            a.texels, b.texels);
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
      const LightMaps &x = a.lights[i], &y = b.lights[i];
      require(x.outcome == y.outcome && x.size == y.size && x.map_count == y.map_count &&
                  x.place == y.place && x.frames == y.frames && x.due == y.due,
              "light", i, x.size, y.size);
      require(std::abs(x.m - y.m) <= 1e-9 * x.m && std::abs(x.share - y.share) <= 1e-9, "m", x.m, y.m);
      compared += x.size > 0;
    }
  });
  EXPECT_GT(compared, of_all_draws(300));
}

TEST(LightsLaw, more_texels_never_raise_the_error) {
  int compared = 0;
  for_all(200, [&] {
    Scene scene = draw_scene(60);
    double last = std::numeric_limits<double>::infinity();
    std::vector<std::byte> memory(light_memory(scene.lights.size(), 0));
    for (double budget = 1 << 14; budget < 1 << 24; budget *= between(1.02, 1.6)) {
      scene.options.texel_budget = static_cast<std::int64_t>(budget);
      const LightPlan plan = scene.plan(memory);
      if (plan.status != PlanStatus::ok) continue;
      require(plan.error <= last * (1.0 + 1e-9), "budget", budget, "error", plan.error, "before", last);
      last = plan.error;
      ++compared;
    }
  });
  EXPECT_GT(compared, of_all_draws(1000));
}

TEST(LightsLaw, budgets_of_pages_and_milliseconds_are_kept_and_no_light_starves) {
  int by_pages = 0, by_time = 0;
  for_all(500, [&] {
    Scene scene = draw_scene(60);
    draw_work_of_lights(scene);
    scene.options.costs = draw_costs();
    const bool pages = chance(0.5);
    if (pages) {
      scene.options.page_texels = 16 << pick(5);
      scene.options.page_budget = 1 + static_cast<int>(std::exp2(between(0.0, 12.0)));
    }
    if (!pages || chance(0.3)) scene.options.millisecond_budget = std::exp2(between(-6.0, 5.0));
    std::vector<std::byte> memory(light_memory(scene.lights.size(), 0));
    const LightPlan plan = scene.plan(memory);
    if (small_budget(plan)) return;
    require(plan.status != PlanStatus::invalid_input, "refused", plan.invalid_field);
    require_places(plan, scene.options);
    const double milliseconds = milliseconds_of(scene, plan);
    require(std::abs(plan.milliseconds - milliseconds) <= 1e-9 * (1.0 + milliseconds), "another sum",
            plan.milliseconds, milliseconds);
    if (pages) {
      std::int64_t covered = 0;
      for (const LightMaps& maps : plan.lights) {
        if (maps.map_count == 0) continue;
        require(maps.size % scene.options.page_texels == 0, "shares a page", maps.size);
        const std::int64_t across = maps.size / scene.options.page_texels;
        covered += across * across * maps.map_count;
      }
      require(covered <= scene.options.page_budget, "above the budget of pages", covered);
      require(covered == plan.pages, "pages counted", covered, plan.pages);
      by_pages += plan.mapped > 1;
    }
    if (scene.options.millisecond_budget > 0.0) {
      require(plan.milliseconds <= scene.options.millisecond_budget, "above the budget of milliseconds",
              plan.milliseconds, scene.options.millisecond_budget);
      by_time += plan.mapped > 1;
    }
    for (const LightMaps& maps : plan.lights) {
      const bool mapped =
          maps.outcome == LightOutcome::mapped || maps.outcome == LightOutcome::below_least_size;
      require(mapped == (maps.map_count > 0 && maps.size > 0), "starves");
    }
  });
  EXPECT_GT(by_pages, of_all_draws(50));
  EXPECT_GT(by_time, of_all_draws(50));
}

TEST(LightsLaw, more_pages_or_milliseconds_never_raise_the_error) {
  int pages_compared = 0, time_compared = 0, gained = 0;
  for_all(150, [&] {
    Scene scene = draw_scene(60);
    draw_work_of_lights(scene);
    scene.options.costs = draw_costs();
    const bool pages = chance(0.4);
    scene.options.page_texels = 16 << pick(4);
    double last = std::numeric_limits<double>::infinity(), first = 0.0;
    std::vector<std::byte> memory(light_memory(scene.lights.size(), 0));
    for (double budget = pages ? 16.0 : 0.02; budget < (pages ? 5e4 : 300.0); budget *= between(1.02, 1.6)) {
      if (pages)
        scene.options.page_budget = static_cast<int>(budget);
      else
        scene.options.millisecond_budget = budget;
      const LightPlan plan = scene.plan(memory);
      if (plan.status != PlanStatus::ok) continue;
      require(plan.error <= last * (1.0 + 1e-9), "budget", budget, "error", plan.error, "before", last);
      if (first == 0.0) first = plan.error;
      last = plan.error;
      ++(pages ? pages_compared : time_compared);
    }
    gained += first > 1.1 * last;
  });
  EXPECT_GT(pages_compared, of_all_draws(300));
  EXPECT_GT(time_compared, of_all_draws(1000));
  EXPECT_GT(gained, of_all_draws(80));
}

/// Demands and maps of lights, from a seed.
std::vector<LightWork> draw_work(int count, const SizeLadder& ladder) {
  std::vector<LightWork> work;
  Random random(static_cast<std::uint64_t>(pick(1 << 20)));
  for (int i = 0; i < count; ++i) {
    const int maps = random.unit() < 0.4 ? 1 : 1 + static_cast<int>(random.unit() * 6.0);
    work.push_back(
        {std::exp2(random.between(-8.0, 8.0)), 0.0, static_cast<std::uint32_t>(i), maps, 0, ladder.top, 0});
  }
  return work;
}
double error_of(const std::vector<LightWork>& work, const SizeLadder& ladder) {
  double sum = 0.0;
  for (const LightWork& light : work) sum += light.demand / ladder.inside(light.level);
  return sum;
}

/// The least error of all sizes from the floor to the top.
double brute_force(const std::vector<LightWork>& work, const SizeLadder& ladder, std::size_t from,
                   const SizeBudget& left, double error, double best) {
  if (left.cells < 0 || left.milliseconds < 0.0 || error >= best) return best;
  if (from == work.size()) return error;
  for (int level = ladder.top; level >= ladder.floor; --level) {
    const auto squares = static_cast<double>(SizeLadder::cells(level));
    const SizeBudget rest{left.cells - work[from].maps * SizeLadder::cells(level),
                          left.milliseconds - work[from].fixed - work[from].price * squares};
    best = brute_force(work, ladder, from + 1, rest, error + work[from].demand / ladder.inside(level), best);
  }
  return best;
}

TEST(LightsLaw, eight_lights_are_within_five_percent_of_all_sizes_tried) {
  const SizeLadder ladder{16, 2, 6, 1.0};
  int compared = 0;
  double worst = 0.0;
  for_all(150, [&] {
    std::vector<LightWork> work = draw_work(8, ladder);
    const auto cells = static_cast<std::int64_t>(std::exp2(between(9.0, 16.0)));
    if (!choose_sizes(work, ladder, {cells}, 1.0)) return;
    if (std::any_of(work.begin(), work.end(), [&](const LightWork& l) { return l.level < ladder.floor; }))
      return;
    const double best = brute_force(work, ladder, 0, {cells}, 0.0, std::numeric_limits<double>::infinity());
    const double ratio = error_of(work, ladder) / best;
    worst = std::max(worst, ratio);
    require(ratio <= 1.05, "error over the best", ratio);
    ++compared;
  });
  EXPECT_GT(compared, of_all_draws(100));
  RecordProperty("worst", std::to_string(worst));
}

TEST(LightsLaw, eight_lights_in_a_budget_of_milliseconds_are_within_five_percent_of_all_sizes_tried) {
  const SizeLadder ladder{16, 2, 6, 1.0};
  int compared = 0, scarce = 0;
  double worst = 0.0;
  for_all(150, [&] {
    std::vector<LightWork> work = draw_work(8, ladder);
    for (LightWork& light : work) {
      // Lights that are due less often cost less.
      light.price = 1e-3 * light.maps / (1 << pick(4));
      light.fixed = between(0.0, 0.05);
    }
    const SizeBudget budget{static_cast<std::int64_t>(std::exp2(between(11.0, 17.0))),
                            std::exp2(between(-1.0, 6.0))};
    if (!choose_sizes(work, ladder, budget, 1.0)) return;
    if (std::any_of(work.begin(), work.end(), [&](const LightWork& l) { return l.level < ladder.floor; }))
      return;
    require(gnomon::milliseconds_of(work) <= budget.milliseconds, "above the budget");
    const double best = brute_force(work, ladder, 0, budget, 0.0, std::numeric_limits<double>::infinity());
    const double ratio = error_of(work, ladder) / best;
    worst = std::max(worst, ratio);
    require(ratio <= 1.05, "error over the best", ratio);
    ++compared;
    std::vector<LightWork> free = work;
    scarce += choose_sizes(free, ladder, {budget.cells}, 1.0) &&
              error_of(free, ladder) < 0.99 * error_of(work, ladder);
  });
  EXPECT_GT(compared, of_all_draws(80));
  EXPECT_GT(scarce, of_all_draws(20)) << "cases in which time decides";
  RecordProperty("worst", std::to_string(worst));
}

TEST(LightsLaw, many_lights_are_no_worse_than_equal_sizes) {
  const SizeLadder ladder{16, 0, 6, 1.0};
  for_all(100, [&] {
    std::vector<LightWork> work = draw_work(20 + pick(100), ladder);
    const auto cells = static_cast<std::int64_t>(std::exp2(between(11.0, 17.0)));
    if (!choose_sizes(work, ladder, {cells}, 1.0)) return;
    std::vector<LightWork> equal = work;
    std::int64_t used = 0, maps = 0;
    for (const LightWork& light : work) {
      used += light.maps * SizeLadder::cells(light.level);
      maps += light.maps;
    }
    require(used <= cells, "above the budget", used, cells);
    int level = 0;
    while (level < ladder.top && maps * SizeLadder::cells(level + 1) <= cells) ++level;
    for (LightWork& light : equal) light.level = level;
    require(error_of(work, ladder) <= error_of(equal, ladder) * (1.0 + 1e-9), "worse than equal sizes");
  });
}

TEST(LightsLaw, over_a_flight_kept_maps_stay_and_none_is_older_than_its_interval) {
  int kept = 0, repacked = 0, moved = 0;
  for_all(150, [&] {
    Scene scene = draw_scene(60);
    std::vector<LightState> states(scene.lights.size());
    LightHistory history{states, 0, {}};
    std::vector<std::byte> memory(light_memory(scene.lights.size(), 0));
    std::vector<LightMaps> last;
    std::vector<int> age(scene.lights.size(), 0);
    const glm::dvec3 step =
        camera_axes(scene.input.camera).forward * scene.input.camera.far_depth * between(0.0, 0.02);
    for (int frame = 0; frame < 24; ++frame) {
      const std::size_t mover = static_cast<std::size_t>(pick(static_cast<int>(scene.lights.size())));
      bool is_local = false;
      if (auto* point = std::get_if<PointLight>(&scene.lights[mover].light)) {
        point->position += step * 0.1 + point->range * 0.01;
        is_local = true;
      }
      const LightPlan plan = scene.plan(memory, &history);
      if (small_budget(plan)) return;
      require(plan.status != PlanStatus::invalid_input, "refused", plan.invalid_field);
      require_places(plan, scene.options);
      repacked += plan.repacked;
      for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        const LightMaps& maps = plan.lights[i];
        age[i] = maps.due || maps.map_count == 0 ? 0 : age[i] + 1;
        require(age[i] < maps.frames, "older than its interval", age[i], maps.frames);
        if (maps.map_count == 0 || maps.due) continue;
        ++kept;
        require(!last.empty() && last[i].size == maps.size && last[i].place == maps.place, "moved, not due",
                i);
      }
      if (is_local && plan.lights[mover].map_count > 0) {
        ++moved;
        require(plan.lights[mover].due, "a moved light waits", mover);
      }
      last.assign(plan.lights.begin(), plan.lights.end());
      scene.input.camera.position += step;
    }
  });
  EXPECT_GT(kept, of_all_draws(1000));
  EXPECT_GT(moved, of_all_draws(50));
  RecordProperty("repacked", repacked);
}

TEST(LightsLaw, states_that_were_copied_share_no_place) {
  for_all(40, [&] {
    const Scene scene = draw_scene(40);
    std::vector<LightState> states(scene.lights.size());
    LightHistory history{states, 0, {}};
    std::vector<std::byte> memory(light_memory(scene.lights.size(), 0));
    const LightPlan first = scene.plan(memory, &history);
    if (first.status != PlanStatus::ok) return;
    std::fill(states.begin(), states.end(), states[states.size() / 2]);
    require_places(scene.plan(memory, &history), scene.options);
  });
}

/// A ground with a box on it, and a camera that sees both.
struct Ground {
  std::vector<Box> boxes{{{-50, -1, -50}, {50, 0, 50}}, {{-1, 0, -1}, {1, 3, 1}}};
  Camera camera = perspective_camera({0, 5, 20}, {0, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, 0.1, 100.0, 640, 480);
  [[nodiscard]] LightPlan plan(const std::vector<LightRequest>& lights, const LightOptions& options,
                               std::span<std::byte> memory,
                               const std::vector<glm::dvec3>& points = {}) const {
    return plan_lights({.camera = camera, .points_world = points}, lights, {boxes, boxes}, options, memory);
  }
};

TEST(Lights, broken_input_comes_back_as_a_status) {
  const Ground ground;
  const PointLight good{{0, 5, 0}, 20.0};
  const auto status = [&](std::vector<LightRequest> lights, LightOptions options = {}, std::size_t room = 4) {
    std::vector<std::byte> memory(light_memory(room, room));
    return ground.plan(lights, options, memory);
  };
  EXPECT_EQ(status({}).status, PlanStatus::nothing_visible);
  EXPECT_EQ(status({{good}}).status, PlanStatus::ok);
  EXPECT_EQ(status({{PointLight{{0, 500, 0}, 20.0}}}).status, PlanStatus::nothing_visible);
  EXPECT_EQ(status({{good}, {PointLight{{0, kNan, 0}, 20.0}}}).invalid_field, "light.position");
  EXPECT_EQ(status({{good}, {PointLight{{0, kNan, 0}, 20.0}}}).invalid_light, 1);
  EXPECT_EQ(status({{PointLight{{0, 5, 0}, 0.0}}}).invalid_field, "light.range");
  EXPECT_EQ(status({{SpotLight{{0, 5, 0}, {0, 0, 0}, 0.5, 10.0}}}).invalid_field, "light.direction");
  EXPECT_EQ(status({{good, kNan}}).invalid_field, "light.weight");
  EXPECT_EQ(status({{good, -1.0}}).invalid_field, "light.weight");
  EXPECT_EQ(status(std::vector<LightRequest>(10000, {good}), {}, 10000).invalid_field, "lights");
  EXPECT_EQ(status(std::vector<LightRequest>(10, {good})).invalid_field, "memory");
  const std::vector<glm::dvec3> points = {{0, 0, 0}}, normals = {{0, 2, 0}};
  const View view{.camera = ground.camera, .points_world = points, .normals_world = normals};
  const std::vector<LightRequest> one = {{good}};
  std::vector<std::byte> memory(light_memory(1, 1));
  EXPECT_EQ(plan_lights(view, one, {ground.boxes, ground.boxes}, {}, memory).invalid_field,
            "view.normals_world");
  const auto with = [](auto&& change) {
    LightOptions options;
    change(options);
    return options;
  };
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.texel_budget = 0; })).invalid_field,
            "lights.texel_budget");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.texel_budget = 100; })).invalid_field,
            "lights.texel_budget");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.page_budget = -1; })).invalid_field,
            "lights.page_budget");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.page_budget = 2; })).invalid_field,
            "lights.page_budget")
      << "six faces want six pages";
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) {
                     o.page_budget = 100;
                     o.page_texels = 100;
                   }))
                .invalid_field,
            "lights.page_texels");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) {
                     o.page_budget = 100;
                     o.page_texels = 2048;
                   }))
                .invalid_field,
            "lights.page_texels");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.millisecond_budget = kNan; })).invalid_field,
            "lights.millisecond_budget");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) {
                     o.millisecond_budget = 0.001;
                     o.costs.per_map = 1.0;
                   }))
                .invalid_field,
            "lights.millisecond_budget");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.costs.per_megatexel = -1.0; })).invalid_field,
            "lights.costs");
  EXPECT_EQ(status({{good, 1.0, false, kNan}}).invalid_field, "light.draws");
  EXPECT_EQ(status({{good, 1.0, false, 1.0, -1.0}}).invalid_field, "light.triangles");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.pool_width = 1000; })).invalid_field,
            "lights.pool_width, lights.pool_height");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.pool_height = 0; })).invalid_field,
            "lights.pool_width, lights.pool_height");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.most_size = 1000; })).invalid_field,
            "lights.most_size");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.least_size = 2048; })).invalid_field,
            "lights.least_size");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.most_frames = 0; })).invalid_field,
            "lights.most_frames");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.full_share = kNan; })).invalid_field,
            "lights.full_share");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.enough_m = kNan; })).invalid_field,
            "lights.enough_m");
  EXPECT_EQ(status({{good}}, with([](LightOptions& o) { o.keep_gain = 0.5; })).invalid_field,
            "lights.keep_gain");
}

TEST(Lights, a_light_without_casters_or_receivers_is_listed_with_the_reason) {
  Ground ground;
  const std::vector<Box> receivers{ground.boxes[0]}, casters{ground.boxes[1]};
  const std::vector<LightRequest> lights{
      {PointLight{{0, 5, 0}, 20.0}}, {PointLight{{30, 2, 0}, 4.0}}, {PointLight{{0, 5, 40}, 10.0}}};
  std::vector<std::byte> memory(light_memory(3, 0));
  const LightPlan plan = plan_lights(ground.camera, lights, {casters, receivers}, {}, memory);
  EXPECT_EQ(plan.lights[0].outcome, LightOutcome::mapped);
  EXPECT_EQ(plan.lights[1].outcome, LightOutcome::without_receiver);
  EXPECT_EQ(plan.lights[2].outcome, LightOutcome::without_receiver);
  const std::vector<LightRequest> far{{PointLight{{8, 2, 0}, 4.0}}};
  const LightPlan dark = plan_lights(ground.camera, far, {casters, receivers}, {}, memory);
  EXPECT_EQ(dark.status, PlanStatus::no_caster);
  EXPECT_EQ(dark.lights[0].outcome, LightOutcome::without_caster);
  EXPECT_STREQ(describe(dark.lights[0], {}).why.data(), "no caster lies within the light's range and cone");
}

TEST(Lights, no_light_grows_above_the_floor_while_another_is_below) {
  const SizeLadder ladder{16, 1, 3, 1.0};
  std::vector<LightWork> work{{1.0, 0.0, 0, 6, 0, 3, 0}, {100.0, 0.0, 1, 1, 0, 3, 0}};
  // One square less than the six maps of the first need; the second could take twelve of them.
  ASSERT_TRUE(choose_sizes(work, ladder, {7 + 3 + 17}, 1.0));
  EXPECT_EQ(work[0].level, 0);
  EXPECT_EQ(work[1].level, 1);
  ASSERT_TRUE(choose_sizes(work, ladder, {7 + 3 + 18 + 12}, 1.0));
  EXPECT_EQ(work[0].level, 1);
  EXPECT_EQ(work[1].level, 2);
  EXPECT_FALSE(choose_sizes(work, ladder, {6}, 1.0));
}

TEST(Lights, a_light_without_demand_keeps_the_floor_and_keeps_no_other_there) {
  const SizeLadder ladder{16, 1, 6, 1.0};
  for (const std::uint32_t count : {7u, 40u}) {  // searched for, and by steps alone
    std::vector<LightWork> work;
    for (std::uint32_t i = 0; i < count; ++i) work.push_back({i == 2 ? 0.0 : 3.7, 0.0, i, 4, 0, 6, 0});
    const SizeBudget budget{static_cast<std::int64_t>(count) * 4 * SizeLadder::cells(5)};
    ASSERT_TRUE(choose_sizes(work, ladder, budget, 1.25));
    EXPECT_EQ(work[2].level, ladder.floor) << count;
    std::vector<int> levels;
    for (LightWork& light : work) levels.push_back(light.last = light.level);
    EXPECT_GE(*std::min_element(levels.begin() + 3, levels.end()), 5) << count;
    // The sums are rounded in another way, and say the same.
    ASSERT_TRUE(choose_sizes(work, ladder, budget, 1.25));
    for (std::size_t i = 0; i < work.size(); ++i) EXPECT_EQ(work[i].level, levels[i]) << i;
  }
}

TEST(Lights, visible_points_decide_the_share) {
  const Ground ground;
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 100; ++i) points.emplace_back(-5.0 + 0.1 * i, 0.0, 0.0);
  std::vector<std::byte> memory(light_memory(1, points.size()));
  const LightPlan plan =
      ground.plan({{PointLight{{0, 1, 0}, std::sqrt(1.0 + 2.05 * 2.05)}}}, {}, memory, points);
  EXPECT_NEAR(plan.lights[0].share, 0.41, 1e-6);
  const LightPlan none = ground.plan({{PointLight{{0, 2, 10}, 4.0}}}, {}, memory, points);
  EXPECT_EQ(none.mapped, 1);
  EXPECT_NEAR(none.lights[0].share, 0.005, 1e-9);
}

TEST(Lights, the_estimated_error_is_near_the_measured_one) {
  const Ground ground;
  LightOptions options;
  options.most_size = 512;
  for (const Light& light : {Light{SpotLight{{3, 8, 2}, {0, -1, 0}, 0.6, 12.0}},
                             Light{PointLight{{-4, 3, 0}, 9.0}}, Light{DirectionalLight{{0.3, -1.0, 0.2}}}}) {
    std::vector<std::byte> memory(light_memory(1, 0));
    const LightPlan plan = ground.plan({{light}}, options, memory);
    ASSERT_EQ(plan.mapped, 1);
    PlanOptions own = light_options({}, plan.lights[0]);
    if (!std::holds_alternative<DirectionalLight>(light)) own.warp.warp = &warps::none;
    const SceneBounds bounds{ground.boxes, ground.boxes};
    const AliasingStats stats = measure(make_plan(ground.camera, light, bounds, own), ground.camera, bounds);
    EXPECT_GT(plan.lights[0].m, stats.mean / 1.5);
    EXPECT_LT(plan.lights[0].m, stats.mean * 1.5);
  }
}

}  // namespace
}  // namespace gnomon::test
