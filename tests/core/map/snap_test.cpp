// Which whole number of texels is a length nearest to?
#include "gnomon/shadow_map.hpp"
#include "gnomon/study/formulas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/property.hpp"

namespace gnomon::test {
namespace {

constexpr std::int64_t kWhole = std::int64_t{1} << 53;

TEST(Snap, beyond_the_whole_numbers_of_double_the_index_is_clamped) {
  EXPECT_EQ(snap_index(1e30, 1e-3), kWhole);
  EXPECT_EQ(snap_index(-1e30, 1e-3), -kWhole);
  EXPECT_EQ(snap_index(std::numeric_limits<double>::infinity(), 1.0), kWhole);
  EXPECT_GE(snap_index(std::numeric_limits<double>::quiet_NaN(), 1.0), -kWhole);  // any index, no trap
}

TEST(Snap, the_nearest_step_is_taken_on_both_sides_of_zero) {
  EXPECT_EQ(snap_index(0.0, 0.5), 0);
  EXPECT_EQ(snap_index(0.74, 0.5), 1);
  EXPECT_EQ(snap_index(0.76, 0.5), 2);
  EXPECT_EQ(snap_index(-0.74, 0.5), -1);
  EXPECT_EQ(snap_index(-0.76, 0.5), -2);
}

TEST(Snap, a_default_key_is_that_of_a_map_without_a_grid) {
  EXPECT_FALSE(SnapKey{}.valid);
}

TEST(Snap, keys_are_equal_where_every_part_is) {
  const SnapKey key{1, 2, 3, 4, glm::dvec2(0.5), true};
  EXPECT_EQ(key, (SnapKey{1, 2, 3, 4, glm::dvec2(0.5), true}));
  EXPECT_NE(key, (SnapKey{9, 2, 3, 4, glm::dvec2(0.5), true}));
  EXPECT_NE(key, (SnapKey{1, 9, 3, 4, glm::dvec2(0.5), true}));
  EXPECT_NE(key, (SnapKey{1, 2, 9, 4, glm::dvec2(0.5), true}));
  EXPECT_NE(key, (SnapKey{1, 2, 3, 9, glm::dvec2(0.5), true}));
  EXPECT_NE(key, (SnapKey{1, 2, 3, 4, {0.25, 0.5}, true}));
  EXPECT_NE(key, (SnapKey{1, 2, 3, 4, {0.5, 0.25}, true}));
  EXPECT_NE(key, (SnapKey{1, 2, 3, 4, glm::dvec2(0.5), false}));
}

TEST(Snap, keys_of_maps_without_a_grid_are_equal_to_nothing) {
  EXPECT_NE(SnapKey{}, SnapKey{});
  EXPECT_NE((SnapKey{1, 2, 3, 4, glm::dvec2(0.5), false}), (SnapKey{1, 2, 3, 4, glm::dvec2(0.5), false}));
}

TEST(SnapProperty, the_index_is_within_half_a_step_and_moves_by_whole_steps) {
  for_all(2000, [&] {
    const double step = std::exp2(between(-20.0, 20.0)), value = between(-1.0, 1.0) * step * 1e6;
    const std::int64_t index = snap_index(value, step);
    require(std::abs(value / step - static_cast<double>(index)) <= 0.5 + 1e-9, "index", index, "of",
            value / step);
    require(snap_index((static_cast<double>(index) + 0.25) * step, step) == index,
            "not the same within half a step");
    require(snap_index((static_cast<double>(index) + 7.25) * step, step) == index + 7, "not seven steps on");
  });
}

}  // namespace
}  // namespace gnomon::test
