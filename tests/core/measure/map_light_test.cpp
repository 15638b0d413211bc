// Is the light of a map's matrix found where the map does not name it?
#include "measure/map_light.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gnomon/gnomon.hpp"

namespace gnomon::test {
namespace {

ShadowPlan plan_of(const Light& light, const Warp& warp, const ClipSpace& space) {
  static const Box boxes[] = {{{-40, -1, -200}, {40, 0, 20}}, {{-4, 0, -30}, {4, 6, -26}}};
  const Camera camera =
      perspective_camera({0, 3, 10}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.2, 250.0, 960, 640);
  PlanOptions options;
  options.cascades = 2;
  options.warp.warp = &warp;
  options.clip_space = space;
  return make_plan(camera, light, {boxes, boxes}, options);
}

/// A matrix as engines have it: of products in single precision, each number off by a few roundings.
glm::dmat4 in_single(glm::dmat4 m) {
  constexpr double kRoundings = 4.0 * static_cast<double>(std::numeric_limits<float>::epsilon());
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] *= 1.0 + kRoundings * std::sin(7.0 * i);
  return m;
}

TEST(MapLight, is_that_of_the_matrix_where_the_map_names_another) {
  const Light lights[] = {DirectionalLight{{0.4, -1, 0.3}}, DirectionalLight{{0.9, -0.1, -0.2}},
                          SpotLight{{2, 9, -12}, {0.1, -1, -0.4}, 0.7, 60.0}, PointLight{{-3, 5, -14}, 80.0}};
  ClipSpace left = kDirect3D;
  left.handedness = Handedness::left;
  int found = 0;
  for (const Light& light : lights) {
    for (const Warp* const warp : {&warps::none, &warps::lispsm, &warps::optimal}) {
      for (const ClipSpace& space : {kOpenGl, kVulkan, kDirect3D, left}) {
        const ShadowPlan plan = plan_of(light, *warp, space);
        ASSERT_EQ(plan.status, PlanStatus::ok);
        for (const ShadowMap& map : plan.maps()) {
          EXPECT_EQ(light_of(map), map.light_world) << "what the map names is kept";
          for (const bool single : {false, true}) {
            for (const glm::dvec4& other : {glm::dvec4(0, 1, 0, 0), glm::dvec4(0.6, 0.8, 0, 0),
                                            glm::dvec4(5, 5, 5, 1), glm::dvec4(0.0)}) {
              ShadowMap foreign = map;
              foreign.light_world = other;
              if (single) foreign.clip_from_world = in_single(map.clip_from_world);
              const glm::dvec4 at = light_of(foreign);
              ASSERT_EQ(at.w, map.light_world.w) << warp->name;
              const double size = glm::length(glm::dvec3(map.light_world));
              EXPECT_LE(glm::length(at - map.light_world), (single ? 1e-4 : 1e-6) * size) << warp->name;
              ++found;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(found, 600);
}

TEST(MapLight, of_no_use_is_left_as_it_is) {
  ShadowMap map;
  map.light_world = {0.6, 0.8, 0, 0};
  const double kInf = std::numeric_limits<double>::infinity();
  for (const double value : {0.0, 1e200, kInf, std::nan("")}) {
    map.clip_from_world = glm::dmat4(0.0);
    map.clip_from_world[0][0] = map.clip_from_world[3][3] = value;
    EXPECT_EQ(light_of(map), map.light_world) << value;
  }
}

}  // namespace
}  // namespace gnomon::test
