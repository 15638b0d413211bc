// Is the light behind panes what rays through the panes say, under any light, warp and number of panes?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/trace/transmittance.hpp"
#include "mask_frame.hpp"
#include "page_storage.hpp"
#include "shared_context.hpp"
#include "support/light_storage.hpp"

namespace gnomon::render {
namespace {

class Panes : public testing::Test {
 protected:
  void SetUp() override { (void)shared_context(); }
};

Material glass(const glm::vec3& color, float transmission) {
  Material material;
  material.base_color = glm::vec4(color, 1.0f);
  material.transmission = transmission;
  return material;
}

Material smoke(float alpha) {
  Material material;
  material.alpha_mode = AlphaMode::blend;
  material.base_color = glm::vec4(1.0f, 1.0f, 1.0f, alpha);
  return material;
}

/// Level panes over the ground of box_on_ground, some above the others.
Scene panes_over_ground(int count) {
  Scene scene = empty_scene();
  const glm::vec3 tints[] = {{0.9f, 0.2f, 0.1f}, {0.2f, 0.8f, 0.3f}, {0.3f, 0.4f, 1.0f}, {0.9f, 0.8f, 0.3f}};
  for (int i = 0; i < count; ++i) {
    const int material =
        i == 3 ? add_material(scene, smoke(0.4f)) : add_material(scene, glass(tints[i], 0.8f));
    const float x = -3.0f + static_cast<float>(i), y = 3.0f + 0.7f * static_cast<float>(i);
    add_quad(scene, {x, y, 3.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f}, material);
  }
  return scene;
}

struct Judged {
  double mean = 0.0, worst_inside = 0.0;
  std::size_t coloured = 0;
};

/// Boxes of both parts, which plans take as casters.
std::vector<Box> all_boxes(const Scene& opaque, const Scene& panes) {
  std::vector<Box> boxes = boxes_of(opaque);
  for (const Box& box : boxes_of(panes)) boxes.push_back(box);
  return boxes;
}

FrameOptions plain_options() {
  FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  return options;
}

/// The last frame's image against rays. Pixels whose neighbours, as far as a texel is wide, differ in truth
/// are edges, and count in the mean alone.
Judged judged(const Renderer& renderer, const Camera& camera, const Scene& opaque, const Scene& panes,
              const Light& light) {
  const FloatImage image = renderer.transmittance();
  const trace::Tracer tracer(opaque);
  const trace::SurfacePoints points =
      trace::surface_points(tracer, camera, light, renderer.positions(), renderer.normals());
  const trace::PaneReference truth = trace::pane_reference(trace::PaneTracer(panes), points, light);
  Judged result;
  std::size_t counted = 0;
  for (int y = 2; y + 2 < kSize; ++y)
    for (int x = 2; x + 2 < kSize; ++x) {
      const auto i = static_cast<std::size_t>(y * kSize + x);
      if (points.pixels[i].state != trace::PixelState::facing) continue;
      const glm::dvec3 found(image.values[3 * i], image.values[3 * i + 1], image.values[3 * i + 2]);
      const glm::dvec3 off = glm::abs(found - truth.pixels[i]);
      const double error = (off.x + off.y + off.z) / 3.0;
      result.mean += error;
      ++counted;
      result.coloured += truth.pixels[i] != glm::dvec3(1.0) ? 1 : 0;
      bool edge = false;
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
          const auto j = static_cast<std::size_t>((y + dy) * kSize + x + dx);
          edge = edge || points.pixels[j].state != trace::PixelState::facing ||
                 truth.pixels[j] != truth.pixels[i];
        }
      if (!edge) result.worst_inside = std::max(result.worst_inside, error);
    }
  result.mean /= static_cast<double>(counted);
  return result;
}

Judged judged(const Scene& opaque, const Scene& panes, const Light& light, const PlanOptions& options,
              bool panes_are_casters = true) {
  const Camera camera = camera_on_box(kSize, kSize);
  const std::vector<Box> boxes = panes_are_casters ? all_boxes(opaque, panes) : boxes_of(opaque);
  Renderer renderer(opaque);
  renderer.add_panes(panes);
  const ShadowPlan plan = make_plan(camera, light, {boxes, boxes}, options);
  EXPECT_EQ(plan.status, PlanStatus::ok);
  (void)draw(renderer, camera, plan, filters::hard);
  return judged(renderer, camera, opaque, panes, light);
}

PlanOptions plan_options(const char* warp, int cascades) {
  PlanOptions options;
  options.resolution.max_size = 512;
  options.cascades = cascades;
  options.warp.warp = find_warp(warp);
  set_margin(default_settings(filters::hard), options);
  return options;
}

TEST_F(Panes, light_behind_panes_is_the_product_of_what_they_let_through) {
  const Scene opaque = box_on_ground();
  for (const int count : {1, 2, 3, 4})
    for (const char* warp : {"none", "optimal"})
      for (const int cascades : {1, 3}) {
        const Judged j =
            judged(opaque, panes_over_ground(count), DirectionalLight{kSlant}, plan_options(warp, cascades));
        EXPECT_GT(j.coloured, 500u);
        // Single precision, and the mask's map where two meet.
        EXPECT_LT(j.worst_inside, 0.005) << count << " " << warp << " " << cascades;
        EXPECT_LT(j.mean, 0.004) << count << " " << warp << " " << cascades;
      }
}

TEST_F(Panes, panes_nearer_to_the_light_than_every_caster_of_the_plan_tint_as_well) {
  const Judged j = judged(box_on_ground(), panes_over_ground(3), DirectionalLight{{0.02, -1.0, 0.01}},
                          plan_options("none", 1), false);
  EXPECT_GT(j.coloured, 500u);
  EXPECT_LT(j.worst_inside, 0.005);
}

TEST_F(Panes, local_lights_shine_through_them_as_well) {
  const Scene opaque = box_on_ground();
  for (const Light& light : {Light{PointLight{{0.5, 9.0, 0.5}, 60.0}},
                             Light{SpotLight{{0.5, 9.0, 0.5}, {0.0, -1.0, 0.0}, 0.9, 60.0}}}) {
    const Judged j = judged(opaque, panes_over_ground(3), light, plan_options("none", 1));
    EXPECT_GT(j.coloured, 500u);
    EXPECT_LT(j.worst_inside, 0.005);
    EXPECT_LT(j.mean, 0.004);
  }
}

TEST_F(Panes, a_receiver_between_two_panes_has_the_light_of_the_one_before_it) {
  // A shelf below the first pane, above the second.
  Scene opaque = box_on_ground();
  add_quad(opaque, {-3.0f, 4.0f, 3.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f});
  for (const glm::vec3& second : {glm::vec3(0.8f, 0.5f, 0.5f), glm::vec3(0.1f, 0.3f, 0.9f)}) {
    Scene panes = empty_scene();
    const int upper = add_material(panes, glass({0.8f, 0.5f, 0.5f}, 0.9f)),
              lower = add_material(panes, glass(second, 0.9f));
    add_quad(panes, {-3.0f, 5.0f, 3.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f}, upper);
    add_quad(panes, {-3.0f, 3.0f, 3.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f}, lower);
    const Judged j = judged(opaque, panes, DirectionalLight{kSlant}, plan_options("none", 1));
    EXPECT_GT(j.coloured, 500u);
    EXPECT_LT(j.worst_inside, 0.01) << second.b;
  }
}

TEST_F(Panes, a_receiver_among_many_panes_has_nearly_the_light_of_those_before_it) {
  Scene opaque = box_on_ground();
  add_quad(opaque, {-3.0f, 4.0f, 3.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f});
  Scene panes = empty_scene();
  const int tint = add_material(panes, glass({0.9f, 0.7f, 0.6f}, 0.95f));
  for (const float y : {5.5f, 5.0f, 4.5f, 3.5f, 3.0f, 2.7f})
    add_quad(panes, {-3.0f, y, 3.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f}, tint);
  const Judged j = judged(opaque, panes, DirectionalLight{kSlant}, plan_options("none", 1));
  EXPECT_LT(j.worst_inside, 0.2);
  EXPECT_LT(j.mean, 0.02);
}

/// Panes at heights on both sides of a shelf, the last of them of smoke.
Scene panes_round_shelf(Scene& opaque) {
  add_quad(opaque, {-3.0f, 4.0f, 3.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f});
  Scene panes = empty_scene();
  const int tints[] = {add_material(panes, glass({0.9f, 0.7f, 0.6f}, 0.95f)),
                       add_material(panes, glass({0.5f, 0.8f, 0.9f}, 0.9f)),
                       add_material(panes, smoke(0.4f))};
  int i = 0;
  for (const float y : {5.5f, 5.0f, 4.5f, 3.5f, 3.0f, 2.7f})
    add_quad(panes, {-3.0f, y, 3.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f}, tints[i++ % 3]);
  return panes;
}

TEST_F(Panes, exact_shadows_have_exactly_the_light_of_any_number_of_panes) {
  Scene opaque = box_on_ground();
  const Scene panes = panes_round_shelf(opaque);
  const std::vector<Box> boxes = all_boxes(opaque, panes);
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(opaque);
  renderer.add_panes(panes);
  const PreparedFilter exact = renderer.prepare_irregular();
  for (const Light& light : {Light{DirectionalLight{kSlant}}, Light{PointLight{{0.5, 9.0, 0.5}, 60.0}}})
    for (const Shape* shape : {&shapes::linear, &shapes::logarithmic}) {
      PlanOptions options = plan_options("none", 2);
      options.warp.shape = shape;
      const ShadowPlan plan = make_plan(camera, light, {boxes, boxes}, options);
      ASSERT_EQ(plan.status, PlanStatus::ok);
      ASSERT_TRUE(renderer.draw(plan, camera, exact, plain_options()).irregular);
      const Judged j = judged(renderer, camera, opaque, panes, light);
      EXPECT_GT(j.coloured, 1000u);
      // Single precision, and six roundings to whole steps.
      EXPECT_LT(j.worst_inside, 1e-4) << shape->name;
      // Edges are those of the rays too: single pixels where both are rounded.
      EXPECT_LT(j.mean, 1e-4) << shape->name;
    }
}

TEST_F(Panes, samples_of_exact_shadows_are_weighed_by_the_light_that_they_get) {
  const Scene opaque = box_on_ground(), panes = panes_over_ground(4);
  const std::vector<Box> boxes = all_boxes(opaque, panes);
  const Camera camera = camera_on_box(kSize, kSize);
  const DirectionalLight light{kSlant};
  const ShadowPlan plan = make_plan(camera, light, {boxes, boxes}, plan_options("none", 1));
  Renderer renderer(opaque);
  const PreparedFilter first = renderer.prepare_irregular(16);
  renderer.add_panes(panes);  // after the filter: either order is fine
  renderer.draw(plan, camera, first, plain_options());
  const Judged sixteen = judged(renderer, camera, opaque, panes, light);
  EXPECT_LT(sixteen.worst_inside, 1e-4);
  const FloatImage mean = renderer.transmittance();
  renderer.draw(plan, camera, renderer.prepare_irregular(1), plain_options());
  const FloatImage centre = renderer.transmittance();
  std::size_t softened = 0;
  for (std::size_t i = 0; i < mean.values.size(); ++i)
    softened += std::abs(mean.values[i] - centre.values[i]) > 0.05f ? 1 : 0;
  EXPECT_GT(softened, 100u) << "edges are as wide as a pixel";
}

TEST_F(Panes, shadows_by_identifiers_are_tinted_as_well) {
  const Scene opaque = box_on_ground(), panes = panes_over_ground(3);
  const std::vector<Box> boxes = all_boxes(opaque, panes);
  const Camera camera = camera_on_box(kSize, kSize);
  const DirectionalLight light{kSlant};
  Renderer renderer(opaque);
  renderer.add_panes(panes);
  const ShadowPlan plan = make_plan(camera, light, {boxes, boxes}, plan_options("none", 2));
  ASSERT_TRUE(renderer.draw(plan, camera, renderer.prepare_identifiers(), plain_options()).identified);
  const Judged j = judged(renderer, camera, opaque, panes, light);
  EXPECT_GT(j.coloured, 500u);
  EXPECT_LT(j.worst_inside, 0.005);
}

/// A weak sun, a spot and point lights over a box, some of them where no pane is.
struct ManyLights {
  Scene opaque = box_on_ground(), panes = panes_over_ground(3);
  Camera camera = camera_on_box(kSize, kSize);
  std::vector<Box> boxes = all_boxes(opaque, panes);
  std::vector<LightRequest> requests{{DirectionalLight{kSlant}},
                                     {SpotLight{{-2, 8, 3}, {0.3, -1, -0.3}, 0.6, 20.0}},
                                     {PointLight{{1.0, 7.5, 0.5}, 12.0}},
                                     {PointLight{{4.0, 1.0, 2.0}, 2.0}},
                                     {PointLight{{-6.0, 1.5, 2.0}, 2.5}}};
  test::LightStorage memory{requests.size()};
  PlanOptions options = plan_options("none", 1);
  LightPlan plan;
  std::vector<ShadowPlan> own;

