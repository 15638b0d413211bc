// Errors of masks that can be counted by hand.
#include "gnomon/report/errors.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace gnomon::report {
namespace {

using Mask = std::vector<float>;

TEST(Errors, of_nothing_are_zero) {
  const MaskErrors errors = mask_errors({}, {}, {});
  EXPECT_EQ(errors.pixels, 0u);
  EXPECT_EQ(errors.false_lit + errors.false_shadow + errors.mean_error + errors.leaking + errors.darkening,
            0.0);
  EXPECT_EQ(excess_flips({}, {}, {}, {}), 0.0);
  EXPECT_EQ(pixel_aliasing({}).pixels, 0u);
}

TEST(Errors, pixels_that_are_not_evaluated_do_not_count) {
  const Mask mask{1, 0, 1}, none{-1, -1, -1};
  EXPECT_EQ(mask_errors(mask, none, none).pixels, 0u);
  EXPECT_EQ(mask_errors(mask, none, none).mean_error, 0.0);
}

TEST(Errors, false_light_and_false_shadow_are_distinguished) {
  const Mask hard{0, 0, 0, 0, 1, 1, 1, -1}, mask{0, 0.5f, 0.75f, 1, 1, 0.5f, 0, 1};
  const MaskErrors errors = mask_errors(mask, hard, Mask(8, -1.0f));
  EXPECT_EQ(errors.pixels, 7u);
  EXPECT_DOUBLE_EQ(errors.false_lit, 2.0 / 7.0);     // 0.75 and 1 in shadow; exactly half counts as shadow
  EXPECT_DOUBLE_EQ(errors.false_shadow, 2.0 / 7.0);  // 0.5 and 0 in light
}

TEST(Errors, leaking_and_darkening_look_at_the_deep_pixels_only) {
  const Mask soft{0, 0, 0.5f, 1, 1, 1, 1, -1}, mask{0.25f, 0, 0.75f, 1, 1, 0.5f, 1, 0};
  const MaskErrors errors = mask_errors(mask, soft, soft);
  EXPECT_EQ(errors.deep_pixels, 2u);
  EXPECT_DOUBLE_EQ(errors.leaking, 0.125);
  EXPECT_EQ(errors.open_pixels, 4u);
  EXPECT_DOUBLE_EQ(errors.darkening, 0.125);
  EXPECT_DOUBLE_EQ(errors.mean_error, (0.25 + 0.25 + 0.5) / 7.0);
}

TEST(Errors, acne_and_leaks_below_one_half_count) {
  const Mask soft{0, 0, 0, 0.5f, 1, 1, 1, -1}, mask{0.05f, 0.11f, 0.4f, 0, 0.95f, 0.89f, 0.6f, 0};
  const MaskErrors errors = mask_errors(mask, Mask(8, 1.0f), soft);
  EXPECT_DOUBLE_EQ(errors.too_light, 2.0 / 8.0);
  EXPECT_DOUBLE_EQ(errors.too_dark, 2.0 / 8.0);
}

TEST(Errors, pixel_error_is_the_mean_distance_to_the_light_over_pixels) {
  const Mask mask{1, 0, 0.5f, 0.25f, 1}, light{0.75f, 0, 1, 0.5f, -1};
  const std::vector<std::uint8_t> several{0, 0, 1, 0, 1};
  const PixelErrors errors = pixel_errors(mask, light, several);
  EXPECT_EQ(errors.pixels, 4u);
  EXPECT_EQ(errors.several, 1u);
  EXPECT_DOUBLE_EQ(errors.error, (0.25 + 0.5 + 0.25) / 4.0);
  EXPECT_DOUBLE_EQ(errors.one_surface, (0.25 + 0.25) / 3.0);
  EXPECT_EQ(pixel_errors({}, {}, {}).error, 0.0);
}

TEST(Errors, hard_comparison_of_a_fine_fence_has_no_misclassified_pixel_and_half_a_pixel_error) {
  const Mask hard{1, 0, 1, 0}, half(4, 0.5f);
  EXPECT_EQ(mask_errors(hard, hard, Mask(4, -1.0f)).false_lit, 0.0);
  EXPECT_DOUBLE_EQ(pixel_errors(hard, half, std::vector<std::uint8_t>(4)).error, 0.5);
  EXPECT_EQ(pixel_errors(half, half, std::vector<std::uint8_t>(4)).error, 0.0);
}

TEST(Errors, changes_beyond_those_of_the_light_twinkle) {
  const Mask before{0, 0, 0, 0.5f, 1, 1}, after{1, 1, 0.25f, 0.8f, 0, 0};
  const Mask light_before{0.5f, 0.1f, 0, 0.5f, -1, 0.5f}, light_after{0.5f, 0.9f, 0, 0.5f, 0, -1};
  // The first and the fourth: the second follows the light, the third changes by a quarter, two have none.
  EXPECT_DOUBLE_EQ(twinkling(before, after, light_before, light_after), 2.0 / 4.0);
  EXPECT_EQ(twinkling(light_before, light_after, light_before, light_after), 0.0);
  EXPECT_EQ(twinkling({}, {}, {}, {}), 0.0);
}

TEST(Errors, the_truth_is_uniform_where_all_neighbours_have_it) {
  const Mask truth{1,  1, 1, 1, 0,  //
                   1,  1, 1, 1, 1,  //
                   -1, 1, 1, 1, 1};
  const Mask expected{1,  1,  1, -1, -1,  //
                      -1, -1, 1, -1, -1,  //
                      -1, -1, 1, 1,  1};
  EXPECT_EQ(uniform_truth(truth, 5, 1), expected);
  EXPECT_EQ(uniform_truth(truth, 5, 0), truth);
  EXPECT_TRUE(uniform_truth({}, 0, 3).empty());
}

TEST(Errors, a_perfect_mask_has_none) {
  const Mask truth{0, 1, 0.25f, 1, 0};
  const MaskErrors errors = mask_errors(truth, truth, truth);
  EXPECT_EQ(errors.false_lit + errors.false_shadow + errors.mean_error + errors.leaking + errors.darkening,
            0.0);
}

TEST(Errors, flips_beyond_those_of_the_truth_count) {
  const Mask before{0, 1, 0, 1, 0, 1}, after{0, 0, 1, 0, 0.5f, 0};
  const Mask truth_before{0, 1, 0, 1, 0, -1}, truth_after{0, 1, 1, 1, 0, 1};
  // The third follows the truth, the fifth changes by no more than half, the last is not judged.
  EXPECT_DOUBLE_EQ(excess_flips(before, after, truth_before, truth_after), 2.0 / 5.0);
  EXPECT_EQ(excess_flips(before, before, truth_before, truth_after), 0.0);
}

TEST(Errors, aliasing_counts_what_is_above_zero_infinities_included) {
  const float infinite = std::numeric_limits<float>::infinity();
  const Mask m{0, -1, 0.5f, 2, 4, infinite, std::numeric_limits<float>::quiet_NaN()};
  const PixelAliasing aliasing = pixel_aliasing(m);
  EXPECT_EQ(aliasing.pixels, 4u);
  EXPECT_EQ(aliasing.p50, 2.0);
  EXPECT_EQ(aliasing.max, static_cast<double>(infinite));
  EXPECT_DOUBLE_EQ(aliasing.share_undersampled, 0.75);
}

TEST(Errors, aliasing_has_the_value_that_95_of_100_pixels_stay_below) {
  Mask m;
  for (int i = 100; i >= 0; --i) m.push_back(0.5f + static_cast<float>(i));
  const PixelAliasing aliasing = pixel_aliasing(m);
  EXPECT_EQ(aliasing.p50, 50.5);
  EXPECT_EQ(aliasing.p95, 95.5);
  EXPECT_EQ(aliasing.max, 100.5);
}

}  // namespace
}  // namespace gnomon::report
