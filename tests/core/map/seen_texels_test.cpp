// Do maps of the rectilinear shape have short texels where the camera sees receivers, and do plans fall back
// to linear texels where nobody knows what is seen or little is won?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "gnomon/extend/shape.hpp"
#include "gnomon/gnomon.hpp"
#include "gnomon/measure.hpp"
#include "gnomon/study/bias.hpp"
#include "support/fitted_shapes.hpp"
#include "support/near.hpp"

namespace gnomon::test {
namespace {

constexpr std::size_t kPieces = 8;  // that the shape cuts an axis into
const Shape& kShape = shapes::rectilinear;

/// The largest need that the best cut between strips leaves, each piece having as many texels.
double best_between_strips(const std::array<double, kNeedStrips>& need) {
  std::array<double, kNeedStrips + 1> least;
  least.fill(std::numeric_limits<double>::infinity());
  least[0] = 0.0;
  for (std::size_t piece = 0; piece < kPieces; ++piece) {
    auto next = least;
    for (std::size_t end = 1; end <= kNeedStrips; ++end) {
      double largest = 0.0;
      for (std::size_t begin = end; begin-- > 0;) {
        largest = std::max(largest, need[begin]);
        const double width = static_cast<double>(end - begin) / kNeedStrips;
        next[end] = std::min(next[end], std::max(least[begin], kPieces * width * largest));
      }
    }
    least = next;
  }
  return least[kNeedStrips];
}

/// Strips as the shape takes them: each with its neighbours, none below a sixteenth of the largest.
std::array<double, kNeedStrips> with_neighbours(const std::array<double, kNeedStrips>& need) {
  const double least = *std::max_element(need.begin(), need.end()) / 16.0;
  std::array<double, kNeedStrips> result;
  for (std::size_t i = 0; i < kNeedStrips; ++i) {
    result[i] = std::max(least, need[i]);
    if (i > 0) result[i] = std::max(result[i], need[i - 1]);
    if (i + 1 < kNeedStrips) result[i] = std::max(result[i], need[i + 1]);
  }
  return result;
}

TEST(RectilinearShape, leaves_no_more_than_the_best_cut_between_strips) {
  std::mt19937 random(11);
  int gained = 0;
  for (int i = 0; i < 60; ++i) {
    TexelNeeds needs = needs_round(0.01 * static_cast<double>(random() % 100), 0.5, 4);
    for (double& n : needs.x)
      n *= random() % 4 == 0 ? 0.0 : 0.5 + 1e-3 * static_cast<double>(random() % 1000);
    const ServingShape serving = kShape.serving(needs);
    const std::array<double, kNeedStrips> need = with_neighbours(needs.x);
    const double largest = *std::max_element(need.begin(), need.end());
    EXPECT_LE(serving.left.x, 1.0);
    // The narrowest piece that is allowed is a strip's quarter: between strips there is none narrower.
    EXPECT_LE(serving.left.x, best_between_strips(need) / largest + 1e-6);
    // What it says is what its texels are.
    const TexelGrid grid{512, 512, &kShape, serving.parameters}, linear{512, 512};
    double left = 0.0, longest = 0.0;
    for (std::size_t k = 0; k < 50 * kNeedStrips; ++k) {
      const double share = (static_cast<double>(k) + 0.5) / (50 * kNeedStrips);
      const double x = (4.0 + share * 504.0) / 256.0 - 1.0;
      const double length =
          linear.place({x, 0.0}).texel_from_ndc[0][0] / grid.place({x, 0.0}).texel_from_ndc[0][0];
      left = std::max(left, length * need[k / 50] / largest);
      longest = std::max(longest, length);
    }
    EXPECT_NEAR(left, serving.left.x, 1e-3);
    EXPECT_NEAR(longest, serving.longest.x, 1e-9);
    gained += serving.left.x < 0.7 ? 1 : 0;
  }
  EXPECT_GT(gained, 30);
}

TEST(RectilinearShape, one_place_that_counts_gets_most_of_the_texels) {
  TexelNeeds needs;
  needs.x[20] = 5.0;
  needs.y.fill(2.0);
  const ServingShape serving = kShape.serving(needs);
  // Three strips at 5 and 61 at 5/16: no cut leaves less than their sum, and eight pieces come near it.
  const double sum = (3.0 + 61.0 / 16.0) / kNeedStrips;
  EXPECT_GE(serving.left.x, sum);
  EXPECT_LE(serving.left.x, 1.3 * sum);
  EXPECT_EQ(serving.left.y, 1.0);
  EXPECT_EQ(serving.longest.y, 1.0);
}

TEST(RectilinearShape, needs_that_are_no_numbers_give_linear_texels) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const double value : {0.0, -1.0, kNone, kEndless, 1e-300, 1e300}) {
    TexelNeeds needs;
    needs.x.fill(value);
    needs.y[3] = value;
    needs.margin_texels = 3;
    const ServingShape serving = kShape.serving(needs);
    const TexelGrid grid{64, 32, &kShape, serving.parameters};
    EXPECT_EQ(serving.left.x, 1.0) << value;
    for (const double x : {-2.0, -1.0, -0.3, 0.4, 1.0, 5.0})
      EXPECT_NEAR(grid.place({x, 0.0}).texel.x, 32.0 * (x + 1.0), 1e-9) << value;
    EXPECT_TRUE(std::isfinite(serving.left.y) && serving.left.y > 0.0) << value;
  }
  // A margin as wide as the map leaves nothing to cut.
  TexelNeeds needs = needs_round(0.5, 0.5, 1000);
  const TexelGrid grid{64, 64, &kShape, kShape.serving(needs).parameters};
  for (const double x : {-1.0, 0.0, 0.99, 1.0}) EXPECT_TRUE(std::isfinite(grid.place({x, x}).texel.x));
}

