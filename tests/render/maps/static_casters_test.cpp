// Do maps and pages whose static casters have depths of their own hold what drawing everything holds, and do
// moving casters cost their own triangles alone?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <random>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "casters/moving_casters.hpp"
#include "gnomon/render/renderer.hpp"
#include "mask_frame.hpp"
#include "source/page_runs.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

constexpr std::uint64_t kBoxTriangles = 12;
/// Casters that the plan culls may be in kept maps, where no look-up reads.
constexpr PruneRules kKeeping = exact_prune_rules().without(PruneRule::swept_casters);
constexpr PruneRules kRedrawing = kKeeping.without(PruneRule::held_maps);

std::vector<Light> all_lights() {
  return {DirectionalLight{kSlant}, SpotLight{{-4.0, 6.0, 3.0}, {0.5, -0.8, -0.3}, 0.9, 60.0},
          PointLight{{-4.0, 6.0, 3.0}, 60.0}};
}

/// A scene that two renderers follow: one keeps what it can, the other draws everything in every frame.
struct Pair {
  Scene scene;
  Light light = DirectionalLight{kSlant};
  Renderer keeps, redraws;
  std::vector<Box> boxes;
  PlanOptions options;
  PageOptions pages;
  std::vector<std::byte> memory = std::vector<std::byte>(page_memory(4096, 1 << 17));
  FilterSettings filter = default_settings(filters::hard);
  FilterSettings looks = default_settings(filters::hard);  ///< of the frame that finds points for pages
  FrameOptions drawing;
  FrameStats last, whole;
  std::size_t blocks = 0;  ///< with a page that the last frame drew

  explicit Pair(const Scene& of = boxes_on_ground())
      : scene(of), keeps(scene), redraws(scene), boxes(boxes_of(scene)) {
    options.fit = Fit::stable;
    options.resolution.max_size = 128;
    options.prune = exact_prune_rules();
    pages.page_texels = 64;
    pages.fallback = true;
    pages.policy = &page_policies::clipmap;
    drawing.aliasing = drawing.heat_map = drawing.cascade_tint = drawing.time_passes = false;
    drawing.prune = kKeeping;
  }
  void place(std::size_t instance, const Instance& at) {
    scene.instances[instance] = at;
    boxes[instance] = at.bounds_world;
    ASSERT_TRUE(keeps.move_instance(instance, at));
    ASSERT_TRUE(redraws.move_instance(instance, at));
  }
  void move(std::size_t instance, const glm::dvec3& by) {
    Instance at = scene.instances[instance];
    at.world_from_object = glm::translate(glm::dmat4(1.0), by) * at.world_from_object;
    at.bounds_world = {at.bounds_world.min + by, at.bounds_world.max + by};
    place(instance, at);
  }
  /// Draws everything, and needs no bounds of what moved.
  [[nodiscard]] static FrameOptions all_of(FrameOptions how) {
    how.prune = kRedrawing;
    how.moved_world = {};
    return how;
  }
  /// Texels and pixels of a frame of maps that differ.
  std::size_t stale(const Camera& camera) {
    PlanOptions with = options;
    set_margin(filter, with);
    const ShadowPlan plan = make_plan(camera, light, {boxes, boxes}, with);
    last = keeps.draw(plan, camera, keeps.prepare(filter), drawing);
    whole = redraws.draw(plan, camera, redraws.prepare(filter), all_of(drawing));
    std::size_t differ = keeps.mask().values == redraws.mask().values ? 0 : 1;
    for (int map = 0; map < plan.map_count; ++map) {
      const std::vector<float> a = keeps.depth_map(map).values, b = redraws.depth_map(map).values;
      for (std::size_t i = 0; i < a.size(); ++i) differ += a[i] != b[i];
    }
    return differ;
  }
  /// The same of pages.
  std::size_t stale_pages(const Camera& camera) {
    PageOptions with = pages;
    with.plan = options;
    set_margin(filter, with.plan);
    keeps.draw(ShadowPlan{}, camera, keeps.prepare(looks), drawing);
    const FloatImage at = keeps.positions();
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < at.values.size(); i += 4 * 3) {
      const float* p = &at.values[i];
      if (p[3] > 0.0f) points.push_back(camera.position + glm::dvec3(p[0], p[1], p[2]));
    }
    const PagePlan plan =
        plan_pages({.camera = camera, .points_world = points}, light, {boxes, boxes}, with, memory);
    EXPECT_EQ(plan.status, PlanStatus::ok);
    last = keeps.draw(plan, camera, keeps.prepare(filter, Source::pages), drawing);
    whole = redraws.draw(plan, camera, redraws.prepare(filter, Source::pages), all_of(drawing));
    std::size_t differ = keeps.mask().values == redraws.mask().values ? 0 : 1;
    std::set<std::tuple<std::uint32_t, std::int64_t, std::int64_t>> drawn;
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
      const PageBlock block = block_of(plan, plan.pages[i]);
      if (keeps.drew_page(i)) drawn.insert({block.level, block.column, block.row});
      const std::vector<float> a = keeps.page_depths(i).values, b = redraws.page_depths(i).values;
      for (std::size_t k = 0; k < a.size(); ++k) differ += a[k] != b[k];
    }
    blocks = drawn.size();
    return differ;
  }
  [[nodiscard]] std::uint64_t triangles() const {
    std::uint64_t sum = 0;
    for (int map = 0; map < last.map_count; ++map) sum += last.map[static_cast<std::size_t>(map)].triangles;
    return sum;
  }
  [[nodiscard]] std::uint64_t copied() const {
    std::uint64_t sum = 0;
    for (int map = 0; map < last.map_count; ++map) sum += last.map[static_cast<std::size_t>(map)].copied;
    return sum;
  }
};

