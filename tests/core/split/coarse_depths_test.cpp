// Do coarse depths hold every depth that a camera sees, and keep off what is hidden?
#include "gnomon/view.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "gnomon/plan.hpp"

namespace gnomon {
namespace {

struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  CoarseMesh as;

  [[nodiscard]] CoarseMesh coarse() const {
    CoarseMesh mesh = as;
    mesh.positions = positions;
    mesh.indices = indices;
    return mesh;
  }
  void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    for (const glm::vec3& corner : {a, b, c}) {
      indices.push_back(static_cast<std::uint32_t>(positions.size()));
      positions.push_back(corner);
    }
  }
};

/// A square across the view at -z, which faces the camera at the origin.
Mesh wall(float depth, float half) {
  Mesh mesh;
  mesh.add({-half, -half, -depth}, {half, -half, -depth}, {half, half, -depth});
  mesh.add({-half, -half, -depth}, {half, half, -depth}, {-half, half, -depth});
  return mesh;
}

Camera camera_at_origin(int width = 64, int height = 64) {
  return perspective_camera({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}, 1.0, 1.0 * width / height,
                            0.1, 1000.0, width, height);
}

VisibleDepths depths_of(const Camera& camera, const std::vector<Mesh>& meshes,
                        std::span<const Box> boxes = {}) {
  std::vector<CoarseMesh> coarse;
  for (const Mesh& mesh : meshes) coarse.push_back(mesh.coarse());
  std::vector<CoarseTile> tiles(coarse_tile_count(camera));
  return coarse_depths(camera, coarse, boxes, tiles);
}

/// Nearest depth along the ray through a place of the image in pixels; 0: none.
double traced(const Camera& camera, const std::vector<Mesh>& meshes, double x, double y) {
  const CameraAxes axes = camera_axes(camera);
  const glm::dvec3 side = axes.right * (camera.left + (camera.right - camera.left) * x / camera.width) +
                          axes.up * (camera.bottom + (camera.top - camera.bottom) * y / camera.height);
  const glm::dvec3 from = camera.position + (camera.orthographic ? side : glm::dvec3(0.0));
  const glm::dvec3 along = camera.orthographic ? axes.forward : axes.forward + side;
  double nearest = 0.0;
  for (const Mesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      std::array<glm::dvec3, 3> corner;
      for (std::size_t k = 0; k < 3; ++k)
        corner[k] = glm::dvec3(mesh.as.world_from_object *
                               glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[i + k]]), 1.0));
      const glm::dvec3 a = corner[1] - corner[0], b = corner[2] - corner[0], normal = glm::cross(a, b);
      const double facing = glm::dot(normal, along);
      const bool front = (facing < 0.0) != mesh.as.mirrored;
      if (facing == 0.0 || !(front || mesh.as.double_sided)) continue;
      const double depth = glm::dot(normal, corner[0] - from) / facing;
      const glm::dvec3 at = from + along * depth - corner[0];
      const double area = glm::dot(normal, normal);
      const double u = glm::dot(glm::cross(at, b), normal) / area,
                   v = glm::dot(glm::cross(a, at), normal) / area;
      if (u < 0.0 || v < 0.0 || u + v > 1.0 || depth < camera.near_depth || depth > camera.far_depth)
        continue;
      if (nearest == 0.0 || depth < nearest) nearest = depth;
    }
  }
  return nearest;
}

bool holds(const VisibleDepths& depths, double depth) {
  return depth >= depths.min && depth <= depths.max &&
         depths.count[static_cast<std::size_t>(depth_bin(depth))] > 0;
}

TEST(CoarseDepths, nothing_to_see_or_no_memory_is_unknown) {
  const Camera camera = camera_at_origin();
  EXPECT_TRUE(depths_of(camera, {}).empty());
  std::vector<CoarseTile> few(coarse_tile_count(camera) - 1);
  const Mesh mesh = wall(10.0f, 100.0f);
  const std::array<CoarseMesh, 1> meshes{mesh.coarse()};
  EXPECT_TRUE(coarse_depths(camera, meshes, {}, few).empty());
  Camera none = camera;
  none.width = 0;
  EXPECT_EQ(coarse_tile_count(none), 0u);
  EXPECT_TRUE(depths_of(none, {mesh}).empty());
  Camera inside_out = camera;
  std::swap(inside_out.left, inside_out.right);
  EXPECT_TRUE(depths_of(inside_out, {mesh}).empty());
  // Behind the camera, before the near plane, beyond the far plane, beside the image.
  EXPECT_TRUE(depths_of(camera, {wall(-10.0f, 5.0f)}).empty());
  EXPECT_TRUE(depths_of(camera, {wall(0.05f, 5.0f)}).empty());
  EXPECT_TRUE(depths_of(camera, {wall(2000.0f, 5.0f)}).empty());
  Mesh beside = wall(10.0f, 1.0f);
  beside.as.world_from_object[3].x = 50.0;
  EXPECT_TRUE(depths_of(camera, {beside}).empty());
  Mesh broken = wall(10.0f, 5.0f);
  broken.positions[2] = glm::vec3(std::nanf(""));
  EXPECT_FALSE(depths_of(camera, {broken}).empty());  // its other triangle
}