  ManyLights() {
    LightOptions pool;
    pool.pool_width = pool.pool_height = 2048;
    pool.most_size = 512;
    pool.least_size = 256;
    plan = plan_lights(camera, requests, {boxes, boxes}, options, pool, memory.spans(), nullptr);
    for (std::size_t i = 0; i < requests.size(); ++i)
      own.push_back(
          make_plan(camera, requests[i].light, {boxes, boxes}, light_options(options, plan.lights[i])));
  }
  /// The sum of all lights, or of one alone.
  FloatImage sum(Renderer& renderer, int only, const ClusterOptions& clusters, FrameStats* stats = nullptr) {
    std::vector<DrawnLight> lights;
    for (std::size_t i = 0; i < requests.size(); ++i)
      lights.push_back(
          {requests[i].light, &own[i], glm::vec3(only < 0 || only == static_cast<int>(i) ? 0.5f : 0.0f)});
    FrameOptions frame = plain_options();
    frame.light_clusters = clusters;
    const FrameStats drawn =
        renderer.draw(plan, lights, camera, renderer.prepare_lights(default_settings(filters::hard)), frame);
    if (stats != nullptr) *stats = drawn;
    return renderer.light_sum();
  }
};

TEST_F(Panes, many_lights_are_tinted_each_by_the_panes_before_it) {
  ManyLights lights;
  ASSERT_EQ(lights.plan.status, PlanStatus::ok);
  ASSERT_EQ(lights.plan.mapped, 5);
  Renderer plain(lights.opaque), tinted(lights.opaque);
  tinted.add_panes(lights.panes);
  const trace::Tracer tracer(lights.opaque);
  const trace::PaneTracer panes(lights.panes);
  // What rays leave of each light alone.
  std::vector<double> truth;
  for (std::size_t i = 0; i < lights.requests.size(); ++i) {
    const FloatImage alone = lights.sum(plain, static_cast<int>(i), {});
    const trace::SurfacePoints points = trace::surface_points(tracer, lights.camera, lights.requests[i].light,
                                                              plain.positions(), plain.normals());
    const trace::PaneReference left = trace::pane_reference(panes, points, lights.requests[i].light);
    truth.resize(alone.values.size());
    for (std::size_t k = 0; k < truth.size(); ++k)
      truth[k] += alone.values[k] * left.pixels[k / 3][static_cast<int>(k % 3)];
  }
  for (const ClusterOptions& clusters : {ClusterOptions{}, ClusterOptions{0, 1}}) {
    FrameStats stats;
    const FloatImage found = lights.sum(tinted, -1, clusters, &stats);
    EXPECT_EQ(stats.lights_tinted, 3) << "the sun, the spot and one lamp";
    EXPECT_GT(stats.pane_texels, 0u);
    const FloatImage untinted = lights.sum(plain, -1, clusters);
    double error = 0.0, light = 0.0, tint = 0.0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      error += std::abs(found.values[k] - truth[k]);
      light += truth[k];
      tint += untinted.values[k] - truth[k];
    }
    EXPECT_GT(tint, 0.05 * light);
    EXPECT_LT(error, 0.004 * light) << clusters.tile_pixels;
  }
  // Panes gone, nothing is left of them.
  tinted.add_panes(empty_scene());
  EXPECT_EQ(lights.sum(tinted, -1, {}).values, lights.sum(plain, -1, {}).values);
}

