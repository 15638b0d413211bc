// Rays against triangles: nothing, one, holes, and the same answers from both engines.
#include "gnomon/trace/tracer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

#include "render/test_scene.hpp"

namespace gnomon::trace {
namespace {

using render::add_material;
using render::add_mesh;
using render::add_quad;
using render::empty_scene;

std::vector<Engine> engines() {
  return built_with_embree() ? std::vector{Engine::own, Engine::embree} : std::vector{Engine::own};
}

bool occluded(const Tracer& tracer, const Ray& ray) {
  std::uint8_t answer = 2;
  tracer.occluded({&ray, 1}, {&answer, 1});
  EXPECT_LE(answer, 1);
  return answer == 1;
}

Ray up_from(double x, double z, double y = 0.0) {
  Ray ray;
  ray.origin = {x, y, z};
  return ray;
}

/// A square of 2 x 2 at height 1 over the origin.
Scene one_square(const glm::dvec3& at = glm::dvec3(0.0)) {
  Scene scene = empty_scene();
  add_mesh(scene, {{-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, 1}, {1, 1, -1}, {-1, 1, -1}},
           glm::translate(glm::dmat4(1.0), at));
  return scene;
}

TEST(Tracer, an_empty_scene_stops_nothing) {
  for (const Engine engine : engines()) {
    const Tracer tracer(empty_scene(), engine);
    EXPECT_EQ(tracer.triangle_count(), 0u);
    EXPECT_FALSE(occluded(tracer, up_from(0, 0)));
    EXPECT_EQ(tracer.first_hit(up_from(0, 0)).triangle, kNoTriangle);
    EXPECT_EQ(tracer.error_world(), 0.0);
    tracer.occluded({}, {});
  }
}

TEST(Tracer, embree_is_refused_by_name_where_it_was_not_built_in) {
  if (built_with_embree()) {
    EXPECT_EQ(Tracer(one_square()).engine(), Engine::embree);
  } else {
    EXPECT_THROW(Tracer(one_square(), Engine::embree), TraceError);
    EXPECT_EQ(Tracer(one_square()).engine(), Engine::own);
  }
}

TEST(Tracer, a_triangle_far_from_all_others_takes_no_precision_from_them) {
  Scene scene = one_square();
  add_mesh(scene, {{1e9, 1e9, 1e9}, {1.1e9, 1e9, 1e9}, {1e9, 1.1e9, 1e9}}, glm::dmat4(1.0));
  const Tracer tracer(scene);
  EXPECT_EQ(tracer.engine(), Engine::own);
  EXPECT_LT(tracer.error_world(), 1e-4);
  EXPECT_TRUE(occluded(tracer, up_from(0.99, 0.5)));
  EXPECT_FALSE(occluded(tracer, up_from(1.01, 0.5)));
}

TEST(Tracer, triangles_without_area_stop_nothing) {
  Scene scene = empty_scene();
  add_mesh(scene, {{0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}});
  for (const Engine engine : engines()) EXPECT_FALSE(occluded(Tracer(scene, engine), up_from(0.5, 0.0)));
}

TEST(Tracer, a_square_stops_what_passes_through_it_from_both_sides_and_within_the_rays_length) {
  for (const Engine engine : engines()) {
    const Tracer tracer(one_square(), engine);
    EXPECT_TRUE(occluded(tracer, up_from(0.5, 0.25)));
    EXPECT_TRUE(occluded(tracer, up_from(0.5, 0.5)));  // on the diagonal that its triangles share
    EXPECT_FALSE(occluded(tracer, up_from(1.5, 0.25)));
    Ray ray = up_from(0.5, 0.25, 2.0);
    EXPECT_FALSE(occluded(tracer, ray));
    ray.direction = {0.0, -0.5, 0.0};
    EXPECT_TRUE(occluded(tracer, ray));
    ray.end = 1.9;
    EXPECT_FALSE(occluded(tracer, ray));
    ray.end = 3.0;
    ray.begin = 2.1;
    EXPECT_FALSE(occluded(tracer, ray));
  }
}

TEST(Tracer, no_ray_slips_through_the_diagonal) {
  for (const Engine engine : engines()) {
    const Tracer tracer(one_square(), engine);
    for (int i = -99; i < 100; ++i) {
      Ray ray = up_from(i / 100.0, i / 100.0);
      ray.direction = {0.0, 1.0, 0.0};
      EXPECT_TRUE(occluded(tracer, ray)) << i;
    }
  }
}

TEST(Tracer, the_excepted_triangle_is_not_there) {
  for (const Engine engine : engines()) {
    const Tracer tracer(one_square(), engine);
    Ray ray = up_from(0.5, 0.25);
    ray.except = tracer.first_hit(ray).triangle;
    ASSERT_NE(ray.except, kNoTriangle);
    EXPECT_FALSE(occluded(tracer, ray));
    ray.except = 1 - ray.except;
    EXPECT_TRUE(occluded(tracer, ray));
  }
}

TEST(Tracer, first_and_nearest_hits_are_exact) {
  Scene scene = one_square();
  add_mesh(scene, {{-1, 3, 1}, {1, 3, 1}, {1, 3, -1}});
  const Tracer tracer(scene, Engine::own);
  Ray ray = up_from(0.5, 0.25);
  ray.direction = {0.0, 2.0, 0.0};
  EXPECT_EQ(tracer.first_hit(ray).t, 0.5);
  EXPECT_EQ(tracer.first_hit(ray).normal, glm::dvec3(0, 1, 0));
  EXPECT_EQ(tracer.hit_nearest_to(ray, 1.2).t, 1.5);
  EXPECT_EQ(tracer.hit_nearest_to(ray, 1.2).triangle, 2u);
  ray.begin = -1.0;
  ray.origin.y = 1.5;
  EXPECT_EQ(tracer.hit_nearest_to(ray, 0.0).t, -0.25);
}

TEST(Tracer, the_first_hit_is_the_nearest_of_many_from_either_side) {
  Scene scene = empty_scene();
  constexpr int kSquares = 20;
  for (int i = 0; i < kSquares; ++i) {  // 1 to 20 in another order
    const auto y = static_cast<float>(1 + 7 * i % kSquares);
    add_quad(scene, {-1, y, 1}, {2, 0, 0}, {0, 0, -2});
  }
  const Tracer tracer(scene, Engine::own);
  for (int below = 0; below < kSquares; ++below) {
    Ray up = up_from(0.5, 0.25, below + 0.5), down = up_from(0.5, 0.25, below + 1.5);
    up.direction = {0, 1, 0};
    down.direction = {0, -1, 0};
    EXPECT_EQ(tracer.first_hit(up).t, 0.5) << below;
    EXPECT_EQ(tracer.first_hit(down).t, 0.5) << below;
  }
}

TEST(Tracer, rays_along_the_sides_of_boxes_are_stopped_by_what_lies_there) {
  // Far more than a leaf holds: each square has sides of boxes through its own sides.
  Scene scene = empty_scene();
  for (int i = 0; i < 32; ++i) add_quad(scene, {static_cast<float>(2 * i), 1, 1}, {1, 0, 0}, {0, 0, -1});
  const Tracer tracer(scene, Engine::own);
  for (int i = 0; i < 32; ++i) {
    for (const double side : {0.0, 1.0}) {
      Ray ray = up_from(2.0 * i + side, 0.5);
      ray.direction = {0, 1, 0};
      EXPECT_TRUE(occluded(tracer, ray)) << i << " " << side;
    }
  }
}

TEST(Tracer, masks_let_light_through_where_they_cut) {
  Scene scene = empty_scene();
  // Two columns: left alpha 0, right 255. Bilinear between their centres at u = 1/4 and 3/4; cut below one
  // half.
  scene.images.push_back({"halves", 2, 1, {0, 0, 0, 0, 0, 0, 0, 255}});
  Material material;
  material.base_color_image = 0;
  material.alpha_mode = AlphaMode::mask;
  material.wrap_u = TextureWrap::clamp_to_edge;
  material.wrap_v = TextureWrap::clamp_to_edge;
  add_quad(scene, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}, add_material(scene, material));
  for (const Engine engine : engines()) {
    const Tracer tracer(scene, engine);
    EXPECT_FALSE(occluded(tracer, up_from(0.1, -0.5)));
    EXPECT_FALSE(occluded(tracer, up_from(0.48, -0.3)));
    EXPECT_TRUE(occluded(tracer, up_from(0.52, -0.3)));
    EXPECT_TRUE(occluded(tracer, up_from(0.9, -0.5)));
  }
}

TEST(Tracer, wraps_are_those_of_the_image) {
  Scene scene = empty_scene();
  scene.images.push_back({"halves", 2, 1, {0, 0, 0, 0, 0, 0, 0, 255}});
  Material material;
  material.base_color_image = 0;
  material.alpha_mode = AlphaMode::mask;
  const auto there = [&](TextureWrap wrap, float u) {
    Scene copy = scene;
    material.wrap_u = wrap;
    add_quad(copy, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}, add_material(copy, material));
    for (glm::vec2& texcoord : copy.texcoords) texcoord.x += u - 0.5f;
    return occluded(Tracer(copy, Engine::own), up_from(0.5, -0.5));
  };
  EXPECT_TRUE(there(TextureWrap::repeat, -0.25f));
  EXPECT_FALSE(there(TextureWrap::mirrored_repeat, -0.25f));
  EXPECT_FALSE(there(TextureWrap::clamp_to_edge, -0.25f));
  EXPECT_TRUE(there(TextureWrap::mirrored_repeat, -0.75f));
  EXPECT_FALSE(there(TextureWrap::repeat, 1.25f));
  EXPECT_TRUE(there(TextureWrap::mirrored_repeat, 1.25f));
}

