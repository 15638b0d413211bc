// Are pixels lit by identifiers exactly where the light's ray through their texel's centre meets what they
// show?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "gnomon/study/bias.hpp"
#include "gnomon/trace/tracer.hpp"
#include "mask_frame.hpp"
#include "shared_context.hpp"

namespace gnomon::render {
namespace {

class Identifiers : public testing::Test {
 protected:
  void SetUp() override { (void)shared_context(); }
};

FrameOptions mask_only() {
  FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  return options;
}

/// Boxes over a ground: two of them are instances of one primitive, one is a mirror image.
Scene boxes_over_ground() {
  Scene scene = empty_scene();
  add_quad(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  const auto turned = [](const glm::dvec3& middle, double angle) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), middle), angle, glm::dvec3(0.3, 1.0, 0.2));
  };
  const std::vector<glm::vec3> box = box_triangles({-1, -1, -1}, {1, 1, 1});
  add_mesh(scene, box, turned({-3, 2, 0}, 0.4));
  add_mesh(scene, box, glm::scale(turned({3, 2.5, 1}, 1.1), glm::dvec3(-1.0, 1.0, 1.0)), 0, true);
  Instance copy = scene.instances[1];
  copy.world_from_object = turned({-1.5, 5.5, 0.5}, 0.9);
  copy.bounds_world = {{-3.3, 3.7, -1.3}, {0.3, 7.3, 2.3}};
  scene.instances.push_back(copy);
  return scene;
}

/// Hills of many triangles: a caster that is drawn in parts.
Scene hills() {
  Scene scene = empty_scene();
  std::vector<glm::vec3> corners;
  const auto at = [](int x, int z) {
    const float u = 0.5f * static_cast<float>(x) - 10.0f, v = 0.5f * static_cast<float>(z) - 10.0f;
    return glm::vec3(u, 1.2f * std::sin(0.9f * u) * std::cos(0.7f * v), v);
  };
  for (int z = 0; z < 40; ++z) {
    for (int x = 0; x < 40; ++x) {
      for (const glm::vec3& p :
           {at(x, z), at(x, z + 1), at(x + 1, z + 1), at(x, z), at(x + 1, z + 1), at(x + 1, z)})
        corners.push_back(p);
    }
  }
  add_mesh(scene, corners);
  return scene;
}

ShadowPlan planned(const Scene& scene, const Camera& camera, const Light& light, int size = 128,
                   const char* warp = "none", int cascades = 1) {
  PlanOptions options;
  options.resolution.max_size = size;
  options.cascades = cascades;
  options.warp.warp = find_warp(warp);
  options.bias = {0.0, 0.0, 0.0};
  const std::vector<Box> boxes = boxes_of(scene);
  return make_plan(camera, light, {boxes, boxes}, options);
}

Frame drawn(Renderer& renderer, const Camera& camera, const ShadowPlan& plan, const IdentifierTest& test,
            const FrameOptions& options = mask_only()) {
  const PreparedFilter identified = renderer.prepare(filters::hard, Source::identifiers(test));
  EXPECT_TRUE(renderer.draw(plan, camera, identified, options).identified);
  return {camera, plan, renderer.mask(), renderer.positions(), renderer.normals()};
}

/// Rays in place of the maps.
class Rays {
 public:
  Rays(const Scene& scene, IdentifierOf of) : tracer_(scene, trace::Engine::own) {
    std::uint32_t number = 0;
    for (const Instance& instance : scene.instances) {
      const std::uint32_t count = scene.primitives[instance.primitive].index_count / 3;
      for (std::uint32_t i = 0; i < count; ++i, ++number)
        number_.push_back(of == IdentifierOf::triangle
                              ? number
                              : static_cast<std::uint32_t>(&instance - scene.instances.data()));
    }
  }
  /// What stands along the light's ray through a place of the map, in texels.
  [[nodiscard]] std::uint32_t seen_by_light(const ShadowMap& map, const glm::dvec2& texel) const {
    const glm::dmat4 world_from_clip = glm::inverse(map.clip_from_world);
    const glm::dvec2 ndc = texel / glm::dvec2(map.width, map.height) * 2.0 - 1.0;
    const auto at = [&](double z) {
      const glm::dvec4 h = world_from_clip * glm::dvec4(ndc, z, 1.0);
      return glm::dvec3(h) / h.w;
    };
    return first(at(-1.0), at(1.0) - at(-1.0), 1.0);
  }
  [[nodiscard]] std::uint32_t seen_by_camera(const glm::dvec3& eye, const glm::dvec3& point) const {
    return first(eye, point - eye, 1.0 + 1e-4);
  }

