// Do the depth maps hold what the plan says they hold?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "gnomon/render/renderer.hpp"
#include "gnomon/study/bias.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

constexpr int kSize = 64;
/// Vertices are moved to the nearest 1/256 of a texel before they are rasterized: the depth at a texel's
/// centre may come from up to 1/512 of a texel away along each axis, and is itself rounded.
constexpr double kSnapTexels = 2.0 / 512.0, kDepthRounding = 4.0 / 16777216.0;

/// Where the light's ray through a place of the map meets the ground y = 0, and its depth 0..1 there.
double ground_depth(const ShadowMap& map, double ndc_x, double ndc_y, glm::dvec3& point) {
  const glm::dmat4 world_from_clip = glm::inverse(map.clip_from_world);
  const auto at = [&](double z) {
    const glm::dvec4 h = world_from_clip * glm::dvec4(ndc_x, ndc_y, z, 1.0);
    return glm::dvec3(h) / h.w;
  };
  const glm::dvec3 a = at(-1.0), b = at(1.0);
  point = a + (b - a) * (a.y / (a.y - b.y));
  const glm::dvec4 h = map.clip_from_world * glm::dvec4(point, 1.0);
  return 0.5 * h.z / h.w + 0.5;
}

TEST(DepthMaps, hold_the_depth_of_the_ground_at_each_texels_centre) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  for (const Warp* warp : all_warps()) {
    PlanOptions options;
    options.resolution.max_size = 128;
    options.cascades = 1;
    options.warp.warp = warp;
    options.prune = kPruneNothing;  // a square map
    const ShadowPlan plan = plan_for(scene, camera, {0.4, -0.8, -0.3}, options);
    ASSERT_EQ(plan.map_count, 1);
    renderer.draw(plan, camera, renderer.prepare(filters::hard));
    const FloatImage depth = renderer.depth_map(0);
    ASSERT_EQ(depth.width, plan.map[0].width);
    const auto ndc = [&](double texel) { return texel / depth.width * 2.0 - 1.0; };
    std::size_t ground = 0;
    for (int y = 1; y + 1 < depth.height; ++y) {
      for (int x = 1; x + 1 < depth.width; ++x) {
        glm::dvec3 p, q;
        const double expected = ground_depth(plan.map[0], ndc(x + 0.5), ndc(y + 0.5), p);
        const double step_x = ground_depth(plan.map[0], ndc(x + 1.5), ndc(y + 0.5), q) - expected;
        const double step_y = ground_depth(plan.map[0], ndc(x + 0.5), ndc(y + 1.5), q) - expected;
        if (std::max(std::abs(p.x), std::abs(p.z)) > 19.0) continue;
        // Ground that no visible receiver reaches may lie behind the map's far plane.
        if (expected + std::abs(step_x) + std::abs(step_y) > 1.0) continue;
        const double stored = depth.values[static_cast<std::size_t>(y * depth.width + x)];
        const double bound = (std::abs(step_x) + std::abs(step_y)) * kSnapTexels + kDepthRounding;
        const glm::dvec2 texel = texel_extent_world(plan.map[0].clip_from_world, {depth.width, depth.height},
                                                    plan.light_direction, p);
        const glm::dvec3 rim(2.0 * std::max(texel.x, texel.y));
        const glm::dvec3 low = glm::dvec3(kBoxMin) - rim, high = glm::dvec3(kBoxMax) + rim;
        if (hits_box(p, -plan.light_direction, low, high)) continue;
        ASSERT_NEAR(stored, expected, bound) << warp->name << " " << x << " " << y;
        ++ground;
      }
    }
    EXPECT_GT(ground, 4'000u) << warp->name;
  }
}

TEST(DepthMaps, are_drawn_for_plans_of_any_clip_space) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  std::vector<float> reference;
  for (const ClipSpace space :
       {kOpenGl, kOpenGlZeroToOne, kVulkan, ClipSpace{NdcDepth::zero_to_one, true, false}}) {
    PlanOptions options;
    options.resolution.max_size = 128;
    options.clip_space = space;
    const ShadowPlan plan = plan_for(scene, camera, {0.4, -0.8, -0.3}, options);
    renderer.draw(plan, camera, renderer.prepare(filters::pcf));
    const std::vector<float> mask = renderer.mask().values;
    if (reference.empty()) reference = mask;
    std::size_t different = 0;
    for (std::size_t i = 0; i < mask.size(); ++i)
      different += std::abs(mask[i] - reference[i]) > 0.01f ? 1 : 0;
    // The float matrices are rounded in other places; a comparison at a texel's border may turn out
    // otherwise.
    EXPECT_LE(different, mask.size() / 500);
  }
}

TEST(DepthMaps, of_different_sizes_share_one_array) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  PlanOptions options;
  options.resolution.max_size = 128;
  options.cascades = 2;
  options.prune = kPruneNothing;
  ShadowPlan plan = plan_for(scene, camera, {0.4, -0.8, -0.3}, options);
  ASSERT_EQ(plan.map_count, 2);
  renderer.draw(plan, camera, renderer.prepare(filters::hard));
  const FloatImage alone = renderer.depth_map(0);
  plan.map[1].width = 256;
  plan.map[1].height = 64;
  const FrameStats stats = renderer.draw(plan, camera, renderer.prepare(filters::hard));
  EXPECT_EQ(renderer.depth_map(0).values, alone.values);
  EXPECT_EQ(renderer.depth_map(1).width, 256);
  EXPECT_EQ(renderer.depth_map(1).height, 64);
  EXPECT_EQ(stats.texels, 128u * 128u + 256u * 64u);
  EXPECT_THROW((void)renderer.depth_map(2), RenderError);
}

TEST(DepthMaps, count_what_is_drawn_into_them) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  PlanOptions options;
  options.cascades = 1;
  const FrameStats stats = renderer.draw(plan_for(scene, camera, {0.4, -0.8, -0.3}, options), camera,
                                         renderer.prepare(filters::hard));
  EXPECT_EQ(stats.map_count, 1);
  EXPECT_EQ(stats.map[0].instances, 2u);
  EXPECT_EQ(stats.map[0].triangles, 14u);
  EXPECT_EQ(stats.map[0].draws, 2u);
  EXPECT_EQ(stats.camera.triangles, 14u);
  EXPECT_GT(stats.milliseconds[0], 0.0);
}

}  // namespace
}  // namespace gnomon::render
