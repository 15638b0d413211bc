// Does the net of random cases hold, and does it notice a plan that breaks a promise?
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <span>
#include <string>

#include "base/random.hpp"
#include "check.hpp"
#include "draw.hpp"
#include "run.hpp"
#include "shrink.hpp"
#include "support/float_traps.hpp"

namespace gnomon::stress {
namespace {

using Json = nlohmann::ordered_json;

/// A ground under a camera, a plate above it, and a light.
Json plain_case(const char* light) {
  return Json::parse(R"({"camera": {"position": [0, 2, 0], "forward": [0, -0.3, -1], "up": [0, 1, 0],
      "fov_y_deg": 60, "aspect": 1.5, "near": 0.1, "far": 100, "width": 640, "height": 480},
    "light": )" + std::string(light) +
                     R"(,
    "receivers": [{"min": [-50, -1, -50], "max": [50, 0, 50]}],
    "casters": [{"min": [-50, -1, -50], "max": [50, 0, 50]}, {"min": [-2, 1, -12], "max": [2, 1.5, -6]}],
    "options": {"cascades": 2, "map_size": 256, "warp": "none"}})");
}
const char* const kSun = R"({"type": "directional", "direction": [0.2, -1, 0.1]})";
const char* const kSpot =
    R"({"type": "spot", "position": [0, 8, -9], "direction": [0, -1, 0], "outer_deg": 60, "range": 30})";

std::set<std::string> kinds(const Verdict& verdict) {
  std::set<std::string> names;
  for (const Finding& f : verdict.findings) names.emplace(f.kind);
  return names;
}

/// What check_points and check_numbers say of the case's plan after `harm`.
template <typename Harm>
std::set<std::string> kinds_after(const char* light, Harm&& harm) {
  const Case input = read_case(plain_case(light).dump());
  ShadowPlan plan = make_plan(input.camera, input.light, input.bounds(), input.options);
  EXPECT_EQ(plan.status, PlanStatus::ok);
  harm(plan);
  Verdict verdict;
  Report report(verdict);
  check_numbers(input, plan, report);
  check_points(input, plan, seen_places(input), report);
  check_metric(input, plan, report);
  return kinds(verdict);
}

TEST(RandomNet, a_thousand_cases_keep_every_promise) {
  const RandomOptions options{1000, 20061026, false};
  const RandomResult result = run_random(options);
  for (const KindFound& k : result.kinds)
    ADD_FAILURE() << k.kind << ": " << k.cases << " cases, first " << k.first << ": " << k.text;
  // Nothing holds because nothing was looked at.
  EXPECT_EQ(result.counts.plans, 1000);
  EXPECT_GT(result.counts.maps, 1000);
  EXPECT_GT(result.counts.receivers, 25000);
  EXPECT_GT(result.counts.casters, 12000);
  EXPECT_GT(result.counts.unmapped, 2000);
  EXPECT_GT(result.counts.measured, 12000);
  EXPECT_GT(result.counts.warps, 40);
  EXPECT_GT(result.counts.lights, 2500);
  EXPECT_GT(result.counts.light_maps, 5000);
}

TEST(RandomNet, no_plan_of_a_random_case_is_no_number_on_the_way) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Case input = read_case(draw_case(20061026, i).dump());
    const bool quiet = test::runs_without_trap([&] {
      volatile int maps = make_plan(input.camera, input.light, input.bounds(), input.options).map_count;
      (void)maps;
    });
    EXPECT_TRUE(quiet) << "case " << i;
  }
}

TEST(RandomNet, cases_that_failed_once_keep_every_promise) {
  namespace fs = std::filesystem;
  int files = 0;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(fs::path(GNOMON_TEST_DATA) / "stress_random")) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path());
    const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    for (const Finding& f : check_case(Json::parse(text)).findings)
      ADD_FAILURE() << entry.path().filename() << ": " << f.kind << ": " << f.text;
    ++files;
  }
  EXPECT_GT(files, 5);
}

TEST(RandomNet, plain_cases_have_no_finding) {
  for (const char* light : {kSun, kSpot}) {
    const Verdict verdict = check_case(plain_case(light));
    for (const Finding& f : verdict.findings) ADD_FAILURE() << f.kind << ": " << f.text;
    EXPECT_GE(verdict.counts.receivers, 7);
    EXPECT_GE(verdict.counts.casters, 3);
    EXPECT_GE(verdict.counts.measured, 6);
  }
}

TEST(RandomNet, a_million_points_have_their_pages_under_every_policy) {
  const Case input = read_case(plain_case(kSun).dump());
  const std::vector<glm::dvec3> seen = seen_places(input);
  ASSERT_GT(seen.size(), 3u);
  // What lies between two visible points is in view as well.
  std::vector<glm::dvec3> points(1'000'000);
  Random random(3);
  const auto any = [&] { return seen[static_cast<std::size_t>(random.pick(static_cast<int>(seen.size())))]; };
  for (glm::dvec3& point : points) {
    const glm::dvec3 from = any(), to = any();
    point = from + (to - from) * random.unit();
  }
  Verdict verdict;
  Report report(verdict);
  check_pages(input, points, report);
  for (const Finding& f : verdict.findings) ADD_FAILURE() << f.kind << ": " << f.text;
  EXPECT_GT(verdict.counts.page_points, 1'000'000);
}

