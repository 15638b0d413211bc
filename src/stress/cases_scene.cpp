// Extreme cases of what there is to see: nothing, flat, far away, tiny, behind the eye.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "case_list.hpp"
#include "judge.hpp"

namespace gnomon::stress {
namespace {

/// Perspective error of the plan's maps at points given relative to the eye.
std::vector<double> errors_at(const Input& input, const std::vector<glm::dvec3>& offsets) {
  const ShadowPlan plan = input.plan();
  const CameraAxes axes = camera_axes(input.camera);
  std::vector<double> errors;
  for (const glm::dvec3& offset : offsets) {
    const glm::dvec3 p = input.camera.position + offset;
    const int map = map_serving(plan, p, glm::dot(axes.forward, offset));
    errors.push_back(
        map < 0 ? -1.0 : measure_perspective(plan.map[static_cast<std::size_t>(map)], input.camera, p).m_max);
  }
  return errors;
}

/// Points on the view axis and off it, in units of `unit`.
std::vector<glm::dvec3> offsets_ahead(const Camera& camera, double unit) {
  const CameraAxes axes = camera_axes(camera);
  std::vector<glm::dvec3> all;
  for (double depth = 0.2; depth < 150.0; depth *= 3.0)
    all.push_back((axes.forward + axes.right * 0.2 - axes.up * 0.05) * depth * unit);
  return all;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(b[i] / a[i] - 1.0));
  return largest;
}

void expect_nothing(const Input& input, Check& check) {
  const ShadowPlan plan = input.plan();
  check.that(plan.status == PlanStatus::nothing_visible && plan.map_count == 0, "nothing is visible, no map");
  check.that(map_serving(plan, input.camera.position + glm::dvec3(0, 0, -5), 5.0) == -1, "everything is lit");
  check.that(measure(plan, input.camera, input.bounds(), {4, 4, 4}).p95 == 0.0,
             "there is no error to measure");
}

}  // namespace

void case_looking_away(Check& check) {
  Input away = plain_input(0);
  away.receivers = away.casters = {{{-10, -1, 20}, {10, 5, 40}}};
  away.camera.forward = {0, 0, -1};
  expect_nothing(away, check);
  Input empty = plain_input(0);
  empty.receivers.clear();
  expect_nothing(empty, check);
  empty.receivers = {Box{}};
  expect_nothing(empty, check);
  empty.receivers = {{{5, 5, 5}, {-5, -5, -5}}};
  expect_nothing(empty, check);
  Input no_caster = plain_input(0);
  no_caster.casters.clear();
  const ShadowPlan plan = no_caster.plan();
  check.that(plan.status == PlanStatus::no_caster && plan.map_count == 0, "without casters there is no map");
}

void case_behind_eye(Check& check) {
  Input input = plain_input(0);
  input.camera.forward = {0, 0, -1};
  const glm::dvec3 travel = glm::normalize(glm::dvec3(0.05, -1, -2));
  input.light = DirectionalLight{travel};
  input.receivers = {{{-50, -1, -100}, {50, 0, 50}}};
  // A tower 40 m behind the eye: its shadow ends 60 m in front of it.
  const Box tower{{-4, 0, 38}, {4, 50, 42}};
  input.casters = {input.receivers[0], tower};
  for (const Warp* warp : all_warps()) {
    input.options.warp.warp = warp;
    const ShadowPlan plan = input.plan();
    check.that(plan.status == PlanStatus::ok && all_finite(plan), "planned, finite");
    if (plan.map_count == 0) continue;
    const ShadowMap& map = plan.map[0];
    std::uint32_t kept[2];
    check.that(cull_casters(map, input.casters, kept) == 2, "the tower behind the eye is kept");
    const glm::dvec3 top = tower.max;
    const glm::dvec3 shadow = top - travel * (top.y / travel.y);
    const glm::dvec4 a = map.clip_from_world * glm::dvec4(top, 1),
                     b = map.clip_from_world * glm::dvec4(shadow, 1);
    check.that(a.w > 0.0 && b.w > 0.0, "both are in front of the map's projection");
    const double apart = std::max(std::abs(a.x / a.w - b.x / b.w), std::abs(a.y / a.w - b.y / b.w));
    check.that(apart * 0.5 * map.width < 1e-6, "the tower lands on its shadow");
    check.that(a.z / a.w < b.z / b.w && a.z / a.w >= -1.0, "and before it, within the map");
  }
}

