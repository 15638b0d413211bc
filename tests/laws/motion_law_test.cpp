// Along a flight: do texels change smoothly, does everything in view keep its map, does a held map hold
// still?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "gnomon/extend/warp.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"
#include "support/walk.hpp"
#include "warp/plane_error.hpp"
#include "warp/plane_map.hpp"

namespace gnomon::test {
namespace {

constexpr double kTexel = 1e-4;     // rounding of a position in a map, texels
constexpr double kRounding = 1e-6;  // of a ratio of densities

glm::dvec4 clip_of(const ShadowMap& map, const glm::dvec3& p) {
  return map.clip_from_world * glm::dvec4(p, 1.0);
}

/// Texels per world area across the light.
double density(const ShadowMap& map, const glm::dvec3& light_direction, const glm::dvec3& p) {
  const glm::dvec4 clip = clip_of(map, p);
  std::array<glm::dvec3, 2> gradient;
  for (int axis = 0; axis < 2; ++axis) {
    for (int column = 0; column < 3; ++column)
      gradient[static_cast<std::size_t>(axis)][column] =
          (map.clip_from_world[column][axis] - clip[axis] / clip.w * map.clip_from_world[column].w) / clip.w;
  }
  return std::abs(glm::dot(glm::cross(gradient[0], gradient[1]), light_direction)) * map.width * map.height;
}

/// The same walk in another unit.
Walk in_units(Walk w, double unit) {
  for (Box& box : w.boxes) box = {box.min * unit, box.max * unit};
  w.start *= unit;
  w.velocity *= unit;
  w.unit = unit;
  return w;
}

Walk draw_walk() {
  Walk w;
  Random random(static_cast<std::uint64_t>(1 + pick(1000)));
  w.boxes = floor_with_blocks(random);
  draw_course(w, [](double low, double high) { return between(low, high); });
  w.options.cascades = 1 + pick(4);
  w.options.warp.objective = static_cast<Objective>(pick(3));
  const Warp* const warps[] = {nullptr, &warps::lispsm, &warps::lispsm_closed, &warps::none};
  w.options.warp.warp = warps[pick(4)];
  // The border of a kernel in world units comes and goes with the map's own size.
  if (chance(0.3)) w.options.filter.world = between(0.0, 0.5);
  return w;
}

std::vector<glm::dvec3> points_of(const Walk& w, const Camera& camera, Random& random) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 240; ++i) {
    const glm::dvec3 p =
        point_at(camera, random.between(-1.0, 1.0), random.between(-1.0, 1.0),
                 camera.near_depth * std::pow(camera.far_depth / camera.near_depth, random.unit()));
    const auto holds = [&](const Box& b) {
      return p.x >= b.min.x && p.y >= b.min.y && p.z >= b.min.z && p.x <= b.max.x && p.y <= b.max.y &&
             p.z <= b.max.z;
    };
    if (std::any_of(w.boxes.begin(), w.boxes.end(), holds)) points.push_back(p);
  }
  return points;
}

/// The map that serves a point in view; nullptr outside the view.
const ShadowMap* serving(const ShadowPlan& plan, const Camera& camera, const glm::dvec3& p) {
  const int map = map_serving(plan, p, depth_of(camera, p));
  return map >= 0 ? &plan.map[static_cast<std::size_t>(map)] : nullptr;
}

/// Flies and calls `use(plan before, plan now, camera before, camera now, history)` for each pair of frames.
template <typename Use>
void fly(const Walk& w, const Light& light, int frames, Use&& use) {
  PlanHistory history;
  ShadowPlan before;
  for (int frame = 0; frame < frames; ++frame) {
    const ShadowPlan now = make_plan(w.camera(frame), light, w.bounds(), w.options, &history);
    // A spot may light nothing in view.
    const bool dark = now.status == PlanStatus::nothing_visible && std::holds_alternative<SpotLight>(light);
    require(now.status == PlanStatus::ok || dark, "status", to_string(now.status), "frame", frame);
    if (frame > 0) use(before, now, w.camera(frame - 1), w.camera(frame), history);
    before = now;
  }
}
template <typename Use>
void fly(const Walk& w, int frames, Use&& use) {
  fly(w, DirectionalLight{w.light}, frames, use);
}