TEST(StaticCasters, a_box_that_walks_costs_its_own_triangles) {
  for (const Light& light : all_lights()) {
    for (const char* name : {"hard", "vsm:radius=2", "pcf"}) {
      SCOPED_TRACE(std::string(name) + ", light " + std::to_string(light.index()));
      Pair pair;
      pair.light = light;
      pair.filter = parse_filter(name).settings;
      ASSERT_EQ(pair.stale(going(0)), 0u);
      const std::uint64_t bytes = pair.last.map_bytes;
      for (int frame = 0; frame < 12; ++frame) {
        pair.move(1, {0.13, 0.0, -0.07});
        ASSERT_EQ(pair.stale(going(0)), 0u) << "frame " << frame;
        if (frame == 0) continue;  // the static casters at its place are drawn without it
        EXPECT_LE(pair.triangles(), kBoxTriangles * static_cast<std::uint64_t>(pair.last.map_count));
        EXPECT_GT(pair.triangles(), 0u);
        EXPECT_GT(pair.copied(), 0u);
        EXPECT_LT(pair.copied(), pair.whole.texels / 2);
        EXPECT_GT(pair.last.saved[static_cast<std::size_t>(PruneRule::static_casters)].triangles, 0u);
      }
      EXPECT_GT(pair.last.map_bytes, bytes) << "static casters have texels of their own";
    }
  }
}

TEST(StaticCasters, the_rule_changes_no_pixel) {
  Pair with, without;
  without.drawing.prune = kKeeping.without(PruneRule::static_casters);
  for (int frame = 0; frame < 20; ++frame) {
    for (Pair* pair : {&with, &without}) {
      pair->move(1, {0.13, 0.0, -0.07});
      ASSERT_EQ(pair->stale(going(frame / 4)), 0u) << "frame " << frame;
    }
    EXPECT_EQ(with.keeps.mask().values, without.keeps.mask().values);
    EXPECT_EQ(without.copied(), 0u);
  }
  EXPECT_LT(with.triangles(), without.triangles());
}

