// Do the biases for any map give what one can work out by hand, and what the golden numbers say?
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <set>

#include "gnomon/gnomon.hpp"
#include "gnomon/study/bias.hpp"
#include "support/golden.hpp"
#include "support/near.hpp"

namespace gnomon::test {
namespace {

constexpr double kRounding = 1e-12;
const BiasOptions kHalfTexel{0.0, 0.5, 0.5, 8.0};

/// A map of two units by two over 4 x 4 texels from above: texels of half a unit, one unit of height is one
/// of ndc.
Receiver overhead(const glm::dvec3& normal) {
  Receiver r;
  // x right, y away, depth down.
  r.clip_from_world = glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, -1, 0, 0),
                                 glm::dvec4(0, 0, 0, 1));
  r.texels.width = r.texels.height = 4;
  r.light_direction = {0, -1, 0};
  r.normal = glm::normalize(normal);
  return r;
}

TEST(ReceiverPlane, rises_by_its_slope_per_texel_and_not_at_all_where_it_faces_the_light) {
  const ReceiverPlane flat = receiver_plane(overhead({0, 1, 0}));
  EXPECT_TRUE(flat.valid);
  EXPECT_EQ(flat.gradient, glm::dvec2(0.0));
  // y = -x: falls away from the light by half a unit in each texel along x.
  const ReceiverPlane falling = receiver_plane(overhead({1, 1, 0}));
  EXPECT_NEAR(falling.gradient.x, 0.5, kRounding);
  EXPECT_NEAR(falling.gradient.y, 0.0, kRounding);
  // y = 2 z, and the map's y runs against z: falls by one unit in each texel along y.
  const ReceiverPlane steep = receiver_plane(overhead({0, 1, -2}));
  EXPECT_NEAR(steep.gradient.x, 0.0, kRounding);
  EXPECT_NEAR(steep.gradient.y, 1.0, kRounding);
}

TEST(ReceiverPlane, is_not_valid_edge_on_behind_the_map_and_in_a_singular_one) {
  EXPECT_FALSE(receiver_plane(overhead({1, 0, 0})).valid);
  EXPECT_EQ(receiver_plane(overhead({1, 0, 0})).gradient, glm::dvec2(0.0));
  EXPECT_TRUE(receiver_plane(overhead({1, 1e-9, 0})).valid);
  Receiver behind = overhead({0, 1, 0});
  behind.clip_from_world[3][3] = -1.0;
  EXPECT_FALSE(receiver_plane(behind).valid);
  EXPECT_EQ(plane_bias_ndc(kHalfTexel, behind, 1.0), 0.0);
  EXPECT_EQ(plane_bias_world(kHalfTexel, behind, 1.0), 0.0);
  EXPECT_EQ(adaptive_bias_ndc(behind, 1.0), 0.0);
  EXPECT_EQ(normal_offset_world(kHalfTexel, behind, 1.0), glm::dvec3(0.0));
  EXPECT_TRUE(std::isinf(depth_rounding_world(DepthFormat::unorm24, kOpenGl, behind)));
  Receiver singular = overhead({0, 1, 0});
  singular.clip_from_world[0] = glm::dvec4(0.0);
  EXPECT_FALSE(receiver_plane(singular).valid);
}

TEST(ReceiverPlane, equals_the_plane_taken_through_the_inverse_matrix) {
  // A map with perspective in every row.
  Receiver r = overhead({0.3, 1, -0.4});
  r.clip_from_world[0] = {1.0, 0.1, 0.2, 0.05};
  r.clip_from_world[1] = {0.3, -0.2, -1.0, 0.02};
  r.clip_from_world[2] = {-0.1, -1.2, 0.1, -0.03};
  r.clip_from_world[3] = {0.2, 0.1, 0.3, 1.5};
  r.point = {0.2, 0.4, -0.3};
  r.texels.width = 64;
  r.texels.height = 32;
  const glm::dvec4 pi =
      glm::inverse(glm::transpose(r.clip_from_world)) * glm::dvec4(r.normal, -glm::dot(r.normal, r.point));
  const ReceiverPlane plane = receiver_plane(r);
  EXPECT_CLOSE(plane.gradient.x, -pi.x / pi.z * 2.0 / 64.0, kRounding);
  EXPECT_CLOSE(plane.gradient.y, -pi.y / pi.z * 2.0 / 32.0, kRounding);
}