TEST(Tracer, a_million_units_from_the_origin_results_are_the_same) {
  const glm::dvec3 far(1e6, -2e6, 3e6);
  for (const Engine engine : engines()) {
    const Tracer tracer(one_square(far), engine);
    const auto shifted = [&](double x, double z) {
      Ray ray = up_from(x, z);
      ray.origin += far;
      return ray;
    };
    EXPECT_TRUE(occluded(tracer, shifted(0.99999, 0.25)));
    EXPECT_FALSE(occluded(tracer, shifted(1.00001, 0.25)));
    // Coordinates alone are rounded to this.
    const double rounding = 3e6 * std::numeric_limits<double>::epsilon();
    EXPECT_GT(tracer.error_world(), engine == Engine::own ? rounding : 0.0);
    EXPECT_LT(tracer.error_world(), 1e-5);
  }
}

TEST(Tracer, both_engines_agree_on_random_triangles_off_their_error) {
  if (!built_with_embree()) GTEST_SKIP() << "built without Embree";
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> at(-10.0f, 10.0f), small(-1.0f, 1.0f);
  Scene scene = empty_scene();
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 centre(at(engine), at(engine), at(engine));
    for (int k = 0; k < 3; ++k)
      corners.push_back(centre + glm::vec3(small(engine), small(engine), small(engine)));
  }
  add_mesh(scene, corners);
  const Tracer own(scene, Engine::own), embree(scene, Engine::embree);
  int stopped = 0, uncertain = 0;
  constexpr int kRays = 20'000;
  for (int i = 0; i < kRays; ++i) {
    Ray ray;
    ray.origin = {at(engine), at(engine), at(engine)};
    ray.direction = glm::normalize(glm::dvec3(small(engine), small(engine), small(engine)));
    const bool truth = occluded(own, ray);
    stopped += truth;
    if (truth == occluded(embree, ray)) continue;
    // The two differ: then an edge or a start must lie within the error that Embree states.
    const glm::dvec3 side = glm::normalize(glm::cross(ray.direction, glm::dvec3(0.3, 0.5, 0.8)));
    const glm::dvec3 other = glm::cross(ray.direction, side);
    bool changes = false;
    for (const glm::dvec3& offset : {side, -side, other, -other, ray.direction, -ray.direction}) {
      Ray moved = ray;
      moved.origin += embree.error_world() * offset;
      changes = changes || occluded(own, moved) != truth;
    }
    EXPECT_TRUE(changes) << "ray " << i;
    ++uncertain;
  }
  EXPECT_GT(stopped, kRays / 10);
  EXPECT_LT(stopped, kRays * 9 / 10);
  EXPECT_LT(uncertain, 20);
}

}  // namespace
}  // namespace gnomon::trace
