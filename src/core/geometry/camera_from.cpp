// Which camera has an engine's view and projection matrices? Every entry is accounted for: what a Camera
// cannot say is refused by name.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/matrix.hpp"
#include "geometry/usable.hpp"
#include "geometry/vector.hpp"
#include "gnomon/camera.hpp"

namespace gnomon {
namespace {

// What products of a few single-precision matrices round by, with a hundredfold reserve; a shear or a tilt of
// this size moves no point by a pixel.
constexpr double kRounding = 1e-4;
// Largest ratio of the numbers of one projection, such as far over near: as make_plan takes them.
constexpr double kLargestRatio = 1e12;

bool all_usable(const glm::dmat4& m) noexcept {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!usable(m[column][row])) return false;
    }
  }
  return true;
}

/// False for what rounds to zero next to `scale`.
bool counts(double value, double scale) noexcept {
  return std::abs(value) > kRounding * std::abs(scale);
}

/// The view: the eye, and the axes of view space in the world, unit.
struct Eye {
  CameraError error = CameraError::none;
  glm::dvec3 position{0.0}, x{0.0}, y{0.0}, z{0.0};
  double scale = 1.0;  // view units per world unit
};

Eye eye_of(const glm::dmat4& view_from_world) noexcept {
  Eye eye;
  const glm::dvec4 bottom = row_of(view_from_world, 3);
  const std::array<glm::dvec3, 3> axis{glm::dvec3(row_of(view_from_world, 0)),
                                       glm::dvec3(row_of(view_from_world, 1)),
                                       glm::dvec3(row_of(view_from_world, 2))};
  const auto refuse = [&](CameraError error) {
    eye.error = error;
    return eye;
  };
  // A bottom row other than 0 0 0 1 belongs to a projection. Engines that invert any matrix in one way have
  // exact zeros, and a 1 that is rounded.
  constexpr double kRounded = 1e-6;
  if (glm::dvec3(bottom) != glm::dvec3(0.0) || !(std::abs(bottom.w - 1.0) <= kRounded))
    return refuse(CameraError::view_not_affine);
  const std::array<double, 3> length{glm::length(axis[0]), glm::length(axis[1]), glm::length(axis[2])};
  const double scale = length[0];
  // Beyond it neither the scale's square nor its inverse means anything.
  if (!(scale >= 1.0 / kLargestRatio && scale <= kLargestRatio)) return refuse(CameraError::view_scaled);
  if (counts(length[1] - scale, scale) || counts(length[2] - scale, scale))
    return refuse(CameraError::view_scaled);
  for (std::size_t i = 0; i < 3; ++i) {
    if (counts(glm::dot(axis[i], axis[(i + 1) % 3]), scale * scale)) return refuse(CameraError::view_sheared);
  }
  const glm::dvec3 moved(view_from_world[3]);
  eye.scale = scale;
  eye.position =
      -(axis[0] * (moved.x / scale) + axis[1] * (moved.y / scale) + axis[2] * (moved.z / scale)) / scale;
  eye.x = axis[0] / length[0];
  eye.y = axis[1] / length[1];
  eye.z = axis[2] / length[2];
  return eye;
}

/// Along one side of the image: ndc = slope * offset + shift, for offsets along view space's axis at unit
/// depth of a perspective, or anywhere of a parallel projection.
struct Side {
  double slope = 0.0, shift = 0.0;
};

/// The projection in view space. ndc z = depth_slope * depth + depth_shift of a parallel projection, and
/// depth_slope + depth_shift / depth of a perspective.
struct Lens {
  CameraError error = CameraError::none;
  bool orthographic = false;
  double toward = -1.0;  // view z of a point at depth 1
  Side x, y;
  double depth_slope = 0.0, depth_shift = 0.0;
};

