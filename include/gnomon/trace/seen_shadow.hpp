// The exact hard shadow as a camera sees it, without a renderer.
#pragma once

#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/study/expected_error.hpp"
#include "gnomon/trace/tracer.hpp"

namespace gnomon::trace {

/// A ShadowPicture that owns its pixels.
struct SeenShadow {
  Camera camera;                          ///< its width and height are those of both pictures
  std::vector<float> mask;                ///< 1 lit, 0 in shadow, -1 where no ray to the light decides
  std::vector<float> view_depths;         ///< 0 where there is no surface
  std::vector<float> occluder_distances;  ///< world units, of what is in shadow; elsewhere -1
  /// Refers to this object, which must outlive it.
  [[nodiscard]] ShadowPicture picture() const noexcept {
    return {camera, mask, view_depths, occluder_distances};
  }
};

/// One ray through the centre of each pixel, and one to the light from the surface that it shows. Where that
/// is stopped, a third one from the light finds what is nearest to it. Surfaces that face away from the
/// light, lie beyond it or are grazed by it count for nothing.
[[nodiscard]] SeenShadow seen_shadow(const Tracer& tracer, const Camera& camera, const Light& light);

}  // namespace gnomon::trace