TEST_F(Panes, lights_that_no_pane_tints_leave_an_image_of_the_frame_without_any_tint) {
  ManyLights lights;
  Renderer renderer(lights.opaque);
  renderer.add_panes(lights.panes);
  FrameStats stats;
  (void)lights.sum(renderer, 0, {}, &stats);
  ASSERT_EQ(stats.lights_tinted, 1);
  (void)lights.sum(renderer, 3, {}, &stats);
  ASSERT_EQ(stats.lights_tinted, 0);
  EXPECT_EQ(stats.pane_texels, 0u);
  const FloatImage image = renderer.transmittance();
  EXPECT_TRUE(std::all_of(image.values.begin(), image.values.end(), [](float v) { return v == 1.0f; }));
}

/// An instance somewhere else.
Instance shifted(const Instance& from, const glm::dvec3& by) {
  Instance to = from;
  to.world_from_object[3] += glm::dvec4(by, 0.0);
  to.bounds_world = {from.bounds_world.min + by, from.bounds_world.max + by};
  return to;
}

TEST_F(Panes, maps_with_a_moving_pane_have_the_bits_of_maps_that_are_drawn_whole) {
  const Scene opaque = box_on_ground();
  Scene panes = panes_over_ground(4);
  const std::vector<Box> boxes{Box{{-20, -1, -20}, {20, 20, 20}}};  // of wherever panes go
  const Camera camera = camera_on_box(kSize, kSize);
  for (const Light& light : {Light{DirectionalLight{kSlant}}, Light{PointLight{{0.5, 9.0, 0.5}, 60.0}}}) {
    const ShadowPlan plan = make_plan(camera, light, {boxes, boxes}, plan_options("optimal", 2));
    ASSERT_EQ(plan.status, PlanStatus::ok);
    Renderer kept(opaque), whole(opaque);
    kept.add_panes(panes);
    whole.add_panes(panes);
    const PreparedFilter of_kept = kept.prepare(filters::hard), of_whole = whole.prepare(filters::hard);
    FrameOptions options = plain_options(), redraws = plain_options();
    redraws.prune = redraws.prune.without(PruneRule::held_maps);
    std::uint64_t kept_texels = 0, whole_texels = 0, moved_frames = 0;
    Scene posed = panes;
    FloatImage before;
    for (int frame = 0; frame < 12; ++frame) {
      // One pane slides, and rests in every third frame; another one jumps once.
      if (frame % 3 != 2) {
        posed.instances[1] = shifted(posed.instances[1], {0.25, 0.02, -0.1});
        EXPECT_TRUE(kept.move_pane(1, posed.instances[1]));
        EXPECT_TRUE(whole.move_pane(1, posed.instances[1]));
      }
      if (frame == 5) {
        posed.instances[0] = shifted(posed.instances[0], {-6.0, 0.5, 2.0});
        EXPECT_TRUE(kept.move_pane(0, posed.instances[0]));
        EXPECT_TRUE(whole.move_pane(0, posed.instances[0]));
      }
      const FrameStats k = kept.draw(plan, camera, of_kept, options);
      const FrameStats w = whole.draw(plan, camera, of_whole, redraws);
      const FloatImage found = kept.transmittance();
      EXPECT_EQ(found.values, whole.transmittance().values) << frame;
      EXPECT_EQ(k.pane_texels == 0, frame % 3 == 2 && frame != 5) << frame;
      if (frame > 0 && frame % 3 != 2) {
        EXPECT_NE(found.values, before.values) << frame;
        ++moved_frames;
      }
      before = found;
      if (frame == 0) continue;
      kept_texels += k.pane_texels;
      whole_texels += w.pane_texels;
    }
    EXPECT_GT(moved_frames, 5u);
    EXPECT_LT(kept_texels, whole_texels / 2);
    // And those of panes that were there from the start.
    Renderer fresh(opaque);
    fresh.add_panes(posed);
    fresh.draw(plan, camera, fresh.prepare(filters::hard), options);
    EXPECT_EQ(fresh.transmittance().values, before.values);
    const Judged j = judged(kept, camera, opaque, posed, light);
    EXPECT_GT(j.coloured, 500u);
    EXPECT_LT(j.worst_inside, 0.01);
    EXPECT_LT(j.mean, 0.004);
  }
}

