// Is the light behind panes what rays through the panes say, under any light, warp and number of panes?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pane_scenes.hpp"

namespace gnomon::render {
namespace {

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
  const PreparedFilter exact = renderer.prepare(filters::hard, Source::irregular());
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
  const PreparedFilter first = renderer.prepare(filters::hard, Source::irregular(16));
  renderer.add_panes(panes);  // after the filter: either order is fine
  renderer.draw(plan, camera, first, plain_options());
  const Judged sixteen = judged(renderer, camera, opaque, panes, light);
  EXPECT_LT(sixteen.worst_inside, 1e-4);
  const FloatImage mean = renderer.transmittance();
  renderer.draw(plan, camera, renderer.prepare(filters::hard, Source::irregular(1)), plain_options());
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
  const PreparedFilter identified = renderer.prepare(filters::hard, Source::identifiers());
  ASSERT_TRUE(renderer.draw(plan, camera, identified, plain_options()).identified);
  const Judged j = judged(renderer, camera, opaque, panes, light);
  EXPECT_GT(j.coloured, 500u);
  EXPECT_LT(j.worst_inside, 0.005);
}

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
    EXPECT_EQ(stats.lights_tinted, 3) << "the sun, the spot and one point light";
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
