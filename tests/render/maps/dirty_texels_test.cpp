// Do the rectangles of moved casters hold every texel that their triangles cover, and few others?
#include "maps/dirty_texels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <random>
#include <vector>

#include "maps/texel_mask.hpp"

namespace gnomon::render {
namespace {

/// Texels of a map, one by one.
struct Texels {
  int width, height;
  std::vector<std::uint8_t> at;

  Texels(int w, int h) : width(w), height(h), at(static_cast<std::size_t>(w * h)) {}
  std::uint8_t& operator()(int x, int y) { return at[static_cast<std::size_t>(y * width + x)]; }
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(std::count(at.begin(), at.end(), std::uint8_t{1}));
  }
  /// Those whose centres lie in a triangle.
  void cover(const std::array<glm::dvec2, 3>& p) {
    const auto turn = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
      return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    const double sign = turn(p[0], p[1], p[2]) < 0.0 ? -1.0 : 1.0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const glm::dvec2 centre(x + 0.5, y + 0.5);
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i)
          inside = inside && sign * turn(p[i], p[(i + 1) % 3], centre) >= 0.0;
        if (inside) (*this)(x, y) = 1;
      }
    }
  }
  /// How many of these are in no rectangle.
  [[nodiscard]] std::size_t missing(std::span<const TexelRect> rectangles) const {
    Texels left = *this;
    for (const TexelRect& r : rectangles) {
      EXPECT_TRUE(r.x >= 0 && r.y >= 0 && r.x + r.width <= width && r.y + r.height <= height && !r.empty());
      for (int y = r.y; y < r.y + r.height; ++y)
        for (int x = r.x; x < r.x + r.width; ++x) left(x, y) = 0;
    }
    return left.count();
  }
};

double area(std::span<const TexelRect> rectangles) {
  double sum = 0.0;
  for (const TexelRect& r : rectangles) sum += 1.0 * r.width * r.height;
  return sum;
}

constexpr std::array<std::array<std::uint8_t, 2>, 3> kEdges{{{0, 1}, {1, 2}, {2, 0}}};

TEST(TexelMask, holds_all_texels_of_triangles_and_few_others) {
  std::mt19937 random(7);
  const auto within = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
  };
  TexelMask mask;
  for (int round = 0; round < 60; ++round) {
    const int width = 40 + static_cast<int>(random() % 120), height = 40 + static_cast<int>(random() % 60);
    Texels exact(width, height);
    mask.reset(width, height);
    const double size = round % 3 == 0 ? 3.0 : round % 3 == 1 ? 20.0 : 200.0;
    for (int i = 0; i < 5 + round; ++i) {
      const glm::dvec2 at(within(-20.0, width + 20.0), within(-20.0, height + 20.0));
      std::array<glm::dvec2, 3> triangle;
      for (glm::dvec2& corner : triangle) corner = at + glm::dvec2(within(-size, size), within(-size, size));
      if (i % 4 == 0) triangle[1].y = triangle[0].y;  // level
      if (i % 7 == 0) triangle[2].x = triangle[0].x;  // upright
      exact.cover(triangle);
      mask.mark(triangle, kEdges, glm::dvec2(0.0));
    }
    const std::span<const TexelRect> close = mask.rectangles(100000);
    EXPECT_EQ(exact.missing(close), 0u) << "round " << round;
    EXPECT_LE(area(close), 1.07 * static_cast<double>(exact.count()) + 5.0) << "round " << round;
    for (const std::size_t most : {40u, 5u, 1u}) {
      const std::span<const TexelRect> few = mask.rectangles(most);
      EXPECT_LE(few.size(), most);
      EXPECT_EQ(exact.missing(few), 0u) << "round " << round << ", at most " << most;
    }
  }
}

TEST(TexelMask, large_maps_are_marked_by_squares) {
  TexelMask mask;
  mask.reset(3000, 2100);
  mask.mark({2990.2, 2090.1}, {3200.0, 2200.0}, glm::dvec2(0.0));
  const std::span<const TexelRect> corner = mask.rectangles(8);
  ASSERT_EQ(corner.size(), 1u);
  EXPECT_EQ(corner[0], (TexelRect{2988, 2088, 12, 12}));
  mask.reset(3000, 2100);
  EXPECT_TRUE(mask.rectangles(8).empty());
  mask.mark({-50.0, -50.0}, {-1.0, -1.0}, glm::dvec2(0.0));
  EXPECT_TRUE(mask.rectangles(8).empty());
}