TEST(StaticCasters, maps_without_static_casters_have_no_copies) {
  Pair pair;
  ASSERT_EQ(pair.stale(going(0)), 0u);
  const std::uint64_t bytes = pair.last.map_bytes;
  const auto move_all = [&] {
    for (std::size_t i = 0; i < pair.boxes.size(); ++i) pair.move(i, {0.13, 0.0, -0.07});
  };
  for (int frame = 0; frame < 4; ++frame) {
    move_all();
    ASSERT_EQ(pair.stale(going(0)), 0u) << "frame " << frame;
    EXPECT_EQ(pair.copied(), 0u) << "frame " << frame;
    EXPECT_EQ(pair.last.map_bytes, bytes) << "frame " << frame;
  }
  // All but one come to rest, and lie beneath it then.
  for (int frame = 0; frame < MovingCasters::kRestFrames + 4; ++frame) {
    pair.move(1, {0.01, 0.0, 0.0});
    ASSERT_EQ(pair.stale(going(0)), 0u) << "frame " << frame;
  }
  EXPECT_GT(pair.copied(), 0u);
  EXPECT_GT(pair.last.map_bytes, bytes);
  move_all();
  ASSERT_EQ(pair.stale(going(0)), 0u) << "static casters begin to move";
}

TEST(StaticCasters, depths_from_before_all_casters_moved_are_not_taken_up_again) {
  Pair pair;
  const auto frame = [&](std::size_t movers) {
    for (std::size_t i = 0; i < movers; ++i) pair.move(i + 1 == movers ? 0 : i + 1, {0.13, 0.0, -0.07});
    ASSERT_EQ(pair.stale(going(0)), 0u);
  };
  for (int i = 0; i < 3; ++i) {
    pair.move(1, {0.13, 0.0, -0.07});
    ASSERT_EQ(pair.stale(going(0)), 0u);
  }
  EXPECT_GT(pair.copied(), 0u) << "the others lie beneath";
  for (int i = 0; i < 3; ++i) frame(pair.boxes.size());
  // The ground goes on, so that nothing else draws the whole map.
  for (int i = 0; i < MovingCasters::kRestFrames + 4; ++i) {
    pair.move(0, {0.01, 0.0, 0.0});
    ASSERT_EQ(pair.stale(going(0)), 0u) << "frame " << i;
  }
  EXPECT_GT(pair.copied(), 0u) << "they do again";
}

TEST(StaticCasters, a_caster_that_rests_becomes_static_and_costs_nothing) {
  Pair pair;
  ASSERT_EQ(pair.stale(going(0)), 0u);
  pair.move(1, {0.5, 0.0, 0.0});
  for (int frame = 0; frame < MovingCasters::kRestFrames + 4; ++frame)
    ASSERT_EQ(pair.stale(going(0)), 0u) << "frame " << frame;
  EXPECT_EQ(pair.triangles(), 0u);
  EXPECT_EQ(pair.last.texels, 0u);
  pair.move(2, {0.5, 0.0, 0.0});
  ASSERT_EQ(pair.stale(going(0)), 0u);
  pair.move(1, {0.5, 0.0, 0.0});
  ASSERT_EQ(pair.stale(going(0)), 0u) << "it moves again, from where it rested";
  pair.move(1, {0.5, 0.0, 0.0});
  ASSERT_EQ(pair.stale(going(0)), 0u);
  EXPECT_LE(pair.triangles(), 2 * kBoxTriangles * static_cast<std::uint64_t>(pair.last.map_count));
}

TEST(StaticCasters, maps_that_scroll_stay_within_their_bound_beneath_a_moving_caster) {
  Pair pair;
  pair.drawing.prune = kKeeping.with(PruneRule::scrolled_maps);
  std::size_t pixels = 0, off = 0;
  bool scrolled = false;
  for (int frame = 0; frame < 60; ++frame) {
    pair.move(1, {0.05, 0.0, -0.03});
    (void)pair.stale(going(frame));
    const std::vector<float> a = pair.keeps.mask().values, b = pair.redraws.mask().values;
    pixels += a.size() / 2;
    for (std::size_t i = 0; i < a.size(); i += 2) off += std::abs(a[i] - b[i]) > 0.5f / 255.0f;
    for (int map = 0; map < pair.last.map_count; ++map)
      scrolled = scrolled || pair.last.map[static_cast<std::size_t>(map)].scrolled;
  }
  EXPECT_TRUE(scrolled);
  EXPECT_LE(off, pixels / 5000);
}

