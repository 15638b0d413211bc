// Variance shadow maps against sums worked out by hand and the golden rows.
#include <gtest/gtest.h>

#include "filter/variance.hpp"
#include "filter_harness.hpp"
#include "golden_filters.hpp"

namespace gnomon::render {
namespace {

/// Golden rows are computed in double from double moments.
constexpr double kGolden = 1e-9;

TEST(VsmFilter, agrees_with_the_golden_rows_of_the_bound) {
  FilterSettings settings = settings_from("vsm:bleed=0,floor=0,slope=0");
  settings.format = TexelFormat::fp32;
  for (const GoldenRow& row : golden_rows()) {
    const StoredTexel mean = mean_over(row.kernel, settings);
    // Their floor is zero, ours the format's rounding: the bound itself is compared.
    const double variance = std::max(mean[1] - mean[0] * mean[0], 0.0);
    const double u = 2.0 * row.depth - 1.0;
    EXPECT_NEAR(chebyshev(mean[0], variance, u), row.answer("vsm"), kGolden) << row.kernel.name << row.depth;
    EXPECT_NEAR(without_bleeding(chebyshev(mean[0], variance, u), 0.3), row.answer("vsm_red03"), kGolden);
    EXPECT_NEAR(chebyshev(mean[0], std::max(variance, 4.0 * 2e-5), u), row.answer("vsm_floor2e5"), kGolden);
  }
}

TEST(VsmFilter, is_exact_for_two_depths_at_the_nearer_one_and_bleeds_just_behind_the_other) {
  const FilterSettings settings = settings_from("vsm:bleed=0,floor=0");
  StoredTexel mean{};
  for (const double depth : {0.25, 0.75}) {
    const StoredTexel texel = filters::vsm.reference.store(depth, {}, settings);
    mean[0] += 0.5 * texel[0];
    mean[1] += 0.5 * texel[1];
  }
  FilterLookup lookup;
  lookup.depth = 0.75;
  EXPECT_NEAR(filters::vsm.reference.visibility(mean, lookup, settings), 0.5, 1e-12);
  lookup.depth = 0.8;  // behind both: the right answer is 0
  EXPECT_NEAR(filters::vsm.reference.visibility(mean, lookup, settings), 0.0625 / (0.0625 + 0.09), 1e-12);
}

TEST(VsmFilter, never_returns_less_than_the_share_that_is_lit) {
  const FilterSettings settings = settings_from("vsm:bleed=0,floor=0,slope=0");
  for (const GoldenRow& row : golden_rows()) {
    FilterLookup lookup;
    lookup.depth = row.depth;
    const double lit = filters::vsm.reference.visibility(mean_over(row.kernel, settings), lookup, settings);
    EXPECT_GE(lit, row.answer("pcf") - kGolden);
  }
}

TEST(VsmFilter, takes_the_slope_within_a_texel_as_variance_but_no_edge) {
  const FilterSettings settings = settings_from("vsm");
  const StoredTexel flat = filters::vsm.reference.store(0.25, {0.0, 0.0}, settings);
  const StoredTexel slanted = filters::vsm.reference.store(0.25, {0.04, 0.03}, settings);
  EXPECT_NEAR(slanted[1] - flat[1], 0.0025, 1e-15);  // 4 times a quarter of the slope's square
  EXPECT_LE(filters::vsm.reference.store(0.25, {0.9, 0.9}, settings)[1] - flat[1], 0.01 + 1e-15);
}

}  // namespace
}  // namespace gnomon::render
