// Do maps whose shape bends lines hold the depths that they should, without cracks, and do all filters read
// them?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "gnomon/extend/shape.hpp"
#include "gnomon/measure.hpp"
#include "mask_frame.hpp"
#include "support/fitted_shapes.hpp"

namespace gnomon::render {
namespace {

const glm::dvec3 kLight(0.4, -0.8, -0.3);

PlanOptions one_map(const Shape& shape, int size = 256) {
  PlanOptions options;
  options.cascades = 1;
  options.resolution.max_size = size;
  options.warp.warp = &warps::psm;
  options.warp.shape = &shape;
  options.prune = kPruneNothing;
  return options;
}

ShadowPlan bent_plan(const Scene& scene, const Camera& camera, int size = 256) {
  return plan_for(scene, camera, kLight, one_map(shapes::logarithmic, size));
}

/// Columns and rows that are narrow round two places.
ShadowPlan rectilinear(ShadowPlan plan) {
  ShadowMap& map = plan.map[0];
  map.shape = &shapes::rectilinear;
  map.shape_parameters =
      shapes::rectilinear.serving(test::needs_round(0.6, 0.3, map.filter_margin_texels)).parameters;
  return plan;
}
ShadowPlan rectilinear_plan(const Scene& scene, const Camera& camera, int size = 256) {
  return rectilinear(plan_for(scene, camera, kLight, one_map(shapes::linear, size)));
}

FloatImage depths_of(Renderer& renderer, const ShadowPlan& plan, const Camera& camera) {
  renderer.draw(plan, camera, renderer.prepare(filters::hard));
  return renderer.depth_map(0);
}

/// The same map with rows of one size, drawn as bent ones are.
ShadowPlan straight_by_rectangles(ShadowPlan plan) {
  plan.map[0].shape = &shapes::logarithmic;
  plan.map[0].shape_parameters = {};
  return plan;
}

struct Difference {
  std::size_t same = 0, covered_by_one = 0;
  double largest = 0.0;  // where both cover the texel with the same surface
};
/// `step`: depths that differ by more are of different surfaces.
Difference difference(const FloatImage& a, const FloatImage& b, double step) {
  Difference d;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double off = std::abs(static_cast<double>(a.values[i]) - b.values[i]);
    if (off > step) {
      ++d.covered_by_one;
      continue;
    }
    ++d.same;
    d.largest = std::max(d.largest, off);
  }
  return d;
}

Scene many_triangles() {
  Scene scene = empty_scene();
  // Hills of small triangles, some of them far behind the camera.
  std::vector<glm::vec3> corners;
  const auto at = [](int x, int z) {
    const float u = static_cast<float>(x) * 0.7f - 21.0f, v = static_cast<float>(z) * 0.7f - 21.0f;
    return glm::vec3(u, 0.6f * std::sin(u) * std::cos(1.3f * v), v);
  };
  for (int z = 0; z < 60; ++z) {
    for (int x = 0; x < 60; ++x) {
      for (const auto& c :
           {at(x, z), at(x, z + 1), at(x + 1, z), at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)})
        corners.push_back(c);
    }
  }
  add_mesh(scene, corners);
  add_box(scene, kBoxMin, kBoxMax);
  return scene;
}

TEST(BentMaps, linear_texels_by_rectangles_are_those_of_the_rasterizer) {
  for (const Scene& scene : {box_on_ground(), many_triangles()}) {
    const Camera camera = camera_on_box(kSize, kSize);
    Renderer renderer(scene);
    const ShadowPlan plan = plan_for(scene, camera, kLight, one_map(shapes::linear));
    ASSERT_EQ(plan.map_count, 1);
    const FloatImage own = depths_of(renderer, plan, camera);
    const FloatImage drawn = depths_of(renderer, straight_by_rectangles(plan), camera);
    const Difference d = difference(own, drawn, 0.01);
    // Rasterizers move corners by up to 1/512 of a texel: of the texels on an edge, a few hundredths change
    // sides.
    EXPECT_LT(d.covered_by_one, own.values.size() / 1000);
    EXPECT_GT(d.same, own.values.size() / 2);
    // Depth over a texel times 1/256, on slopes as steep as here.
    EXPECT_LT(d.largest, 1e-3);
    std::size_t empty = 0, empty_drawn = 0;
    for (std::size_t i = 0; i < own.values.size(); ++i) {
      empty += own.values[i] == 1.0f ? 1 : 0;
      empty_drawn += drawn.values[i] == 1.0f ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(empty), static_cast<double>(empty_drawn),
                static_cast<double>(own.values.size()) / 1000.0);
  }
}