TEST(CoarseDepths, a_wall_over_the_whole_image_hides_what_is_behind_it) {
  const Camera camera = camera_at_origin();
  const Box behind{{-5.0, -5.0, -300.0}, {5.0, 5.0, -200.0}};
  const VisibleDepths depths = depths_of(camera, {wall(400.0f, 500.0f), wall(10.0f, 100.0f)}, {{behind}});
  EXPECT_NEAR(depths.min, 10.0, 0.001);
  EXPECT_NEAR(depths.max, 10.0, 0.001);
  // In either order.
  EXPECT_NEAR(depths_of(camera, {wall(10.0f, 100.0f), wall(400.0f, 500.0f)}).max, 10.0, 0.001);
  EXPECT_GE(depths.count[static_cast<std::size_t>(depth_bin(10.0))], coarse_tile_count(camera));
}

TEST(CoarseDepths, holes_windows_and_back_faces_hide_nothing) {
  const Camera camera = camera_at_origin();
  const Mesh far_wall = wall(400.0f, 500.0f);
  for (const char* what : {"masked", "turned", "mirrored", "small"}) {
    Mesh near_wall = wall(10.0f, 100.0f);
    const std::string_view kind = what;
    if (kind == "masked") near_wall.as.occludes = false;
    if (kind == "turned") near_wall.as.world_from_object[0].x = -1.0;
    if (kind == "mirrored") near_wall.as.mirrored = true;
    if (kind == "small") near_wall = wall(10.0f, 4.0f);
    EXPECT_NEAR(depths_of(camera, {far_wall, near_wall}).max, 400.0, 0.01) << what;
  }
  Mesh turned = wall(10.0f, 100.0f);
  turned.as.world_from_object[0].x = -1.0;
  turned.as.double_sided = true;
  EXPECT_NEAR(depths_of(camera, {far_wall, turned}).max, 10.0, 0.001);
  turned.as.double_sided = false;
  turned.as.mirrored = true;
  EXPECT_NEAR(depths_of(camera, {far_wall, turned}).max, 10.0, 0.001);
}

TEST(CoarseDepths, a_wall_of_many_triangles_hides_as_one_of_two) {
  const Camera camera = camera_at_origin(150, 90);
  Mesh mosaic;
  // Strips of odd sizes that share their corners.
  constexpr int kSide = 23;
  const auto at = [](int x, int y) {
    return glm::vec3(-30.0f + 60.0f * std::pow(static_cast<float>(x) / kSide, 1.3f),
                     -30.0f + 60.0f * static_cast<float>(y) / kSide, -20.0f);
  };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      mosaic.add(at(x, y), at(x + 1, y), at(x + 1, y + 1));
      mosaic.add(at(x, y), at(x + 1, y + 1), at(x, y + 1));
    }
  }
  const VisibleDepths depths = depths_of(camera, {wall(400.0f, 500.0f), mosaic});
  EXPECT_NEAR(depths.max, 20.0, 0.001);
}

TEST(CoarseDepths, a_ground_counts_from_the_image_s_lower_edge_to_the_wall_on_it) {
  const Camera camera = camera_at_origin();
  Mesh ground;
  ground.add({-900.0f, -2.0f, 50.0f}, {900.0f, -2.0f, 50.0f}, {900.0f, -2.0f, -900.0f});
  ground.add({-900.0f, -2.0f, 50.0f}, {900.0f, -2.0f, -900.0f}, {-900.0f, -2.0f, -900.0f});
  const double nearest = 2.0 / std::tan(0.5);
  const VisibleDepths open = depths_of(camera, {ground});
  EXPECT_NEAR(open.min, nearest, 0.02 * nearest);
  EXPECT_NEAR(open.max, 900.0, 1.0);
  // The wall stands on the ground at 40: the tile that its foot is in, and those round it, show more.
  const VisibleDepths closed = depths_of(camera, {ground, wall(40.0f, 60.0f)});
  EXPECT_NEAR(closed.min, nearest, 0.02 * nearest);
  EXPECT_GE(closed.max, 40.0);
  EXPECT_LT(closed.max, 41.0);
}

