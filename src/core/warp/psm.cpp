// Perspective shadow maps: the map is laid in the viewer's own post-perspective space.
// Based on: Stamminger and Drettakis, "Perspective Shadow Maps", 2002. Kept as published, but for the light
// behind the viewer, whose inverted order of depths never arises here: the map of the light plane is taken,
// and depth from the light.
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/vector.hpp"
#include "gnomon/extend/warp.hpp"

namespace gnomon::warps {
namespace {

WarpChoice choose(const WarpInput& input) noexcept {
  const double n = input.depth_begin, f = input.depth_end;
  if (input.orthographic || !(n > 0.0 && f > n)) return input.unwarped;
  const ViewInLight& v = input.view;
  // Clip coordinates of the viewer, and those of the direction to the light (0, 0, 1).
  const auto image_axis = [&](const glm::dvec3& axis, double low, double high) {
    return (axis * 2.0 - v.forward * (low + high)) / (high - low);
  };
  const LightLinear clip[3] = {
      light_linear(input.light, image_axis(v.right, v.image_left, v.image_right), 0.0),
      light_linear(input.light, image_axis(v.up, v.image_bottom, v.image_top), 0.0),
      light_linear(input.light, v.forward * ((f + n) / (f - n)), -2.0 * n * (f / (f - n)))};
  const LightLinear clip_w = light_linear(input.light, v.forward, 0.0);
  const glm::dvec3 light{clip[0].slope.z, clip[1].slope.z, clip[2].slope.z};
  const double light_w = clip_w.slope.z;
  // The light's own projection looks from light / light_w at the middle of the unit cube. Its w over the
  // scene is (clip - light / light_w clip_w) . (-light / light_w), here times light_w^2: no division, and
  // right at light_w = 0, where the light stays directional.
  LightLinear w{clip_w.slope * glm::dot(light, light), clip_w.constant * glm::dot(light, light)};
  for (int i = 0; i < 3; ++i) {
    w.slope -= clip[i].slope * (light_w * light[i]);
    w.constant -= clip[i].constant * (light_w * light[i]);
  }
  const double steepness = std::sqrt(w.slope.x * w.slope.x + w.slope.y * w.slope.y);
  if (!(steepness > 0.0)) return input.unwarped;
  // Behind the viewer the light becomes a sink and w changes its sign as a whole.
  for (const double sign : {1.0, -1.0}) {
    const glm::dvec2 axis{sign * w.slope.x / steepness, sign * w.slope.y / steepness};
    double u_min = input.body.front().x * axis.x + input.body.front().y * axis.y, u_max = u_min;
    for (const WarpInput::Point& p : input.body) {
      const double u = p.x * axis.x + p.y * axis.y;
      u_min = min_of(u_min, u);
      u_max = max_of(u_max, u);
    }
    const double w_near = sign * w.constant + steepness * u_min;
    if (!(w_near > 0.0)) continue;
    // Where w does not change over the body, rounding decides the axis.
    constexpr double kLeastChange = 1e-6;
    if (!(steepness * (u_max - u_min) > kLeastChange * w_near)) break;
    WarpChoice choice;
    choice.kappa = steepness / w_near;
    choice.axis = axis;
    choice.centre = input.centre * axis.y;
    return choice;
  }
  return input.unwarped;
}

}  // namespace

const Warp psm{"psm", "perspective shadow map, as published in 2002, for comparison", choose, false};

}  // namespace gnomon::warps