TEST_F(Panes, a_pose_moves_and_bends_panes_as_a_scene_made_so) {
  const Scene opaque = box_on_ground();
  const Scene panes = panes_over_ground(3);
  Scene posed = panes;
  posed.instances[2] = shifted(posed.instances[2], {-0.5, 0.25, 0.5});
  // The first pane sags at a corner.
  const Primitive& first = panes.primitives[panes.instances[0].primitive];
  const std::uint32_t vertex = panes.indices[first.first_index];
  posed.positions[vertex].y -= 0.75f;
  posed.instances[0].bounds_world.min.y -= 0.75;
  Pose pose;
  for (const std::uint32_t i : {0u, 2u})
    pose.instances.push_back(
        {i, posed.instances[i].world_from_object, false, posed.instances[i].bounds_world});
  pose.vertices = {{0, 0, vertex, 1, {}}};
  pose.positions = {posed.positions[vertex]};
  pose.normals = {posed.normals[vertex]};
  const std::vector<Box> boxes = all_boxes(opaque, posed);
  const Camera camera = camera_on_box(kSize, kSize);
  const ShadowPlan plan =
      make_plan(camera, DirectionalLight{kSlant}, {boxes, boxes}, plan_options("none", 2));
  Renderer moved(opaque), fresh(opaque);
  moved.add_panes(panes);
  fresh.add_panes(posed);
  moved.draw(plan, camera, moved.prepare(filters::hard), plain_options());
  ASSERT_TRUE(moved.apply_pane_pose(pose));
  const std::uint64_t texels =
      moved.draw(plan, camera, moved.prepare(filters::hard), plain_options()).pane_texels;
  EXPECT_GT(texels, 0u);
  fresh.draw(plan, camera, fresh.prepare(filters::hard), plain_options());
  EXPECT_EQ(moved.transmittance().values, fresh.transmittance().values);
  ASSERT_TRUE(moved.apply_pane_pose(pose));
  EXPECT_EQ(moved.draw(plan, camera, moved.prepare(filters::hard), plain_options()).pane_texels, 0u)
      << "the same pose again";
  pose.instances[0].instance = 3;
  EXPECT_FALSE(moved.apply_pane_pose(pose)) << "an instance that is not there";
}

