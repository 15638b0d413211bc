// The scenes built in code are sound: closed where solid, wound outwards, bounded as said, the same at every
// call.
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/caster_work.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/scene/translucent.hpp"
#include "gtest/gtest.h"

namespace gnomon::test {
namespace {

class Builtin : public ::testing::TestWithParam<std::string> {
 protected:
  // Loaded once: every check reads the same scene.
  static const Scene& scene() {
    static std::map<std::string, Scene> scenes;
    const auto [it, is_new] = scenes.try_emplace(GetParam());
    if (is_new) it->second = load_builtin(GetParam());
    return it->second;
  }
};

// Surfaces that are sheets and not solids.
bool is_sheet(const Scene& scene, const Primitive& primitive) {
  static const std::set<std::string> kSheets{"grass", "meadow", "concrete", "asphalt"};
  const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
  return kSheets.contains(material.name) || material.alpha_mode == AlphaMode::mask ||
         is_translucent(material);
}

TEST_P(Builtin, loads_without_a_warning_and_lies_on_the_ground) {
  EXPECT_EQ(scene().name, "builtin:" + GetParam());
  EXPECT_TRUE(scene().warnings.empty()) << scene().warnings.front();
  EXPECT_GT(scene().instances.size(), 64u) << "a ground of tiles and things on it";
  EXPECT_GT(scene().bounds_world.max.y, 2.0);
  EXPECT_GT(scene().bounds_world.min.y, -12.0);
}

TEST_P(Builtin, indices_normals_and_materials_are_valid) {
  const Scene& s = scene();
  ASSERT_EQ(s.positions.size(), s.normals.size());
  ASSERT_EQ(s.positions.size(), s.texcoords.size());
  for (const std::uint32_t i : s.indices) ASSERT_LT(i, s.positions.size());
  constexpr float kUnit = 1e-5f;  // rounding of a float normal
  for (const glm::vec3& n : s.normals) ASSERT_NEAR(glm::length(n), 1.0f, kUnit);
  for (const Primitive& p : s.primitives) {
    ASSERT_LE(static_cast<std::size_t>(p.first_index) + p.index_count, s.indices.size());
    ASSERT_LT(static_cast<std::size_t>(p.material), s.materials.size());
  }
}

TEST_P(Builtin, every_triangle_has_area_and_is_wound_to_the_side_its_normals_point_to) {
  const Scene& s = scene();
  for (std::size_t i = 0; i < s.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return glm::dvec3(s.positions[s.indices[i + k]]); };
    const glm::dvec3 area = glm::cross(at(1) - at(0), at(2) - at(0));
    ASSERT_GT(glm::length(area), 0.0) << "triangle " << i / 3;
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_GT(glm::dot(glm::normalize(area), glm::dvec3(s.normals[s.indices[i + k]])), 0.3)
          << "triangle " << i / 3;
    }
  }
}

TEST_P(Builtin, solids_are_closed_every_edge_is_met_by_its_opposite) {
  const Scene& s = scene();
  using Point = std::array<float, 3>;
  std::size_t solids = 0;
  for (const Primitive& p : s.primitives) {
    if (is_sheet(s, p)) continue;
    ++solids;
    std::map<std::pair<Point, Point>, int> open;
    for (std::size_t i = p.first_index; i < p.first_index + std::size_t{p.index_count}; i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3 a = s.positions[s.indices[i + k]], b = s.positions[s.indices[i + (k + 1) % 3]];
        const Point from{a.x, a.y, a.z}, to{b.x, b.y, b.z};
        ++open[{from, to}];
        --open[{to, from}];
      }
    }
    for (const auto& [edge, count] : open) {
      ASSERT_EQ(count, 0) << s.materials[static_cast<std::size_t>(p.material)].name << " at " << edge.first[0]
                          << " " << edge.first[1] << " " << edge.first[2];
    }
  }
  EXPECT_GT(solids, 1u);
}

