// Kernels that hide texels: the rule itself, and the map sizes that follow from it.
#include "gnomon/render/perceptual.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>

#include "gnomon/measure.hpp"
#include "support/property.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

using test::between;
using test::for_all;
using test::require;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-12;  // relative: a handful of operations in double

FilterSettings filter(const std::string& text) {
  const ParsedFilter parsed = parse_filter(text);
  EXPECT_EQ(parsed.error, "");
  return parsed.settings;
}

/// One square map whose longest texel is `texel_world` long.
ShadowPlan plan_of(int side, double texel_world, double depth_begin = 2.0) {
  ShadowPlan plan;
  plan.status = PlanStatus::ok;
  plan.map_count = 1;
  plan.map[0] = {};
  plan.map[0].width = plan.map[0].height = side;
  plan.map[0].texel_world = {0.5 * texel_world, 0.25 * texel_world};
  plan.map[0].texel_world_max = {0.5 * texel_world, texel_world};
  plan.map[0].depth_begin = depth_begin;
  plan.map[0].depth_end = 50.0;
  return plan;
}

Camera camera() {
  return camera_on_box(200, 100);
}

TEST(Perceptual, takes_no_kernel_for_no_texel_and_hides_nothing_without_kernel) {
  for (const double nothing : {0.0, -0.0, -5.0, -kInfinity, kNan}) {
    EXPECT_EQ(hiding_radius_pixels(nothing), 0.0);
    EXPECT_EQ(hidden_texel_pixels(nothing), 0.0);
  }
  EXPECT_EQ(hiding_radius_pixels(kInfinity), kInfinity);
  EXPECT_EQ(hidden_texel_pixels(kInfinity), kInfinity);
}

TEST(Perceptual, has_nothing_to_hide_without_maps) {
  const HidingMapSize size = hiding_map_size({}, camera(), filter("hard"));
  EXPECT_EQ(size.map_size, kLeastMapSize);
  EXPECT_TRUE(size.hides);
}

TEST(Perceptual, finds_no_map_for_filters_without_kernel_and_for_contacts) {
  const ShadowPlan plan = plan_of(1024, 0.1);
  const ShadowDistances far{100.0, 0.0};
  FilterSettings wide = filter("hard");
  wide.radius = 9.0;
  wide.unit = KernelUnit::world;
  for (const FilterSettings& settings :
       {FilterSettings{}, filter("hard"), wide, filter("vsm:radius=0,unit=world"), filter("pcss:radius=2")}) {
    const HidingMapSize size = hiding_map_size(plan, camera(), settings, far);
    EXPECT_EQ(size.map_size, kMaxMapSize);
    EXPECT_FALSE(size.hides);
  }
  for (const double contact : {0.0, -1.0, kNan}) {
    const HidingMapSize size = hiding_map_size(plan, camera(), filter("pcss"), {contact, 0.0});
    EXPECT_EQ(size.radius_world, 0.0);
    EXPECT_FALSE(size.hides);
  }
}

TEST(Perceptual, stays_within_the_sizes_that_a_plan_takes) {
  const FilterSettings one = filter("pcf:radius=1,unit=world");
  const HidingMapSize tiny = hiding_map_size(plan_of(1024, 1e-9), camera(), one);
  EXPECT_EQ(tiny.map_size, kLeastMapSize);
  EXPECT_TRUE(tiny.hides);
  for (const double texel_world : {1e6, kInfinity}) {
    const HidingMapSize huge = hiding_map_size(plan_of(1024, texel_world), camera(), one);
    EXPECT_EQ(huge.map_size, kMaxMapSize);
    EXPECT_FALSE(huge.hides);
  }
}

TEST(Perceptual, multiplies_by_the_studys_number) {
  EXPECT_DOUBLE_EQ(hiding_radius_pixels(10.0), 34.7);
  EXPECT_DOUBLE_EQ(hidden_texel_pixels(34.7), 10.0);
}