TEST_F(Panes, panes_that_become_mirrored_or_are_not_there_are_handled) {
  const Scene opaque = box_on_ground(), panes = panes_over_ground(3);
  const std::vector<Box> boxes = all_boxes(opaque, panes);
  const Camera camera = camera_on_box(kSize, kSize);
  const ShadowPlan plan =
      make_plan(camera, DirectionalLight{kSlant}, {boxes, boxes}, plan_options("none", 1));
  Renderer renderer(opaque);
  EXPECT_FALSE(renderer.move_pane(0, panes.instances[0])) << "no panes";
  renderer.add_panes(panes);
  EXPECT_FALSE(renderer.move_pane(3, panes.instances[0]));
  EXPECT_FALSE(renderer.move_pane(0, Instance{})) << "empty bounds";
  const PreparedFilter hard = renderer.prepare(filters::hard);
  renderer.draw(plan, camera, hard, plain_options());
  Scene mirrored = panes;
  Instance& first = mirrored.instances[0];
  // The quad's own middle, so that it covers the same place.
  const double middle = 0.5 * (first.bounds_world.min.x + first.bounds_world.max.x);
  first.world_from_object = glm::dmat4(1.0);
  first.world_from_object[0].x = -1.0;
  first.world_from_object[3].x = 2.0 * middle;
  first.mirrored = true;
  EXPECT_TRUE(renderer.move_pane(0, first));
  renderer.draw(plan, camera, hard, plain_options());
  const Judged j = judged(renderer, camera, opaque, mirrored, DirectionalLight{kSlant});
  EXPECT_LT(j.worst_inside, 0.005);
}

