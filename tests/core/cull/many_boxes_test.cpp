// Do plans and measurements say of a tree of boxes what they say of the list, to the last bit, in any order?
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "geometry/visible.hpp"
#include "gnomon/extend/body.hpp"
#include "support/plan_hash.hpp"
#include "support/seeded_input.hpp"

namespace gnomon::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Owned {
  std::vector<CasterBlock> blocks;
  std::vector<std::uint32_t> indices;
  CasterSet set;
  explicit Owned(const std::vector<Box>& boxes)
      : blocks(CasterSet::block_count(boxes.size())),
        indices(CasterSet::index_count(boxes.size())),
        set(boxes, blocks, indices) {}
};

Box random_box(SeededNumbers& numbers, const Box& hull) {
  const auto place = [&] {
    glm::dvec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = numbers.between(hull.min[axis], hull.max[axis]);
    return p;
  };
  const int kind = numbers.pick(12);
  if (kind == 0) return Box{};
  glm::dvec3 a = place();
  if (kind == 1) return {a, a};
  const double share = numbers.chance(0.1) ? 1.0 : 0.02;
  Box box{a, a};
  box.extend(a + (place() - a) * share);
  if (kind == 2) box.max.y = box.min.y;            // flat
  if (kind == 3) std::swap(box.min.x, box.max.x);  // mostly empty, with numbers
  if (kind == 4) box.min = {box.min.x, numbers.chance(0.5) ? 0.0 : -0.0, box.min.z};
  return box;
}

/// `count` boxes where the given ones are, those included.
std::vector<Box> crowd(SeededNumbers& numbers, const std::vector<Box>& given, int count) {
  Box hull;
  for (const Box& box : given) hull.extend(box);
  if (hull.empty()) return std::vector<Box>(static_cast<std::size_t>(count));
  std::vector<Box> boxes = numbers.chance(0.5) ? given : std::vector<Box>{};
  for (int i = 0; i < count; ++i) boxes.push_back(random_box(numbers, hull));
  return boxes;
}

void shuffle(SeededNumbers& numbers, std::vector<Box>& boxes) {
  for (std::size_t i = boxes.size(); i > 1; --i)
    std::swap(boxes[i - 1], boxes[static_cast<std::size_t>(numbers.pick(static_cast<int>(i)))]);
}

std::uint64_t hash_of(const ShadowPlan& plan) {
  PlanHash hash;
  hash.add(plan);
  return hash.value();
}
std::uint64_t hash_of(const AliasingStats& s) {
  PlanHash hash;
  for (const double v : {s.p50, s.p95, s.max, s.mean, s.share_undersampled, s.storage}) hash.add(v);
  hash.add(static_cast<std::uint64_t>(s.samples));
  hash.add(static_cast<std::uint64_t>(s.outside));
  return hash.value();
}

TEST(ManyBoxes, plans_of_sets_and_of_lists_in_any_order_are_the_same_bits) {
  int planned = 0, measured = 0;
  for (int i = 0; i < 1500; ++i) {
    SeededInput in;
    seed_input(static_cast<std::uint64_t>(i) + 77, i % 3 == 0 ? Extremes::stiff : Extremes::ordinary, in);
    SeededNumbers numbers(static_cast<std::uint64_t>(i) * 3 + 1);
    const int most = i % 100 == 0 ? 3000 : 150;
    std::vector<Box> casters = crowd(numbers, in.casters, 1 + numbers.pick(most));
    std::vector<Box> receivers = crowd(numbers, in.receivers, 1 + numbers.pick(most));
    const auto plan = [&](const SceneBounds& bounds) {
      return make_plan(in.camera, in.light, bounds, in.options);
    };
    const ShadowPlan of_lists = plan({casters, receivers});
    const Owned caster_set(casters), receiver_set(receivers);
    const ShadowPlan of_sets = plan({caster_set.set, receiver_set.set});
    ASSERT_EQ(hash_of(of_sets), hash_of(of_lists)) << "case " << i;
    ASSERT_EQ(hash_of(plan({caster_set.set, receivers})), hash_of(of_lists)) << "case " << i;
    if (of_lists.status == PlanStatus::ok) {
      ++planned;
      const AliasingStats stats = measure(of_lists, in.camera, {casters, receivers}, {8, 8, 8});
      const AliasingStats again = measure(of_lists, in.camera, {caster_set.set, receiver_set.set}, {8, 8, 8});
      ASSERT_EQ(hash_of(stats), hash_of(again)) << "case " << i;
      measured += stats.samples > 0 ? 1 : 0;
    }
    shuffle(numbers, casters);
    shuffle(numbers, receivers);
    ASSERT_EQ(hash_of(plan({casters, receivers})), hash_of(of_lists)) << "shuffled, case " << i;
  }
  EXPECT_GT(planned, 500);
  EXPECT_GT(measured, 300);
}