TEST_P(Builtin, solids_have_volume_inside_and_not_outside) {
  const Scene& s = scene();
  for (const Primitive& p : s.primitives) {
    if (is_sheet(s, p)) continue;
    double six_volumes = 0.0;
    for (std::size_t i = p.first_index; i < p.first_index + std::size_t{p.index_count}; i += 3) {
      const auto at = [&](std::size_t k) { return glm::dvec3(s.positions[s.indices[i + k]]); };
      six_volumes += glm::dot(at(0), glm::cross(at(1), at(2)));
    }
    EXPECT_GT(six_volumes, 0.0) << s.materials[static_cast<std::size_t>(p.material)].name;
  }
}

TEST_P(Builtin, bounds_are_those_of_the_vertices) {
  const Scene& s = scene();
  Box all;
  for (const Instance& instance : s.instances) {
    const Primitive& p = s.primitives[instance.primitive];
    Box box;
    for (std::size_t i = p.first_index; i < p.first_index + std::size_t{p.index_count}; ++i) {
      box.extend(
          glm::dvec3(instance.world_from_object * glm::dvec4(glm::dvec3(s.positions[s.indices[i]]), 1.0)));
    }
    ASSERT_EQ(box.min, instance.bounds_world.min);
    ASSERT_EQ(box.max, instance.bounds_world.max);
    ASSERT_FALSE(instance.mirrored);
    all.extend(box);
  }
  EXPECT_EQ(all.min, s.bounds_world.min);
  EXPECT_EQ(all.max, s.bounds_world.max);
}

TEST_P(Builtin, the_same_bytes_come_out_of_every_call) {
  const std::hash<std::string> hash;
  const std::string first = build_glb(GetParam());
  EXPECT_GT(first.size(), 10'000u);
  EXPECT_EQ(hash(first), hash(build_glb(GetParam())));
}

bool holds(const Box& box, const glm::dvec3& p) {
  return p.x > box.min.x && p.y > box.min.y && p.z > box.min.z && p.x < box.max.x && p.y < box.max.y &&
         p.z < box.max.z;
}

// Crossings of the ray from `p` in direction `d` with a solid: odd inside. Moeller and Trumbore 1997.
bool is_inside(const Scene& s, const Instance& instance, const glm::dvec3& p) {
  const Primitive& primitive = s.primitives[instance.primitive];
  const glm::dvec3 d = glm::normalize(glm::dvec3(0.231, 0.941, 0.183));  // along no face of any scene
  int crossings = 0;
  for (std::size_t i = primitive.first_index; i < primitive.first_index + std::size_t{primitive.index_count};
       i += 3) {
    glm::dvec3 c[3];
    for (std::size_t k = 0; k < 3; ++k) {
      c[k] =
          glm::dvec3(instance.world_from_object * glm::dvec4(glm::dvec3(s.positions[s.indices[i + k]]), 1.0));
    }
    const glm::dvec3 e1 = c[1] - c[0], e2 = c[2] - c[0], h = glm::cross(d, e2), q = glm::cross(p - c[0], e1);
    const double det = glm::dot(e1, h);
    if (det == 0.0) continue;
    const double u = glm::dot(p - c[0], h) / det, v = glm::dot(d, q) / det, t = glm::dot(e2, q) / det;
    crossings += u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 ? 1 : 0;
  }
  return crossings % 2 == 1;
}

TEST_P(Builtin, the_default_flight_stays_above_ground_and_out_of_solids) {
  const Scene& s = scene();
  const CameraPath path = default_path(s);
  ASSERT_GE(path.keys.size(), 5u);
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps; ++i) {
    const Camera camera = path.at(static_cast<double>(i) / kSteps, 160, 90);
    ASSERT_GT(camera.position.y, 0.5) << "at step " << i;
    for (const Instance& instance : s.instances) {
      if (!holds(instance.bounds_world, camera.position) || is_sheet(s, s.primitives[instance.primitive]))
        continue;
      ASSERT_FALSE(is_inside(s, instance, camera.position)) << "at step " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Builtin,
                         ::testing::Values("city", "fence", "hangar", "room", "street", "terrain", "trees"),
                         [](const auto& param) { return param.param; });

TEST(BuiltinScenes, the_list_names_each_once_and_each_loads_by_its_name) {
  std::set<std::string_view> names;
  for (const BuiltinScene& scene : builtin_scenes()) {
    EXPECT_FALSE(scene.summary.empty());
    names.insert(scene.name);
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"city", "fence", "glass", "hangar", "room", "street",
                                               "terrain", "trees"}));
  EXPECT_THROW((void)build_glb("nowhere"), SceneError);
  EXPECT_THROW((void)build_glb(""), SceneError);
}

