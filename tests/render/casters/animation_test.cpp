// Does a renderer that follows an animation draw what one made of the posed scene draws, and is nothing
// stale?
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "animated_gltf.hpp"
#include "gnomon/scene/pose.hpp"
#include "mask_frame.hpp"
#include "shared_files.hpp"

namespace gnomon::render {
namespace {

constexpr double kFrameSeconds = 1.0 / 30.0;

Scene animated_scene() {
  return test::animated_gltf().load();
}

Camera watching(int frame, int size = 96) {
  Camera camera = camera_on_box(size, size);
  camera.position += glm::dvec3(0.03, 0.005, -0.05) * static_cast<double>(frame);
  return camera;
}

/// A scene that two renderers follow: one keeps what it can from frame to frame, the other draws all.
struct Pair {
  explicit Pair(const Scene& of) : scene(of), posed(of), keeps(of), redraws(of) {
    options.fit = Fit::stable;
    options.resolution.max_size = 256;
  }
  void go(double time_s, int animation = 0) {
    Pose at;
    ASSERT_TRUE(pose(scene, animation, looped_time(scene.motion.animations.at(0), time_s), at));
    ASSERT_TRUE(keeps.apply_pose(at));
    ASSERT_TRUE(redraws.apply_pose(at));
    gnomon::apply_pose(at, posed);
    boxes = boxes_of(posed);
  }
  /// Texels and pixels that differ.
  std::size_t stale(const Camera& camera, const Light& light, const FilterSettings& filter) {
    PlanOptions with = options;
    set_margin(filter, with);
    with.prune = exact_prune_rules();
    const ShadowPlan plan = make_plan(camera, light, {boxes, boxes}, with);
    FrameOptions draw;
    draw.aliasing = draw.heat_map = draw.cascade_tint = draw.time_passes = false;
    draw.prune = rules;
    last = keeps.draw(plan, camera, keeps.prepare(filter), draw);
    draw.prune = draw.prune.without(PruneRule::held_maps).without(PruneRule::scrolled_maps);
    const FrameStats whole = redraws.draw(plan, camera, redraws.prepare(filter), draw);
    texels += last.texels;
    all_texels += whole.texels;
    std::size_t differ = keeps.mask().values == redraws.mask().values ? 0 : 1;
    for (int map = 0; map < plan.map_count; ++map) {
      const std::vector<float> a = keeps.depth_map(map).values, b = redraws.depth_map(map).values;
      for (std::size_t i = 0; i < a.size(); ++i) differ += a[i] != b[i];
    }
    return differ;
  }

