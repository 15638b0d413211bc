// Extreme cases of one map in parallel light, for which there are formulas.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "case_list.hpp"
#include "judge.hpp"

namespace gnomon::stress {
namespace {

constexpr double kFov = kPi / 3.0, kTheta = 0.5 * kFov;
// Of strengths and storages that two ways of rounding lead to.
constexpr double kRounding = 1e-9;

bool near(double a, double b, double relative) {
  return std::abs(a - b) <= relative * std::abs(b);
}

// A grid of samples misses the worst point of a map by this much.
constexpr double kSampled = 1.0 + 1e-3;

/// By the exact error at many points; the plan's own number is a bound from simplified weights.
double measured_storage(Input input, const Warp& warp) {
  input.options.warp.objective = Objective::storage;
  input.options.warp.warp = &warp;
  return measure(input.plan(), input.camera, input.bounds(), {24, 24, 24}).storage;
}

/// From this view depth on.
double measured_storage_from(double depth, Input input, const Warp& warp) {
  input.options.warp.objective = Objective::storage;
  input.options.warp.warp = &warp;
  const ShadowPlan plan = input.plan();
  input.camera.near_depth = std::min(depth, 0.9999 * input.camera.far_depth);
  return measure(plan, input.camera, input.bounds(), {24, 24, 24}).storage;
}

/// Angle below which the storage of a full frustum is least without a warp.
double turn_off_angle(double alpha) {
  return std::atan(std::tan(kTheta) * (1.0 + 3.0 / alpha) / (3.0 * (1.0 - 1.0 / alpha)));
}

/// W + K - 3 D of the full frustum: not above 0 where no warp has the least storage.
double warp_margin(double n, double f, double gamma) {
  const double low = std::sin(gamma) - std::tan(kTheta) * std::cos(gamma);
  const double high = std::sin(gamma) + std::tan(kTheta) * std::cos(gamma);
  const double y0 = std::min(n * low, f * low);
  const double length = f * high - y0, top = n * high - y0, bottom = std::max(0.0, f * low - y0);
  return length + bottom - 3.0 * top;
}

}  // namespace

Input full_frustum(double near_depth, double far_depth, double fov_radians, double gamma) {
  Input input;
  input.camera = perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, fov_radians, 1.0, near_depth, far_depth,
                                    1024, 1024);
  // cos(pi / 2) is not 0, and an overhead light must be exactly that.
  const double cosine = gamma == 0.5 * kPi ? 0.0 : std::cos(gamma);
  const double sine = gamma == kPi ? 0.0 : std::sin(gamma);
  input.light = DirectionalLight{{0.0, -sine, -cosine}};
  const glm::dvec3 half(8.0 * far_depth);
  input.receivers = input.casters = {{-half, half}};
  input.options.cascades = 1;
  input.options.filter.texels = 0.0;
  return input;
}

ShadowMap one_map(Input input, const Warp& warp, Check& check) {
  input.options.warp.objective = Objective::storage;
  input.options.warp.warp = &warp;
  const ShadowPlan plan = input.plan();
  check.that(plan.status == PlanStatus::ok && plan.map_count == 1, "one map is planned");
  check.that(all_finite(plan), "every number is finite");
  return plan.map[0];
}

void case_depth_ratio(Check& check) {
  const double n = 1e-4, f = 1e3;
  const Input input = full_frustum(n, f, kFov, 0.5 * kPi);
  const ShadowMap closed = one_map(input, warps::lispsm_closed, check);
  const ShadowMap none = one_map(input, warps::none, check);
  check.that(closed.kappa > 0.0 && near(1.0 / closed.kappa, n + std::sqrt(n * f), kRounding),
             "N = n + sqrt(n f)");
  check.that(closed.storage <= none.storage, "the warp needs no more texels than none");
  const double error = judge(input, input.plan()).float_relative_texels;
  check.that(error < 0.5, "floats relative to the camera stay within half a texel");
  check.note("storage against none", closed.storage / none.storage);
  check.note("float error, texels", error);
}

