// Do shapes keep their word, and do metric, bias, selection and culling go through them? A bent shape that no
// plan makes shows the second.
#include "gnomon/extend/shape.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <iterator>
#include <limits>
#include <string>

#include "gnomon/measure.hpp"
#include "gnomon/motion.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/shader.hpp"
#include "gnomon/study/bias.hpp"
#include "support/fitted_shapes.hpp"
#include "support/near.hpp"

namespace gnomon::test {
namespace {

constexpr double kStep = 1e-5;      // of finite differences
constexpr double kRounding = 1e-8;  // of central differences with that step, of a texel count of hundreds

/// Texels crowd towards ndc x = -1, and rows lean: parameter 0 says how much, below 1/2.
ShapedPoint bend(const ShapeParameters& p, const glm::dvec2& size, const glm::dvec2& ndc) noexcept {
  const double u = ndc.x - p[0] * (ndc.x * ndc.x - 1.0),
               v = ndc.y + p[0] * (ndc.x + 1.0) * (1.0 - ndc.y * ndc.y);
  return {(glm::dvec2(u, v) * 0.5 + 0.5) * size,
          {0.5 * size.x * (1.0 - 2.0 * p[0] * ndc.x), 0.5 * size.y * p[0] * (1.0 - ndc.y * ndc.y), 0.0,
           0.5 * size.y * (1.0 - 2.0 * p[0] * (ndc.x + 1.0) * ndc.y)}};
}
/// Of all texels that are shown, which is right for any rectangle.
ShapeRectangle whole_texels(const ShapeParameters&, const glm::dvec2& size, const ShapeRectangle&) noexcept {
  return {{0.0, 0.0}, size};
}
ShapeRectangle whole_ndc(const ShapeParameters&, const glm::dvec2&, const ShapeRectangle&) noexcept {
  return {{-1.0, -1.0}, {1.0, 1.0}};
}
/// By Newton's method: the bent shape has no inverse that could be written down.
glm::dvec2 unbend(const ShapeParameters& p, const glm::dvec2& size, const glm::dvec2& texel) noexcept {
  glm::dvec2 ndc = texel / size * 2.0 - 1.0;
  for (int i = 0; i < 30; ++i) {
    const ShapedPoint at = bend(p, size, ndc);
    ndc += glm::inverse(at.texel_from_ndc) * (texel - at.texel);
  }
  return ndc;
}
ShapeParameters straight(double) noexcept {
  return {};
}
ShapeParameters as_it_is(const ShapeParameters& p, bool, bool) noexcept {
  return p;
}
const Shape kBent{"bent", "for this test", false, bend, unbend, whole_texels, whole_ndc, straight, as_it_is};

/// Every registered shape, and the bent one, as grids to look at.
std::vector<TexelGrid> grids() {
  std::vector<TexelGrid> all;
  for (const Shape* shape : all_shapes()) {
    for (const ShapeParameters& parameters : fitted_parameters(*shape, {640.0, 384.0}))
      all.push_back({640, 384, shape, parameters});
  }
  all.push_back({640, 384, &kBent, {0.2, 0.0, 0.0}});
  return all;
}

/// A warped map of a plan, its texels bent.
struct Bent {
  Camera camera = perspective_camera({0, 5, 10}, {0.1, -0.3, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 60.0, 600, 400);
  std::array<Box, 2> boxes{{{{-20, 0, -60}, {20, 1, 8}}, {{-2, 1, -20}, {2, 6, -10}}}};
  ShadowPlan plan;
  ShadowMap map;

  Bent() {
    PlanOptions options;
    options.cascades = 1;
    options.resolution.max_size = 512;
    options.filter.texels = 2;
    plan = make_plan(camera, DirectionalLight{{0.3, -1.0, 0.2}}, {boxes, boxes}, options);
    map = plan.map[0];
    map.shape = &kBent;
    map.shape_parameters = {0.2, 0.0, 0.0};
  }
  [[nodiscard]] glm::dvec2 texel(const glm::dvec3& p) const {
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
    return map.texels().place(glm::dvec2(clip) / clip.w).texel;
  }
  /// d(texel)/d(world) along `way`, by differences.
  [[nodiscard]] glm::dvec2 slope(const glm::dvec3& p, const glm::dvec3& way) const {
    return (texel(p + kStep * way) - texel(p - kStep * way)) / (2.0 * kStep);
  }
};
const std::array<glm::dvec3, 4> kPoints{{{0, 1, 0}, {-3, 0.5, -8}, {2, 1, -25}, {1, 3, -10}}};

TEST(Shape, the_registry_finds_each_by_its_name) {
  ASSERT_FALSE(all_shapes().empty());
  for (const Shape* shape : all_shapes()) {
    EXPECT_EQ(find_shape(shape->name), shape);
    EXPECT_FALSE(shape->summary.empty());
  }
  EXPECT_EQ(find_shape("bent"), nullptr);
  EXPECT_EQ(ShadowMap{}.shape, &shapes::linear);
}

TEST(Shape, linear_texels_by_hand) {
  const ShapedPoint p = TexelGrid{8, 4}.place({0.5, -0.5});
  EXPECT_EQ(p.texel, glm::dvec2(6, 1));
  EXPECT_EQ(p.texel_from_ndc, glm::dmat2(4, 0, 0, 2));
  EXPECT_TRUE(shapes::linear.affine);
}

TEST(Shape, logarithmic_texels_by_hand) {
  // w doubles from ndc y -1 to 1: where 1 / w is (1 + 1/2) / 2, the texel is the share ln(4/3) / ln 2.
  const TexelGrid grid{8, 4, &shapes::logarithmic, {std::log(2.0), 0.0, 0.0}};
  const ShapedPoint p = grid.place({0.5, 0.0});
  EXPECT_NEAR(p.texel.x, 6.0, 1e-12);
  EXPECT_NEAR(p.texel.y, 4.0 * std::log(4.0 / 3.0) / std::log(2.0), 1e-12);
  EXPECT_NEAR(p.texel_from_ndc[1][1], 2.0 * 0.5 / (std::log(2.0) * 0.75), 1e-12);
  EXPECT_FALSE(shapes::logarithmic.affine);
}

TEST(Shape, parameters_that_are_no_warp_give_linear_texels) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const double growth : {0.0, 1e-300, -1e-9, kNone}) {
    const TexelGrid grid{8, 4, &shapes::logarithmic, {growth, 0.0, 0.0}};
    for (const glm::dvec2 ndc : {glm::dvec2(-1, -1), glm::dvec2(0.5, -0.5), glm::dvec2(1, 3)}) {
      EXPECT_EQ(grid.place(ndc).texel, TexelGrid(8, 4).place(ndc).texel);
      EXPECT_EQ(grid.ndc_of(grid.place(ndc).texel), ndc);
    }
  }
  // The strongest that there is.
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  EXPECT_EQ(shapes::logarithmic.undoing(kEndless)[0], kMaxLogGrowth);
  EXPECT_EQ(shapes::logarithmic.undoing(kNone)[0], 0.0);
  const TexelGrid grid{8, 4, &shapes::logarithmic, {kEndless, 0.0, 0.0}};
  EXPECT_TRUE(std::isfinite(grid.place({0.0, 5.0}).texel.y));
}

TEST(Shape, every_place_comes_back_from_its_texel) {
  for (const TexelGrid& grid : grids()) {
    for (double x = -1.25; x <= 1.25; x += 0.125) {
      for (double y = -1.25; y <= 1.25; y += 0.125) {
        // The bent one has no inverse beyond its square.
        if (grid.shape == &kBent && (std::abs(x) > 1.0 || std::abs(y) > 1.0)) continue;
        const glm::dvec2 back = grid.ndc_of(grid.place({x, y}).texel);
        EXPECT_NEAR(back.x, x, 1e-11) << grid.shape->name;
        EXPECT_NEAR(back.y, y, 1e-11) << grid.shape->name;
      }
    }
  }
}

TEST(Shape, a_mirrored_shape_has_the_same_texels) {
  for (const Shape* shape : all_shapes()) {
    for (const ShapeParameters& p : fitted_parameters(*shape, {640.0, 384.0})) {
      const TexelGrid grid{640, 384, shape, p};
      for (const bool mirror_x : {false, true}) {
        for (const bool mirror_y : {false, true}) {
          const glm::dmat4 other(
              glm::dmat4(mirror_x ? -1 : 1, 0, 0, 0, 0, mirror_y ? -1 : 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1));
          const TexelGrid mirrored{640, 384, shape, parameters_in(other, *shape, p)};
          for (double y = -1.0; y <= 1.0; y += 0.25) {
            const glm::dvec2 ndc(0.3, y), a = grid.place(ndc).texel;
            const glm::dvec2 b = mirrored.place(ndc * glm::dvec2(mirror_x ? -1 : 1, mirror_y ? -1 : 1)).texel;
            EXPECT_NEAR(b.x, mirror_x ? 640.0 - a.x : a.x, 1e-9) << shape->name;
            EXPECT_NEAR(b.y, mirror_y ? 384.0 - a.y : a.y, 1e-9) << shape->name;
          }
        }
      }
    }
  }
}

TEST(Shape, derivatives_are_those_of_finite_differences) {
  for (const TexelGrid& grid : grids()) {
    for (double x = -0.9; x < 1.0; x += 0.3) {
      for (double y = -0.9; y < 1.0; y += 0.3) {
        const glm::dmat2 d = grid.place({x, y}).texel_from_ndc;
        for (int axis = 0; axis < 2; ++axis) {
          glm::dvec2 step(0.0);
          step[axis] = kStep;
          const glm::dvec2 slope =
              (grid.place(glm::dvec2(x, y) + step).texel - grid.place(glm::dvec2(x, y) - step).texel) /
              (2 * kStep);
          EXPECT_NEAR(d[axis].x, slope.x, kRounding * grid.width) << grid.shape->name;
          EXPECT_NEAR(d[axis].y, slope.y, kRounding * grid.width) << grid.shape->name;
        }
      }
    }
  }
}

TEST(Shape, the_square_fills_the_map_and_rectangles_hold_what_they_bound) {
  for (const TexelGrid& grid : grids()) {
    const ShapeRectangle ndc{{-0.6, -0.2}, {0.1, 0.7}};
    const ShapeRectangle texels = grid.shape->texel_bounds(grid.parameters, grid.size(), ndc);
    const ShapeRectangle back = grid.shape->ndc_bounds(grid.parameters, grid.size(), texels);
    for (double s = 0.0; s <= 1.0; s += 0.125) {
      for (double t = 0.0; t <= 1.0; t += 0.125) {
        const glm::dvec2 all = grid.place({2.0 * s - 1.0, 2.0 * t - 1.0}).texel;
        // Of a round one the square shows more than the map, so that margins are in it.
        EXPECT_TRUE(
            grid.shape->round != nullptr ||
            (all.x >= -1e-9 && all.y >= -1e-9 && all.x <= grid.width + 1e-9 && all.y <= grid.height + 1e-9));
        const glm::dvec2 at = glm::mix(ndc.low, ndc.high, glm::dvec2(s, t));
        const glm::dvec2 texel = grid.place(at).texel;
        for (int axis = 0; axis < 2; ++axis) {
          EXPECT_GE(texel[axis], texels.low[axis] - 1e-9) << grid.shape->name;
          EXPECT_LE(texel[axis], texels.high[axis] + 1e-9) << grid.shape->name;
          EXPECT_GE(at[axis], back.low[axis] - 1e-12) << grid.shape->name;
          EXPECT_LE(at[axis], back.high[axis] + 1e-12) << grid.shape->name;
        }
      }
    }
  }
}

TEST(Shape, the_metric_measures_the_bent_texels) {
  const Bent b;
  for (const glm::dvec3& p : kPoints) {
    const PointAliasing m = measure_point(b.map, b.camera, p, {0, 1, 0});
    ASSERT_EQ(m.status, PointAliasing::Status::ok);
    // On the ground: how far the ray through the next pixel moves on it, in texels.
    const glm::dvec3 ray = p - b.camera.position;
    const CameraAxes axes = camera_axes(b.camera);
    const double depth = glm::dot(ray, axes.forward);
    glm::dmat2 texels_per_pixel;
    const std::array<glm::dvec3, 2> pixel{
        axes.right * ((b.camera.right - b.camera.left) / b.camera.width * depth),
        axes.up * ((b.camera.top - b.camera.bottom) / b.camera.height * depth)};
    for (int i = 0; i < 2; ++i) {
      const glm::dvec3 way = pixel[static_cast<std::size_t>(i)];
      texels_per_pixel[i] = b.slope(p, way - ray * (way.y / ray.y));
    }
    const glm::dmat2 pixels_per_texel = glm::inverse(texels_per_pixel);
    EXPECT_NEAR(m.m_s / glm::length(pixels_per_texel[0]), 1.0, 1e-5);
    EXPECT_NEAR(m.m_t / glm::length(pixels_per_texel[1]), 1.0, 1e-5);
  }
}

TEST(Shape, biases_see_the_bent_texels) {
  const Bent b;
  const glm::dvec3 light = b.plan.light_direction;
  for (const glm::dvec3& p : kPoints) {
    const glm::dvec2 extent = texel_extent_world(b.map.clip_from_world, b.map.texels(), light, p);
    const glm::dvec3 x = glm::normalize(glm::cross(light, {0, 1, 0})), y = glm::cross(light, x);
    const glm::dvec2 along_x = b.slope(p, x), along_y = b.slope(p, y);
    const glm::dmat2 world = glm::inverse(glm::dmat2(along_x, along_y));
    EXPECT_NEAR(extent.x / glm::length(world[0]), 1.0, 1e-5);
    EXPECT_NEAR(extent.y / glm::length(world[1]), 1.0, 1e-5);
    // Along the plane, the depth changes by the gradient times the way in texels.
    const ReceiverPlane plane =
        receiver_plane({b.map.clip_from_world, b.map.texels(), light, p, glm::dvec3(0, 1, 0)});
    ASSERT_TRUE(plane.valid);
    for (const glm::dvec3 way : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)}) {
      const auto depth = [&](double s) {
        const glm::dvec4 clip = b.map.clip_from_world * glm::dvec4(p + s * way, 1.0);
        return clip.z / clip.w;
      };
      const double rise = (depth(kStep) - depth(-kStep)) / (2.0 * kStep);
      EXPECT_NEAR(glm::dot(plane.gradient, b.slope(p, way)), rise, 1e-6 * (1.0 + std::abs(rise)));
    }
  }
}