TEST(ReceiverPlane, from_derivatives_matches_the_golden_rows) {
  for (const Json& row : golden("extra").at("receiver_plane")) {
    const auto& dx = row.at("duv_dx");
    const auto& dy = row.at("duv_dy");
    const ReceiverPlane plane =
        receiver_plane_from_derivatives({number(dx.at(0)), number(dx.at(1)), number(row.at("dz_dx"))},
                                        {number(dy.at(0)), number(dy.at(1)), number(row.at("dz_dy"))});
    EXPECT_TRUE(plane.valid);
    EXPECT_CLOSE(plane.gradient.x, number(row.at("dz_du")), 1e-11);
    EXPECT_CLOSE(plane.gradient.y, number(row.at("dz_dv")), 1e-11);
  }
}

TEST(ReceiverPlane, from_derivatives_falls_back_on_a_silhouette_at_any_scale) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    const glm::dvec3 dx = glm::dvec3(1, 2, 5) * scale;
    EXPECT_FALSE(receiver_plane_from_derivatives(dx, 2.0 * dx).valid) << scale;
    EXPECT_TRUE(receiver_plane_from_derivatives(dx, glm::dvec3(2, 4.001, 0) * scale).valid) << scale;
  }
  EXPECT_FALSE(receiver_plane_from_derivatives({0, 0, 1}, {0, 0, 1}).valid);
}

TEST(PlaneBias, is_half_a_texel_of_slope_and_as_much_again_for_each_texel_of_radius) {
  const Receiver r = overhead({1, 1, 0});
  EXPECT_NEAR(plane_bias_ndc(kHalfTexel, r, 0.0), -0.25,
              kRounding);  // half of half a unit, towards the light
  EXPECT_NEAR(plane_bias_world(kHalfTexel, r, 0.0), 0.25, kRounding);
  EXPECT_NEAR(plane_bias_world(kHalfTexel, r, 2.0), 1.25, kRounding);
  const Receiver both = overhead({1, 1, -2});
  EXPECT_NEAR(plane_bias_world(kHalfTexel, both, 0.0), 0.25 + 0.5, kRounding);
  EXPECT_NEAR(plane_bias_world({0.1, 0.5, 0.0, 8.0}, both, 0.0), 0.75 + 0.05, kRounding);
}

TEST(PlaneBias, is_towards_the_light_in_every_clip_space) {
  for (const bool reversed : {false, true}) {
    Receiver r = overhead({1, 1, 0});
    r.clip_from_world = clip_from_gl_clip({NdcDepth::zero_to_one, reversed, true}) * r.clip_from_world;
    EXPECT_NEAR(plane_bias_ndc(kHalfTexel, r, 0.0), reversed ? 0.125 : -0.125, kRounding);
    EXPECT_NEAR(plane_bias_world(kHalfTexel, r, 0.0), 0.25, kRounding);
  }
}

TEST(PlaneBias, is_capped_for_grazing_planes_and_for_those_that_face_away) {
  for (const glm::dvec3& normal : {glm::dvec3(1, 0.01, 0), glm::dvec3(1, 0, 0), glm::dvec3(1, -1, 0)}) {
    EXPECT_NEAR(plane_bias_world(kHalfTexel, overhead(normal), 0.0), 0.5 * 0.5 * 8.0, 1e-9);
  }
  const double away = plane_bias_world(kHalfTexel, overhead({0, -1, 0}), 0.0);
  EXPECT_GE(away, 0.5 * 0.5 * 8.0 * (1 - kRounding));
  EXPECT_LE(away, 0.5 * 0.5 * 8.0 * std::sqrt(2.0) * (1 + kRounding));
}