TEST_F(Panes, kept_maps_survive_no_frame_that_used_their_images) {
  ManyLights lights;
  const std::vector<Box>& boxes = lights.boxes;
  const ShadowPlan plan =
      make_plan(lights.camera, DirectionalLight{kSlant}, {boxes, boxes}, plan_options("none", 2));
  Renderer renderer(lights.opaque);
  renderer.add_panes(lights.panes);
  const PreparedFilter hard = renderer.prepare(filters::hard), exact = renderer.prepare_irregular();
  renderer.draw(plan, lights.camera, hard, plain_options());
  const FloatImage before = renderer.transmittance();
  EXPECT_EQ(renderer.draw(plan, lights.camera, hard, plain_options()).pane_texels, 0u);
  EXPECT_EQ(renderer.transmittance().values, before.values);
  (void)lights.sum(renderer, -1, {});
  EXPECT_GT(renderer.draw(plan, lights.camera, hard, plain_options()).pane_texels, 0u);
  EXPECT_EQ(renderer.transmittance().values, before.values);
  // Exact frames leave them alone, and what moved meanwhile is not forgotten.
  const Instance there = shifted(lights.panes.instances[0], {1.0, 0.0, 0.0});
  EXPECT_TRUE(renderer.move_pane(0, there));
  renderer.draw(plan, lights.camera, exact, plain_options());
  renderer.draw(plan, lights.camera, hard, plain_options());
  Scene moved = lights.panes;
  moved.instances[0] = there;
  Renderer fresh(lights.opaque);
  fresh.add_panes(moved);
  fresh.draw(plan, lights.camera, fresh.prepare(filters::hard), plain_options());
  EXPECT_EQ(renderer.transmittance().values, fresh.transmittance().values);
}

/// Pages for what a camera sees of a scene.
struct Pages {
  Camera camera = camera_on_box(kSize, kSize);
  std::vector<glm::dvec3> points;
  PageStorage memory{4096, 1 << 17};
  PagePlan plan;