/// A mesh on the CPU, and the poses that it takes.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;

  [[nodiscard]] CasterShape posed(const glm::dmat4& world_from_object) const {
    CasterShape shape;
    shape.positions = positions;
    shape.indices = indices;
    shape.world_from_object = world_from_object;
    for (const glm::vec3& p : positions)
      shape.bounds_world.extend(glm::dvec3(world_from_object * glm::dvec4(glm::dvec3(p), 1.0)));
    return shape;
  }
};

/// A figure with limbs: its box holds much that it does not.
Mesh figure() {
  Mesh mesh;
  const auto add = [&mesh](const glm::vec3& low, const glm::vec3& high) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < 8; ++i)
      mesh.positions.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                                  (i & 4) != 0 ? high.z : low.z);
    for (const std::uint32_t i : {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                  2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5})
      mesh.indices.push_back(first + i);
  };
  add({-1.0f, 1.0f, -0.3f}, {1.0f, 1.6f, 0.3f});
  add({-1.0f, 0.0f, -0.3f}, {-0.7f, 1.0f, 0.0f});
  add({0.7f, 0.0f, 0.0f}, {1.0f, 1.0f, 0.3f});
  add({0.9f, 1.5f, -0.1f}, {1.2f, 2.4f, 0.1f});
  return mesh;
}

ShadowMap map_of(const glm::dmat4& clip_from_world, int size) {
  ShadowMap map;
  map.clip_from_world = clip_from_world;
  map.width = map.height = size;
  return map;
}
ShadowMap sun_map(int size = 256) {
  return map_of(glm::orthoRH_ZO(-5.0, 5.0, -5.0, 5.0, 0.0, 40.0) *
                    glm::lookAt(glm::dvec3(6.0, 14.0, 9.0), glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0)),
                size);
}
ShadowMap spot_map(int size = 256) {
  return map_of(glm::perspectiveRH_ZO(0.6, 1.0, 1.0, 40.0) *
                    glm::lookAt(glm::dvec3(6.0, 14.0, 9.0), glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0)),
                size);
}

void cover(Texels& texels, const ShadowMap& map, const CasterShape& shape, const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::array<glm::dvec2, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec4 clip = map.clip_from_world * shape.world_from_object *
                              glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[i + k]]), 1.0);
      triangle[k] = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(map.width, map.height);
    }
    texels.cover(triangle);
  }
}

glm::dmat4 walking(double at) {
  return glm::rotate(glm::translate(glm::dmat4(1.0), {-2.0 + at, 0.0, 0.5 * at}), 0.4 * at,
                     glm::dvec3(0.0, 1.0, 0.0));
}

TEST(DirtyShapes, follow_a_walking_figure_within_a_fifth_of_its_texels) {
  const Mesh mesh = figure();
  for (const ShadowMap& map : {sun_map(), spot_map(), sun_map(64)}) {
    DirtyShapes shapes, each;
    double drawn = 0.0, exact = 0.0, boxes = 0.0;
    for (int frame = 1; frame < 30; ++frame) {
      const MovedCaster moved{3, mesh.posed(walking(0.1 * (frame - 1))), mesh.posed(walking(0.1 * frame))};
      Texels covered(map.width, map.height);
      cover(covered, map, moved.from, mesh);
      cover(covered, map, moved.to, mesh);
      ASSERT_TRUE(shapes.find(map, {}, {&moved, 1}));
      EXPECT_EQ(covered.missing(shapes.rectangles()), 0u) << "frame " << frame;
      each.forget();
      ASSERT_TRUE(each.find(map, {}, {&moved, 1}));
      EXPECT_EQ(area(each.rectangles()), area(shapes.rectangles())) << "what it remembers is what it finds";
      drawn += area(shapes.rectangles());
      exact += static_cast<double>(covered.count());
      const std::array<Box, 2> bounds{moved.from.bounds_world, moved.to.bounds_world};
      boxes += area(dirty_bounds(map, bounds).rectangles());
    }
    EXPECT_LE(drawn, (map.width < 100 ? 1.35 : 1.2) * exact) << map.width;
    EXPECT_GT(boxes, 2.0 * exact) << "boxes would do";
  }
}

