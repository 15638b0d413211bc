// Do storage factors match the closed forms: per cascade, over warp strengths, over light angles?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"
#include "gnomon/gnomon.hpp"
#include "support/golden.hpp"
#include "support/near.hpp"
#include "warp/formulas.hpp"

namespace gnomon::test {
namespace {

/// A frustum's profile in the light frame, symmetric across the plane of view and light; x spans one unit per
/// unit of depth.
struct Profile {
  std::array<WarpInput::Point, 8> point{};
  Polytope polytope;
  WarpInput in{};
  Profile(double n, double f, double tan_half, double gamma) {
    const double s = std::sin(gamma), c = std::cos(gamma);
    polytope = box_polytope({glm::dvec3(-1), glm::dvec3(1)});
    for (std::size_t i = 0; i < 8; ++i) {
      const double z = i & 4 ? f : n, side = i & 2 ? tan_half : -tan_half;
      point[i] = {i & 1 ? 0.5 * z : -0.5 * z, z * (s + side * c), z * (side * s - c), z};
      polytope.vertex[i].position = {point[i].x, point[i].y, point[i].z};
    }
    in.body = point;
    in.y_min = in.y_max = point[0].y;
    for (const WarpInput::Point& p : point) {
      in.y_min = std::min(in.y_min, p.y);
      in.y_max = std::max(in.y_max, p.y);
    }
    in.sin_gamma = s;
    in.cos_gamma = c;
    in.depth_begin = n;
    in.depth_end = f;
    in.tan_half_fov = tan_half;
    in.objective = Objective::storage;
    in.polytope = &polytope;
    in.view = {{1, 0, 0}, {0, c, s}, {0, s, -c}, -0.5, 0.5, -tan_half, tan_half, 1e-3, 2e-3 * tan_half};
  }
};

// A light exactly across or along the view makes the closed forms exact; sines of 90 degrees round.
constexpr double kClosed = 1e-12;

TEST(StorageGolden, every_strength_between_uniform_and_psm_has_the_errors_of_the_eta_family) {
  int rows = 0;
  for (const Json& row : golden("eta_family").at("rows")) {
    const double alpha = row.at("alpha"), n_over_w = number(row.at("n_over_W"));
    Profile profile(1.0, alpha, 0.5, std::numbers::pi / 2);
    const double kappa = 1.0 / (n_over_w * (alpha - 1.0));
    const WarpError error = warp_error(profile.in, kappa);
    EXPECT_CLOSE(error.m_t, number(row.at("Mt")), kClosed) << row.dump();
    EXPECT_CLOSE(error.m_s, number(row.at("Ms")), kClosed) << row.dump();
    EXPECT_CLOSE(error.value(Objective::storage), number(row.at("S")), kClosed) << row.dump();
    ++rows;
  }
  EXPECT_GT(rows, 20);
}

// The page's S has the beam's angle to the image plane: 1 / cos(theta) at all four corners of the profile;
// and an image one unit high. Both are factors of every strength alike.
double normalised(double value, double theta) {
  return value / (2.0 * std::sin(theta));
}

TEST(StorageGolden, the_vertex_search_is_as_good_as_brute_force_over_light_angles_and_never_above_uniform) {
  constexpr double kSearch = 1e-3;  // of the optimum: the search may stop this short of it
  int warped = 0;
  for (const Json& row : golden("falloff").at("rows")) {
    const double theta = number(row.at("theta_deg")) * std::numbers::pi / 180.0;
    const double gamma = number(row.at("gamma_deg")) * std::numbers::pi / 180.0;
    const Profile profile(1.0, row.at("alpha"), std::tan(theta), gamma);
    EXPECT_CLOSE(profile.in.y_max - profile.in.y_min, number(row.at("W")), 1e-11);
    const double uniform = warp_error(profile.in, 0.0).value(Objective::storage);
    EXPECT_CLOSE(normalised(uniform, theta), number(row.at("S_uniform")), 1e-11);
    const double kappa_2004 = 1.0 / number(row.at("n_lispsm"));
    EXPECT_CLOSE(normalised(warp_error(profile.in, kappa_2004).value(Objective::storage), theta),
                 number(row.at("S_lispsm")), 1e-10);
    const double kappa = warps::lispsm.choose(profile.in).kappa;
    const double ours = warp_error(profile.in, kappa).value(Objective::storage);
    EXPECT_LE(ours, uniform) << row.dump();
    EXPECT_LE(normalised(ours, theta), number(row.at("S_brute")) * (1.0 + kSearch)) << row.dump();
    if (kappa > 0.0) ++warped;
  }
  EXPECT_GT(warped, 20);
}

TEST(StorageGolden, lloyds_fall_off_has_the_strengths_of_his_thesis) {
  constexpr double kFormula = 1e-9;  // a few elementary functions, and the body's length by subtraction
  int warped = 0, off = 0;
  for (const Json& row : golden("falloff").at("rows")) {
    const double theta = number(row.at("theta_deg")) * std::numbers::pi / 180.0;
    const double gamma = number(row.at("gamma_deg")) * std::numbers::pi / 180.0;
    const Profile profile(1.0, row.at("alpha"), std::tan(theta), gamma);
    EXPECT_NEAR(lloyd_eta(gamma, theta), number(row.at("eta_lloyd_linear")), kFormula) << row.dump();
    // The strength of either way to let the parameter fall off.
    for (const std::string way : {"linear", "cos"}) {
      const double eta = number(row.at("eta_lloyd_" + way));
      EXPECT_NEAR(kappa_length_from_eta(eta, row.at("alpha")) / number(row.at("W")),
                  1.0 / number(row.at("n_lloyd_" + way)), kFormula)
          << way << row.dump();
    }
    const double kappa = warps::lispsm_lloyd.choose(profile.in).kappa, n = number(row.at("n_lloyd_linear"));
    if (std::isinf(n)) {
      EXPECT_EQ(kappa, 0.0) << row.dump();
      ++off;
    } else {
      EXPECT_CLOSE(1.0 / kappa, n, kFormula) << row.dump();
      EXPECT_CLOSE(normalised(warp_error(profile.in, kappa).value(Objective::storage), theta),
                   number(row.at("S_lloyd_linear")), kFormula)
          << row.dump();
      ++warped;
    }
  }
  EXPECT_GT(warped, 20);
  EXPECT_GT(off, 5);
}

TEST(StorageGolden, every_strength_of_the_page_has_its_storage_and_its_errors) {
  constexpr double kFormula = 1e-9;
  // `n_brute` is where a search stopped on a flat valley: its strength has few digits, its storage has them
  // all.
  constexpr double kBrute = 1e-6;
  int closed = 0;
  for (const Json& row : golden("falloff").at("rows")) {
    const double theta = number(row.at("theta_deg")) * std::numbers::pi / 180.0;
    const double gamma = number(row.at("gamma_deg")) * std::numbers::pi / 180.0;
    const Profile profile(1.0, row.at("alpha"), std::tan(theta), gamma);
    EXPECT_CLOSE(std::min_element(profile.point.begin(), profile.point.end(),
                                  [](const auto& a, const auto& b) { return a.y < b.y; })
                     ->y,
                 number(row.at("y0")), kFormula);
    const auto at = [&](const char* n) { return warp_error(profile.in, 1.0 / number(row.at(n))); };
    const auto storage = [&](const WarpError& error) {
      return normalised(error.value(Objective::storage), theta);
    };
    EXPECT_CLOSE(storage(at("n_brute")), number(row.at("S_brute")), kBrute) << row.dump();
    EXPECT_CLOSE(storage(at("n_lloyd_cos")), number(row.at("S_lloyd_cos")), kFormula) << row.dump();
    EXPECT_CLOSE(storage(warp_error(profile.in, 1.0)), number(row.at("S_psm_n1")), kFormula) << row.dump();
    EXPECT_CLOSE(storage(at("n_closed")), number(row.at("S_closed")), kFormula) << row.dump();
    const double kappa = warps::lispsm_closed.choose(profile.in).kappa;
    EXPECT_NEAR(kappa, 1.0 / number(row.at("n_closed")), kFormula) << row.dump();
    const double ratio = at("n_closed").m_t / warp_error(profile.in, 0.0).m_t;
    const double uniform_t = number(row.at("S_uniform")) / number(row.at("alpha"));
    EXPECT_CLOSE(ratio * uniform_t, number(row.at("Mt_closed")), kFormula) << row.dump();
    const double across = at("n_closed").m_s / warp_error(profile.in, 0.0).m_s;
    EXPECT_CLOSE(across * number(row.at("alpha")), number(row.at("Ms_closed")), kFormula) << row.dump();
    if (kappa > 0.0) ++closed;
  }
  EXPECT_GT(closed, 20);
}

TEST(StorageGolden, an_overhead_light_takes_the_weakest_of_the_strengths_that_are_equally_good) {
  // Storage is flat from PSM to LiSPSM there, while the worst texel is best at LiSPSM: the weakest is the
  // answer.
  constexpr double kWeakest = 1.02;
  for (const Json& row : golden("falloff").at("rows")) {
    if (number(row.at("gamma_deg")) != 90.0) continue;
    const Profile profile(1.0, row.at("alpha"),
                          std::tan(number(row.at("theta_deg")) * std::numbers::pi / 180.0),
                          std::numbers::pi / 2);
    const double kappa = warps::lispsm.choose(profile.in).kappa;
    EXPECT_LE(kappa * number(row.at("n_closed")), kWeakest) << row.dump();
  }
}

/// Sum of the maps' storage for one camera, k logarithmic cascades over the camera's whole range.
double planned_storage(double alpha, int k, const glm::dvec3& light, const Warp& warp) {
  // An image one unit wide and high: the factors of the page without the opening.
  const Camera camera =
      perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 2.0 * std::atan(0.5), 1.0, 1.0, alpha, 1024, 1024);
  const Box everything{glm::dvec3(-2 * alpha), glm::dvec3(2 * alpha)};
  PlanOptions options;
  options.cascades = k;
  options.split.scheme = SplitScheme::logarithmic;
  options.split.range = SplitRange::camera;
  options.filter.texels = 0.0;
  options.warp.warp = &warp;
  const ShadowPlan plan =
      make_plan(camera, DirectionalLight{light}, {{&everything, 1}, {&everything, 1}}, options);
  double sum = 0.0;
  for (const ShadowMap& map : plan.maps()) sum += map.storage;
  return sum;
}

TEST(StorageGolden, logarithmic_cascades_need_the_texels_of_the_closed_forms) {
  constexpr double kPlan = 1e-9;    // through clipping and matrices
  constexpr double kWarped = 1e-3;  // what the search may fall short of the optimum
  int rows = 0;
  for (const Json& row : golden("storage").at("zp")) {
    const int k = row.at("k");
    const double alpha = row.at("alpha");
    if (k > kMaxMaps) continue;
    EXPECT_CLOSE(planned_storage(alpha, k, {0, -1, 0}, warps::none), number(row.at("overhead_ZP")), kPlan)
        << row.dump();
    EXPECT_CLOSE(planned_storage(alpha, k, {0, 0, -1}, warps::none), number(row.at("behind_ZP")), kPlan)
        << row.dump();
    EXPECT_CLOSE(planned_storage(alpha, k, {0, 0, -1}, warps::lispsm), number(row.at("behind_ZP_W")), kPlan)
        << row.dump();
    EXPECT_LE(planned_storage(alpha, k, {0, -1, 0}, warps::lispsm),
              number(row.at("overhead_ZP")) * (1.0 + kPlan));
    ++rows;
  }
  EXPECT_GT(rows, 20);
  // With the warp the closed form leaves out the lean of texels off the axis, which the plan's bound counts:
  // never below it.
  for (const Json& row : golden("storage").at("zp")) {
    if (row.at("k").get<int>() > kMaxMaps) continue;
    EXPECT_GE(planned_storage(row.at("alpha"), row.at("k"), {0, -1, 0}, warps::lispsm),
              number(row.at("overhead_ZP_W")) * (1.0 - kWarped))
        << row.dump();
  }
}

}  // namespace
}  // namespace gnomon::test
