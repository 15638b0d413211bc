// Extreme cases of lights with a position.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "case_list.hpp"
#include "judge.hpp"

namespace gnomon::stress {
namespace {

/// A hall 40 units long with the camera at one end, looking down it.
Input hall(const Light& light) {
  Input input;
  input.camera =
      perspective_camera({0, 2, 0}, {0, -0.05, -1}, {0, 1, 0}, kPi / 3.0, 1.5, 0.1, 100.0, 1200, 800);
  input.light = light;
  input.receivers = {{{-10, -1, -40}, {10, 0, 5}}};
  input.casters = {{{-1, 0, -12}, {1, 3, -10}}, {{-6, 0, -25}, {-4, 2, -23}}, {{-10, -1, -40}, {10, 0, 5}}};
  return input;
}

/// Points of the floor in view, and whether maps hold those that a caster could shadow.
struct Held {
  int points = 0, held = 0, behind = 0;
};
Held held_points(const Input& input, const ShadowPlan& plan) {
  Held result;
  const CameraAxes axes = camera_axes(input.camera);
  for (double depth = 4.0; depth < 38.0; depth += 1.5) {
    for (double x = -0.7; x <= 0.7; x += 0.2) {
      const glm::dvec3 ray = axes.forward + axes.right * (x * input.camera.right);
      const glm::dvec3 p{input.camera.position.x + ray.x * depth, 0.0,
                         input.camera.position.z + ray.z * depth};
      const glm::dvec3 offset = p - input.camera.position;
      const double z = glm::dot(axes.forward, offset);
      if (std::abs(glm::dot(axes.up, offset)) > input.camera.top * z || std::abs(p.x) > 10.0) continue;
      ++result.points;
      const int map = map_serving(plan, p, z);
      if (map < 0) continue;
      ++result.held;
      const glm::dvec4 clip = plan.map[static_cast<std::size_t>(map)].clip_from_world * glm::dvec4(p, 1.0);
      result.behind += clip.w > 0.0 ? 0 : 1;
    }
  }
  return result;
}

/// Depth grows along a ray of light from `apex` through `p`.
bool depth_grows(const ShadowMap& map, const glm::dvec3& apex, const glm::dvec3& p) {
  double before = -std::numeric_limits<double>::infinity();
  for (const double share : {0.3, 0.5, 0.7, 0.9, 1.0}) {
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4(apex + (p - apex) * share, 1.0);
    if (!(clip.w > 0.0) || !(clip.z / clip.w > before)) return false;
    before = clip.z / clip.w;
  }
  return true;
}

}  // namespace

void case_wide_spot(Check& check) {
  const auto plan_of = [&](double cone_degrees) {
    const Input input = hall(SpotLight{{0, 8, -15}, {0, -1, 0.1}, 0.5 * cone_degrees * kPi / 180.0, 60.0});
    const ShadowPlan plan = input.plan();
    check.that(all_finite(plan), "every number is finite");
    return plan;
  };
  for (const double cone : {1e-9, 0.01, 90.0, 131.0})
    check.that(plan_of(cone).map_count <= 1, "one map below 131 degrees");
  for (const double cone : {132.0, 170.1, 180.0, 270.0, 359.999}) {
    const ShadowPlan plan = plan_of(cone);
    check.that(plan.status == PlanStatus::ok && plan.map_count > 1 && plan.map_count <= 6,
               "a cube from 132 degrees on");
    for (const ShadowMap& map : plan.maps()) check.that(map.cascade >= 0 && map.cascade < 6, "its faces");
  }
  for (const double cone : {0.0, -1.0, 360.0, 400.0})
    check.that(plan_of(cone).invalid_field == "light.outer_radians", "0 and 360 degrees are refused");
}

void case_spot_near(Check& check) {
  // The light stands in the floor's own box: a receiver touches it.
  const glm::dvec3 position{0, -0.5, -10};
  const Input input = hall(SpotLight{position, {0, 0.2, -1}, 0.6, 50.0});
  for (const Warp* warp : all_warps()) {
    const ShadowMap map = one_map(input, *warp, check);
    // Where the axis enters the map.
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0, 0.2, -1));
    double low = 1e-9, high = 50.0;
    for (int i = 0; i < 100; ++i) {
      const double middle = std::sqrt(low * high);
      const glm::dvec4 clip = map.clip_from_world * glm::dvec4(position + axis * middle, 1.0);
      (clip.w > 0.0 && clip.z >= -clip.w ? high : low) = middle;
    }
    const double share = high / map.depth_range_world;
    check.that(share >= 1e-4 * 0.99, "the near plane is at 1e-4 of the far one at least");
    if (warp == &warps::none) check.note("near plane over depth range", share);
  }
}

