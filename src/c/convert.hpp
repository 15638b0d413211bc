// How do the structs of C become those of C++, and back? Each pair of functions names every field once.
#pragma once

#include <array>
#include <span>

#include "c/sized.hpp"
#include "gnomon/gnomon.hpp"
#include "gnomon/study/expected_error.hpp"

/// Owns the memory of a CasterSet.
struct gnomon_caster_set {
  gnomon::CasterBlock* blocks = nullptr;
  std::uint32_t* indices = nullptr;
  gnomon::CasterSet set;
};
struct gnomon_history {
  gnomon::PlanHistory history;
};

namespace gnomon::c {

// Each returns nullptr, or the name of the field that is wrong.
[[nodiscard]] const char* to_camera(const gnomon_camera* from, Camera& to) noexcept;
[[nodiscard]] const char* to_light(const gnomon_light* from, Light& to) noexcept;
/// nullptr: the defaults.
[[nodiscard]] const char* to_options(const gnomon_plan_options* from, PlanOptions& to) noexcept;
[[nodiscard]] const char* to_scene(const gnomon_scene* from, SceneBounds& to) noexcept;
/// `to.depths` points into `from`.
[[nodiscard]] const char* to_view(const gnomon_view* from, View& to) noexcept;
/// A map of the caller's, checked so that no later call divides by zero or reads beyond an array.
[[nodiscard]] const char* to_map(const gnomon_map* from, ShadowMap& to) noexcept;
[[nodiscard]] const char* to_plan(const gnomon_plan* from, ShadowPlan& to) noexcept;
/// Plans of maps that others made have no origin, which bounds the rounding of points: the camera's place.
inline void place_origin(const Camera& camera, ShadowPlan& plan) noexcept {
  if (plan.origin_world == glm::dvec3(0.0)) plan.origin_world = camera.position;
}

/// What is measured, beside the plan. `stats` is to be written to.
struct Measured {
  View view;
  SceneBounds bounds;
  MeasureOptions options;
};
[[nodiscard]] const char* to_measured(const gnomon_view* view, const gnomon_scene* scene,
                                      const gnomon_measure_options* options, const gnomon_stats* stats,
                                      Measured& to) noexcept;

/// A picture of the caller's. Not to be copied: the search points to `from`.
struct SeenPicture {
  gnomon_shadow_picture from;
  ShadowPicture shadow;
};
[[nodiscard]] const char* to_picture(const gnomon_shadow_picture* from, SeenPicture& to) noexcept;
/// What a call for expected errors returns. `fault`: what is wrong with its plan; `expect`: from a picture
/// and a kernel.
template <class Expect>
[[nodiscard]] std::int32_t expect_pixels(const char* fault, const gnomon_shadow_picture* picture,
                                         gnomon_wrong_pixels* pixels, const char** invalid_field,
                                         const Expect& expect) noexcept {
  SeenPicture seen;
  if (fault == nullptr) fault = to_picture(picture, seen);
  if (fault == nullptr && pixels == nullptr) fault = "pixels";
  if (fault != nullptr) return refuse(fault, invalid_field);
  const ExpectedError found = expect(seen.shadow, seen.from.kernel_texels);
  *pixels = {found.wrong_pixels, found.counted_pixels, found.share()};
  return done(invalid_field);
}

/// `count` boxes of six doubles; `name` and `count_name` are those of the two in messages.
struct BoxList {
  const double* first;
  std::int64_t count;
  const char *name, *count_name;
};
[[nodiscard]] const char* to_boxes(const BoxList& from, std::span<const Box>& to) noexcept;
[[nodiscard]] const char* to_points(const double* first, std::int64_t count, const char* name,
                                    std::span<const glm::dvec3>& to) noexcept;

[[nodiscard]] ClipSpace to_clip_space(const gnomon_clip_space& from) noexcept;
/// nullptr: OpenGL.
[[nodiscard]] ClipSpace to_clip_space(const gnomon_clip_space* from) noexcept;
[[nodiscard]] glm::dmat4 to_matrix(const double* from) noexcept;

void from_camera(const Camera& from, gnomon_camera& to) noexcept;
void from_options(const PlanOptions& from, gnomon_plan_options& to) noexcept;
void from_map(const ShadowMap& from, gnomon_map& to) noexcept;
[[nodiscard]] gnomon_clip_space from_clip_space(const ClipSpace& from) noexcept;
[[nodiscard]] gnomon_texel_rect from_rect(const TexelRect& from) noexcept;
[[nodiscard]] TexelRect to_rect(const gnomon_texel_rect& from) noexcept;
[[nodiscard]] gnomon_atlas from_atlas(const Atlas& from) noexcept;
void from_stats(const AliasingStats& from, gnomon_stats& to) noexcept;
void from_matrix(const glm::dmat4& from, double* to) noexcept;
template <typename Vector, typename Number>
void from_vector(const Vector& from, Number* to) noexcept {
  for (int i = 0; i < static_cast<int>(Vector::length()); ++i) to[i] = static_cast<Number>(from[i]);
}
[[nodiscard]] inline glm::dvec3 to_vector(const double* from) noexcept {
  return {from[0], from[1], from[2]};
}
/// Writes the maps of a plan over those that `to` has room for.
void write_maps(std::span<const ShadowMap> maps, const gnomon_plan& to) noexcept;
/// Writes at most `room` omissions.
void from_omissions(std::span<const Omission> from, gnomon_omission* to, std::int32_t room) noexcept;

/// The field's name in C of one in C++: "options.split.lambda" is "plan_options.split_lambda". A static text.
[[nodiscard]] const char* field_of(std::string_view name) noexcept;
/// What is wrong with a camera, a scene and points, as make_plan finds it; nullptr where all is well.
[[nodiscard]] const char* fault_of_view(const View& view, const SceneBounds& bounds) noexcept;

}  // namespace gnomon::c
