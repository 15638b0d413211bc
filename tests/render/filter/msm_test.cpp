// Moment shadow maps against the golden rows, a linear program, and distributions known by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "filter/moments.hpp"
#include "filter_harness.hpp"
#include "golden_filters.hpp"

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

/// Moments of some depths of -1..1 with weights, the mean of a kernel: few surfaces, each a little slanted.
Moments random_moments(std::mt19937& random, std::size_t surfaces) {
  const auto unit = [&random] { return static_cast<double>(random() % 100001) / 100000.0; };
  Moments b{};
  double sum = 0.0;
  std::vector<std::pair<double, double>> depths;
  for (std::size_t i = 0; i < surfaces; ++i) {
    const double middle = 1.9 * unit() - 0.95, slant = 0.02 * unit() * unit(), weight = 0.02 + unit();
    for (const double away : {-1.0, 0.0, 1.0}) depths.emplace_back(middle + away * slant, weight);
    sum += 3.0 * weight;
  }
  for (const auto& [depth, weight] : depths) {
    double power = weight / sum;
    for (double& moment : b) moment += power *= depth;
  }
  return b;
}

StoredTexel rounded_to_16_bits(StoredTexel texel) {
  for (std::size_t i = 0; i < 4; ++i) texel[i] = rounded_to(TexelFormat::nonlinear16, texel[i]);
  return texel;
}

TEST(MsmFilter, packs_moments_into_numbers_that_16_bits_round_without_making_them_no_moments) {
  std::mt19937 random(17);
  for (int i = 0; i < 20000; ++i) {
    const Moments b = random_moments(random, 1 + i % 4);
    // Variances that floats could not tell from none are none: 5e-7, up to eight times that in the fourth.
    const StoredTexel packed = packed_moments(b);
    for (std::size_t k = 0; k < 4; ++k) ASSERT_TRUE(packed[k] >= 0.0 && packed[k] <= 1.0) << i;
    const Moments exact = unpacked_moments(packed), read = unpacked_moments(rounded_to_16_bits(packed));
    for (std::size_t k = 0; k < 4; ++k) {
      ASSERT_NEAR(exact[k], b[k], 4e-6) << i << " moment " << k + 1;
      ASSERT_NEAR(read[k], b[k], 1e-4) << i << " moment " << k + 1;
    }
    // Hankel's determinants.
    const double d22 = read[1] - read[0] * read[0], l32 = read[2] - read[0] * read[1];
    ASSERT_GE(d22, -1e-12) << i;
    ASSERT_GE((read[3] - read[1] * read[1]) * d22 - l32 * l32, -1e-12) << i;
  }
}

TEST(MsmFilter, in_16_bits_returns_nearly_what_32_do_where_its_numbers_are_not_moments) {
  const FilterSettings full = settings_from("msm"), linear = settings_from("msm:format=unorm16"),
                       packed = settings_from("msm:format=nonlinear16");
  std::mt19937 random(19);
  double off_linear = 0.0, off_packed = 0.0;
  int count = 0;
  for (int i = 0; i < 4000; ++i) {
    const Moments b = random_moments(random, 1 + i % 3);
    const StoredTexel as_moments{b[0], b[1], b[2], b[3]};
    StoredTexel in_basis{0.5 + 1.5 * b[0] - 2.0 * b[2], 4.0 * (b[1] - b[3]),
                         0.5 + 0.86602540378443865 * b[0] - 0.38490017945975052 * b[2], 0.5 * (b[1] + b[3])};
    const StoredTexel basis16 = rounded_to_16_bits(in_basis);
    StoredTexel read = filters::msm.reference.nothing(packed);
    filters::msm.reference.join(read, rounded_to_16_bits(packed_moments(b)), 1.0, packed);
    for (double receiver = 0.02; receiver < 1.0; receiver += 0.04) {
      FilterLookup lookup;
      lookup.depth = receiver;
      const double exact = filters::msm.reference.visibility(as_moments, lookup, full);
      off_linear += std::abs(filters::msm.reference.visibility(basis16, lookup, linear) - exact);
      off_packed += std::abs(filters::msm.reference.visibility(read, lookup, packed) - exact);
      ++count;
    }
  }
  RecordProperty("linear", std::to_string(off_linear / count));
  RecordProperty("packed", std::to_string(off_packed / count));
  EXPECT_GT(off_linear / count, 0.001);
  EXPECT_LT(off_packed, 0.1 * off_linear) << off_packed / count << " of " << off_linear / count;
}

}  // namespace
}  // namespace gnomon::render
