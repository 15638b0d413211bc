// Percentage-closer filtering: kernels of every width, the same on GPU and CPU.
#include <gtest/gtest.h>

#include "filter_harness.hpp"

namespace gnomon::render {
namespace {

/// Sums of at most 100 terms with weights up to 1, then one division, in float.
constexpr double kSumRounding = 100.0 * 6e-8;
constexpr double kWeights = 1e-12;  ///< weights added in double make up 1 to this
constexpr FilterParameters kRadii[] = {{0.0}, {1.0}, {2.0}, {3.0}, {4.0}};

/// Dark left of column 8, lit from it on.
FilterLookup edge_at_8(double x) {
  FilterLookup lookup;
  lookup.texel = [](int column, int) { return StoredTexel{column < 8 ? 0.25 : 0.75, 0, 0, 0}; };
  lookup.position = {x, 5.2};
  lookup.depth = 0.5;
  return lookup;
}

TEST(PcfFilter, is_all_or_nothing_where_all_texels_agree) {
  for (const FilterParameters& parameters : kRadii) {
    EXPECT_NEAR(filters::pcf.visibility(edge_at_8(30.3), parameters), 1.0, kWeights);
    EXPECT_EQ(filters::pcf.visibility(edge_at_8(-20.7), parameters), 0.0);
  }
}

TEST(PcfFilter, ramps_linearly_over_the_kernels_width_at_an_edge) {
  for (const FilterParameters& parameters : kRadii) {
    const double width = 2.0 * parameters.radius_texels + 1.0;
    for (double x = 8.0 - width / 2.0; x <= 8.0 + width / 2.0; x += 0.17) {
      const double expected = 0.5 + (x - 8.0) / width;
      EXPECT_NEAR(filters::pcf.visibility(edge_at_8(x), parameters), expected, kWeights) << x << " " << width;
    }
  }
}

TEST(PcfFilter, does_not_shadow_a_plane_with_itself_however_wide_the_kernel) {
  FilterLookup lookup;
  const glm::dvec2 gradient{0.011, -0.007};
  lookup.texel = [&](int x, int y) {
    return StoredTexel{0.3 + gradient.x * (x + 0.5) + gradient.y * (y + 0.5) + 1e-12, 0, 0, 0};
  };
  lookup.depth_gradient = gradient;
  for (const FilterParameters& parameters : {kRadii[1], kRadii[4]}) {
    for (double x = 20.0; x < 21.0; x += 0.13) {
      lookup.position = {x, 20.4};
      lookup.depth = 0.3 + gradient.x * x + gradient.y * 20.4;
      EXPECT_NEAR(filters::pcf.visibility(lookup, parameters), 1.0, kWeights);
    }
  }
}

TEST(PcfFilter, is_lit_where_the_receivers_plane_goes_on_behind_the_far_plane) {
  FilterLookup lookup;
  lookup.texel = [](int, int) { return StoredTexel{1.0, 0, 0, 0}; };
  lookup.position = {8.3, 8.4};
  lookup.depth = 0.99;
  lookup.depth_gradient = {0.02, 0.01};
  for (const FilterParameters& parameters : kRadii)
    EXPECT_NEAR(filters::pcf.visibility(lookup, parameters), 1.0, kWeights);
}

TEST(PcfFilter, answers_the_same_on_gpu_and_cpu_for_every_width) {
  for (const auto& [width, height] : {std::pair{64, 64}, std::pair{48, 83}}) {
    const TestMap map = random_map(width, height, 3);
    const std::vector<Question> questions = random_questions(map, 2048, 4);
    for (const FilterParameters& parameters : kRadii) {
      const std::vector<float> gpu = ask_shader(filters::pcf, parameters, map, questions);
      const std::vector<double> cpu = ask_reference(filters::pcf, parameters, map, questions);
      // The hardware's bilinear weights have at least 8 bits.
      const double bound = parameters.radius_texels == 0.0 ? 2.0 / 256.0 : kSumRounding;
      double between = 0.0;
      for (std::size_t i = 0; i < gpu.size(); ++i) {
        ASSERT_NEAR(gpu[i], cpu[i], bound) << i << " radius " << parameters.radius_texels << ": "
                                           << questions[i].position.x << " " << questions[i].position.y;
        between += cpu[i] > 0.0 && cpu[i] < 1.0 ? 1.0 : 0.0;
      }
      EXPECT_GT(between, 500.0);
    }
  }
}

TEST(PcfFilter, reads_no_further_than_it_says) {
  for (const FilterParameters& parameters : kRadii) {
    const double reach = filters::pcf.reach_texels(parameters);
    FilterLookup lookup = edge_at_8(0.0);
    lookup.texel = [&](int x, int) {
      EXPECT_LE(std::abs(x + 0.5 - lookup.position.x), reach);
      return StoredTexel{1.0, 0, 0, 0};
    };
    for (double x = 30.0; x < 31.0; x += 0.09) {
      lookup.position = {x, 10.0};
      EXPECT_NEAR(filters::pcf.visibility(lookup, parameters), 1.0, kWeights);
    }
  }
}

TEST(PcfFilter, stores_the_depth_itself) {
  const std::vector<float> depths{0.0f, 0.125f, 0.7f, 1.0f};
  EXPECT_EQ(stored_by_shader(filters::pcf, depths), depths);
  for (const float depth : depths) EXPECT_EQ(filters::pcf.store(depth, {})[0], depth);
}

}  // namespace
}  // namespace gnomon::render
