// A ground under a scene, and sections through it.
#include "gnomon/scene/edit.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "default_view_scenes.hpp"
#include "gnomon/scene/camera_path.hpp"

namespace gnomon::test {
namespace {

Scene scene_of(const std::string& name) {
  for (const ViewScene& one : default_view_scenes())
    if (one.name == name) return one.gltf.load();
  ADD_FAILURE() << "no scene " << name;
  return {};
}

// Ground.

TEST(Ground, is_not_added_to_a_scene_without_triangles) {
  Scene scene;
  add_ground(scene);
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_FALSE(has_ground(scene));
}

TEST(Ground, is_missed_where_nothing_lies_under_a_scene_and_then_no_more) {
  for (const auto& [name, grounded] : {std::pair{"prop", false},
                                       {"town", false},
                                       {"car", false},
                                       {"millimetres", true},
                                       {"town_on_plate", true},
                                       {"town_on_tiles", true},
                                       {"village_on_land", true},
                                       {"terrain", true},
                                       {"room", true}}) {
    Scene scene = scene_of(name);
    EXPECT_EQ(has_ground(scene), grounded) << name;
    add_ground(scene);
    EXPECT_TRUE(has_ground(scene)) << name;
  }
}

TEST(Ground, lies_right_below_the_scene_and_neither_casts_nor_moves_the_view_or_the_light) {
  for (const char* name : {"prop", "town", "town_on_earth"}) {
    SCOPED_TRACE(name);
    const Scene before = scene_of(name);
    Scene scene = before;
    edit({.ground = true, .sections = {}}, scene);
    ASSERT_EQ(scene.instances.size(), before.instances.size() + 1);
    const Instance& ground = scene.instances.back();
    EXPECT_FALSE(ground.casts);
    EXPECT_TRUE(ground.receives);
    EXPECT_EQ(scene.bounds_world, before.bounds_world);
    const double below = before.bounds_world.min.y - ground.bounds_world.max.y;
    EXPECT_GT(below, 0.0);
    EXPECT_LT(below, 1e-3 * (before.bounds_world.max.x - before.bounds_world.min.x));
    const CameraPath with = default_path(scene), without = default_path(before);
    ASSERT_EQ(with.keys.size(), without.keys.size());
    for (std::size_t i = 0; i < with.keys.size(); ++i)
      EXPECT_LT(glm::length(with.keys[i].position - without.keys[i].position), 1e-6);
  }
}

// Sections.

using Triangle = std::array<glm::dvec3, 3>;
std::vector<Triangle> triangles_of(const Scene& scene) {
  std::vector<Triangle> triangles;
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[instance.primitive];
    for (std::uint32_t k = 0; k < primitive.index_count; ++k) {
      if (k % 3 == 0) triangles.emplace_back();
      const glm::dvec3 at(scene.positions[scene.indices[primitive.first_index + k]]);
      triangles.back()[k % 3] = glm::dvec3(instance.world_from_object * glm::dvec4(at, 1.0));
    }
  }
  return triangles;
}
double area_of(const Triangle& t) {
  return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
}
double area_of(const Scene& scene) {
  double area = 0.0;
  for (const Triangle& triangle : triangles_of(scene)) area += area_of(triangle);
  return area;
}

/// Area of what of a triangle lies where dot(normal, p) <= distance, by hand: the whole less the cut corner.
double area_kept(Triangle t, const SectionPlane& plane) {
  const auto value = [&](const glm::dvec3& p) { return glm::dot(plane.normal, p) - plane.distance; };
  for (int turn = 0; turn < 3; ++turn) {
    const double a = value(t[0]), b = value(t[1]), c = value(t[2]);
    if (a <= 0.0 && b <= 0.0 && c <= 0.0) return area_of(t);
    if (a > 0.0 && b > 0.0 && c > 0.0) return 0.0;
    if (a > 0.0 && b <= 0.0 && c <= 0.0) return area_of(t) * (1.0 - a / (a - b) * (a / (a - c)));
    if (a <= 0.0 && b > 0.0 && c > 0.0) return area_of(t) * (a / (a - b)) * (a / (a - c));
    t = {t[1], t[2], t[0]};
  }
  return 0.0;
}

TEST(Section, a_plane_that_is_none_or_misses_changes_nothing) {
  const Scene before = scene_of("town");
  Scene scene = before;
  const double inf = std::numeric_limits<double>::infinity();
  cut_by(
      std::vector<SectionPlane>{
          {{0, 0, 0}, 1}, {{0, inf, 0}, 1}, {{0, 1, 0}, std::nan("")}, {{0, 1, 0}, 1e9}},
      scene);
  EXPECT_EQ(scene.indices, before.indices);
  EXPECT_EQ(scene.instances.size(), before.instances.size());
  cut_by(std::vector<SectionPlane>{{{0, 1, 0}, -1e9}}, scene);
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_TRUE(scene.bounds_world.empty());
}

TEST(Section, of_one_triangle_is_what_one_cuts_by_hand) {
  Scene scene = one_triangle().load();
  cut_by(std::vector<SectionPlane>{{{2, 0, 0}, 0.5}}, scene);  // x <= 1/4
  const std::vector<Triangle> left = triangles_of(scene);
  ASSERT_EQ(left.size(), 2u);
  EXPECT_NEAR(area_of(scene), 0.5 - 0.5 * 0.75 * 0.75, 1e-7);
  EXPECT_EQ(scene.bounds_world.max.x, 0.25);
  EXPECT_EQ(scene.bounds_world.max.y, 1.0);
  for (const glm::vec3& normal : scene.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.positions.size(), scene.normals.size());
  EXPECT_EQ(scene.positions.size(), scene.texcoords.size());
}

TEST(Section, keeps_exactly_the_area_on_its_side_and_both_sides_make_the_whole) {
  for (const char* name : {"town", "car", "tunnel", "town_on_earth"})
    for (const glm::dvec3& normal :
         {glm::dvec3(0, 1, 0), glm::dvec3(1, 0.3, -0.7), glm::dvec3(-0.2, -1, 0.1)}) {
      SCOPED_TRACE(name);
      const Scene whole = scene_of(name);
      const glm::dvec3 size = whole.bounds_world.max - whole.bounds_world.min;
      const double extent = std::max({size.x, size.y, size.z});
      SectionPlane plane{normal, glm::dot(normal, whole.bounds_world.min + 0.4 * size)};
      Scene kept = whole, other = whole;
      cut_by({&plane, 1}, kept);
      double by_hand = 0.0;
      for (const Triangle& triangle : triangles_of(whole)) by_hand += area_kept(triangle, plane);
      // A vertex is rounded to single precision in its own space.
      const double rounding = 1e-6 * area_of(whole);
      EXPECT_GT(by_hand, 10.0 * rounding);
      EXPECT_NEAR(area_of(kept), by_hand, rounding);
      for (const Triangle& triangle : triangles_of(kept))
        for (const glm::dvec3& corner : triangle)
          EXPECT_LE(glm::dot(normal, corner) - plane.distance, 1e-6 * extent * glm::length(normal));
      const SectionPlane turned{-plane.normal, -plane.distance};
      cut_by({&turned, 1}, other);
      EXPECT_NEAR(area_of(kept) + area_of(other), area_of(whole), 2.0 * rounding);
    }
}

TEST(Section, cuts_an_edge_that_triangles_share_once) {
  TestGltf gltf;
  const int corners = gltf.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  const int normals = gltf.positions({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  const int indices =
      gltf.accessor(gltf.view(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}), kUnsignedShort, "SCALAR", 6);
  gltf.show({{"attributes", {{"POSITION", corners}, {"NORMAL", normals}}}, {"indices", indices}});
  Scene scene = gltf.load();
  ASSERT_EQ(scene.positions.size(), 4u);
  cut_by(std::vector<SectionPlane>{{{1, 0, 0}, 0.5}}, scene);
  // Two sides of the square, and the diagonal.
  EXPECT_EQ(scene.positions.size(), 7u);
  EXPECT_NEAR(area_of(scene), 0.5, 1e-7);
}

TEST(Section, of_a_scene_that_plays_rests_with_a_warning) {
  Scene scene = scene_of("prop");
  scene.motion.animations.emplace_back();
  cut_by(std::vector<SectionPlane>{{{0, 1, 0}, 0.2}}, scene);
  EXPECT_TRUE(scene.motion.animations.empty());
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("at rest"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::test