TEST(PlaneBias, a_plane_that_faces_the_light_needs_some_under_a_warp) {
  // w grows with the map's y: what is stored of a level plane is not level.
  Receiver r = overhead({0, 1, 0});
  r.clip_from_world[2][3] = -0.5;
  r.point = {0, 0.5, 0};
  EXPECT_GT(plane_bias_world(kHalfTexel, r, 0.0), 0.01);
  EXPECT_EQ(slope_bias_world({0.0, 0.5, 0.0, 8.0}, 0.5, 0.0, r.normal, r.light_direction), 0.0);
}

TEST(NormalOffset, matches_the_golden_rows_where_there_is_no_warp) {
  for (const Json& row : golden("extra").at("slope_bias")) {
    const double cosine = row.at("cos_l"), texel = row.at("texel");
    Receiver r = overhead({std::sqrt((1.0 - cosine) * (1.0 + cosine)), cosine, 0.0});
    r.texels.width = r.texels.height = static_cast<int>(std::lround(2.0 / texel));
    const BiasOptions uncapped{0.0, 0.5, 0.5, 1e9};
    const glm::dvec3 half = normal_offset_world(uncapped, r, 0.0),
                     whole = normal_offset_world(uncapped, r, 0.5);
    EXPECT_NEAR(glm::dot(half, r.normal), number(row.at("normal_offset_half")), 1e-12);
    EXPECT_NEAR(glm::dot(whole, r.normal), number(row.at("normal_offset_sin")), 1e-12);
    EXPECT_NEAR(glm::length(glm::cross(half, r.normal)), 0.0, kRounding);
    EXPECT_NEAR(plane_bias_world(uncapped, r, 0.0), number(row.at("half_texel_slope")), 1e-12);
  }
}

TEST(AdaptiveBias, takes_the_fragment_to_its_plane_over_the_texels_centre) {
  Receiver r = overhead({1, 1, 0});  // depth +0.5 per texel along x; centres at -0.75, -0.25, 0.25, 0.75
  r.point = {0.05, 0, 0.25};
  EXPECT_NEAR(adaptive_bias_ndc(r, 0.0), 0.2, kRounding);  // the centre is farther from the light
  r.point = {0.45, 0, 0.25};
  EXPECT_NEAR(adaptive_bias_ndc(r, 0.0), -0.2, kRounding);
  r.point = {0.25, 0, 0.25};
  EXPECT_NEAR(adaptive_bias_ndc(r, 0.0), 0.0, kRounding);
  EXPECT_NEAR(adaptive_bias_ndc(r, 0.125), -0.125, kRounding);
}

TEST(AdaptiveBias, is_exact_where_the_centre_lies_in_the_next_piece_of_the_map) {
  Receiver r = overhead({1, 1, 0});
  // Pieces of 4.25 texels: the end of the first is in texel 4, and those of the second are nine times as
  // long.
  r.texels = {34, 34, &shapes::rectilinear, {}};
  r.texels.parameters[0] = -0.1;
  const auto x_of = [&](double texel) { return r.texels.ndc_of({texel, 0.0}).x; };
  EXPECT_NEAR(x_of(5.25) - x_of(4.25), 9.0 * (x_of(4.25) - x_of(3.25)), kRounding);
  for (const double texel : {4.05, 4.2, 4.3, 4.95}) {
    r.point = {x_of(texel), 0.0, 0.1};
    // On the plane y = -x, a unit of ndc x is one of depth.
    EXPECT_NEAR(adaptive_bias_ndc(r, 0.0), x_of(4.5) - r.point.x, kRounding);
  }
}

TEST(AdaptiveBias, a_ray_along_the_plane_gets_no_more_than_the_steepest_plane) {
  Receiver r = overhead({1, 0, 0});
  r.point = {0.49, 0, 0.25};
  EXPECT_NEAR(adaptive_bias_ndc(r, 0.0), -0.24 * kSteepestPlane, 1e-9);
}

