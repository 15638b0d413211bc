// Moment soft shadows: penumbras as wide as the light makes them, smooth, and right far from the table's
// origin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "filter_harness.hpp"

namespace gnomon::render {
namespace {

constexpr float kReceiver = 0.8f;

/// An occluder over the left half, `away` world units above a receiver at kReceiver; nothing else.
TestMap edge_map(int side, double away) {
  TestMap map{side, side, {}};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x)
      map.depth.push_back(x < side / 2 ? static_cast<float>(kReceiver - away / kTestDepthRange) : 1.0f);
  }
  return map;
}

std::vector<float> lit_across(const FilterSettings& settings, const TestMap& map) {
  std::vector<Question> questions;
  for (float x = 34.0f; x <= static_cast<float>(map.width) - 34.0f; x += 0.25f)
    questions.push_back({{x, 40.3f}, kReceiver, {}, 0.0f});
  return ask_shader(settings, map, questions);
}

/// Texels between 2 % and 98 % lit.
double penumbra_texels(const std::vector<float>& lit) {
  const auto begin = std::find_if(lit.begin(), lit.end(), [](float v) { return v > 0.02f; });
  const auto end = std::find_if(lit.begin(), lit.end(), [](float v) { return v > 0.98f; });
  return 0.25 * static_cast<double>(end - begin);
}

TEST(MssmFilter, has_penumbras_as_wide_as_the_lights_angle_times_the_distance) {
  FilterSettings settings = settings_from("mssm:angle_deg=40,radius=32,bleed=0");
  for (const double away : {0.2, 2.0, 4.0, 6.0}) {
    const double disc = 2.0 * std::tan(20.0 * std::numbers::pi / 180.0) * away * kTestTexelsPerWorld;
    // A box of the disc's variance; a texel is the narrowest.
    const double expected = std::max(0.96 * 0.866 * disc, 0.96);
    EXPECT_NEAR(penumbra_texels(lit_across(settings, edge_map(128, away))), expected, 0.5 + 0.03 * expected)
        << away;
  }
}

TEST(MssmFilter, fades_evenly_without_the_steps_and_noise_of_samples) {
  const std::vector<float> lit =
      lit_across(settings_from("mssm:angle_deg=40,radius=32,bleed=0"), edge_map(128, 4.0));
  const double step = 0.25 / (2.0 * 0.866 * std::tan(20.0 * std::numbers::pi / 180.0) * 4.0 * 8.0);
  for (std::size_t i = 1; i < lit.size(); ++i) {
    EXPECT_GE(lit[i], lit[i - 1] - 1e-3f) << i;
    EXPECT_LE(lit[i], lit[i - 1] + 1.5 * step) << i;
  }
}

TEST(MssmFilter, keeps_to_the_widest_kernel) {
  const double narrow =
      penumbra_texels(lit_across(settings_from("mssm:angle_deg=40,radius=5,bleed=0"), edge_map(128, 6.0)));
  EXPECT_NEAR(narrow, 0.96 * 11.0, 1.0);
}

TEST(MssmFilter, widens_for_local_lights_by_the_ratio_of_distances) {
  // A receiver 8 units from a light of radius 0.5, all of its kernel under a blocker.
  const FilterSettings settings = settings_from("mssm:light_radius=0.5,radius=32");
  const TestMap map = edge_map(128, 0.0);
  for (const double away : {1.0, 2.0, 4.0}) {
    FilterLookup lookup = lookup_of(settings, map, {{64.0f, 64.0f}, kReceiver, {}, 0.0f});
    lookup.light_distance = 8.0;
    const StoredTexel blocker =
        filters::mssm.reference.store(kReceiver - away / kTestDepthRange, glm::dvec2(0.0), settings);
    double half_side = 0.0;
    lookup.mean_of_box = [&](const glm::dvec2& half_sides) {
      half_side = half_sides.x;
      EXPECT_EQ(half_sides.x, half_sides.y);
      return blocker;
    };
    EXPECT_LT(filters::mssm.reference.visibility(blocker, lookup, settings), 0.01);
    const double disc = 0.5 * away / (8.0 - away) * kTestTexelsPerWorld;
    EXPECT_NEAR(half_side, std::max(0.866 * disc, 0.5), 0.01 * disc) << away;
  }
}

TEST(MssmFilter, leaves_a_flat_surface_lit_far_from_the_tables_origin) {
  constexpr int kSide = 512;
  const TestMap map{kSide, kSide, std::vector<float>(static_cast<std::size_t>(kSide) * kSide, 0.7f)};
  for (const char* text : {"mssm:radius=0", "mssm", "mssm:radius=32"}) {
    std::vector<Question> questions;
    for (float at = 40.0f; at < 470.0f; at += 7.3f) questions.push_back({{at, 500.0f - at}, 0.7f, {}, 0.0f});
    for (const float lit : ask_shader(settings_from(text), map, questions))
      ASSERT_GE(lit, 1.0f - 1e-3f) << text;
  }
}

}  // namespace
}  // namespace gnomon::render