TEST(BuiltinScenes, the_city_has_two_hundred_thousand_triangles_of_few_meshes_on_two_kilometres) {
  const Scene city = load_builtin("city");
  EXPECT_GE(city.triangle_count(), 200'000u);
  EXPECT_LT(city.indices.size() / 3, city.triangle_count() / 20) << "instances share their meshes";
  EXPECT_NEAR(city.bounds_world.max.x - city.bounds_world.min.x, 2000.0, 1.0);
}

TEST(BuiltinScenes, the_leaves_are_cut_out_by_a_picture_with_holes) {
  const Scene trees = load_builtin("trees");
  ASSERT_EQ(trees.images.size(), 1u);
  std::size_t holes = 0;
  for (std::size_t i = 3; i < trees.images[0].rgba.size(); i += 4)
    holes += trees.images[0].rgba[i] < 128 ? 1u : 0u;
  const double part = static_cast<double>(holes) / (static_cast<double>(trees.images[0].rgba.size()) / 4.0);
  EXPECT_GT(part, 0.2);
  EXPECT_LT(part, 0.9);
  std::size_t cut = 0;
  for (const Primitive& p : trees.primitives) {
    const Material& m = trees.materials[static_cast<std::size_t>(p.material)];
    cut += m.alpha_mode == AlphaMode::mask && m.base_color_image == 0 && m.double_sided ? 1u : 0u;
  }
  EXPECT_EQ(cut, 4u) << "one crown per kind of tree";
}

TEST(BuiltinScenes, the_work_of_casters_is_that_of_their_meshes_and_crowns_are_tested) {
  const Scene trees = load_builtin("trees");
  const std::vector<CasterWork> work = caster_work(trees);
  ASSERT_EQ(work.size(), trees.instances.size());
  std::size_t triangles = 0, tested = 0, crowns = 0;
  for (std::size_t i = 0; i < work.size(); ++i) {
    triangles += work[i].triangles;
    tested += work[i].alpha_tested ? 1u : 0u;
    const int material = trees.primitives[trees.instances[i].primitive].material;
    crowns += trees.materials[static_cast<std::size_t>(material)].base_color_image == 0 ? 1u : 0u;
  }
  EXPECT_EQ(triangles, trees.triangle_count());
  // A box has the area of its six sides.
  const Scene street = load_builtin("street");
  const std::vector<CasterWork> boxes = caster_work(street);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const glm::dvec3 side = street.instances[i].bounds_world.max - street.instances[i].bounds_world.min;
    if (boxes[i].triangles != 12) continue;
    EXPECT_NEAR(boxes[i].area_world, 2.0 * (side.x * side.y + side.y * side.z + side.z * side.x), 1e-3);
  }
  EXPECT_EQ(tested, crowns);
  EXPECT_GT(tested, 0u);
  EXPECT_LT(tested, work.size());
}

TEST(BuiltinScenes, the_terrain_is_a_kilometre_of_256_by_256_quads) {
  const Scene terrain = load_builtin("terrain");
  EXPECT_GE(terrain.triangle_count(), 2u * 256u * 256u);
  const glm::dvec3 size = terrain.bounds_world.max - terrain.bounds_world.min;
  EXPECT_NEAR(size.x, 1024.0, 20.0);
  EXPECT_GT(size.y, 30.0);
}

}  // namespace
}  // namespace gnomon::test