void case_near_and_far_touch(Check& check) {
  for (const double alpha : {1.0 + 1e-12, 1.0 + 1e-9, 1.0001, 1.5, 2.0, 3.0}) {
    for (const double gamma : {1e-6, 0.3 * kTheta, kTheta, 1.2 * kTheta, 0.5 * kPi}) {
      const Input input = full_frustum(1.0, alpha, kFov, gamma);
      const ShadowMap closed = one_map(input, warps::lispsm_closed, check);
      check.that(std::isfinite(closed.kappa) && closed.kappa >= 0.0,
                 "the strength is finite and not negative");
      check.that(closed.kappa == 0.0 || warp_margin(1.0, alpha, gamma) > -1e-9, "no warp where W + K <= 3 D");
      check.that(measured_storage(input, warps::optimal) <= measured_storage(input, warps::none) * kSampled,
                 "optimal needs no more texels than none");
    }
  }
}

void case_bad_near(Check& check) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double near_depth : {0.0, -1.0, kNan, 1e-13 * 100.0, 100.0, 200.0}) {
    Input input = full_frustum(1.0, 100.0, kFov, 1.0);
    input.camera.near_depth = near_depth;
    const ShadowPlan plan = input.plan();
    check.that(plan.status == PlanStatus::invalid_input && plan.map_count == 0, "refused");
    check.that(!plan.invalid_field.empty(), "the field is named");
  }
  Input input = full_frustum(1.0, 100.0, kFov, 1.0);
  input.camera.near_depth = 1e-12 * 100.0;
  check.that(input.plan().status == PlanStatus::ok, "1e-12 of the far plane is accepted");
}

void case_light_along_view(Check& check) {
  for (const double gamma : {0.0, kPi}) {
    const Input input = full_frustum(1.0, 100.0, kFov, gamma);
    const ShadowMap none = one_map(input, warps::none, check);
    const ShadowMap closed = one_map(input, warps::lispsm_closed, check);
    check.that(closed.kappa == 0.0, "no warp by formula");
    check.that(closed.storage == none.storage, "storage of no warp");
    glm::dvec3 row[3];
    for (int i = 0; i < 3; ++i) {
      const glm::dmat4& m = none.clip_from_world;
      const glm::dvec3 r{m[0][i], m[1][i], m[2][i]};
      row[i] = r / std::sqrt(glm::dot(r, r));
    }
    const double volume = glm::dot(glm::cross(row[0], row[1]), row[2]);
    check.that(near(std::abs(volume), 1.0, 1e-14), "axes are orthonormal");
    check.that(one_map(input, warps::optimal, check).storage <= none.storage, "optimal needs no more texels");
  }
  // What the formula does not know: a ground cuts the frustum.
  Input ground = full_frustum(0.1, 1000.0, kFov, 0.0);
  ground.receivers = ground.casters = {{{-1000, -2, -1000}, {1000, 20, 1000}}};
  const double gain =
      one_map(ground, warps::lispsm, check).storage / one_map(ground, warps::none, check).storage;
  check.that(gain <= 1.0, "the searched warp needs no more texels over a ground either");
  check.note("over a ground the searched warp is taken even here: storage against none", gain);
}

void case_below_turn_off(Check& check) {
  double published = 0.0;
  for (const double alpha : {10.0, 100.0, 1000.0, 1e7}) {
    const double off = turn_off_angle(alpha);
    for (const double gamma : {1e-9, 1e-6, 1e-3, 0.1 * off, 0.5 * off, off * (1.0 - 1e-9)}) {
      const Input input = full_frustum(1.0, alpha, kFov, gamma);
      check.that(one_map(input, warps::lispsm_closed, check).kappa == 0.0, "no warp by formula");
      const double none = one_map(input, warps::none, check).storage;
      check.that(one_map(input, warps::lispsm, check).storage <= none * (1.0 + kRounding),
                 "the searched warp needs no more texels");
      published = std::max(published, one_map(input, warps::lispsm04, check).storage / none);
    }
    const Input above = full_frustum(1.0, alpha, kFov, off * 1.1);
    check.that(one_map(above, warps::lispsm_closed, check).kappa > 0.0,
               "a warp a tenth above the turn-off angle");
  }
  check.note("storage of the 2004 formula against none, at worst", published);
}

