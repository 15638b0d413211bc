// Does one plan serve several cameras: every receiver that any of them sees, at the error of the worst?
#include "gnomon/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "support/finite.hpp"
#include "support/float_traps.hpp"
#include "support/near.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A street of 200 seen from its end.
struct Street {
  std::vector<Box> boxes = {{{-30, -1, -200}, {30, 20, 10}}};
  DirectionalLight light{{0.3, -1, 0.2}};
  PlanOptions options;
  [[nodiscard]] Camera camera(double x, double yaw = 0.0) const {
    return perspective_camera({x, 1.7, 0}, {std::sin(yaw), -0.05, -std::cos(yaw)}, {0, 1, 0}, 90 * kDegree,
                              1.0, 0.1, 200, 1000, 1000);
  }
  [[nodiscard]] SceneBounds bounds() const { return {boxes, boxes}; }
  [[nodiscard]] ShadowPlan plan(std::span<const Camera> cameras) const {
    return plan_views(cameras, light, bounds(), options);
  }
};

int blind(const ShadowPlan& plan, double index) {
  return static_cast<int>(std::ranges::count_if(plan.omitted(), [&](const Omission& o) {
    return o.kind == OmissionKind::view_without_receiver && o.a == index;
  }));
}

TEST(Views, none_too_many_or_broken_ones_are_refused_by_name) {
  const Street street;
  std::vector<Camera> cameras;
  EXPECT_EQ(street.plan(cameras).invalid_field, "cameras");
  cameras.assign(kMaxViews + 1, street.camera(0));
  EXPECT_EQ(street.plan(cameras).status, PlanStatus::invalid_input);
  EXPECT_EQ(street.plan(cameras).invalid_field, "cameras");
  cameras = {street.camera(0), street.camera(1)};
  cameras[1].orthographic = true;
  EXPECT_EQ(street.plan(cameras).invalid_field, "cameras");
  cameras[1] = street.camera(1);
  cameras[1].position.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(street.plan(cameras).invalid_field, "camera.position");
  cameras[1] = street.camera(1);
  EXPECT_EQ(plan_views(cameras, DirectionalLight{{0, 0, 0}}, street.bounds()).invalid_field,
            "light.direction");
}

TEST(Views, no_boxes_show_nothing_and_a_broken_one_in_a_set_is_named) {
  const Street street;
  const std::array eyes{street.camera(-1), street.camera(1)};
  EXPECT_EQ(plan_views(eyes, street.light, {}).status, PlanStatus::nothing_visible);
  EXPECT_EQ(plan_views(eyes, street.light, {{}, street.boxes}).status, PlanStatus::no_caster);
  std::vector<Box> boxes(100, street.boxes[0]);
  boxes[77].min.x = std::numeric_limits<double>::quiet_NaN();
  std::vector<CasterBlock> blocks(CasterSet::block_count(boxes.size()));
  std::vector<std::uint32_t> indices(CasterSet::index_count(boxes.size()));
  const CasterSet set(boxes, blocks, indices);
  EXPECT_EQ(plan_views(eyes, street.light, {street.boxes, set}).invalid_field, "bounds.receivers");
  EXPECT_EQ(plan_views(eyes, street.light, {set, street.boxes}).invalid_field, "bounds.casters");
}

TEST(Views, cameras_that_see_nothing_are_omitted_and_listed) {
  const Street street;
  Camera away = street.camera(0);
  away.position = {0, 500, 0};
  away.forward = {0, 1, 0};
  const ShadowPlan none = street.plan(std::array{away, away});
  EXPECT_EQ(none.status, PlanStatus::nothing_visible);
  EXPECT_EQ(blind(none, 0.0) + blind(none, 1.0), 2);
  const ShadowPlan one = street.plan(std::array{away, street.camera(2)});
  EXPECT_EQ(one.status, PlanStatus::ok);
  EXPECT_EQ(blind(one, 0.0), 1);
  EXPECT_EQ(blind(one, 1.0), 0);
}

TEST(Views, one_camera_is_the_plan_with_the_finest_map_to_the_bit) {
  Street street;
  const ShadowPlan shared = street.plan(std::array{street.camera(0)});
  street.options.split.selection = MapSelection::finest;
  const ShadowPlan alone = make_plan(street.camera(0), street.light, street.bounds(), street.options);
  ASSERT_EQ(shared.map_count, alone.map_count);
  for (std::size_t i = 0; i < alone.maps().size(); ++i)
    EXPECT_EQ(shared.map[i].clip_from_world, alone.map[i].clip_from_world);
}

