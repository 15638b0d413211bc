// One exponential warp against the golden rows.
#include <gtest/gtest.h>

#include "filter/exponential_variance.hpp"
#include "filter_harness.hpp"
#include "golden_filters.hpp"

namespace gnomon::render {
namespace {

constexpr double kGolden = 1e-9;

TEST(Evsm2Filter, agrees_with_the_golden_rows_of_the_rising_warp) {
  const FilterSettings settings = settings_from("evsm2:c=5,bleed=0,floor=0");
  for (const GoldenRow& row : golden_rows()) {
    const StoredTexel mean = mean_over(row.kernel, settings);
    EXPECT_NEAR(warped_bound(mean[0], mean[1], row.depth, 5.0, 1.0, 0.0, 0.0), row.answer("evsm_pos5"),
                kGolden)
        << row.kernel.name << row.depth;
  }
}

TEST(Evsm2Filter, has_exponents_whose_squares_its_formats_hold) {
  EXPECT_LT(largest_exponent(TexelFormat::fp32),
            golden_filters().at("evsm_limits").at("fp32_max_c").get<double>());
  EXPECT_LT(largest_exponent(TexelFormat::fp16),
            golden_filters().at("evsm_limits").at("fp16_max_c").get<double>());
  EXPECT_EQ(settings_from("evsm2:format=fp16").value("c"), largest_exponent(TexelFormat::fp16));
  for (const TexelFormat format : {TexelFormat::fp32, TexelFormat::fp16}) {
    EXPECT_TRUE(std::isfinite(rounded_to(format, warped_moments(1.0, largest_exponent(format))[1])));
  }
}

}  // namespace
}  // namespace gnomon::render
