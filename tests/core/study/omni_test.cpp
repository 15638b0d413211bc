// Do the maps of all directions cover the sphere, undo themselves, and have the texels that they claim?
#include "gnomon/study/omni.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "support/near.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr std::array kMappings = {OmniMapping::cube, OmniMapping::dual_paraboloid, OmniMapping::tetrahedron};
// Rounding of a few products and a root.
constexpr double kRounding = 1e-13;
// Central differences of step h lose about h^2 to curvature and 1e-16 / h to rounding.
constexpr double kStep = 1e-6, kDifference = 1e-8;

Camera room_camera() {
  return perspective_camera({0, 2, 9}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 40, 640, 480);
}

TEST(Omni, a_zero_direction_and_a_point_on_the_light_give_finite_or_infinite_numbers) {
  for (const OmniMapping mapping : kMappings) {
    const OmniPoint at = omni_from_direction(mapping, glm::dvec3(0.0));
    EXPECT_TRUE(std::isfinite(at.uv.x) && std::isfinite(at.uv.y));
    const PointAliasing a = omni_aliasing(mapping, 1e6, {1, 2, 3}, room_camera(), {1, 2, 3});
    EXPECT_EQ(a.status, PointAliasing::Status::outside);
    EXPECT_TRUE(std::isinf(a.m_max));
  }
}

TEST(Omni, tiny_and_huge_offsets_land_where_their_direction_does) {
  for (const OmniMapping mapping : kMappings) {
    const glm::dvec3 d{0.3, -0.7, 0.2};
    const OmniPoint at = omni_from_direction(mapping, d);
    for (const double scale : {1e-200, 1e200}) {
      const OmniPoint same = omni_from_direction(mapping, d * scale);
      EXPECT_EQ(same.map, at.map);
      EXPECT_NEAR(same.uv.x, at.uv.x, kRounding);
      EXPECT_NEAR(same.uv.y, at.uv.y, kRounding);
    }
  }
}

TEST(Omni, nothing_in_view_within_range_compares_as_zeros) {
  const std::vector<Box> far_away = {{{500, 0, 0}, {501, 1, 1}}};
  const OmniComparison none = compare_omni({{0, 2, 0}, 5.0}, room_camera(), {far_away, far_away}, 1e6);
  EXPECT_EQ(none.cube.samples, 0u);
  EXPECT_EQ(none.tetrahedron.p95, 0.0);
  EXPECT_EQ(none.dual_paraboloid.storage, 0.0);
}

TEST(Omni, the_centre_of_each_map_looks_along_its_axis) {
  EXPECT_EQ(direction_from_omni(OmniMapping::cube, {0, {0, 0}}), glm::dvec3(1, 0, 0));
  EXPECT_EQ(direction_from_omni(OmniMapping::cube, {3, {0, 0}}), glm::dvec3(0, -1, 0));
  EXPECT_EQ(direction_from_omni(OmniMapping::dual_paraboloid, {0, {0, 0}}), glm::dvec3(0, 0, 1));
  EXPECT_EQ(direction_from_omni(OmniMapping::dual_paraboloid, {1, {0, 0}}), glm::dvec3(0, 0, -1));
}

TEST(Omni, a_paraboloid_has_the_equator_on_its_edge_and_sixty_degrees_at_the_tangent_of_thirty) {
  const OmniPoint rim = omni_from_direction(OmniMapping::dual_paraboloid, {0.6, 0.8, 0.0});
  EXPECT_NEAR(rim.uv.x, 0.6, kRounding);
  EXPECT_NEAR(rim.uv.y, 0.8, kRounding);
  const OmniPoint at = omni_from_direction(OmniMapping::dual_paraboloid, {std::sqrt(3.0), 0.0, 1.0});
  EXPECT_NEAR(at.uv.x, std::tan(30.0 * 3.14159265358979324 / 180.0), kRounding);
}

