// Do the trapezoid and the separating plane match the golden numbers?
#include <gtest/gtest.h>

#include <cmath>

#include "gnomon/extend/warp.hpp"
#include "gnomon/gnomon.hpp"
#include "gnomon/study/formulas.hpp"
#include "support/golden.hpp"
#include "support/near.hpp"
#include "warp/formulas.hpp"

namespace gnomon::test {
namespace {

// Double against double; next to the turn-off a difference of 158 loses three digits.
constexpr double kClosedForm = 1e-12;

TEST(TrapezoidGolden, the_distance_of_the_projection_centre_matches_and_is_infinite_from_80_percent_on) {
  for (const Json& row : golden("extra").at("tsm")) {
    const double expected = number(row.at("eta"));
    const double distance = trapezoid_distance(number(row.at("lam")), number(row.at("delta")));
    EXPECT_CLOSE(distance, expected, kClosedForm);
  }
}

TEST(TrapezoidGolden, the_focus_lands_on_the_80_percent_line) {
  for (const Json& row : golden("extra").at("tsm")) {
    const double length = number(row.at("lam")), focus = number(row.at("delta"));
    const double distance = trapezoid_distance(length, focus);
    if (std::isinf(distance)) continue;
    // The kappa form's row, -1 at the near end and 1 at the far end.
    const double kappa = 1.0 / distance;
    const double y = ((2.0 / length + kappa) * focus - 1.0) / (1.0 + kappa * focus);
    // The paper counts from the far end.
    EXPECT_CLOSE(-y, number(row.at("row_of_focus")), kClosedForm);
  }
}

TEST(TrapezoidWarp, half_of_the_logarithmic_depths_get_80_percent_of_the_map) {
  // Depths 1 to 100 seen from the side of an overhead light: the body is 99 long, depth 10 lies 9 from its
  // near end and lands at 79.2 of 99.
  WarpInput in{};
  const WarpInput::Point body[] = {{-1, 1, 0, 1}, {1, 100, 0, 100}};
  in.body = body;
  in.y_min = 1.0;
  in.y_max = 100.0;
  in.sin_gamma = 1.0;
  in.depth_begin = 1.0;
  in.depth_end = 100.0;
  in.view.forward = {0, 1, 0};
  const double kappa = warps::tsm.choose(in).kappa;
  EXPECT_CLOSE(9.0 * (1.0 + kappa * 99.0) / (1.0 + kappa * 9.0), 0.8 * 99.0, kClosedForm);
}

TEST(SeparatingPlaneGolden, texels_are_as_large_as_uniform_ones_at_the_plane) {
  const Json& row = golden("extra").at("separating_plane");
  const double length = number(row.at("d")), kappa = 1.0 / number(row.at("n"));
  const double u = length * separating_share(kappa, length);
  EXPECT_CLOSE(u, number(row.at("u_star")), kClosedForm);
  // Texels per area of both maps there: the warped one's falls with w^3.
  const double uniform = number(row.at("rho_uniform"));
  const double w = 1.0 + kappa * u, w_far = 1.0 + kappa * length;
  EXPECT_CLOSE(uniform * w_far * w_far / (w * w * w), number(row.at("rho_at")), kClosedForm);
}

TEST(SeparatingPlane, without_a_warp_the_share_tends_to_two_thirds) {
  EXPECT_EQ(separating_share(0.0, 99.0), 2.0 / 3.0);
  EXPECT_CLOSE(separating_share(1e-12, 1.0), 2.0 / 3.0, kClosedForm);
}

}  // namespace
}  // namespace gnomon::test
