// Do biases and the warp's kappa form match the golden numbers?
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/extend/warp.hpp"
#include "gnomon/gnomon.hpp"
#include "gnomon/study/bias.hpp"
#include "support/golden.hpp"
#include "support/near.hpp"
#include "warp/plane_map.hpp"

namespace gnomon::test {
namespace {

TEST(BiasGolden, a_world_unit_along_the_light_is_worth_less_depth_where_w_is_larger) {
  const Json& data = golden("extra").at("warp_bias");
  const glm::dmat4 m = mat4(data.at("M"));
  const glm::dvec3 light = vec3(data.at("light"));
  for (const Json& row : data.at("rows")) {
    // Golden depth grows towards the light and its derivative is along the light's travel; ours is for a move
    // towards the light: the sign turns once.
    EXPECT_CLOSE(ndc_depth_per_world_unit(m, light, vec3(row.at("world"))), -number(row.at("predicted")),
                 1e-12);
    // Golden differences are central: their own rounding.
    EXPECT_CLOSE(ndc_depth_per_world_unit(m, light, vec3(row.at("world"))),
                 -number(row.at("dndcz_per_world_bias")), 1e-10);
  }
}

TEST(BiasGolden, half_a_texel_of_slope_matches_the_table) {
  for (const Json& row : golden("extra").at("slope_bias")) {
    const double cosine = row.at("cos_l"), texel = row.at("texel");
    const glm::dvec3 normal{std::sqrt((1.0 - cosine) * (1.0 + cosine)), cosine, 0.0};
    const BiasOptions uncapped{0.0, 0.5, 0.0, 1e9};
    EXPECT_CLOSE(slope_bias_world(uncapped, texel, 0.0, normal, {0, -1, 0}),
                 number(row.at("half_texel_slope")), 1e-12);
    EXPECT_CLOSE(slope_bias_world(uncapped, texel * std::sqrt(2.0), 0.0, normal, {0, -1, 0}),
                 number(row.at("diag")), 1e-12);
  }
}

TEST(KappaGolden, the_kappa_form_keeps_its_digits_where_the_textbook_form_loses_them) {
  // A body of length 99, seen at a third of it, with the projection centre ever farther away.
  int rows = 0;
  for (const Json& row : golden("extra").at("kappa_stability")) {
    if (row.at("type") != "float64") continue;
    ++rows;
    const WarpInput::Point body[] = {{-1, 0, 0, 1}, {1, 0, 0, 1}, {-1, 99, 0, 1}, {1, 99, 0, 1}};
    WarpChoice choice;
    choice.kappa = 1.0 / number(row.at("n"));
    const glm::dmat4 m = clip_from_light(plane_map(body, choice), {0.0, 1.0}, 0.0);
    const glm::dvec4 clip = m * glm::dvec4(0.0, 33.0, 0.0, 1.0);
    EXPECT_CLOSE(clip.y / clip.w, number(row.at("y_kform")), 1e-14);
  }
  EXPECT_EQ(rows, 6);
}

}  // namespace
}  // namespace gnomon::test
