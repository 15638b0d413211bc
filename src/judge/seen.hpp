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

[[nodiscard]] SeenSurfaces seen_surfaces(const CapturedFrame& frame, const CapturedScene& scene);
/// Those of these points that are in the image.
[[nodiscard]] SeenSurfaces seen_surfaces(const Camera& camera, const std::vector<glm::dvec3>& points,
                                         const std::vector<glm::dvec3>& normals);

}  // namespace gnomon::judge
