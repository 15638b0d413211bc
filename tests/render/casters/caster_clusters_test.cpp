// Are large casters drawn in parts what they are when drawn whole?
#include "casters/caster_clusters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/pose.hpp"
#include "mask_frame.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

using Triangle = std::array<glm::vec3, 3>;

constexpr int kTiles = 48;

/// A bumpy sheet of kTiles x kTiles squares, -1..1 along x and z, its triangles along rows.
std::vector<Triangle> sheet() {
  const auto corner = [](int i, int k) {
    const float x = 2.0f * static_cast<float>(i) / kTiles - 1.0f,
                z = 2.0f * static_cast<float>(k) / kTiles - 1.0f;
    return glm::vec3(x, 0.05f * std::sin(9.0f * x) * std::cos(7.0f * z), z);
  };
  std::vector<Triangle> triangles;
  for (int k = 0; k < kTiles; ++k) {
    for (int i = 0; i < kTiles; ++i) {
      triangles.push_back({corner(i, k), corner(i, k + 1), corner(i + 1, k)});
      triangles.push_back({corner(i + 1, k), corner(i, k + 1), corner(i + 1, k + 1)});
    }
  }
  return triangles;
}

std::vector<Triangle> shuffled(std::vector<Triangle> triangles) {
  std::mt19937 random(7);
  for (std::size_t i = triangles.size() - 1; i > 0; --i)
    std::swap(triangles[i], triangles[random() % (i + 1)]);
  return triangles;
}

void add(Scene& scene, const std::vector<Triangle>& triangles, const glm::dmat4& world_from_object,
         bool mirrored = false) {
  std::vector<glm::vec3> corners;
  for (const Triangle& triangle : triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  add_mesh(scene, corners, world_from_object, 0, mirrored);
}

glm::dmat4 placed(const glm::dvec3& at, double size, double turned = 0.0) {
  return glm::scale(glm::rotate(glm::translate(glm::dmat4(1.0), at), turned, glm::dvec3(0.2, 1.0, 0.1)),
                    glm::dvec3(size));
}

/// Ground and sails that are larger than most maps, one of them in the file's order by chance, one mirrored.
Scene sails() {
  Scene scene = empty_scene();
  add(scene, shuffled(sheet()), placed({0, -1, 0}, 30.0));
  add(scene, sheet(), placed({3, 4, -4}, 6.0, 0.8));
  add(scene, shuffled(sheet()),
      placed({-4, 3, 2}, 5.0, -1.1) * glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1)), true);
  add_box(scene, {-1, -1, -1}, {1, 2, 1});
  return scene;
}

std::vector<Triangle> drawn_triangles(const Scene& scene, const CasterClusters& clusters,
                                      std::span<const IndexRun> runs) {
  std::vector<std::uint32_t> indices = scene.indices;
  indices.insert(indices.end(), clusters.sorted_indices().begin(), clusters.sorted_indices().end());
  std::vector<Triangle> triangles;
  for (const IndexRun& run : runs) {
    EXPECT_EQ(run.index_count % 3, 0u);
    for (std::uint32_t i = run.first_index; i < run.first_index + run.index_count; i += 3)
      triangles.push_back(
          {scene.positions[indices[i]], scene.positions[indices[i + 1]], scene.positions[indices[i + 2]]});
  }
  return triangles;
}

bool before(const Triangle& a, const Triangle& b) {
  for (std::size_t i = 0; i < 9; ++i) {
    const float x = a[i / 3][static_cast<int>(i % 3)], y = b[i / 3][static_cast<int>(i % 3)];
    if (x != y) return x < y;
  }
  return false;
}

