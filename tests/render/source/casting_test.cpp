// Objects that cast no shadow, and objects that none falls on, by every source of shadows and by rays.
#include <gtest/gtest.h>

#include "gnomon/scene/shadow_boxes.hpp"
#include "gnomon/trace/reference.hpp"
#include "mask_frame.hpp"
#include "shared_context.hpp"

namespace gnomon::render {
namespace {

class Casting : public testing::Test {
 protected:
  void SetUp() override { (void)shared_context(); }
};

constexpr std::size_t kGround = 0, kBox = 1, kBoard = 2;

/// A ground, a box on it, and a board over both that shadows much of them.
Scene board_over_box() {
  Scene scene = box_on_ground();
  add_box(scene, {-3.0f, 4.0f, -2.5f}, {1.5f, 4.2f, 2.0f});
  return scene;
}

FrameOptions mask_only() {
  FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  return options;
}

PlanOptions plan_options() {
  PlanOptions options;
  options.resolution.max_size = 512;
  options.cascades = 2;
  set_margin(default_settings(filters::hard), options);
  return options;
}

ShadowPlan plan_of(const Scene& scene, const Camera& camera) {
  const ShadowBoxes boxes(scene);
  return make_plan(camera, DirectionalLight{kSlant}, boxes.bounds(), plan_options());
}

/// Plans of the scene for each source, and the memory that they lie in.
struct Plans {
  ShadowPlan maps;
  std::vector<std::byte> page_memory, light_memory;
  PagePlan pages;
  LightPlan lights;
  std::vector<DrawnLight> drawn;
  ShadowPlan of_light;