void case_point_in_view(Check& check) {
  const Input input = hall(PointLight{{0, 4, -15}, 60.0});
  for (const Warp* warp : all_warps()) {
    Input asked = input;
    asked.options.warp.warp = warp;
    const ShadowPlan plan = asked.plan();
    check.that(plan.status == PlanStatus::ok && all_finite(plan), "planned, finite");
    check.that(plan.map_count >= 1 && plan.map_count < 6, "faces without receivers are skipped");
    bool skipped = false;
    for (const Omission& o : plan.omitted())
      skipped = skipped || o.kind == OmissionKind::face_without_receiver;
    check.that(skipped, "and listed");
    const Held held = held_points(asked, plan);
    check.that(held.points > 50 && held.held == held.points && held.behind == 0,
               "visible points lie in a map");
    if (warp == &warps::none) check.note("faces", plan.map_count);
  }
}

void case_point_behind(Check& check) {
  const glm::dvec3 position{1, 6, 12};
  for (const Warp* warp : all_warps()) {
    Input input = hall(PointLight{position, 100.0});
    input.options.warp.warp = warp;
    const ShadowPlan plan = input.plan();
    check.that(plan.status == PlanStatus::ok && all_finite(plan), "planned, finite");
    const Held held = held_points(input, plan);
    check.that(held.points > 50 && held.held == held.points && held.behind == 0,
               "visible points lie in a map");
    for (int i = 0; i < plan.map_count; ++i) {
      for (const glm::dvec3& p : points_of(input, plan, i, 8, 3))
        check.that(depth_grows(plan.map[static_cast<std::size_t>(i)], position, p),
                   "depth grows away from the light");
    }
  }
}

void case_eye_behind_spot(Check& check) {
  // The spot hangs before the eye and shines away from it, down the hall.
  const Input input = hall(SpotLight{{0, 3, -5}, {0, -0.3, -1}, 0.7, 60.0});
  for (const Warp* warp : all_warps()) {
    const ShadowMap map = one_map(input, *warp, check);
    check.that(map.kappa >= 0.0, "the strength is not negative");
    Input asked = input;
    asked.options.warp.warp = warp;
    asked.options.warp.objective = Objective::storage;
    const ShadowPlan plan = asked.plan();
    for (const glm::dvec3& p : points_of(asked, plan, 0, 8, 3)) {
      const PointAliasing at = measure_perspective(map, asked.camera, p);
      check.that(at.status == PointAliasing::Status::ok && std::isfinite(at.m_max),
                 "m is finite where it is lit");
    }
  }
}

void case_facing_spot(Check& check) {
  // At the hall's far end, back towards the eye: what is near in the light is far in view.
  for (const double pitch : {-0.2, -0.1, 0.0}) {
    const Input input = hall(SpotLight{{0, 3, -35}, {0, pitch, 1}, 0.5, 80.0});
    const double none = one_map(input, warps::none, check).storage;
    for (const Warp* warp : all_warps()) {
      const ShadowMap map = one_map(input, *warp, check);
      check.that(std::isfinite(map.kappa) && map.kappa >= 0.0, "the strength is finite and not negative");
      check.that(!warp->drop_without_gain || map.storage <= none * (1.0 + 1e-9),
                 "no more texels than no warp");
    }
  }
}

}  // namespace gnomon::stress