TEST(CasterClusters, are_a_permutation_and_keep_every_triangle_that_no_plane_holds_out) {
  const Scene scene = sails();
  CasterClusters clusters(scene);
  // The shuffled sheets are worth a copy, the others are not.
  EXPECT_EQ(clusters.sorted_indices().size(), 2 * sheet().size() * 3);
  EXPECT_FALSE(clusters.has(3)) << "a box";
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  std::size_t kept = 0, all = 0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(clusters.has(i));
    const Instance& instance = scene.instances[i];
    std::vector<Triangle> whole =
        drawn_triangles(scene, clusters, clusters.within(i, instance.world_from_object, {}));
    std::vector<Triangle> expected = sheet();
    std::sort(whole.begin(), whole.end(), before);
    std::sort(expected.begin(), expected.end(), before);
    EXPECT_EQ(whole, expected);
    for (int trial = 0; trial < 50; ++trial) {
      std::vector<glm::dvec4> planes;
      const glm::dvec3 middle(instance.world_from_object * glm::dvec4(part(random), 0.0, part(random), 1.0));
      for (int k = 0; k < 4; ++k) {
        const glm::dvec3 normal = glm::normalize(glm::dvec3(part(random), part(random), part(random)));
        planes.emplace_back(normal, 0.2 * (1.0 + part(random)) - glm::dot(normal, middle));
      }
      std::vector<Triangle> some =
          drawn_triangles(scene, clusters, clusters.within(i, instance.world_from_object, planes));
      std::sort(some.begin(), some.end(), before);
      kept += some.size();
      all += expected.size();
      for (const Triangle& triangle : expected) {
        const bool out = std::any_of(planes.begin(), planes.end(), [&](const glm::dvec4& plane) {
          return std::all_of(triangle.begin(), triangle.end(), [&](const glm::vec3& corner) {
            return glm::dot(plane, instance.world_from_object * glm::dvec4(glm::dvec3(corner), 1.0)) < 0.0;
          });
        });
        EXPECT_TRUE(out || std::binary_search(some.begin(), some.end(), triangle, before));
      }
    }
  }
  EXPECT_LT(kept, all / 2);
}

TEST(CasterClusters, of_vertices_that_move_are_none) {
  const Scene scene = sails();
  CasterClusters clusters(scene);
  const auto one = static_cast<std::uint32_t>(3 * sheet().size());  // vertices of a sheet
  clusters.forget(one - 1, 1);
  EXPECT_FALSE(clusters.has(0));
  EXPECT_TRUE(clusters.has(1));
  clusters.forget(one + 5, 3 * one);
  EXPECT_FALSE(clusters.has(1));
  EXPECT_FALSE(clusters.has(2));
}

/// Draws frames with and without parts and counts what differs and what they saved.
struct Pair {
  explicit Pair(const Scene& of = sails()) : scene(of) {}
  Scene scene;
  Renderer parts{scene}, whole{scene};
  std::vector<Box> boxes = boxes_of(scene);
  std::size_t differing = 0, texels = 0;
  std::uint64_t saved = 0, triangles = 0;

  void compare(const FloatImage& a, const FloatImage& b) {
    ASSERT_EQ(a.values.size(), b.values.size());
    for (std::size_t i = 0; i < a.values.size(); ++i) differing += a.values[i] != b.values[i] ? 1 : 0;
    texels += a.values.size();
  }
  template <class Plan, class Prepare, class Depths>
  void draw(const Plan& plan, const Camera& camera, FrameOptions options, Prepare&& prepare,
            Depths&& depths) {
    options.time_passes = false;
    const FrameStats few = parts.draw(plan, camera, prepare(parts), options);
    options.prune = options.prune.without(PruneRule::caster_clusters);
    const FrameStats all = whole.draw(plan, camera, prepare(whole), options);
    const PruneSaving& saving = few.saved[static_cast<std::size_t>(PruneRule::caster_clusters)];
    std::uint64_t drawn = saving.triangles, of_all = 0;
    for (int i = 0; i < few.map_count; ++i) drawn += few.map[static_cast<std::size_t>(i)].triangles;
    for (int i = 0; i < all.map_count; ++i) of_all += all.map[static_cast<std::size_t>(i)].triangles;
    EXPECT_EQ(drawn, of_all);
    saved += saving.triangles;
    triangles += of_all;
    depths(parts, whole);
  }
};

Camera on_the_way(int frame) {
  return perspective_camera({0.3 * frame - 2.0, 1.0, 6.0}, {0.05 * frame, -0.15, -1.0}, {0, 1, 0}, 1.0, 1.0,
                            0.2, 40.0, 96, 96);
}

TEST(CasterClusters, draw_the_depths_of_whole_casters_into_maps_that_scroll_and_are_kept) {
  Pair pair;
  const std::array<Light, 3> lights{DirectionalLight{{0.4, -1, 0.3}},
                                    SpotLight{{0, 9, 3}, {0.1, -1, -0.2}, 0.9, 40.0},
                                    PointLight{{1, 5, 2}, 40.0}};
  for (const Fit fit : {Fit::tight, Fit::stable}) {
    for (const Light& light : lights) {
      for (int frame = 0; frame < 4; ++frame) {
        const Camera camera = on_the_way(frame);
        PlanOptions options;
        options.fit = fit;
        options.resolution.max_size = 256;
        options.clip_space = frame < 2 ? ClipSpace{} : kVulkan;
        FrameOptions draw_options;
        draw_options.prune = draw_options.prune.with(PruneRule::scrolled_maps);
        const ShadowPlan plan = make_plan(camera, light, {pair.boxes, pair.boxes}, options);
        ASSERT_GT(plan.map_count, 0);
        pair.draw(
            plan, camera, draw_options, [](Renderer& renderer) { return renderer.prepare(filters::pcf); },
            [&](Renderer& a, Renderer& b) {
              for (int map = 0; map < plan.map_count; ++map) pair.compare(a.depth_map(map), b.depth_map(map));
            });
      }
    }
  }
  EXPECT_EQ(pair.differing, 0u);
  EXPECT_GT(pair.texels, 1000000u);
  EXPECT_GT(pair.saved, pair.triangles / 5);
}