void case_degenerate_body(Check& check) {
  double worst = 0.0;
  int kinds = 0;
  for (const glm::dvec3 half :
       {glm::dvec3(5, 5, 0), glm::dvec3(5, 0, 5), glm::dvec3(0, 5, 5), glm::dvec3(5, 0, 0),
        glm::dvec3(0, 5, 0), glm::dvec3(0, 0, 5), glm::dvec3(0, 0, 0)}) {
    for (const glm::dvec3 travel : {glm::dvec3(0.4, -1, 0.3), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1)}) {
      Input input = plain_input(0);
      const glm::dvec3 centre = input.camera.position + glm::normalize(input.camera.forward) * 20.0;
      input.receivers = {{centre - half, centre + half}};
      input.casters = {{centre - glm::dvec3(6.0), centre + glm::dvec3(6.0)}};
      input.light = DirectionalLight{travel};
      for (const Warp* warp : all_warps()) {
        const ShadowMap map = one_map(input, *warp, check);
        input.options.warp.warp = warp;
        const Judgement judged = judge(input, input.plan());
        check.that(judged.float_relative_texels < 0.5 * map.width, "floats land in the map");
        check.that(half != glm::dvec3(0.0) || map.kappa == 0.0, "no warp for a point");
        worst = std::max(worst, judged.float_relative_texels);
        ++kinds;
      }
    }
  }
  check.note("bodies", kinds);
  check.note("largest float error, texels", worst);
}

void case_edge_on(Check& check) {
  Input input = plain_input(0);
  const glm::dvec3 centre = input.camera.position + glm::normalize(input.camera.forward) * 20.0;
  // A wall at x = const under a light that travels within it.
  const double x = centre.x;
  input.receivers = {{{x, centre.y - 5, centre.z - 5}, {x, centre.y + 5, centre.z + 5}}};
  input.casters = {{{x - 5, centre.y + 6, centre.z - 5}, {x + 5, centre.y + 7, centre.z + 5}}};
  input.light = DirectionalLight{{0, -1, 0.3}};
  for (const Warp* warp : all_warps()) {
    const ShadowMap map = one_map(input, *warp, check);
    const glm::dvec3 towards_eye{input.camera.position.x > x ? 1.0 : -1.0, 0, 0};
    const PointAliasing at = measure_point(map, input.camera, centre, towards_eye);
    check.that(at.status != PointAliasing::Status::ok || at.m_max > 1e6,
               "the error on the wall is infinite, or there is none");
    check.that(!std::isnan(at.m_max) && !std::isnan(at.m_min) && !std::isnan(at.perspective_max),
               "and a number");
  }
  const AliasingStats stats = measure(input.plan(), input.camera, input.bounds(), {8, 8, 64});
  check.that(!std::isnan(stats.p95) && !std::isnan(stats.max) && !std::isnan(stats.storage),
             "statistics are numbers");
}

void case_outside_depths(Check& check) {
  Input input = plain_input(0);
  input.camera.forward = {0, 0, -1};
  input.camera.near_depth = 10.0;
  input.receivers = input.casters = {{{-1, 1, -9}, {1, 3, -5}}};
  expect_nothing(input, check);
  input.receivers = input.casters = {{{-1, 1, -3000}, {1, 3, -1001}}};
  expect_nothing(input, check);
}

void case_far_from_origin(Check& check) {
  const Input here = plain_input(0);
  const std::vector<glm::dvec3> offsets = offsets_ahead(here.camera, 1.0);
  const std::vector<double> expected = errors_at(here, offsets);
  check.that(std::none_of(expected.begin(), expected.end(), [](double m) { return !(m > 0.0); }),
             "every point is served");
  double change = 0.0, error = 0.0, absolute = 0.0;
  for (const double distance : {1e6, 1e7}) {
    Input there = plain_input(0);
    const glm::dvec3 move = glm::dvec3(1.0, 0.5, -0.7) * distance;
    there.camera.position += move;
    for (std::vector<Box>* boxes : {&there.receivers, &there.casters}) {
      for (Box& box : *boxes) box = {box.min + move, box.max + move};
    }
    change = std::max(change, largest_difference(expected, errors_at(there, offsets)));
    const Judgement judged = judge(there, there.plan());
    error = std::max(error, judged.float_relative_texels);
    absolute = std::max(absolute, judged.float_absolute_texels);
  }
  check.that(change <= 1e-6, "m is the same to 1e-6");
  check.that(error < 5e-4, "floats relative to the camera stay below 0.0005 texels");
  check.note("change of m", change);
  check.note("float error relative to the camera, texels", error);
  check.note("of an absolute matrix", absolute);
}

