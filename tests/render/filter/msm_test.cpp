// Moment shadow maps against the golden rows, a linear program, and distributions known by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "filter_harness.hpp"
#include "golden_filters.hpp"
#include "moments.hpp"

namespace gnomon::render {
namespace {

/// The golden rows are solved by other formulas, on moments of depths in 0..1.
constexpr double kGolden = 1e-6;

/// Moments of u = 2 z - 1 under the golden rows' own bias of depths in 0..1, alpha towards one half each.
Moments biased_moments(const GoldenKernel& kernel, double alpha) {
  std::array<double, 5> z{1.0};
  for (std::size_t power = 1; power <= 4; ++power) {
    for (std::size_t i = 0; i < kernel.depth.size(); ++i) {
      z[power] += kernel.weight[i] * std::pow(kernel.depth[i], static_cast<double>(power));
    }
    z[power] = (1.0 - alpha) * z[power] + alpha * 0.5;
  }
  return {2 * z[1] - 1, 4 * z[2] - 4 * z[1] + 1, 8 * z[3] - 12 * z[2] + 6 * z[1] - 1,
          16 * z[4] - 32 * z[3] + 24 * z[2] - 8 * z[1] + 1};
}

TEST(MsmFilter, agrees_with_the_golden_rows_under_their_bias) {
  for (const GoldenRow& row : golden_rows()) {
    const double dark = share_in_front(biased_moments(row.kernel, 3e-5), 2.0 * row.depth - 1.0).share;
    EXPECT_NEAR(1.0 - dark, row.answer("msm_b3e5"), kGolden) << row.kernel.name << " " << row.depth;
  }
}

TEST(MsmFilter, agrees_with_the_golden_rows_without_bias_where_depths_are_many) {
  for (const GoldenRow& row : golden_rows()) {
    if (row.kernel.name != "five")
      continue;  // of fewer depths than four the moments are on the edge of being any
    const double dark = share_in_front(biased_moments(row.kernel, 0.0), 2.0 * row.depth - 1.0).share;
    EXPECT_NEAR(1.0 - dark, row.answer("msm"), kGolden) << row.depth;
  }
}

TEST(MsmFilter, is_the_bound_that_a_linear_program_finds) {
  const std::vector<GoldenRow> rows = golden_rows();
  const auto five =
      std::find_if(rows.begin(), rows.end(), [](const GoldenRow& r) { return r.kernel.name == "five"; });
  ASSERT_NE(five, rows.end());
  for (const nlohmann::json& row : golden_filters().at("msm_vs_lp")) {
    const double u = 2.0 * row.at("d").get<double>() - 1.0;
    EXPECT_NEAR(1.0 - share_in_front(biased_moments(five->kernel, 1e-4), u).share,
                row.at("msm").get<double>(), kGolden);
  }
}

TEST(MsmFilter, bounds_the_share_in_front_from_below_and_more_tightly_with_known_range) {
  std::mt19937 random(3);
  const auto unit = [&random] { return static_cast<double>(random() % 100001) / 100000.0; };
  double gained = 0.0;
  for (int i = 0; i < 5000; ++i) {
    Moments b{};
    std::array<double, 6> depth{}, weight{};
    double sum = 0.0;
    for (std::size_t k = 0; k < depth.size(); ++k) {
      depth[k] = 2.0 * unit() - 1.0;
      weight[k] = 0.01 + unit();
      sum += weight[k];
    }
    const double u = 1.98 * unit() - 0.99;
    double in_front = 0.0;
    for (std::size_t k = 0; k < depth.size(); ++k) {
      double power = weight[k] / sum;
      in_front += depth[k] < u ? power : 0.0;
      for (double& moment : b) moment += power *= depth[k];
    }
    // Six depths in general position: the matrices' condition numbers stay below 1e6.
    constexpr double kRounding = 1e-8;
    const double free = share_in_front(b, u).share, bounded = share_in_front_bounded(b, u);
    ASSERT_LE(free, in_front + kRounding);
    ASSERT_LE(bounded, in_front + kRounding);
    ASSERT_GE(bounded, free - kRounding);
    gained += bounded - free;
  }
  EXPECT_GT(gained / 5000.0, 0.005) << "the known range must darken something";
}

TEST(MsmFilter, reads_back_what_it_quantises_to_16_bits) {
  const FilterSettings wide = settings_from("msm:bias=0.01"),
                       narrow = settings_from("msm:format=unorm16,bias=0.01");
  for (double depth = 0.0; depth <= 1.0; depth += 0.05) {
    StoredTexel quantised = filters::msm.reference.store(depth, {}, narrow);
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_GE(quantised[i], -1e-12);
      ASSERT_LE(quantised[i], 1.0 + 1e-12);
      quantised[i] = rounded_to(TexelFormat::unorm16, quantised[i]);
    }
    for (double receiver = 0.03; receiver < 1.0; receiver += 0.1) {
      FilterLookup lookup;
      lookup.depth = receiver;
      // A bias of a hundredth lets 16 bits' rounding of 1e-5 through as some thousandths.
      EXPECT_NEAR(
          filters::msm.reference.visibility(quantised, lookup, narrow),
          filters::msm.reference.visibility(filters::msm.reference.store(depth, {}, wide), lookup, wide),
          0.01)
          << depth << " " << receiver;
    }
  }
}

}  // namespace
}  // namespace gnomon::render
