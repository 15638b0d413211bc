// The exact hard shadow as a camera sees it, without a renderer.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/study/expected_error.hpp"
#include "gnomon/trace/reference.hpp"
#include "gnomon/trace/tracer.hpp"

namespace gnomon::trace {

/// Finds by rays what a map of a light stores: ShadowPicture::occluders.
class LightOccluders {
 public:
  LightOccluders() = default;  ///< searches nothing
  /// The tracer must outlive it.
  LightOccluders(const Tracer& tracer, const Light& light) : tracer_(&tracer), light_(light) {}
  /// Refers to this object, which must outlive it.
  [[nodiscard]] OccluderSearch search() const noexcept;

 private:
  const Tracer* tracer_ = nullptr;
  Light light_;
};

/// A ShadowPicture that owns its pixels.
struct SeenShadow {
  Camera camera;                         ///< its width and height are those of the pictures
  std::vector<float> mask;               ///< 1 lit, 0 in shadow, -1 where no ray to the light decides
  std::vector<float> view_depths;        ///< 0 where there is no surface
  std::vector<glm::vec3> normals_world;  ///< of the triangles, towards the viewer; zero: no surface
  LightOccluders occluders;              ///< search what lies between a point and the light
  /// Refers to this object and to the tracer, which must outlive it.
  [[nodiscard]] ShadowPicture picture() const noexcept {
    return {camera, mask, view_depths, {}, normals_world, occluders.search()};
  }
};

/// One ray through the centre of each pixel, and one to the light from the surface that it shows. Surfaces
/// that face away from the light, lie beyond it or are grazed by it count for nothing. The tracer must
/// outlive what is returned.
[[nodiscard]] SeenShadow seen_shadow(const Tracer& tracer, const Camera& camera, const Light& light);
/// The same of points that were found, and of their shadow: `mask` is SeenShadow::mask.
[[nodiscard]] SeenShadow seen_shadow(const Tracer& tracer, const Camera& camera, const Light& light,
                                     const SurfacePoints& points, std::vector<float> mask);

}  // namespace gnomon::trace