bool listed(const PlanHistory& history, int cascade) {
  const auto events = history.events();
  return std::any_of(events.begin(), events.end(), [&](const PlanEvent& e) { return e.map == cascade; });
}

TEST(MotionLaw, texels_per_area_jump_only_where_an_event_says_so) {
  std::int64_t pairs = 0, maps = 0, events = 0;
  for_all(12, [&] {
    Walk w = draw_walk();
    w.options.fit = chance(0.3) ? Fit::rotated : Fit::tight;
    Random random(5);
    fly(w, 120,
        [&](const ShadowPlan& a, const ShadowPlan& b, const Camera& from, const Camera& to,
            const PlanHistory& history) {
          maps += b.map_count;
          events += history.event_count;
          for (const glm::dvec3& p : points_of(w, to, random)) {
            const ShadowMap *m = serving(a, from, p), *n = serving(b, to, p);
            if (m == nullptr || n == nullptr || m->cascade != n->cascade || !map_holds(a, *m, p)) continue;
            ++pairs;
            if (listed(history, n->cascade)) continue;
            const double ratio = density(*n, w.light, p) / density(*m, w.light, p);
            require(std::max(ratio, 1.0 / ratio) <= 1.0 + kDensityStep + kRounding, "ratio", ratio, "cascade",
                    n->cascade, n->warp->name, "of", to_string(w.options.warp.objective));
          }
        });
  });
  EXPECT_GT(pairs, of_all_draws(4000));
  EXPECT_LT(events * 10, maps);  // listed jumps are the exception
}

TEST(MotionLaw, texels_per_area_of_a_spot_jump_only_where_an_event_says_so) {
  std::int64_t pairs = 0, maps = 0, events = 0;
  for_all(20, [&] {
    Walk w = draw_walk();
    w.options.cascades = 1;
    w.options.fit = chance(0.3) ? Fit::rotated : Fit::tight;
    SpotLight spot;
    spot.position = w.start + glm::dvec3(between(-6.0, 6.0), between(4.0, 12.0), between(-6.0, 6.0));
    spot.direction = {between(-0.5, 0.5), -1.0, between(-0.5, 0.5)};
    spot.outer_radians = between(0.5, 1.0);
    spot.range = 60.0;
    const glm::dvec3 axis = glm::normalize(spot.direction);
    Random random(5);
    fly(w, spot, 120,
        [&](const ShadowPlan& a, const ShadowPlan& b, const Camera&, const Camera& to,
            const PlanHistory& history) {
          maps += b.map_count;
          events += history.event_count;
          if (a.map_count != 1 || b.map_count != 1 || listed(history, b.map[0].cascade)) return;
          for (const glm::dvec3& p : points_of(w, to, random)) {
            const glm::dvec3 way = p - spot.position, ray = glm::normalize(way);
            const bool lit =
                glm::dot(ray, axis) >= std::cos(spot.outer_radians) && glm::length(way) <= spot.range;
            if (!lit || !map_holds(a, a.map[0], p) || !map_holds(b, b.map[0], p)) continue;
            ++pairs;
            const double ratio = density(b.map[0], ray, p) / density(a.map[0], ray, p);
            require(std::max(ratio, 1.0 / ratio) <= 1.0 + kDensityStep + kRounding, "ratio", ratio,
                    b.map[0].warp->name, "of", to_string(w.options.warp.objective));
          }
        });
  });
  EXPECT_GT(pairs, of_all_draws(4000));
  EXPECT_LT(events * 5, maps);
}

TEST(MotionLaw, everything_in_view_is_inside_its_map_in_every_frame) {
  std::int64_t points = 0;
  for_all(12, [&] {
    Walk w = draw_walk();
    const Fit fits[] = {Fit::tight, Fit::rotated, Fit::warped_stable};
    w.options.fit = fits[pick(3)];
    w.velocity *= 1.0 + 9.0 * unit();  // a car's speed, too
    Random random(6);
    fly(w, 60,
        [&](const ShadowPlan&, const ShadowPlan& b, const Camera&, const Camera& to, const PlanHistory&) {
          for (const glm::dvec3& p : points_of(w, to, random)) {
            const ShadowMap* map = serving(b, to, p);
            require(map != nullptr, "no map at depth", depth_of(to, p));
            require(map_holds(b, *map, p), "outside its map at depth", depth_of(to, p),
                    to_string(w.options.fit));
            ++points;
          }
        });
  });
  EXPECT_GT(points, of_all_draws(2000));
}