 private:
  std::uint32_t first(const glm::dvec3& origin, const glm::dvec3& direction, double end) const {
    trace::Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    ray.end = end;
    const trace::Hit hit = tracer_.first_hit(ray);
    return hit.triangle == trace::kNoTriangle ? trace::kNoTriangle : number_[hit.triangle];
  }
  trace::Tracer tracer_;
  std::vector<std::uint32_t> number_;
};

/// Whether the pixel is lit by the rule; nothing where an edge or a texel's border is too near to say.
std::optional<bool> lit_by_rays(const Rays& rays, const Frame& frame, std::size_t pixel, int neighbours) {
  const ShadowMap& map = frame.plan.map[static_cast<std::size_t>(frame.map(pixel))];
  const glm::dvec3 point = frame.point(pixel);
  const std::uint32_t own = rays.seen_by_camera(frame.camera.position, point);
  for (const glm::dvec3& off : {glm::dvec3(0.01, 0, 0), glm::dvec3(0, 0.01, 0), glm::dvec3(0, 0, 0.01)}) {
    if (rays.seen_by_camera(frame.camera.position + off, point) != own) return std::nullopt;
    if (rays.seen_by_camera(frame.camera.position - off, point) != own) return std::nullopt;
  }
  const glm::dvec4 h = map.clip_from_world * glm::dvec4(point, 1.0);
  const glm::dvec2 texel = (glm::dvec2(h) / h.w * 0.5 + 0.5) * glm::dvec2(map.width, map.height);
  const glm::dvec2 cell = glm::floor(texel), inside = texel - cell;
  if (std::min({inside.x, inside.y, 1.0 - inside.x, 1.0 - inside.y}) < 0.02) return std::nullopt;
  bool lit = false, certain = true;
  for (int y = -neighbours; y <= neighbours; ++y) {
    for (int x = -neighbours; x <= neighbours; ++x) {
      const glm::dvec2 centre = cell + glm::dvec2(x, y) + 0.5;
      if (centre.x < 0.0 || centre.y < 0.0 || centre.x > map.width || centre.y > map.height) continue;
      const std::uint32_t there = rays.seen_by_light(map, centre);
      bool sure = true;
      for (const glm::dvec2& off :
           {glm::dvec2(0.1, 0), glm::dvec2(-0.1, 0), glm::dvec2(0, 0.1), glm::dvec2(0, -0.1)})
        sure = sure && rays.seen_by_light(map, centre + off) == there;
      certain = certain && sure;
      const bool empty_own = there == trace::kNoTriangle && x == 0 && y == 0;  // nothing is before it
      if (sure && (there == own || empty_own)) lit = true;
    }
  }
  // One that is sure lights it, whatever the others are.
  return lit ? std::optional(true) : certain ? std::optional(false) : std::nullopt;
}

struct Counts {
  std::size_t lit = 0, dark = 0, wrong = 0;
};

Counts against_rays(const Scene& scene, const Frame& frame, const Light& light, const IdentifierTest& test) {
  const Rays rays(scene, test.of);
  Counts counts;
  for (std::size_t i = 0; i < frame.pixels(); i += 3) {
    if (!frame.surface(i) || frame.map(i) < 0) continue;
    glm::dvec3 way = frame.plan.light_direction;
    if (const auto* spot = std::get_if<SpotLight>(&light)) way = frame.point(i) - spot->position;
    if (const auto* point_light = std::get_if<PointLight>(&light))
      way = frame.point(i) - point_light->position;
    if (glm::dot(frame.normal(i), glm::normalize(way)) > -0.02) continue;
    const std::optional<bool> expected = lit_by_rays(rays, frame, i, test.neighbours);
    if (!expected) continue;
    ++(*expected ? counts.lit : counts.dark);
    counts.wrong += *expected != (frame.lit(i) > 0.5f);
  }
  return counts;
}