std::span<ShadowMap> maps_of(ShadowPlan& plan) {
  return {plan.map.data(), static_cast<std::size_t>(plan.map_count)};
}

TEST(RandomNet, it_notices_a_map_that_is_moved) {
  const auto found = kinds_after(kSun, [](ShadowPlan& plan) {
    for (ShadowMap& map : maps_of(plan)) map.clip_from_world[3].x += 0.1;
  });
  EXPECT_TRUE(found.contains("receiver_outside_map"));
  EXPECT_TRUE(found.contains("matrices_disagree"));
}

TEST(RandomNet, it_notices_two_matrices_that_differ_by_a_hundredth_of_a_texel) {
  const auto found = kinds_after(kSun, [](ShadowPlan& plan) {
    for (ShadowMap& map : maps_of(plan)) map.clip_from_camera_relative[3].y += 0.02f / 256.0f;
  });
  EXPECT_EQ(found, std::set<std::string>{"matrices_disagree"});
}

TEST(RandomNet, it_notices_a_near_plane_behind_a_caster) {
  const auto nearer = [](ShadowPlan& plan) {
    for (ShadowMap& map : maps_of(plan)) {
      for (int c = 0; c < 4; ++c) {
        map.clip_from_world[c].z = 100.0 * map.clip_from_world[c].z - 99.0 * map.clip_from_world[c].w;
        map.clip_from_camera_relative[c].z = static_cast<float>(100.0 * map.clip_from_camera_relative[c].z -
                                                                99.0 * map.clip_from_camera_relative[c].w);
      }
    }
  };
  EXPECT_TRUE(kinds_after(kSun, nearer).contains("caster_before_near_plane"));
  EXPECT_TRUE(kinds_after(kSpot, nearer).contains("local_caster_before_near_plane"));
}

TEST(RandomNet, it_notices_a_cull_plane_that_takes_a_caster) {
  const auto cut = [](ShadowPlan& plan) {
    for (ShadowMap& map : maps_of(plan)) map.cull_planes[0] = {0.0, -1.0, 0.0, 0.5};  // all above half a unit
  };
  EXPECT_TRUE(kinds_after(kSun, cut).contains("caster_culled"));
  EXPECT_TRUE(kinds_after(kSpot, cut).contains("local_caster_culled"));
}

TEST(RandomNet, it_notices_a_plan_that_says_there_is_no_caster) {
  const auto none = [](ShadowPlan& plan) {
    plan.map_count = 0;
    plan.status = PlanStatus::no_caster;
  };
  EXPECT_TRUE(kinds_after(kSun, none).contains("no_caster_with_caster"));
  EXPECT_TRUE(kinds_after(kSpot, none).contains("local_no_caster_with_caster"));
  const auto nothing = [](ShadowPlan& plan) {
    plan.map_count = 0;
    plan.status = PlanStatus::nothing_visible;
  };
  EXPECT_TRUE(kinds_after(kSun, nothing).contains("nothing_visible_with_receiver"));
}

TEST(RandomNet, it_notices_a_depth_range_below_zero_and_what_is_no_number) {
  EXPECT_TRUE(kinds_after(kSun, [](ShadowPlan& plan) {
                plan.map[0].depth_range_world = -1.0;
              }).contains("depth_range_not_positive"));
  EXPECT_TRUE(kinds_after(kSun, [](ShadowPlan& plan) {
                plan.map[1].texel_world.x = std::numeric_limits<double>::quiet_NaN();
              }).contains("not_finite"));
}

TEST(RandomNet, cases_are_the_same_everywhere_and_different_from_each_other) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  std::set<std::string> different;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const std::string text = draw_case(7, i).dump();
    different.insert(text);
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  EXPECT_EQ(different.size(), 200u);
  EXPECT_EQ(hash, 17014952173928883394u);
  EXPECT_NE(draw_case(7, 3), draw_case(8, 3));
}

TEST(RandomNet, shrinking_keeps_what_fails_and_takes_the_rest_away) {
  Json value = plain_case(kSun);
  for (int i = 0; i < 20; ++i)
    value["casters"].push_back({{"min", {i, 1.0, -7.25 - i}}, {"max", {i + 1, 2.0, -6.0 - i}}});
  value["options"]["lambda"] = 0.123456789;
  const Json small = shrink_case(value, [](const Json& candidate) {
    const auto& casters = candidate["casters"];
    return std::any_of(casters.begin(), casters.end(), [](const Json& box) { return box["min"][2] < -20.0; });
  });
  EXPECT_EQ(small["casters"].size(), 1u);
  EXPECT_EQ(small["receivers"].size(), 1u);
  EXPECT_TRUE(small["options"].empty());
  EXPECT_LT(small["casters"][0]["min"][2].get<double>(), -20.0);
  EXPECT_EQ(small["camera"]["near"], 0.0);
}

}  // namespace
}  // namespace gnomon::stress
