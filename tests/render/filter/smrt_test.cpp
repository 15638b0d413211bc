// Soft shadows by rays through the depth map: hard where the light is small, and as wide as the light makes
// them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "filter_harness.hpp"

namespace gnomon::render {
namespace {

/// An occluder over x < 0 at `away` world units from a receiver in the middle of a depth range of 10; 10
/// texels per world unit.
FilterLookup edge(double x, double away) {
  FilterLookup lookup;
  lookup.map_depth = [away](int column, int) { return column < 0 ? 0.8 - away / 10.0 : 1.0; };
  lookup.position = {x, 0.3};
  lookup.depth = 0.8;
  lookup.disc = glm::dmat2(32.5);
  lookup.texels_per_world = glm::dmat2(10.0);
  lookup.ray = {lookup.depth, 1.0, 0.1, 0.0};
  return lookup;
}

double mean_lit(double x, double away, const FilterSettings& settings) {
  double lit = 0.0;
  for (int turn = 0; turn < 16; ++turn) {
    FilterLookup lookup = edge(x, away);
    lookup.rotation = turn * 0.4;
    lit += filters::smrt.reference.visibility({}, lookup, settings) / 16.0;
  }
  return lit;
}

TEST(SmrtFilter, is_hard_under_a_light_too_small_to_reach_another_texel) {
  const FilterSettings settings = settings_from("smrt:angle_deg=0.01,radius=32");
  for (const double away : {0.1, 1.0, 4.0, 7.5}) {
    EXPECT_EQ(mean_lit(-0.5, away, settings), 0.0) << away;
    EXPECT_EQ(mean_lit(0.5, away, settings), 1.0) << away;
  }
}

TEST(SmrtFilter, leaves_a_slanted_plane_lit) {
  FilterLookup lookup = edge(0.5, 0.0);
  lookup.depth_gradient = {0.01, -0.02};
  lookup.map_depth = [&](int column, int row) {
    return 0.8 + 0.01 * (column + 0.5 - lookup.position.x) - 0.02 * (row + 0.5 - lookup.position.y) + 1e-9;
  };
  const FilterSettings settings = settings_from("smrt:angle_deg=20,radius=32");
  EXPECT_EQ(filters::smrt.reference.visibility({}, lookup, settings), 1.0);
}

TEST(SmrtFilter, has_penumbras_as_wide_as_the_lights_angle_times_the_distance) {
  const FilterSettings settings = settings_from("smrt:angle_deg=10,radius=32,rays=64,steps=32");
  for (const double away : {2.0, 4.0, 6.0}) {
    const double expected = 2.0 * std::tan(5.0 * std::numbers::pi / 180.0) * away * 10.0;
    double begin = 0.0, end = 0.0;
    for (double x = -30.0; x <= 30.0; x += 0.05) {
      const double lit = mean_lit(x, away, settings);
      if (lit < 0.02) begin = x;
      if (lit < 0.98) end = x;
    }
    // A texel, and the stretch of 1/32 of the march in which the caster lies.
    EXPECT_NEAR(end - begin, expected, 1.0 + 0.15 * expected) << away;
    EXPECT_NEAR(mean_lit(0.0, away, settings), 0.5, 0.1) << away;
  }
}

TEST(SmrtFilter, leaves_no_light_under_a_wall_that_the_light_grazes) {
  // From the receiver on, the wall's foot, to its top: depths jump by much from texel to texel.
  const FilterSettings settings = settings_from("smrt:angle_deg=20,radius=32,steps=32");
  for (const double x : {-1.5, -4.5, -8.5}) {
    double lit = 0.0;
    for (int turn = 0; turn < 16; ++turn) {
      FilterLookup lookup = edge(x, 0.0);
      lookup.map_depth = [](int column, int) {
        return column < 0 ? std::max(0.05, 0.79 + 0.25 * (column + 1)) : 1.0;
      };
      lookup.rotation = turn * 0.4;
      lit += filters::smrt.reference.visibility({}, lookup, settings) / 16.0;
    }
    // Rays may miss the wall's foot, which is lower than a stretch is long.
    EXPECT_LE(lit, x > -2.0 ? 0.15 : 0.05) << x;
  }
}

TEST(SmrtFilter, lets_light_pass_between_a_caster_and_the_ground) {
  // A narrow caster far above: rays under it that leave it meet nothing more.
  const FilterSettings settings = settings_from("smrt:angle_deg=30,radius=32");
  FilterLookup lookup = edge(0.5, 0.0);
  lookup.map_depth = [](int column, int) { return column == 0 ? 0.2 : 1.0; };
  EXPECT_GT(filters::smrt.reference.visibility({}, lookup, settings), 0.8);
}

TEST(SmrtFilter, returns_nearly_always_the_same_on_gpu_and_cpu) {
  const TestMap map = random_map(48, 47, 5);
  const std::vector<Question> questions = random_questions(map, 1024, 6, 2);
  const FilterSettings settings = settings_from("smrt:radius=4,angle_deg=8");
  const std::vector<float> gpu = ask_shader(settings, map, questions);
  const std::vector<double> cpu = ask_reference(settings, map, questions);
  std::size_t different = 0;
  for (std::size_t i = 0; i < questions.size(); ++i) different += std::abs(gpu[i] - cpu[i]) > 1e-4 ? 1 : 0;
  // A texel's edge or a depth that rounding carries to the other side changes one ray of eight.
  EXPECT_LE(different, questions.size() / 50);
}

}  // namespace
}  // namespace gnomon::render