/// A camera over a plain of boxes.
struct Plain {
  Camera camera = perspective_camera({0, 12, 40}, {0.2, -0.3, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 120, 900, 600);
  std::vector<Box> boxes;
  explicit Plain(int count, std::uint64_t seed = 5) {
    SeededNumbers numbers(seed);
    for (int i = 0; i < count; ++i) boxes.push_back(random_box(numbers, {{-90, 0, -100}, {90, 8, 80}}));
  }
};

TEST(ManyBoxes, the_visible_part_is_the_hull_of_what_each_box_has_inside) {
  const Plain plain(700);
  const CameraAxes axes = camera_axes(plain.camera);
  const glm::dvec3 eye = plain.camera.position;
  for (const double end : {3.0, 30.0, 60.0, 120.0}) {
    const Polytope region = frustum_slice(plain.camera, axes, end / 2.0, end);
    Box expected;
    for (const Box& box : plain.boxes) {
      if (box.empty()) continue;
      Polytope part = region;
      clip(part, relative_to(box, eye));
      expected.extend(bounds_of(part));
    }
    const Box found = visible_bounds(region, plain.boxes, eye);
    ASSERT_EQ(found.empty(), expected.empty());
    if (found.empty()) continue;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(found.min[axis], expected.min[axis], 1e-10) << end;
      EXPECT_NEAR(found.max[axis], expected.max[axis], 1e-10) << end;
    }
  }
}

/// Boxes that only touch a plane are not.
bool outside(const Plane& plane, const Box& box) {
  const glm::dvec3& n = plane.normal;
  const double inward = (n.x > 0.0 ? box.max.x : box.min.x) * n.x +
                        (n.y > 0.0 ? box.max.y : box.min.y) * n.y + (n.z > 0.0 ? box.max.z : box.min.z) * n.z;
  constexpr double kTouching = 1e-12;
  return inward + plane.offset < -kTouching * (std::abs(inward) + std::abs(plane.offset));
}

TEST(ManyBoxes, casters_inside_planes_are_those_that_one_test_after_the_other_finds) {
  const Plain plain(900);
  const Owned owned(plain.boxes);
  const CameraAxes axes = camera_axes(plain.camera);
  const glm::dvec3 eye = plain.camera.position, up{0.3, 0.9, -0.2};
  int some = 0;
  for (const double begin : {1.0, 10.0, 25.0, 60.0, 118.0}) {
    const Polytope region = frustum_slice(plain.camera, axes, begin, begin * 1.1);
    const std::span planes(region.plane.data(), static_cast<std::size_t>(region.face_count));
    CasterReach expected{{}, -kInfinity, false};
    for (const Box& world : plain.boxes) {
      if (world.empty()) continue;
      const Box box = relative_to(world, eye);
      if (std::any_of(planes.begin(), planes.end(), [&](const Plane& p) { return outside(p, box); }))
        continue;
      expected.any = true;
      expected.bounds.extend(box);
      for (int k = 0; k < 8; ++k) {
        const glm::dvec3 p{(k & 1) != 0 ? box.max.x : box.min.x, (k & 2) != 0 ? box.max.y : box.min.y,
                           (k & 4) != 0 ? box.max.z : box.min.z};
        expected.top = std::max(expected.top, p.x * up.x + p.y * up.y + p.z * up.z);
      }
    }
    some += expected.any ? 1 : 0;
    for (const Boxes& boxes : {Boxes(plain.boxes), Boxes(owned.set)}) {
      const CasterReach found = casters_inside(planes, boxes, eye, up);
      EXPECT_EQ(found.any, expected.any);
      EXPECT_EQ(found.top, expected.top);
      EXPECT_EQ(found.bounds.min, expected.bounds.min);
      EXPECT_EQ(found.bounds.max, expected.bounds.max);
    }
  }
  EXPECT_GT(some, 3);
}