TEST(Shape, a_point_is_held_where_its_texel_is_off_the_border) {
  const Bent b;
  // Along a line through the map: held exactly where the bent texel keeps the margin.
  int held = 0, outside = 0;
  for (double s = -1.2; s <= 1.2; s += 0.01) {
    const glm::dvec4 h = glm::inverse(b.map.clip_from_world) * glm::dvec4(s, 0.3, 0.0, 1.0);
    const glm::dvec3 p = glm::dvec3(h) / h.w;
    const glm::dvec2 texel = b.texel(p);
    const double margin = b.map.filter_margin_texels;
    const double inside =
        std::min({texel.x, texel.y, b.map.width - texel.x, b.map.height - texel.y}) - margin;
    if (std::abs(inside) < 0.5) continue;             // left to rounding
    if (std::abs(s) > 1.0 && inside > 0.0) continue;  // the formula goes on beyond the square
    EXPECT_EQ(map_holds(b.plan, b.map, p), inside > 0.0) << s;
    ++(inside > 0.0 ? held : outside);
  }
  EXPECT_GT(held, 100);
  EXPECT_GT(outside, 10);
}

TEST(Shape, a_bent_map_is_never_scrolled_and_its_rectangles_hold_all_they_show) {
  const Bent b;
  PlanOptions options;
  options.cascades = 1;
  options.fit = Fit::stable;
  ShadowMap map = make_plan(b.camera, DirectionalLight{{0.3, -1.0, 0.2}}, {b.boxes, b.boxes}, options).map[0];
  ASSERT_TRUE(map.snap_key.valid);
  ShadowMap moved = map;
  moved.snap_key.x += 3;
  ASSERT_EQ(reuse(map, moved).kind, ReuseKind::scrolled);
  map.shape = moved.shape = &kBent;
  EXPECT_EQ(reuse(map, moved).kind, ReuseKind::none);
  EXPECT_EQ(reuse(map, map).kind, ReuseKind::identical);
  ShadowMap other = map;
  other.shape_parameters[0] = 0.1;
  EXPECT_EQ(reuse(map, other).kind, ReuseKind::none);
  for (const glm::dvec4& plane : rectangle_planes(b.map, {100, 200, 50, 60})) {
    for (const glm::dvec3& p : kPoints) {
      const glm::dvec2 texel = b.texel(p);
      if (texel.x < 100 || texel.y < 200 || texel.x > 150 || texel.y > 260) continue;
      EXPECT_GE(glm::dot(glm::dvec3(plane), p) + plane.w, 0.0);
    }
  }
}