  Scene scene, posed;
  Renderer keeps, redraws;
  PlanOptions options;
  PruneRules rules = exact_prune_rules();
  std::vector<Box> boxes;
  FrameStats last;
  std::uint64_t texels = 0, all_texels = 0;
};

TEST(Animation, the_test_scene_holds_all_that_moves) {
  const Scene scene = animated_scene();
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_EQ(scene.motion.animations.at(0).channels.size(), 5u);
  EXPECT_EQ(scene.motion.meshes.size(), 2u);
  EXPECT_EQ(scene.motion.instances.size(), 3u);
}

TEST(Animation, a_posed_renderer_is_one_of_the_posed_scene_bit_for_bit) {
  Pair pair(animated_scene());
  const Camera camera = watching(0, 160);
  const FilterSettings filter = default_settings(filters::pcf);
  for (const double time : {0.0, 0.7, 1.6, 2.9, 3.3}) {
    SCOPED_TRACE(time);
    pair.go(time);
    Renderer anew(pair.posed);
    const ShadowPlan plan = plan_for(pair.posed, camera, kSlant, pair.options);
    const Frame kept = draw(pair.keeps, camera, plan, filter), fresh = draw(anew, camera, plan, filter);
    EXPECT_EQ(kept.mask.values, fresh.mask.values);
    EXPECT_EQ(kept.normals.values, fresh.normals.values);
    EXPECT_EQ(kept.positions.values, fresh.positions.values);
    EXPECT_EQ(pair.keeps.image().rgba, anew.image().rgba);
  }
}

TEST(Animation, shadows_move_with_their_casters) {
  Pair pair(animated_scene());
  const FilterSettings filter = default_settings(filters::hard);
  std::vector<std::vector<float>> masks;
  for (const double time : {0.0, 0.5, 1.5}) {
    pair.go(time);
    ASSERT_EQ(pair.stale(watching(0), DirectionalLight{kSlant}, filter), 0u);
    masks.push_back(pair.keeps.mask().values);
  }
  EXPECT_NE(masks[0], masks[1]);
  EXPECT_NE(masks[1], masks[2]);
}

// The same pose again moves nothing, and a camera at rest then has nothing to draw.
TEST(Animation, a_pose_that_stays_costs_nothing) {
  Pair pair(animated_scene());
  const FilterSettings filter = default_settings(filters::hard);
  pair.go(1.0);
  (void)pair.stale(watching(0), DirectionalLight{kSlant}, filter);
  pair.go(1.0);
  ASSERT_EQ(pair.stale(watching(0), DirectionalLight{kSlant}, filter), 0u);
  EXPECT_EQ(pair.last.texels, 0u);
  pair.go(1.0 + kFrameSeconds);
  ASSERT_EQ(pair.stale(watching(0), DirectionalLight{kSlant}, filter), 0u);
  EXPECT_GT(pair.last.texels, 0u);
}

TEST(Animation, kept_maps_redraw_what_moved_and_nothing_is_stale) {
  const std::vector<Light> lights{DirectionalLight{kSlant},
                                  SpotLight{{-4.0, 6.0, 3.0}, {0.5, -0.8, -0.3}, 0.9, 60.0},
                                  PointLight{{-4.0, 6.0, 3.0}, 60.0}};
  for (const Light& light : lights) {
    for (const char* name : {"hard", "vsm:radius=2"}) {
      SCOPED_TRACE(std::string(name) + ", light " + std::to_string(light.index()));
      Pair pair(animated_scene());
      const FilterSettings filter = parse_filter(name).settings;
      for (int frame = 0; frame < 24; ++frame) {
        pair.go(4.0 * frame * kFrameSeconds);
        ASSERT_EQ(pair.stale(watching(0), light, filter), 0u) << "frame " << frame;
      }
      EXPECT_LT(pair.texels, pair.all_texels * 2 / 3);
    }
  }
}

TEST(Animation, frames_without_maps_forget_nothing_that_moved) {
  Pair pair(animated_scene());
  const FilterSettings filter = default_settings(filters::hard);
  pair.go(0.0);
  ASSERT_EQ(pair.stale(watching(0), DirectionalLight{kSlant}, filter), 0u);
  pair.go(0.4);
  draw(pair.keeps, watching(0), ShadowPlan{}, filter);
  pair.go(0.8);
  draw(pair.keeps, watching(0), ShadowPlan{}, filter);
  ASSERT_EQ(pair.stale(watching(0), DirectionalLight{kSlant}, filter), 0u);
  EXPECT_LT(pair.last.texels, pair.all_texels / 2) << "and keep the maps";
}

// Maps of a moving camera, of a mirrored figure, and of one that another plan left: all are as drawn anew.
TEST(Animation, a_flight_through_the_animation_has_no_stale_texel) {
  Pair pair(animated_scene());
  const FilterSettings filter = default_settings(filters::hard);
  for (int frame = 0; frame < 60; ++frame) {
    pair.go(2.0 * frame * kFrameSeconds);
    pair.options.cascades = frame % 20 == 7 ? 1 : 3;
    // Scrolled strips may differ by an edge's rounding; the rule is checked where the camera rests.
    ASSERT_EQ(pair.stale(watching(frame / 10), DirectionalLight{kSlant}, filter), 0u) << "frame " << frame;
  }
  EXPECT_LT(pair.texels, pair.all_texels);
}

TEST(Animation, kept_pages_of_a_flight_have_no_stale_texel) {
  Pair pair(animated_scene());
  pair.options.fit = Fit::stable;
  const FilterSettings filter = default_settings(filters::hard);
  set_margin(filter, pair.options);
  PageOptions pages;
  pages.page_texels = 64;
  pages.policy = &page_policies::clipmap;
  pages.fallback = true;
  pages.plan = pair.options;
  std::vector<std::byte> memory(page_memory(4096, 1 << 17));
  std::size_t kept = 0, all = 0;
  for (int frame = 0; frame < 30; ++frame) {
    pair.go(2.0 * frame * kFrameSeconds);
    const Camera camera = watching(frame);
    // Points as the renderer itself sees them: frames without maps between those of pages.
    const Frame seen = draw(pair.keeps, camera, ShadowPlan{}, filter);
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < seen.pixels(); i += 3) {
      if (seen.surface(i)) points.push_back(seen.point(i));
    }
    const PagePlan plan = plan_pages({.camera = camera, .points_world = points}, DirectionalLight{kSlant},
                                     {pair.boxes, pair.boxes}, pages, memory);
    ASSERT_EQ(plan.status, PlanStatus::ok);
    FrameOptions options;
    options.time_passes = false;
    const FrameStats stats =
        pair.keeps.draw(plan, camera, pair.keeps.prepare(filter, Source::pages), options);
    options.prune = options.prune.without(PruneRule::held_maps);
    pair.redraws.draw(plan, camera, pair.redraws.prepare(filter, Source::pages), options);
    kept += static_cast<std::size_t>(stats.pages - stats.pages_drawn);
    all += plan.pages.size();
    for (std::size_t i = 0; i < plan.pages.size(); ++i)
      ASSERT_EQ(pair.keeps.page_depths(i).values, pair.redraws.page_depths(i).values) << "frame " << frame;
    ASSERT_EQ(pair.keeps.mask().values, pair.redraws.mask().values) << "frame " << frame;
  }
  EXPECT_GT(kept, all / 3);
  EXPECT_LT(kept, all);
}

TEST(Animation, a_pose_that_comes_back_takes_what_was_moved_by_hand) {
  Pair pair(animated_scene());
  const FilterSettings filter = default_settings(filters::hard);
  pair.go(1.0);
  ASSERT_EQ(pair.stale(watching(0), DirectionalLight{kSlant}, filter), 0u);
  Pose at;
  ASSERT_TRUE(pose(pair.scene, 0, 1.0, at));
  const std::size_t mover = at.instances.front().instance;
  Instance aside = pair.posed.instances[mover];
  const glm::dvec3 step(0.0, 3.0, 0.0);
  aside.world_from_object[3] += glm::dvec4(step, 0.0);
  aside.bounds_world = {aside.bounds_world.min + step, aside.bounds_world.max + step};
  ASSERT_TRUE(pair.keeps.move_instance(mover, aside));
  EXPECT_NE(pair.stale(watching(0), DirectionalLight{kSlant}, filter), 0u);
  pair.go(1.0);
  EXPECT_EQ(pair.stale(watching(0), DirectionalLight{kSlant}, filter), 0u);
}

TEST(Animation, a_mesh_that_bends_within_its_bounds_moves_its_shadow) {
  const FilterSettings filter = default_settings(filters::hard);
  for (const bool apart : {true, false}) {
    Pair pair(animated_scene());
    if (!apart) pair.rules = pair.rules.without(PruneRule::static_casters);
    Pose at;
    ASSERT_TRUE(pose(pair.scene, 0, 1.0, at));
    const auto take = [&] {
      ASSERT_TRUE(pair.keeps.apply_pose(at));
      ASSERT_TRUE(pair.redraws.apply_pose(at));
      gnomon::apply_pose(at, pair.posed);
      pair.boxes = boxes_of(pair.posed);
    };
    take();
    ASSERT_EQ(pair.stale(watching(0), DirectionalLight{kSlant}, filter), 0u);
    const std::vector<float> before = pair.keeps.mask().values;
    // The tower's waist: its foot and its top hold its bounds.
    const PosedVertices& tower = at.vertices.back();
    for (std::size_t i = tower.first; i < tower.first + tower.count; ++i) {
      glm::vec3& p = at.positions[i];
      if (p.y > 0.2f && p.y < 3.5f) p.x = 1.0f + 0.1f * (p.x - 1.0f);
    }
    take();
    EXPECT_EQ(pair.stale(watching(0), DirectionalLight{kSlant}, filter), 0u) << apart;
    EXPECT_NE(pair.keeps.mask().values, before);
  }
}

TEST(Animation, poses_of_other_scenes_are_refused) {
  Pair pair(animated_scene());
  Pose good;
  ASSERT_TRUE(pose(pair.scene, 0, 1.0, good));
  Pose bad = good;
  bad.instances.back().instance = 999;
  EXPECT_FALSE(pair.keeps.apply_pose(bad));
  bad = good;
  bad.instances.front().bounds_world = {};
  EXPECT_FALSE(pair.keeps.apply_pose(bad));
  bad = good;
  bad.vertices.back().first_vertex = 0xfffffff0u;
  EXPECT_FALSE(pair.keeps.apply_pose(bad));
  bad = good;
  bad.positions.resize(1);
  EXPECT_FALSE(pair.keeps.apply_pose(bad));
  EXPECT_TRUE(pair.keeps.apply_pose(good));
  EXPECT_TRUE(pair.keeps.apply_pose(Pose{}));
}

TEST(Animation, figures_of_real_files_walk) {
  for (const char* name : {"fox/Fox.glb", "robot_expressive/RobotExpressive.glb"}) {
    const auto file = test::shared_folder() / "scenes" / name;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared/scenes";
    SCOPED_TRACE(name);
    Pair pair(load_gltf(file));
    const FilterSettings filter = default_settings(filters::hard);
    const glm::dvec3 middle = 0.5 * (pair.scene.bounds_world.min + pair.scene.bounds_world.max);
    const double size = glm::length(pair.scene.bounds_world.max - pair.scene.bounds_world.min);
    Camera camera = camera_on_box(96, 96);
    camera.forward = glm::normalize(glm::dvec3(-0.6, -0.4, -0.7));
    camera.position = middle - size * camera.forward;
    camera.near_depth = 0.05 * size;
    camera.far_depth = 4.0 * size;
    for (int frame = 0; frame < 4; ++frame) {
      pair.go(0.2 * frame, 1);
      ASSERT_EQ(pair.stale(camera, DirectionalLight{kSlant}, filter), 0u) << "frame " << frame;
      const std::vector<float> seen = pair.keeps.mask().values;
      EXPECT_LT(*std::min_element(seen.begin(), seen.end()), 1.0f);
    }
  }
}

}  // namespace
}  // namespace gnomon::render