TEST(MotionLaw, a_warped_stable_map_keeps_its_very_matrix_until_an_event) {
  std::int64_t held = 0, maps = 0;
  for_all(12, [&] {
    Walk w = draw_walk();
    w.options.fit = Fit::warped_stable;
    if (chance(0.7)) w.options.clip_space = chance(0.5) ? kVulkan : kDirect3D;
    fly(w, 120,
        [&](const ShadowPlan& a, const ShadowPlan& b, const Camera&, const Camera&,
            const PlanHistory& history) {
          for (const ShadowMap& n : b.maps()) {
            ++maps;
            if (listed(history, n.cascade)) continue;
            const auto m = std::find_if(a.maps().begin(), a.maps().end(),
                                        [&](const ShadowMap& other) { return other.cascade == n.cascade; });
            require(m != a.maps().end(), "a map without an event that was not there before");
            require(m->clip_from_world == n.clip_from_world, "another matrix, cascade", n.cascade);
            require(reuse(*m, n).kind == ReuseKind::identical, "not reusable");
            ++held;
          }
        });
  });
  EXPECT_GT(held * 2, maps);  // most of the time
}

TEST(MotionLaw, a_still_camera_keeps_its_grid) {
  for_all(20, [&] {
    Walk w = draw_walk();
    w.velocity = {0.0, 0.0, 0.0};
    w.turn = 0.0;
    const Fit fits[] = {Fit::tight, Fit::warped_stable};
    w.options.fit = fits[pick(2)];
    fly(w, 20,
        [&](const ShadowPlan& a, const ShadowPlan& b, const Camera&, const Camera&,
            const PlanHistory& history) {
          require(history.event_count == 0, "events", history.event_count);
          for (int i = 0; i < b.map_count; ++i) {
            const ShadowMap &m = a.map[static_cast<std::size_t>(i)], &n = b.map[static_cast<std::size_t>(i)];
            const glm::dvec3 p = point_at(w.camera(0), 0.3, -0.7, 0.5 * (n.depth_begin + n.depth_end));
            const glm::dvec4 x = clip_of(m, p), y = clip_of(n, p);
            const double step = 0.5 * n.width * glm::length(glm::dvec2(x) / x.w - glm::dvec2(y) / y.w);
            require(step <= kTexel, "texels moved", step);
          }
        });
  });
}

TEST(MotionLaw, edges_come_to_rest_where_a_plan_without_history_has_them) {
  constexpr int kMoving = 30, kLonger = 120;  // frames
  constexpr double kAlike = 1e-9;
  int moved = 0;
  for_all(12, [&] {
    Walk w = draw_walk();
    w.options.cascades = 4;
    w.options.split.scheme = SplitScheme::optimal;
    PlanHistory history;
    const auto plan = [&](const Camera& camera) {
      const ShadowPlan result = make_plan(camera, DirectionalLight{w.light}, w.bounds(), w.options, &history);
      require(result.status == PlanStatus::ok, "status", to_string(result.status));
    };
    for (int frame = 0; frame < kMoving; ++frame) plan(w.camera(frame));
    const std::vector<double> on_the_way(history.edge.begin(), history.edge.begin() + history.edge_count);
    for (int frame = 0; frame < kLonger; ++frame) plan(w.camera(kMoving));
    PlanHistory afresh;
    (void)make_plan(w.camera(kMoving), DirectionalLight{w.light}, w.bounds(), w.options, &afresh);
    require(history.edge_count == afresh.edge_count, "edges", history.edge_count, afresh.edge_count);
    for (std::size_t i = 0; i < on_the_way.size(); ++i) {
      const double found = afresh.edge[i];
      require(std::abs(history.edge[i] / found - 1.0) <= kAlike, "edge", i, history.edge[i], "for", found);
      moved += std::abs(on_the_way[i] / found - 1.0) > kAlike ? 1 : 0;
    }
  });
  EXPECT_GT(moved, of_all_draws(12)) << "edges that had to move";
}