Lens lens_of(const glm::dmat4& clip_from_view, const ClipSpace& clip_space) noexcept {
  Lens lens;
  const auto refuse = [&](CameraError error) {
    lens.error = error;
    return lens;
  };
  glm::dvec4 x = row_of(clip_from_view, 0), y = row_of(clip_from_view, 1), z = row_of(clip_from_view, 2),
             w = row_of(clip_from_view, 3);
  if (clip_space.y_down) y = -y;
  const double of_z = std::abs(w.z), of_one = std::abs(w.w);
  if (of_z == 0.0 && of_one == 0.0) return refuse(CameraError::projection_singular);
  lens.orthographic = of_z == 0.0;
  // The numbers of a perspective per unit of w at unit depth; of a parallel projection per unit of w.
  const double unit = lens.orthographic ? w.w : of_z;
  for (glm::dvec4* const row : {&x, &y, &z, &w}) {
    for (int i = 0; i < 4; ++i) {
      if (std::abs((*row)[i]) > std::abs(unit) * kLargestRatio)
        return refuse(CameraError::projection_singular);
      (*row)[i] /= unit;
    }
  }
  if (std::abs(x.x) * kLargestRatio < 1.0 || std::abs(y.y) * kLargestRatio < 1.0)
    return refuse(CameraError::projection_singular);
  // Each at the edge of the image, next to w there.
  if (counts(x.y, y.y) || counts(y.x, x.x)) return refuse(CameraError::projection_sheared);
  if (counts(w.x, x.x) || counts(w.y, y.y)) return refuse(CameraError::projection_tilted);
  if (counts(z.x, x.x) || counts(z.y, y.y)) return refuse(CameraError::near_plane_tilted);
  const double depth_sign = clip_space.reversed_z ? -1.0 : 1.0;
  if (lens.orthographic) {
    if (z.z == 0.0) return refuse(CameraError::depth_range);
    lens.toward = z.z * depth_sign > 0.0 ? 1.0 : -1.0;
    lens.depth_slope = z.z * lens.toward;
    // The image must not move with depth, over the range that is one unit of ndc deep.
    if (counts(x.z, z.z) || counts(y.z, z.z)) return refuse(CameraError::projection_sheared);
    lens.x = {x.x, x.w};
    lens.y = {y.y, y.w};
  } else {
    lens.toward = w.z > 0.0 ? 1.0 : -1.0;
    lens.depth_slope = z.z * lens.toward;
    // At the near plane, whose depth z.w stands for up to a factor of two.
    if (counts(x.w, z.w) || counts(y.w, z.w) || counts(w.w, z.w))
      return refuse(CameraError::projection_off_eye);
    lens.x = {x.x, x.z * lens.toward};
    lens.y = {y.y, y.z * lens.toward};
  }
  lens.depth_shift = z.w;
  return lens;
}

/// Depths of the near and far plane, view units; not above 0 and ascending where there are none.
struct DepthEnds {
  double near_depth = 0.0, far_depth = 0.0;
};

DepthEnds depths_of(const Lens& lens, const ClipSpace& clip_space) noexcept {
  const double front = clip_space.ndc_depth == NdcDepth::zero_to_one ? 0.0 : -1.0;
  const double near_ndc = clip_space.reversed_z ? 1.0 : front, far_ndc = clip_space.reversed_z ? front : 1.0;
  if (lens.orthographic)
    return {(near_ndc - lens.depth_shift) / lens.depth_slope,
            (far_ndc - lens.depth_shift) / lens.depth_slope};
  const double at_near = near_ndc - lens.depth_slope, at_far = far_ndc - lens.depth_slope;
  if (at_near == 0.0 || lens.depth_shift == 0.0) return {};
  const double near_depth = lens.depth_shift / at_near;
  // Not even at the end of the world does depth come to the far plane's, or only by rounding.
  const bool passes = at_far != 0.0 && lens.depth_shift / at_far > 0.0;
  const double far_depth = passes ? lens.depth_shift / at_far : std::numeric_limits<double>::infinity();
  if (!passes && std::abs(at_far) > kRounding) return {};
  return {near_depth,
          far_depth > near_depth * kLargestRatio ? std::numeric_limits<double>::infinity() : far_depth};
}

}  // namespace