TEST(CasterClusters, follow_vertices_that_an_animation_moves) {
  Scene ground = empty_scene();
  add(ground, shuffled(sheet()), placed({0, -1, 0}, 30.0));
  add_box(ground, {-1, -1, -1}, {1, 2, 1});
  Pair pair(ground);
  const auto count = static_cast<std::uint32_t>(3 * sheet().size());
  Pose pose;
  pose.positions.assign(pair.scene.positions.begin(), pair.scene.positions.begin() + count);
  pose.normals.assign(pair.scene.normals.begin(), pair.scene.normals.begin() + count);
  // The halves change places.
  for (std::size_t i = 0; i < pose.positions.size(); i += 3) {
    const float by = pose.positions[i].x < 0.0f ? 1.0f : -1.0f;
    for (std::size_t k = i; k < i + 3; ++k) pose.positions[k].x += by;
  }
  pose.vertices.push_back({0, 0, 0, count, pair.scene.primitives[0].bounds});
  const Instance& at = pair.scene.instances[0];
  pose.instances.push_back({0, at.world_from_object, at.mirrored, at.bounds_world});
  ASSERT_TRUE(pair.parts.apply_pose(pose));
  ASSERT_TRUE(pair.whole.apply_pose(pose));
  for (int frame = 0; frame < 3; ++frame) {
    const Camera camera = on_the_way(frame);
    PlanOptions options;
    options.resolution.max_size = 256;
    const ShadowPlan plan =
        make_plan(camera, DirectionalLight{{0.4, -1, 0.3}}, {pair.boxes, pair.boxes}, options);
    pair.draw(
        plan, camera, FrameOptions{}, [](Renderer& renderer) { return renderer.prepare(filters::pcf); },
        [&](Renderer& a, Renderer& b) {
          for (int map = 0; map < plan.map_count; ++map) pair.compare(a.depth_map(map), b.depth_map(map));
        });
  }
  EXPECT_EQ(pair.differing, 0u);
  EXPECT_EQ(pair.saved, 0u) << "it has no parts any more";
}

TEST(CasterClusters, draw_the_depths_of_whole_casters_into_pages) {
  Pair pair;
  std::vector<std::byte> memory(page_memory(4096, 1 << 17));
  for (const Light& light :
       std::array<Light, 2>{DirectionalLight{{0.4, -1, 0.3}}, PointLight{{1, 5, 2}, 40.0}}) {
    for (int frame = 0; frame < 3; ++frame) {
      const Camera camera = on_the_way(frame);
      const Frame seen = render::draw(pair.parts, camera, ShadowPlan{}, filters::hard);
      std::vector<glm::dvec3> points;
      for (std::size_t i = 0; i < seen.pixels(); i += 3)
        if (seen.surface(i)) points.push_back(seen.point(i));
      PageOptions pages;
      pages.plan.fit = Fit::stable;
      set_margin(default_settings(filters::hard), pages.plan);
      pages.page_texels = 64;
      const PagePlan plan = plan_pages({.camera = camera, .points_world = points}, light,
                                       {pair.boxes, pair.boxes}, pages, memory);
      ASSERT_EQ(plan.status, PlanStatus::ok);
      ASSERT_GE(plan.pages.size(), 16u);
      pair.draw(
          plan, camera, FrameOptions{},
          [](Renderer& renderer) { return renderer.prepare(filters::hard, Source::pages); },
          [&](Renderer& a, Renderer& b) {
            for (std::size_t page = 0; page < plan.pages.size(); ++page)
              pair.compare(a.page_depths(page), b.page_depths(page));
          });
    }
  }
  EXPECT_EQ(pair.differing, 0u);
  EXPECT_GT(pair.saved, pair.triangles / 2);
}

}  // namespace
}  // namespace gnomon::render