TEST(BentMaps, hold_the_depth_of_the_ground_at_each_texels_centre) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  const ShadowPlan logarithmic = bent_plan(scene, camera);
  ASSERT_EQ(logarithmic.map[0].shape, &shapes::logarithmic);
  for (const ShadowPlan& plan : {logarithmic, rectilinear_plan(scene, camera)}) {
    ASSERT_EQ(plan.map_count, 1);
    const ShadowMap& map = plan.map[0];
    const FloatImage depth = depths_of(renderer, plan, camera);
    const glm::dmat4 world_from_clip = glm::inverse(map.clip_from_world);
    std::size_t ground = 0;
    for (int y = 0; y < depth.height; ++y) {
      for (int x = 0; x < depth.width; ++x) {
        const glm::dvec2 ndc = map.texels().ndc_of({x + 0.5, y + 0.5});
        const auto at = [&](double z) {
          const glm::dvec4 h = world_from_clip * glm::dvec4(ndc, z, 1.0);
          return glm::dvec3(h) / h.w;
        };
        const glm::dvec3 a = at(-1.0), b = at(1.0), p = a + (b - a) * (a.y / (a.y - b.y));
        const glm::dvec4 h = map.clip_from_world * glm::dvec4(p, 1.0);
        const double expected = 0.5 * h.z / h.w + 0.5;
        if (std::max(std::abs(p.x), std::abs(p.z)) > 19.0 || expected > 0.999) continue;
        const glm::dvec3 rim(0.2);
        if (hits_box(p, -plan.light_direction, glm::dvec3(kBoxMin) - rim, glm::dvec3(kBoxMax) + rim))
          continue;
        // Positions, the matrix and the shape's inverse in single precision.
        ASSERT_NEAR(depth.values[static_cast<std::size_t>(y * depth.width + x)], expected, 2e-5)
            << x << " " << y;
        ++ground;
      }
    }
    EXPECT_GT(ground, 20'000u) << map.shape->name;
  }
}