TEST(StaticCasters, layers_that_are_peeled_are_drawn_whole) {
  for (const DepthLayer layer : {DepthLayer::back, DepthLayer::second, DepthLayer::dual}) {
    Pair pair;
    pair.drawing.depth_layer = layer;
    for (int frame = 0; frame < 4; ++frame) {
      pair.move(1, {0.13, 0.0, -0.07});
      ASSERT_EQ(pair.stale(going(0)), 0u) << static_cast<int>(layer) << " frame " << frame;
      if (info_of(layer).peels) {
        EXPECT_EQ(pair.copied(), 0u);
      }
    }
  }
}

TEST(StaticCasters, pages_compose_what_a_walking_box_reaches) {
  std::size_t pages = 0, blocks = 0;
  for (const Light& light : all_lights()) {
    for (const PagePolicy* policy : {&page_policies::resolution, &page_policies::clipmap}) {
      SCOPED_TRACE(std::string(policy->name) + ", light " + std::to_string(light.index()));
      Pair pair;
      pair.light = light;
      pair.pages.policy = policy;
      ASSERT_EQ(pair.stale_pages(going(0)), 0u);
      int composed = 0;
      for (int frame = 0; frame < 16; ++frame) {
        pair.move(1, {0.13, 0.0, -0.07});
        ASSERT_EQ(pair.stale_pages(going(0.5 * frame)), 0u) << "frame " << frame;
        composed += pair.last.pages_composed;
        EXPECT_LE(pair.last.pages_composed, pair.last.pages_drawn);
      }
      EXPECT_GT(composed, 0);
      // At rest the camera needs no page but those that the box reaches, and of them the box alone.
      ASSERT_EQ(pair.stale_pages(going(8)), 0u);
      pair.move(1, {0.05, 0.0, -0.02});
      ASSERT_EQ(pair.stale_pages(going(8)), 0u);
      EXPECT_EQ(pair.last.pages_composed, pair.last.pages_drawn);
      EXPECT_EQ(pair.triangles(), kBoxTriangles * pair.blocks) << "once for all pages of a block";
      pages += static_cast<std::size_t>(pair.last.pages_drawn);
      blocks += pair.blocks;
    }
  }
  EXPECT_GT(blocks, 0u);
  EXPECT_LT(blocks, pages);
}

TEST(StaticCasters, pages_compose_after_frames_that_drew_outlines) {
  Pair pair;
  pair.looks = default_settings(filters::silhouette);
  ASSERT_EQ(pair.stale_pages(going(0)), 0u);
  for (int frame = 0; frame < 2; ++frame) {
    pair.move(1, {0.1, 0.0, 0.0});
    ASSERT_EQ(pair.stale_pages(going(0)), 0u);
  }
  EXPECT_GT(pair.last.pages_composed, 0);
}

TEST(StaticCasters, a_page_out_of_view_while_a_caster_walks_is_right_when_it_comes_back) {
  Pair pair;
  for (int frame = 0; frame < 4; ++frame) {
    pair.move(1, {0.1, 0.0, 0.0});
    ASSERT_EQ(pair.stale_pages(going(0)), 0u);
  }
  Camera away = going(0);
  away.forward = -away.forward;
  away.forward.y = going(0).forward.y;
  for (int frame = 0; frame < 4; ++frame) {
    pair.move(1, {0.1, 0.0, 0.0});
    ASSERT_EQ(pair.stale_pages(away), 0u);
  }
  ASSERT_EQ(pair.stale_pages(going(0)), 0u);
}

