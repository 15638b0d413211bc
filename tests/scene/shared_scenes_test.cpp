// Real scenes and the glTF asset generator's files mean what their makers say.
#include <map>

#include "gnomon/scene/load.hpp"
#include "gtest/gtest.h"
#include "shared_files.hpp"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

Scene load_generated(const std::string& folder, int number) {
  char name[80];
  std::snprintf(name, sizeof name, "%s_%02d.gltf", folder.c_str(), number);
  return load_gltf(shared_folder() / "gltf-robustness/asset-generator" / folder / name);
}

bool is_absent(const char* folder) {
  return !fs::exists(shared_folder() / folder);
}

struct Expected {
  const char* file;
  std::uint64_t triangles;
  std::size_t images;
};

TEST(SharedScenes, real_scenes_load_whole_with_their_pictures) {
  if (is_absent("scenes")) GTEST_SKIP() << "no shared/scenes";
  // Triangles and base colour pictures as counted in the files themselves, by mode and indices.
  const std::vector<Expected> scenes{{"church/scene.gltf", 40046, 1},
                                     {"dutch_ship/dutch_ship_medium_1k.gltf", 69162, 3},
                                     {"zdm2_level/zdm2.glb", 58772, 0},
                                     {"low_poly_city/scene.gltf", 14105, 0},
                                     {"low_poly_forest/scene.gltf", 22302, 0},
                                     {"flight_helmet/FlightHelmet.gltf", 94722, 5},
                                     {"occlusion_room/room.glb", 63720, 0},
                                     {"robot_expressive/RobotExpressive.glb", 3237, 0},
                                     {"fox/Fox.glb", 576, 1},
                                     {"terrain/terrain.glb", 31422, 1}};
  int there = 0;
  for (const Expected& expected : scenes) {
    SCOPED_TRACE(expected.file);
    if (!fs::exists(shared_folder() / "scenes" / expected.file)) continue;
    ++there;
    const Scene scene = load_gltf(shared_folder() / "scenes" / expected.file);
    EXPECT_EQ(scene.triangle_count(), expected.triangles);
    EXPECT_EQ(scene.images.size(), expected.images);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    EXPECT_FALSE(scene.bounds_world.empty());
  }
  EXPECT_GT(there, 0);
}

TEST(SharedScenes, every_scene_there_loads_with_triangles_and_no_warning) {
  const auto files = gltf_files(shared_folder() / "scenes");
  if (files.empty()) GTEST_SKIP() << "no shared/scenes";
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    const Scene scene = load_gltf(file);
    EXPECT_GT(scene.triangle_count(), 0u);
    EXPECT_TRUE(scene.warnings.empty());
    for (const std::uint32_t i : scene.indices) ASSERT_LT(i, scene.positions.size());
  }
}

TEST(AssetGenerator, every_primitive_mode_of_the_same_square_gives_the_same_triangles) {
  if (is_absent("gltf-robustness/asset-generator")) GTEST_SKIP() << "no shared/gltf-robustness";
  for (const int points_or_lines : {0, 1, 2, 3, 7, 8, 9, 10}) {
    const Scene scene = load_generated("Mesh_PrimitiveMode", points_or_lines);
    EXPECT_EQ(scene.triangle_count() % (points_or_lines == 0 || points_or_lines == 7 ? 8 : 12), 0u);
    EXPECT_GT(scene.triangle_count(), 0u) << points_or_lines;
    EXPECT_EQ(scene.warnings.size(), 1u) << points_or_lines;
  }
  const Scene first = load_generated("Mesh_PrimitiveMode", 4);
  for (const int triangles : {4, 5, 6, 11, 12, 13, 14, 15}) {
    const Scene scene = load_generated("Mesh_PrimitiveMode", triangles);
    EXPECT_EQ(scene.triangle_count(), 2u) << triangles;
    EXPECT_EQ(scene.bounds_world.min, first.bounds_world.min) << triangles;
    EXPECT_EQ(scene.bounds_world.max, first.bounds_world.max) << triangles;
    for (const glm::vec3& n : scene.normals) EXPECT_EQ(n, glm::vec3(0, 0, 1)) << triangles;
  }
}

TEST(AssetGenerator, nodes_of_negative_scale_are_mirrored_where_the_signs_are_odd) {
  if (is_absent("gltf-robustness/asset-generator")) GTEST_SKIP() << "no shared/gltf-robustness";
  // From the folder's README: which axes are negative in model 00 to 12.
  const int negative_axes[13] = {0, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3};
  for (int i = 0; i < 13; ++i) {
    const Scene scene = load_generated("Node_NegativeScale", i);
    ASSERT_EQ(scene.instances.size(), 2u) << i;
    EXPECT_FALSE(scene.instances[0].mirrored) << i;
    EXPECT_EQ(scene.instances[1].mirrored, negative_axes[i] % 2 == 1) << i;
  }
}

TEST(AssetGenerator, interleaved_buffers_all_hold_the_same_square) {
  if (is_absent("gltf-robustness/asset-generator")) GTEST_SKIP() << "no shared/gltf-robustness";
  for (int i = 0; i < 5; ++i) {
    const Scene scene = load_generated("Buffer_Interleaved", i);
    EXPECT_EQ(scene.triangle_count(), 2u) << i;
    EXPECT_NEAR(scene.bounds_world.max.x - scene.bounds_world.min.x, 1.0, 1e-6) << i;
    glm::vec2 low(9.0f), high(-9.0f);
    for (const glm::vec2& uv : scene.texcoords) {
      low = {std::min(low.x, uv.x), std::min(low.y, uv.y)};
      high = {std::max(high.x, uv.x), std::max(high.y, uv.y)};
    }
    EXPECT_EQ(low, glm::vec2(0.0f)) << i;
    EXPECT_EQ(high, glm::vec2(1.0f)) << i;
  }
}

TEST(AssetGenerator, double_sided_materials_are_distinguished) {
  if (is_absent("gltf-robustness/asset-generator")) GTEST_SKIP() << "no shared/gltf-robustness";
  for (int i = 0; i < 4; ++i) {
    const Scene scene = load_generated("Material_DoubleSided", i);
    ASSERT_FALSE(scene.primitives.empty()) << i;
    for (const Primitive& p : scene.primitives) {
      EXPECT_TRUE(scene.materials[static_cast<std::size_t>(p.material)].double_sided) << i;
    }
  }
}

}  // namespace
}  // namespace gnomon::test