TEST(Omni, a_triangle_of_the_tetrahedron_ends_at_the_corners_of_its_rectangle) {
  // A tetrahedron's corners are the opposites of its faces' centres.
  const glm::dvec3 corner[4] = {{-1, -1, -1}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}};
  for (int face = 0; face < 4; ++face) {
    const glm::dmat4 m = tetrahedron_clip_from_light(face, 0.1, 10.0);
    int tops = 0, left = 0, right = 0;
    for (int k = 0; k < 4; ++k) {
      if (k == face) continue;
      const glm::dvec4 clip = m * glm::dvec4(corner[k], 1.0);
      ASSERT_GT(clip.w, 0.0);
      const double x = clip.x / clip.w, y = clip.y / clip.w;
      if (std::abs(x) < kRounding && std::abs(y - 1.0) < kRounding) ++tops;
      if (std::abs(x - 1.0) < kRounding && std::abs(y + 1.0) < kRounding) ++right;
      if (std::abs(x + 1.0) < kRounding && std::abs(y + 1.0) < kRounding) ++left;
    }
    EXPECT_EQ(tops + left + right, 3);
    EXPECT_EQ(tops * left * right, 1);
  }
}

TEST(Omni, the_maps_have_the_requested_texels) {
  const glm::dvec2 cube = omni_size(OmniMapping::cube, 6e6);
  EXPECT_NEAR(cube.x, 1000.0, 1e-9);
  EXPECT_EQ(cube.x, cube.y);
  const glm::dvec2 disc = omni_size(OmniMapping::dual_paraboloid, 2e6);
  EXPECT_NEAR(disc.x, 1000.0, 1e-9);
  const glm::dvec2 triangle = omni_size(OmniMapping::tetrahedron, 4e6);
  EXPECT_NEAR(0.5 * triangle.x * triangle.y, 1e6, 1e-6);
  EXPECT_NEAR(triangle.x / triangle.y, 2.0 / std::sqrt(3.0), 1e-12);  // an equilateral triangle's
}

TEST(Omni, a_texel_in_a_cube_face_is_as_long_in_pixels_as_one_can_do_by_hand) {
  // Light at the eye: everything is seen as the light sees it, and a texel is as wide as pixels per texel
  // say.
  Camera camera =
      perspective_camera({1, 2, 3}, {0, 0, -1}, {0, 1, 0}, 2.0 * std::atan(1.0), 1.0, 0.1, 100, 1000, 1000);
  const PointAliasing a =
      omni_aliasing(OmniMapping::cube, 6.0 * 500 * 500, camera.position, camera, {1, 2, -7});
  EXPECT_NEAR(a.m_max, 2.0, 1e-12);
  EXPECT_NEAR(a.m_min, 2.0, 1e-12);
  // In its middle a paraboloid spreads a slope of 2 over a width of 1, so as many texels stand for half.
  const PointAliasing b =
      omni_aliasing(OmniMapping::dual_paraboloid, 2.0 * 500 * 500, camera.position, camera, {1, 2, -7});
  EXPECT_NEAR(b.m_max, 4.0, 1e-12);
}

TEST(OmniProperty, every_direction_lands_inside_its_map_and_comes_back) {
  Random random(1);
  std::array<std::array<int, 6>, 3> hits{};
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 d = random.direction();
    for (std::size_t m = 0; m < kMappings.size(); ++m) {
      const OmniPoint at = omni_from_direction(kMappings[m], d);
      ASSERT_GE(at.map, 0);
      ASSERT_LT(at.map, omni_map_count(kMappings[m]));
      ++hits[m][static_cast<std::size_t>(at.map)];
      ASSERT_LE(std::abs(at.uv.x), 1.0 + kRounding);
      ASSERT_LE(std::abs(at.uv.y), 1.0 + kRounding);
      if (kMappings[m] == OmniMapping::dual_paraboloid) {
        ASSERT_LE(glm::length(at.uv), 1.0 + kRounding);
      }
      if (kMappings[m] == OmniMapping::tetrahedron) {  // inside the triangle (-1,-1) (1,-1) (0,1)
        ASSERT_LE(2.0 * std::abs(at.uv.x) + at.uv.y, 1.0 + 4.0 * kRounding);
      }
      ASSERT_LE(glm::length(direction_from_omni(kMappings[m], at) - d), kRounding) << to_string(kMappings[m]);
    }
  }
  // Faces of a regular solid are equally large.
  for (std::size_t m = 0; m < kMappings.size(); ++m) {
    const int count = omni_map_count(kMappings[m]);
    for (int k = 0; k < count; ++k)
      EXPECT_NEAR(hits[m][static_cast<std::size_t>(k)], 20000.0 / count, 600.0) << to_string(kMappings[m]);
  }
}