void case_frustum_edge(Check& check) {
  const double n = 1.0, f = 100.0;
  const auto strength = [&](double gamma) {
    return one_map(full_frustum(n, f, kFov, gamma), warps::lispsm_closed, check).kappa;
  };
  const double at = strength(kTheta);
  check.that(near(at, 1.0 / (2.0 * std::sqrt(n * f) * std::sin(kTheta)), 1e-9), "N = 2 sqrt(n f) sin(theta)");
  double jump = 0.0;
  for (const double off : {1e-12, 1e-9, 1e-6}) {
    for (const double sign : {-1.0, 1.0}) {
      const double change = std::abs(strength(kTheta * (1.0 + sign * off)) / at - 1.0);
      check.that(change <= 1e3 * off, "the strength is continuous");
      jump = std::max(jump, change / off);
    }
  }
  check.note("largest relative change of strength per relative change of angle", jump);
}

void case_overhead(Check& check) {
  for (const double f : {2.0, 100.0, 1e4}) {
    const Input input = full_frustum(1.0, f, kFov, 0.5 * kPi);
    const double kappa = one_map(input, warps::lispsm_closed, check).kappa;
    check.that(kappa > 0.0 && near(1.0 / kappa, 1.0 + std::sqrt(f), kRounding), "N = n + sqrt(n f)");
  }
}

void case_from_ahead(Check& check) {
  double exact = 0.0;
  for (const double gamma : {0.01, 0.4, kTheta, 0.9, 1.4, 1.5707}) {
    const Input behind = full_frustum(1.0, 100.0, kFov, gamma),
                ahead = full_frustum(1.0, 100.0, kFov, kPi - gamma);
    for (const Warp* warp : {&warps::lispsm_closed, &warps::lispsm}) {
      const ShadowMap a = one_map(behind, *warp, check), b = one_map(ahead, *warp, check);
      check.that(near(b.storage, a.storage, 1e-6), "storage is that of the mirrored angle");
      check.that(std::abs(a.kappa - b.kappa) <= 1e-6 * a.kappa, "strength is that of the mirrored angle");
      const double apart = measured_storage(ahead, *warp) / measured_storage(behind, *warp);
      exact = std::max(exact, std::abs(apart - 1.0));
    }
  }
  check.note("by the exact error, which knows no such symmetry, storage differs by up to", exact);
}

void case_pseudo_near(Check& check) {
  const double n = 1.0, f = 100.0;
  double ratio = 0.0;
  for (const double hint : {1.0, 10.0, 66.9, 67.1, 90.0, 99.9999}) {
    Input input = full_frustum(n, f, kFov, 0.5 * kPi);
    input.options.split.pseudo_near = hint;
    const ShadowMap none = one_map(input, warps::none, check);
    for (const Warp* warp : all_warps()) {
      if (!warp->drop_without_gain) continue;
      const ShadowMap map = one_map(input, *warp, check);
      check.that(map.kappa >= 0.0, "the strength is not negative");
      // Some warps go by the simplified weights, some by the exact error.
      check.that(map.storage <= none.storage * (1.0 + kRounding) ||
                     measured_storage_from(hint, input, *warp) <=
                         measured_storage_from(hint, input, warps::none) * kSampled,
                 "no more texels than no warp");
      if (hint >= 67.1) ratio = std::max(ratio, none.storage / map.storage);
    }
  }
  for (const double hint : {100.0, 150.0, 1e9}) {
    Input input = full_frustum(n, f, kFov, 0.5 * kPi);
    input.options.split.pseudo_near = hint;
    check.that(one_map(input, warps::lispsm_closed, check).kappa == 0.0, "no warp where no depths are left");
  }
  check.note("a warp is still worth it beyond two thirds: texels saved, times", ratio);
}

}  // namespace gnomon::stress
