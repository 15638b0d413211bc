// Does a camera come back from its matrices, in every clip space, and is what no camera sees refused by name?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <vector>

#include "gnomon/camera.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr int kWidth = 1280, kHeight = 720;

std::vector<ClipSpace> all_clip_spaces() {
  std::vector<ClipSpace> all;
  for (const NdcDepth depth : {NdcDepth::minus_one_to_one, NdcDepth::zero_to_one})
    for (const bool reversed_z : {false, true})
      for (const bool y_down : {false, true})
        for (const Handedness hand : {Handedness::right, Handedness::left})
          all.push_back({depth, reversed_z, y_down, hand, FirstRow::y_minus_one});
  return all;
}

/// The projection as the engine of such a clip space has it.
glm::dmat4 projection(const Camera& camera, const ClipSpace& clip_space) {
  return clip_from_gl_clip(clip_space) * clip_from_view(camera);
}

CameraFrom back(const Camera& camera, const ClipSpace& clip_space) {
  return camera_from(view_from_world(camera), projection(camera, clip_space), clip_space, camera.width,
                     camera.height);
}

/// Largest difference of two cameras: of directions and slopes, and of lengths next to `length`.
double difference(const Camera& a, const Camera& b, double length) {
  const CameraAxes x = camera_axes(a), y = camera_axes(b);
  const double side = a.orthographic ? length : 1.0;
  double most = glm::distance(a.position, b.position) / length;
  for (const double d :
       {glm::distance(x.forward, y.forward), glm::distance(x.up, y.up), glm::distance(x.right, y.right),
        (a.left - b.left) / side, (a.right - b.right) / side, (a.bottom - b.bottom) / side,
        (a.top - b.top) / side, (a.near_depth - b.near_depth) / length})
    most = std::max(most, std::abs(d));
  if (std::isinf(a.far_depth) || std::isinf(b.far_depth))
    return a.far_depth == b.far_depth ? most : std::numeric_limits<double>::infinity();
  return std::max(most, std::abs(a.far_depth - b.far_depth) / a.far_depth);
}

Camera drawn_camera() {
  Camera camera = draw_case().camera;
  // Off the axis, by up to the width of the image.
  if (chance(0.5)) {
    const double x = between(-1.0, 1.0) * (camera.right - camera.left),
                 y = between(-1.0, 1.0) * (camera.top - camera.bottom);
    camera.left += x;
    camera.right += x;
    camera.bottom += y;
    camera.top += y;
  }
  if (!camera.orthographic && chance(0.3)) camera.far_depth = std::numeric_limits<double>::infinity();
  return camera;
}

TEST(CameraFrom, its_own_matrices_give_the_camera_back_in_every_clip_space) {
  // Far planes a million times as deep as near ones come back with a millionth of double's digits.
  constexpr double kTolerance = 1e-8;
  int perspective = 0, parallel = 0, endless = 0;
  for_all(500, [&] {
    const Camera camera = drawn_camera();
    const double length = std::max(glm::length(camera.position),
                                   std::isinf(camera.far_depth) ? camera.near_depth : camera.far_depth);
    for (const ClipSpace& clip_space : all_clip_spaces()) {
      const CameraFrom from = back(camera, clip_space);
      require(from.error == CameraError::none, to_string(from.error));
      require(from.camera.orthographic == camera.orthographic, "kind");
      require(from.camera.width == camera.width && from.camera.height == camera.height, "image");
      const double off = difference(camera, from.camera, length);
      require(off <= kTolerance, "off by", off);
    }
    ++(camera.orthographic ? parallel : std::isinf(camera.far_depth) ? endless : perspective);
  });
  EXPECT_GT(perspective, 50);
  EXPECT_GT(parallel, 20);
  EXPECT_GT(endless, 20);
}

