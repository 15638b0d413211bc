// The light of a scene that brings none stands where it is said to.
#include "gnomon/scene/default_light.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace gnomon::test {
namespace {

constexpr Box kScene{{-10.0, 0.0, -20.0}, {10.0, 6.0, 20.0}};
constexpr double kLongest = 40.0;

TEST(DefaultLight, is_found_by_its_name_and_no_other) {
  LightKind kind = LightKind::point;
  for (const LightKind known : {LightKind::sun, LightKind::spot, LightKind::point}) {
    ASSERT_TRUE(light_kind_from_name(to_string(known), kind));
    EXPECT_EQ(kind, known);
  }
  EXPECT_FALSE(light_kind_from_name("Sun", kind));
  EXPECT_EQ(kind, LightKind::point);
}

TEST(DefaultLight, sun_over_plus_x_shines_towards_minus_x_and_down) {
  const Light light = default_light({LightKind::sun, 30.0, 90.0}, kScene);
  const glm::dvec3 direction = std::get<DirectionalLight>(light).direction;
  EXPECT_LT(glm::distance(direction, glm::dvec3(-std::sqrt(0.75), -0.5, 0.0)), 1e-12);
}

TEST(DefaultLight, spot_looks_at_the_middle_of_the_scene_and_reaches_it) {
  const auto light = std::get<SpotLight>(default_light({LightKind::spot, 38.0, 140.0}, kScene));
  const glm::dvec3 middle{0.0, 3.0, 0.0}, way = middle - light.position;
  EXPECT_NEAR(glm::length(way), 0.6 * kLongest, 1e-9);
  EXPECT_NEAR(glm::dot(glm::normalize(way), light.direction), 1.0, 1e-12);
  EXPECT_GT(light.range, glm::length(way));
}

TEST(DefaultLight, point_light_hangs_inside_the_scene) {
  const auto light = std::get<PointLight>(default_light({LightKind::point, 38.0, 140.0}, kScene));
  EXPECT_LT(glm::distance(light.position, glm::dvec3(0.0, 4.8, 0.0)), 1e-12);
  EXPECT_DOUBLE_EQ(light.range, 0.75 * kLongest);
}

TEST(DefaultLight, local_lights_are_even_over_the_ground_and_reach_each_part_of_it) {
  EXPECT_TRUE(local_lights(0, kScene).empty());
  const std::vector<Light> lights = local_lights(9, kScene);
  ASSERT_EQ(lights.size(), 9u);
  int spots = 0;
  double least_apart = 1e9;
  std::vector<glm::dvec3> places;
  for (const Light& light : lights) {
    const auto* const spot = std::get_if<SpotLight>(&light);
    spots += spot != nullptr ? 1 : 0;
    const glm::dvec3 at = spot != nullptr ? spot->position : std::get<PointLight>(light).position;
    EXPECT_TRUE(at.x >= kScene.min.x && at.x <= kScene.max.x && at.z >= kScene.min.z && at.z <= kScene.max.z);
    for (const glm::dvec3& other : places)
      least_apart = std::min(least_apart, glm::length(glm::dvec2(at.x - other.x, at.z - other.z)));
    places.push_back(at);
  }
  EXPECT_EQ(spots, 3);
  EXPECT_TRUE(std::holds_alternative<SpotLight>(lights.front()));
  const glm::dvec3 size = kScene.max - kScene.min;
  EXPECT_GT(least_apart, 0.25 * std::sqrt(size.x * size.z / 9)) << "no two in one place";
}

TEST(DefaultLight, a_covering_range_reaches_every_corner_from_the_light) {
  for (const glm::dvec3& from : {glm::dvec3(0.0), glm::dvec3(1e4, 0.0, 0.0), kScene.max}) {
    const double range = covering_range(from, kScene);
    for (const glm::dvec3& corner : {kScene.min, kScene.max}) EXPECT_GT(range, glm::distance(from, corner));
  }
  EXPECT_EQ(covering_range({3, 4, 5}, {}), 1.0) << "nothing to reach";
}

}  // namespace
}  // namespace gnomon::test