TEST(Views, the_same_camera_twice_is_as_good_as_once) {
  Street street;
  street.options.warp.objective = Objective::storage;  // the one that views can share
  const ShadowPlan once = street.plan(std::array{street.camera(0)});
  const ShadowPlan twice = street.plan(std::array{street.camera(0), street.camera(0)});
  ASSERT_EQ(once.map_count, twice.map_count);
  // The body's vertices come in another order, and the search for the warp ends as near to the best.
  constexpr double kSearch = 1.1;
  for (std::size_t i = 0; i < once.maps().size(); ++i) {
    EXPECT_LE(twice.map[i].m_t_max * twice.map[i].m_s_max,
              kSearch * once.map[i].m_t_max * once.map[i].m_s_max);
    EXPECT_EQ(twice.map[i].depth_end, once.map[i].depth_end);
  }
}

TEST(Views, both_eyes_get_the_error_of_one_eye_for_as_many_texels) {
  // Eyes 64 mm apart that look the same way. In a room of 10 m the near plane, 0.1 before the eyes, is where
  // most texels go, and its two images lie side by side.
  struct Place {
    std::vector<Box> boxes;
    double most;  // texels over those of one eye
  };
  Street street;
  street.options.warp.objective = Objective::p95;
  for (const Place& place : {Place{street.boxes, 1.05},
                             Place{{{{-100, -1, -200}, {100, 0.2, 10}}, {{8, 0, -90}, {12, 8, -60}}}, 1.05},
                             Place{{{{-5, 0, -5}, {5, 3, 5}}}, 1.2}}) {
    street.boxes = place.boxes;
    const std::array eyes{street.camera(-0.032), street.camera(0.032)};
    const ShadowPlan both = street.plan(eyes);
    ASSERT_EQ(both.map_count, 4);
    for (const Camera& eye : eyes) {
      const ShadowPlan own = make_plan(eye, street.light, street.bounds(), street.options);
      const double alone = measure(own, eye, street.bounds()).p95;
      const AliasingStats shared = measure(both, eye, street.bounds());
      EXPECT_EQ(shared.outside, 0u);
      // Texels go by the square of the error.
      EXPECT_LE(shared.p95 * shared.p95, place.most * alone * alone);
    }
  }
}

TEST(Views, a_point_has_one_map_for_every_camera) {
  const Street street;
  const std::array eyes{street.camera(-2.0, 0.4), street.camera(2.0, -0.3)};
  const ShadowPlan plan = street.plan(eyes);
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 point =
        point_at(eyes[0], random.between(-1, 1), random.between(-1, 1), random.between(1, 150));
    EXPECT_EQ(map_serving(plan, point, depth_of(eyes[0], point)),
              map_serving(plan, point, depth_of(eyes[1], point)));
  }
  EXPECT_EQ(plan.origin_world, (eyes[0].position + eyes[1].position) * 0.5);
}

TEST(Views, six_faces_of_a_probe_get_maps_round_their_eye) {
  const Street street;
  std::vector<Camera> faces;
  for (const glm::dvec3& forward : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0),
                                    glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)})
    faces.push_back(
        perspective_camera({0, 5, -100}, forward, {0.1, 1, 0}, 90 * kDegree, 1.0, 0.5, 60, 256, 256));
  const ShadowPlan plan = street.plan(faces);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  for (const Camera& face : faces) EXPECT_EQ(measure(plan, face, street.bounds()).outside, 0u);
}

TEST(Views, options_for_one_view_alone_are_reported) {
  Street street;
  street.options.split.partition = Partition::frustum_faces;
  const ShadowPlan plan = street.plan(std::array{street.camera(0), street.camera(1)});
  EXPECT_TRUE(std::ranges::any_of(plan.omitted(), [](const Omission& o) {
    return o.kind == OmissionKind::option_ignored && o.a == static_cast<double>(IgnoredOption::partition);
  }));
}

/// One to seven more cameras beside, behind or far from the case's own.
std::vector<Camera> draw_views(const Case& c) {
  std::vector<Camera> cameras{c.camera};
  const int more = 1 + pick(kMaxViews - 1);
  const bool near_by = chance(0.5);
  for (int i = 0; i < more; ++i) {
    Camera other = c.camera;
    const double reach = c.camera.far_depth * (near_by ? 0.002 : 0.5);
    other.position += glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1)) * reach;
    if (!near_by)
      other.forward = glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1)) + glm::dvec3(0, 0, 1e-3);
    cameras.push_back(other);
  }
  return cameras;
}