TEST(OmniProperty, the_jacobian_is_that_of_finite_differences_and_nothing_changes_along_the_ray) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 d = random.direction() * std::pow(10.0, random.between(-3, 3));
    const double h = kStep * glm::length(d);
    for (const OmniMapping mapping : kMappings) {
      const int map = omni_from_direction(mapping, d).map;
      const OmniJacobian j = omni_jacobian(mapping, map, d);
      EXPECT_NEAR(glm::dot(j.u, d), 0.0, 1e-12);
      EXPECT_NEAR(glm::dot(j.v, d), 0.0, 1e-12);
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 a = d, b = d;
        a[axis] -= h;
        b[axis] += h;
        const OmniPoint from = omni_from_direction(mapping, a), to = omni_from_direction(mapping, b);
        if (from.map != map || to.map != map) continue;
        const glm::dvec2 change = (to.uv - from.uv) / (2.0 * kStep);
        ASSERT_NEAR(j.u[axis] * glm::length(d), change.x, kDifference * 10.0) << to_string(mapping);
        ASSERT_NEAR(j.v[axis] * glm::length(d), change.y, kDifference * 10.0) << to_string(mapping);
      }
    }
  }
}

TEST(OmniProperty, a_tetrahedron_matrix_lands_where_the_mapping_does_and_is_measured_alike) {
  const Camera camera = room_camera();
  const glm::dvec3 light{1, 4, 2};
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 offset = random.direction() * random.between(0.5, 8.0);
    const OmniPoint at = omni_from_direction(OmniMapping::tetrahedron, offset);
    const glm::dmat4 m = tetrahedron_clip_from_light(at.map, 0.01, 20.0);
    const glm::dvec4 clip = m * glm::dvec4(offset, 1.0);
    ASSERT_GT(clip.w, 0.0);
    ASSERT_NEAR(clip.x / clip.w, at.uv.x, 1e-12);
    ASSERT_NEAR(clip.y / clip.w, at.uv.y, 1e-12);
    ASSERT_LE(std::abs(clip.z), clip.w);
    ShadowMap map;
    map.clip_from_world = m;
    map.clip_from_world[3] = m * glm::dvec4(-light, 1.0);
    map.light_world = glm::dvec4(light, 1.0);
    map.width = map.height = 1024;
    const glm::dvec2 size = omni_size(OmniMapping::tetrahedron, 1e6);
    map.width = 1000;
    map.height = 1000;
    const PointAliasing whole = measure_perspective(map, camera, light + offset);
    const PointAliasing a = omni_aliasing(OmniMapping::tetrahedron, 1e6, light, camera, light + offset);
    // Along each axis the error is as the texels along it.
    ASSERT_NEAR(a.m_s * size.x / 1000.0, whole.m_s, 1e-9 * whole.m_s);
    ASSERT_NEAR(a.m_t * size.y / 1000.0, whole.m_t, 1e-9 * whole.m_t);
  }
}

TEST(OmniProperty, doubling_the_texels_along_each_side_halves_every_error) {
  const std::vector<Box> room = {{{-10, 0, -10}, {10, 5, 10}}};
  const MeasureGrid grid{24, 24, 24};
  const OmniComparison a = compare_omni({{1, 3, -2}, 30.0}, room_camera(), {room, room}, 1e6, grid);
  const OmniComparison b = compare_omni({{1, 3, -2}, 30.0}, room_camera(), {room, room}, 4e6, grid);
  for (const auto stats :
       {&OmniComparison::cube, &OmniComparison::dual_paraboloid, &OmniComparison::tetrahedron}) {
    EXPECT_GT((a.*stats).samples, 1000u);
    EXPECT_CLOSE((a.*stats).max, 2.0 * (b.*stats).max, 1e-9);
    EXPECT_CLOSE((a.*stats).p95, 2.0 * (b.*stats).p95, 0.02);  // a bin is 1.6 % wide
    EXPECT_CLOSE((a.*stats).storage, (b.*stats).storage, 1e-9);
    EXPECT_LE((a.*stats).p50, (a.*stats).p95);
    EXPECT_LE((a.*stats).p95, (a.*stats).max);
  }
}

}  // namespace
}  // namespace gnomon::test