TEST(CameraFrom, matrices_in_single_precision_are_accepted) {
  // A far plane a thousand times as deep as the near one keeps four digits of a float.
  constexpr double kTolerance = 1e-3;
  for (const bool orthographic : {false, true}) {
    for (const ClipSpace& clip_space : all_clip_spaces()) {
      Camera camera =
          perspective_camera({30, 5, -20}, {0.3, -0.2, -1}, {0, 1, 0}, 1.0, 1.6, 0.5, 500.0, kWidth, kHeight);
      if (orthographic)
        camera = orthographic_camera({30, 5, -20}, {0.3, -0.2, -1}, {0, 1, 0}, 40.0, 1.6, 0.5, 500.0, kWidth,
                                     kHeight);
      const glm::mat4 view(view_from_world(camera)), clip(projection(camera, clip_space));
      const CameraFrom from = camera_from(glm::dmat4(view), glm::dmat4(clip), clip_space, kWidth, kHeight);
      ASSERT_EQ(from.error, CameraError::none) << to_string(from.error);
      EXPECT_LE(difference(camera, from.camera, 500.0), kTolerance);
    }
  }
}

TEST(CameraFrom, glm_s_matrices_are_those_of_opengl) {
  const glm::dvec3 eye{3, 4, 5}, at{0, 1, 0};
  const CameraFrom from = camera_from(glm::lookAtRH(eye, at, {0, 1, 0}),
                                      glm::perspectiveRH_NO(1.0, 1.5, 0.1, 100.0), kOpenGl, kWidth, kHeight);
  ASSERT_EQ(from.error, CameraError::none);
  EXPECT_LE(difference(perspective_camera(eye, at - eye, {0, 1, 0}, 1.0, 1.5, 0.1, 100.0, kWidth, kHeight),
                       from.camera, 100.0),
            1e-9);
}

TEST(CameraFrom, a_left_handed_engine_looks_along_plus_z) {
  ClipSpace clip_space = kDirect3D;
  clip_space.handedness = Handedness::left;
  const glm::dvec3 eye{3, 4, 5}, at{0, 1, 30};
  const glm::dmat4 view = glm::lookAtLH(eye, at, {0, 1, 0});
  // Slopes from -0.2 to 0.6 to the right, as the engine counts, and from -0.4 to 0.2 up.
  glm::dmat4 clip(0.0);
  clip[0][0] = 2.0 / 0.8;
  clip[1][1] = 2.0 / 0.6;
  clip[2] = {-0.4 / 0.8, 0.2 / 0.6, 80.0 / 79.5, 1.0};
  clip[3][2] = -0.5 * 80.0 / 79.5;
  const CameraFrom from = camera_from(view, clip, clip_space, kWidth, kHeight);
  ASSERT_EQ(from.error, CameraError::none) << to_string(from.error);
  EXPECT_LE(glm::distance(from.camera.forward, glm::normalize(at - eye)), 1e-12);
  EXPECT_NEAR(from.camera.left, -0.6, 1e-12);
  EXPECT_NEAR(from.camera.right, 0.2, 1e-12);
  EXPECT_NEAR(from.camera.near_depth, 0.5, 1e-12);
  EXPECT_NEAR(from.camera.far_depth, 80.0, 1e-9);
  clip_space.handedness = Handedness::right;
  EXPECT_EQ(camera_from(view, clip, clip_space, kWidth, kHeight).error, CameraError::mirrored);
}

TEST(CameraFrom, an_infinite_far_plane_stays_infinite) {
  const Camera camera = perspective_camera({0, 2, 0}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.5, 0.25,
                                           std::numeric_limits<double>::infinity(), kWidth, kHeight);
  for (const ClipSpace& clip_space : all_clip_spaces()) {
    for (const double less : {0.0, 0x1p-22}) {
      // With `less`, the limit of depth is a little nearer than the far plane, so that rounding clips
      // nothing.
      glm::dmat4 clip = projection(camera, clip_space);
      clip[2][2] += clip_space.reversed_z ? -less : less;
      const CameraFrom from = camera_from(view_from_world(camera), clip, clip_space, kWidth, kHeight);
      ASSERT_EQ(from.error, CameraError::none) << to_string(from.error);
      EXPECT_TRUE(std::isinf(from.camera.far_depth));
      EXPECT_NEAR(from.camera.near_depth, 0.25, 1e-6);
    }
  }
}