/// What searches from the last frame's result came to, over searches from nothing in the same frame.
struct Followed {
  std::vector<double> ratio;  // of the objective
  int searches = 0, kept = 0, kept_over_none = 0;
  double over_none = 0.0;   // the largest objective over that of no warp, of those that are not kept
  double over_limit = 0.0;  // the largest stretch over what the camera's motion lets it be
};
Followed followed;

/// In the place of `optimal`, which it asks twice.
WarpChoice follow(const WarpInput& input) noexcept {
  const WarpChoice choice = warps::optimal.choose(input);
  ++followed.searches;
  if (input.start != nullptr) {
    const double stretch = plane_map(input.body, choice).stretch;
    followed.over_limit = std::max(followed.over_limit, stretch / input.start->most_stretch);
  }
  if (!choice.followed) return choice;
  WarpInput cold = input;
  cold.start = nullptr;
  cold.most_stretch = std::min(input.most_stretch, input.start->most_stretch);  // under the same motion
  PlaneError error(input, true);
  const double value = error.value(choice);
  followed.ratio.push_back(value / error.value(warps::optimal.choose(cold)));
  const double over = value / error.value(input.unwarped);
  const bool keeps = input.start->use == StartUse::keep;
  followed.kept += keeps ? 1 : 0;
  // A result that is kept is not measured again: it holds for a frame, while the body still fills its map.
  if (keeps) {
    followed.kept_over_none += over > 1.0 + kRounding ? 1 : 0;
  } else {
    followed.over_none = std::max(followed.over_none, over);
  }
  return choice;
}
const Warp kFollow{"follow", "compares searches", follow, true, true};

double mean_log(std::span<const double> ratios) {
  double sum = 0.0;
  for (const double r : ratios) sum += std::log(r);
  return sum / static_cast<double>(ratios.size());
}

TEST(MotionLaw, a_search_from_the_last_result_finds_what_one_from_nothing_finds_and_does_not_drift) {
  constexpr double kMean = 0.005;     // of the logarithm: a search from nothing is off by as much
  constexpr double kNearlyAll = 1.3;  // where another place became better since the last search
  constexpr double kOverLimit = 1.05 + kRounding;  // a result is kept while the limit changes little
  constexpr int kFrames = 600;
  for (const Objective objective : {Objective::storage, Objective::max, Objective::p95}) {
    std::vector<double> all, early, late;
    int searches = 0, kept = 0, kept_over_none = 0;
    for_all(12, [&] {
      Walk w = draw_walk();
      w.options.warp.warp = &kFollow;
      w.options.warp.objective = objective;
      w.options.cascades = 2;
      PlanHistory history;
      for (int frame = 0; frame < kFrames; ++frame) {
        followed = {};
        (void)make_plan(w.camera(frame), DirectionalLight{w.light}, w.bounds(), w.options, &history);
        searches += followed.searches;
        kept += followed.kept;
        kept_over_none += followed.kept_over_none;
        require(followed.over_none <= 1.0 + kRounding, "over no warp", followed.over_none, "frame", frame);
        require(followed.over_limit <= kOverLimit, "over the limit", followed.over_limit, "frame", frame);
        for (const double r : followed.ratio) {
          all.push_back(r);
          (frame < kFrames / 2 ? early : late).push_back(r);
        }
      }
    });
    ASSERT_GT(static_cast<int>(all.size()), searches * 8 / 10) << "most begin at the last result";
    EXPECT_GT(kept, searches * 3 / 10) << "every second result is kept, but where the body changes";
    EXPECT_LT(kept, searches * 6 / 10);
    EXPECT_LT(kept_over_none, kept / 500);
    EXPECT_LT(mean_log(all), kMean) << to_string(objective);
    // What is better than a search from nothing at first need not stay so.
    EXPECT_LT(mean_log(late), std::max(mean_log(early), 0.0) + 4.0 * kMean) << to_string(objective);
    std::sort(all.begin(), all.end());
    EXPECT_LT(all[all.size() * 99 / 100], kNearlyAll) << to_string(objective);
    std::printf("%s: mean %.4f, 90%% %.4f, 99%% %.4f, worst %.4f\n",
                std::string(to_string(objective)).c_str(), std::exp(mean_log(all)), all[all.size() * 9 / 10],
                all[all.size() * 99 / 100], all.back());
  }
}