TEST_F(Identifiers, masks_are_those_that_rays_through_texels_find) {
  const Scene scene = boxes_over_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  const Light lights[] = {DirectionalLight{kSlant}, SpotLight{{4, 12, 6}, {-0.35, -1, -0.5}, 0.6, 40.0},
                          PointLight{{1, 8, 3}, 40.0}};
  for (const Light& light : lights) {
    for (const IdentifierOf of : {IdentifierOf::instance, IdentifierOf::triangle}) {
      for (const int neighbours : {0, 1}) {
        const IdentifierTest test{of, neighbours};
        const Frame frame = drawn(renderer, camera, planned(scene, camera, light, 96), test);
        const Counts counts = against_rays(scene, frame, light, test);
        EXPECT_GT(counts.lit, 1000u);
        EXPECT_GT(counts.dark, 100u) << light.index();
        EXPECT_EQ(counts.wrong, 0u) << light.index() << static_cast<int>(of) << neighbours;
      }
    }
  }
}

TEST_F(Identifiers, cascades_and_warps_are_looked_up_alike) {
  const Scene scene = boxes_over_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  const Light light = DirectionalLight{kSlant};
  const IdentifierTest test{IdentifierOf::triangle, 0};
  const ShadowPlan plan = planned(scene, camera, light, 64, "optimal", 3);
  ASSERT_GT(plan.map_count, 1);
  const Counts counts = against_rays(scene, drawn(renderer, camera, plan, test), light, test);
  EXPECT_GT(counts.dark, 100u);
  EXPECT_EQ(counts.wrong, 0u);
}

TEST_F(Identifiers, no_instance_shadows_itself_and_no_bias_is_needed) {
  const Scene scene = hills();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  const ShadowPlan plan = planned(scene, camera, DirectionalLight{glm::normalize(glm::dvec3(1, -0.3, 0.2))});
  const Frame by_instance = drawn(renderer, camera, plan, {});
  const Frame by_triangle = drawn(renderer, camera, plan, {IdentifierOf::triangle, 0});
  FrameOptions no_plane = mask_only();
  no_plane.receiver_plane = false;
  const Frame by_depth = draw(renderer, camera, plan, default_settings(filters::hard), no_plane);
  std::size_t facing = 0, dark_of_triangle = 0, acne = 0;
  for (std::size_t i = 0; i < by_instance.pixels(); ++i) {
    if (!by_instance.surface(i) || glm::dot(by_instance.normal(i), plan.light_direction) > -0.02) continue;
    ++facing;
    ASSERT_EQ(by_instance.lit(i), 1.0f);
    dark_of_triangle += by_triangle.lit(i) < 0.5f;
    acne += by_depth.lit(i) < 0.5f;
  }
  EXPECT_GT(facing, 3000u);
  EXPECT_GT(dark_of_triangle, 100u) << "triangles do shadow each other";
  EXPECT_GT(acne, dark_of_triangle) << "the scene is to be hard for depths";
}

TEST_F(Identifiers, parts_of_large_casters_have_the_numbers_of_the_whole) {
  const Scene scene = hills();
  // A narrow view: most of the hills lie outside of the map.
  const Camera camera =
      perspective_camera({0, 6, 9}, {0.1, -0.7, -1}, {0, 1, 0}, 0.3, 1.0, 0.5, 40.0, kSize, kSize);
  Renderer renderer(scene);
  const ShadowPlan plan = planned(scene, camera, DirectionalLight{kSlant});
  for (const IdentifierOf of : {IdentifierOf::instance, IdentifierOf::triangle}) {
    FrameOptions all = mask_only();
    all.prune = kPruneNothing;
    const Frame whole = drawn(renderer, camera, plan, {of, 0}, all);
    all.prune = default_prune_rules();
    EXPECT_EQ(drawn(renderer, camera, plan, {of, 0}, all).mask.values, whole.mask.values);
    const Counts counts = against_rays(scene, whole, DirectionalLight{kSlant}, {of, 0});
    EXPECT_GT(counts.lit, 1000u);
    EXPECT_EQ(counts.wrong, 0u);
  }
}

