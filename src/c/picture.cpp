// What will a plan get wrong in a picture of the shadow, and where are the shadow's edges? For C.
#include "c/convert.hpp"
#include "gnomon/study/expected_error.hpp"

namespace gnomon::c {
namespace {

const char* to_picture(const gnomon_shadow_picture* from, ShadowPicture& to) noexcept {
  if (const char* fault = fault_of(from)) return fault;
  gnomon_shadow_picture older;
  const gnomon_shadow_picture& p = whole(*from, older);
  if (const char* fault = to_camera(p.camera, to.camera)) return fault;
  if (const char* fault = fault_of_view(View{.camera = to.camera}, {})) return fault;
  if (p.pixel_count != std::int64_t{to.camera.width} * to.camera.height) return "shadow_picture.pixel_count";
  if (p.mask == nullptr) return "shadow_picture.mask";
  if (p.view_depths == nullptr) return "shadow_picture.view_depths";
  const auto count = static_cast<std::size_t>(p.pixel_count);
  to.mask = {p.mask, count};
  to.view_depths = {p.view_depths, count};
  if (p.occluder_distances != nullptr) to.occluder_distances = {p.occluder_distances, count};
  return nullptr;
}

/// The picture is one that to_picture() takes.
double kernel_of(const gnomon_shadow_picture& picture) noexcept {
  gnomon_shadow_picture older;
  return whole(picture, older).kernel_texels;
}

}  // namespace
}  // namespace gnomon::c

using namespace gnomon;
using namespace gnomon::c;

extern "C" {

int32_t gnomon_expected_error(const gnomon_plan* plan, const gnomon_shadow_picture* picture,
                              gnomon_wrong_pixels* pixels, const char** invalid_field) {
  ShadowPlan p;
  ShadowPicture shadow;
  const char* fault = to_plan(plan, p);
  if (fault == nullptr) fault = to_picture(picture, shadow);
  if (fault == nullptr && pixels == nullptr) fault = "pixels";
  if (fault != nullptr) return refuse(fault, invalid_field);
  place_origin(shadow.camera, p);
  const ExpectedError found = expected_error(p, shadow, kernel_of(*picture));
  *pixels = {found.wrong_pixels, found.counted_pixels, found.share()};
  return done(invalid_field);
}

int32_t gnomon_shadow_edge_points(const gnomon_shadow_picture* picture, double* points, int64_t room,
                                  int64_t* written, const char** invalid_field) {
  ShadowPicture shadow;
  if (const char* fault = to_picture(picture, shadow)) return refuse(fault, invalid_field);
  if (room < 0) return refuse("room", invalid_field);
  if (points == nullptr && room > 0) return refuse("points", invalid_field);
  if (written == nullptr) return refuse("written", invalid_field);
  const std::span<glm::dvec3> out(reinterpret_cast<glm::dvec3*>(points), static_cast<std::size_t>(room));
  *written = static_cast<int64_t>(shadow_edge_points(shadow, out));
  return done(invalid_field);
}

}  // extern "C"
