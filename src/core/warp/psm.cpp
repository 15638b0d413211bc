// Perspective shadow maps: the map is laid in the viewer's own post-perspective space.
// Based on: Stamminger and Drettakis, "Perspective Shadow Maps", 2002. Kept as published, but for the light
// behind the viewer, whose inverted order of depths never arises here: the map of the light plane is taken,
// and depth from the light.
#include <cmath>
#include <glm/geometric.hpp>

#include "../vector.hpp"
#include "gnomon/warp.hpp"

namespace gnomon::warps {
namespace {

/// A linear function of a point in the light frame.
struct Linear {
  glm::dvec3 slope;
  double at_eye;
};

WarpChoice choose(const WarpInput& input) noexcept {
  const double n = input.depth_begin, f = input.depth_end;
  if (input.orthographic || !(n > 0.0 && f > n)) return {};
  const ViewInLight& v = input.view;
  // Clip coordinates of the viewer, and those of the direction to the light (0, 0, 1).
  const auto image_axis = [&](const glm::dvec3& axis, double low, double high) {
    return (axis * 2.0 - v.forward * (low + high)) / (high - low);
  };
  const Linear clip[3] = {{image_axis(v.right, v.image_left, v.image_right), 0.0},
                          {image_axis(v.up, v.image_bottom, v.image_top), 0.0},
                          {v.forward * ((f + n) / (f - n)), -2.0 * n * (f / (f - n))}};
  const glm::dvec3 light{clip[0].slope.z, clip[1].slope.z, clip[2].slope.z};
  const double light_w = v.forward.z;
  // The light's own projection looks from light / light_w at the middle of the unit cube. Its w over the
  // scene is (clip - light / light_w clip_w) . (-light / light_w), here times light_w^2: no division, and
  // right at light_w = 0, where the light stays directional.
  Linear w{v.forward * glm::dot(light, light), 0.0};
  for (int i = 0; i < 3; ++i) {
    w.slope -= clip[i].slope * (light_w * light[i]);
    w.at_eye -= clip[i].at_eye * (light_w * light[i]);
  }
  const double steepness = std::sqrt(w.slope.x * w.slope.x + w.slope.y * w.slope.y);
  if (!(steepness > 0.0)) return {};
  // Behind the viewer the light becomes a sink and w changes its sign as a whole.
  for (const double sign : {1.0, -1.0}) {
    const glm::dvec2 axis{sign * w.slope.x / steepness, sign * w.slope.y / steepness};
    double u_min = input.body.front().x * axis.x + input.body.front().y * axis.y, u_max = u_min;
    for (const WarpInput::Point& p : input.body) {
      const double u = p.x * axis.x + p.y * axis.y;
      u_min = min_of(u_min, u);
      u_max = max_of(u_max, u);
    }
    const double w_near = sign * w.at_eye + steepness * u_min;
    if (!(w_near > 0.0)) continue;
    // Where w does not change over the body, rounding decides the axis.
    constexpr double kLeastChange = 1e-6;
    return steepness * (u_max - u_min) > kLeastChange * w_near ? WarpChoice{steepness / w_near, axis}
                                                               : WarpChoice{};
  }
  return {};
}

}  // namespace

const Warp psm{"psm", "perspective shadow map, as published in 2002, for comparison", choose, false};

}  // namespace gnomon::warps
