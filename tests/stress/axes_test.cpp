// Along every stiff axis: are plans finite, exact to a small part of a texel, and smooth?
#include "axes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/float_traps.hpp"

namespace gnomon::stress {

void PrintTo(const Axis& axis, std::ostream* out) {
  *out << axis.name;
}

namespace {

constexpr SweepOptions kSmall{10, 2, 3};

// What double may lose: most where everything is 1e9 units from the origin and a texel is a tenth of a unit.
constexpr double kDoubleTexels = 1e-3;
// Floats relative to the camera. A receiver or a cone smaller than 1e-4 of its distance has a map as narrow
// as floats allow: they tell its texels apart by a few at best, by some more close to a spot.
double most_float_texels(std::string_view axis) {
  constexpr double kOrdinary = 0.5, kTiny = 4.0, kNarrowSpot = 32.0;
  if (axis == "cone") return kNarrowSpot;
  return axis == "extent" || axis == "thickness" ? kTiny : kOrdinary;
}
// Of texels per area for a step of 1e-6: what a search's own steps and a stable map's sizes amount to.
constexpr double kJump = 3e-3;

class StressParameters : public testing::TestWithParam<Axis> {};

TEST_P(StressParameters, stay_finite_exact_and_smooth) {
  const Axis& axis = GetParam();
  int planned = 0;
  for (const AxisRow& row : sweep(axis, kSmall)) {
    const auto at = [&] { return std::string(row.variant) + " at " + std::to_string(row.value); };
    EXPECT_TRUE(row.worst.finite) << at();
    if (row.maps == 0) continue;
    ++planned;
    if (kRealIsFiner) {
      EXPECT_LE(row.worst.error_texels, kDoubleTexels) << at();
    }
    EXPECT_LE(row.worst.float_relative_texels, most_float_texels(axis.name)) << at();
    // Beside a ratio of 1, a step of 1e-6 makes the frustum's slice several times as thick.
    constexpr double kThin = 1.0 + 1e-4;
    if (axis.name != "depth_ratio" || row.value > kThin) {
      // Straight against the view a warp is kept or dropped by points inside the body, not by the texels
      // here.
      constexpr double kDropped = 0.2;
      const bool against = axis.name == "light_angle" && row.value > 3.14;
      // In an image of nearly half a space the step changes slopes by up to 2e-4, and a search may go another
      // way.
      constexpr double kAnotherWay = 1.0;
      const bool wide = axis.name == "fov" && row.value > 174.0;
      const double most = against ? kDropped : wide ? kAnotherWay : kJump;
      EXPECT_TRUE(std::isnan(row.jump) || row.jump <= most) << at() << " jumps by " << row.jump;
    }
    EXPECT_GE(row.worst.condition, 1.0) << at();
  }
  EXPECT_GT(planned, 10);
}

TEST_P(StressParameters, raise_no_floating_point_exception) {
  const Axis& axis = GetParam();
  for (const double value : axis.values(24)) {
    for (const Variant& variant : all_variants()) {
      Input input = plain_input(5);
      variant.apply(input.options);
      axis.apply(value, 0.4, input);
      ShadowPlan plan;
      EXPECT_TRUE(test::runs_without_trap([&] {
        plan = input.plan();
        if (plan.status == PlanStatus::ok) (void)measure(plan, input.camera, input.bounds(), {5, 5, 5});
      })) << variant.name
          << " at " << value;
    }
  }
}

TEST_P(StressParameters, have_ascending_values) {
  const std::vector<double> values = GetParam().values(20);
  ASSERT_GE(values.size(), 10u);
  for (std::size_t i = 1; i < values.size(); ++i) EXPECT_LT(values[i - 1], values[i]);
}

std::string test_name(const testing::TestParamInfo<Axis>& axis) {
  return std::string(axis.param.name);
}
INSTANTIATE_TEST_SUITE_P(All, StressParameters, testing::ValuesIn(all_axes().begin(), all_axes().end()),
                         test_name);

TEST(Axes, are_held_against_arithmetic_finer_than_double) {
  if (!kRealIsFiner)
    GTEST_SKIP()
        << "long double is no finer than double here: what double loses along the axes is not judged";
  EXPECT_GE(std::numeric_limits<Real>::digits, std::numeric_limits<double>::digits + 8);
}

TEST(Axes, fall_back_where_they_must) {
  const auto used_at = [](std::string_view name, double value) {
    Input input = plain_input(0);
    find_axis(name)->apply(value, 0.0, input);
    return used_by(input, input.plan());
  };
  EXPECT_EQ(used_at("cone", 0.0), "refused: light.outer_radians");
  EXPECT_EQ(used_at("cone", 131.0), "optimal");
  EXPECT_EQ(used_at("cone", 133.0).substr(0, 4), "cube");
  EXPECT_EQ(used_at("cone", 360.0), "refused: light.outer_radians");
  EXPECT_EQ(used_at("map_size", 3.0), "refused: options.resolution.max_size");
  EXPECT_EQ(used_at("depth_ratio", 1e9), "optimal");
  EXPECT_EQ(find_axis("nonsense"), nullptr);
}

}  // namespace
}  // namespace gnomon::stress
