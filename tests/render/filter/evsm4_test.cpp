// Two exponential warps against the golden rows.
#include <gtest/gtest.h>

#include "filter/exponential_variance.hpp"
#include "filter_harness.hpp"
#include "golden_filters.hpp"

namespace gnomon::render {
namespace {

constexpr double kGolden = 1e-9;

TEST(Evsm4Filter, agrees_with_the_golden_rows_of_both_warps) {
  const FilterSettings fives = settings_from("evsm4:c=5,c_negative=5,bleed=0,floor=0");
  const FilterSettings forty = settings_from("evsm4:c=40,c_negative=5,bleed=0,floor=0");
  for (const GoldenRow& row : golden_rows()) {
    const StoredTexel mean = mean_over(row.kernel, fives), steep = mean_over(row.kernel, forty);
    const double rising = warped_bound(mean[0], mean[1], row.depth, 5.0, 1.0, 0.0, 0.0);
    const double falling = warped_bound(mean[2], mean[3], row.depth, 5.0, -1.0, 0.0, 0.0);
    const double steeply = warped_bound(steep[0], steep[1], row.depth, 40.0, 1.0, 0.0, 0.0);
    EXPECT_NEAR(falling, row.answer("evsm_neg5"), kGolden) << row.kernel.name << row.depth;
    EXPECT_NEAR(std::min(rising, falling), row.answer("evsm5"), kGolden);
    EXPECT_NEAR(std::min(steeply, falling), row.answer("evsm40_5"), kGolden);
  }
}

TEST(Evsm4Filter, never_lets_more_light_through_than_either_warp) {
  const FilterSettings four = settings_from("evsm4:bleed=0"), two = settings_from("evsm2:bleed=0");
  for (const GoldenRow& row : golden_rows()) {
    FilterLookup lookup;
    lookup.depth = row.depth;
    EXPECT_LE(filters::evsm4.reference.visibility(mean_over(row.kernel, four), lookup, four),
              filters::evsm2.reference.visibility(mean_over(row.kernel, two), lookup, two) + 1e-12);
  }
}

}  // namespace
}  // namespace gnomon::render
