// The rays of the references: from the eye to a surface, and from a surface to the light.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <variant>

#include "gnomon/camera.hpp"
#include "gnomon/trace/reference.hpp"
#include "light_ray.hpp"

namespace gnomon::trace {

/// The surface that a ray from the eye shows; sky where there is none.
[[nodiscard]] inline SurfacePoint met_by(const Tracer& tracer, const Ray& ray, const Light& light) noexcept {
  SurfacePoint point;
  const Hit hit = tracer.first_seen(ray);
  if (hit.triangle == kNoTriangle) return point;
  point.triangle = hit.triangle;
  point.receives = tracer.receives(hit.triangle);
  point.position = ray.origin + ray.direction * hit.t;
  point.normal = glm::dot(hit.normal, ray.direction) > 0.0 ? -hit.normal : hit.normal;
  const LightRay to_light = light_ray(light, point.position);
  const double cosine = glm::dot(point.normal, to_light.direction);
  point.state = std::abs(cosine) < kGrazingCosine ? PixelState::undecided
                : cosine < 0.0                    ? PixelState::turned_away
                : to_light.lit                    ? PixelState::facing
                                                  : PixelState::unlit;
  return point;
}

/// The ray from the receiver's plane to the light, along the line through `from`. It starts where that line
/// leaves the plane, so that the rounding of the picture's position does not matter, and beyond what
/// the engine may see too early of triangles in the same plane.
[[nodiscard]] inline Ray ray_off_plane(const SurfacePoint& point, const glm::dvec3& from,
                                       const glm::dvec3& direction, double distance, double error) noexcept {
  Ray ray;
  const double cosine = std::max(glm::dot(point.normal, direction), kGrazingCosine);
  const double height = point.above + glm::dot(point.normal, from - point.position);
  const double begin = (error - height) / cosine;
  ray.origin = from + begin * direction;
  ray.direction = direction;
  ray.end = distance - begin;
  ray.except = point.triangle;
  return ray;
}

/// How far the engine may err along a ray from the point to the light, world units.
[[nodiscard]] inline double error_of(const Tracer& tracer, const Light& light,
                                     const SurfacePoint& point) noexcept {
  const double of_scene = tracer.error_world();
  if (std::holds_alternative<DirectionalLight>(light)) return of_scene;
  // Whatever stops a ray lies within the scene, however far behind it the light is.
  return std::min(tracer.error_world(light_ray(light, point.position).distance), 2.0 * of_scene);
}

}  // namespace gnomon::trace
