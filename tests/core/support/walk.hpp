// A camera that walks over a wide floor with blocks on it: every frame has casters and receivers.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <vector>

#include "base/random.hpp"
#include "gnomon/gnomon.hpp"

namespace gnomon::test {

struct Walk {
  std::vector<Box> boxes;
  PlanOptions options;
  glm::dvec3 light, start, velocity;
  double turn, pitch;  // radians per frame, radians
  double unit = 1.0;   // what the lengths above are given in, world units
  [[nodiscard]] SceneBounds bounds() const { return {boxes, boxes}; }
  [[nodiscard]] Camera camera(int frame) const {
    const double heading = turn * frame;
    const glm::dvec3 forward{std::sin(heading) * std::cos(pitch), std::sin(pitch),
                             -std::cos(heading) * std::cos(pitch)};
    const glm::dvec3 sideways{std::cos(heading), 0.0, std::sin(heading)};
    const glm::dvec3 ahead{std::sin(heading), 0.0, -std::cos(heading)};
    const double t = frame;
    return perspective_camera(
        start + ahead * (velocity.z * t) + sideways * (velocity.x * t) + glm::dvec3(0.0, velocity.y * t, 0.0),
        forward, {0.0, 1.0, 0.0}, 1.0, 1.6, 0.5 * unit, 200.0 * unit, 640, 400);
  }
  /// The objective of a plan as measure() has it.
  [[nodiscard]] double error_of(const ShadowPlan& plan, const Camera& camera) const {
    const AliasingStats error = measure(plan, camera, bounds());
    const Objective objective = options.warp.objective;
    return objective == Objective::storage ? error.storage
           : objective == Objective::max   ? error.max
                                           : error.p95;
  }
};

inline std::vector<Box> floor_with_blocks(gnomon::Random& random) {
  std::vector<Box> boxes{{{-600.0, -1.0, -600.0}, {600.0, 0.0, 600.0}}};
  for (int i = 0; i < 40; ++i) {
    const double x = random.between(-80.0, 80.0), z = random.between(-80.0, 80.0);
    const double width = random.between(0.5, 6.0), height = random.between(0.5, 15.0);
    boxes.push_back({{x, 0.0, z}, {x + width, height, z + 3.0}});
  }
  return boxes;
}

/// Light and way of the camera. `between(low, high)` draws a number.
template <typename Between>
void draw_course(Walk& w, Between&& between) {
  const double light_x = between(-1.0, 1.0), light_y = -between(0.2, 1.0);
  w.light = {light_x, light_y, between(-1.0, 1.0)};
  const double x = between(-20.0, 20.0), eye = between(1.5, 6.0);
  w.start = {x, eye, between(-20.0, 20.0)};
  constexpr double kSpeed = 0.08;  // 5 m/s at 60 frames a second
  const double aside = between(-kSpeed, kSpeed), up = between(-0.2, 0.2) * kSpeed;
  w.velocity = {aside, up, between(-kSpeed, kSpeed)};
  w.turn = between(-0.01, 0.01);  // up to 34 degrees a second
  w.pitch = between(-0.4, 0.1);
}

}  // namespace gnomon::test
