// Where do surfaces lie that the camera sees, as far as boxes tell?
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/extend/body.hpp"

namespace gnomon {

/// Points that stand for what a camera sees, relative to it: each for an equal share of the image.
struct SeenPoints {
  static constexpr std::size_t kMost = 128;
  static constexpr std::size_t kFewest = 6;  // fewer are no picture: all may be seen
  std::array<glm::dvec3, kMost> point;
  std::size_t count = 0;
  [[nodiscard]] std::span<const glm::dvec3> points() const noexcept { return {point.data(), count}; }
};

/// A point on each ray of a fixed fan that meets a box between the near and the far plane: anywhere between
/// both sides of one of the first six boxes. The same ones in any order of the boxes.
[[nodiscard]] SeenPoints first_hits(const Camera& camera, const CameraAxes& axes,
                                    const Boxes& boxes) noexcept;

/// Copies those of `points`, no more than fit, which are inside `body` or off it by no more than this share
/// of their coordinates. Returns how many.
std::size_t points_inside(const Polytope& body, std::span<const glm::dvec3> points, double touching,
                          std::array<glm::dvec3, SeenPoints::kMost>& inside) noexcept;

/// Evenly chosen ones of `points_world` that are in view.
[[nodiscard]] SeenPoints some_of(const Camera& camera, const CameraAxes& axes,
                                 std::span<const glm::dvec3> points_world) noexcept;

}  // namespace gnomon