TEST(ManyBoxes, the_nearest_part_is_that_of_cutting_every_box) {
  int cut_deeper = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Plain plain(300, seed);
    const Owned owned(plain.boxes);
    // A pyramid that looks down on the plain.
    const Camera light = perspective_camera({5.0 * static_cast<double>(seed % 7), 30, 0}, {0.1, -1, 0.05},
                                            {1, 0, 0}, 0.3, 1.0, 1.0, 100, 10, 10);
    const CameraAxes axes = camera_axes(light);
    const Polytope region = frustum_slice(light, axes, 1.0, 100.0);
    const std::span planes(region.plane.data(), static_cast<std::size_t>(region.face_count));
    double expected = kInfinity, corner = kInfinity;
    for (const Box& world : plain.boxes) {
      if (world.empty()) continue;
      const Box box = relative_to(world, light.position);
      Polytope part = box_polytope(box);
      for (const Plane& p : planes) clip(part, p);
      for (const Polytope::Vertex& v : part.vertices())
        expected = std::min(expected, glm::dot(axes.forward, v.position));
      if (part.empty()) continue;
      const Polytope whole = box_polytope(box);
      for (const Polytope::Vertex& v : whole.vertices())
        corner = std::min(corner, glm::dot(axes.forward, v.position));
    }
    cut_deeper += expected > corner + 1e-9 ? 1 : 0;
    for (const Boxes& boxes : {Boxes(plain.boxes), Boxes(owned.set)}) {
      const double found =
          nearest_inside(planes, region, boxes, light.position, -axes.forward, glm::dvec3(0.0), -kInfinity)
              .nearest;
      if (expected < kInfinity) {
        EXPECT_NEAR(found, expected, 1e-9) << seed;
      } else {
        EXPECT_EQ(found, kInfinity) << seed;
      }
    }
  }
  EXPECT_GT(cut_deeper, 5);
}

TEST(ManyBoxes, more_boxes_in_the_way_than_are_cut_leave_a_bound_below_the_nearest) {
  // Slabs whose corners are nearer than the part inside, 200 of them.
  std::vector<Box> slabs;
  for (int i = 0; i < 200; ++i) slabs.push_back({{2.0, 0.0, -10.0 - i}, {30.0, 1.0, -1.0 - 0.01 * i}});
  const Camera eye = perspective_camera({0, 0.5, 0}, {0, 0, -1}, {0, 1, 0}, 0.5, 1.0, 1.0, 100, 10, 10);
  const Polytope region = frustum_slice(eye, camera_axes(eye), 1.0, 100.0);
  const std::span planes(region.plane.data(), static_cast<std::size_t>(region.face_count));
  const Owned owned(slabs);
  for (const std::size_t few : {60u, 200u}) {
    const double found = nearest_inside(planes, region, std::span(slabs).first(few), eye.position, {0, 0, 1},
                                        glm::dvec3(0.0), 0.0)
                             .nearest;
    // x >= 2 is seen from z = 2 / tan(0.25) on.
    const double exact = 2.0 / std::tan(0.25);
    if (few == 60) {
      EXPECT_NEAR(found, exact, 1e-9);
    } else {
      EXPECT_LE(found, exact);
      EXPECT_GE(found, 1.5);
    }
  }
  EXPECT_EQ(nearest_inside(planes, region, owned.set, eye.position, {0, 0, 1}, glm::dvec3(0.0), 0.0).nearest,
            nearest_inside(planes, region, slabs, eye.position, {0, 0, 1}, glm::dvec3(0.0), 0.0).nearest);
}

TEST(ManyBoxes, a_box_that_is_no_number_makes_the_set_what_it_makes_the_list) {
  const Plain plain(500);
  const Light light = DirectionalLight{{0.3, -1.0, 0.2}};
  for (const double bad : {kNan, kInfinity, 2e30}) {
    std::vector<Box> boxes = plain.boxes;
    boxes[123] = {{0, 0, 0}, {1, bad, 1}};
    Owned owned(boxes);
    const Owned good(plain.boxes);
    EXPECT_FALSE(owned.set.usable());
    EXPECT_TRUE(good.set.usable());
    for (const bool set : {false, true}) {
      const Boxes broken = set ? Boxes(owned.set) : Boxes(boxes);
      const ShadowPlan casters = make_plan(plain.camera, light, {broken, good.set}, {});
      EXPECT_EQ(casters.status, PlanStatus::invalid_input);
      EXPECT_EQ(casters.invalid_field, "bounds.casters");
      EXPECT_EQ(make_plan(plain.camera, light, {good.set, broken}, {}).invalid_field, "bounds.receivers");
    }
    owned.set.update(123, plain.boxes[123]);
    EXPECT_EQ(make_plan(plain.camera, light, {owned.set, owned.set}, {}).status, PlanStatus::ok);
  }
}

