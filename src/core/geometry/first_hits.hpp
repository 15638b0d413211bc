// Where do surfaces lie that the camera sees, as far as boxes tell?
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"

namespace gnomon {

/// Points that stand for what a camera sees, relative to it: each for an equal share of the image.
struct SeenPoints {
  static constexpr std::size_t kMost = 128;
  std::array<glm::dvec3, kMost> point;
  std::size_t count = 0;
  [[nodiscard]] std::span<const glm::dvec3> points() const noexcept { return {point.data(), count}; }
};

/// A point of the first box on each ray of a fixed fan, anywhere between both of its sides. Of a box that a
/// ray begins in, the point where it leaves it: nothing in front of that is known. Rays that meet no box
/// between the near and the far plane add nothing.
[[nodiscard]] SeenPoints first_hits(const Camera& camera, const CameraAxes& axes,
                                    const Boxes& boxes) noexcept;

/// Evenly chosen ones of `points_world` that are in view.
[[nodiscard]] SeenPoints some_of(const Camera& camera, const CameraAxes& axes,
                                 std::span<const glm::dvec3> points_world) noexcept;

}  // namespace gnomon
