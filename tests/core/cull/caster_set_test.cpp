// Does the tree of casters give what testing one box after the other gives?
#include "gnomon/bounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Indices = std::vector<std::uint32_t>;

/// A set with its memory.
struct Owned {
  std::vector<CasterBlock> blocks;
  std::vector<std::uint32_t> indices;
  CasterSet set;
  explicit Owned(std::span<const Box> boxes)
      : blocks(CasterSet::block_count(boxes.size())),
        indices(CasterSet::index_count(boxes.size())),
        set(boxes, blocks, indices) {}
};

Indices listed(const CasterSet& set, const ShadowMap& map) {
  Indices list(set.size());
  const std::size_t count = set.cull(map, list);
  EXPECT_LE(count, list.size());
  list.resize(count);
  std::sort(list.begin(), list.end());
  return list;
}
Indices one_by_one(const ShadowMap& map, std::span<const Box> boxes) {
  Indices list(boxes.size());
  list.resize(cull_casters(map, boxes, list));
  return list;
}

/// What both must be: written down again, a box and a plane at a time.
Indices by_definition(const ShadowMap& map, std::span<const Box> boxes) {
  Indices list;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    bool kept = !boxes[i].empty();
    for (int k = 0; k < map.cull_plane_count; ++k) {
      const glm::dvec4 p = map.cull_planes[static_cast<std::size_t>(k)];
      double sum[3];
      for (int axis = 0; axis < 3; ++axis)
        sum[axis] = p[axis] * (p[axis] > 0.0 ? boxes[i].max[axis] : boxes[i].min[axis]);
      kept = kept && !(sum[0] + sum[1] + sum[2] + p.w < 0.0);
    }
    if (kept) list.push_back(static_cast<std::uint32_t>(i));
  }
  return list;
}

ShadowMap with_planes(std::initializer_list<glm::dvec4> planes) {
  ShadowMap map{};
  for (const glm::dvec4& p : planes) map.cull_planes[static_cast<std::size_t>(map.cull_plane_count++)] = p;
  return map;
}

ShadowMap random_map(Random& random) {
  ShadowMap map{};
  const int planes = random.pick(kMaxCullPlanes + 1);
  for (int k = 0; k < planes; ++k) {
    glm::dvec3 n = random.direction();
    if (random.unit() < 0.3) n = {0.0, random.unit() < 0.5 ? 1.0 : -1.0, 0.0};
    map.cull_planes[static_cast<std::size_t>(k)] = glm::dvec4(n, random.between(-3.0, 30.0));
  }
  map.cull_plane_count = planes;
  return map;
}

Box random_caster(Random& random) {
  const int kind = random.pick(20);
  const double at = 20.0;
  const glm::dvec3 centre{random.between(-at, at), random.between(-at, at), random.between(-at, at)};
  glm::dvec3 half{random.unit(), random.unit(), random.unit()};
  if (kind == 0) return Box{};
  if (kind == 1) return {centre + half, centre - half};  // empty, with numbers
  if (kind == 2) half = glm::dvec3(0.0);
  if (kind == 3) half[random.pick(3)] = 0.0;
  if (kind == 4) half *= 20.0;
  if (kind == 5) return {{3, 3, 3}, {4, 4, 4}};  // many of the same
  return {centre - half, centre + half};
}

static_assert(noexcept(std::declval<const CasterSet&>().cull(std::declval<const ShadowMap&>(), {})));
static_assert(noexcept(std::declval<CasterSet&>().update(0, std::declval<const Box&>())));

TEST(CasterSet, a_set_of_nothing_lists_nothing) {
  const CasterSet none;
  EXPECT_EQ(none.size(), 0u);
  EXPECT_EQ(none.cull(ShadowMap{}, {}), 0u);
  Owned of_none({});
  EXPECT_EQ(of_none.set.cull(ShadowMap{}, {}), 0u);
  of_none.set.update(0, Box{{0, 0, 0}, {1, 1, 1}});
  of_none.set.refit({});
  EXPECT_EQ(of_none.set.size(), 0u);
}

TEST(CasterSet, memory_that_is_too_small_leaves_the_set_without_boxes) {
  const std::vector<Box> boxes(100, Box{{0, 0, 0}, {1, 1, 1}});
  std::vector<CasterBlock> blocks(CasterSet::block_count(100));
  std::vector<std::uint32_t> indices(CasterSet::index_count(100));
  EXPECT_EQ(CasterSet(boxes, std::span(blocks).first(blocks.size() - 1), indices).size(), 0u);
  EXPECT_EQ(CasterSet(boxes, blocks, std::span(indices).first(199)).size(), 0u);
  EXPECT_EQ(CasterSet(boxes, blocks, indices).size(), 100u);
}