TEST(Views, the_bound_of_several_cameras_holds_from_the_pseudo_near_depth_on) {
  // A narrow view nearly along the light, of which a receiver crosses the depth that counts.
  Camera camera;
  camera.position = {-0.5, -0.5, -0.5};
  camera.forward = {0, -0.997, -0.071};
  camera.right = 0.0035;
  camera.top = 0.0087;
  camera.left = -camera.right;
  camera.bottom = -camera.top;
  camera.near_depth = 0.1486;
  camera.far_depth = 0.25;
  camera.width = 26;
  camera.height = 67;
  const std::vector<Box> receivers = {{{-0.506, -1.303, -0.586}, {-0.496, -0.266, -0.45}}};
  PlanOptions options;
  options.cascades = 1;
  options.resolution.max_size = 64;
  options.warp.warp = &warps::lispsm;
  options.filter.texels = 0.0;
  options.split.pseudo_near = 0.1541;
  // Few cameras' bodies are shown by their vertices, many by the corners round them.
  for (const int count : {2, 3, kMaxViews}) {
    std::vector<Camera> cameras(static_cast<std::size_t>(count), camera);
    for (std::size_t i = 0; i < cameras.size(); ++i)
      cameras[i].position -= glm::dvec3(0.0005 * static_cast<double>(i) / (count - 1));
    const ShadowPlan plan =
        plan_views(cameras, DirectionalLight{{0, -1, 0}}, {receivers, receivers}, options);
    ASSERT_EQ(plan.map_count, 1) << count;
    const ShadowMap& map = plan.map[0];
    ASSERT_GT(map.kappa, 0.0) << count;
    double most = 0.0;
    for (const Camera& k : cameras) {
      const CameraAxes axes = camera_axes(k);
      for (double depth = options.split.pseudo_near * 1.000001; depth < 0.18; depth += 0.001) {
        for (int corner = 0; corner < 4; ++corner) {
          const glm::dvec3 p =
              k.position + depth *
                               (axes.forward + axes.right * ((corner & 1) ? k.left : k.right) +
                                axes.up * ((corner & 2) ? k.bottom : k.top)) *
                               0.999999;
          const PointAliasing m = measure_perspective(map, k, p);
          if (m.status != PointAliasing::Status::ok) continue;
          most = std::max(most, m.m_max);
        }
      }
    }
    EXPECT_GT(most, 0.5 * map.m_max) << count;
    EXPECT_LE(most, map.m_max * (1.0 + 1e-6)) << count;
  }
}

TEST(Views, every_receiver_that_any_camera_sees_is_in_a_map_within_its_error) {
  int held = 0, lit = 0, own = 0;
  for_all(400, [&] {
    Case c = draw_case({.max_depth_ratio = 1e3, .max_boxes = 12});
    const std::vector<Camera> cameras = draw_views(c);
    const Light light = chance(0.7) ? Light{DirectionalLight{c.light}}
                                    : Light{PointLight{point_at(c.camera, 0.3, 0.8, 0.5 * c.camera.far_depth),
                                                       2.0 * c.camera.far_depth}};
    const bool sun = std::holds_alternative<DirectionalLight>(light);
    const ShadowPlan plan = plan_views(cameras, light, c.bounds(), c.options);
    require(plan.status != PlanStatus::invalid_input, plan.invalid_field, c);
    for (const ShadowMap& map : plan.maps())
      require(all_finite(map.clip_from_world) && std::isfinite(map.m_max), "not finite", c);
    Random random(9);
    for (const Camera& camera : cameras) {
      Case seen = c;
      seen.camera = camera;
      for (const glm::dvec3& point : visible_points(seen, random, 2, 4)) {
        const double depth = depth_of(camera, point);
        const int map = map_serving(plan, point, depth);
        if (map < 0) {
          ++lit;
          continue;
        }
        ++held;
        if (!sun || camera.orthographic || depth < c.options.split.pseudo_near) continue;
        // In the map of its own depths the plan's bound holds.
        for (const ShadowMap& cascade : plan.maps()) {
          if (!(depth >= cascade.depth_begin * 1.000001 && depth <= cascade.depth_end * 0.999999)) continue;
          const PointAliasing m = measure_perspective(cascade, camera, point);
          require(m.status == PointAliasing::Status::ok, "not in the map of its depth", cascade.cascade, c);
          require(m.m_max <= cascade.m_max * (1.0 + 1e-6), "m", m.m_max, "bound", cascade.m_max, c);
          ++own;
        }
      }
    }
  });
  EXPECT_GT(held, 3000);
  EXPECT_GT(own, 1000);
  EXPECT_GT(lit, 0);
}

