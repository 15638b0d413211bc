// Which plan does a spot or point light get in scenes that one can see through?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "support/finite.hpp"
#include "support/near.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Room {
  Camera camera =
      perspective_camera({0, 2, 9}, {0, -0.1, -1}, {0, 1, 0}, 60 * kDegree, 1.5, 0.2, 60, 960, 640);
  std::vector<Box> receivers = {{{-10, 0, -10}, {10, 5, 10}}};
  std::vector<Box> casters = {{{-1, 0, -1}, {1, 2, 1}}, {{3, 0, -6}, {4, 3, -5}}};
  SpotLight spot{{2, 8, 1}, {-0.2, -1, -0.2}, 40 * kDegree, 30.0};
  PointLight point{{0, 4, -2}, 30.0};
  PlanOptions options;
  [[nodiscard]] SceneBounds bounds() const { return {casters, receivers}; }
  [[nodiscard]] ShadowPlan plan(const Light& light) const {
    return make_plan(camera, light, bounds(), options);
  }
};

int told(const ShadowPlan& plan, OmissionKind kind) {
  int count = 0;
  for (const Omission& omission : plan.omitted()) count += omission.kind == kind ? 1 : 0;
  return count;
}

bool finite(const ShadowPlan& plan) {
  for (const ShadowMap& map : plan.maps()) {
    if (!all_finite(map.clip_from_world)) return false;
    if (!std::isfinite(map.storage + map.kappa + map.texel_world_max.x + map.bias_world.slope)) return false;
  }
  return true;
}

TEST(Positional, a_spot_that_looks_away_from_the_view_or_ends_before_it_shows_nothing) {
  Room room;
  room.spot.direction = {0, 1, 0};
  EXPECT_EQ(room.plan(room.spot).status, PlanStatus::nothing_visible);
  room.spot.direction = {0, -1, 0};
  room.spot.range = 1.0;
  EXPECT_EQ(room.plan(room.spot).status, PlanStatus::nothing_visible);
  room.point = {{100, 4, -2}, 5.0};
  EXPECT_EQ(room.plan(room.point).status, PlanStatus::nothing_visible);
  room.receivers.clear();
  room.point = {{0, 4, -2}, 30.0};
  EXPECT_EQ(room.plan(room.point).status, PlanStatus::nothing_visible);
}

TEST(Positional, maps_begin_where_the_light_reaches_towards_an_eye_beyond_its_range) {
  Room room;
  room.receivers = {{{-100, -1, -100}, {100, 0, 100}}};
  room.casters = {{{-2, 0, -2}, {2, 3, 2}}};
  room.point = {{0, 1, 0}, 10.0};
  const glm::dvec3 eye{15, 1, 15};  // 21.2 units away; the cube round the range begins 7.1 from it
  room.camera =
      perspective_camera(eye, room.point.position - eye, {0, 1, 0}, 60 * kDegree, 1.5, 0.2, 60, 960, 640);
  const double reach = glm::length(eye - room.point.position) - room.point.range;
  ShadowPlan plan = room.plan(room.point);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  for (const ShadowMap& map : plan.maps()) EXPECT_GE(map.depth_begin, reach * (1.0 - 1e-6));
  // An eye within the range sees lit points from its near plane on.
  room.point.range = 30.0;
  plan = room.plan(room.point);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  EXPECT_LT(plan.map[0].depth_begin, reach);
}

TEST(Positional, receivers_that_nothing_can_shadow_need_no_map) {
  Room room;
  room.casters = {{{-1, 9, -1}, {1, 10, 1}}, Box{}};  // above the spot
  const ShadowPlan plan = room.plan(room.spot);
  EXPECT_EQ(plan.status, PlanStatus::no_caster);
  EXPECT_EQ(plan.map_count, 0);
  room.casters.clear();
  const ShadowPlan cube = room.plan(room.point);
  EXPECT_EQ(cube.status, PlanStatus::no_caster);
  EXPECT_GT(told(cube, OmissionKind::face_without_caster), 3);
}