TEST(MotionLaw, a_result_is_kept_while_the_view_goes_on_and_not_after_a_jump) {
  int kept = 0;
  for_all(20, [&] {
    Walk w = draw_walk();
    w.options.warp.warp = &kFollow;
    const int frames = 6 + pick(8);
    PlanHistory history;
    for (int frame = 0; frame < frames; ++frame) {
      followed = {};
      (void)make_plan(w.camera(frame), DirectionalLight{w.light}, w.bounds(), w.options, &history);
      kept += followed.kept;
    }
    const double turned = 1.0;  // radians
    w.turn += turned / frames;
    followed = {};
    (void)make_plan(w.camera(frames), DirectionalLight{w.light}, w.bounds(), w.options, &history);
    require(followed.kept == 0, "kept", followed.kept, "of", followed.searches, "in frame", frames);
  });
  EXPECT_GT(kept, of_all_draws(50));
}

TEST(MotionLaw, a_leap_ends_at_maps_as_good_as_those_without_history) {
  constexpr double kLeap = 40.0;  // times as far as in a frame
  constexpr double kNearly = 1.05;
  std::vector<double> ratio;
  for_all(24, [&] {
    Walk w = draw_walk();
    w.options.warp.warp = &warps::optimal;
    w.options.cascades = 1 + pick(2);
    const int frames = 6 + pick(30);
    PlanHistory history;
    for (int frame = 0; frame < frames; ++frame)
      (void)make_plan(w.camera(frame), DirectionalLight{w.light}, w.bounds(), w.options, &history);
    w.turn *= kLeap;
    w.velocity *= kLeap;
    w.start += w.velocity;
    const Camera camera = w.camera(frames);
    const ShadowPlan followed_plan =
        make_plan(camera, DirectionalLight{w.light}, w.bounds(), w.options, &history);
    const ShadowPlan afresh = make_plan(camera, DirectionalLight{w.light}, w.bounds(), w.options);
    ratio.push_back(w.error_of(followed_plan, camera) / w.error_of(afresh, camera));
  });
  std::sort(ratio.begin(), ratio.end());
  EXPECT_LT(ratio[ratio.size() / 2], kNearly) << "some leaps are no cuts: there the map goes in small steps";
}

TEST(MotionLaw, a_search_follows_the_last_result_in_any_unit) {
  constexpr double kTiny = 0x1p-24, kLarge = 0x1p24;
  int kept = 0;
  for_all(12, [&] {
    Walk w = draw_walk();
    w.options.warp.warp = &kFollow;
    const std::array<Walk, 3> walks = {w, in_units(w, kTiny), in_units(w, kLarge)};
    std::array<PlanHistory, 3> history;
    for (int frame = 0; frame < 30; ++frame) {
      std::array<int, 3> of{};
      for (std::size_t i = 0; i < walks.size(); ++i) {
        followed = {};
        (void)make_plan(walks[i].camera(frame), DirectionalLight{w.light}, walks[i].bounds(), w.options,
                        &history[i]);
        of[i] = 100 * followed.kept + static_cast<int>(followed.ratio.size());
      }
      require(of[0] == of[1] && of[0] == of[2], "kept and followed", of[0], of[1], of[2], "frame", frame,
              to_string(w.options.warp.objective));
      kept += of[0] / 100;
    }
  });
  EXPECT_GT(kept, of_all_draws(100));
}

TEST(MotionLaw, a_broken_input_leaves_the_history_as_it_was) {
  Camera camera = perspective_camera({0, 5, 0}, {0, -0.3, -1}, {0, 1, 0}, 1.0, 1.6, 0.5, 200.0, 640, 400);
  const Box floor{{-100, -1, -100}, {100, 0, 100}};
  const std::vector<Box> boxes{floor};
  PlanHistory history;
  ASSERT_EQ(make_plan(camera, DirectionalLight{{0.3, -1, 0.2}}, {boxes, boxes}, {}, &history).status,
            PlanStatus::ok);
  EXPECT_EQ(history.frame, 1);
  camera.near_depth = -1.0;
  EXPECT_EQ(make_plan(camera, DirectionalLight{{0.3, -1, 0.2}}, {boxes, boxes}, {}, &history).status,
            PlanStatus::invalid_input);
  EXPECT_EQ(history.frame, 1);
  EXPECT_EQ(history.event_count, 0);
}

}  // namespace
}  // namespace gnomon::test
