// Are linear depths even along the light's rays, those that rays find, and read alike by every filter?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "filter/filter_block.hpp"
#include "gnomon/shader.hpp"
#include "gnomon/trace/tracer.hpp"
#include "mask_frame.hpp"
#include "shared_context.hpp"

namespace gnomon::render {
namespace {

class LinearDepth : public testing::Test {
 protected:
  void SetUp() override { (void)shared_context(); }
};

FrameOptions frame_of(bool linear, DepthLayer layer = DepthLayer::front) {
  FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  options.depth_layer = layer;
  options.linear_depth = linear;
  return options;
}

Scene solids() {
  Scene scene = empty_scene();
  scene.materials[0].double_sided = false;
  add_quad(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  add_box(scene, {-4, 1, -1}, {-2, 3, 1});
  add_box(scene, {1, 1.5, 0}, {3, 3.5, 2});
  return scene;
}

ShadowPlan planned(const Scene& scene, const Camera& camera, const Light& light, const char* warp,
                   int size = 128, const ClipSpace& space = {}) {
  PlanOptions options;
  options.resolution.max_size = size;
  options.cascades = 1;
  options.warp.warp = find_warp(warp);
  options.clip_space = space;
  const std::vector<Box> boxes = boxes_of(scene);
  return make_plan(camera, light, {boxes, boxes}, options);
}

const Light kLights[] = {DirectionalLight{kSlant}, SpotLight{{4, 12, 6}, {-0.35, -1, -0.5}, 0.6, 40.0},
                         PointLight{{1, 8, 3}, 40.0}};

/// Clip z without the division, 0 near .. 1, of a point.
double even_depth(const ShadowPlan& plan, const ShadowMap& map, const glm::dvec3& point) {
  const glm::dvec4 h =
      glm::inverse(clip_from_gl_clip(plan.clip_space)) * map.clip_from_world * glm::dvec4(point, 1.0);
  return 0.5 * (h.z + h.w) * even_depth_scale(plan, map);
}

glm::dvec3 point_in(const ShadowPlan& plan, const ShadowMap& map, const glm::dvec3& gl_ndc) {
  const glm::dvec4 h =
      glm::inverse(map.clip_from_world) * clip_from_gl_clip(plan.clip_space) * glm::dvec4(gl_ndc, 1.0);
  return glm::dvec3(h) / h.w;
}

TEST_F(LinearDepth, is_0_on_the_near_plane_at_most_1_on_the_far_one_and_even_along_every_ray) {
  const Scene scene = solids();
  const Camera camera = camera_on_box(64, 64);
  ClipSpace other;
  other.reversed_z = true;
  other.handedness = Handedness::left;
  for (const Light& light : kLights) {
    for (const char* warp : {"none", "optimal"}) {
      for (const ClipSpace& space : {ClipSpace{}, kOpenGlZeroToOne, other}) {
        const ShadowPlan plan = planned(scene, camera, light, warp, 128, space);
        ASSERT_GT(plan.map_count, 0);
        for (const ShadowMap& map : plan.maps()) {
          double largest = 0.0;
          for (const glm::dvec2& at : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1),
                                       glm::dvec2(1, 1), glm::dvec2(0.3, -0.6)}) {
            const glm::dvec3 from = point_in(plan, map, {at, -1.0}), to = point_in(plan, map, {at, 1.0});
            const auto depth = [&](double share) { return even_depth(plan, map, glm::mix(from, to, share)); };
            largest = std::max(largest, depth(1.0));
            EXPECT_NEAR(depth(0.0), 0.0, 1e-9);
            for (const double share : {0.25, 0.5, 0.75}) EXPECT_NEAR(depth(share), share * depth(1.0), 1e-9);
          }
          EXPECT_NEAR(largest, 1.0, 1e-9);
        }
      }
    }
  }
}

TEST_F(LinearDepth, engines_get_the_curve_that_the_renderer_draws_with) {
  const Scene scene = solids();
  for (const Light& light : kLights) {
    for (const ClipSpace& space :
         {ClipSpace{}, ClipSpace{.ndc_depth = NdcDepth::zero_to_one, .reversed_z = true},
          ClipSpace{.handedness = Handedness::left}}) {
      const ShadowPlan plan = planned(scene, camera_on_box(64, 64), light, "optimal", 128, space);
      ASSERT_GT(plan.map_count, 0);
      const ShaderBlock block = shader_block(plan);
      for (std::size_t i = 0; i < plan.maps().size(); ++i) {
        const double curve = depth_curve(plan, plan.map[i]);
        EXPECT_EQ(curve > 0.0, !std::holds_alternative<DirectionalLight>(light));
        EXPECT_NEAR(static_cast<double>(block.maps[i].kernel.w), curve, 1e-6 * (1.0 + curve)) << i;
      }
    }
  }
}

TEST_F(LinearDepth, a_map_without_an_inverse_keeps_its_depths) {
  ShadowPlan plan;
  ShadowMap map;
  map.clip_from_world = glm::dmat4(0.0);
  EXPECT_EQ(even_depth_scale(plan, map), 0.0);
  plan.map_count = 1;
  plan.map[0] = map;
  EXPECT_GE(depth_curves(plan, true)[0], 0.0);
}

TEST_F(LinearDepth, a_map_that_bends_lines_has_them_only_where_w_grows_little_across_it) {
  const Scene scene = solids();
  ShadowPlan plan = planned(scene, camera_on_box(64, 64), kLights[0], "none");
  ASSERT_EQ(plan.map_count, 1);
  const glm::dmat4 straight = plan.map[0].clip_from_world;
  for (const double strength : {0.9, 0.99}) {  // w grows 19 and 199 times from the lower edge to the upper
    glm::dmat4 warp(1.0);
    warp[1][3] = strength;
    plan.map[0].clip_from_world = warp * straight;
    plan.map[0].shape = &shapes::linear;
    EXPECT_GT(even_depth_scale(plan, plan.map[0]), 0.0) << strength;
    plan.map[0].shape = &shapes::logarithmic;
    EXPECT_EQ(even_depth_scale(plan, plan.map[0]) > 0.0, strength < 0.95) << strength;
  }
}

TEST_F(LinearDepth, maps_hold_the_depths_of_what_rays_along_the_texels_find) {
  const Scene scene = solids();
  const trace::Tracer tracer(scene, trace::Engine::own);
  const Camera camera = camera_on_box(64, 64);
  Renderer renderer(scene);
  for (const Light& light : kLights) {
    for (const char* warp : {"none", "optimal"}) {
      const ShadowPlan plan = planned(scene, camera, light, warp);
      renderer.draw(plan, camera, renderer.prepare(filters::hard), frame_of(true));
      std::size_t checked = 0, wrong = 0;
      for (int m = 0; m < plan.map_count; ++m) {
        const ShadowMap& map = plan.map[static_cast<std::size_t>(m)];
        const FloatImage image = renderer.depth_map(m);
        const auto hit = [&](double x, double y, std::uint32_t& triangle) {
          const glm::dvec2 ndc(x / map.width * 2.0 - 1.0, y / map.height * 2.0 - 1.0);
          trace::Ray ray;
          ray.origin = point_in(plan, map, {ndc, -1.0});
          ray.direction = point_in(plan, map, {ndc, 1.0}) - ray.origin;
          ray.end = 1.0;
          const trace::Hit found = tracer.first_hit(ray);
          triangle = found.triangle;
          return found.triangle == trace::kNoTriangle
                     ? 1.0
                     : even_depth(plan, map, ray.origin + found.t * ray.direction);
        };
        for (int y = 1; y + 1 < map.height; y += 3) {
          for (int x = 1; x + 1 < map.width; x += 3) {
            std::uint32_t own = 0, near[2] = {};
            const double expected = hit(x + 0.5, y + 0.5, own), right = hit(x + 0.75, y + 0.5, near[0]),
                         up = hit(x + 0.5, y + 0.75, near[1]);
            if (near[0] != own || near[1] != own || expected > 0.999) continue;
            // Vertices are moved to the nearest 1/256 of a texel; numbers between them are rounded a few
            // times.
            constexpr double kSnap = 2.0 / 512.0 / 0.25, kRounding = 1e-6;
            const double bound = (std::abs(right - expected) + std::abs(up - expected)) * kSnap + kRounding;
            const double stored = image.values[static_cast<std::size_t>(y * map.width + x)];
            ++checked;
            if (std::abs(stored - expected) > bound && ++wrong < 5)
              ADD_FAILURE() << x << ", " << y << " of map " << m << " under " << warp << ": " << stored
                            << " is not " << expected;
          }
        }
      }
      EXPECT_GT(checked, 500u);
      EXPECT_EQ(wrong, 0u) << light.index() << warp;
    }
  }
}

TEST_F(LinearDepth, every_filter_finds_the_shadow_of_a_solid_in_every_layer) {
  const Scene scene = solids();
  const Camera camera = camera_on_box(64, 64);
  Renderer renderer(scene);
  for (std::size_t l = 0; l < 2; ++l) {
    for (const Filter* filter : all_filters()) {
      for (const DepthLayerInfo& info : depth_layers()) {
        // Layers do not ask which filter reads them: each once is enough.
        if (filter != &filters::hard && info.layer != DepthLayer::front) continue;
        PlanOptions options;
        options.resolution.max_size = 128;
        options.cascades = 1;
        // Exponents of stored texels are shares of the map's range, which even depths of a warped map use in
        // part.
        options.warp.warp = find_warp(filter->info.reads == MapRead::depth ? "optimal" : "none");
        set_margin(default_settings(*filter), options);
        const std::vector<Box> boxes = boxes_of(scene);
        const ShadowPlan plan = make_plan(camera, kLights[l], {boxes, boxes}, options);
        const Frame even =
            draw(renderer, camera, plan, default_settings(*filter), frame_of(true, info.layer));
        const Frame divided =
            draw(renderer, camera, plan, default_settings(*filter), frame_of(false, info.layer));
        double apart = 0.0, dark = 0.0;
        for (std::size_t i = 0; i < even.pixels(); ++i) {
          apart += std::abs(even.lit(i) - divided.lit(i));
          dark += even.surface(i) ? 1.0 - divided.lit(i) : 0.0;
        }
        EXPECT_GT(dark, 60.0) << filter->info.name;
        EXPECT_LT(apart, 0.04 * static_cast<double>(even.pixels())) << filter->info.name << info.name << l;
      }
    }
  }
}

TEST_F(LinearDepth, maps_of_the_other_scale_are_not_reused) {
  const Scene scene = solids();
  const Camera camera = camera_on_box(48, 48);
  Renderer renderer(scene);
  const ShadowPlan plan = planned(scene, camera, kLights[1], "none", 64);
  const PreparedFilter hard = renderer.prepare(filters::hard);
  const auto depths = [&](bool linear) {
    renderer.draw(plan, camera, hard, frame_of(linear));
    return renderer.depth_map(0).values;
  };
  const std::vector<float> even = depths(true), divided = depths(false);
  EXPECT_NE(even, divided);
  EXPECT_EQ(depths(true), even);
  EXPECT_TRUE(renderer.draw(plan, camera, hard, frame_of(true)).map[0].held);
  EXPECT_EQ(depths(true), even);
}

TEST_F(LinearDepth, bent_maps_hold_even_depths_too) {
  const Scene scene = solids();
  const Camera camera = camera_on_box(96, 96);
  Renderer renderer(scene);
  PlanOptions options;
  options.resolution.max_size = 256;
  options.warp.shape = find_shape("paraboloid");
  const std::vector<Box> boxes = boxes_of(scene);
  const ShadowPlan plan =
      make_plan(camera, SpotLight{{0, 9, 0}, {0, -1, 0.1}, 1.35, 40.0}, {boxes, boxes}, options);
  ASSERT_FALSE(plan.map[0].shape->affine);
  const Frame even = draw(renderer, camera, plan, default_settings(filters::hard), frame_of(true));
  const Frame divided = draw(renderer, camera, plan, default_settings(filters::hard), frame_of(false));
  std::size_t apart = 0, dark = 0;
  for (std::size_t i = 0; i < even.pixels(); ++i) {
    apart += even.lit(i) != divided.lit(i);
    dark += even.surface(i) && even.lit(i) < 0.5f;
  }
  EXPECT_GT(dark, 300u);
  EXPECT_LT(apart, 60u);
}

}  // namespace
}  // namespace gnomon::render