TEST(Positional, a_broken_light_is_refused_and_named) {
  Room room;
  room.spot.range = 0.0;
  EXPECT_EQ(room.plan(room.spot).invalid_field, "light.range");
  room.spot = SpotLight{{0, 1, 0}, {0, 0, 0}, 0.5, 10.0};
  EXPECT_EQ(room.plan(room.spot).invalid_field, "light.direction");
  room.point.position.x = std::nan("");
  EXPECT_EQ(room.plan(room.point).invalid_field, "light.position");
}

TEST(Positional, every_cone_from_a_needle_to_the_whole_sphere_gets_a_finite_plan_that_holds_its_axis) {
  Room room;
  const glm::dvec3 target{0, 1, 0};
  room.spot.direction = target - room.spot.position;
  for (double degrees = 0.001; degrees < 180.0; degrees *= 1.08) {
    room.spot.outer_radians = degrees * kDegree;
    const ShadowPlan plan = room.plan(room.spot);
    ASSERT_EQ(plan.status, PlanStatus::ok) << degrees;
    EXPECT_TRUE(finite(plan)) << degrees;
    EXPECT_GE(map_serving(plan, target, 9.0), 0) << degrees;
    if (degrees < 65.9) {
      EXPECT_EQ(plan.map_count, 1) << degrees;
    } else {
      EXPECT_GT(plan.map_count, 1) << degrees;
    }
  }
}

TEST(Positional, a_wider_cone_never_costs_more_texels_for_the_same_error_than_one_of_five_faces) {
  Room room;
  room.spot = SpotLight{{0, 4.5, 0}, {0, -1, 0}, 1.0, 40.0};
  // All round, so that every face has a map.
  room.casters = {{{-9, 0, -9}, {9, 0.5, 9}}};
  const auto texels_for_the_error = [&](double degrees) {
    room.spot.outer_radians = degrees * kDegree;
    const ShadowPlan plan = room.plan(room.spot);
    double texels = 0.0;
    for (const ShadowMap& map : plan.maps()) texels += static_cast<double>(map.width) * map.height;
    const double m = measure(plan, room.camera, {room.casters, room.receivers}).p50;
    return texels * m * m;
  };
  const double of_faces = texels_for_the_error(88.0);
  for (const double degrees : {60.0, 65.0, 65.8, 66.0, 70.0, 80.0, 84.9, 85.0})
    EXPECT_LT(texels_for_the_error(degrees), 1.25 * of_faces) << degrees;
}

TEST(Positional, texels_that_are_even_in_angle_serve_a_wide_cone_by_one_map) {
  Room room;
  room.spot = SpotLight{{0, 4.5, 0}, {0, -1, 0}, 80.0 * kDegree, 40.0};
  EXPECT_GT(room.plan(room.spot).map_count, 1);
  room.options.warp.shape = &shapes::paraboloid;
  EXPECT_EQ(room.plan(room.spot).map_count, 1);
}

TEST(Positional, a_light_anywhere_about_the_eye_is_finite) {
  Room room;
  const glm::dvec3 eye = room.camera.position, forward = glm::normalize(room.camera.forward);
  for (const glm::dvec3& at : {eye, eye - forward * 3.0, eye + forward * 0.2, eye + forward * 4.0,
                               glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 0)}) {
    for (const glm::dvec3& towards : {forward, -forward, glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0)}) {
      const ShadowPlan spot = room.plan(SpotLight{at, towards, 0.7, 40.0});
      EXPECT_NE(spot.status, PlanStatus::invalid_input);
      EXPECT_TRUE(finite(spot));
    }
    const ShadowPlan point = room.plan(PointLight{at, 40.0});
    EXPECT_EQ(point.status, PlanStatus::ok);
    EXPECT_TRUE(finite(point));
  }
}