  Pages(const Scene& opaque, const Scene& panes, const Light& light, const PagePolicy& policy,
        int page_texels = 64) {
    Renderer renderer(opaque);
    const Frame frame = render::draw(renderer, camera, ShadowPlan{}, filters::hard);
    for (std::size_t i = 0; i < frame.pixels(); ++i)
      if (frame.surface(i)) points.push_back(frame.point(i));
    const std::vector<Box> boxes = all_boxes(opaque, panes);
    PlanOptions options;
    set_margin(default_settings(filters::hard), options);
    PageOptions pages;
    pages.policy = &policy;
    pages.page_texels = page_texels;
    plan = plan_pages(camera, light, {boxes, boxes}, {points}, options, pages, memory.spans());
  }
};

TEST_F(Panes, pages_are_tinted_like_maps) {
  const Scene opaque = box_on_ground(), panes = panes_over_ground(4);
  for (const Light& light : {Light{DirectionalLight{kSlant}}, Light{PointLight{{0.5, 9.0, 0.5}, 60.0}}})
    for (const PagePolicy* policy : {&page_policies::queried, &page_policies::resolution}) {
      Pages pages(opaque, panes, light, *policy);
      ASSERT_EQ(pages.plan.status, PlanStatus::ok);
      ASSERT_GT(pages.plan.pages.size(), 20u);
      Renderer renderer(opaque);
      renderer.add_panes(panes);
      const PreparedFilter hard = renderer.prepare_pages(default_settings(filters::hard));
      const FrameStats stats = renderer.draw(pages.plan, pages.camera, hard, plain_options());
      EXPECT_GT(stats.pane_texels, 0u);
      const Judged j = judged(renderer, pages.camera, opaque, panes, light);
      EXPECT_GT(j.coloured, 500u);
      EXPECT_LT(j.worst_inside, 0.005) << policy->name;
      EXPECT_LT(j.mean, 0.004) << policy->name;
      const FloatImage before = renderer.transmittance();
      // Nothing changed, nothing is drawn; a pane that moves is.
      EXPECT_EQ(renderer.draw(pages.plan, pages.camera, hard, plain_options()).pane_texels, 0u);
      EXPECT_EQ(renderer.transmittance().values, before.values);
      Scene moved = panes;
      moved.instances[1] = shifted(moved.instances[1], {0.5, 0.1, -0.25});
      ASSERT_TRUE(renderer.move_pane(1, moved.instances[1]));
      renderer.draw(pages.plan, pages.camera, hard, plain_options());
      EXPECT_LT(judged(renderer, pages.camera, opaque, moved, light).worst_inside, 0.005);
      Renderer fresh(opaque);
      (void)fresh.prepare_pages(default_settings(filters::hard));
      fresh.add_panes(moved);  // after the filter: either order is fine
      fresh.draw(pages.plan, pages.camera, fresh.prepare_pages(default_settings(filters::hard)),
                 plain_options());
      EXPECT_EQ(renderer.transmittance().values, fresh.transmittance().values);
      // Maps in between take the images, and no pane is left where there is none any more.
      const std::vector<Box> boxes = all_boxes(opaque, panes);
      renderer.draw(make_plan(pages.camera, light, {boxes, boxes}, plan_options("none", 2)), pages.camera,
                    renderer.prepare(filters::hard), plain_options());
      renderer.draw(pages.plan, pages.camera, hard, plain_options());
      EXPECT_EQ(renderer.transmittance().values, fresh.transmittance().values);
      renderer.add_panes(empty_scene());
      Renderer plain(opaque);
      renderer.draw(pages.plan, pages.camera, hard, plain_options());
      plain.draw(pages.plan, pages.camera, plain.prepare_pages(default_settings(filters::hard)),
                 plain_options());
      EXPECT_EQ(renderer.image().rgba, plain.image().rgba);
    }
}

TEST_F(Panes, images_are_as_large_as_the_frame_needs_them_whatever_came_before) {
  const Scene opaque = box_on_ground(), panes = panes_over_ground(4);
  const Light light = DirectionalLight{kSlant};
  for (const int texels : {64, 256}) {
    Pages pages(opaque, panes, light, page_policies::resolution, texels);
    ASSERT_EQ(pages.plan.status, PlanStatus::ok);
    Renderer renderer(opaque), plain(opaque);
    renderer.add_panes(panes);
    const auto bytes_of_panes = [&] {
      const auto bytes = [&](Renderer& of) {
        return of
            .draw(pages.plan, pages.camera, of.prepare_pages(default_settings(filters::hard)),
                  plain_options())
            .map_bytes;
      };
      return bytes(renderer) - bytes(plain);
    };
    const auto slot = static_cast<std::uint64_t>(pages.plan.slot_texels());
    // Places are a square of squares.
    EXPECT_LT(bytes_of_panes(), 2 * pages.plan.pages.size() * slot * slot * 40) << texels;
    const std::vector<Box> boxes = all_boxes(opaque, panes);
    PlanOptions large = plan_options("none", 4);
    large.resolution.max_size = 2048;
    renderer.draw(make_plan(pages.camera, light, {boxes, boxes}, large), pages.camera,
                  renderer.prepare(filters::hard), plain_options());
    EXPECT_LE(bytes_of_panes(), std::uint64_t{256} << 20) << texels;
  }
}