TEST(BentMaps, leave_no_crack_between_triangles) {
  Scene scene = empty_scene();
  // A plane of triangles of all sizes, turned so that no edge runs along the texels.
  std::vector<glm::vec3> corners;
  const glm::vec3 centre(0.37f, 0.0f, -1.21f);
  for (int i = 0; i < 720; ++i) {
    const auto rim = [&](int k) {
      const float angle = static_cast<float>(k) * 6.2831853f / 720.0f;
      return k % 720 == 0 ? glm::vec3(60.0f, 0.0f, 0.0f)
                          : glm::vec3(60.0f * std::cos(angle), 0.0f, 60.0f * std::sin(angle));
    };
    corners.insert(corners.end(), {centre, rim(i + 1), rim(i)});
  }
  add_mesh(scene, corners);
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  const ShadowPlan logarithmic = bent_plan(scene, camera, 1024);
  ASSERT_EQ(logarithmic.map[0].shape, &shapes::logarithmic);
  for (const ShadowPlan& plan : {logarithmic, rectilinear_plan(scene, camera, 1024)}) {
    ASSERT_EQ(plan.map_count, 1);
    const FloatImage depth = depths_of(renderer, plan, camera);
    const glm::dmat4 world_from_clip = glm::inverse(plan.map[0].clip_from_world);
    std::size_t inside = 0, holes = 0;
    for (int y = 0; y < depth.height; ++y) {
      for (int x = 0; x < depth.width; ++x) {
        const glm::dvec2 ndc = plan.map[0].texels().ndc_of({x + 0.5, y + 0.5});
        const glm::dvec4 h = world_from_clip * glm::dvec4(ndc, 0.0, 1.0);
        const glm::dvec3 a = glm::dvec3(h) / h.w;
        const glm::dvec3 p = a - plan.light_direction * (a.y / plan.light_direction.y);
        const glm::dvec4 at = plan.map[0].clip_from_world * glm::dvec4(p, 1.0);
        if (glm::length(p) > 58.0 || std::abs(at.z / at.w) > 0.999) continue;
        ++inside;
        holes += depth.values[static_cast<std::size_t>(y * depth.width + x)] == 1.0f ? 1 : 0;
      }
    }
    EXPECT_GT(inside, 500'000u) << plan.map[0].shape->name;
    EXPECT_EQ(holes, 0u) << plan.map[0].shape->name;
  }
}

TEST(BentMaps, a_caster_that_crosses_the_centre_of_projection_is_drawn_where_it_is) {
  Scene scene = box_on_ground();
  // A roof from far behind the camera, where w is below 0, to before it.
  add_quad(scene, {-300.0f, 6.0f, -4.0f}, {600.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 900.0f});
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  const ShadowPlan plan = bent_plan(scene, camera);
  ASSERT_EQ(plan.map[0].shape, &shapes::logarithmic);
  const glm::dvec4 behind = plan.map[0].clip_from_world * glm::dvec4(0.0, 6.0, 896.0, 1.0);
  ASSERT_LT(behind.w, 0.0);
  const Frame frame = draw(renderer, camera, plan, filters::hard);
  std::size_t dark = 0, wrong = 0, judged = 0;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    if (!frame.surface(i) || frame.point(i).y > 0.01) continue;
    const glm::dvec3 p = frame.point(i), to_light = -plan.light_direction,
                     above = p + to_light * (6.0 / to_light.y);
    const bool roofed = above.z > -4.0, boxed = hits_box(p, to_light, kBoxMin, kBoxMax);
    ++judged;
    dark += roofed || boxed ? 1 : 0;
    wrong += (frame.lit(i) < 0.5f) != (roofed || boxed) ? 1 : 0;
  }
  EXPECT_GT(dark, judged / 10);
  EXPECT_LT(wrong, judged / 50);
}

TEST(BentMaps, masks_cut_holes) {
  // A board whose left half is there.
  Scene scene = box_on_ground();
  scene.images.push_back({"half", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}});
  Material board;
  board.alpha_mode = AlphaMode::mask;
  board.alpha_cutoff = 0.5f;
  board.base_color_image = static_cast<int>(scene.images.size()) - 1;
  board.wrap_u = board.wrap_v = TextureWrap::clamp_to_edge;
  const int material = add_material(scene, board);
  add_quad(scene, {-6.0f, 5.0f, -8.0f}, {12.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 4.0f}, material);
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  const ShadowPlan linear = plan_for(scene, camera, kLight, one_map(shapes::linear));
  const FloatImage own = depths_of(renderer, linear, camera);
  const FloatImage drawn = depths_of(renderer, straight_by_rectangles(linear), camera);
  const Difference d = difference(own, drawn, 0.01);
  EXPECT_LT(d.covered_by_one, own.values.size() / 500);
  // The board is seen by the light at all: without it the depths are others.
  const FloatImage without = [&] {
    Renderer bare(box_on_ground());
    return depths_of(bare, straight_by_rectangles(linear), camera);
  }();
  EXPECT_GT(difference(drawn, without, 0.01).covered_by_one, own.values.size() / 500);
}