CameraFrom camera_from(const glm::dmat4& view_from_world, const glm::dmat4& clip_from_view,
                       const ClipSpace& clip_space, int width, int height) noexcept {
  if (!all_usable(view_from_world) || !all_usable(clip_from_view)) return {{}, CameraError::not_finite};
  if (width < 1 || height < 1) return {{}, CameraError::image_size};
  const Eye eye = eye_of(view_from_world);
  if (eye.error != CameraError::none) return {{}, eye.error};
  const Lens lens = lens_of(clip_from_view, clip_space);
  if (lens.error != CameraError::none) return {{}, lens.error};

  const glm::dvec3 forward = eye.z * lens.toward;
  const glm::dvec3 up = lens.y.slope > 0.0 ? eye.y : -eye.y, right = lens.x.slope > 0.0 ? eye.x : -eye.x;
  const bool left_handed = clip_space.handedness == Handedness::left;
  if ((glm::dot(glm::cross(forward, up), right) < 0.0) != left_handed) return {{}, CameraError::mirrored};
  const DepthEnds depths = depths_of(lens, clip_space);
  const bool in_front = lens.orthographic || depths.near_depth > 0.0;
  if (!in_front || !(depths.near_depth < depths.far_depth)) return {{}, CameraError::depth_range};

  // The edges of a parallel projection are lengths of view space. Those of a perspective are slopes, which no
  // scale changes.
  const double shrink = lens.orthographic ? 1.0 / eye.scale : 1.0;
  const auto edge = [&](const Side& side, double ndc) {
    return (ndc - side.shift) / std::abs(side.slope) * shrink;
  };
  Camera camera;
  camera.position = eye.position;
  camera.forward = forward;
  camera.up = up;
  camera.orthographic = lens.orthographic;
  // The core counts to the right of a right-handed world.
  camera.left = left_handed ? -edge(lens.x, 1.0) : edge(lens.x, -1.0);
  camera.right = left_handed ? -edge(lens.x, -1.0) : edge(lens.x, 1.0);
  camera.bottom = edge(lens.y, -1.0);
  camera.top = edge(lens.y, 1.0);
  camera.near_depth = depths.near_depth / eye.scale;
  camera.far_depth = depths.far_depth / eye.scale;
  camera.width = width;
  camera.height = height;
  return {camera, CameraError::none};
}

std::string_view to_string(CameraError error) noexcept {
  switch (error) {
    case CameraError::none:
      return "none";
    case CameraError::not_finite:
      return "an entry of a matrix is no number, or beyond 1e30";
    case CameraError::image_size:
      return "the image has no pixel";
    case CameraError::view_not_affine:
      return "the view's last row is not 0 0 0 1: is it multiplied with the projection, or transposed?";
    case CameraError::view_scaled:
      return "the view scales its axes by different factors, or by none that a number can hold";
    case CameraError::view_sheared:
      return "the view's axes are not at right angles";
    case CameraError::mirrored:
      return "the image is mirrored: y_down or handedness of the clip space do not fit, or it is a "
             "reflection";
    case CameraError::projection_singular:
      return "the projection leaves nothing of one direction";
    case CameraError::projection_sheared:
      return "one direction of the image depends on the other, or on the depth of a parallel projection";
    case CameraError::projection_tilted:
      return "the image is not at a right angle to the view's axis: a perspective with two or three points";
    case CameraError::projection_off_eye:
      return "the projection moves the eye: that belongs into the view";
    case CameraError::near_plane_tilted:
      return "the near plane is tilted: an oblique one clips, and is no part of a camera";
    case CameraError::depth_range:
      return "there is no near plane before a far one: does the clip space fit, reversed_z and ndc_depth?";
  }
  return "unknown";
}

}  // namespace gnomon
