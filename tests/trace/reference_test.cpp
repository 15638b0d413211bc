// Hard, filtered and area shadows against shadows worked out by hand.
#include "gnomon/trace/reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "picture.hpp"
#include "render/test_scene.hpp"

namespace gnomon::trace {
namespace {

using render::add_quad;
using render::empty_scene;

const glm::dvec3 kSlant = glm::normalize(glm::dvec3(0.9, -1.0, 0.5));

/// Looks straight down on [-1,1] x [-1,1] from height 2: pixel column to world x, row to world z.
Camera overhead(int size) {
  return orthographic_camera({0, 2, 0}, {0, -1, 0}, {0, 0, -1}, 2.0, 1.0, 0.1, 3.0, size, size);
}
double world_of(std::size_t pixel, int size) {
  return (static_cast<double>(pixel) + 0.5) / size * 2.0 - 1.0;
}

/// Ground, and far above the camera a roof over x < 0.
Scene half_covered() {
  Scene scene = empty_scene();
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  add_quad(scene, {-40, 4, 40}, {40, 0, 0}, {0, 0, -80});
  return scene;
}

TEST(Reference, nothing_is_evaluated_where_nothing_is_visible) {
  const Tracer tracer(empty_scene());
  const Camera camera = overhead(4);
  const Picture picture = picture_of(tracer, camera);
  const Light sun = DirectionalLight{};
  const SurfacePoints points = surface_points(tracer, camera, sun, picture.positions, picture.normals);
  for (const Verdict v : hard_reference(tracer, points, sun).pixels) EXPECT_EQ(v, Verdict::none);
  for (const float v : area_reference(tracer, points, sun, 0.1).pixels) EXPECT_EQ(v, -1.0f);
}

TEST(Reference, surfaces_turned_from_the_light_and_beyond_its_range_are_not_evaluated) {
  const Scene scene = half_covered();
  const Tracer tracer(scene);
  const Camera camera = overhead(8);
  const Picture picture = picture_of(tracer, camera);
  const auto state = [&](const Light& light, std::size_t pixel) {
    return surface_points(tracer, camera, light, picture.positions, picture.normals).pixels[pixel].state;
  };
  EXPECT_EQ(state(DirectionalLight{{0, 1, 0}}, 9), PixelState::turned_away);
  EXPECT_EQ(state(DirectionalLight{{0, -1, 0}}, 9), PixelState::facing);
  EXPECT_EQ(state(DirectionalLight{{1, -1e-6, 0}}, 9), PixelState::undecided);
  EXPECT_EQ(state(PointLight{{0, 1, 0}, 0.5}, 9), PixelState::unlit);
  EXPECT_EQ(state(PointLight{{0, 1, 0}, 5.0}, 9), PixelState::facing);
  EXPECT_EQ(state(SpotLight{{0, 1, 0}, {0, -1, 0}, 0.1, 5.0}, 0), PixelState::unlit);
  EXPECT_EQ(state(SpotLight{{0, 1, 0}, {0, -1, 0}, 0.1, 5.0}, 27), PixelState::unlit);
  EXPECT_EQ(state(SpotLight{{0, 1, 0}, {0, -1, 0}, 0.3, 5.0}, 27), PixelState::facing);
}

TEST(Reference, a_pixel_that_shows_another_surface_than_the_ray_from_the_eye_finds_is_undecided) {
  const Scene scene = half_covered();
  const Tracer tracer(scene);
  const Camera camera = overhead(8);
  const Light sun = DirectionalLight{{0, -1, 0}};
  const auto state_after = [&](auto&& change) {
    Picture picture = picture_of(tracer, camera);
    change(picture);
    return surface_points(tracer, camera, sun, picture.positions, picture.normals).pixels[9].state;
  };
  EXPECT_EQ(state_after([](Picture&) {}), PixelState::facing);
  // The eye is two units above: rounding moves a point by less than 1e-4 of that.
  const auto raised_by = [](float height) {
    return [height](Picture& picture) { picture.positions.values[4 * 9 + 1] += height; };
  };
  EXPECT_EQ(state_after(raised_by(1e-5f)), PixelState::facing);
  EXPECT_EQ(state_after(raised_by(5e-4f)), PixelState::undecided);
  const auto turned_to = [](float x, float y) {
    return [x, y](Picture& picture) {
      picture.normals.values[4 * 9] = x;
      picture.normals.values[4 * 9 + 1] = y;
    };
  };
  EXPECT_EQ(state_after(turned_to(0.01f, 0.99995f)), PixelState::facing);
  EXPECT_EQ(state_after(turned_to(0.7071f, 0.7071f)), PixelState::undecided);
}

TEST(Reference, the_box_throws_the_shadow_that_geometry_says) {
  const Scene scene = render::box_on_ground();
  const Camera camera = render::camera_on_box(96, 64);
  const Light sun = DirectionalLight{kSlant};
  for (const Engine engine : {Engine::own, Engine::automatic}) {
    const Tracer tracer(scene, engine);
    const Picture picture = picture_of(tracer, camera);
    const SurfacePoints points = surface_points(tracer, camera, sun, picture.positions, picture.normals);
    const HardReference hard = hard_reference(tracer, points, sun);
    int shadow = 0, lit = 0, undecided = 0;
    for (std::size_t i = 0; i < points.pixels.size(); ++i) {
      if (points.pixels[i].state != PixelState::facing) continue;
      if (hard.pixels[i] == Verdict::undecided) {
        ++undecided;
        continue;
      }
      // Off the surface, so that the box's own lit sides are not found to shadow themselves.
      constexpr double kOff = 1e-5;
      const glm::dvec3 p = points.pixels[i].position + kOff * points.pixels[i].normal;
      const bool truth = render::hits_box(p, -kSlant, render::kBoxMin, render::kBoxMax);
      EXPECT_EQ(hard.pixels[i] == Verdict::shadow, truth) << i;
      (truth ? shadow : lit) += 1;
    }
    EXPECT_GT(shadow, 100);
    EXPECT_GT(lit, 1000);
    EXPECT_LE(undecided, 3);
  }
}

TEST(Reference, a_large_floor_does_not_shadow_itself_at_grazing_light) {
  Scene scene = empty_scene();
  for (int i = -8; i < 8;
       ++i) {  // many triangles in one plane, whose neighbours must not stop each other's rays
    const auto x = static_cast<float>(i) * 0.3f;
    add_quad(scene, {x, 0.1f, 2.4f}, {0.3f, 0, 0}, {0, 0, -4.8f});
  }
  add_quad(scene, {500, 0, 500}, {1, 0, 0}, {0, 0, 1});  // far off: the scene's diameter sets the error
  const Camera camera = overhead(32);
  const Light sun = DirectionalLight{{1.0, -0.004, 0.3}};
  for (const Engine engine : {Engine::own, Engine::automatic}) {
    const Tracer tracer(scene, engine);
    const Picture picture = picture_of(tracer, camera);
    const SurfacePoints points = surface_points(tracer, camera, sun, picture.positions, picture.normals);
    for (const Verdict v : hard_reference(tracer, points, sun).pixels) EXPECT_EQ(v, Verdict::lit);
  }
}

TEST(Reference, an_edge_closer_than_the_error_is_undecided) {
  // Columns of pixels whose centres lie exactly below the roof's edge: 3 pixels put the middle one at x = 0.
  const Scene scene = half_covered();
  const Tracer tracer(scene);
  const Camera camera = overhead(3);
  const Picture picture = picture_of(tracer, camera);
  const Light sun = DirectionalLight{{0, -1, 0}};
  const SurfacePoints points = surface_points(tracer, camera, sun, picture.positions, picture.normals);
  const HardReference hard = hard_reference(tracer, points, sun);
  EXPECT_EQ(hard.pixels[3], Verdict::shadow);
  EXPECT_EQ(hard.pixels[4], Verdict::undecided);
  EXPECT_EQ(hard.pixels[5], Verdict::lit);
}

TEST(Reference, a_box_filter_over_a_straight_edge_is_a_ramp) {
  constexpr int kSize = 16, kSamples = 256;
  const Scene scene = half_covered();
  const Tracer tracer(scene);
  const Camera camera = overhead(kSize);
  const Picture picture = picture_of(tracer, camera);
  const Light sun = DirectionalLight{{0, -1, 0}};
  const SurfacePoints points = surface_points(tracer, camera, sun, picture.positions, picture.normals);
  const KernelAxes axes{{0.5, 0, 0}, {0, 0, 0.5}};
  const SoftReference soft = filtered_reference(
      tracer, points, sun, KernelShape::box, [&](std::size_t) { return axes; }, kSamples);
  for (std::size_t i = 0; i < soft.pixels.size(); ++i) {
    const double x = world_of(i % kSize, kSize);
    // Strata are 1/16 of the kernel wide, and at most one column of them is cut.
    EXPECT_NEAR(soft.pixels[i], std::clamp(0.5 + x, 0.0, 1.0), 1.0 / 16) << i;
  }
}

TEST(Reference, a_kernel_without_extent_is_the_hard_shadow) {
  const Scene scene = render::box_on_ground();
  const Tracer tracer(scene);
  const Camera camera = render::camera_on_box(48, 32);
  const Picture picture = picture_of(tracer, camera);
  for (const Light& light : {Light(DirectionalLight{kSlant}), Light(PointLight{{4, 6, 3}, 50.0})}) {
    const SurfacePoints points = surface_points(tracer, camera, light, picture.positions, picture.normals);
    const HardReference hard = hard_reference(tracer, points, light);
    const SoftReference filtered = filtered_reference(tracer, points, light, KernelShape::gauss,
                                                      [](std::size_t) { return KernelAxes{}; });
    const SoftReference area = area_reference(tracer, points, light, 0.0);
    int shadow = 0;
    for (std::size_t i = 0; i < hard.pixels.size(); ++i) {
      if (hard.pixels[i] != Verdict::shadow && hard.pixels[i] != Verdict::lit) continue;
      const float expected = hard.pixels[i] == Verdict::lit ? 1.0f : 0.0f;
      shadow += hard.pixels[i] == Verdict::shadow;
      EXPECT_EQ(filtered.pixels[i], expected);
      EXPECT_EQ(area.pixels[i], expected);
    }
    EXPECT_GT(shadow, 10);
  }
}

TEST(Reference, a_gauss_filter_over_a_straight_edge_is_its_integral_and_ends_at_three_deviations) {
  constexpr int kSize = 32, kSamples = 1024;
  const Scene scene = half_covered();
  const Tracer tracer(scene);
  const Camera camera = overhead(kSize);
  const Picture picture = picture_of(tracer, camera);
  const Light sun = DirectionalLight{{0, -1, 0}};
  const SurfacePoints points = surface_points(tracer, camera, sun, picture.positions, picture.normals);
  constexpr double kDeviation = 0.25, kCut = 3.0;
  const KernelAxes axes{{kDeviation, 0, 0}, {0, 0, kDeviation}};
  const SoftReference soft = filtered_reference(
      tracer, points, sun, KernelShape::gauss, [&](std::size_t) { return axes; }, kSamples);
  for (std::size_t i = 0; i < soft.pixels.size(); ++i) {
    const double x = world_of(i % kSize, kSize) / kDeviation;
    // What lies beyond the cut is a hundredth; 1024 stratified samples.
    EXPECT_NEAR(soft.pixels[i], 0.5 * std::erfc(-x / std::sqrt(2.0)), 0.03) << i;
    if (std::abs(x) < kCut) continue;
    EXPECT_EQ(soft.pixels[i], x > 0.0 ? 1.0f : 0.0f) << i;
  }
}

TEST(Reference, rays_begin_at_the_triangle_and_not_where_the_picture_has_rounded_it_to) {
  // A sheet between the ground and where the picture shows the ground.
  Scene scene = empty_scene();
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  add_quad(scene, {-2, 1e-3f, 2}, {4, 0, 0}, {0, 0, -4});
  const Tracer tracer(scene, Engine::own);
  SurfacePoint point;
  point.position = {0.1, 2e-3, 0.2};
  point.normal = {0, 1, 0};
  point.above = 2e-3;
  point.state = PixelState::facing;
  const SurfacePoints points{1, 1, {point}};
  for (const Light& light : {Light(DirectionalLight{kSlant}), Light(PointLight{{1, 5, 0}, 50.0})})
    EXPECT_EQ(hard_reference(tracer, points, light).pixels[0], Verdict::shadow);
}

TEST(Reference, the_penumbra_of_a_disc_is_the_disc_cut_by_the_edge) {
  constexpr int kSize = 16, kSamples = 1024;
  const Scene scene = half_covered();
  const Tracer tracer(scene);
  const Camera camera = overhead(kSize);
  const Picture picture = picture_of(tracer, camera);
  constexpr double kHeight = 4.0, kTangent = 0.15;
  const Light sun = DirectionalLight{{0, -1, 0}};
  const SurfacePoints points = surface_points(tracer, camera, sun, picture.positions, picture.normals);
  const SoftReference area = area_reference(tracer, points, sun, kTangent, kSamples);
  // Seen from height 0 the disc has radius 0.6 at the roof; the edge cuts it at distance x from its centre.
  for (std::size_t i = 0; i < area.pixels.size(); ++i) {
    const double a = std::clamp(world_of(i % kSize, kSize) / (kHeight * kTangent), -1.0, 1.0);
    const double lit = 0.5 + (a * std::sqrt(1.0 - a * a) + std::asin(a)) / 3.141592653589793;
    EXPECT_NEAR(area.pixels[i], lit, 0.02) << i;  // 1024 stratified samples: a few of the 32 cut strata
  }
}

TEST(Reference, texel_axes_are_the_sides_of_a_texel) {
  const Scene scene = render::box_on_ground();
  PlanOptions options;
  options.cascades = 1;
  options.resolution.max_size = 256;
  const ShadowPlan plan = render::plan_for(scene, render::camera_on_box(96, 64), kSlant, options);
  ASSERT_EQ(plan.map_count, 1);
  const ShadowMap& map = plan.map[0];
  const glm::dvec3 point(0.4, 0.0, 2.0);
  const KernelAxes axes = texel_axes(map, point, 1.0);
  const auto texel = [&](const glm::dvec3& p) {
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
    return glm::dvec2(clip) / clip.w * 0.5 * glm::dvec2(map.width, map.height);
  };
  // A warp's texels change over their own extent: a hundredth of one shows the derivative.
  constexpr double kStep = 0.01;
  const glm::dvec2 along_x = (texel(point + kStep * axes.x) - texel(point)) / kStep;
  const glm::dvec2 along_y = (texel(point + kStep * axes.y) - texel(point)) / kStep;
  EXPECT_NEAR(along_x.x, 1.0, 1e-3);
  EXPECT_NEAR(along_x.y, 0.0, 1e-3);
  EXPECT_NEAR(along_y.x, 0.0, 1e-3);
  EXPECT_NEAR(along_y.y, 1.0, 1e-3);
  EXPECT_NEAR(glm::dot(axes.x, kSlant), 0.0, 1e-9);
}

TEST(Reference, a_light_far_behind_the_scene_has_the_shadow_of_parallel_light) {
  const Scene scene = render::box_on_ground();
  const Camera camera = render::camera_on_box(96, 64);
  const Tracer tracer(scene);
  const Picture picture = picture_of(tracer, camera);
  const auto shadow_of = [&](const Light& light) {
    const SurfacePoints points = surface_points(tracer, camera, light, picture.positions, picture.normals);
    return hard_reference(tracer, points, light).pixels;
  };
  const std::vector<Verdict> parallel = shadow_of(DirectionalLight{kSlant});
  for (const double distance : {1e7, 1e9, 1e12}) {
    const std::vector<Verdict> far = shadow_of(PointLight{-distance * kSlant, 2.0 * distance});
    int different = 0;
    for (std::size_t i = 0; i < far.size(); ++i) different += far[i] != parallel[i] ? 1 : 0;
    EXPECT_LE(different, 6) << distance;
  }
}

}  // namespace
}  // namespace gnomon::trace