TEST(Positional, a_caster_round_the_light_pulls_the_near_plane_to_its_floor) {
  Room room;
  room.casters = {{{1.9, 7.9, 0.9}, {2.1, 8.1, 1.1}}};
  const ShadowPlan plan = room.plan(room.spot);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  EXPECT_TRUE(finite(plan));
  // The farthest receiver is about ten units away, the floor 1e-4 of that.
  const glm::dvec3 near_light = room.spot.position + glm::normalize(room.spot.direction) * 0.01;
  const glm::dvec4 clip = plan.map[0].clip_from_world * glm::dvec4(near_light, 1.0);
  EXPECT_GT(clip.w, 0.0);
  EXPECT_LE(std::abs(clip.z), clip.w);
}

TEST(Positional, the_map_of_a_small_receiver_is_focused_on_it_and_its_depth_on_the_casters) {
  Room room;
  room.options.warp.warp = &warps::none;
  room.options.filter.texels = 0.0;
  room.options.prune = room.options.prune.without(PruneRule::metric_resolution);
  room.camera.forward = {0, 0, -1};  // the map's axis is the view's as the light sees it
  room.receivers = {{{-0.5, 0, -0.5}, {0.5, 0, 0.5}}};
  room.casters = {{{-0.1, 2, -0.1}, {0.1, 3, 0.1}}};
  room.spot = {{0, 8, 0}, {0, -1, 0}, 60 * kDegree, 100.0};
  const ShadowPlan plan = room.plan(room.spot);
  ASSERT_EQ(plan.map_count, 1);
  const ShadowMap& map = plan.map[0];
  // Eight units away, 1024 texels over one unit.
  EXPECT_CLOSE(map.texel_world.x, 1.0 / 1024, 1e-6);
  EXPECT_CLOSE(map.texel_world.y, 1.0 / 1024, 1e-6);
  // From the casters' top, five away, to the receiver, with a thousandth of padding.
  EXPECT_CLOSE(map.depth_range_world, 3.0, 0.01);
  EXPECT_EQ(map.light_world, glm::dvec4(0, 8, 0, 1));
  EXPECT_EQ(map.kappa, 0.0);
}

TEST(Positional, a_room_seen_whole_gets_six_faces_that_cover_every_direction) {
  Room room;
  room.camera = orthographic_camera({0, 2.5, 40}, {0, 0, -1}, {0, 1, 0}, 30.0, 1.5, 1.0, 80.0, 960, 640);
  room.casters = {{{-9, 0, -9}, {9, 5, 9}}};
  room.point = {{0.3, 2.2, -0.1}, 40.0};
  const ShadowPlan plan = room.plan(room.point);
  ASSERT_EQ(plan.map_count, 6);
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    EXPECT_GE(map_serving(plan, room.point.position + random.direction() * 1.5, 0.0), 0);
  }
}

TEST(Positional, faces_without_receivers_are_omitted_with_what_they_save) {
  Room room;
  room.receivers = {{{-10, -0.1, -10}, {10, 0, 10}}};
  room.point.position = {0, 4, 0};
  const ShadowPlan plan = room.plan(room.point);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  EXPECT_GE(told(plan, OmissionKind::face_without_receiver), 1);  // the ceiling's at least
  for (const ShadowMap& map : plan.maps()) EXPECT_NE(map.cascade, 2);
  for (const Omission& o : plan.omitted()) {
    if (o.kind != OmissionKind::face_without_receiver) continue;
    EXPECT_EQ(o.saves_texels, 1024 * 1024);
    EXPECT_NE(std::string_view(describe(o).what.data()).find("face"), std::string_view::npos);
  }
}