TEST(Views, stable_maps_serve_what_only_one_of_two_eyes_is_so_far_from) {
  // The floor's end is less than 64 = 2^6 near planes from the middle between the eyes, and farther from one.
  const Box floor{{-63.9, -1.1, -0.5}, {60.0, -1.0, 0.5}};
  const auto eye = [](double x, double to) {
    return perspective_camera({x, 0, 0}, {to, -0.01, 0}, {0, 1, 0}, 5 * kDegree, 1.0, 1.0, 1e4, 500, 500);
  };
  const std::array cameras{eye(5.0, -1.0), eye(-5.0, 1.0)};
  PlanOptions options;
  options.fit = Fit::stable;
  const ShadowPlan plan =
      plan_views(cameras, DirectionalLight{{0.2, -1, 0.1}}, {{&floor, 1}, {&floor, 1}}, options);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  const glm::dvec3 end(-63.8, -1.0, 0.0);
  EXPECT_GE(map_serving(plan, end, depth_of(cameras[0], end)), 0);
}

/// A camera without a twin and one beside it, over a single receiver: what random cases found.
struct Beside {
  Camera camera;
  Light light;
  Box receiver, caster;
  bool third = false;  ///< beside the second, and looking aside
  double apart = 1e-3;

  [[nodiscard]] ShadowPlan plan() const {
    const CameraAxes axes = camera_axes(camera);
    std::vector<Camera> cameras{camera, camera};
    cameras[1].position += apart * axes.right;
    if (third) {
      cameras.push_back(cameras[1]);
      cameras[2].forward = axes.right;
      cameras[2].up = axes.up;
    }
    ShadowPlan found;
    EXPECT_TRUE(runs_without_trap([&] {
      found = plan_views(cameras, light, {{&caster, 1}, {&receiver, 1}});
    }));
    EXPECT_EQ(found.status, PlanStatus::ok);
    for (const ShadowMap& map : found.maps()) {
      EXPECT_TRUE(all_finite(map.clip_from_world));
      EXPECT_TRUE(std::isfinite(map.m_max) && std::isfinite(map.bias_world.constant));
    }
    return found;
  }
};

TEST(Views, images_that_lie_wholly_at_a_steep_angle_are_planned) {
  Beside steep;
  steep.camera =
      Camera{{0, 20000, 0}, {0, 0, 1}, {0, 1, 0}, false, 0.0, 1.0, -300.0, -50.0, 1.0, 10000.0, 1, 1};
  steep.light = SpotLight{{0, 20000, 0}, {0, -1, 0}, kDegree, 60000.0};
  steep.receiver = {{0, 0, 0}, {0, 0, 40000}};
  steep.caster = {{0, 0, 0}, {0, 0, 4000}};
  steep.apart = 10.0;
  EXPECT_GT(steep.plan().map_count, 0);
}

TEST(Views, a_hull_that_goes_behind_its_warp_has_finite_texels) {
  Beside wide;
  wide.camera = Camera{{20, -3, 29.32}, {0, 1, 1}, {0, 1, 0}, false, -2.0, 1.0, -0.7, 0.0, 0.04, 1.0, 1, 1};
  wide.light = SpotLight{{20.42, -3, 29.4}, {0, 1, 0.6}, 176.1 * kDegree, 1.0};
  wide.receiver = {{0, -4, 0}, {50, 0, 60}};
  wide.caster = {{0, -3, 0}, {20.46, 0, 30}};
  wide.third = true;
  wide.apart = 0.04;
  const ShadowPlan plan = wide.plan();
  for (const ShadowMap& map : plan.maps()) EXPECT_TRUE(std::isfinite(map.texel_world.x)) << map.cascade;
}

TEST(Views, a_receiver_that_is_a_point_is_not_lost_to_rounding) {
  Beside point;
  point.camera = perspective_camera({-6.5281676375300295, -2.216, -26.48}, {1, 0.97, 1}, {1, 0, 0},
                                    130 * kDegree, 0.7, 0.0002, 23.89, 1, 1);
  point.light = DirectionalLight{{-0.7, 0, 1}};
  const glm::dvec3 at{-6.522584290497505, -2.1951858068737615, -26.472866588919157};
  point.receiver = {at, at};
  point.caster = {at + glm::dvec3(0.7, 0, -1), at + glm::dvec3(0.7, 0, -1)};
  point.apart = 0.02389;
  EXPECT_GT(point.plan().map_count, 0);
}

TEST(Views, one_camera_with_a_partition_has_the_plan_of_one_without) {
  Street street;
  const std::array<Camera, 1> camera{street.camera(0)};
  const ShadowPlan plain = street.plan(camera);
  street.options.split.partition = Partition::separating_plane;
  const ShadowPlan parted = street.plan(camera);
  ASSERT_EQ(parted.map_count, plain.map_count);
  for (int i = 0; i < plain.map_count; ++i)
    EXPECT_EQ(parted.map[static_cast<std::size_t>(i)].clip_from_world,
              plain.map[static_cast<std::size_t>(i)].clip_from_world);
}

}  // namespace
}  // namespace gnomon::test
