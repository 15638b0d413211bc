// Does a look-up whose depths a search finds return what the shaders' comparison does?
#include "measure/traced_lookup.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace gnomon::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const BiasOptions kTiny{1e-9, 0.0, 0.0, 8.0};

/// From above over x and z in [-8, 8]: texels of one unit, texel 0, 0 at x = z = -8 but for the flip of ndc.
ShadowMap overhead() {
  ShadowMap map;
  map.clip_from_world = {{0.125, 0, 0, 0}, {0, 0, -0.125, 0}, {0, -0.125, 0, 0}, {0, 0, 0, 1}};
  map.light_world = {0, 1, 0, 0};
  map.width = map.height = 16;
  return map;
}

/// A plane through the origin, and above it what lies over `from_x` or beyond, at `height` over y = 0.
struct World {
  glm::dvec3 normal{0, 1, 0};
  double from_x = kInf, height = 5.0;
  mutable std::vector<glm::dvec3> asked = {};

  [[nodiscard]] OccluderSearch search() const noexcept {
    return {[](const void* scene, const glm::dvec3& point) noexcept {
              const World& world = *static_cast<const World*>(scene);
              world.asked.push_back(point);
              if (point.x >= world.from_x) return world.height - point.y;
              return -(world.normal.x * point.x + world.normal.z * point.z) / world.normal.y - point.y;
            },
            this};
  }
  [[nodiscard]] glm::dvec3 on_plane(double x, double z) const noexcept {
    return {x, -(normal.x * x + normal.z * z) / normal.y, z};
  }
};

World sloping(const glm::dvec3& normal) {
  World world;
  world.normal = glm::normalize(normal);
  return world;
}

/// Of one look-up alone.
double hard(const World& world, double x, double z, const BiasOptions& bias = kTiny) {
  const ShadowMap map = overhead();
  const OccluderSearch search = world.search();
  FoundOccluders found(search);
  const TracedLookup lookup(found, bias, map, map.light_world, world.on_plane(x, z), world.normal);
  EXPECT_TRUE(lookup.known());
  return lookup.hard();
}
double mean(const World& world, double x, double z, double half_side) {
  const ShadowMap map = overhead();
  const OccluderSearch search = world.search();
  FoundOccluders found(search);
  return TracedLookup(found, kTiny, map, map.light_world, world.on_plane(x, z), world.normal).mean(half_side);
}

TEST(TracedLookup, compares_the_middle_of_its_texel) {
  World world;
  world.from_x = 0.4;  // the middle of the texel from 0 to 1 is in the shadow, the one before is not
  EXPECT_EQ(hard(world, 0.1, 0.3), 0.0);
  EXPECT_EQ(hard(world, 0.9, 0.3), 0.0);
  EXPECT_EQ(hard(world, -0.1, 0.3), 1.0);
  world.from_x = 0.6;
  EXPECT_EQ(hard(world, 0.9, 0.3), 1.0);
  ASSERT_FALSE(world.asked.empty());
  EXPECT_NEAR(world.asked.back().x, 0.5, 1e-12);
  EXPECT_NEAR(world.asked.back().z, 0.5, 1e-12);
}

TEST(TracedLookup, follows_the_plane_as_far_as_the_shaders_do) {
  for (const double slope : {0.5, 7.0, 0.95 * kSteepestPlane}) {
    World world = sloping({slope, 1, 0.3 * slope});
    for (int i = 0; i < 200; ++i)
      EXPECT_EQ(hard(world, std::fmod(0.37 * i, 14.0) - 7.0, std::fmod(0.71 * i, 14.0) - 7.0), 1.0) << slope;
    EXPECT_NEAR(world.asked.back().y, world.on_plane(world.asked.back().x, world.asked.back().z).y,
                1e-9 * slope);
  }
  // Beyond that the plane is followed as if it were not steeper: acne on one side of each texel's middle.
  const World steep = sloping({3.0 * kSteepestPlane, 1, 0});
  EXPECT_EQ(hard(steep, -0.7, 0.5), 1.0);
  EXPECT_EQ(hard(steep, -0.3, 0.5), 0.0);
}

TEST(TracedLookup, lights_what_is_closer_than_the_bias) {
  World world;
  world.from_x = -kInf;
  for (const double height : {0.29, 0.31}) {
    world.height = height;
    EXPECT_EQ(hard(world, 0.1, 0.3, {0.3, 0.0, 0.0, 8.0}), height < 0.3 ? 1.0 : 0.0);
  }
  // At 45 degrees half a texel of slope is as long, and what the offset lifts comes to it.
  world = sloping({1, 1, 0});
  world.from_x = -kInf;
  for (const double height : {0.74, 0.76}) {
    world.height = height - 0.5;  // over the middle of the texel, whose plane is half a unit lower
    EXPECT_EQ(hard(world, 0.25, 0.5, {0.0, 0.5, 0.25, 8.0}), height < 0.75 ? 1.0 : 0.0) << height;
  }
}

TEST(TracedLookup, reads_where_the_offset_along_the_normal_leads) {
  World world = sloping({1, 1, 0});
  world.from_x = 1.0;
  world.height = 100.0;
  // By half a texel times sin(45) along the normal, a quarter of a unit of it along x.
  const BiasOptions offset{0.0, 0.0, 0.5, 8.0};
  EXPECT_EQ(hard(world, 0.74, 0.5, offset), 1.0);
  EXPECT_EQ(hard(world, 0.76, 0.5, offset), 0.0);
}

