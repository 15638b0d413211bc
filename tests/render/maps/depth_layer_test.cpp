// Do the layers store the surfaces that rays along the texels find, and do filters read them as they are?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <set>
#include <string>

#include "filter/filter_block.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/study/bias.hpp"
#include "gnomon/trace/tracer.hpp"
#include "mask_frame.hpp"
#include "shared_context.hpp"

namespace gnomon::render {
namespace {

constexpr double kNone = 1.0;  ///< depth where there is no surface
/// As in depth_test.cpp: vertices are moved to the nearest 1/256 of a texel, and depths are rounded.
constexpr double kSnapTexels = 2.0 / 512.0, kDepthRounding = 4.0 / 16777216.0;

class DepthLayers : public testing::Test {
 protected:
  void SetUp() override { (void)shared_context(); }
};

FrameOptions frame_of(DepthLayer layer) {
  FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  options.depth_layer = layer;
  return options;
}

Scene single_sided() {
  Scene scene = empty_scene();
  scene.materials[0].double_sided = false;
  return scene;
}

void add_turned_box(Scene& scene, const glm::dvec3& middle, double angle, const glm::dvec3& half,
                    bool mirrored) {
  const glm::dmat4 turned =
      glm::rotate(glm::translate(glm::dmat4(1.0), middle), angle, glm::dvec3(0.3, 1.0, 0.2));
  const glm::dvec3 scale = mirrored ? glm::dvec3(-half.x, half.y, half.z) : half;
  add_mesh(scene, box_triangles({-1, -1, -1}, {1, 1, 1}), glm::scale(turned, scale), 0, mirrored);
}

/// Closed boxes over an open ground, one over another, one of them a mirror image.
Scene solids() {
  Scene scene = single_sided();
  add_quad(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  add_turned_box(scene, {-3, 2, 0}, 0.4, {1.5, 1.0, 1.2}, false);
  add_turned_box(scene, {3, 2.5, 1}, 1.1, {1.0, 1.3, 1.6}, true);
  add_turned_box(scene, {-2.5, 5, 0.5}, 0.8, {0.8, 0.4, 0.9}, false);
  return scene;
}

PlanOptions one_map(const char* warp, int size = 128) {
  PlanOptions options;
  options.resolution.max_size = size;
  options.cascades = 1;
  options.warp.warp = find_warp(warp);
  options.prune = kPruneNothing;
  return options;
}

ShadowPlan planned(const Scene& scene, const Camera& camera, const Light& light, const PlanOptions& options) {
  const std::vector<Box> boxes = boxes_of(scene);
  return make_plan(camera, light, {boxes, boxes}, options);
}

FloatImage depths(Renderer& renderer, const ShadowPlan& plan, const Camera& camera,
                  const FrameOptions& options) {
  renderer.draw(plan, camera, renderer.prepare(filters::hard), options);
  return renderer.depth_map(0);
}

/// Two surfaces that a ray meets, and their depths in the map.
struct TwoHits {
  std::array<std::uint32_t, 2> triangle{trace::kNoTriangle, trace::kNoTriangle};
  std::array<double, 2> depth{kNone, kNone};
};

/// Along the light's ray through a place of the map, in texels.
TwoHits hits_along(const trace::Tracer& tracer, const ShadowMap& map, const glm::dmat4& world_from_clip,
                   const glm::dvec2& texel) {
  const glm::dvec2 ndc(texel.x / map.width * 2.0 - 1.0, texel.y / map.height * 2.0 - 1.0);
  const auto at = [&](double z) {
    const glm::dvec4 h = world_from_clip * glm::dvec4(ndc, z, 1.0);
    return glm::dvec3(h) / h.w;
  };
  trace::Ray ray;
  ray.origin = at(-1.0);
  ray.direction = at(1.0) - ray.origin;
  ray.end = 1.0;
  TwoHits hits;
  for (std::size_t i = 0; i < 2; ++i) {
    const trace::Hit hit = tracer.first_hit(ray);
    if (hit.triangle == trace::kNoTriangle) break;
    const glm::dvec4 h = map.clip_from_world * glm::dvec4(ray.origin + hit.t * ray.direction, 1.0);
    hits.triangle[i] = hit.triangle;
    hits.depth[i] = 0.5 * h.z / h.w + 0.5;
    ray.begin = hit.t;
    ray.except = hit.triangle;
  }
  return hits;
}

/// The hits of a texel that no edge is near, and how far its depths may be off.
struct CertainTexel {
  TwoHits hits;
  double bound = kDepthRounding;
};

std::optional<CertainTexel> certain_texel(const trace::Tracer& tracer, const ShadowMap& map,
                                          const glm::dmat4& world_from_clip, int x, int y) {
  const glm::dvec2 centre(x + 0.5, y + 0.5);
  CertainTexel texel{hits_along(tracer, map, world_from_clip, centre)};
  constexpr double kStep = 0.25;
  for (const glm::dvec2 axis : {glm::dvec2(kStep, 0.0), glm::dvec2(0.0, kStep)}) {
    for (const double sign : {-1.0, 1.0}) {
      const TwoHits near = hits_along(tracer, map, world_from_clip, centre + sign * axis);
      if (near.triangle != texel.hits.triangle) return std::nullopt;
      for (std::size_t i = 0; i < 2; ++i) {
        const double slope = std::abs(near.depth[i] - texel.hits.depth[i]) / kStep;
        texel.bound += slope * kSnapTexels;
        // A surface that the far plane cuts beside the texel.
        if (near.depth[i] + slope >= 1.0 && near.depth[i] < 1.0) return std::nullopt;
      }
    }
  }
  return texel;
}

TEST_F(DepthLayers, registry_names_each_layer_once) {
  std::set<std::string_view> names;
  for (const DepthLayerInfo& info : depth_layers()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_EQ(find_depth_layer(info.name), &info);
    EXPECT_EQ(&info_of(info.layer), &info);
    EXPECT_FALSE(info.what.empty());
    EXPECT_FALSE(info.source.empty());
  }
  EXPECT_EQ(find_depth_layer("fronts"), nullptr);
  EXPECT_EQ(find_depth_layer(""), nullptr);
  EXPECT_EQ(info_of(static_cast<DepthLayer>(200)).layer, DepthLayer::front);
}

TEST_F(DepthLayers, layers_of_two_depths_by_hand) {
  EXPECT_EQ(depth_of_layer(DepthLayer::front, 0.25, 0.75, 0.0, 0.1), 0.25);
  EXPECT_EQ(depth_of_layer(DepthLayer::second, 0.25, 0.75, 0.0, 0.1), 0.75);
  EXPECT_EQ(depth_of_layer(DepthLayer::midpoint, 0.25, 0.75, 0.0, 0.1), 0.5);
  EXPECT_EQ(depth_of_layer(DepthLayer::dual, 0.25, 0.75, 0.0, 0.125), 0.375);
  EXPECT_EQ(depth_of_layer(DepthLayer::dual, 0.25, 0.375, 0.0, 0.125), 0.3125);
  // With far = 4 near, depth is (1 - 1 / t) * 4 / 3 at t times the near distance: 0.8 half way, at 2.5.
  EXPECT_NEAR(depth_of_layer(DepthLayer::midpoint, 0.0, 1.0 - 1e-15, 3.0, 0.0), 0.8, 1e-14);
}

TEST_F(DepthLayers, layers_without_a_second_surface_keep_the_first) {
  for (const double first : {0.0, 0.4, 1.0}) {
    EXPECT_EQ(depth_of_layer(DepthLayer::second, first, kNone, 7.0, 0.1), first);
    EXPECT_EQ(depth_of_layer(DepthLayer::midpoint, first, kNone, 7.0, 0.1), first);
  }
  EXPECT_DOUBLE_EQ(depth_of_layer(DepthLayer::dual, 0.4, kNone, 0.0, 0.1), 0.5);
  EXPECT_EQ(depth_of_layer(DepthLayer::dual, 0.95, kNone, 0.0, 0.1), 1.0);
  EXPECT_EQ(depth_of_layer(DepthLayer::dual, kNone, kNone, 0.0, 0.1), kNone);
}

TEST_F(DepthLayers, maps_hold_what_rays_along_the_texels_find) {
  const Scene scene = solids();
  const trace::Tracer tracer(scene, trace::Engine::own);
  const Camera camera = camera_on_box(64, 64);
  Renderer renderer(scene);
  const Light lights[] = {DirectionalLight{kSlant}, SpotLight{{4, 12, 6}, {-0.35, -1, -0.5}, 0.6, 40.0}};
  for (const Light& light : lights) {
    for (const char* warp : {"none", "optimal"}) {
      const ShadowPlan plan = planned(scene, camera, light, one_map(warp));
      ASSERT_EQ(plan.map_count, 1);
      const ShadowMap& map = plan.map[0];
      const double curve = depth_curve(plan, map);
      EXPECT_EQ(curve > 0.0, light.index() != 0);
      const glm::dmat4 world_from_clip = glm::inverse(map.clip_from_world);
      const double limit = 4.0 * std::max(map.texel_world.x, map.texel_world.y) / map.depth_range_world;
      std::array<FloatImage, kDepthLayerCount> drawn;
      for (const DepthLayerInfo& info : depth_layers())
        drawn[static_cast<std::size_t>(info.layer)] = depths(renderer, plan, camera, frame_of(info.layer));
      std::size_t solid = 0, open = 0, wrong = 0;
      for (int y = 1; y + 1 < map.height; ++y) {
        for (int x = 1; x + 1 < map.width; ++x) {
          const std::optional<CertainTexel> texel = certain_texel(tracer, map, world_from_clip, x, y);
          if (!texel) continue;
          const auto [first, second] = texel->hits.depth;
          const bool on_ground = texel->hits.triangle[0] < 2;  // the quad comes first
          ++(second < 1.0 ? solid : open);
          for (const DepthLayerInfo& info : depth_layers()) {
            const double expected = info.layer == DepthLayer::back
                                        ? (on_ground ? kNone : second)
                                        : depth_of_layer(info.layer, first, second, curve, limit);
            const double stored = drawn[static_cast<std::size_t>(info.layer)]
                                      .values[static_cast<std::size_t>(y * map.width + x)];
            // The step between depths and distances magnifies rounding by no more than the curve's slope.
            const double bound = texel->bound + (info.peels ? 4.0 * (1.0 + curve) * kDepthRounding : 0.0);
            if (std::abs(stored - expected) > bound && ++wrong < 5)
              ADD_FAILURE() << info.name << " at " << x << ", " << y << " under " << warp << ": " << stored
                            << " is not " << expected << " (of " << first << " and " << second << ")";
          }
        }
      }
      EXPECT_EQ(wrong, 0u);
      EXPECT_GT(solid, 200u);
      EXPECT_GT(open, 500u);
    }
  }
}

TEST_F(DepthLayers, back_faces_are_found_in_every_clip_space) {
  const Scene scene = solids();
  const Camera camera = camera_on_box(64, 64);
  Renderer renderer(scene);
  PlanOptions options = one_map("none");
  options.clip_space = {};
  const FloatImage usual = depths(renderer, planned(scene, camera, DirectionalLight{kSlant}, options), camera,
                                  frame_of(DepthLayer::back));
  EXPECT_GT(std::count_if(usual.values.begin(), usual.values.end(), [](float d) { return d < 1.0f; }), 200);
  for (const bool reversed : {false, true}) {
    for (const Handedness hand : {Handedness::right, Handedness::left}) {
      options.clip_space.reversed_z = reversed;
      options.clip_space.handedness = hand;
      const FloatImage other = depths(renderer, planned(scene, camera, DirectionalLight{kSlant}, options),
                                      camera, frame_of(DepthLayer::back));
      ASSERT_EQ(other.values.size(), usual.values.size());
      std::size_t differ = 0;
      for (std::size_t i = 0; i < usual.values.size(); ++i)
        differ += std::abs(other.values[i] - usual.values[i]) > 1e-5f;
      // Matrices of other spaces are rounded otherwise: texels on an edge fall to either side.
      EXPECT_LE(differ, usual.values.size() / 500) << reversed << static_cast<int>(hand);
    }
  }
}

TEST_F(DepthLayers, sheets_have_one_depth_in_every_layer) {
  // A double-sided leaf over a single-sided ground: its own second surface.
  Scene scene = single_sided();
  add_quad(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  Material leaf;
  leaf.double_sided = true;
  Material cut;  // single-sided, but masked
  cut.alpha_mode = AlphaMode::mask;
  cut.alpha_cutoff = 0.5f;
  add_quad(scene, {-4, 2, 2}, {3, 0, 0}, {0, 1, -3}, add_material(scene, leaf));
  // Turned away from the light.
  add_quad(scene, {1, 2, -1}, {3, 0, 0}, {0, -1, 3}, add_material(scene, cut));
  const Camera camera = camera_on_box(64, 64);
  Renderer renderer(scene);
  const ShadowPlan plan = planned(scene, camera, DirectionalLight{kSlant}, one_map("none"));
  const FloatImage front = depths(renderer, plan, camera, frame_of(DepthLayer::front));
  // Where the sheets are: the map with them alone.
  for (const DepthLayer layer :
       {DepthLayer::back, DepthLayer::second, DepthLayer::midpoint, DepthLayer::dual}) {
    const FloatImage image = depths(renderer, plan, camera, frame_of(layer));
    std::size_t sheets = 0, differ = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const auto i = static_cast<std::size_t>(y * image.width + x);
        const glm::dvec4 h =
            glm::inverse(plan.map[0].clip_from_world) * glm::dvec4((x + 0.5) / image.width * 2.0 - 1.0,
                                                                   (y + 0.5) / image.height * 2.0 - 1.0,
                                                                   2.0 * front.values[i] - 1.0, 1.0);
        if (h.y / h.w < 0.5) continue;  // ground
        ++sheets;
        differ += std::abs(image.values[i] - front.values[i]) > kDepthRounding;
      }
    }
    EXPECT_GT(sheets, 300u);
    EXPECT_EQ(differ, 0u) << info_of(layer).name;
  }
}

TEST_F(DepthLayers, a_lone_sheet_and_an_empty_scene_are_drawn) {
  Scene sheet = single_sided();
  add_quad(sheet, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  const Scene nothing = single_sided();
  const Camera camera = camera_on_box(32, 32);
  Renderer of_sheet(sheet), of_nothing(nothing);
  const ShadowPlan plan = planned(sheet, camera, DirectionalLight{kSlant}, one_map("none", 64));
  const FloatImage front = depths(of_sheet, plan, camera, frame_of(DepthLayer::front));
  ASSERT_LT(*std::min_element(front.values.begin(), front.values.end()), 1.0f);
  for (const DepthLayerInfo& info : depth_layers()) {
    const FloatImage image = depths(of_sheet, plan, camera, frame_of(info.layer));
    const bool same = image.values == front.values;
    EXPECT_EQ(same, info.layer != DepthLayer::back && info.layer != DepthLayer::dual) << info.name;
    if (info.layer == DepthLayer::back) {
      EXPECT_EQ(*std::min_element(image.values.begin(), image.values.end()), 1.0f);
    }
    // A plan of another scene: its maps are empty.
    const FloatImage empty = depths(of_nothing, plan, camera, frame_of(info.layer));
    EXPECT_EQ(*std::min_element(empty.values.begin(), empty.values.end()), 1.0f) << info.name;
    of_nothing.draw(ShadowPlan{}, camera, of_nothing.prepare(filters::hard), frame_of(info.layer));
  }
}

TEST_F(DepthLayers, limits_that_are_no_lengths_count_as_zero) {
  const Scene scene = solids();
  const Camera camera = camera_on_box(32, 32);
  Renderer renderer(scene);
  const ShadowPlan plan = planned(scene, camera, DirectionalLight{kSlant}, one_map("none", 64));
  const FloatImage front = depths(renderer, plan, camera, frame_of(DepthLayer::front));
  for (const double limit : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    FrameOptions options = frame_of(DepthLayer::dual);
    options.dual_limit_texels = limit;
    const FloatImage image = depths(renderer, plan, camera, options);
    for (std::size_t i = 0; i < image.values.size(); ++i)
      ASSERT_NEAR(image.values[i], front.values[i], kDepthRounding) << limit;
  }
}

TEST_F(DepthLayers, maps_of_another_layer_are_not_reused) {
  const Scene scene = solids();
  const Camera camera = camera_on_box(32, 32);
  Renderer renderer(scene);
  const ShadowPlan plan = planned(scene, camera, DirectionalLight{kSlant}, one_map("none", 64));
  std::array<FloatImage, kDepthLayerCount> once;
  for (const DepthLayerInfo& info : depth_layers()) {
    Renderer fresh(scene);
    once[static_cast<std::size_t>(info.layer)] = depths(fresh, plan, camera, frame_of(info.layer));
  }
  for (const DepthLayerInfo& before : depth_layers()) {
    for (const DepthLayerInfo& after : depth_layers()) {
      (void)depths(renderer, plan, camera, frame_of(before.layer));
      const FloatImage image = depths(renderer, plan, camera, frame_of(after.layer));
      EXPECT_EQ(image.values, once[static_cast<std::size_t>(after.layer)].values)
          << before.name << ", then " << after.name;
    }
  }
}

TEST_F(DepthLayers, unchanged_maps_are_held_and_changed_ones_are_peeled_again) {
  Scene scene = solids();
  const Camera camera = camera_on_box(32, 32);
  Renderer renderer(scene);
  const PreparedFilter hard = renderer.prepare(filters::hard);
  const FrameOptions options = frame_of(DepthLayer::midpoint);
  ShadowPlan plan = planned(scene, camera, DirectionalLight{kSlant}, one_map("none", 64));
  renderer.draw(plan, camera, hard, options);
  EXPECT_TRUE(renderer.draw(plan, camera, hard, options).map[0].held);
  Instance moved = scene.instances[1];
  moved.world_from_object[3] += glm::dvec4(0.7, 0.3, 0.0, 0.0);
  moved.bounds_world = {moved.bounds_world.min + glm::dvec3(0.7, 0.3, 0.0),
                        moved.bounds_world.max + glm::dvec3(0.7, 0.3, 0.0)};
  ASSERT_TRUE(renderer.move_instance(1, moved));
  scene.instances[1] = moved;
  Renderer fresh(scene);
  EXPECT_EQ(depths(renderer, plan, camera, options).values, depths(fresh, plan, camera, options).values);
  // A caster that comes into the plan's reach while the map stays: a held map that only took it in would be
  // wrong.
  ShadowPlan narrow = plan;
  narrow.map[0].cull_plane_count = 1;
  narrow.map[0].cull_planes[0] = {1.0, 0.0, 0.0, -1.0};  // x >= 1: the right box and the ground
  FrameOptions culled = options;
  culled.prune = default_prune_rules();
  (void)depths(renderer, narrow, camera, culled);
  EXPECT_EQ(depths(renderer, plan, camera, culled).values, depths(fresh, plan, camera, culled).values);
}

/// What the adaptive bias on the CPU says of a pixel; nothing where
/// rounding decides.
std::optional<bool> lit_by_adaptive_bias(const Frame& frame, std::size_t pixel, const Light& light,
                                         const FloatImage& depth) {
  const ShadowMap& map = frame.plan.map[0];
  const glm::dvec3 point = frame.point(pixel);
  const auto* spot = std::get_if<SpotLight>(&light);
  const glm::dvec3 way =
      glm::normalize(spot != nullptr ? point - spot->position : frame.plan.light_direction);
  const Receiver receiver{map.clip_from_world, map.texels(), way, point, frame.normal(pixel)};
  const glm::dvec2 texel_world = texel_extent_world(map.clip_from_world, map.texels(), way, point);
  const double epsilon = frame.plan.bias.constant_texels * std::max(texel_world.x, texel_world.y);
  const glm::dvec4 h = map.clip_from_world * glm::dvec4(point, 1.0);
  const glm::dvec2 texel = (glm::dvec2(h) / h.w * 0.5 + 0.5) * glm::dvec2(map.width, map.height);
  const glm::dvec2 cell = glm::floor(texel), inside = texel - cell;
  constexpr double kBorder = 0.01, kDepth = 1e-5;
  const bool on_border = std::min({inside.x, inside.y, 1.0 - inside.x, 1.0 - inside.y}) < kBorder;
  if (on_border || cell.x < 0.0 || cell.y < 0.0 || cell.x >= map.width || cell.y >= map.height)
    return std::nullopt;
  const double biased = 0.5 * (h.z / h.w + adaptive_bias_ndc(receiver, epsilon)) + 0.5;
  const double stored = depth.values[static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(map.width) +
                                     static_cast<std::size_t>(cell.x)];
  if (std::abs(biased - stored) < kDepth) return std::nullopt;
  return biased <= stored;
}

TEST_F(DepthLayers, the_hard_filter_without_slope_bias_is_the_adaptive_bias_of_the_cpu) {
  const Scene scene = solids();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  const Light lights[] = {DirectionalLight{kSlant}, SpotLight{{4, 12, 6}, {-0.35, -1, -0.5}, 0.6, 40.0}};
  for (const Light& light : lights) {
    for (const char* warp : {"none", "optimal"}) {
      PlanOptions options = one_map(warp);
      options.bias = {0.05, 0.0, 0.0, 8.0};
      const ShadowPlan plan = planned(scene, camera, light, options);
      const Frame frame =
          render::draw(renderer, camera, plan, default_settings(filters::hard), frame_of(DepthLayer::front));
      const FloatImage depth = renderer.depth_map(0);
      FrameOptions own_depth = frame_of(DepthLayer::front);
      own_depth.receiver_plane = false;
      const Frame without = render::draw(renderer, camera, plan, default_settings(filters::hard), own_depth);
      std::size_t lit = 0, dark = 0, wrong = 0, acne = 0;
      for (std::size_t i = 0; i < frame.pixels(); ++i) {
        const auto* spot = std::get_if<SpotLight>(&light);
        const glm::dvec3 way = spot != nullptr ? frame.point(i) - spot->position : plan.light_direction;
        if (!frame.surface(i) || frame.map(i) != 0 || glm::dot(frame.normal(i), way) >= 0.0) continue;
        const std::optional<bool> expected = lit_by_adaptive_bias(frame, i, light, depth);
        if (!expected) continue;
        ++(*expected ? lit : dark);
        wrong += *expected != (frame.lit(i) > 0.5f);
        acne += *expected && without.lit(i) < 0.5f;
      }
      EXPECT_GT(lit, 350u) << warp;
      EXPECT_GT(dark, 300u) << warp;
      EXPECT_EQ(wrong, 0u) << warp << light.index();
      EXPECT_GT(acne, 10u) << "the receiver's own depth needs a slope bias";
    }
  }
}

TEST_F(DepthLayers, filters_find_the_shadow_of_a_solid_in_every_layer) {
  const Scene scene = [] {
    Scene s = single_sided();
    add_quad(s, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
    add_mesh(s, box_triangles(kBoxMin + glm::vec3(0, 1, 0), kBoxMax + glm::vec3(0, 1, 0)));
    return s;
  }();
  const glm::dvec3 low = glm::dvec3(kBoxMin) + glm::dvec3(0, 1, 0),
                   high = glm::dvec3(kBoxMax) + glm::dvec3(0, 1, 0);
  const Camera camera = camera_on_box(96, 96);
  Renderer renderer(scene);
  for (const Filter* filter : all_filters()) {
    for (const DepthLayerInfo& info : depth_layers()) {
      PlanOptions options = one_map("none", 256);
      set_margin(default_settings(*filter), options);
      const ShadowPlan plan = planned(scene, camera, DirectionalLight{kSlant}, options);
      const Frame frame =
          render::draw(renderer, camera, plan, default_settings(*filter), frame_of(info.layer));
      double dark = 0.0, lit = 0.0;
      int dark_count = 0, lit_count = 0;
      for (std::size_t i = 0; i < frame.pixels(); ++i) {
        if (!frame.surface(i) || frame.point(i).y > 0.01) continue;
        const glm::dvec3 room(0.35);
        if (hits_box(frame.point(i), -kSlant, low + room, high - room)) dark += frame.lit(i), ++dark_count;
        if (!hits_box(frame.point(i), -kSlant, low - room, high + room)) lit += frame.lit(i), ++lit_count;
      }
      ASSERT_GT(dark_count, 50);
      ASSERT_GT(lit_count, 1000);
      EXPECT_LT(dark / dark_count, 0.15) << filter->info.name << " of " << info.name;
      EXPECT_GT(lit / lit_count, 0.9) << filter->info.name << " of " << info.name;
    }
  }
}

}  // namespace
}  // namespace gnomon::render