TEST(ManyBoxes, sets_of_nothing_and_of_empty_boxes_show_nothing) {
  const Plain plain(10);
  const Light light = DirectionalLight{{0.3, -1.0, 0.2}};
  const CasterSet nothing;
  const Owned empty(std::vector<Box>(100));
  const Owned one(std::vector<Box>(1));
  for (const Boxes& boxes : {Boxes(nothing), Boxes(empty.set), Boxes(one.set), Boxes()}) {
    EXPECT_EQ(make_plan(plain.camera, light, {boxes, boxes}, {}).status, PlanStatus::nothing_visible);
    EXPECT_EQ(make_plan(plain.camera, light, {boxes, plain.boxes}, {}).status, PlanStatus::no_caster);
    EXPECT_EQ(make_plan(plain.camera, light, {plain.boxes, boxes}, {}).status, PlanStatus::nothing_visible);
    const ShadowPlan plan = make_plan(plain.camera, light, {plain.boxes, plain.boxes}, {});
    EXPECT_EQ(measure(plan, plain.camera, {boxes, boxes}).samples, 0u);
  }
}

/// Whether a ray meets a box in view at none of these depths.
bool passes_between(const std::vector<double>& depths, const Camera& camera, const glm::dvec3& start,
                    const glm::dvec3& step, const Box& box) {
  if (box.empty()) return false;
  double begin = camera.near_depth, end = camera.far_depth;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = (box.min[axis] - start[axis]) / step[axis],
                 high = (box.max[axis] - start[axis]) / step[axis];
    begin = std::max(begin, std::min(low, high));
    end = std::min(end, std::max(low, high));
  }
  return begin <= end && begin < camera.far_depth &&
         std::none_of(depths.begin(), depths.end(), [&](double d) { return d >= begin && d <= end; });
}

/// Points of the grid in some box, one ray, depth and box after the other; and one for each ray that passes a
/// box between two depths.
std::uint64_t points_by_definition(const Camera& camera, const std::vector<Box>& boxes,
                                   const MeasureOptions& grid) {
  const CameraAxes axes = camera_axes(camera);
  std::vector<double> depths;
  for (int k = 0; k < grid.depths; ++k) {
    const double t = (k + 0.5) / grid.depths, n = camera.near_depth, f = camera.far_depth;
    depths.push_back(n > 0.0 ? n * std::pow(f / n, t) : n + (f - n) * t);
  }
  std::uint64_t count = 0;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const double x = camera.left + (camera.right - camera.left) * (column + 0.5) / grid.columns;
      const double y = camera.bottom + (camera.top - camera.bottom) * (row + 0.5) / grid.rows;
      const glm::dvec3 image = axes.right * x + axes.up * y;
      const glm::dvec3 start = camera.orthographic ? camera.position + image : camera.position,
                       step = camera.orthographic ? axes.forward : axes.forward + image;
      count += std::any_of(boxes.begin(), boxes.end(),
                           [&](const Box& b) { return passes_between(depths, camera, start, step, b); });
      for (const double depth : depths) {
        const glm::dvec3 p = start + step * depth;
        count += std::any_of(boxes.begin(), boxes.end(), [&](const Box& b) {
          return p.x >= b.min.x && p.x <= b.max.x && p.y >= b.min.y && p.y <= b.max.y && p.z >= b.min.z &&
                 p.z <= b.max.z;
        });
      }
    }
  }
  return count;
}

TEST(ManyBoxes, measuring_counts_every_point_of_the_grid_in_some_box) {
  std::uint64_t points = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    Plain plain(seed % 2 == 0 ? 300 : 12, seed);
    const bool orthographic = seed % 3 == 0;
    if (orthographic)
      plain.camera =
          orthographic_camera({0, 12, 40}, {0.2, -0.3, -1}, {0, 1, 0}, 50, 1.5, 0.5, 120, 900, 600);
    // From among the boxes, too, where they surround the eye.
    if (seed % 4 == 1) plain.camera.position = {0, 4, 0};
    // More rays, and more depths, than fit the memory at once.
    const MeasureOptions grid = seed % 5 == 0 ? MeasureOptions{40, 37, 300} : MeasureOptions{53, 31, 20};
    const Light light = DirectionalLight{{0.3, -1.0, 0.2}};
    const ShadowPlan plan = make_plan(plain.camera, light, {plain.boxes, plain.boxes}, {});
    if (plan.status != PlanStatus::ok) continue;
    const AliasingStats stats = measure(plan, plain.camera, {plain.boxes, plain.boxes}, grid);
    const std::uint64_t expected = points_by_definition(plain.camera, plain.boxes, grid);
    // A point on a face may fall on either side by rounding: none of these grids has one.
    EXPECT_EQ(stats.samples + stats.outside, expected) << seed;
    points += expected;
  }
  EXPECT_GT(points, 100'000u);
}

}  // namespace
}  // namespace gnomon::test
