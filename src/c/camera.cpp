// Cameras of C: from angles, from matrices, and their clip spaces.
#include "c/convert.hpp"
#include "geometry/usable.hpp"

namespace gnomon::c {
namespace {

constexpr double kPi = 3.141592653589793;

const char* fault_of_image(double aspect, double near_depth, double far_depth, std::int32_t width,
                           std::int32_t height) noexcept {
  if (!(aspect > 0.0 && aspect <= kLargest)) return "aspect";
  if (!usable(near_depth)) return "near_depth";
  if (!(far_depth > near_depth)) return "far_depth";
  if (width < 1 || width > 1 << 20) return "width";
  return height < 1 || height > 1 << 20 ? "height" : nullptr;
}

std::int32_t write_camera(const Camera& camera, gnomon_camera* to, const char** invalid_field) noexcept {
  gnomon_camera all;
  set_defaults(all);
  from_camera(camera, all);
  write(all, to);
  return done(invalid_field);
}
/// The image of one camera, at the place of the other.
std::int32_t write_image(Camera image, const Camera& place, gnomon_camera* to,
                         const char** invalid_field) noexcept {
  image.position = place.position;
  image.forward = place.forward;
  image.up = place.up;
  return write_camera(image, to, invalid_field);
}

/// One static sentence for each, which ends in a zero.
const char* text_of(CameraError error) noexcept {
  return error == CameraError::none ? nullptr : to_string(error).data();
}

const char* place_of(CameraError error) noexcept {
  switch (error) {
    case CameraError::view_not_affine:
    case CameraError::view_scaled:
    case CameraError::view_sheared:
      return "view_from_world";
    case CameraError::image_size:
      return "width, height";
    case CameraError::not_finite:
      return "view_from_world, clip_from_view";
    case CameraError::mirrored:
    case CameraError::depth_range:
      return "clip_from_view, clip_space";
    default:
      return "clip_from_view";
  }
}

}  // namespace
}  // namespace gnomon::c

using namespace gnomon;
using namespace gnomon::c;

extern "C" {

int32_t gnomon_perspective(gnomon_camera* camera, double fov_y, double aspect, double near_depth,
                           double far_depth, int32_t width, int32_t height, const char** invalid_field) {
  Camera c;
  if (const char* fault = to_camera(camera, c)) return refuse(fault, invalid_field);
  if (!(fov_y > 0.0 && fov_y < kPi)) return refuse("fov_y", invalid_field);
  if (const char* fault = fault_of_image(aspect, near_depth, far_depth, width, height))
    return refuse(fault, invalid_field);
  if (!(near_depth > 0.0)) return refuse("near_depth", invalid_field);
  return write_image(
      perspective_camera(c.position, c.forward, c.up, fov_y, aspect, near_depth, far_depth, width, height), c,
      camera, invalid_field);
}

int32_t gnomon_orthographic(gnomon_camera* camera, double height_world, double aspect, double near_depth,
                            double far_depth, int32_t width, int32_t height, const char** invalid_field) {
  Camera c;
  if (const char* fault = to_camera(camera, c)) return refuse(fault, invalid_field);
  if (!(height_world > 0.0 && height_world <= kLargest)) return refuse("height_world", invalid_field);
  if (const char* fault = fault_of_image(aspect, near_depth, far_depth, width, height))
    return refuse(fault, invalid_field);
  return write_image(orthographic_camera(c.position, c.forward, c.up, height_world, aspect, near_depth,
                                         far_depth, width, height),
                     c, camera, invalid_field);
}

int32_t gnomon_camera_from(const double view_from_world[16], const double clip_from_view[16],
                           const gnomon_clip_space* clip_space, int32_t width, int32_t height,
                           gnomon_camera* camera, const char** why, const char** invalid_field) {
  if (why != nullptr) *why = nullptr;
  if (view_from_world == nullptr) return refuse("view_from_world", invalid_field);
  if (clip_from_view == nullptr) return refuse("clip_from_view", invalid_field);
  if (const char* fault = fault_of(camera)) return refuse(fault, invalid_field);
  const CameraFrom found = camera_from(to_matrix(view_from_world), to_matrix(clip_from_view),
                                       to_clip_space(clip_space), width, height);
  if (found.error != CameraError::none) {
    if (why != nullptr) *why = text_of(found.error);
    return refuse(place_of(found.error), invalid_field);
  }
  return write_camera(found.camera, camera, invalid_field);
}

int32_t gnomon_texture_from_clip(const gnomon_clip_space* clip_space, double out[16]) {
  if (out == nullptr) return GNOMON_INVALID_INPUT;
  from_matrix(texture_from_clip(to_clip_space(clip_space)), out);
  return GNOMON_OK;
}

}  // extern "C"