TEST(CasterShapes, a_mesh_that_bends_before_it_is_read_has_bounds_alone_for_what_it_was) {
  const Scene scene = box_on_ground();
  SceneBuffers buffers(scene);
  CasterShapes shapes(buffers);
  const Primitive& box = scene.primitives[scene.instances[1].primitive];
  const auto indices = std::span(scene.indices).subspan(box.first_index, box.index_count);
  const auto [first, last] = std::minmax_element(indices.begin(), indices.end());
  const std::size_t count = *last - *first + 1;
  const auto bend = [&, begin = *first](float by) {
    std::vector<glm::vec3> positions(scene.positions.begin() + begin,
                                     scene.positions.begin() + begin + count);
    for (glm::vec3& position : positions) position.y += by;
    shapes.bend(1, begin, positions);
    buffers.bend(begin, positions, std::span(scene.normals).subspan(begin, count));
  };
  const auto height = [](const CasterShape& shape) {
    float highest = 0.0f;
    for (const glm::vec3& position : shape.positions) highest = std::max(highest, position.y);
    return highest;
  };
  bend(0.25f);
  std::span<const MovedCaster> moved = shapes.moved();
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(moved[0].from.size(), 0u);
  EXPECT_EQ(moved[0].from.bounds_world.max, scene.instances[1].bounds_world.max);
  EXPECT_EQ(moved[0].to.size(), kBoxTriangles);
  EXPECT_EQ(height(moved[0].to), kBoxMax.y + 0.25f);
  shapes.forget_moves();
  EXPECT_TRUE(shapes.moved().empty());
  bend(0.5f);
  moved = shapes.moved();
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(moved[0].from.size(), kBoxTriangles);
  EXPECT_EQ(height(moved[0].from), kBoxMax.y + 0.25f);
  EXPECT_EQ(height(moved[0].to), kBoxMax.y + 0.5f);
  shapes.forget_moves();
  shapes.keep(1);
  moved = shapes.moved();
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(height(moved[0].from), kBoxMax.y + 0.5f);
  EXPECT_EQ(height(moved[0].to), kBoxMax.y + 0.5f);
}

// Everything that a scene can do, in random order.
TEST(StaticCasters, nothing_is_stale_whatever_moves) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    std::mt19937 random(seed);
    const auto chance = [&](unsigned of) { return random() % of == 0; };
    const auto within = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
    };
    Pair pair;
    pair.light = all_lights()[seed % 3];
    double at = 0.0;
    const Scene first = pair.scene;
    for (int frame = 0; frame < 70; ++frame) {
      const bool all = chance(12);
      for (std::size_t i = 1; i < pair.scene.instances.size(); ++i) {
        if (!all && !(i < 4 && !chance(3)) && !chance(25)) continue;
        if (chance(20)) {  // far outside of every map, and back again
          pair.move(i, {within(-500, 500), 0.0, within(-500, 500)});
        } else if (chance(10)) {
          pair.place(i, first.instances[i]);
        } else if (chance(15)) {  // disappears: scaled to a point
          Instance point = pair.scene.instances[i];
          point.world_from_object = glm::scale(first.instances[i].world_from_object, glm::dvec3(0.0));
          point.bounds_world = {glm::dvec3(0.0), glm::dvec3(0.0)};
          pair.place(i, point);
        } else {
          pair.move(i, {within(-0.3, 0.3), 0.0, within(-0.3, 0.3)});
        }
      }
      const Box named = pair.boxes[random() % pair.boxes.size()];
      pair.drawing.moved_world = chance(10) ? std::span<const Box>(&named, 1) : std::span<const Box>();
      pair.drawing.prune = chance(8)    ? kKeeping.without(PruneRule::static_casters)
                           : chance(15) ? kRedrawing
                                        : kKeeping;
      if (chance(3)) at += 1.0;
      pair.options.cascades = chance(10) ? 2 : 3;
      ASSERT_EQ(chance(4) || seed == 4 ? pair.stale_pages(going(at)) : pair.stale(going(at)), 0u)
          << "seed " << seed << ", frame " << frame;
    }
  }
}

}  // namespace
}  // namespace gnomon::render
