// Which way does light travel at a point?
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <variant>

#include "gnomon/light.hpp"

namespace gnomon {

/// Of a spot or point light, world space.
[[nodiscard]] inline const glm::dvec3& position_of(const Light& light) {
  const auto* spot = std::get_if<SpotLight>(&light);
  return spot != nullptr ? spot->position : std::get<PointLight>(light).position;
}

/// Unit; down where the light itself is.
[[nodiscard]] inline glm::dvec3 travel_at(const Light& light, const glm::dvec3& point) {
  const auto* sun = std::get_if<DirectionalLight>(&light);
  const glm::dvec3 way = sun != nullptr ? sun->direction : point - position_of(light);
  const double length = glm::length(way);
  return length > 0.0 ? way / length : glm::dvec3(0.0, -1.0, 0.0);
}

/// From a point to the light, world units; infinite to a sun.
[[nodiscard]] inline double distance_to(const Light& light, const glm::dvec3& point) {
  if (std::holds_alternative<DirectionalLight>(light)) return std::numeric_limits<double>::infinity();
  return glm::length(position_of(light) - point);
}

}  // namespace gnomon
