// What will a plan get wrong in a picture of the shadow, and where are the shadow's edges? For C.
#include "c/convert.hpp"

namespace gnomon::c {
namespace {

double distance_by_caller(const void* picture, const glm::dvec3& point_world) noexcept {
  const auto& p = *static_cast<const gnomon_shadow_picture*>(picture);
  return p.occluder_search(p.occluder_scene, &point_world.x);
}

}  // namespace

const char* to_picture(const gnomon_shadow_picture* from, SeenPicture& to) noexcept {
  if (const char* fault = read(from, to.from)) return fault;
  const gnomon_shadow_picture& p = to.from;
  ShadowPicture& shadow = to.shadow;
  if (const char* fault = to_camera(p.camera, shadow.camera)) return fault;
  if (const char* fault = fault_of_view(View{.camera = shadow.camera}, {})) return fault;
  if (p.pixel_count != std::int64_t{shadow.camera.width} * shadow.camera.height)
    return "shadow_picture.pixel_count";
  if (p.mask == nullptr) return "shadow_picture.mask";
  if (p.view_depths == nullptr) return "shadow_picture.view_depths";
  const auto count = static_cast<std::size_t>(p.pixel_count);
  shadow.mask = {p.mask, count};
  shadow.view_depths = {p.view_depths, count};
  if (p.occluder_distances != nullptr) shadow.occluder_distances = {p.occluder_distances, count};
  if (p.normals != nullptr) shadow.normals_world = {reinterpret_cast<const glm::vec3*>(p.normals), count};
  if (p.occluder_search != nullptr) shadow.occluders = {distance_by_caller, &p};
  return nullptr;
}

}  // namespace gnomon::c

using namespace gnomon;
using namespace gnomon::c;

extern "C" {

int32_t gnomon_expected_error(const gnomon_plan* plan, const gnomon_shadow_picture* picture,
                              gnomon_wrong_pixels* pixels, const char** invalid_field) {
  ShadowPlan p;
  const char* fault = to_plan(plan, p);
  return expect_pixels(fault, picture, pixels, invalid_field,
                       [&](const ShadowPicture& shadow, double kernel) {
                         place_origin(shadow.camera, p);
                         return expected_error(p, shadow, kernel);
                       });
}

int32_t gnomon_shadow_edge_points(const gnomon_shadow_picture* picture, double* points, int64_t room,
                                  int64_t* written, const char** invalid_field) {
  SeenPicture seen;
  if (const char* fault = to_picture(picture, seen)) return refuse(fault, invalid_field);
  if (room < 0) return refuse("room", invalid_field);
  if (points == nullptr && room > 0) return refuse("points", invalid_field);
  if (written == nullptr) return refuse("written", invalid_field);
  const std::span<glm::dvec3> out(reinterpret_cast<glm::dvec3*>(points), static_cast<std::size_t>(room));
  *written = static_cast<int64_t>(shadow_edge_points(seen.shadow, out));
  return done(invalid_field);
}

}  // extern "C"
