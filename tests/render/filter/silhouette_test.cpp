// Shadow silhouettes: which edges are outlines, points on them, straight edges out of coarse maps, the same
// on GPU and CPU.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "casters/caster_edges.hpp"
#include "filter_harness.hpp"
#include "gnomon/render/error.hpp"
#include "mask_frame.hpp"

namespace gnomon::render {
namespace {

constexpr double kStored = 0.25, kReceiver = 0.5;

std::vector<std::uint32_t> edges_of(const std::vector<glm::vec3>& corners) {
  std::vector<std::uint32_t> all(corners.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
  return caster_edges(corners, all);
}

TEST(CasterEdges, of_a_box_are_its_edges_and_diagonals_with_two_triangles_each) {
  const std::vector<glm::vec3> corners = box_triangles({0, 0, 0}, {1, 2, 3});
  const std::vector<std::uint32_t> edges = edges_of(corners);
  ASSERT_EQ(edges.size(), 4u * 18u);
  int flat = 0;
  for (std::size_t i = 0; i < edges.size(); i += 4) {
    const auto at = [&](std::size_t k) { return corners[edges[i + k]]; };
    EXPECT_NE(edges[i], edges[i + 3]);
    const glm::vec3 across = glm::cross(at(2) - at(1), at(0) - at(1));
    flat += std::abs(glm::dot(across, at(3) - at(1))) < 1e-6f ? 1 : 0;
  }
  EXPECT_EQ(flat, 6);
}

TEST(CasterEdges, of_open_sheets_and_of_three_triangles_have_one_corner_twice) {
  const glm::vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0, -1, 0}, e{0, 0, 1};
  EXPECT_EQ(edges_of({a, b, c}), (std::vector<std::uint32_t>{2, 0, 1, 2, 1, 2, 0, 1, 0, 1, 2, 0}));
  const std::vector<std::uint32_t> fan = edges_of({a, b, c, b, a, d, a, b, e});
  ASSERT_EQ(fan.size(), 4u * 7u);
  for (std::size_t i = 0; i < fan.size(); i += 4) EXPECT_EQ(fan[i], fan[i + 3]);
}

TEST(CasterEdges, skip_triangles_without_area_and_take_nothing) {
  EXPECT_TRUE(edges_of({}).empty());
  EXPECT_TRUE(edges_of({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}).empty());
}

/// Share of points within a texel of the line y = x slope, below which it is dark, on its wrong side.
double wrong_share(double slope, const Filter& filter) {
  const auto below = [slope](const glm::dvec2& p) { return p.y < slope * p.x; };
  FilterLookup lookup;
  lookup.depth = kReceiver;
  lookup.map_depth = [&](int x, int y) { return below({x + 0.5, y + 0.5}) ? kStored : 1.0; };
  // Where the line crosses the diagonals of the square between four centres.
  lookup.silhouette = [slope](int x, int y) {
    const double c = slope * (x + 0.5) - (y + 0.5);  // over the square: y = c + slope x
    const double rising = c / (1.0 - slope), falling = (1.0 - c) / (1.0 + slope);
    const bool on_rising = rising >= 0.0 && rising <= 1.0, on_falling = falling >= 0.0 && falling <= 1.0;
    if (!on_rising && !on_falling) return glm::dvec2(0.5);
    const double at = on_rising && on_falling ? 0.5 * (rising + falling) : on_rising ? rising : falling;
    return glm::dvec2(at, c + slope * at);
  };
  int wrong = 0, all = 0;
  for (double y = -8.0; y < 8.0; y += 0.0625) {
    for (double x = -16.0; x < 16.0; x += 0.0625) {
      lookup.position = {x + 0.03125, y + 0.03125};
      if (std::abs(lookup.position.y - slope * lookup.position.x) > std::sqrt(1.0 + slope * slope)) continue;
      const double lit = filter.reference.visibility({}, lookup, default_settings(filter));
      ++all;
      wrong += (lit > 0.5) == below(lookup.position) ? 1 : 0;
    }
  }
  EXPECT_GT(all, 1000);
  return 1.0 * wrong / all;
}

TEST(SilhouetteFilter, has_every_straight_edge_in_its_place) {
  for (const double slope : {0.0, 0.2, 0.37, 0.5, 0.8, 1.3, 2.0, 5.0, -0.3, -2.5}) {
    if (slope != 0.0) {
      EXPECT_GT(wrong_share(slope, filters::hard), 0.08) << slope;
    }
    // Centres of texels that lie on the line itself may be either.
    EXPECT_LT(wrong_share(slope, filters::silhouette), 0.005) << slope;
  }
}

TEST(SilhouetteFilter, compares_with_the_nearest_texel_where_there_is_no_outline) {
  const TestMap map = random_map(24, 24, 9);
  FilterLookup lookup;
  lookup.depth = kReceiver;
  lookup.map_depth = [&map](int x, int y) { return map.at(x, y); };
  for (const Question& q : random_questions(map, 1000, 5)) {
    lookup.position = glm::dvec2(q.position) + 0.01;
    EXPECT_EQ(filters::silhouette.reference.visibility({}, lookup, default_settings(filters::silhouette)),
              filters::hard.reference.visibility({}, lookup, default_settings(filters::hard)));
  }
}

TEST(SilhouetteFilter, returns_the_same_on_gpu_and_cpu) {
  const TestMap map = random_map(64, 48, 3);
  const std::vector<Question> questions = random_questions(map, 4096, 4);
  const FilterSettings settings = default_settings(filters::silhouette);
  const std::vector<float> gpu = ask_shader(settings, map, questions);
  const std::vector<double> cpu = ask_reference(settings, map, questions);
  TestMap without = map;
  without.silhouette.clear();
  const std::vector<double> nearest = ask_reference(settings, without, questions);
  int moved = 0;
  for (std::size_t i = 0; i < gpu.size(); ++i) {
    ASSERT_EQ(gpu[i], static_cast<float>(cpu[i]))
        << i << ": " << questions[i].position.x << " " << questions[i].position.y;
    moved += cpu[i] != nearest[i] ? 1 : 0;
  }
  EXPECT_GT(moved, 200);
}

/// Moves no shadow; the receiver's plane alone keeps it from shadowing itself.
constexpr BiasOptions kNoOffset{0.05, 0.0, 0.0, 8.0};

/// A box that floats turned over the ground: no edge of its shadow runs along texels, none is a contact.
Scene turned_box(glm::dmat4& world_from_box) {
  Scene scene = empty_scene();
  add_quad(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  world_from_box = glm::rotate(glm::translate(glm::dmat4(1.0), {0.2, 1.5, 0.3}), 0.6, {0.3, 1.0, 0.2});
  add_mesh(scene, box_triangles(kBoxMin, kBoxMax), world_from_box);
  return scene;
}

/// Pixels of the ground that are lit though the box shadows them, or dark though it does not.
int wrong_pixels(const Frame& frame, const glm::dmat4& world_from_box, const glm::dvec4& light) {
  const glm::dmat4 box_from_world = glm::inverse(world_from_box);
  int wrong = 0;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    if (!frame.surface(i) || frame.map(i) < 0 || frame.normal(i).y < 0.99 || frame.point(i).y > 1e-3)
      continue;
    const glm::dvec3 to_light = glm::dvec3(light) - light.w * frame.point(i);
    const glm::dvec3 p = box_from_world * glm::dvec4(frame.point(i), 1.0),
                     d = box_from_world * glm::dvec4(to_light, 0.0);
    const bool dark = hits_box(p, d, glm::dvec3(kBoxMin), glm::dvec3(kBoxMax));
    wrong += dark == (frame.lit(i) > 0.5f) ? 1 : 0;
  }
  return wrong;
}

TEST(SilhouettePass, draws_the_edges_of_a_box_in_their_place_out_of_64_texels) {
  glm::dmat4 world_from_box;
  const Scene scene = turned_box(world_from_box);
  const Camera camera = camera_on_box(2 * kSize, 2 * kSize);
  Renderer renderer(scene);
  for (const Warp* warp : {&warps::none, &warps::lispsm}) {
    PlanOptions options;
    options.resolution.max_size = 64;
    options.cascades = 1;
    options.warp.warp = warp;
    options.bias = kNoOffset;
    set_margin(default_settings(filters::silhouette), options);
    const ShadowPlan plan = plan_for(scene, camera, kSlant, options);
    const glm::dvec4 light(-kSlant, 0.0);
    const int hard = wrong_pixels(draw(renderer, camera, plan, filters::hard), world_from_box, light);
    const int exact = wrong_pixels(draw(renderer, camera, plan, filters::silhouette), world_from_box, light);
    EXPECT_GT(hard, 300) << warp->name;
    EXPECT_LT(exact, hard / 8) << warp->name;
  }
}

TEST(SilhouettePass, serves_lights_whose_rays_spread) {
  glm::dmat4 world_from_box;
  const Scene scene = turned_box(world_from_box);
  const Camera camera = camera_on_box(2 * kSize, 2 * kSize);
  const SpotLight spot{.position = {-4.0, 9.0, 3.0},
                       .direction = glm::normalize(glm::dvec3(4, -9, -3)),
                       .outer_radians = 0.7,
                       .range = 40.0};
  PlanOptions options;
  options.resolution.max_size = 64;
  options.bias = kNoOffset;
  set_margin(default_settings(filters::silhouette), options);
  const std::vector<Box> boxes = boxes_of(scene);
  const ShadowPlan plan = make_plan(camera, spot, {boxes, boxes}, options);
  ASSERT_EQ(plan.map_count, 1);
  Renderer renderer(scene);
  const glm::dvec4 light(spot.position, 1.0);
  const int hard = wrong_pixels(draw(renderer, camera, plan, filters::hard), world_from_box, light);
  const int exact = wrong_pixels(draw(renderer, camera, plan, filters::silhouette), world_from_box, light);
  EXPECT_GT(hard, 300);
  EXPECT_LT(exact, hard / 8);
  FrameOptions even;
  even.linear_depth = true;
  const Frame of_even = draw(renderer, camera, plan, default_settings(filters::silhouette), even);
  EXPECT_LT(wrong_pixels(of_even, world_from_box, light), hard / 8) << "depths even along the light";
}

TEST(SilhouettePass, follows_casters_that_move_and_maps_that_were_drawn_without_it) {
  glm::dmat4 world_from_box;
  const Scene scene = turned_box(world_from_box);
  const Camera camera = camera_on_box(kSize, kSize);
  PlanOptions options;
  options.resolution.max_size = 128;
  options.cascades = 2;
  set_margin(default_settings(filters::silhouette), options);
  const ShadowPlan plan = plan_for(scene, camera, kSlant, options);
  Renderer fresh(scene), used(scene);
  const auto mask_of = [&](Renderer& renderer) {
    return draw(renderer, camera, plan, filters::silhouette).mask.values;
  };
  const std::vector<float> first = mask_of(fresh);
  EXPECT_NE(draw(used, camera, plan, filters::hard).mask.values, first);
  EXPECT_EQ(mask_of(used), first);
  EXPECT_EQ(mask_of(used), first) << "held";
  Instance moved = scene.instances[1];
  moved.world_from_object = glm::translate(glm::dmat4(1.0), {0.3, 0.0, -0.4}) * moved.world_from_object;
  moved.bounds_world.min += glm::dvec3(0.3, 0.0, -0.4);
  moved.bounds_world.max += glm::dvec3(0.3, 0.0, -0.4);
  Scene after = scene;
  after.instances[1] = moved;
  ASSERT_TRUE(used.move_instance(1, moved));
  Renderer anew(after);
  EXPECT_EQ(mask_of(used), mask_of(anew));
  EXPECT_NE(mask_of(used), first);
}

TEST(SilhouettePass, refuses_pages_and_many_lights_in_one_line) {
  Renderer renderer(box_on_ground());
  const FilterSettings settings = default_settings(filters::silhouette);
  EXPECT_THROW((void)renderer.prepare(settings, Source::pages), RenderError);
  EXPECT_THROW((void)renderer.prepare(settings, Source::lights), RenderError);
}

TEST(SilhouettePass, takes_scenes_without_triangles) {
  const Scene scene = empty_scene();
  Renderer renderer(scene);
  const Camera camera = camera_on_box(kSize, kSize);
  const Frame frame = draw(renderer, camera, plan_for(scene, camera, kSlant, {}), filters::silhouette);
  EXPECT_FALSE(frame.surface(0));
}

}  // namespace
}  // namespace gnomon::render
