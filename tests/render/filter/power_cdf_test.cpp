// The power-law filter against the golden rows, its limits and its degenerate kernels.
#include "filter/power_cdf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "filter_harness.hpp"
#include "golden_filters.hpp"

namespace gnomon::render {
namespace {

constexpr double kGolden = 1e-9;  ///< golden rows are computed in double

TEST(PowerCdfFilter, is_a_step_where_all_depths_agree) {
  EXPECT_EQ(power_lit(0.5, 0.5, 0.5, 0.5), 1.0);
  EXPECT_EQ(power_lit(0.5, 0.5, 0.5, 0.5 + 1e-12), 0.0);
}

TEST(PowerCdfFilter, stays_finite_where_the_mean_is_an_end_of_the_range_or_rounded_beyond_it) {
  EXPECT_EQ(power_lit(0.2, 0.2, 0.8, 0.5), 0.0);
  EXPECT_EQ(power_lit(0.2, 0.2 - 1e-7, 0.8, 0.5), 0.0);
  EXPECT_EQ(power_lit(0.2, 0.8, 0.8, 0.79), 1.0);
  EXPECT_EQ(power_lit(0.2, 0.8 + 1e-7, 0.8, 0.79), 1.0);
  EXPECT_EQ(power_lit(0.2, 0.8, 0.8, 0.81), 0.0);
  // The mean nearly at the largest depth: the power's exponent is huge, the answer is not.
  const double lit = power_lit(0.2, 0.8 - 1e-9, 0.8, 0.8 - 0.5e-9);
  EXPECT_GT(lit, 0.0);
  EXPECT_LT(lit, 1.0);
}

TEST(PowerCdfFilter, is_one_up_to_the_mean_and_falls_to_nothing_at_the_largest_depth) {
  for (const double mean : {0.25, 0.5, 0.75}) {
    double before = 1.0;
    for (double depth = 0.0; depth <= 1.0; depth += 1.0 / 1024) {
      const double lit = power_lit(0.2, mean, 0.8, depth);
      if (depth <= mean) {
        EXPECT_EQ(lit, 1.0);
      }
      if (depth >= 0.8) {
        EXPECT_EQ(lit, 0.0);
      }
      EXPECT_LE(lit, before + 1e-12);
      before = lit;
    }
  }
}

TEST(PowerCdfFilter, is_linear_where_the_mean_is_in_the_middle) {
  EXPECT_NEAR(power_lit(0.2, 0.5, 0.8, 0.6), 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(power_lit(0.2, 0.5, 0.8, 0.7), 1.0 / 3.0, 1e-12);
}

TEST(PowerCdfFilter, agrees_with_the_golden_rows) {
  for (const nlohmann::json& row : golden_filters().at("power")) {
    const double least = row.at("zmin").get<double>(), largest = row.at("zmax").get<double>();
    const double mean = row.at("mu").get<double>(), depth = row.at("zr").get<double>();
    EXPECT_NEAR(power_lit(least, mean, largest, depth), row.at("v").get<double>(), kGolden)
        << least << " " << mean << " " << largest << " " << depth;
  }
}

TEST(PowerCdfFilter, agrees_with_the_golden_kernels) {
  for (const GoldenRow& row : golden_rows()) {
    const auto [least, largest] = std::minmax_element(row.kernel.depth.begin(), row.kernel.depth.end());
    double mean = 0.0;
    for (std::size_t i = 0; i < row.kernel.depth.size(); ++i)
      mean += row.kernel.weight[i] * row.kernel.depth[i];
    EXPECT_NEAR(power_lit(*least, mean, *largest, row.depth), row.answer("power"), kGolden)
        << row.kernel.name << " " << row.depth;
  }
}

TEST(PowerCdfFilter, puts_least_and_largest_together_without_averaging_them) {
  const FilterSettings settings = settings_from("power_cdf");
  const StoredTexel sum = mean_over({"", {0.1, 0.6, 0.3}, {0.25, 0.25, 0.5}}, settings);
  EXPECT_NEAR(sum[0], 2.0 * 0.1 - 1.0, 1e-15);
  EXPECT_NEAR(sum[1], 2.0 * 0.325 - 1.0, 1e-15);
  EXPECT_NEAR(sum[2], 2.0 * 0.6 - 1.0, 1e-15);
}

TEST(PowerCdfFilter, leaves_a_surface_lit_that_16_bits_have_rounded_towards_the_light) {
  for (const char* text : {"power_cdf:format=fp16", "power_cdf:format=unorm16", "power_cdf"}) {
    const FilterSettings settings = settings_from(text);
    for (double depth = 0.0; depth <= 1.0; depth += 1.0 / 1021) {
      StoredTexel texel = filters::power_cdf.reference.store(depth, {}, settings);
      for (double& channel : texel) channel = rounded_to(settings.format, channel);
      FilterLookup lookup;
      lookup.depth = depth;
      EXPECT_EQ(filters::power_cdf.reference.visibility(texel, lookup, settings), 1.0)
          << text << " " << depth;
    }
  }
}

TEST(PowerCdfFilter, is_close_to_the_share_of_lit_texels_on_a_flat_receiver) {
  // Without the offset a receiver as deep as the deepest texel would be dark wherever one texel shadows it.
  constexpr double kMostlyDark = 0.7, kNear = 0.105, kNearWhereMostlyLit = 0.21;  // of the law
  for (double lit_share = 0.05; lit_share < 1.0; lit_share += 0.05) {
    const GoldenKernel kernel{"", {0.2, 0.6}, {1.0 - lit_share, lit_share}};
    FilterLookup lookup;
    lookup.depth = 0.6;
    const FilterSettings plain = settings_from("power_cdf:offset=0"), moved = settings_from("power_cdf");
    EXPECT_LT(filters::power_cdf.reference.visibility(mean_over(kernel, plain), lookup, plain), 0.01);
    EXPECT_NEAR(filters::power_cdf.reference.visibility(mean_over(kernel, moved), lookup, moved), lit_share,
                lit_share < kMostlyDark ? kNear : kNearWhereMostlyLit);
  }
}

TEST(PowerCdfFilter, bleeds_nothing_behind_the_farthest_occluder) {
  // Two moments would let through 0.2 here.
  const FilterSettings settings = settings_from("power_cdf");
  FilterLookup lookup;
  lookup.depth = 0.8;
  const StoredTexel sum = mean_over({"", {0.2, 0.6}, {0.5, 0.5}}, settings);
  EXPECT_EQ(filters::power_cdf.reference.visibility(sum, lookup, settings), 0.0);
}

/// Mean difference to the lit share over kernels of three depths, at a receiver as deep as the deepest.
double mean_error_over_kernels(const FilterSettings& settings) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  constexpr int kKernels = 2000;
  double sum = 0.0;
  for (int i = 0; i < kKernels; ++i) {
    const double second = any(random), first = second * any(random);
    const double deepest = second + (1.0 - second) * any(random);
    std::array<double, 3> weight{any(random), any(random), any(random)};
    const double whole = weight[0] + weight[1] + weight[2];
    for (double& w : weight) w /= whole;
    FilterLookup lookup;
    lookup.depth = deepest;
    const StoredTexel texel =
        mean_over({"", {first, second, deepest}, {weight[0], weight[1], weight[2]}}, settings);
    sum += std::abs(filters::power_cdf.reference.visibility(texel, lookup, settings) - weight[2]);
  }
  return sum / kKernels;
}

TEST(PowerCdfFilter, layers_part_occluders_behind_each_other) {
  double before = mean_error_over_kernels(settings_from("power_cdf"));
  EXPECT_GT(before, 0.1);
  for (const char* layers : {"2", "4", "8"}) {
    const double error = mean_error_over_kernels(settings_from(std::string("power_cdf:layers=") + layers));
    EXPECT_LT(error, before) << layers;
    before = error;
  }
  EXPECT_LT(before, 0.7 * mean_error_over_kernels(settings_from("power_cdf")));
}

TEST(PowerCdfFilter, passes_from_layer_to_layer_without_a_jump) {
  // Nine depths on a slanted surface and an occluder: what changes at a middle or an end of a layer is
  // rounding.
  GoldenKernel kernel{"", {0.05}, {0.1}};
  for (int i = 0; i < 9; ++i) {
    kernel.depth.push_back(0.06 + 0.11 * i);
    kernel.weight.push_back(0.1);
  }
  for (const int layers : {2, 3, 4, 8}) {
    const FilterSettings settings = settings_from("power_cdf:layers=" + std::to_string(layers));
    const StoredTexel texel = mean_over(kernel, settings);
    const auto lit_at = [&](double depth) {
      FilterLookup lookup;
      lookup.depth = depth;
      return filters::power_cdf.reference.visibility(texel, lookup, settings);
    };
    for (int half = 1; half < 2 * layers; ++half) {
      constexpr double kStep = 1e-7;
      const double depth = 0.5 * half / layers;
      EXPECT_NEAR(lit_at(depth - kStep), lit_at(depth + kStep), 1e-4) << layers << " layers, " << depth;
    }
  }
}

TEST(PowerCdfFilter, has_no_stairs_where_a_kernel_takes_in_another_texel) {
  constexpr int kSide = 40;
  TestMap map{kSide, kSide, {}};
  for (int i = 0; i < kSide * kSide; ++i)
    map.depth.push_back(2 * (i % kSide) + i / kSide < 50 ? 0.25f : 0.75f);  // a slanted edge
  std::vector<Question> questions;
  for (int i = 0; i <= 640; ++i)
    questions.push_back({{10.0f + static_cast<float>(i) / 64.0f, 20.3f}, 0.75f, {}, 0.0f});
  for (const char* text : {"power_cdf:radius=2", "power_cdf:radius=2,layers=4"}) {
    const std::vector<float> lit = ask_shader(settings_from(text), map, questions);
    EXPECT_LT(lit.front(), 0.01f) << text;
    EXPECT_GT(lit.back(), 0.99f) << text;
    float most = 0.0f;
    for (std::size_t i = 1; i < lit.size(); ++i) most = std::max(most, std::abs(lit[i] - lit[i - 1]));
    EXPECT_LT(most, 0.02f) << text;  // a texel's 64th
  }
}

}  // namespace
}  // namespace gnomon::render
