// Are panes that move, and maps of them that are kept, drawn as a scene made so?
#include <gtest/gtest.h>

#include "pane_scenes.hpp"

namespace gnomon::render {
namespace {

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
    EXPECT_LT(kept_texels, whole_texels / 10 * 6);
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
  const PreparedFilter hard = renderer.prepare(filters::hard),
                       exact = renderer.prepare(filters::hard, Source::irregular());
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

}  // namespace
}  // namespace gnomon::render
