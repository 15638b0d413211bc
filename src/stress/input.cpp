// Input of make_plan with its memory, and random scenes to strain.
#include "input.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace gnomon::stress {

glm::dvec3 across(const glm::dvec3& v, double angle_radians) {
  const glm::dvec3 other = std::abs(v.y) < 0.7 * glm::length(v) ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 a = glm::normalize(glm::cross(v, other)), b = glm::normalize(glm::cross(v, a));
  return a * std::cos(angle_radians) + b * std::sin(angle_radians);
}

Input plain_input(std::uint64_t seed) {
  Random random(seed);
  const bool plain = seed == 0;
  const double yaw = plain ? 0.3 : random.between(0.0, 2.0 * std::numbers::pi);
  const double pitch = plain ? -0.1 : random.between(-0.6, 0.3);
  const double sun = plain ? 0.9 : random.between(0.0, 2.0 * std::numbers::pi);
  const double height = plain ? 0.8 : random.between(0.35, 1.4);
  Input input;
  const glm::dvec3 forward{std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                           -std::cos(yaw) * std::cos(pitch)};
  constexpr double kRightAngle = std::numbers::pi / 2.0;
  input.camera = perspective_camera({0, 2, 0}, forward, {0, 1, 0}, kRightAngle * 2.0 / 3.0, 16.0 / 9.0, 0.1,
                                    1000.0, 1920, 1080);
  input.light = DirectionalLight{
      {std::cos(sun) * std::cos(height), -std::sin(height), std::sin(sun) * std::cos(height)}};
  const Box world{{-1000, -1, -1000}, {1000, 25, 1000}};
  input.receivers = {world};
  input.casters = {world};
  for (int i = 0; i < 6; ++i) {
    const glm::dvec3 foot{40.0 * i - 100.0, 0.0, 35.0 * ((i * 5) % 6) - 90.0};
    input.casters.push_back({foot, foot + glm::dvec3(6, 30 + 5 * i, 6)});
  }
  input.options.cascades = 1;
  // Errors are told in texels: of the size that was asked for.
  input.options.prune = input.options.prune.without(PruneRule::metric_resolution);
  return input;
}

}  // namespace gnomon::stress
