// Is the error per pixel the error? The drawn figures against the C++ metric, and both against what is on the
// screen.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/grazing.hpp"
#include "gnomon/measure.hpp"
#include "gnomon/render/renderer.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

constexpr int kSize = 128;
constexpr double kUnit = 1.0 / 16777216.0;  ///< rounding of one float operation
/// About sixty float operations lie between a position and its m, each of relative error kUnit, half of them
/// before the determinant, which magnifies what comes before it by the anisotropy.
constexpr double kOperations = 60.0;

struct Pixel {
  glm::dvec3 point, normal;
  std::array<float, 4> aliasing;
  double depth;
};

struct Frame {
  Camera camera;
  ShadowPlan plan;
  FloatImage aliasing, positions, normals;
  [[nodiscard]] Pixel at(int x, int y) const {
    const auto i = static_cast<std::size_t>(y * aliasing.width + x) * 4;
    const auto v3 = [i](const FloatImage& f) {
      return glm::dvec3(f.values[i], f.values[i + 1], f.values[i + 2]);
    };
    return {camera.position + v3(positions),
            glm::normalize(v3(normals)),
            {aliasing.values[i], aliasing.values[i + 1], aliasing.values[i + 2], aliasing.values[i + 3]},
            positions.values[i + 3]};
  }
};

Frame draw(const Scene& scene, const Camera& camera, const PlanOptions& options) {
  Renderer renderer(scene);
  Frame frame{camera, plan_for(scene, camera, glm::dvec3(0.4, -0.8, -0.3), options), {}, {}, {}};
  renderer.draw(frame.plan, camera, renderer.prepare(filters::hard));
  frame.aliasing = renderer.aliasing();
  frame.positions = renderer.positions();
  frame.normals = renderer.normals();
  return frame;
}

PlanOptions options_for(const Warp* warp, int cascades) {
  PlanOptions options;
  options.resolution.max_size = 256;
  options.cascades = cascades;
  options.warp.warp = warp;
  return options;
}

void expect_equal_to_core(const Frame& frame) {
  std::size_t compared = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Pixel pixel = frame.at(x, y);
      if (pixel.aliasing[3] < 0.0f || pixel.aliasing[0] == 0.0f) continue;
      const ShadowMap& map = frame.plan.map[static_cast<std::size_t>(pixel.aliasing[3])];
      const PointAliasing core = measure_point(map, frame.camera, pixel.point, pixel.normal);
      ASSERT_EQ(core.status, PointAliasing::Status::ok) << x << " " << y;
      const glm::dvec3 ray = frame.camera.orthographic ? glm::normalize(frame.camera.forward)
                                                       : glm::normalize(pixel.point - frame.camera.position);
      const double edge_on = 1.0 / std::abs(glm::dot(ray, pixel.normal));
      const double relative = kOperations * kUnit * (core.anisotropy + edge_on);
      ASSERT_NEAR(pixel.aliasing[0], core.m_max, core.m_max * relative) << x << " " << y;
      ASSERT_NEAR(pixel.aliasing[1], core.m_s, core.m_max * relative) << x << " " << y;
      ASSERT_NEAR(pixel.aliasing[2], core.m_t, core.m_max * relative) << x << " " << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, static_cast<std::size_t>(kSize * kSize / 3));
}

TEST(AliasingPass, equals_the_metric_of_the_core_under_every_warp) {
  for (const Warp* warp : all_warps()) {
    SCOPED_TRACE(warp->name);
    expect_equal_to_core(draw(box_on_ground(), camera_on_box(kSize, kSize), options_for(warp, 3)));
  }
}

TEST(AliasingPass, equals_the_metric_of_the_core_for_an_orthographic_camera) {
  const Camera p = camera_on_box(kSize, kSize);
  const Camera camera = orthographic_camera(p.position, p.forward, p.up, 8.0, 1.0, 0.5, 60.0, kSize, kSize);
  expect_equal_to_core(draw(box_on_ground(), camera, options_for(nullptr, 2)));
}

/// Texel coordinates of a point in a map, in double.
glm::dvec2 texel_of(const ShadowMap& map, const glm::dvec3& point) {
  const glm::dvec4 h = map.clip_from_world * glm::dvec4(point, 1.0);
  return (glm::dvec2(h) / h.w * 0.5 + 0.5) * glm::dvec2(map.width, map.height);
}

