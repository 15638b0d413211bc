// Do the textbook curves dp/ds(z) come out, from the formulas and from measuring a real plan?
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gnomon/extend/warp.hpp"
#include "gnomon/gnomon.hpp"
#include "gnomon/study/dpds.hpp"
#include "support/golden.hpp"
#include "support/near.hpp"

namespace gnomon::test {
namespace {

// Both sides in double, a handful of operations on numbers up to 1e7.
constexpr double kCurve = 1e-12;

TEST(DpdsGolden, the_closed_forms_reproduce_the_curves_of_the_survey) {
  const Json& data = golden("dpds");
  int rows = 0;
  for (const Json& curve : data.at("curves")) {
    const double n = curve.at("zn"), f = curve.at("zf");
    for (const Json& row : curve.at("rows")) {
      const double z = row.at("z");
      EXPECT_CLOSE(dpds::uniform(z, n, f), number(row.at("uniform")), kCurve);
      EXPECT_CLOSE(dpds::psm(z, n, f), number(row.at("psm")), kCurve);
      EXPECT_CLOSE(dpds::lispsm(z, n, f), number(row.at("lispsm")), kCurve);
      EXPECT_CLOSE(dpds::logarithmic(z, n, f), number(row.at("log")), kCurve);
      // PSM is the perspective that starts at the eye.
      EXPECT_CLOSE(dpds::perspective(z, n, f, n), number(row.at("psm")), kCurve);
      ++rows;
    }
  }
  EXPECT_EQ(rows, 19);
}

TEST(DpdsGolden, extremes_lie_where_they_were_derived) {
  const Json& closed = golden("dpds").at("curves").at(0).at("closed");
  EXPECT_CLOSE(dpds::uniform(1, 1, 100), number(closed.at("uniform_max")), kCurve);
  EXPECT_CLOSE(dpds::psm(100, 1, 100), number(closed.at("psm_max")), kCurve);
  EXPECT_CLOSE(dpds::lispsm(1, 1, 100), number(closed.at("lispsm_max_both_ends")), kCurve);
  EXPECT_CLOSE(dpds::lispsm(100, 1, 100), number(closed.at("lispsm_max_both_ends")), kCurve);
  EXPECT_CLOSE(dpds::lispsm(number(closed.at("lispsm_min_at")), 1, 100), number(closed.at("lispsm_min")),
               kCurve);
}

TEST(DpdsGolden, no_depth_range_has_no_error) {
  EXPECT_EQ(dpds::uniform(5, 5, 5), 0.0);
  EXPECT_EQ(dpds::psm(5, 5, 5), 0.0);
  EXPECT_EQ(dpds::lispsm(5, 5, 5), 0.0);
  EXPECT_EQ(dpds::logarithmic(5, 5, 5), 0.0);
}

/// A plan with one map round the whole frustum, under a light across the view.
ShadowPlan overhead_plan(const Camera& camera, const Warp& warp, const Box& everything) {
  PlanOptions options;
  options.cascades = 1;
  options.filter.texels = 0.0;
  options.warp.warp = &warp;
  return make_plan(camera, DirectionalLight{{0, -1, 0}}, {{&everything, 1}, {&everything, 1}}, options);
}

// Positions of up to 1e7 through a matrix whose w spans four orders of magnitude.
constexpr double kMeasured = 1e-8;

TEST(DpdsGolden, measuring_a_plan_along_the_view_axis_reproduces_the_curves) {
  const Json& data = golden("dpds");
  for (const Json& curve : data.at("curves")) {
    const double n = curve.at("zn"), f = curve.at("zf");
    // Pixels as texels, and an image two units of slope high: dp/ds is for an image one unit high.
    const Camera camera =
        perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, std::numbers::pi / 2, 1.0, n, f, 1024, 1024);
    const Box everything{glm::dvec3(-2 * f), glm::dvec3(2 * f)};
    const ShadowPlan uniform = overhead_plan(camera, warps::none, everything);
    const ShadowPlan lispsm = overhead_plan(camera, warps::lispsm04, everything);
    ASSERT_EQ(uniform.map_count, 1);
    ASSERT_EQ(lispsm.map_count, 1);
    for (const Json& row : curve.at("rows")) {
      const double z = row.at("z");
      const PointAliasing flat = measure_perspective(uniform.map[0], camera, {0, 0, -z});
      ASSERT_EQ(flat.status, PointAliasing::Status::ok) << z;
      EXPECT_CLOSE(flat.m_t, 0.5 * number(row.at("uniform")), kMeasured);
      EXPECT_CLOSE(flat.m_s, number(row.at("mx_uniform")), kMeasured);
      const PointAliasing warped = measure_perspective(lispsm.map[0], camera, {0, 0, -z});
      EXPECT_CLOSE(warped.m_t, 0.5 * number(row.at("lispsm")), kMeasured);
      EXPECT_CLOSE(warped.m_s, number(row.at("mx_lispsm")), kMeasured);
    }
  }
}

TEST(DpdsGolden, the_published_strength_is_that_of_2004_at_every_angle) {
  // The table's body is f - n long at every angle; its sample line ends at z1 = z0 + length sin(gamma).
  for (const Json& row : golden("dpds").at("n_opt")) {
    const double n = row.at("zn"), f = row.at("zf");
    for (const auto& [degrees, expected] : row.at("lispsm04").items()) {
      const double gamma = std::stod(degrees) * std::numbers::pi / 180.0;
      WarpInput in{};
      const WarpInput::Point ends[] = {{0, 0, 0, n}, {0, f - n, 0, f}};
      in.body = ends;
      in.y_max = ends[1].y;
      in.sin_gamma = std::sin(gamma);
      in.cos_gamma = std::cos(gamma);
      in.depth_begin = n;
      in.depth_end = f;
      in.tan_half_fov = 1.0;
      in.scale_near = n;
      in.depth_per_y = in.sin_gamma;
      EXPECT_CLOSE(1.0 / warps::lispsm04.choose(in).kappa, number(expected), 1e-11) << f << ' ' << degrees;
    }
  }
}

}  // namespace
}  // namespace gnomon::test
