// The one place where clip-space conventions are applied.
// Based on: OpenGL 4.6 section 13.8, Vulkan 1.3 section 27.9, Direct3D 11.3 section 15.7 and Metal Shading
// Language (viewport transforms and texture coordinates).
#include "gnomon/clip_space.hpp"

namespace gnomon {

glm::dmat4 clip_from_gl_clip(const ClipSpace& target) noexcept {
  glm::dmat4 m(1.0);
  if (target.handedness == Handedness::left) m[0][0] = -1.0;
  if (target.y_down) m[1][1] = -1.0;
  const double sign = target.reversed_z ? -1.0 : 1.0;
  if (target.ndc_depth == NdcDepth::zero_to_one) {
    m[2][2] = 0.5 * sign;
    m[3][2] = 0.5;
  } else {
    m[2][2] = sign;
  }
  return m;
}

glm::dmat4 texture_from_clip(const ClipSpace& source) noexcept {
  glm::dmat4 m(1.0);
  m[0][0] = 0.5;
  m[3][0] = 0.5;
  m[1][1] = source.first_row == FirstRow::y_plus_one ? -0.5 : 0.5;
  m[3][1] = 0.5;
  if (source.ndc_depth == NdcDepth::minus_one_to_one) {
    m[2][2] = 0.5;
    m[3][2] = 0.5;
  }
  return m;
}

}  // namespace gnomon