TEST(CasterSet, memory_that_is_too_small_makes_plans_refuse_the_set) {
  const std::vector<Box> boxes(100, Box{{-1, -1, -10}, {1, 1, -2}});
  std::vector<CasterBlock> blocks(CasterSet::block_count(100));
  std::vector<std::uint32_t> indices(CasterSet::index_count(100));
  const CasterSet whole(boxes, blocks, indices);
  EXPECT_TRUE(whole.usable());
  EXPECT_TRUE(CasterSet({}, {}, {}).usable());
  const CasterSet cut(boxes, std::span(blocks).first(blocks.size() - 1), indices);
  EXPECT_FALSE(cut.usable());
  const Camera camera = perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.0, 0.1, 100.0, 64, 64);
  const DirectionalLight sun{{0.1, -1.0, 0.0}};
  EXPECT_EQ(make_plan(camera, sun, {whole, whole}).status, PlanStatus::ok);
  for (const SceneBounds& bounds : {SceneBounds{cut, whole}, SceneBounds{whole, cut}}) {
    const ShadowPlan plan = make_plan(camera, sun, bounds);
    EXPECT_EQ(plan.status, PlanStatus::invalid_input);
    EXPECT_NE(plan.invalid_field.find("bounds."), std::string_view::npos) << plan.invalid_field;
  }
}

TEST(CasterSet, blocks_hold_eight_boxes_and_eight_blocks_each) {
  EXPECT_EQ(CasterSet::block_count(0), 0u);
  EXPECT_EQ(CasterSet::block_count(8), 1u);
  EXPECT_EQ(CasterSet::block_count(9), 2u + 1u);
  EXPECT_EQ(CasterSet::block_count(64), 8u + 1u);
  EXPECT_EQ(CasterSet::block_count(65), 9u + 2u + 1u);
}

TEST(CasterSet, one_box_is_listed_on_one_side_of_a_plane_and_where_it_touches_it) {
  const Box box{{1, 0, 0}, {2, 1, 1}};
  const Owned owned({&box, 1});
  EXPECT_EQ(listed(owned.set, with_planes({{1, 0, 0, -1.5}})), Indices{0});
  EXPECT_EQ(listed(owned.set, with_planes({{1, 0, 0, -2.0}})), Indices{0});
  EXPECT_EQ(listed(owned.set, with_planes({{1, 0, 0, -2.5}})), Indices{});
  EXPECT_EQ(listed(owned.set, with_planes({{-1, 0, 0, 1.0}})), Indices{0});
  EXPECT_EQ(listed(owned.set, with_planes({{-1, 0, 0, 0.5}})), Indices{});
}

TEST(CasterSet, without_planes_everything_but_the_empty_boxes_is_listed) {
  std::vector<Box> boxes(1000, Box{{0, 0, 0}, {1, 1, 1}});
  for (std::size_t i = 0; i < boxes.size(); i += 10) boxes[i] = Box{};
  const Owned owned(boxes);
  const Indices list = listed(owned.set, ShadowMap{});
  EXPECT_EQ(list.size(), 900u);
  EXPECT_TRUE(std::none_of(list.begin(), list.end(), [](std::uint32_t i) { return i % 10 == 0; }));
  const std::vector<Box> empty(77);
  EXPECT_EQ(listed(Owned(empty).set, ShadowMap{}), Indices{});
}

TEST(CasterSet, equal_boxes_are_all_listed_or_none_is) {
  const std::vector<Box> boxes(777, Box{{1, 1, 1}, {1, 1, 1}});
  const Owned owned(boxes);
  EXPECT_EQ(listed(owned.set, with_planes({{0, 1, 0, -1.0}})).size(), 777u);
  EXPECT_EQ(listed(owned.set, with_planes({{0, 1, 0, -1.0000001}})).size(), 0u);
}

TEST(CasterSet, an_endless_box_is_always_listed) {
  std::vector<Box> boxes(100, Box{{5, 5, 5}, {6, 6, 6}});
  boxes[42] = {glm::dvec3(-kInfinity), glm::dvec3(kInfinity)};
  const ShadowMap map = with_planes({{0, 1, 0, -100.0}, {0.6, 0, -0.8, -3.0}});
  EXPECT_EQ(listed(Owned(boxes).set, map), Indices{42});
  EXPECT_EQ(one_by_one(map, boxes), Indices{42});
}

TEST(CasterSet, a_list_without_room_is_filled_and_all_are_counted) {
  const std::vector<Box> boxes(100, Box{{0, 0, 0}, {1, 1, 1}});
  const Owned owned(boxes);
  for (const std::size_t room : {0u, 1u, 7u, 63u, 64u, 65u, 99u}) {
    Indices list(room + 1, 12345u);
    EXPECT_EQ(owned.set.cull(ShadowMap{}, std::span(list).first(room)), 100u);
    EXPECT_EQ(list.back(), 12345u);
    list.pop_back();
    std::sort(list.begin(), list.end());
    EXPECT_EQ(std::adjacent_find(list.begin(), list.end()), list.end());
    EXPECT_TRUE(list.empty() || list.back() < 100u);
  }
}