TEST_F(Identifiers, kept_maps_hold_what_was_drawn_for_the_same_test) {
  Scene scene = boxes_over_ground();
  const Camera camera = camera_on_box(96, 96);
  Renderer renderer(scene);
  const ShadowPlan plan = planned(scene, camera, DirectionalLight{kSlant});
  const PreparedFilter by_instance = renderer.prepare(filters::hard, Source::identifiers());
  const PreparedFilter by_triangle =
      renderer.prepare(filters::hard, Source::identifiers({IdentifierOf::triangle, 0}));
  const PreparedFilter hard = renderer.prepare(filters::hard);
  renderer.draw(plan, camera, by_instance, mask_only());
  const FloatImage first = renderer.mask();
  EXPECT_TRUE(renderer.draw(plan, camera, by_instance, mask_only()).map[0].held);
  EXPECT_EQ(renderer.mask().values, first.values);
  renderer.draw(plan, camera, by_triangle, mask_only());
  const FloatImage triangles = renderer.mask();
  EXPECT_NE(triangles.values, first.values);
  renderer.draw(plan, camera, hard, mask_only());
  const FloatImage depths = renderer.mask();
  FrameOptions back = mask_only();
  back.depth_layer = DepthLayer::back;
  renderer.draw(plan, camera, hard, back);
  renderer.draw(plan, camera, by_instance, back);
  EXPECT_EQ(renderer.mask().values, first.values) << "the layer is none of theirs";
  renderer.draw(plan, camera, hard, mask_only());
  EXPECT_EQ(renderer.mask().values, depths.values);
  Instance moved = scene.instances[1];
  moved.world_from_object[3] += glm::dvec4(0.7, 0.3, 0.0, 0.0);
  moved.bounds_world.min += glm::dvec3(0.7, 0.3, 0.0);
  moved.bounds_world.max += glm::dvec3(0.7, 0.3, 0.0);
  renderer.draw(plan, camera, by_instance, mask_only());
  ASSERT_TRUE(renderer.move_instance(1, moved));
  renderer.draw(plan, camera, by_instance, mask_only());
  scene.instances[1] = moved;
  Renderer fresh(scene);
  EXPECT_EQ(renderer.mask().values, drawn(fresh, camera, plan, {}).mask.values);
}

TEST_F(Identifiers, bent_maps_are_drawn_by_depths_and_no_maps_leave_all_lit) {
  const Scene scene = boxes_over_ground();
  const Camera camera = camera_on_box(64, 64);
  Renderer renderer(scene);
  const std::vector<Box> boxes = boxes_of(scene);
  PlanOptions options;
  options.resolution.max_size = 64;
  options.warp.shape = find_shape("paraboloid");
  const ShadowPlan bent =
      make_plan(camera, SpotLight{{0, 9, 0}, {0, -1, 0.1}, 1.35, 40.0}, {boxes, boxes}, options);
  ASSERT_FALSE(bent.map[0].shape->affine);
  const PreparedFilter identified =
      renderer.prepare(filters::hard, Source::identifiers({IdentifierOf::triangle, 99}));
  EXPECT_EQ(identified.source.test.neighbours, kMaxIdentifierNeighbours);
  EXPECT_FALSE(renderer.draw(bent, camera, identified, mask_only()).identified);
  const FloatImage mask = renderer.mask();
  renderer.draw(bent, camera, renderer.prepare(filters::hard), mask_only());
  EXPECT_EQ(mask.values, renderer.mask().values);
  EXPECT_TRUE(renderer.draw(ShadowPlan{}, camera, identified, mask_only()).identified);
  const FloatImage open = renderer.mask();
  for (std::size_t i = 0; i < open.values.size(); i += 2) ASSERT_EQ(open.values[i], 1.0f);
  const Scene nothing = empty_scene();
  Renderer of_nothing(nothing);
  of_nothing.draw(bent, camera, of_nothing.prepare(filters::hard, Source::identifiers()), mask_only());
}

}  // namespace
}  // namespace gnomon::render
