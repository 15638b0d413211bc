// The viewer: where it stands and what it sees. Perspective, off-axis and orthographic cameras in one plain
// value.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "gnomon/bounds.hpp"

namespace gnomon {

/// A viewing camera in a right-handed world. View depth is positive forward: z = dot(p - position, forward).
struct Camera {
  glm::dvec3 position{0.0};            ///< eye, world units
  glm::dvec3 forward{0.0, 0.0, -1.0};  ///< view direction, any non-zero length
  glm::dvec3 up{0.0, 1.0, 0.0};  ///< any vector not along forward; along forward, a fixed axis stands in
  bool orthographic = false;     ///< parallel projection instead of perspective
  /// Edges of the image: slopes (offset per unit of depth) for a perspective camera, world units for an
  /// orthographic one. An off-axis camera is one whose left != -right or bottom != -top.
  double left = -1.0, right = 1.0, bottom = -1.0, top = 1.0;
  double near_depth = 0.1;  ///< view depth where the frustum begins, > 0 for perspective
  /// View depth where it ends, > near_depth. Infinity sees without end: plans and measurements then take
  /// with_finite_far of the receivers.
  double far_depth = 100.0;
  int width = 1920, height = 1080;  ///< image size, pixels
};

/// The usual symmetric perspective camera. `fov_y_radians` is the full vertical angle, in (0, pi); other angles,
/// such as degrees, give edges that are no numbers, and make_plan refuses them by the name of this argument.
/// `aspect` is width over height.
[[nodiscard]] Camera perspective_camera(const glm::dvec3& position, const glm::dvec3& forward,
                                        const glm::dvec3& up, double fov_y_radians, double aspect,
                                        double near_depth, double far_depth, int width, int height) noexcept;

/// A parallel-projection camera that sees `height_world` world units from bottom to top.
[[nodiscard]] Camera orthographic_camera(const glm::dvec3& position, const glm::dvec3& forward,
                                         const glm::dvec3& up, double height_world, double aspect,
                                         double near_depth, double far_depth, int width, int height) noexcept;

/// The camera's orthonormal axes in world space: right x up = -forward. Well defined for every non-zero
/// forward, also where `up` is zero or along it.
struct CameraAxes {
  glm::dvec3 right, up, forward;  ///< unit vectors, world space
};
[[nodiscard]] CameraAxes camera_axes(const Camera& camera) noexcept;

/// The camera itself where its far plane is finite. Else one that sees as much of `boxes`: its far plane lies
/// at the depth of their farthest corner, rounded up to the next quarter octave of the near plane's depth
/// (orthographic: of the image's height, counted from the near plane). Between such steps it does not change
/// under a moving camera, and neither does the grid of Fit::stable; a far plane of one's own never moves it.
/// At least one step, where no box reaches beyond the near plane.
[[nodiscard]] Camera with_finite_far(const Camera& camera, const Boxes& boxes) noexcept;

/// OpenGL clip space (z in -1..1) from view space (x right, y up, z backward), and view from world. With an
/// infinite far plane depth tends to 1 for a perspective camera (Upchurch, Desbrun 2012: no loss of
/// precision) and is -1 everywhere for an orthographic one, which cannot distinguish infinite depths.
[[nodiscard]] glm::dmat4 clip_from_view(const Camera& camera) noexcept;
[[nodiscard]] glm::dmat4 view_from_world(const Camera& camera) noexcept;

}  // namespace gnomon