TEST(Perceptual, sizes_maps_for_kernels_in_world_units_by_hand) {
  // Texels of 0.1 want a kernel of 0.347. One of twice that is content with half of the map.
  EXPECT_EQ(hiding_map_size(plan_of(1000, 0.1), camera(), filter("pcf:radius=0.347,unit=world")).map_size,
            1000);
  EXPECT_EQ(hiding_map_size(plan_of(1000, 0.1), camera(), filter("esm:radius=0.694,unit=world")).map_size,
            500);
  const HidingMapSize odd = hiding_map_size(plan_of(1000, 0.1), camera(), filter("pcf:radius=1,unit=world"));
  EXPECT_EQ(odd.map_size, 347);
  EXPECT_TRUE(odd.hides);
  EXPECT_EQ(odd.radius_world, 1.0);
  // The view is 2 tan(0.45) z high and has 100 pixels; the map begins at z = 2.
  EXPECT_NEAR(odd.radius_pixels, 100.0 / (4.0 * std::tan(0.45)), 100.0 * kRounding);
  // Pixels twice as close side by side: what hides along one side only shows along the other.
  Camera close = camera();
  close.width *= 2;
  const HidingMapSize same = hiding_map_size(plan_of(1000, 0.1), close, filter("pcf:radius=1,unit=world"));
  EXPECT_NEAR(same.radius_pixels, 2.0 * odd.radius_pixels, 100.0 * kRounding);
}

TEST(Perceptual, kernels_are_as_wide_at_every_depth_of_a_parallel_view) {
  const Camera view = orthographic_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 20.0, 2.0, 0.5, 60.0, 200, 100);
  const FilterSettings settings = filter("pcf:radius=1,unit=world");
  for (const double depth_begin : {2.0, 40.0})
    EXPECT_NEAR(hiding_map_size(plan_of(1000, 0.1, depth_begin), view, settings).radius_pixels, 5.0,
                100.0 * kRounding);
}

TEST(Perceptual, sizes_all_maps_for_the_worst_of_them) {
  ShadowPlan plan = plan_of(1000, 0.1);
  plan.map_count = 2;
  plan.map[1] = plan.map[0];
  plan.map[1].width = 500;
  plan.map[1].texel_world_max = {0.3, 0.05};
  EXPECT_EQ(hiding_map_size(plan, camera(), filter("pcf:radius=0.347,unit=world")).map_size, 1500);
}

TEST(Perceptual, requires_of_kernels_in_texels_only_that_they_span_enough_of_them) {
  const ShadowPlan plan = plan_of(1000, 0.1);
  const HidingMapSize wide = hiding_map_size(plan, camera(), filter("vsm:radius=3"));
  EXPECT_EQ(wide.map_size, kLeastMapSize);
  EXPECT_TRUE(wide.hides);
  EXPECT_EQ(wide.radius_world, 0.0);
  EXPECT_FALSE(hiding_map_size(plan, camera(), filter("vsm:radius=2.9")).hides);
}

TEST(Perceptual, maps_penumbras_back_on_the_map) {
  // Half the sun's angle spans tan(0.5 degrees) * 40 at 40 units.
  const double sun = 40.0 * std::tan(0.5 * std::numbers::pi / 180.0);
  EXPECT_NEAR(kernel_radius_world(filter("pcss:angle_deg=1"), {40.0, 0.0}), sun, kRounding);
  // A local light of radius 0.5, halfway up: as much again below the blocker.
  EXPECT_NEAR(kernel_radius_world(filter("pcss:light_radius=0.5"), {5.0, 10.0}), 0.5, kRounding);
  EXPECT_EQ(kernel_radius_world(filter("pcss:light_radius=0.5,radius=0.2,unit=world"), {5.0, 10.0}), 0.2);
  EXPECT_EQ(
      hiding_map_size(plan_of(1000, 0.1), camera(), filter("pcss:light_radius=0.694"), {5.0, 10.0}).map_size,
      500);
}

TEST(Perceptual, undoes_the_radius_by_the_texel) {
  for_all(1000, [] {
    const double texel = std::exp2(between(-10.0, 12.0));
    const double again = hidden_texel_pixels(hiding_radius_pixels(texel));
    require(std::abs(again - texel) <= kRounding * texel, texel, again);
    require(hiding_radius_pixels(1.01 * texel) > hiding_radius_pixels(texel), texel);
  });
}