TEST(CasterSet, lists_what_the_definition_and_the_linear_search_list_for_any_planes) {
  std::size_t kept = 0, culled = 0;
  for_all(600, [&] {
    Random random(static_cast<std::uint64_t>(pick(1 << 30)));
    const int count = pick(3) == 0 ? pick(40) : pick(3000);
    std::vector<Box> boxes;
    for (int i = 0; i < count; ++i) boxes.push_back(random_caster(random));
    const Owned owned(boxes);
    for (int k = 0; k < 4; ++k) {
      const ShadowMap map = random_map(random);
      const Indices expected = by_definition(map, boxes);
      require(listed(owned.set, map) == expected, "set", count, map.cull_plane_count);
      require(one_by_one(map, boxes) == expected, "linear", count, map.cull_plane_count);
      kept += expected.size();
      culled += boxes.size() - expected.size();
    }
  });
  EXPECT_GT(kept, 50'000u);
  EXPECT_GT(culled, 500'000u);
}

TEST(CasterSet, planes_through_corners_are_distinguished_to_the_last_bit) {
  // Offsets that are the negative of some box's own rounded sum: on the plane, and one bit beside it.
  std::size_t kept = 0, culled = 0;
  for_all(200, [&] {
    Random random(static_cast<std::uint64_t>(pick(1 << 30)));
    std::vector<Box> boxes;
    for (int i = 0; i < 500; ++i) boxes.push_back(random_caster(random));
    const Owned owned(boxes);
    for (const Box& box : boxes) {
      if (box.empty() || random.unit() > 0.05) continue;
      const glm::dvec3 n = random.direction();
      const double sum = n.x * (n.x > 0.0 ? box.max.x : box.min.x) +
                         n.y * (n.y > 0.0 ? box.max.y : box.min.y) +
                         n.z * (n.z > 0.0 ? box.max.z : box.min.z);
      const auto chosen = static_cast<std::uint32_t>(&box - boxes.data());
      for (const double offset : {-sum, std::nextafter(-sum, -kInfinity)}) {
        const ShadowMap map = with_planes({glm::dvec4(n, offset)});
        const Indices list = listed(owned.set, map);
        require(list == by_definition(map, boxes), "set");
        const bool in = std::binary_search(list.begin(), list.end(), chosen);
        require(in == (offset == -sum), "the box on the plane", in);
        (in ? kept : culled) += 1;
      }
    }
  });
  EXPECT_GT(kept, 1000u);
  EXPECT_GT(culled, 1000u);
}

TEST(CasterSet, lists_what_the_linear_search_lists_for_planned_maps) {
  std::size_t maps = 0;
  for_all(400, [&] {
    const Case c = draw_case({.max_boxes = 400});
    const Owned owned(c.casters);
    const ShadowPlan plan = c.plan();
    for (const ShadowMap& map : plan.maps()) {
      ++maps;
      require(listed(owned.set, map) == one_by_one(map, c.casters), "cascade", map.cascade);
    }
  });
  EXPECT_GT(maps, 400u);
}

TEST(CasterSet, boxes_that_moved_vanished_or_came_are_found_where_they_are_now) {
  for_all(300, [&] {
    Random random(static_cast<std::uint64_t>(pick(1 << 30)));
    std::vector<Box> boxes;
    const int count = 1 + pick(1500);
    for (int i = 0; i < count; ++i) boxes.push_back(random_caster(random));
    Owned owned(boxes);
    const bool one_at_a_time = chance(0.5);
    for (Box& box : boxes) {
      if (random.unit() < 0.7) continue;
      box = random_caster(random);
      if (one_at_a_time) owned.set.update(static_cast<std::uint32_t>(&box - boxes.data()), box);
    }
    if (!one_at_a_time) owned.set.refit(boxes);
    for (int k = 0; k < 3; ++k) {
      const ShadowMap map = random_map(random);
      require(listed(owned.set, map) == by_definition(map, boxes), one_at_a_time ? "update" : "refit", count);
    }
  });
}

TEST(CasterSet, one_box_that_is_none_among_many_is_refused) {
  std::vector<Box> boxes(200, Box{{-1, 0, -11}, {1, 1, -10}});
  Owned owned(boxes);
  const std::vector<Box> ground = {{{-50, -1, -100}, {50, 0, 0}}};
  const Camera camera = perspective_camera({0, 2, 0}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 100, 640, 480);
  const auto status = [&] {
    return make_plan(camera, DirectionalLight{{0.3, -1, 0}}, SceneBounds{owned.set, ground}).status;
  };
  EXPECT_EQ(status(), PlanStatus::ok);
  for (const std::uint32_t index : {0u, 77u, 199u}) {
    owned.set.update(index, {{0, std::numeric_limits<double>::quiet_NaN(), 0}, {1, 1, 1}});
    EXPECT_EQ(status(), PlanStatus::invalid_input) << index;
    owned.set.update(index, boxes[index]);
    EXPECT_EQ(status(), PlanStatus::ok) << index;
  }
}

TEST(CasterSet, a_refit_with_another_number_of_boxes_changes_nothing) {
  std::vector<Box> boxes(20, Box{{0, 0, 0}, {1, 1, 1}});
  Owned owned(boxes);
  const std::vector<Box> fewer(19, Box{{50, 0, 0}, {51, 1, 1}});
  owned.set.refit(fewer);
  owned.set.update(20, fewer[0]);
  EXPECT_EQ(listed(owned.set, with_planes({{-1, 0, 0, 10.0}})).size(), 20u);
}

}  // namespace
}  // namespace gnomon::test