TEST(BentMaps, every_clip_space_draws_the_same_shadows) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  std::vector<float> reference;
  for (const ClipSpace space : {kOpenGl, kOpenGlZeroToOne, kVulkan}) {
    PlanOptions options = one_map(shapes::logarithmic);
    options.clip_space = space;
    const ShadowPlan plan = plan_for(scene, camera, kLight, options);
    ASSERT_EQ(plan.map[0].shape, &shapes::logarithmic);
    const Frame frame = draw(renderer, camera, plan, filters::hard);
    if (reference.empty()) reference = frame.mask.values;
    std::size_t other = 0;
    for (std::size_t i = 0; i < reference.size(); i += 2)
      other += reference[i] != frame.mask.values[i] ? 1 : 0;
    EXPECT_LT(other, reference.size() / 2000);
  }
}

/// Pixels of the ground that a spot's map decides otherwise than rays do, of all; at least `dark` in shadow.
double wrong_under(const SpotLight& spot, const Shape& shape, double dark_at_least) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  const std::vector<Box> boxes = boxes_of(scene);
  PlanOptions options = one_map(shape, 512);
  if (shape.round != nullptr) options.warp.warp = &warps::none;
  const ShadowPlan plan = make_plan(camera, spot, {boxes, boxes}, options);
  EXPECT_EQ(plan.map_count, 1);
  EXPECT_EQ(plan.map[0].shape, &shape);
  Renderer renderer(scene);
  const Light light = spot;
  FrameOptions frame_options;
  frame_options.light = &light;
  const Frame frame = draw(renderer, camera, plan, default_settings(filters::hard), frame_options);
  std::size_t dark = 0, wrong = 0, judged = 0;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    const glm::dvec3 p = frame.point(i);
    if (!frame.surface(i) || p.y > 0.01 || frame.map(i) < 0) continue;
    const bool shadowed = hits_box(p, glm::normalize(spot.position - p), kBoxMin, kBoxMax);
    ++judged;
    dark += shadowed ? 1 : 0;
    wrong += (frame.lit(i) < 0.5f) != shadowed ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(dark), dark_at_least * static_cast<double>(judged));
  return static_cast<double>(wrong) / static_cast<double>(judged);
}

TEST(BentMaps, a_spot_light_has_its_shadows) {
  EXPECT_LT(wrong_under({{8.0, 9.0, 3.0}, {-1.0, -1.0, -0.4}, 0.7, 60.0}, shapes::logarithmic, 0.01), 0.02);
}

TEST(BentMaps, a_wide_spot_light_has_sharper_shadows_on_a_paraboloid) {
  const SpotLight wide{{3.0, 6.0, 2.0}, {0.0, -1.0, 0.0}, 1.15, 60.0};
  const double round = wrong_under(wide, shapes::paraboloid, 0.005);
  EXPECT_LT(round, 0.02);
  EXPECT_LT(round, 0.8 * wrong_under(wide, shapes::linear, 0.005));
}

TEST(BentMaps, every_filter_reads_them) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  const auto error_with = [&](const ShadowPlan& plan, const Filter& filter) {
    const Frame frame = draw(renderer, camera, plan, filter);
    double sum = 0.0;
    std::size_t judged = 0;
    for (std::size_t i = 0; i < frame.pixels(); ++i) {
      if (!frame.surface(i) || glm::dot(frame.normal(i), plan.light_direction) > -0.1) continue;
      const double truth =
          frame.point(i).y < 0.01 && hits_box(frame.point(i), -plan.light_direction, kBoxMin, kBoxMax) ? 0.0
                                                                                                       : 1.0;
      sum += std::abs(frame.lit(i) - truth);
      ++judged;
    }
    EXPECT_GT(judged, frame.pixels() / 2);
    return sum / static_cast<double>(judged);
  };
  for (const Filter* filter : all_filters()) {
    const auto plan_of = [&](const Shape& shape) {
      PlanOptions options = one_map(shape, 512);
      set_margin(default_settings(*filter), options);
      const ShadowPlan plan = plan_for(scene, camera, kLight, options);
      EXPECT_EQ(plan.map[0].shape, &shape);
      return plan;
    };
    const ShadowPlan straight = plan_of(shapes::linear);
    const double linear = error_with(straight, *filter);
    for (const ShadowPlan& plan : {plan_of(shapes::logarithmic), rectilinear(straight)}) {
      const double bent = error_with(plan, *filter);
      // Penumbras of the default kernels; texels near the box are larger or smaller than the linear ones.
      EXPECT_LT(bent, 0.06) << filter->info.name << " " << plan.map[0].shape->name;
      EXPECT_LT(bent, 2.0 * linear + 0.01) << filter->info.name << " " << plan.map[0].shape->name;
    }
  }
}