TEST(Positional, a_warp_lowers_the_error_of_a_spot_over_a_wide_floor) {
  Room room;
  room.options.warp.objective = Objective::p95;
  room.options.warp.warp = &warps::none;
  const ShadowPlan plain = room.plan(room.spot);
  room.options.warp.warp = nullptr;
  const ShadowPlan warped = room.plan(room.spot);
  const double before = measure(plain, room.camera, room.bounds()).p95;
  const double after = measure(warped, room.camera, room.bounds()).p95;
  EXPECT_GT(warped.map[0].kappa, 0.0);
  EXPECT_LT(after, 0.9 * before);
  room.options.warp.warp = &warps::lispsm04;
  EXPECT_EQ(room.plan(room.spot).map[0].warp, &warps::lispsm04);
}

TEST(Positional, moving_and_scaling_the_world_changes_only_units) {
  const auto numbers = [](double scale, const glm::dvec3& move) {
    Room room;
    room.camera.position = room.camera.position * scale + move;
    room.camera.near_depth *= scale;
    room.camera.far_depth *= scale;
    for (auto* boxes : {&room.receivers, &room.casters}) {
      for (Box& box : *boxes) box = {box.min * scale + move, box.max * scale + move};
    }
    room.spot.position = room.spot.position * scale + move;
    room.spot.range *= scale;
    const ShadowPlan plan = room.plan(room.spot);
    EXPECT_EQ(plan.map_count, 1);
    const ShadowMap& map = plan.map[0];
    return std::vector<double>{map.storage, map.kappa, map.texel_world.x / scale,
                               map.depth_range_world / scale};
  };
  // Positions are rounded to 1e-9 at ten million; the search may then stop a step of its last round apart.
  constexpr double kMoved = 1e-3;
  const auto here = numbers(1.0, glm::dvec3(0.0));
  for (const auto& there :
       {numbers(1e-6, glm::dvec3(0.0)), numbers(1e6, glm::dvec3(0.0)), numbers(1.0, {1e7, -1e7, 1e7})}) {
    for (std::size_t i = 0; i < here.size(); ++i) EXPECT_CLOSE(there[i], here[i], kMoved) << i;
  }
}

TEST(Positional, a_stable_spot_keeps_its_matrix_while_the_camera_moves_and_turns) {
  Room room;
  room.options.fit = Fit::stable;
  const ShadowPlan first = room.plan(room.spot);
  ASSERT_EQ(first.map_count, 1);
  int equal = 0;
  for (int i = 1; i <= 20; ++i) {
    room.camera.position.x = 0.05 * i;
    room.camera.forward = {0.01 * i, -0.1, -1};
    const ShadowPlan plan = room.plan(room.spot);
    ASSERT_EQ(plan.map_count, 1);
    if (!(plan.map[0].snap_key == first.map[0].snap_key)) continue;
    ++equal;
    for (int c = 0; c < 4; ++c) {
      for (int r = 0; r < 4; ++r)
        EXPECT_NEAR(plan.map[0].clip_from_world[c][r], first.map[0].clip_from_world[c][r], 1e-12);
    }
  }
  EXPECT_GT(equal, 10);
}

TEST(Positional, every_clip_space_holds_the_same_points) {
  Room room;
  Random random(9);
  for (const ClipSpace& space :
       {kOpenGl, kOpenGlZeroToOne, kVulkan, ClipSpace{NdcDepth::zero_to_one, true, true},
        ClipSpace{NdcDepth::minus_one_to_one, true, false}}) {
    const ShadowPlan reference = room.plan(room.point);
    room.options.clip_space = space;
    const ShadowPlan plan = room.plan(room.point);
    for (int i = 0; i < 500; ++i) {
      const glm::dvec3 p{random.between(-10, 10), random.between(0, 5), random.between(-10, 10)};
      EXPECT_EQ(map_serving(plan, p, 0.0), map_serving(reference, p, 0.0));
    }
    room.options.clip_space = kOpenGl;
  }
}

