// Boxes inside-out, touching, nested and flat, under every light, split and size: is every plan whole?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "judge.hpp"
#include "support/float_traps.hpp"

namespace gnomon::stress {
namespace {

/// A box that touches, holds, meets or is unlike an earlier one.
Box next_box(const std::vector<Box>& before, Random& random) {
  const auto around = [&](double size) {
    return glm::dvec3(random.between(-size, size), random.between(-size, size), random.between(-size, size));
  };
  const glm::dvec3 corner = around(60.0);
  Box box{corner, corner + glm::abs(around(20.0))};
  if (!before.empty()) {
    const Box& other = before[static_cast<std::size_t>(random.pick(static_cast<int>(before.size())))];
    switch (random.pick(5)) {
      case 0:  // touching
        box = {{other.max.x, other.min.y, other.min.z}, other.max + glm::dvec3(5, 0, 0)};
        break;
      case 1:  // nested, exactly as large on some sides
        box = {other.min, 0.5 * other.min + 0.5 * other.max};
        break;
      case 2:  // the same
        box = other;
        break;
      case 3:  // inside-out
        box = {other.max + glm::dvec3(1.0), other.min};
        break;
      default:
        break;
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (random.pick(8) == 0) box.max[axis] = box.min[axis];
  }
  return box;
}

Input random_input(std::uint64_t seed) {
  Random random(seed);
  Input input = plain_input(seed);
  input.receivers.clear();
  input.casters.clear();
  const int boxes = 1 + random.pick(12);
  for (int i = 0; i < boxes; ++i) input.receivers.push_back(next_box(input.receivers, random));
  for (int i = 0; i < boxes; ++i) input.casters.push_back(next_box(input.receivers, random));
  const glm::dvec3 at{random.between(-40, 40), random.between(-40, 40), random.between(-40, 40)};
  const int kind = random.pick(4);
  if (kind == 1) input.light = PointLight{at, random.between(1.0, 200.0)};
  if (kind >= 2)
    input.light = SpotLight{at, across(at + glm::dvec3(0, 1, 0), random.unit()),
                            random.unit() * std::numbers::pi, random.between(1.0, 200.0)};
  PlanOptions& o = input.options;
  o.cascades = 1 + random.pick(kMaxMaps);
  o.resolution.max_size = std::max(4, static_cast<int>(std::exp2(random.between(0.0, 14.0))));
  o.filter.texels = 0.25 * o.resolution.max_size * random.unit() * random.unit();
  o.fit = static_cast<Fit>(random.pick(4));
  o.split.scheme = static_cast<SplitScheme>(random.pick(6));
  o.split.partition = static_cast<Partition>(random.pick(3));
  return input;
}

TEST(Boxes, of_every_kind_make_whole_plans_without_a_floating_point_exception) {
  int planned = 0, points = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    const Input input = random_input(seed);
    ShadowPlan plan;
    ASSERT_TRUE(test::runs_without_trap([&] { plan = input.plan(); })) << seed;
    ASSERT_NE(plan.status, PlanStatus::invalid_input) << seed << ' ' << plan.invalid_field;
    ASSERT_TRUE(all_finite(plan)) << seed;
    planned += plan.map_count > 0 ? 1 : 0;
    for (int i = 0; i < plan.map_count; ++i) {
      const ShadowMap& map = plan.map[static_cast<std::size_t>(i)];
      ASSERT_LE(map.depth_begin, map.depth_end) << seed;
      // A pixel of a receiver that has a depth of this map finds it there.
      if (plan.selection != MapSelection::view_depth) continue;
      for (const glm::dvec3& p : points_of(input, plan, i, 2, seed)) {
        ASSERT_TRUE(map_holds(plan, map, p)) << seed << " map " << i;
        ++points;
      }
    }
  }
  EXPECT_GT(planned, 300);
  EXPECT_GT(points, 3000);
}

TEST(Boxes, that_are_all_empty_make_no_map) {
  Input input = plain_input(0);
  for (Box& box : input.receivers) std::swap(box.min, box.max);
  EXPECT_EQ(input.plan().status, PlanStatus::nothing_visible);
}

}  // namespace
}  // namespace gnomon::stress
