// The way from a point to a light.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <variant>

#include "base/grazing.hpp"
#include "gnomon/light.hpp"

namespace gnomon::trace {

struct LightRay {
  glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit, towards the light
  double distance = std::numeric_limits<double>::infinity();
  bool lit = true;  ///< within the light's range and cone
};

[[nodiscard]] inline LightRay light_ray(const Light& light, const glm::dvec3& point) noexcept {
  if (const auto* sun = std::get_if<DirectionalLight>(&light)) return {-glm::normalize(sun->direction)};
  const auto* spot = std::get_if<SpotLight>(&light);
  const auto* point_light = std::get_if<PointLight>(&light);
  const glm::dvec3 to_light = (spot != nullptr ? spot->position : point_light->position) - point;
  LightRay ray;
  ray.distance = glm::length(to_light);
  ray.lit = ray.distance > 0.0 && ray.distance <= (spot != nullptr ? spot->range : point_light->range);
  if (ray.distance > 0.0) ray.direction = to_light / ray.distance;
  if (spot != nullptr)
    ray.lit =
        ray.lit && -glm::dot(ray.direction, glm::normalize(spot->direction)) >= std::cos(spot->outer_radians);
  return ray;
}

}  // namespace gnomon::trace