TEST(Shape, shaders_get_the_place_in_the_list_and_the_parameters) {
  ShadowMap map;
  for (std::size_t i = 0; i < all_shapes().size(); ++i) {
    map.shape = all_shapes()[i];
    map.shape_parameters = {};
    for (int k = 0; k < map.shape->parameter_count; ++k)
      map.shape_parameters[static_cast<std::size_t>(k)] = k + 1;
    const glm::mat4 shape = shader_shape(map, glm::dmat4(1.0));
    EXPECT_EQ(shape[0][0], static_cast<float>(i));
    for (int k = 1; k < 16; ++k)
      EXPECT_EQ(shape[k / 4][k % 4],
                static_cast<float>(map.shape_parameters[static_cast<std::size_t>(k - 1)]));
  }
}

TEST(Shape, the_shader_library_calls_each_by_its_place) {
  std::ifstream in(GNOMON_SOURCE_DIR "/shaders/library/shape.glsl");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (const Shape* shape : all_shapes()) {
    const std::string name(shape->name);
    std::string include = "#include \"library/shape/", call = "place_";
    include.append(name).append(".glsl\"");
    call.append(name).append("(");
    EXPECT_NE(text.find(include), std::string::npos) << name;
    EXPECT_NE(text.find(call), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace gnomon::test