TEST(DirtyShapes, casters_that_rest_are_not_marked_and_those_that_start_are) {
  const Mesh mesh = figure();
  const ShadowMap map = sun_map();
  DirtyShapes shapes;
  const auto moved = [&mesh](std::uint32_t instance, double from, double to) {
    return MovedCaster{instance, mesh.posed(walking(from)), mesh.posed(walking(to))};
  };
  const auto covered = [&](std::span<const MovedCaster> casters) {
    Texels texels(map.width, map.height);
    for (const MovedCaster& caster : casters)
      for (const CasterShape& shape : {caster.from, caster.to}) cover(texels, map, shape, mesh);
    return texels;
  };
  const std::array<MovedCaster, 1> left{moved(1, 0.0, 0.1)}, right{moved(2, 3.0, 3.1)};
  ASSERT_TRUE(shapes.find(map, {}, left));
  EXPECT_GT(area(shapes.rectangles()), 0.0);
  ASSERT_TRUE(shapes.find(map, {}, {}));
  EXPECT_EQ(area(shapes.rectangles()), 0.0);
  ASSERT_TRUE(shapes.find(map, {}, std::array{moved(1, 0.1, 0.2)}));
  ASSERT_TRUE(shapes.find(map, {}, right));
  Texels texels = covered(right);
  EXPECT_EQ(texels.missing(shapes.rectangles()), 0u);
  EXPECT_LE(area(shapes.rectangles()), 1.25 * static_cast<double>(texels.count())) << "the other rests";
  const std::array<MovedCaster, 2> both{moved(2, 3.1, 3.2), moved(1, 0.2, 0.3)};
  ASSERT_TRUE(shapes.find(map, {}, both));
  texels = covered(both);
  EXPECT_EQ(texels.missing(shapes.rectangles()), 0u);
}

TEST(DirtyShapes, parts_and_bounds_stand_for_triangles) {
  const Mesh mesh = figure();
  const ShadowMap map = spot_map();
  MovedCaster moved{0, mesh.posed(walking(0.0)), mesh.posed(walking(0.1))};
  Texels covered(map.width, map.height);
  cover(covered, map, moved.from, mesh);
  cover(covered, map, moved.to, mesh);
  DirtyShapes by_triangles;
  ASSERT_TRUE(by_triangles.find(map, {}, {&moved, 1}));
  std::vector<Box> parts;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    Box& part = parts.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) part.extend(glm::dvec3(mesh.positions[mesh.indices[i + k]]));
  }
  for (CasterShape* shape : {&moved.from, &moved.to}) {
    shape->indices = {};
    shape->parts = parts;
  }
  DirtyShapes by_parts;
  ASSERT_TRUE(by_parts.find(map, {}, {&moved, 1}));
  EXPECT_EQ(covered.missing(by_parts.rectangles()), 0u);
  EXPECT_GE(area(by_parts.rectangles()), 0.95 * area(by_triangles.rectangles()));
  moved.from.parts = moved.to.parts = {};
  DirtyShapes by_bounds;
  ASSERT_TRUE(by_bounds.find(map, {}, {&moved, 1}));
  EXPECT_EQ(covered.missing(by_bounds.rectangles()), 0u);
  EXPECT_GT(area(by_bounds.rectangles()), area(by_parts.rectangles()));
  // So many that only some are projected one by one.
  const std::vector<Box> many(DirtyShapes::kMaxParts + 1, parts.front());
  moved.from.parts = moved.to.parts = many;
  ASSERT_TRUE(by_bounds.find(map, {}, {&moved, 1}));
  EXPECT_EQ(covered.missing(by_bounds.rectangles()), 0u);
}

TEST(DirtyShapes, what_is_behind_the_light_may_be_anywhere) {
  const Mesh mesh = figure();
  DirtyShapes shapes;
  const glm::dmat4 at_the_light = glm::translate(glm::dmat4(1.0), {6.0, 13.0, 9.0});
  const MovedCaster moved{0, mesh.posed(walking(0.0)), mesh.posed(at_the_light)};
  EXPECT_FALSE(shapes.find(spot_map(), {}, {&moved, 1}));
  EXPECT_TRUE(shapes.rectangles().empty());
  const Box named{{-1.0, 0.0, -1.0}, {1.0, 1.0, 1.0}};
  ASSERT_TRUE(shapes.find(sun_map(), {&named, 1}, {}));
  EXPECT_GT(area(shapes.rectangles()), 0.0);
  const Box nothing;
  ASSERT_TRUE(shapes.find(sun_map(), {&nothing, 1}, {}));
  EXPECT_TRUE(shapes.rectangles().empty());
}

}  // namespace
}  // namespace gnomon::render
