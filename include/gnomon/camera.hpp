// The viewer: where it stands and what it sees. Perspective, off-axis and orthographic cameras in one plain
// value.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string_view>

#include "gnomon/bounds.hpp"
#include "gnomon/clip_space.hpp"

namespace gnomon {

struct View;

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

  /// The view of this camera with nothing known of what it sees (view.hpp).
  operator View() const noexcept;
};

/// The usual symmetric perspective camera. `fov_y_radians` is the full vertical angle, in (0, pi). Other
/// angles, such as degrees, give edges that are no numbers, and make_plan refuses them by the name of this
/// argument. `aspect` is width over height.
[[nodiscard]] Camera perspective_camera(const glm::dvec3& position, const glm::dvec3& forward,
                                        const glm::dvec3& up, double fov_y_radians, double aspect,
                                        double near_depth, double far_depth, int width, int height) noexcept;

/// A parallel-projection camera that sees `height_world` world units from bottom to top.
[[nodiscard]] Camera orthographic_camera(const glm::dvec3& position, const glm::dvec3& forward,
                                         const glm::dvec3& up, double height_world, double aspect,
                                         double near_depth, double far_depth, int width, int height) noexcept;

/// Why two matrices are those of no camera.
enum class CameraError : std::uint8_t {
  none,             ///< they are
  not_finite,       ///< an entry is not a number, infinite or beyond 1e30
  image_size,       ///< width or height below 1
  view_not_affine,  ///< the view's last row is not 0 0 0 1
  view_scaled,      ///< the view scales its axes unevenly, or by a factor beyond 1e12 or below its inverse
  view_sheared,     ///< the view's axes are not at right angles
  mirrored,         ///< y_down or handedness do not fit, or the camera sees a reflection
  projection_singular,  ///< width, height or w of the image are zero, or out of proportion by 1e12
  projection_sheared,   ///< x of the image depends on y, y on x, or either on the depth of a parallel
                        ///< projection
  projection_tilted,    ///< w depends on x or y: a perspective with two or three vanishing points
  projection_off_eye,   ///< the perspective's centre is not the view's origin
  near_plane_tilted,    ///< depth depends on x or y: an oblique near plane
  depth_range,          ///< no near plane before a far one: reversed_z or ndc_depth do not fit
};
/// One sentence for each, without a full stop.
[[nodiscard]] std::string_view to_string(CameraError error) noexcept;

/// The result of camera_from.
struct CameraFrom {
  Camera camera;                          ///< where error is none
  CameraError error = CameraError::none;  ///< why there is no camera
};

/// The camera of an engine's own matrices: perspective or parallel, centred or off-axis, far plane finite or
/// not. `clip_space` is that of `clip_from_view`, and says which z is near, where y points, and the world's
/// handedness. View space looks along either z, as the projection has it. Matrices act on column vectors;
/// engines with row vectors hand in their transposes. Entries may be rounded to single precision.
///
/// A far plane that depth only tends to (reversed_z with an infinite far plane, say) gives an infinite
/// Camera::far_depth. Plans then end at the receivers (with_finite_far). A view may scale the world evenly;
/// depths and sizes come back in world units. Edges of a left-handed world's camera come back as ClipSpace
/// counts them. Refuses what a Camera cannot be: CameraError. Pure; never throws.
[[nodiscard]] CameraFrom camera_from(const glm::dmat4& view_from_world, const glm::dmat4& clip_from_view,
                                     const ClipSpace& clip_space, int width, int height) noexcept;

/// The camera's orthonormal axes in world space: right x up = -forward. Well defined for every non-zero
/// forward, also where `up` is zero or along it.
struct CameraAxes {
  glm::dvec3 right, up, forward;  ///< unit vectors, world space
};
[[nodiscard]] CameraAxes camera_axes(const Camera& camera) noexcept;

/// The camera itself where its far plane is finite. Else one that sees as much of `boxes`, whatever it looks
/// at. Its far plane lies at the distance of the farthest corner of their bounds. That is rounded up to the
/// next half octave of the near plane's depth (orthographic: of the image's height, counted from the near
/// plane). A camera that turns does not change it, and one that walks does so at these steps alone. At least
/// one step, where no box reaches beyond the near plane.
[[nodiscard]] Camera with_finite_far(const Camera& camera, const Boxes& boxes) noexcept;

/// OpenGL clip space (z in -1..1) from view space (x right, y up, z backward), and view from world. With an
/// infinite far plane depth tends to 1 for a perspective camera (Upchurch, Desbrun 2012: no loss of
/// precision). It is -1 everywhere for an orthographic one, which cannot distinguish infinite depths.
[[nodiscard]] glm::dmat4 clip_from_view(const Camera& camera) noexcept;
[[nodiscard]] glm::dmat4 view_from_world(const Camera& camera) noexcept;

}  // namespace gnomon