// The first receiver lies in the light's own plane but for the last bits: nothing that a map could show.
TEST(Positional, a_light_on_a_flat_receiver_gets_no_map_of_it) {
  Room room;
  room.camera.position = {-0.49999999576071913, -0.50878376816441961, -0.50878376816441961};
  room.camera.forward = {0.045813742875781889, -0.99060848656401512, -0.12882518119941924};
  room.camera.right = 0.8475183723942501;
  room.camera.left = -room.camera.right;
  room.camera.top = 1.084534040498436;
  room.camera.bottom = -room.camera.top;
  room.camera.near_depth = 0.0011605291092999966;
  room.camera.far_depth = 0.25439188408220981;
  room.receivers = {{{-0.51197452193473947, -0.53549334333114407, -0.5158044745110858},
                     {-0.51197452193473947, -0.53526259944021126, -0.48875490949791656}},
                    {{-0.50114086848282191, -0.51216782871902022, -0.50912950366157861},
                     {-0.50111382691831052, -0.50803291721934307, -0.50721329361667578}}};
  room.casters = {{{-0.6, -0.6, -0.6}, {-0.4, -0.4, -0.4}}};
  room.point = {{-0.51197452193473947, -0.53537797138567766, -0.50227969200450118}, 0.5659484116335215};
  const ShadowPlan plan = room.plan(room.point);
  EXPECT_GT(plan.map_count, 0);
  EXPECT_TRUE(finite(plan));
  for (const ShadowMap& map : plan.maps()) EXPECT_GT(map.cascade, 1) << "a face towards +x or -x";
}

// Near planes were a share of the frustum's farthest corner, where no receiver lay: two faces lost all of
// theirs.
TEST(Positional, maps_begin_at_a_share_of_the_farthest_receiver_not_of_what_lies_beside_them) {
  Room room;
  room.camera = perspective_camera({0.9, 8.0, -20.0}, {-0.04, -0.3, 0.9}, {0, 1, 0}, 60 * kDegree, 0.1, 3.0,
                                   4e6, 100, 1000);
  room.spot = {{0.3, 0.1, -2.0}, {0.2, -0.9, -0.3}, 85 * kDegree, 2.0};
  room.receivers = {{{-0.5, -0.4, -1.0}, {-0.1, -0.009, -0.4}}, {{-0.04, -0.1, -2.0}, {0.4, 0.3, -2.0}}};
  room.casters = {{{-0.04, -0.1, -2.4}, {0.4, 0.3, -1.8}}};
  room.options.light_near_share = 0.5;
  const ShadowPlan plan = room.plan(room.spot);
  int seen = 0;
  for (int i = 0; i <= 20; ++i) {
    for (int k = 0; k <= 20; ++k) {
      const glm::dvec3 p{-0.04 + 0.022 * i, -0.1 + 0.02 * k, -2.0};
      const glm::dvec3 ray = p - room.spot.position;
      const double distance = glm::length(ray);
      const bool lit =
          glm::dot(ray, glm::normalize(room.spot.direction)) > distance * std::cos(room.spot.outer_radians);
      // Half of the way to the farthest, along a face's axis.
      if (!lit || distance < 0.26) continue;
      ++seen;
      EXPECT_GE(map_serving(plan, p, 0.0), 0) << p.x << ' ' << p.y;
    }
  }
  EXPECT_GT(seen, 20);
}