TEST(BentMaps, a_plane_is_lit_where_texels_of_several_lengths_meet) {
  // Depths change from texel to texel by more than the bias covers: it is capped at less than this slope.
  const glm::dvec3 light(8.0, -1.0, 2.4);
  Scene scene = empty_scene();
  add_quad(scene, {-20.0f, 0.0f, 20.0f}, {40.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -40.0f});
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  // Those that compare texel by texel, and pcf by the hardware's comparison.
  std::vector<FilterSettings> compared{default_settings(filters::pcf)};
  compared[0].radius = 0.0;
  for (const Filter* filter : all_filters()) {
    if (filter->info.reads == MapRead::depth) compared.push_back(default_settings(*filter));
  }
  for (const FilterSettings& settings : compared) {
    // Of 8 texels to a piece, or of 32 for wide kernels: a way of more than a piece is not followed exactly.
    PlanOptions options = one_map(shapes::linear, settings.radius > 4.0 ? 256 : 64);
    set_margin(settings, options);
    ShadowPlan plan = plan_for(scene, camera, light, options);
    // Every other piece has texels a twelfth as long as its neighbours'.
    ShadowMap& map = plan.map[0];
    map.shape = &shapes::rectilinear;
    for (std::size_t i = 0; i < 7; i += 2) map.shape_parameters[i] = map.shape_parameters[7 + i] = -0.105;
    map.shape_parameters[14] = map.filter_margin_texels;
    const Frame frame = draw(renderer, camera, plan, settings);
    std::size_t judged = 0, dark = 0;
    for (std::size_t i = 0; i < frame.pixels(); ++i) {
      if (!frame.surface(i) || frame.map(i) < 0) continue;
      ++judged;
      dark += frame.lit(i) < 1.0f - kWeightRounding ? 1 : 0;
    }
    EXPECT_GT(judged, frame.pixels() / 2);
    EXPECT_EQ(dark, 0u) << settings.filter->info.name << " radius " << settings.radius;
  }
}

TEST(BentMaps, the_error_along_the_view_is_the_same_in_every_pixel) {
  // Through a lens of six degrees: m counts pixels beside the view axis by their obliquity, which no map
  // evens out.
  Scene scene = empty_scene();
  add_quad(scene, {-400.0f, 0.0f, 10.0f}, {800.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -3000.0f});
  add_box(scene, {-1.0f, 0.0f, -120.0f}, {1.0f, 1.0f, -118.0f});
  const Camera camera =
      perspective_camera({0.0, 2.0, 8.0}, {0, 0, -1}, {0, 1, 0}, 0.1, 1.0, 10.0, 2000.0, kSize, kSize);
  PlanOptions options = one_map(shapes::logarithmic, 1024);
  options.filter.texels = 0.0;
  const ShadowPlan plan = plan_for(scene, camera, {0, -1, 0}, options);
  ASSERT_EQ(plan.map_count, 1);
  ASSERT_EQ(plan.map[0].shape, &shapes::logarithmic);
  Renderer renderer(scene);
  const Frame frame = draw(renderer, camera, plan, filters::hard);
  double least = 1e300, most = 0.0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    if (!frame.surface(i) || frame.point(i).y > 0.01) continue;
    const PointAliasing a = measure_perspective(plan.map[0], camera, frame.point(i));
    if (a.status != PointAliasing::Status::ok) continue;
    least = std::min(least, a.m_t);
    most = std::max(most, a.m_t);
    ++pixels;
  }
  EXPECT_GT(pixels, frame.pixels() / 4);
  EXPECT_LT(most, 1.01 * least);
}

}  // namespace
}  // namespace gnomon::render