TEST(CoarseDepths, a_box_counts_from_end_to_end_as_far_as_it_shows) {
  const Camera camera = camera_at_origin();
  const Box box{{-3.0, -3.0, -80.0}, {3.0, 3.0, -20.0}};
  VisibleDepths depths = depths_of(camera, {}, {{box}});
  EXPECT_NEAR(depths.min, 20.0, 0.001);
  EXPECT_NEAR(depths.max, 80.0, 0.01);
  depths = depths_of(camera, {wall(50.0f, 100.0f)}, {{box}});
  EXPECT_NEAR(depths.min, 20.0, 0.001);
  EXPECT_NEAR(depths.max, 50.0, 0.01);
  // Round the eye.
  const Box round{{-3.0, -3.0, -80.0}, {3.0, 3.0, 20.0}};
  depths = depths_of(camera, {}, {{round}});
  EXPECT_DOUBLE_EQ(depths.min, camera.near_depth);
  EXPECT_NEAR(depths.max, 80.0, 0.01);
}

/// Boxes of triangles, floors and slivers, some with holes for the occluder, some turned.
std::vector<Mesh> random_meshes(std::mt19937& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<Mesh> meshes;
  for (int n = 0; n < 12; ++n) {
    Mesh mesh;
    const glm::dvec3 middle(uniform(-30, 30), uniform(-15, 15), uniform(-120, 10));
    const double size = std::exp(uniform(-1.0, 4.0));
    const int triangles = 1 + static_cast<int>(uniform(0, 6));
    for (int t = 0; t < triangles; ++t) {
      const auto corner = [&] {
        return glm::vec3(middle + size * glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
      };
      mesh.add(corner(), corner(), corner());
    }
    mesh.as.double_sided = uniform(0, 1) < 0.5;
    mesh.as.mirrored = uniform(0, 1) < 0.2;
    mesh.as.occludes = uniform(0, 1) < 0.8;
    mesh.as.world_from_object[3] = glm::dvec4(uniform(-5, 5), uniform(-5, 5), uniform(-5, 5), 1.0);
    meshes.push_back(mesh);
  }
  // Half of them with a wall behind everything that something may hide.
  if (uniform(0, 1) < 0.5) meshes.push_back(wall(150.0f, 90.0f));
  return meshes;
}

TEST(CoarseDepths, every_depth_that_a_ray_finds_is_held) {
  constexpr int kScenes = 300, kSamples = 1500;
  std::mt19937 random(7);
  std::size_t seen = 0, sky = 0;
  double widths = 0.0, widths_of_all = 0.0;
  for (int n = 0; n < kScenes; ++n) {
    Camera camera = camera_at_origin(97, 61);
    if (n % 4 == 3)
      camera = orthographic_camera({0.0, 0.0, 0.0}, {0.0, 0.1, -1.0}, {0.0, 1.0, 0.0}, 40.0, 1.6, 0.5, 300.0,
                                   97, 61);
    const std::vector<Mesh> meshes = random_meshes(random);
    const VisibleDepths depths = depths_of(camera, meshes);
    double low = 1e300, high = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      // Pixel centres, and where else a renderer may sample.
      const bool centre = i % 2 == 0;
      double x = std::uniform_real_distribution<double>(0.0, camera.width)(random),
             y = std::uniform_real_distribution<double>(0.0, camera.height)(random);
      if (centre) x = std::floor(x) + 0.5, y = std::floor(y) + 0.5;
      const double depth = traced(camera, meshes, x, y);
      ++(depth > 0.0 ? seen : sky);
      if (depth == 0.0) continue;
      ASSERT_TRUE(holds(depths, depth)) << "scene " << n << ", " << x << " " << y << ": " << depth
                                        << ", held " << depths.min << " to " << depths.max;
      low = std::min(low, depth);
      high = std::max(high, depth);
    }
    if (!(low < high)) continue;
    widths += std::log(depths.max / depths.min);
    widths_of_all += std::log(high / low);
  }
  EXPECT_GT(seen, 100'000u);
  EXPECT_GT(sky, 10'000u);
  // Not by holding everything.
  EXPECT_LT(widths, 1.5 * widths_of_all);
}

TEST(CoarseDepths, plans_cover_them_alone) {
  const Camera camera = camera_at_origin();
  const VisibleDepths depths = depths_of(camera, {wall(40.0f, 100.0f), wall(10.0f, 4.0f)});
  const Box boxes[] = {{{-100.0, -100.0, -900.0}, {100.0, 100.0, -1.0}}};
  PlanOptions options;
  options.cascades = 2;
  const ShadowPlan plan =
      make_plan({camera, &depths}, DirectionalLight{{0.3, -1.0, 0.2}}, {boxes, boxes}, options);
  ASSERT_GT(plan.map_count, 0);
  EXPECT_GT(plan.map[0].depth_begin, 9.0);
  EXPECT_LT(plan.map[static_cast<std::size_t>(plan.map_count - 1)].depth_end, 42.0);
}

}  // namespace
}  // namespace gnomon