TEST(Positional, receivers_in_front_of_their_map_are_reported_where_a_caster_is_nearer_still) {
  Room room;
  room.receivers = {{{-10, -10, -10}, {10, 10, 10}}};
  room.casters = {{{2.0, -0.5, -0.5}, {2.2, 0.5, 0.5}}};
  room.point = {{0, 0, 0}, 30.0};
  room.options.light_near_share = 0.5;
  const ShadowPlan plan = room.plan(room.point);
  const auto near = std::find_if(plan.omitted().begin(), plan.omitted().end(), [](const Omission& o) {
    return o.kind == OmissionKind::receiver_near_light;
  });
  ASSERT_NE(near, plan.omitted().end());
  EXPECT_EQ(near->map, 0);
  EXPECT_EQ(near->b, 1.0);
  EXPECT_GT(near->a, 2.2);
  EXPECT_LE(near->a, 5.1);
  room.casters = {{{7.0, -0.5, -0.5}, {7.2, 0.5, 0.5}}};
  EXPECT_EQ(told(room.plan(room.point), OmissionKind::receiver_near_light), 0) << "nothing could shadow them";
  room.options.light_near_share = PlanOptions{}.light_near_share;
  room.casters = {{{-10, -10, -10}, {10, 10, 10}}};
  EXPECT_EQ(told(room.plan(room.point), OmissionKind::receiver_near_light), 0)
      << "depth_near_light says as much";
}

/// All round the light: the camera looks down on a floor from the middle of the room's ceiling.
Room looked_down_on() {
  Room room;
  room.camera = perspective_camera({0, 20, 0}, {0, -1, 0}, {0, 0, 1}, 70 * kDegree, 1.0, 0.2, 60, 512, 512);
  room.point = {{0.3, 2.0, -0.2}, 30.0};
  room.casters = {{{-10, 0, -10}, {10, 5, 10}}};
  return room;
}

TEST(Positional, a_tetrahedron_shows_with_four_maps_what_a_cube_shows_with_six) {
  Room room = looked_down_on();
  const ShadowPlan cube = room.plan(room.point);
  room.options.split.partition = Partition::tetrahedron;
  const ShadowPlan plan = room.plan(room.point);
  EXPECT_EQ(cube.map_count, 6);
  ASSERT_EQ(plan.map_count, 4);
  EXPECT_TRUE(finite(plan));
  for (const ShadowMap& map : plan.maps()) EXPECT_EQ(map.select_plane_count, 3);
  // Straight down is the first face's, the horizon belongs to the others.
  EXPECT_EQ(plan.map[0].cascade, 0);
  EXPECT_EQ(map_serving(plan, room.point.position - glm::dvec3(0, 1.5, 0), 0.0), 0);
  EXPECT_GT(map_serving(plan, room.point.position + glm::dvec3(1.0, 0.2, 2.0), 0.0), 0);
  Random random(3);
  for (int i = 0; i < 4000; ++i) {
    const glm::dvec3 p{random.between(-10, 10), random.between(0, 5), random.between(-10, 10)};
    EXPECT_EQ(map_serving(plan, p, 0.0) >= 0, map_serving(cube, p, 0.0) >= 0) << i;
  }
}

TEST(Positional, only_point_lights_have_the_maps_of_a_tetrahedron) {
  Room room = looked_down_on();
  const auto ignored = [](const ShadowPlan& plan) {
    const auto omitted = plan.omitted();
    return std::count_if(omitted.begin(), omitted.end(), [](const Omission& o) {
      return o.kind == OmissionKind::option_ignored && o.a == static_cast<double>(IgnoredOption::partition);
    });
  };
  const SpotLight wide{{0, 4, -2}, {0, -1, 0}, 120 * kDegree, 30.0};
  const DirectionalLight sun{{0.2, -1.0, 0.1}};
  const ShadowPlan wide_before = room.plan(wide), sun_before = room.plan(sun);
  room.options.split.partition = Partition::tetrahedron;
  EXPECT_EQ(ignored(room.plan(room.point)), 0);
  EXPECT_EQ(ignored(room.plan(wide)), 1);
  EXPECT_EQ(ignored(room.plan(sun)), 1);
  EXPECT_EQ(room.plan(wide).map_count, wide_before.map_count);
  EXPECT_EQ(room.plan(sun).map_count, sun_before.map_count);
  // A pool of many lights has places for a cube's faces.
  LightOptions pool;
  pool.plan = room.options;
  EXPECT_EQ(light_options(pool, LightMaps{}).split.partition, Partition::view_depth);
}

}  // namespace
}  // namespace gnomon::test
