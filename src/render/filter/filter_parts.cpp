// Sample patterns, and the size of penumbras.
#include "filter/filter_parts.hpp"

#include <array>
#include <numbers>

namespace gnomon::render {
namespace {

using vec2 = glm::dvec2;
// The shader's own points.
constexpr std::array<vec2, 64> kPoissonPoints{
#include "../../../shaders/library/poisson_64.glsl"
};

}  // namespace

glm::dvec2 vogel_point(int i, int count, double angle) noexcept {
  constexpr double kGoldenAngle = 2.3999632;
  const double a = i * kGoldenAngle + angle;
  return std::sqrt((i + 0.5) / count) * glm::dvec2(std::cos(a), std::sin(a));
}

glm::dvec2 poisson_point(int i, double angle) noexcept {
  const glm::dvec2 p = kPoissonPoints[static_cast<std::size_t>(i) % kPoissonPoints.size()];
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

double penumbra_radius(double angle_deg, double light_radius, double away, double light_distance) noexcept {
  if (light_distance == 0.0) return std::tan(0.5 * angle_deg * std::numbers::pi / 180.0) * away;
  return light_radius * away / std::max(light_distance - away, 0.01 * light_distance);
}

}  // namespace gnomon::render
