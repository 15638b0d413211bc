// The hard filter: one comparison, the same on GPU and CPU.
#include <gtest/gtest.h>

#include "filter_harness.hpp"

namespace gnomon::render {
namespace {

FilterLookup lookup_in(float depth_of_map, glm::dvec2 position, double depth, glm::dvec2 gradient) {
  FilterLookup lookup;
  lookup.map_depth = [depth_of_map](int, int) { return double{depth_of_map}; };
  lookup.position = position;
  lookup.depth = depth;
  lookup.depth_gradient = gradient;
  return lookup;
}

TEST(HardFilter, is_lit_at_the_stored_depth_and_dark_behind_it) {
  const auto see = [](double depth) {
    return filters::hard.reference.visibility({}, lookup_in(0.5f, {3.5, 3.5}, depth, {}), {});
  };
  EXPECT_EQ(see(0.25), 1.0);
  EXPECT_EQ(see(0.5), 1.0);
  EXPECT_EQ(see(0.5 + 1e-9), 0.0);
}

TEST(HardFilter, compares_the_receivers_plane_at_the_texels_centre) {
  // A quarter texel left of the centre, the plane rising by 0.4 a texel: 0.1 deeper at the centre.
  EXPECT_EQ(filters::hard.reference.visibility({}, lookup_in(0.59f, {3.25, 3.5}, 0.5, {0.4, 0.0}), {}), 0.0);
  EXPECT_EQ(filters::hard.reference.visibility({}, lookup_in(0.61f, {3.25, 3.5}, 0.5, {0.4, 0.0}), {}), 1.0);
}

TEST(HardFilter, follows_the_plane_by_the_texels_of_either_piece) {
  // The next piece begins an eighth of a texel before the centre, and its texels are five times as long.
  FilterLookup lookup = lookup_in(0.0f, {3.25, 3.5}, 0.5, {0.4, 0.0});
  lookup.ends_above = {0.125, 0.0};
  lookup.longer_above = {4.0, 0.0};
  for (const double off : {-1e-9, 1e-9}) {
    lookup.map_depth = [off](int, int) { return 0.5 + 0.4 * (0.125 + 5.0 * 0.125) + off; };
    EXPECT_EQ(filters::hard.reference.visibility({}, lookup, {}), off < 0.0 ? 0.0 : 1.0);
  }
}

TEST(HardFilter, returns_the_same_on_gpu_and_cpu) {
  // Sides that are no powers of two too: texel centres over the side are then rounded.
  for (const auto& [width, height] : {std::pair{64, 64}, std::pair{48, 83}}) {
    const TestMap map = random_map(width, height, 1);
    const std::vector<Question> questions = random_questions(map, 4096, 2);
    const std::vector<float> gpu = ask_shader(settings_from("hard"), map, questions);
    const std::vector<double> cpu = ask_reference(settings_from("hard"), map, questions);
    double lit = 0.0;
    for (std::size_t i = 0; i < gpu.size(); ++i) {
      ASSERT_EQ(gpu[i], cpu[i]) << i << ": " << questions[i].position.x << " " << questions[i].position.y;
      lit += cpu[i];
    }
    EXPECT_GT(lit, 1000.0);
    EXPECT_LT(lit, 3500.0);
  }
}

}  // namespace
}  // namespace gnomon::render
