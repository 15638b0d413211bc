// The one place where clip-space conventions are applied.
#include "gnomon/clip_space.hpp"

namespace gnomon {

glm::dmat4 clip_from_gl_clip(const ClipSpace& target) noexcept {
  glm::dmat4 m(1.0);
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

}  // namespace gnomon
