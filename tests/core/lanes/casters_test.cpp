// Eight boxes at once: does each lane give what its box alone would?
#include "lanes/casters.hpp"
#include "gnomon/extend/body.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "support/seeded_input.hpp"

namespace gnomon::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Eight boxes, some of them empty, endless or of NaN.
std::array<Box, kLanes> boxes_of(SeededNumbers& random) {
  std::array<Box, kLanes> boxes;
  for (Box& box : boxes) {
    for (int axis = 0; axis < 3; ++axis) {
      const double at = random.between(-3.0, 3.0);
      box.min[axis] = at;
      box.max[axis] = at + random.between(0.0, 2.0);
    }
    const double kind = random.between(0.0, 1.0);
    if (kind < 0.1) box = Box{};
    if (kind > 0.9) box.max.y = kInfinity;
  }
  return boxes;
}

CasterBlock block_of(const std::array<Box, kLanes>& boxes) {
  CasterBlock block{};
  for (std::size_t lane = 0; lane < kLanes; ++lane) set_lane(block, lane, boxes[lane]);
  return block;
}

/// Sum at the corner of the box that lies farthest along the plane's normal, or least far.
double corner_sum(const glm::dvec4& plane, const Box& box, bool farthest) {
  const auto at = [&](int axis) { return (plane[axis] > 0.0) == farthest ? box.max[axis] : box.min[axis]; };
  return plane.x * at(0) + plane.y * at(1) + plane.z * at(2) + plane.w;
}

glm::dvec4 plane_of(SeededNumbers& random) {
  return {random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0),
          random.between(-2.0, 2.0)};
}

TEST(CasterLanes, a_plane_parts_each_box_as_it_would_alone) {
  int outside = 0, across = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SeededNumbers random(seed);
    const std::array<Box, kLanes> boxes = boxes_of(random);
    const CasterBlock block = block_of(boxes);
    const glm::dvec4 plane = plane_of(random);
    const std::uint32_t out = lanes<Ask::outside>(plane, block), cut = lanes<Ask::across>(plane, block);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      EXPECT_EQ((block.occupied >> lane & 1) != 0, !boxes[lane].empty());
      EXPECT_EQ((out >> lane & 1) != 0, corner_sum(plane, boxes[lane], true) < 0.0);
      EXPECT_EQ((cut >> lane & 1) != 0, !(corner_sum(plane, boxes[lane], false) >= 0.0));
      outside += static_cast<int>(out >> lane & 1);
      across += static_cast<int>(cut >> lane & 1);
    }
  }
  EXPECT_GT(outside, 100);
  EXPECT_GT(across, 100);
}

TEST(CasterLanes, a_box_that_touches_a_plane_is_not_outside) {
  CasterBlock block = block_of({});
  set_lane(block, 0, {{-1, 0, -1}, {1, 0, 1}});
  set_lane(block, 1, {{-1, -2, -1}, {1, -1, 1}});
  const Plane ground{{0, 1, 0}, 0.0};
  const LaneSides sides = sides_of<true>(ground, block, used_lanes(block));
  EXPECT_EQ(sides.outside & 3u, 2u);
  EXPECT_EQ(sides.across & 3u, 0u);
  EXPECT_EQ(sides_of<false>(ground, block, used_lanes(block)).outside & 3u, 2u);
}

TEST(CasterLanes, bounds_and_reaches_are_those_of_each_box) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SeededNumbers random(seed);
    std::array<Box, kLanes> boxes = boxes_of(random);
    for (Box& box : boxes) {
      if (box.empty() || box.max.y == kInfinity) box = {{-1, -1, -1}, {1, 1, 1}};
    }
    const CasterBlock block = block_of(boxes);
    const glm::dvec3 low(random.between(-2.0, 0.0)), high(random.between(0.0, 3.0)), up(0.6, -0.5, 0.3);
    const std::uint32_t beyond = lanes_beyond(low, high, block);
    const CasterBlock::Lanes reach = reaches(block, up);
    const double least = random.between(-1.0, 1.0);
    const std::uint32_t above = lanes_above(reach, least);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Box& box = boxes[lane];
      EXPECT_EQ(lane_box(block, lane).min, box.min);
      EXPECT_EQ(lane_box(block, lane).max, box.max);
      EXPECT_EQ((beyond >> lane & 1) != 0,
                glm::any(glm::lessThan(box.min, low)) || glm::any(glm::greaterThan(box.max, high)));
      EXPECT_EQ(reach[lane], corner_sum({up, 0.0}, box, true));
      EXPECT_EQ((above >> lane & 1) != 0, reach[lane] > least);
    }
  }
}

TEST(CasterLanes, relative_boxes_are_moved_and_lanes_of_nothing_are_zero) {
  const Box box{{1, 2, 3}, {4, 5, 6}};
  const glm::dvec3 origin(1, 1, 1);
  CasterBlock world = block_of({}), relative{}, listed{};
  set_lane(world, 2, box);
  set_relative(world, origin, relative);
  EXPECT_EQ(relative.occupied, 4u);
  EXPECT_EQ(lane_box(relative, 2).min, box.min - origin);
  EXPECT_EQ(lane_box(relative, 2).max, box.max - origin);
  EXPECT_EQ(lane_box(relative, 0).min, glm::dvec3(0.0));
  set_relative(std::span(&box, 1), origin, listed);
  EXPECT_EQ(listed.occupied, 1u);
  EXPECT_EQ(used_lanes(listed), 2u);
  EXPECT_EQ(lane_box(listed, 0).max, box.max - origin);
}

TEST(CasterLanes, each_set_bit_is_visited_once) {
  std::uint32_t visited = 0;
  for_each_bit(0x8421u, [&](std::size_t bit) { visited ^= 1u << bit; });
  EXPECT_EQ(visited, 0x8421u);
}

}  // namespace
}  // namespace gnomon::test