/// A long street of boxes, seen along it.
struct Street {
  Camera camera = perspective_camera({0, 3, 10}, {0.05, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 120.0, 600, 400);
  std::vector<Box> boxes{{{-60, -1, -120}, {60, 0, 12}}};
  Light light = DirectionalLight{{0.3, -1.0, 0.2}};
  std::vector<glm::dvec3> seen;

  Street() {
    for (int i = 0; i < 20; ++i) {
      const double z = -6.0 * i;
      boxes.push_back({{-8, 0, z - 2}, {-5, 4.0 + i % 3, z}});
      boxes.push_back({{5, 0, z - 2}, {8, 5.0 - i % 3, z}});
    }
    // Of the ground between the boxes alone: walls hide the rest.
    std::mt19937 random(3);
    std::uniform_real_distribution<double> across(-5.0, 5.0), along(-115.0, 5.0);
    for (int i = 0; i < 4000; ++i) seen.push_back({across(random), 0.0, along(random)});
  }
  [[nodiscard]] static PlanOptions options(const Shape& shape) {
    PlanOptions options;
    options.cascades = 1;
    options.resolution.max_size = 512;
    options.warp.warp = &warps::none;
    options.warp.shape = &shape;
    options.prune = kPruneNothing;
    return options;
  }
  [[nodiscard]] ShadowPlan plan(const PlanOptions& options) const {
    return make_plan({.camera = camera, .points_world = seen}, light, {boxes, boxes}, options);
  }
  /// p95 of the longer of m_s and m_t over what is seen.
  [[nodiscard]] double error(const ShadowPlan& plan) const {
    std::vector<double> all;
    for (const glm::dvec3& p : seen) {
      const int map = map_serving(plan, p, glm::dot(camera_axes(camera).forward, p - camera.position));
      if (map < 0) continue;
      const PointAliasing m =
          measure_point(plan.map[static_cast<std::size_t>(map)], camera, p, glm::dvec3(0, 1, 0));
      if (m.status == PointAliasing::Status::ok) all.push_back(std::max(m.m_s, m.m_t));
    }
    EXPECT_GT(all.size(), seen.size() / 2);
    std::sort(all.begin(), all.end());
    return all[all.size() * 95 / 100];
  }
};

bool ignores_shape(const ShadowPlan& plan) {
  return std::any_of(plan.omitted().begin(), plan.omitted().end(), [](const Omission& o) {
    return o.kind == OmissionKind::option_ignored && o.a == static_cast<double>(IgnoredOption::shape);
  });
}
bool gains_nothing(const ShadowPlan& plan) {
  return std::any_of(plan.omitted().begin(), plan.omitted().end(),
                     [](const Omission& o) { return o.kind == OmissionKind::shape_without_gain; });
}

TEST(RectilinearMap, has_less_error_where_something_is_seen) {
  const Street street;
  for (const ClipSpace& clip : {kOpenGl, kVulkan}) {
    PlanOptions linear = Street::options(shapes::linear), bent = Street::options(kShape);
    linear.clip_space = bent.clip_space = clip;
    const ShadowPlan a = street.plan(linear), b = street.plan(bent);
    ASSERT_EQ(b.map_count, 1);
    ASSERT_EQ(b.map[0].shape, &kShape);
    EXPECT_EQ(b.map[0].clip_from_world, a.map[0].clip_from_world);
    EXPECT_LT(street.error(b), 0.5 * street.error(a));
    EXPECT_EQ(b.map[0].filter_margin_texels, a.map[0].filter_margin_texels);
  }
}

TEST(RectilinearMap, holds_the_receivers_that_a_linear_one_holds_and_bounds_its_texels) {
  const Street street;
  PlanOptions options = Street::options(kShape);
  options.filter.texels = 5.0;
  const ShadowPlan bent = street.plan(options);
  options.warp.shape = &shapes::linear;
  const ShadowPlan linear = street.plan(options);
  ASSERT_EQ(bent.map[0].shape, &kShape);
  for (const glm::dvec3& p : street.seen) {
    EXPECT_EQ(map_holds(bent, bent.map[0], p), map_holds(linear, linear.map[0], p));
    if (!map_holds(bent, bent.map[0], p)) continue;
    const glm::dvec2 extent =
        texel_extent_world(bent.map[0].clip_from_world, bent.map[0].texels(), bent.light_direction, p);
    EXPECT_LE(extent.x, bent.map[0].texel_world_max.x * (1.0 + 1e-9));
    EXPECT_LE(extent.y, bent.map[0].texel_world_max.y * (1.0 + 1e-9));
    const PointAliasing m = measure_point(bent.map[0], street.camera, p, {0, 1, 0});
    EXPECT_TRUE(m.status != PointAliasing::Status::ok || m.m_s > 0.0);
  }
  EXPECT_GE(bent.map[0].m_s_max, linear.map[0].m_s_max);
}

TEST(RectilinearMap, several_cascades_take_the_shape_each_for_itself) {
  const Street street;
  PlanOptions options = Street::options(kShape);
  options.cascades = 3;
  options.split.scheme = SplitScheme::uniform;
  const ShadowPlan bent = street.plan(options);
  options.warp.shape = &shapes::linear;
  const ShadowPlan linear = street.plan(options);
  ASSERT_EQ(bent.map_count, linear.map_count);
  int shaped = 0;
  for (const ShadowMap& map : bent.maps()) shaped += map.shape == &kShape ? 1 : 0;
  EXPECT_GT(shaped, 0);
  EXPECT_LE(street.error(bent), street.error(linear));
}

TEST(RectilinearMap, is_linear_where_it_can_not_follow_visible_points) {
  const Street street;
  const SceneBounds bounds{street.boxes, street.boxes};
  const PlanOptions options = Street::options(kShape);
  const auto expect_linear = [](const ShadowPlan& plan) {
    ASSERT_EQ(plan.status, PlanStatus::ok);
    for (const ShadowMap& map : plan.maps()) EXPECT_EQ(map.shape, &shapes::linear);
    EXPECT_TRUE(ignores_shape(plan));
  };
  expect_linear(make_plan(street.camera, street.light, bounds, options));
  expect_linear(make_plan({.camera = street.camera, .points_world = street.seen},
                          SpotLight{{0, 30, -20}, {0, -1, 0}, 0.8, 100.0}, bounds, options));
  for (int i = 0; i < 4; ++i) {
    PlanOptions other = options;
    if (i == 0) other.fit = Fit::stable;
    if (i == 1) other.filter.world = 0.5;
    if (i == 2) other.resolution.max_error = 1.0;
    if (i == 3) other.resolution.texel_budget = 100'000;
    expect_linear(street.plan(other));
  }
  PlanHistory history;
  expect_linear(make_plan({.camera = street.camera, .points_world = street.seen}, street.light, bounds,
                          options, &history));
}

TEST(RectilinearMap, is_linear_where_little_is_won) {
  Street street;
  // Evenly all over what the map shows, from high above.
  street.camera =
      orthographic_camera({0, 80, -50}, {0, -1, 0.001}, {0, 0, -1}, 100.0, 1.0, 1.0, 200.0, 500, 500);
  const ShadowPlan plan = street.plan(Street::options(kShape));
  ASSERT_EQ(plan.map_count, 1);
  EXPECT_EQ(plan.map[0].shape, &shapes::linear);
  EXPECT_TRUE(gains_nothing(plan));
  EXPECT_FALSE(ignores_shape(plan));
  // Points that the camera does not see count for nothing.
  Street elsewhere;
  for (glm::dvec3& p : elsewhere.seen) p.z += 500.0;
  const ShadowPlan away = elsewhere.plan(Street::options(kShape));
  for (const ShadowMap& map : away.maps()) EXPECT_EQ(map.shape, &shapes::linear);
}

}  // namespace
}  // namespace gnomon::test