void case_units(Check& check) {
  const Input one = plain_input(0);
  const std::vector<double> expected = errors_at(one, offsets_ahead(one.camera, 1.0));
  const double kappa = one.plan().map[0].kappa;
  double change = 0.0;
  for (const double scale : {1e-6, 0x1p-20, 0x1p20, 1e6}) {
    Input other = plain_input(0);
    other.camera.position *= scale;
    other.camera.near_depth *= scale;
    other.camera.far_depth *= scale;
    for (std::vector<Box>* boxes : {&other.receivers, &other.casters}) {
      for (Box& box : *boxes) box = {box.min * scale, box.max * scale};
    }
    const ShadowPlan plan = other.plan();
    check.that(plan.map_count == 1 && plan.map[0].warp == one.plan().map[0].warp, "the same maps and warps");
    change = std::max(change, std::abs(plan.map[0].kappa * scale / kappa - 1.0));
    change =
        std::max(change, largest_difference(expected, errors_at(other, offsets_ahead(other.camera, scale))));
  }
  check.that(change <= 1e-6, "strength and m are the same in other units");
  check.note("largest change", change);
}

void case_into_light(Check& check) {
  for (const double sign : {-1.0, 1.0}) {
    Input input = plain_input(0);
    const glm::dvec3 forward = glm::normalize(input.camera.forward);
    input.light = DirectionalLight{forward * sign};
    for (const Warp* warp : all_warps()) {
      const ShadowMap map = one_map(input, *warp, check);
      for (const double depth : {0.2, 3.0, 15.0}) {
        const PointAliasing at =
            measure_perspective(map, input.camera, input.camera.position + forward * depth);
        check.that(at.status == PointAliasing::Status::ok && std::isfinite(at.m_max) && at.m_max > 0.0,
                   "m is finite on the axis");
      }
    }
  }
}

void case_edge_on_surfaces(Check& check) {
  Input input = plain_input(0);
  const glm::dvec3 p = input.camera.position + glm::normalize(input.camera.forward) * 12.0;
  const glm::dvec3 e = glm::normalize(p - input.camera.position);
  const glm::dvec3 l = glm::normalize(glm::dvec3(0.3, -1, 0.2));
  input.light = DirectionalLight{l};
  using Status = PointAliasing::Status;
  const auto no_nan = [&](const PointAliasing& a) {
    for (const double v :
         {a.m_max, a.m_min, a.m_s, a.m_t, a.m_area, a.anisotropy, a.perspective_max, a.projection})
      check.that(!std::isnan(v), "no value is not-a-number");
  };
  for (const Warp* warp : all_warps()) {
    const ShadowMap map = one_map(input, *warp, check);
    const auto at = [&](const glm::dvec3& normal) {
      const PointAliasing a = measure_point(map, input.camera, p, glm::normalize(normal));
      no_nan(a);
      return a;
    };
    const glm::dvec3 both = glm::cross(e, l);
    const PointAliasing across_light = at(-e + l * glm::dot(e, l));
    check.that(across_light.status != Status::ok || across_light.m_max > 1e6, "across the light: infinite");
    const PointAliasing across_eye = at(-l + e * glm::dot(e, l));
    check.that(
        across_eye.status != Status::ok || (std::isfinite(across_eye.m_max) && across_eye.m_min < 1e-6),
        "across the eye: nothing to see of it, finite along it");
    const PointAliasing across_both = at(both);
    check.that(across_both.status != Status::ok || across_both.m_max > 1e6, "across both: no value");
    check.that(at(l).status == Status::faces_away, "turned from the light: faces away");
    check.that(at(e).status == Status::faces_away, "turned from the eye: faces away");
  }
}

}  // namespace gnomon::stress