TEST(AliasingPass, is_what_neighbouring_pixels_see_in_the_map) {
  Scene ground = box_on_ground();
  for (const Warp* warp : all_warps()) {
    const Frame frame = draw(ground, camera_on_box(kSize, kSize), options_for(warp, 1));
    std::size_t compared = 0;
    for (int y = 1; y + 1 < kSize; ++y) {
      for (int x = 1; x + 1 < kSize; ++x) {
        const Pixel p = frame.at(x, y), left = frame.at(x - 1, y), right = frame.at(x + 1, y),
                    above = frame.at(x, y - 1), below = frame.at(x, y + 1);
        bool ground_only = p.aliasing[3] == 0.0f && p.aliasing[0] > 0.0f;
        for (const Pixel& q : {p, left, right, above, below})
          ground_only &= q.normal.y > 0.99 && q.point.y < 0.01;
        if (!ground_only) continue;
        const ShadowMap& map = frame.plan.map[0];
        const glm::dvec2 dx = (texel_of(map, right.point) - texel_of(map, left.point)) * 0.5;
        const glm::dvec2 dy = (texel_of(map, above.point) - texel_of(map, below.point)) * 0.5;
        const double det = std::abs(dx.x * dy.y - dx.y * dy.x);
        const double a = 0.5 * (glm::dot(dx, dx) + glm::dot(dy, dy));
        const double m_max = std::sqrt(a + std::sqrt(std::max(0.0, (a - det) * (a + det)))) / det;
        // A symmetric difference of a projective map is off by the square of the change of depth over a
        // pixel; positions carry float rounding against steps of a pixel.
        const double bend = (above.depth - below.depth) / p.depth;
        const double anisotropy = m_max * m_max * det;
        const double bound = (4.0 * bend * bend + kSize * kUnit * 8.0) * anisotropy;
        ASSERT_NEAR(p.aliasing[0], m_max, m_max * bound) << warp->name << " " << x << " " << y;
        ++compared;
      }
    }
    EXPECT_GT(compared, static_cast<std::size_t>(kSize * kSize / 4)) << warp->name;
  }
}

TEST(AliasingPass, has_no_error_where_light_only_grazes_a_surface) {
  Scene scene = empty_scene();
  add_quad(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  const Camera camera = camera_on_box(kSize, kSize);
  for (const auto& [cosine, counts] : {std::pair{0.5 * kGrazingCosine, false},
                                       {-0.5 * kGrazingCosine, false},
                                       {2.0 * kGrazingCosine, true}}) {
    Renderer renderer(scene);
    const glm::dvec3 light(std::sqrt(1.0 - cosine * cosine), -cosine, 0.0);
    renderer.draw(plan_for(scene, camera, light, options_for(&warps::none, 1)), camera,
                  renderer.prepare(filters::hard));
    const FloatImage aliasing = renderer.aliasing();
    std::size_t with_error = 0, served = 0;
    for (std::size_t i = 0; i < aliasing.values.size(); i += 4) {
      served += aliasing.values[i + 3] >= 0.0f;
      with_error += aliasing.values[i] > 0.0f;
    }
    EXPECT_GT(served, 1000u) << cosine;
    EXPECT_EQ(with_error, counts ? served : 0u) << cosine;
  }
}

TEST(AliasingPass, predicts_how_many_pixels_share_a_texel) {
  PlanOptions options = options_for(&warps::none, 1);
  options.resolution.max_size = 32;  // so few that each texel is many pixels wide
  const Frame frame = draw(box_on_ground(), camera_on_box(kSize, kSize), options);
  const ShadowMap& map = frame.plan.map[0];
  std::vector<double> pixels(static_cast<std::size_t>(map.width * map.height)), predicted(pixels.size());
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Pixel p = frame.at(x, y);
      if (p.aliasing[3] != 0.0f || p.aliasing[0] == 0.0f || p.normal.y < 0.99 || p.point.y > 0.01) continue;
      const glm::dvec2 texel = texel_of(map, p.point);
      const auto id =
          static_cast<std::size_t>(static_cast<int>(texel.y) * map.width + static_cast<int>(texel.x));
      const double area = measure_point(map, frame.camera, p.point, p.normal).m_area;
      pixels[id] += 1.0;
      predicted[id] += area * area;
    }
  }
  std::size_t compared = 0;
  for (int y = 1; y + 1 < map.height; ++y) {
    for (int x = 1; x + 1 < map.width; ++x) {
      const auto id = static_cast<std::size_t>(y * map.width + x);
      // Whole texels only: those whose neighbours are seen too.
      bool inner = pixels[id] > 8.0;
      for (const auto n : {id - 1, id + 1, id - static_cast<std::size_t>(map.width),
                           id + static_cast<std::size_t>(map.width)}) {
        inner &= pixels[n] > 8.0;
      }
      if (!inner) continue;
      const double area = predicted[id] / pixels[id];
      // A cell of this area holds as many pixel centres, give or take those along its rim.
      EXPECT_NEAR(pixels[id], area, 2.0 * std::sqrt(area) + 2.0) << x << " " << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 30u);
}

TEST(AliasingPass, is_silent_on_sky_and_on_faces_turned_from_the_light) {
  Scene scene = box_on_ground();
  Camera camera = camera_on_box(kSize, kSize);
  camera.forward = {-0.4, 0.0, -1.0};
  const Frame frame = draw(scene, camera, options_for(nullptr, 2));
  std::size_t sky = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Pixel p = frame.at(x, y);
      ASSERT_FALSE(std::isnan(p.aliasing[0]));
      if (p.depth > 0.0) continue;
      ASSERT_EQ(p.aliasing[3], -1.0f);
      ASSERT_EQ(p.aliasing[0], 0.0f);
      ++sky;
    }
  }
  EXPECT_GT(sky, 1000u);
}

}  // namespace
}  // namespace gnomon::render
