// Does each graphics API get the clip space it expects?
#include "gnomon/clip_space.hpp"

#include <gtest/gtest.h>

#include <glm/vec4.hpp>

namespace gnomon::test {
namespace {

glm::dvec4 convert(const ClipSpace& space, double x, double y, double z) {
  return clip_from_gl_clip(space) * glm::dvec4(x, y, z, 1.0);
}

TEST(ClipSpace, opengl_is_what_the_core_computes_in) {
  EXPECT_EQ(clip_from_gl_clip(kOpenGl), glm::dmat4(1.0));
}

TEST(ClipSpace, vulkan_has_depth_from_zero_to_one_and_y_down) {
  EXPECT_EQ(convert(kVulkan, 0.25, 0.5, -1.0), glm::dvec4(0.25, -0.5, 0.0, 1.0));
  EXPECT_EQ(convert(kVulkan, 0.25, 0.5, 1.0), glm::dvec4(0.25, -0.5, 1.0, 1.0));
}

TEST(ClipSpace, direct3d_and_metal_keep_y_up) {
  EXPECT_EQ(convert(kDirect3D, 0.25, 0.5, 0.0), glm::dvec4(0.25, 0.5, 0.5, 1.0));
  EXPECT_EQ(convert(kMetal, 0.25, 0.5, -1.0), glm::dvec4(0.25, 0.5, 0.0, 1.0));
}

TEST(ClipSpace, reversed_depth_swaps_near_and_far_and_nothing_else) {
  const ClipSpace zero{NdcDepth::zero_to_one, true, false}, minus{NdcDepth::minus_one_to_one, true, false};
  EXPECT_EQ(convert(zero, 0.25, 0.5, -1.0), glm::dvec4(0.25, 0.5, 1.0, 1.0));
  EXPECT_EQ(convert(zero, 0.25, 0.5, 1.0), glm::dvec4(0.25, 0.5, 0.0, 1.0));
  EXPECT_EQ(convert(minus, 0.25, 0.5, 0.5), glm::dvec4(0.25, 0.5, -0.5, 1.0));
}

TEST(ClipSpace, a_perspective_w_scales_the_shift_of_depth) {
  const glm::dvec4 clip = clip_from_gl_clip(kVulkan) * glm::dvec4(2.0, 4.0, -8.0, 8.0);
  EXPECT_EQ(clip, glm::dvec4(2.0, -4.0, 0.0, 8.0));  // the near plane stays at 0
}

}  // namespace
}  // namespace gnomon::test