TEST(AdaptiveBias, epsilon_is_worth_what_hyperbolic_depth_makes_of_it) {
  // Golden: d(depth)/dz of a perspective depth in [0, 1] on the axis of a spot light's map.
  for (const Json& row : golden("extra").at("dou_eps")) {
    const double n = number(row.at("zn")), f = number(row.at("zf")), z = number(row.at("z"));
    Receiver r;
    r.clip_from_world =
        clip_from_view(perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.0, n, f, 1, 1));
    r.texels.width = r.texels.height = 3;  // a centre on the axis
    r.light_direction = {0, 0, -1};
    r.normal = {0, 0, 1};
    r.point = {0, 0, -z};
    const double epsilon = 1e-3 * n;
    EXPECT_NEAR(adaptive_bias_ndc(r, epsilon) / epsilon, -2.0 * number(row.at("ddz")), 1e-12);
    EXPECT_NEAR(ndc_depth_per_world_unit(r.clip_from_world, r.light_direction, r.point),
                -2.0 * number(row.at("from_d")), 1e-12);
  }
}

TEST(WarpBias, follows_the_golden_rows_along_the_warp) {
  const Json data = golden("extra").at("warp_bias");
  for (const Json& row : data.at("rows")) {
    Receiver r;
    r.clip_from_world = mat4(data.at("M"));
    r.texels.width = r.texels.height = 1024;
    r.light_direction = vec3(data.at("light"));
    r.normal = -r.light_direction;
    r.point = vec3(row.at("world"));
    // One texel of constant bias: its extent times the golden depth per world unit, besides the warp's own
    // slant.
    const double with = plane_bias_ndc({1.0, 0.5, 0.0, 8.0}, r, 0.0);
    const double without = plane_bias_ndc({0.0, 0.5, 0.0, 8.0}, r, 0.0);
    const glm::dvec2 texel = texel_extent_world(r.clip_from_world, r.texels, r.light_direction, r.point);
    EXPECT_CLOSE(std::abs(with - without), std::abs(number(row.at("predicted"))) * std::max(texel.x, texel.y),
                 1e-9);
  }
}

TEST(DepthRounding, is_half_a_step_of_the_format) {
  EXPECT_CLOSE(depth_rounding(DepthFormat::unorm16, 0.3), std::ldexp(1.0, -17), 2e-5);
  EXPECT_CLOSE(depth_rounding(DepthFormat::unorm24, 0.3), std::ldexp(1.0, -25), 1e-7);
  for (const float depth : {1.0f, 0.999f, 0.5f, 0.3f, 1e-4f, 1e-40f, 0.0f}) {
    const double step = static_cast<double>(std::nextafter(depth, 2.0f)) - static_cast<double>(depth);
    EXPECT_EQ(depth_rounding(DepthFormat::float32, static_cast<double>(depth)), 0.5 * step) << depth;
  }
}

TEST(DepthRounding, in_world_units_it_is_a_share_of_the_depth_range) {
  const Receiver r = overhead({0, 1, 0});  // two units from near to far
  EXPECT_CLOSE(depth_rounding_world(DepthFormat::unorm16, kOpenGl, r), 2.0 * 0.5 / 65535.0, kRounding);
  Receiver zero = r;
  zero.clip_from_world = clip_from_gl_clip(kVulkan) * r.clip_from_world;
  EXPECT_CLOSE(depth_rounding_world(DepthFormat::unorm16, kVulkan, zero), 2.0 * 0.5 / 65535.0, kRounding);
  EXPECT_CLOSE(depth_rounding_world(DepthFormat::float32, kVulkan, zero), 2.0 * std::ldexp(1.0, -25),
               kRounding);
}

TEST(BiasAdvice, there_is_one_row_with_a_reason_for_each_pair) {
  std::set<std::pair<int, int>> pairs;
  for (const BiasAdvice& a : bias_advice()) {
    EXPECT_TRUE(pairs.insert({static_cast<int>(a.bias), static_cast<int>(a.filter)}).second);
    EXPECT_GT(a.reason.size(), 20u);
    const BiasAdvice& found = bias_with_filter(a.bias, a.filter);
    EXPECT_EQ(&found, &a);
  }
  EXPECT_EQ(pairs.size(), 20u);
}

}  // namespace
}  // namespace gnomon::test
