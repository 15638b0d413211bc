// Is the technique that is chosen the right one, and is what it is said to cost and to err true?
#include "gnomon/study/technique.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "plain.hpp"

namespace gnomon::test {
namespace {

constexpr std::int64_t kMebi = 1 << 20;

std::int64_t texels(const ShadowPlan& plan) {
  std::int64_t sum = 0;
  for (const ShadowMap& map : plan.maps()) sum += std::int64_t{map.width} * map.height;
  return sum;
}

TEST(Technique, error_and_texels_are_those_of_the_plan_that_is_given_out) {
  for (const double milliseconds : {4.0, 10.0, 40.0}) {
    Plain plain;
    plain.budget.milliseconds = milliseconds;
    const TechniqueChoice choice = plain.choose();
    ASSERT_EQ(choice.status, PlanStatus::ok);
    const double share = expected_error(choice.plan, plain.shadow()).share();
    ASSERT_GT(share, 1e-4);
    EXPECT_EQ(choice.chosen.error, kFilters[choice.chosen.filter].error_ratio * share) << milliseconds;
    EXPECT_EQ(choice.chosen.texels, texels(choice.plan));
    EXPECT_EQ(choice.plan.map[0].width, choice.chosen.map_size);
  }
}

TEST(Technique, least_error_within_a_budget_is_found_among_all) {
  Plain plain;
  const std::vector<Technique> all = plain.all();
  for (const double milliseconds : {5.0, 12.0, 30.0}) {
    for (const std::int64_t limit : {std::int64_t{0}, 2 * kMebi}) {
      plain.budget = {limit, 0, milliseconds, 0.0, 0.0};
      const TechniqueChoice choice = plain.choose();
      EXPECT_TRUE(choice.met);
      EXPECT_LE(choice.chosen.milliseconds, milliseconds);
      double least = std::numeric_limits<double>::infinity();
      for (const Technique& t : all) {
        if (t.milliseconds <= milliseconds && (limit == 0 || t.texels <= limit))
          least = std::min(least, t.error);
      }
      EXPECT_EQ(choice.chosen.error, least);
    }
  }
}

TEST(Technique, a_budget_that_is_missed_by_a_twentieth_is_not_met) {
  Plain plain;
  plain.budget.milliseconds = 1e-6;
  const TechniqueChoice cheapest = plain.choose();
  EXPECT_FALSE(cheapest.met);
  plain.budget.milliseconds = 0.95 * cheapest.chosen.milliseconds;
  EXPECT_FALSE(plain.choose().met);
  plain.budget.milliseconds = 1.05 * cheapest.chosen.milliseconds;
  EXPECT_TRUE(plain.choose().met);
}

TEST(Technique, of_errors_that_are_alike_the_cheapest_is_taken) {
  Plain plain;
  const std::vector<Technique> all = plain.all();
  int cheaper = 0;
  for (const double milliseconds : {5.0, 12.0, 30.0}) {
    plain.budget = {0, 0, milliseconds, 0.0, 0.0};
    const Technique strict = plain.choose().chosen;
    plain.budget.alike = 0.3;
    const Technique chosen = plain.choose().chosen;
    double least = std::numeric_limits<double>::infinity();
    for (const Technique& t : all) {
      if (t.error <= 1.3 * strict.error && t.milliseconds <= milliseconds)
        least = std::min(least, t.milliseconds);
    }
    EXPECT_EQ(chosen.milliseconds, least);
    EXPECT_LE(chosen.error, 1.3 * strict.error);
    cheaper += chosen.milliseconds < strict.milliseconds ? 1 : 0;
  }
  EXPECT_GT(cheaper, 0);
}

TEST(Technique, cheapest_at_an_error_is_found_among_all) {
  Plain plain;
  const std::vector<Technique> all = plain.all();
  for (const double error : {0.01, 0.03, 0.08}) {
    plain.budget = {0, 0, 0.0, error, 0.0};
    const TechniqueChoice choice = plain.choose();
    EXPECT_TRUE(choice.met);
    EXPECT_LE(choice.chosen.error, error);
    double least = std::numeric_limits<double>::infinity();
    for (const Technique& t : all) {
      if (t.error <= error) least = std::min(least, t.milliseconds);
    }
    EXPECT_EQ(choice.chosen.milliseconds, least);
  }
}

TEST(Technique, says_what_less_cost_and_what_less_error_would_have_taken) {
  Plain plain;
  plain.budget.milliseconds = 15.0;
  const TechniqueChoice choice = plain.choose();
  ASSERT_GT(choice.cheaper.map_size, 0);
  EXPECT_LE(choice.cheaper.milliseconds, 0.8 * choice.chosen.milliseconds);
  EXPECT_GE(choice.cheaper.error, choice.chosen.error);
  ASSERT_GT(choice.better.map_size, 0);
  EXPECT_LE(choice.better.error, 0.8 * choice.chosen.error);
  EXPECT_GT(choice.better.milliseconds, plain.budget.milliseconds);
  EXPECT_EQ(choice.tried, 3 * 4 * 5 * 2);
}

TEST(Technique, nothing_is_better_than_a_pick_without_error) {
  Plain plain;
  plain.budget.milliseconds = 15.0;
  std::fill(plain.mask.begin(), plain.mask.end(), 1.0f);
  const TechniqueChoice choice = plain.choose();
  ASSERT_LT(choice.chosen.error, 1e-15);
  EXPECT_EQ(choice.better.map_size, 0);
}

TEST(Technique, texels_are_spent_where_the_shadow_has_edges) {
  Plain plain;
  const Warp* const warp[] = {&warps::optimal};
  const int size[] = {512};
  plain.among.warps = warp;
  plain.among.map_sizes = size;
  plain.costs.filters = {kFilters, 1};
  plain.budget.alike = 0.0;
  // Without a shadow nothing is wrong; with one nearby alone, texels there are all that counts.
  Plain bare = plain;
  std::fill(bare.mask.begin(), bare.mask.end(), 1.0f);
  const TechniqueChoice none = bare.choose();
  EXPECT_LT(none.chosen.error, 1e-9);
  plain.see(15.0);
  const TechniqueChoice near = plain.choose();
  ASSERT_EQ(near.status, PlanStatus::ok);
  for (const int cascades : {1, 2, 3, 4}) {
    PlanOptions options = near.options;
    options.cascades = cascades;
    const ShadowPlan other = make_plan(plain.camera, plain.light, {plain.casters, plain.receivers}, options);
    EXPECT_GE(kFilters[0].error_ratio * expected_error(other, plain.shadow()).share(), near.chosen.error)
        << cascades;
  }
}

TEST(Technique, a_filters_errors_go_with_its_own_power_of_m) {
  Plain plain;
  constexpr FilterCost kSquare[] = {{"a", 0.0, 0.0, 2.0, 4.0, 1.0, 1.0},
                                    {"b", 0.0, 0.0, 1.0, 12.0, 3.0, 0.5}};
  plain.budget.alike = 0.0;
  plain.costs.filters = {kSquare, 1};
  const Technique linear = plain.choose().chosen;
  plain.costs.filters = {kSquare + 1, 1};
  const Technique root = plain.choose().chosen;
  EXPECT_NEAR(root.error, 3.0 * std::sqrt(linear.error), 1e-12 * root.error);
  EXPECT_EQ(linear.bytes, 4 * linear.texels);
  EXPECT_EQ(root.bytes, 12 * root.texels);
}

TEST(Technique, each_filter_errs_as_its_kernel_is_expected_to) {
  Plain plain;
  const int size[] = {512};
  plain.among.map_sizes = size;
  plain.budget.alike = 0.0;
  for (const double kernel : {0.0, 1.5, 2.5}) {
    // Another kernel is looked at before it, and costs too much.
    const FilterCost both[] = {{"dear", 0.0, 0.0, 1e9, 4.0}, {"own", 0.0, 0.0, 1.0, 4.0}};
    FilterCost filters[] = {both[0], both[1]};
    filters[0].kernel_texels = 4.5;
    filters[1].kernel_texels = kernel;
    plain.costs.filters = filters;
    plain.budget.milliseconds = 1e6;
    const TechniqueChoice choice = plain.choose();
    ASSERT_EQ(choice.status, PlanStatus::ok);
    EXPECT_EQ(choice.chosen.filter, 1);
    EXPECT_EQ(choice.chosen.error, expected_error(choice.plan, plain.shadow(), kernel).share());
  }
}

TEST(Technique, each_filter_is_planned_with_its_own_border) {
  Plain plain;
  const int size[] = {256};
  plain.among.map_sizes = size;
  plain.budget.alike = 0.0;
  // The base's counts for none of them.
  plain.base.filter = {7.0, 0.0};
  FilterCost filters[] = {kFilters[0], kFilters[1], kFilters[1]};
  filters[0].extent = {0.0, 0.0};
  filters[1].extent = filters[2].extent = {24.0, 0.0};
  std::vector<Technique> alone;
  for (const FilterCost& filter : filters) {
    plain.costs.filters = {&filter, 1};
    const TechniqueChoice choice = plain.choose();
    ASSERT_EQ(choice.status, PlanStatus::ok);
    EXPECT_EQ(choice.options.filter, filter.extent);
    EXPECT_EQ(choice.chosen.error, filter.error_ratio * expected_error(choice.plan, plain.shadow()).share());
    alone.push_back(choice.chosen);
  }
  // A wide border leaves coarser texels.
  EXPECT_GT(alone[1].error / filters[1].error_ratio, 1.05 * alone[0].error / filters[0].error_ratio);
  // Together each has what it has alone, and filters of one border share their plans.
  for (const bool hard_is_dear : {false, true}) {
    filters[0].lookup_ms_per_megapixel = hard_is_dear ? 1e9 : 0.0;
    plain.costs.filters = filters;
    plain.budget.milliseconds = 1e6;
    const TechniqueChoice choice = plain.choose();
    const auto own = static_cast<std::size_t>(hard_is_dear ? 1 : 0);
    EXPECT_EQ(choice.chosen.filter, static_cast<int>(own));
    EXPECT_EQ(choice.chosen.error, alone[own].error);
    EXPECT_EQ(choice.options.filter, filters[own].extent);
    EXPECT_EQ(choice.tried, 3 * 4 * 3);
  }
  // What a small map cannot spare.
  filters[0] = kFilters[0];
  filters[0].extent = {1e6, 0.0};
  plain.costs.filters = {filters, 1};
  EXPECT_EQ(plain.choose().options.filter.texels, 64.0);
}

TEST(Technique, a_large_picture_takes_no_more_pixels_than_a_small_one) {
  Plain plain;
  const int size[] = {512}, one[] = {1};
  plain.among.map_sizes = size;
  plain.among.cascades = one;
  plain.budget.alike = 0.0;
  EXPECT_EQ(pixels_between(plain.shadow()), 1);
  plain.picture.width = 600;
  plain.picture.height = 400;
  plain.see(200.0);
  EXPECT_EQ(pixels_between(plain.shadow()), 2);
  const TechniqueChoice choice = plain.choose();
  ASSERT_EQ(choice.status, PlanStatus::ok);
  const double share = expected_error(choice.plan, plain.shadow(), 0.0, 2).share();
  EXPECT_EQ(choice.chosen.error, kFilters[choice.chosen.filter].error_ratio * share);
  EXPECT_NEAR(share, expected_error(choice.plan, plain.shadow()).share(), 0.1 * share);
}

TEST(Technique, work_is_what_culling_leaves_for_each_map) {
  const Plain plain;
  PlanOptions options;
  options.cascades = 3;
  const ShadowPlan plan = make_plan(plain.camera, plain.light, {plain.casters, plain.receivers}, options);
  ASSERT_EQ(plan.map_count, 3);
  double draws = 0.0, triangles = 0.0;
  std::vector<std::uint32_t> kept(plain.casters.size());
  for (const ShadowMap& map : plan.maps()) {
    const std::size_t count = cull_casters(map, plain.casters, kept);
    draws += static_cast<double>(count);
    triangles += 1000.0 * static_cast<double>(count);
  }
  ASSERT_GT(draws, 0.0);
  const PlanWork work = planned_work(plan, {plain.casters, plain.receivers}, plain.work);
  EXPECT_EQ(work.maps, 3.0);
  EXPECT_NEAR(work.kilodraws, draws / 1e3, 1e-12);
  EXPECT_NEAR(work.megatriangles, triangles / 1e6, 1e-12);
  EXPECT_NEAR(work.megatexels, static_cast<double>(texels(plan)) / 1e6, 1e-12);
}

/// Middles of texels whose light meets a box.
double texels_under(const ShadowMap& map, const Box& box) {
  const glm::dmat4 world_from_clip = glm::inverse(map.clip_from_world);
  const auto at = [&](int x, int y, double z) {
    const glm::dvec4 p = world_from_clip * glm::dvec4((x + 0.5) * 2.0 / map.width - 1.0,
                                                      (y + 0.5) * 2.0 / map.height - 1.0, z, 1.0);
    return glm::dvec3(p) / p.w;
  };
  double count = 0.0;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      count += cross(box, at(x, y, -1.0), at(x, y, 1.0) - at(x, y, -1.0)).hits ? 1.0 : 0.0;
  return count;
}

TEST(Technique, texels_are_counted_as_often_as_casters_cover_them) {
  Plain plain;
  PlanOptions options;
  options.cascades = 1;
  options.resolution.max_size = 256;
  for (const Light& light : {Light(DirectionalLight{{0.2, -1, 0.1}}), Light(DirectionalLight{{0.9, -1, 0.4}}),
                             Light(SpotLight{{0, 30, -20}, {0, -1, -0.3}, 0.7, 120})}) {
    for (const Warp* warp : {&warps::none, &warps::optimal}) {
      options.warp.warp = warp;
      const ShadowPlan plan = make_plan(plain.camera, light, {plain.casters, plain.receivers}, options);
      ASSERT_EQ(plan.map_count, 1);
      double counted = 0.0, covered = 0.0;
      for (std::size_t i = 0; i < plain.casters.size(); i += 6) {
        const std::vector<Box> box{plain.casters[i]};
        const std::vector<CasterWork> work{{12, false, 0.0}};
        covered += 1e6 * planned_work(plan, {box, plain.receivers}, work).megatexels_covered;
        counted += texels_under(plan.map[0], box[0]);
      }
      EXPECT_GT(counted, 300.0);
      EXPECT_NEAR(covered, counted, 0.3 * counted) << warp->name;
    }
  }
}

TEST(Technique, area_of_triangles_counts_by_half_and_tested_ones_count_apart) {
  const Plain plain;
  const ShadowPlan plan = make_plan(plain.camera, plain.light, {plain.casters, plain.receivers}, {});
  const std::vector<Box> box{plain.casters[3]};
  const glm::dvec3 side = box[0].max - box[0].min;
  const auto covered = [&](const CasterWork& caster) {
    return planned_work(plan, {box, plain.receivers}, std::vector<CasterWork>{caster});
  };
  const PlanWork unknown = covered({12, false, 0.0}), tested = covered({12, true, 0.0});
  ASSERT_GT(unknown.megatexels_covered, 0.0);
  EXPECT_EQ(unknown.megatexels_tested, 0.0);
  EXPECT_EQ(tested.megatexels_tested, unknown.megatexels_covered);
  EXPECT_EQ(tested.megatexels_covered, 0.0);
  // A closed box shows half of its sides in the mean over all directions, and here its large top.
  const double sides = 2.0 * (side.x * side.y + side.y * side.z + side.z * side.x);
  const glm::dvec3 d = glm::abs(glm::normalize(std::get<DirectionalLight>(plain.light).direction));
  const double outline = d.x * side.y * side.z + d.y * side.z * side.x + d.z * side.x * side.y;
  EXPECT_NEAR(covered({12, false, sides}).megatexels_covered,
              unknown.megatexels_covered * 0.5 * sides / outline, 1e-12);
}

TEST(Technique, the_nearest_is_taken_and_reported_where_nothing_fits) {
  Plain plain;
  plain.budget.milliseconds = 0.1;
  const TechniqueChoice choice = plain.choose();
  EXPECT_EQ(choice.status, PlanStatus::ok);
  EXPECT_FALSE(choice.met);
  for (const Technique& t : plain.all()) EXPECT_GE(t.milliseconds, choice.chosen.milliseconds);
}

TEST(Technique, alpha_tested_casters_cost_what_their_texels_cost) {
  Plain plain;
  const Warp* const one[] = {&warps::none};
  const int cascades[] = {1}, sizes[] = {1024};
  plain.among = {one, {}, cascades, sizes};
  for (CasterWork& w : plain.work) w.alpha_tested = false;
  const double opaque = plain.choose().chosen.milliseconds;
  for (CasterWork& w : plain.work) w.alpha_tested = true;
  const TechniqueChoice tested = plain.choose();
  const PlanWork work = planned_work(tested.plan, {plain.casters, plain.receivers}, plain.work);
  ASSERT_GT(work.megatexels_tested, 0.01);
  EXPECT_NEAR(tested.chosen.milliseconds - opaque, 3.0 * work.megatexels_tested, 1e-9);
}

TEST(Technique, is_chosen_by_texels_where_no_time_is_known) {
  Plain plain;
  constexpr FilterCost kFree[] = {{"free"}};
  plain.costs = {};
  plain.costs.filters = kFree;
  plain.budget.target_error = 0.03;
  const TechniqueChoice choice = plain.choose();
  ASSERT_TRUE(choice.met);
  for (const Technique& t : plain.all()) {
    EXPECT_TRUE(t.error > 0.03 || t.texels >= choice.chosen.texels);
  }
}

TEST(Technique, filters_alone_may_take_time) {
  Plain plain;
  plain.costs = {};
  plain.costs.filters = kFilters;
  plain.budget.target_error = 0.03;
  EXPECT_EQ(plain.choose().chosen.filter, 0) << "hard takes less than pcf, whatever the texels";
}

TEST(Technique, what_is_beyond_the_most_is_not_tried) {
  Plain plain;
  const std::vector<int> cascades(200, 1);  // of three warps
  plain.picture.width = plain.picture.height = 4;
  plain.see(200.0);
  const int size[] = {512};
  plain.among.cascades = cascades;
  plain.among.map_sizes = size;
  plain.costs.filters = {kFilters, 1};
  EXPECT_EQ(plain.choose().tried, static_cast<int>(TechniqueSet::kMost));
}

TEST(Technique, local_lights_have_the_maps_they_have) {
  Plain plain;
  plain.light = PointLight{{0, 6, -10}, 80};
  const TechniqueChoice choice = plain.choose();
  ASSERT_EQ(choice.status, PlanStatus::ok);
  EXPECT_EQ(choice.tried, 3 * 5 * 2);
  EXPECT_EQ(choice.chosen.texels, texels(choice.plan));
}

TEST(Technique, broken_input_is_named) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  const auto field = [](const Plain& plain) {
    const TechniqueChoice choice = plain.choose();
    EXPECT_EQ(choice.status, PlanStatus::invalid_input);
    return choice.invalid_field;
  };
  for (const double bad : {nan, infinity, -1.0}) {
    Plain plain;
    plain.budget.milliseconds = bad;
    EXPECT_EQ(field(plain), "budget");
    plain = {};
    plain.costs.drawing.per_map = bad;
    EXPECT_EQ(field(plain), "cost_model");
  }
  Plain plain;
  plain.costs.filters = {};
  EXPECT_EQ(field(plain), "cost_model.filters");
  std::vector<FilterCost> kernels(kMaxKernels + 1, kFilters[0]);
  for (std::size_t i = 0; i < kernels.size(); ++i) kernels[i].kernel_texels = 0.5 + static_cast<double>(i);
  plain.costs.filters = kernels;
  EXPECT_EQ(field(plain), "cost_model.filters");
  plain.costs.filters = {kernels.data(), kMaxKernels};
  EXPECT_EQ(plain.choose().status, PlanStatus::ok);
  for (const double bad : {nan, infinity, -1.0, kMaxKernelTexels + 1.0}) {
    kernels[0].kernel_texels = bad;
    EXPECT_EQ(field(plain), "cost_model.filters");
    kernels[0].kernel_texels = 0.0;
    if (bad > 0.0 && std::isfinite(bad)) continue;  // an extent is cut
    for (double FilterExtent::*const side : {&FilterExtent::texels, &FilterExtent::world}) {
      kernels[0].extent = {};
      kernels[0].extent.*side = bad;
      EXPECT_EQ(field(plain), "cost_model.filters");
    }
    kernels[0].extent = {};
  }
  plain = {};
  const int sizes[] = {1024, 2};
  plain.among.map_sizes = sizes;
  EXPECT_EQ(field(plain), "map_sizes");
  plain = {};
  plain.mask.pop_back();
  EXPECT_EQ(field(plain), "shadow");
  plain.depths.pop_back();
  EXPECT_EQ(field(plain), "shadow");
  plain = {};
  plain.occluder_distances = {1.0f};
  EXPECT_EQ(field(plain), "shadow");
  plain = {};
  plain.picture.height = 0;
  EXPECT_EQ(field(plain), "shadow");
  plain = {};
  plain.camera.far_depth = nan;
  EXPECT_EQ(field(plain), "camera.far_depth");
}

TEST(Technique, nothing_is_chosen_where_nothing_is_in_view) {
  Plain plain;
  plain.receivers = {{{-1, 0, 50}, {1, 1, 60}}};
  const TechniqueChoice choice = plain.choose();
  EXPECT_EQ(choice.status, PlanStatus::nothing_visible);
  EXPECT_EQ(choice.plan.map_count, 0);
  EXPECT_EQ(choice.chosen.map_size, 0);
}

}  // namespace
}  // namespace gnomon::test