TEST(TracedLookup, averages_over_its_box) {
  World world;
  world.from_x = 1.0;
  EXPECT_NEAR(mean(world, 0.5, 0.5, 1.5), 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(mean(world, 0.25, 0.5, 1.5), 0.75, 1e-12);
  EXPECT_NEAR(mean(world, 0.75, 0.1, 0.5), 0.75, 1e-12);
  EXPECT_EQ(mean(world, -1.5, 0.5, 1.5), 1.0);
  EXPECT_EQ(mean(world, 3.5, 0.5, 1.5), 0.0);
  // Blocks of a wide box: within one of them.
  EXPECT_NEAR(mean(world, 1.5, 0.5, 6.0), 5.5 / 12.0, 2.0 / 12.0);
  EXPECT_EQ(mean(world, 0.5, 0.5, 1e-300), 1.0);
}

TEST(TracedLookup, searches_once_for_each_texel_of_each_map) {
  const World world;
  const ShadowMap first = overhead(), second = overhead();
  const OccluderSearch search = world.search();
  FoundOccluders found(search);
  for (int round = 0; round < 3; ++round) {
    for (const double x : {0.1, 0.5, 0.9, 1.1})
      EXPECT_EQ(
          TracedLookup(found, kTiny, first, first.light_world, world.on_plane(x, 0.5), world.normal).hard(),
          1.0);
  }
  EXPECT_EQ(world.asked.size(), 2u);
  (void)TracedLookup(found, kTiny, second, second.light_world, world.on_plane(0.1, 0.5), world.normal).hard();
  EXPECT_EQ(world.asked.size(), 3u);
}

TEST(TracedLookup, keeps_what_it_found_for_planes_of_other_heights) {
  // Over the same texel: under a roof, on it, and over it.
  World world;
  world.from_x = -kInf;
  const ShadowMap map = overhead();
  const OccluderSearch search = world.search();
  FoundOccluders found(search);
  const auto at = [&](double y) {
    return TracedLookup(found, kTiny, map, map.light_world, {0.1, y, 0.1}, {0, 1, 0}).hard();
  };
  EXPECT_EQ(at(0.0), 0.0);
  EXPECT_EQ(at(4.9), 0.0);
  EXPECT_EQ(at(5.0), 1.0);
  EXPECT_EQ(at(7.0), 1.0);
  EXPECT_EQ(world.asked.size(), 1u);
}

TEST(TracedLookup, of_a_local_light_goes_along_its_rays) {
  // A spot in the origin that looks down, and a floor below it: texels of a quarter there.
  ShadowMap map;
  map.clip_from_world = {{1, 0, 0, 0}, {0, 0, -1.02, -1}, {0, -1, 0, 0}, {0, 0, -0.2, 0}};
  map.light_world = {0, 0, 0, 1};
  map.width = map.height = 16;
  const OccluderSearch roof{[](const void*, const glm::dvec3& point) noexcept {
                              const double way = glm::length(point);  // to a roof half way
                              return point.x / -point.y > 0.5 ? 0.5 * way : 0.0;
                            },
                            nullptr};
  FoundOccluders found(roof);
  const auto at = [&](double x, double y) {
    const TracedLookup lookup(found, kTiny, map, map.light_world, {x, y, 0.1}, {0, 1, 0});
    EXPECT_TRUE(lookup.known());
    return lookup.hard();
  };
  // Texels of an eighth in tangents: the one from 0.5 has its middle in the shadow.
  EXPECT_EQ(at(2.0 * 0.49, -2.0), 1.0);
  EXPECT_EQ(at(2.0 * 0.51, -2.0), 0.0);
  EXPECT_EQ(at(2.0 * 0.55, -2.0), 0.0);
}

TEST(TracedLookup, knows_nothing_of_what_faces_away_or_a_broken_map) {
  const World world;
  const OccluderSearch search = world.search();
  FoundOccluders found(search);
  const ShadowMap map = overhead();
  ShadowMap flat = map, behind = map;
  flat.clip_from_world[2] = flat.clip_from_world[0];
  behind.clip_from_world[3][3] = -1.0;
  const auto known = [&](const ShadowMap& in, const glm::dvec3& point, const glm::dvec3& normal) {
    return TracedLookup(found, kTiny, in, in.light_world, point, normal).known();
  };
  EXPECT_TRUE(known(map, glm::dvec3(0.0), {0, 1, 0}));
  EXPECT_FALSE(known(map, glm::dvec3(0.0), {0, -1, 0}));
  EXPECT_FALSE(known(map, glm::dvec3(0.0), {1, 0, 0}));
  EXPECT_FALSE(known(map, glm::dvec3(0.0), glm::dvec3(kNan)));
  EXPECT_FALSE(known(map, glm::dvec3(kNan), {0, 1, 0}));
  EXPECT_FALSE(known(map, glm::dvec3(1e300, 0.0, 0.0), {0, 1, 0}));
  EXPECT_FALSE(known(flat, glm::dvec3(0.0), {0, 1, 0}));
  EXPECT_FALSE(known(behind, glm::dvec3(0.0), {0, 1, 0}));
  // A search without a result, or a broken one, finds no shadow.
  for (const double result : {-kInf, kNan}) {
    const OccluderSearch one{
        [](const void* scene, const glm::dvec3&) noexcept { return *static_cast<const double*>(scene); },
        &result};
    FoundOccluders nothing(one);
    EXPECT_EQ(TracedLookup(nothing, kTiny, map, map.light_world, glm::dvec3(0.0), {0, 1, 0}).hard(), 1.0);
  }
}

}  // namespace
}  // namespace gnomon::test
