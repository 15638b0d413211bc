// The space in which a light's rays are parallel: one description for directional, spot and point lights.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gnomon {

/// Orthonormal, right-handed axes in world space. z points against the light: against the direction of
/// travel of parallel light, against the axis of a local light's map.
struct LightFrame {
  glm::dvec3 x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0}, z{0.0, 0.0, 1.0};  ///< unit, world space
  /// A world-space direction, or a point relative to the camera, along the frame's axes.
  [[nodiscard]] glm::dvec3 turned(const glm::dvec3& v) const noexcept {
    return {v.x * x.x + v.y * x.y + v.z * x.z, v.x * y.x + v.y * y.y + v.z * y.z,
            v.x * z.x + v.y * z.y + v.z * z.z};
  }
};

/// Maps points to the light plane (x, y) and a height h that grows towards the light. Straight lines stay
/// straight, and points on one light ray share (x, y).
///   parallel:    (x, y, h) are the frame's coordinates, world units.
///   perspective: x and y are slopes (offset from the light's axis per unit of distance along it), h is
///                1 / distance. Defined in front of the light only.
/// All points are relative to the camera and along the frame's axes (LightFrame::turned).
/// Based on: Wimmer, Scherzer, "Robust Shadow Mapping with Light-Space Perspective Shadow Maps", ShaderX4,
/// 2006. Warps work on parallel light, and in post-perspective light space every light is parallel.
struct LightSpace {
  LightFrame frame;          ///< axes of all points
  bool perspective = false;  ///< true for spot and point lights
  glm::dvec3 apex{0.0};      ///< perspective: the light's position

  /// Distance along the light's axis; 1 for parallel light.
  [[nodiscard]] double distance(const glm::dvec3& p) const noexcept {
    return perspective ? apex.z - p.z : 1.0;
  }
  /// Light-plane coordinates and height (x, y, h) of a point.
  [[nodiscard]] glm::dvec3 project(const glm::dvec3& p) const noexcept {
    if (!perspective) return p;
    const double h = 1.0 / (apex.z - p.z);
    return {(p.x - apex.x) * h, (p.y - apex.y) * h, h};
  }
  /// Not normalized way of the light at `p`.
  [[nodiscard]] glm::dvec3 ray(const glm::dvec3& p) const noexcept {
    return perspective ? p - apex : glm::dvec3(0.0, 0.0, -1.0);
  }
  /// The move across the light plane that a small move `v` of the point makes.
  [[nodiscard]] glm::dvec2 jacobian(const glm::dvec3& p, const glm::dvec3& v) const noexcept {
    if (!perspective) return {v.x, v.y};
    const double h = 1.0 / (apex.z - p.z);
    return {(v.x + (p.x - apex.x) * h * v.z) * h, (v.y + (p.y - apex.y) * h * v.z) * h};
  }
  /// The light in homogeneous coordinates: its position, or the direction towards it with w = 0.
  [[nodiscard]] glm::dvec4 light() const noexcept {
    return perspective ? glm::dvec4(apex, 1.0) : glm::dvec4(0.0, 0.0, 1.0, 0.0);
  }
  /// Homogeneous light space (x, y, h, 1 times the distance) from points relative to the camera along the
  /// world's axes, and back.
  [[nodiscard]] glm::dmat4 light_from_relative() const noexcept;
  /// The inverse of light_from_relative().
  [[nodiscard]] glm::dmat4 relative_from_light() const noexcept;
};

}  // namespace gnomon