TEST_F(Panes, pages_that_no_pane_reaches_are_not_tinted) {
  const Scene opaque = box_on_ground();
  Scene panes = empty_scene();
  const int tint = add_material(panes, glass({0.9f, 0.2f, 0.1f}, 0.8f));
  add_quad(panes, {400.0f, 3.0f, 403.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f}, tint);
  const Light light = DirectionalLight{{0.02, -1.0, 0.01}};
  Pages pages(opaque, empty_scene(), light, page_policies::queried);
  ASSERT_EQ(pages.plan.status, PlanStatus::ok);
  Renderer renderer(opaque);
  renderer.add_panes(panes);
  const FrameStats stats = renderer.draw(
      pages.plan, pages.camera, renderer.prepare_pages(default_settings(filters::hard)), plain_options());
  EXPECT_EQ(stats.pane_texels, 0u);
  const FloatImage image = renderer.transmittance();
  for (const float value : image.values) ASSERT_EQ(value, 1.0f);
}

TEST_F(Panes, nothing_of_a_frame_with_panes_is_left_in_the_next_one_without) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  const ShadowPlan plan = plan_for(scene, camera, kSlant, plan_options("optimal", 2));
  Renderer plain(scene), tinted(scene);
  for (const Filter* filter : all_filters()) {
    tinted.add_panes(panes_over_ground(3));
    const Frame with = draw(tinted, camera, plan, *filter);
    const Frame without = draw(plain, camera, plan, *filter);
    EXPECT_EQ(with.mask.values, without.mask.values) << filter->info.name;
    tinted.add_panes(empty_scene());
    (void)draw(tinted, camera, plan, *filter);
    EXPECT_EQ(tinted.image().rgba, plain.image().rgba) << filter->info.name;
  }
}

TEST_F(Panes, without_panes_no_bit_changes) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  const ShadowPlan plan = plan_for(scene, camera, kSlant, plan_options("optimal", 2));
  Renderer plain(scene), emptied(scene);
  emptied.add_panes(panes_over_ground(2));
  emptied.add_panes(empty_scene());
  (void)draw(plain, camera, plan, filters::pcf);
  (void)draw(emptied, camera, plan, filters::pcf);
  EXPECT_EQ(plain.image().rgba, emptied.image().rgba);
  EXPECT_EQ(plain.mask().values, emptied.mask().values);
  EXPECT_THROW((void)emptied.transmittance(), RenderError);
}

TEST_F(Panes, the_picture_shows_coloured_light_on_the_ground) {
  const Scene opaque = box_on_ground(), panes = panes_over_ground(1);
  const Camera camera = camera_on_box(kSize, kSize);
  std::vector<Box> boxes = boxes_of(opaque);
  for (const Box& box : boxes_of(panes)) boxes.push_back(box);
  const ShadowPlan plan =
      make_plan(camera, DirectionalLight{kSlant}, {boxes, boxes}, plan_options("none", 1));
  Renderer renderer(opaque);
  (void)draw(renderer, camera, plan, filters::hard);
  const Image before = renderer.image();
  renderer.add_panes(panes);
  (void)draw(renderer, camera, plan, filters::hard);
  const Image after = renderer.image();
  const FloatImage light = renderer.transmittance(), mask = renderer.mask();
  std::size_t redder = 0, coloured = 0;
  for (std::size_t i = 0; i < light.values.size() / 3; ++i) {
    const bool behind = light.values[3 * i] > 2.0f * light.values[3 * i + 2] && mask.values[2 * i] > 0.5f;
    if (!behind) continue;
    ++coloured;
    redder += after.rgba[4 * i] - after.rgba[4 * i + 2] > before.rgba[4 * i] - before.rgba[4 * i + 2] + 20;
  }
  EXPECT_GT(coloured, 500u);
  EXPECT_GT(redder, coloured * 9 / 10);
}

}  // namespace
}  // namespace gnomon::render