TEST(Perceptual,
     answers_with_the_smallest_map_that_hides_and_grows_it_with_texels_and_shrinks_it_with_kernels) {
  for_all(1000, [] {
    const int side = 4 + test::pick(8000);
    const double texel = std::exp2(between(-6.0, 3.0)), more = between(1.0, 4.0);
    FilterSettings settings = filter("pcf:unit=world");
    settings.radius = std::exp2(between(-3.0, 6.0));
    const HidingMapSize size = hiding_map_size(plan_of(side, texel), camera(), settings);
    // Texels as they are on a map of the answer's size, and on one a texel smaller.
    const auto wants = [&](int map_size) { return kHidingRadius * texel * side / map_size; };
    constexpr double kCeiling = 1e-8;  // the code lets a billionth of a side pass
    require(size.hides == (wants(kMaxMapSize) <= settings.radius), side, texel, settings.radius);
    if (size.hides) require(wants(size.map_size) <= settings.radius * (1.0 + kCeiling), size.map_size);
    if (size.map_size > kLeastMapSize) require(wants(size.map_size - 1) > settings.radius, size.map_size);
    const int coarser = hiding_map_size(plan_of(side, more * texel), camera(), settings).map_size;
    require(coarser >= size.map_size, coarser, size.map_size);
    settings.radius *= more;
    const int wider = hiding_map_size(plan_of(side, texel), camera(), settings).map_size;
    require(wider <= size.map_size, wider, size.map_size);
  });
}

TEST(Perceptual, holds_for_plans_of_the_size_it_returns) {
  const Scene scene = box_on_ground();
  const FilterSettings settings = filter("pcf:radius=0.5,unit=world");
  PlanOptions options;
  set_margin(settings, options);
  options.prune = options.prune.without(PruneRule::metric_resolution);  // what hides may ask for more
  options.resolution.max_size = 2048;
  const glm::dvec3 light{0.4, -1.0, -0.3};
  const auto plan = [&] { return plan_for(scene, camera(), light, options); };
  const int size = hiding_map_size(plan(), camera(), settings).map_size;
  EXPECT_LT(size, 2048);
  options.resolution.max_size = size;
  constexpr double kRim = 1.1;  // a small map's rim is a larger share of it
  const ShadowPlan smaller = plan();
  ASSERT_GT(smaller.map_count, 0);
  for (const ShadowMap& map : smaller.maps()) {
    EXPECT_LE(std::max(map.texel_world_max.x, map.texel_world_max.y) * kHidingRadius, kRim * settings.radius);
  }
}

TEST(Perceptual, evaluates_visible_points_alone_where_they_are_known) {
  const Scene scene = box_on_ground();
  const FilterSettings settings = filter("pcf:radius=0.5,unit=world");
  PlanOptions options;
  set_margin(settings, options);
  options.prune = options.prune.without(PruneRule::metric_resolution);
  options.resolution.max_size = 1024;
  options.cascades = 1;
  const Camera view = camera();
  const ShadowPlan plan = plan_for(scene, view, {0.4, -1.0, -0.3}, options);
  ASSERT_EQ(plan.map_count, 1);
  const std::vector<glm::dvec3> near{{0.0, 0.0, 1.5}};
  const std::vector<glm::dvec3> both{{0.0, 0.0, 1.5}, {1.5, 0.0, -1.5}};
  const std::vector<glm::dvec3> nowhere{{1e6, 1e6, 1e6}};
  ASSERT_GE(map_serving(plan, near[0], glm::dot(near[0] - view.position, glm::normalize(view.forward))), 0);
  const int everywhere = hiding_map_size(plan, view, settings).map_size;
  const int one = hiding_map_size(plan, view, settings, {}, near).map_size;
  const int two = hiding_map_size(plan, view, settings, {}, both).map_size;
  EXPECT_GT(one, kLeastMapSize);
  EXPECT_GE(two, one);
  EXPECT_LE(two, static_cast<int>(1.05 * everywhere));  // the half vector's surface is seen within 5 %
  EXPECT_EQ(hiding_map_size(plan, view, settings, {}, nowhere).map_size, kLeastMapSize);
  // A texel of a pixel needs no kernel.
  const double m = measure_perspective(plan.map[0], view, near[0]).perspective_max;
  EXPECT_EQ(hiding_map_size(plan, view, filter("pcf:radius=0.0001,unit=world"), {}, near).map_size,
            static_cast<int>(std::ceil(std::max(plan.map[0].width, plan.map[0].height) * m)));
}

}  // namespace
}  // namespace gnomon::render