  Plans(const Scene& scene, const Camera& camera) : maps(plan_of(scene, camera)) {
    const ShadowBoxes boxes(scene);
    const Light sun = DirectionalLight{kSlant};
    std::vector<glm::dvec3> points;
    const Frame frame = draw_scene(scene, camera, kSlant);
    for (std::size_t i = 0; i < frame.pixels(); ++i)
      if (frame.surface(i)) points.push_back(frame.point(i));
    page_memory.resize(gnomon::page_memory(4096, points.size()));
    PageOptions page_options;
    set_margin(default_settings(filters::hard), page_options.plan);
    pages = plan_pages({.camera = camera, .points_world = points}, sun, boxes.bounds(), page_options,
                       page_memory);
    light_memory.resize(gnomon::light_memory(1, 0));
    const LightRequest request{sun};
    LightOptions light_options;
    light_options.plan = plan_options();
    lights = plan_lights(camera, {&request, 1}, boxes.bounds(), light_options, light_memory);
    of_light = make_plan(camera, sun, boxes.bounds(), gnomon::light_options(light_options, lights.lights[0]));
    drawn.push_back({.light = sun, .plan = &of_light});
  }
  [[nodiscard]] Shadows shadows(const Source& source) const {
    if (source == Source::pages) return pages;
    if (source == Source::lights) return {lights, drawn};
    return maps;
  }
};

/// Pixels where a mask is not what rays find, and those that rays find lit and in shadow.
struct Judged {
  int wrong = 0, lit = 0, shadow = 0;
};
Judged judged(const Scene& scene, const Frame& frame) {
  const trace::Tracer tracer(scene);
  const Light light = DirectionalLight{kSlant};
  const trace::SurfacePoints points =
      trace::surface_points(tracer, frame.camera, light, frame.positions, frame.normals);
  const trace::HardReference truth = trace::hard_reference(tracer, points, light);
  Judged result;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    const bool lit = truth.pixels[i] == trace::Verdict::lit,
               shadow = truth.pixels[i] == trace::Verdict::shadow;
    result.lit += lit;
    result.shadow += shadow;
    result.wrong += (lit && frame.lit(i) != 1.0f) || (shadow && frame.lit(i) != 0.0f);
  }
  return result;
}

TEST_F(Casting, boxes_of_a_scene_are_both_unless_it_says_otherwise) {
  Scene scene = board_over_box();
  const ShadowBoxes both(scene);
  EXPECT_EQ(both.bounds().casters.size(), 3u);
  scene.instances[kBoard].casts = false;
  scene.instances[kGround].receives = false;
  ShadowBoxes boxes(scene);
  boxes.place(kBoard, {{0, 0, 0}, {1, 1, 1}});
  boxes.place(kBox, {{0, 0, 0}, {2, 2, 2}});
  EXPECT_EQ(boxes.all()[kBoard].max.x, 1.0);
  const ShadowPlan plan = plan_of(scene, camera_on_box(kSize, kSize));
  EXPECT_EQ(plan.status, PlanStatus::ok);
}

TEST_F(Casting, maps_hold_to_the_bit_what_they_hold_without_the_objects_that_do_not_cast) {
  Scene scene = board_over_box(), without = box_on_ground();
  scene.instances[kBoard].casts = false;
  const Camera camera = camera_on_box(kSize, kSize);
  // By hand: no caster is the board, which receives.
  const std::vector<Box> receivers = boxes_of(scene), casters = boxes_of(without);
  const ShadowPlan plan = make_plan(camera, DirectionalLight{kSlant}, {casters, receivers}, plan_options());
  ASSERT_GT(plan.map_count, 0);
  const ShadowPlan by_flag = plan_of(scene, camera);
  ASSERT_EQ(by_flag.map_count, plan.map_count);
  for (const PruneRules prune : {exact_prune_rules(), kPruneNothing}) {
    Renderer flagged(scene), by_hand(without);
    FrameOptions options = mask_only();
    options.prune = prune;
    flagged.draw(by_flag, camera, flagged.prepare(filters::hard), options);
    by_hand.draw(plan, camera, by_hand.prepare(filters::hard), options);
    std::size_t drawn = 0;
    for (int map = 0; map < plan.map_count; ++map) {
      const FloatImage depths = flagged.depth_map(map);
      EXPECT_EQ(depths.values, by_hand.depth_map(map).values) << map;
      for (const float depth : depths.values) drawn += depth < 1.0f;
    }
    EXPECT_GT(drawn, 1000u);
  }
}

TEST_F(Casting, every_source_of_shadows_agrees_with_rays) {
  const Camera camera = camera_on_box(kSize, kSize);
  for (const bool casts : {true, false})
    for (const bool receives : {true, false}) {
      Scene scene = board_over_box();
      scene.instances[kBoard].casts = casts;
      scene.instances[kGround].receives = receives;
      const Plans plans(scene, camera);
      for (const Source& source :
           {Source::maps, Source::pages, Source::lights, Source::irregular(), Source::identifiers()}) {
        SCOPED_TRACE(std::string(casts ? "casts" : "") + (receives ? " receives " : " ") +
                     std::to_string(static_cast<int>(source.kind)));
        Renderer renderer(scene);
        renderer.draw(plans.shadows(source), camera, renderer.prepare(filters::hard, source), mask_only());
        const Frame frame{camera, plans.maps, renderer.mask(), renderer.positions(), renderer.normals()};
        const Judged found = judged(scene, frame);
        EXPECT_GT(found.lit, 5000);
        EXPECT_EQ(found.shadow > 200, casts || receives);
        EXPECT_LE(found.wrong, source == Source::irregular() ? 0 : found.lit / 50);
      }
    }
}

TEST_F(Casting, a_proxy_casts_and_neither_cameras_nor_rays_from_the_eye_see_it) {
  const Camera camera = camera_on_box(kSize, kSize);
  Scene proxied = board_over_box(), without = box_on_ground();
  proxied.instances[kBoard].shown = proxied.instances[kBoard].receives = false;
  const Plans plans(proxied, camera);
  const trace::Tracer tracer(proxied);
  for (const Source& source :
       {Source::maps, Source::pages, Source::lights, Source::irregular(), Source::identifiers()}) {
    SCOPED_TRACE(static_cast<int>(source.kind));
    Renderer renderer(proxied), alone(without);
    renderer.draw(plans.shadows(source), camera, renderer.prepare(filters::hard, source), mask_only());
    alone.draw(plan_of(without, camera), camera, alone.prepare(filters::hard), mask_only());
    const Frame frame{camera, plans.maps, renderer.mask(), renderer.positions(), renderer.normals()};
    constexpr float kRounding = 1e-4f;  // of matrices, whose origin depends on the scene
    const std::vector<float> with = frame.positions.values, bare = alone.positions().values;
    std::size_t apart = 0;
    for (std::size_t i = 0; i < with.size(); ++i) apart += std::abs(with[i] - bare[i]) > kRounding;
    EXPECT_EQ(apart, 0u) << "the picture shows it";
    const Judged found = judged(proxied, frame);
    EXPECT_GT(found.lit, 5000);
    EXPECT_GT(found.shadow, 2000) << "it casts no shadow";
    EXPECT_LE(found.wrong, source == Source::irregular() ? 0 : found.lit / 50);
  }
  std::size_t seen = 0;
  const CameraAxes axes = camera_axes(camera);
  for (int i = 0; i < 100; ++i) {
    const trace::Ray ray = trace::eye_ray(camera, axes, (i % 10 + 0.5) / 10, (i / 10 + 0.5) / 10);
    for (const trace::Hit& hit :
         {tracer.first_hit(ray), tracer.first_seen(ray), tracer.hit_nearest_to(ray, 1.0)})
      if (hit.triangle != trace::kNoTriangle) {
        ++seen;
        EXPECT_NE(tracer.instance_of(hit.triangle), kBoard);
      }
  }
  EXPECT_GT(seen, 100u);
  trace::Ray down;
  down.origin = {-1.0, 5.0, 0.0};
  down.direction = {0, -1, 0};
  EXPECT_EQ(tracer.instance_of(tracer.first_caster(down).triangle), kBoard);
}

TEST_F(Casting, an_orthographic_camera_has_the_shadows_of_exact_rays_by_every_source) {
  const Camera camera =
      orthographic_camera({6.0, 9.0, 8.0}, {-0.6, -0.8, -0.8}, {0, 1, 0}, 9.0, 1.0, 0.5, 40.0, kSize, kSize);
  const Scene scene = board_over_box();
  const Plans plans(scene, camera);
  for (const Source& source :
       {Source::maps, Source::pages, Source::lights, Source::irregular(), Source::identifiers()}) {
    SCOPED_TRACE(static_cast<int>(source.kind));
    Renderer renderer(scene);
    renderer.draw(plans.shadows(source), camera, renderer.prepare(filters::hard, source), mask_only());
    const Frame frame{camera, plans.maps, renderer.mask(), renderer.positions(), renderer.normals()};
    const Judged found = judged(scene, frame);
    EXPECT_GT(found.lit, 2000);
    EXPECT_GT(found.shadow, 500);
    EXPECT_LE(found.wrong, source == Source::irregular() ? 0 : found.lit / 50);
  }
}

TEST_F(Casting, an_orthographic_camera_sees_the_same_surfaces_before_any_far_plane_and_beside_any_stray) {
  const auto seen = [](const Scene& scene, double far_depth) {
    const Camera camera = orthographic_camera({6.0, 9.0, 8.0}, {-0.6, -0.8, -0.8}, {0, 1, 0}, 9.0, 1.0, 0.5,
                                              far_depth, kSize, kSize);
    Renderer renderer(scene);
    renderer.draw(plan_of(scene, camera), camera, renderer.prepare(filters::hard), mask_only());
    return Frame{camera, {}, renderer.mask(), renderer.positions(), renderer.normals()};
  };
  const Scene scene = board_over_box();
  Scene strayed = scene;
  strayed.instances.push_back(shifted(scene.instances[kBox], {1e8, 0.0, -1e8}));  // beside the picture
  strayed.bounds_world.extend(strayed.instances.back().bounds_world);
  const Frame near = seen(scene, 40.0);
  for (const Frame& far : {seen(scene, 1e9), seen(strayed, 1e10)}) {
    std::size_t other = 0;
    for (std::size_t i = 0; i < near.pixels(); ++i)
      other += near.surface(i) != far.surface(i) ||
               (near.surface(i) && glm::distance(near.point(i), far.point(i)) > 1e-3);
    EXPECT_LE(other, 2u);
  }
}

TEST_F(Casting, no_ray_of_a_soft_reference_stops_at_what_does_not_cast) {
  Scene scene = board_over_box(), without = box_on_ground();
  scene.instances[kBoard].casts = false;
  scene.instances[kBox].receives = false;
  const Camera camera = camera_on_box(kSize, kSize);
  const Frame frame = draw_scene(scene, camera, kSlant);
  const Light light = DirectionalLight{kSlant};
  for (const trace::Engine engine : {trace::Engine::own, trace::Engine::automatic}) {
    const trace::Tracer tracer(scene, engine), other(without, engine);
    const trace::SurfacePoints points =
        trace::surface_points(tracer, camera, light, frame.positions, frame.normals);
    trace::SurfacePoints ground = points;
    int on_ground = 0, on_box = 0;
    for (trace::SurfacePoint& point : ground.pixels) {
      const bool is_ground = point.state == trace::PixelState::facing && std::abs(point.position.y) < 1e-3;
      if (!is_ground) point = {};
      on_ground += is_ground;
    }
    const trace::SoftReference with_flag = trace::area_reference(tracer, ground, light, 0.05),
                               by_hand = trace::area_reference(other, ground, light, 0.05),
                               all = trace::area_reference(tracer, points, light, 0.05);
    const trace::PixelReference pixels = trace::pixel_reference(tracer, camera, points, light);
    for (std::size_t i = 0; i < points.pixels.size(); ++i) {
      EXPECT_EQ(with_flag.pixels[i], by_hand.pixels[i]);
      if (points.pixels[i].receives || points.pixels[i].state != trace::PixelState::facing) continue;
      ++on_box;
      EXPECT_EQ(all.pixels[i], 1.0f);
      if (pixels.several[i] == 0) {
        EXPECT_EQ(pixels.pixels[i], 1.0f);
      }
    }
    EXPECT_GT(on_ground, 1000);
    EXPECT_GT(on_box, 100);
  }
}

}  // namespace
}  // namespace gnomon::render