TEST(CameraFrom, far_from_the_origin_the_eye_keeps_its_digits) {
  const glm::dvec3 eye{1e7 + 0.25, -3e6, 5e6 + 0.125};
  const Camera camera =
      perspective_camera(eye, {0.3, -0.2, -1}, {0, 1, 0}, 1.0, 1.6, 0.1, 1000.0, kWidth, kHeight);
  const CameraFrom from = back(camera, kVulkan);
  ASSERT_EQ(from.error, CameraError::none);
  EXPECT_LE(glm::distance(from.camera.position, eye), 1e-7);
  // A view in single precision is a metre off at this distance; the camera is still one.
  const CameraFrom rounded = camera_from(glm::dmat4(glm::mat4(view_from_world(camera))),
                                         projection(camera, kVulkan), kVulkan, kWidth, kHeight);
  ASSERT_EQ(rounded.error, CameraError::none);
  EXPECT_LE(glm::distance(rounded.camera.position, eye), 2.0);
}

TEST(CameraFrom, an_evenly_scaled_view_comes_back_in_world_units) {
  for (const double scale : {0.01, 1000.0}) {
    for (const bool orthographic : {false, true}) {
      Camera camera =
          perspective_camera({3, 4, 5}, {1, 0, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 100.0, kWidth, kHeight);
      if (orthographic)
        camera =
            orthographic_camera({3, 4, 5}, {1, 0, -1}, {0, 1, 0}, 20.0, 1.5, 0.5, 100.0, kWidth, kHeight);
      const glm::dmat4 grown = glm::scale(glm::dmat4(1.0), glm::dvec3(scale));
      const CameraFrom from =
          camera_from(grown * view_from_world(camera), clip_from_view(camera) * glm::inverse(grown), kOpenGl,
                      kWidth, kHeight);
      ASSERT_EQ(from.error, CameraError::none) << to_string(from.error);
      EXPECT_LE(difference(camera, from.camera, 100.0), 1e-9);
    }
  }
}

TEST(CameraFrom, an_image_turned_by_half_a_turn_is_a_camera_that_stands_on_its_head) {
  const Camera camera =
      perspective_camera({3, 4, 5}, {1, 0, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 100.0, kWidth, kHeight);
  glm::dmat4 turned(1.0);
  turned[0][0] = turned[1][1] = -1.0;
  const CameraFrom from =
      camera_from(view_from_world(camera), turned * clip_from_view(camera), kOpenGl, kWidth, kHeight);
  ASSERT_EQ(from.error, CameraError::none);
  EXPECT_LE(glm::distance(camera_axes(from.camera).up, -camera_axes(camera).up), 1e-12);
}

TEST(CameraFrom, a_view_that_was_inverted_as_any_matrix_is_one) {
  // As three.js has it while a camera walks: the determinant over itself.
  const Camera camera =
      perspective_camera({2.0, 3.0, 8.0}, {0.1, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.2, 220.0, 900, 600);
  glm::dmat4 view = view_from_world(camera);
  const Camera exact = camera_from(view, clip_from_view(camera), {}, 900, 600).camera;
  for (const double one : {1.0 + 2.3e-16, 1.0 - 1.2e-16, 1.0 + 1.2e-7}) {
    view[3][3] = one;
    const CameraFrom found = camera_from(view, clip_from_view(camera), {}, 900, 600);
    EXPECT_EQ(found.error, CameraError::none) << one;
    EXPECT_LT(glm::distance(found.camera.position, exact.position), 1e-5);
  }
  view[3][3] = 1.001;
  EXPECT_EQ(camera_from(view, clip_from_view(camera), {}, 900, 600).error, CameraError::view_not_affine);
}

TEST(CameraFrom, what_is_no_camera_is_refused_by_name) {
  struct Entry {
    CameraError error;
    void (*change)(glm::dmat4& view, glm::dmat4& clip);
  };
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN(),
                   kInfinity = std::numeric_limits<double>::infinity();
  const Entry entries[] = {
      {CameraError::not_finite, [](glm::dmat4& v, glm::dmat4&) { v[1][2] = kNone; }},
      {CameraError::not_finite, [](glm::dmat4&, glm::dmat4& c) { c[3][2] = kInfinity; }},
      {CameraError::view_not_affine, [](glm::dmat4& v, glm::dmat4& c) { v = c * v; }},
      {CameraError::view_not_affine, [](glm::dmat4& v, glm::dmat4&) { v = glm::transpose(v); }},
      {CameraError::view_scaled, [](glm::dmat4& v, glm::dmat4&) { v = glm::scale(v, glm::dvec3(1, 2, 1)); }},
      {CameraError::view_scaled, [](glm::dmat4& v, glm::dmat4&) { v = glm::scale(v, glm::dvec3(0.0)); }},
      {CameraError::view_sheared,
       [](glm::dmat4& v, glm::dmat4&) {
         // The same length as before, and not at a right angle to the others.
         for (int i = 0; i < 3; ++i) v[i][0] = 0.8 * v[i][0] + 0.6 * v[i][1];
       }},
      {CameraError::mirrored,
       [](glm::dmat4& v, glm::dmat4&) { v = v * glm::scale(glm::dmat4(1.0), glm::dvec3(1, -1, 1)); }},
      {CameraError::mirrored,
       [](glm::dmat4&, glm::dmat4& c) { c = clip_from_gl_clip({.y_down = true}) * c; }},
      {CameraError::projection_singular, [](glm::dmat4&, glm::dmat4& c) { c = glm::dmat4(0.0); }},
      {CameraError::projection_singular, [](glm::dmat4&, glm::dmat4& c) { c[0][0] = 0.0; }},
      {CameraError::projection_sheared, [](glm::dmat4&, glm::dmat4& c) { c[1][0] = 0.3; }},
      {CameraError::projection_tilted, [](glm::dmat4&, glm::dmat4& c) { c[0][3] = 0.2; }},
      {CameraError::projection_tilted, [](glm::dmat4&, glm::dmat4& c) { c[1][3] = -0.2; }},
      {CameraError::near_plane_tilted, [](glm::dmat4&, glm::dmat4& c) { c[0][2] = 0.1; }},
      {CameraError::projection_off_eye,
       [](glm::dmat4&, glm::dmat4& c) { c = c * glm::translate(glm::dmat4(1.0), glm::dvec3(1, 0, 0)); }},
      {CameraError::projection_off_eye,
       [](glm::dmat4&, glm::dmat4& c) { c = c * glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 2)); }},
      {CameraError::depth_range,
       [](glm::dmat4&, glm::dmat4& c) { c = clip_from_gl_clip({.reversed_z = true}) * c; }},
      {CameraError::depth_range, [](glm::dmat4&, glm::dmat4& c) { c[3][2] = 0.0; }},
  };
  const Camera camera =
      perspective_camera({3, 4, 5}, {1, -0.3, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 100.0, kWidth, kHeight);
  for (const Entry& entry : entries) {
    glm::dmat4 view = view_from_world(camera), clip = clip_from_view(camera);
    entry.change(view, clip);
    const CameraFrom from = camera_from(view, clip, kOpenGl, kWidth, kHeight);
    EXPECT_EQ(from.error, entry.error) << to_string(from.error) << ", not " << to_string(entry.error);
  }
  const Camera parallel =
      orthographic_camera({3, 4, 5}, {1, -0.3, -1}, {0, 1, 0}, 20.0, 1.5, 0.5, 100.0, kWidth, kHeight);
  glm::dmat4 oblique = clip_from_view(parallel), flat = oblique;
  oblique[2][0] = 0.1;
  flat[2][2] = 0.0;
  EXPECT_EQ(camera_from(view_from_world(parallel), oblique, kOpenGl, kWidth, kHeight).error,
            CameraError::projection_sheared);
  EXPECT_EQ(camera_from(view_from_world(parallel), flat, kOpenGl, kWidth, kHeight).error,
            CameraError::depth_range);
  EXPECT_EQ(camera_from(view_from_world(camera), clip_from_view(camera), kOpenGl, 0, kHeight).error,
            CameraError::image_size);
}

}  // namespace
}  // namespace gnomon::test
