// Which surfaces does the camera see? What a capture knows of them, or the first hits of rays on boxes.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "judge/capture.hpp"

namespace gnomon::judge {

/// Points of visible surfaces that face the light, or may. The lists are equally long, but for `normals`.
struct SeenSurfaces {
  std::vector<glm::dvec3> points, normals;  ///< world; normals: unit, towards the eye, or none
  std::vector<double> depths;               ///< view depths, world units
  std::vector<glm::dvec2> pixels;           ///< from the image's upper left corner
  bool guessed = false;                     ///< they lie on boxes
};

/// Rays across the image where boxes stand for surfaces.
inline constexpr int kRayColumns = 96, kRayRows = 54;

/// A ray of the camera, as long as one unit of depth.
struct EyeRay {
  glm::dvec3 origin, way;
};
/// At shares of the image's width and height from its upper left corner.
[[nodiscard]] inline EyeRay eye_ray(const Camera& camera, const CameraAxes& axes, double across,
                                    double down) noexcept {
  const glm::dvec3 aside = axes.right * (camera.left + (camera.right - camera.left) * across) +
                           axes.up * (camera.top + (camera.bottom - camera.top) * down);
  if (camera.orthographic) return {camera.position + aside, axes.forward};
  return {camera.position, axes.forward + aside};
}

/// Calls `use(pixel, origin, way)` for each of those rays.
template <typename Use>
void for_each_ray(const Camera& camera, Use&& use) {
  const CameraAxes axes = camera_axes(camera);
  for (int row = 0; row < kRayRows; ++row) {
    for (int column = 0; column < kRayColumns; ++column) {
      const double across = (column + 0.5) / kRayColumns, down = (row + 0.5) / kRayRows;
      const EyeRay ray = eye_ray(camera, axes, across, down);
      use(glm::dvec2(across * camera.width, down * camera.height), ray.origin, ray.way);
    }
  }
}

/// Where a ray enters a box and leaves it, lengths of the ray, and the sides there; enter > leave: nowhere.
struct BoxCrossing {
  double enter, leave;
  glm::dvec3 enter_normal{0.0}, leave_normal{0.0};
};
[[nodiscard]] BoxCrossing crossing_of(const Box& box, const glm::dvec3& origin,
                                      const glm::dvec3& ray) noexcept;

[[nodiscard]] SeenSurfaces seen_surfaces(const CapturedFrame& frame, const CapturedScene& scene);
/// Those of these points that are in the image.
[[nodiscard]] SeenSurfaces seen_surfaces(const Camera& camera, const std::vector<glm::dvec3>& points,
                                         const std::vector<glm::dvec3>& normals);

}  // namespace gnomon::judge
