// What does the camera of a flight see? By rays where they were built in.
#pragma once

#include <glm/vec3.hpp>
#include <stdexcept>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/scene/scene.hpp"
#include "gnomon/study/expected_error.hpp"
#ifdef GNOMON_HAS_TRACE
#include "gnomon/trace/seen_points.hpp"
#include "gnomon/trace/seen_shadow.hpp"
#endif

namespace gnomon::tool::fly {

class SceneRays {
 public:
#ifdef GNOMON_HAS_TRACE
  explicit SceneRays(const Scene& scene) : tracer_(scene) {}
  /// Visible points, one for each of so many columns and rows of the picture; none without rays.
  [[nodiscard]] std::vector<glm::dvec3> points(const Camera& camera, const Light& light, int columns = 64,
                                               int rows = 36) const {
    return trace::seen_points(tracer_, camera, light, columns, rows);
  }
  /// The shadow, for choose_technique; refers to this object. Throws std::runtime_error without rays.
  [[nodiscard]] trace::SeenShadow shadow(const Camera& camera, const Light& light) const {
    return trace::seen_shadow(tracer_, camera, light);
  }

 private:
  trace::Tracer tracer_;
#else
  struct None {
    [[nodiscard]] ShadowPicture picture() const noexcept { return {}; }
  };
  explicit SceneRays(const Scene&) {}
  [[nodiscard]] std::vector<glm::dvec3> points(const Camera&, const Light&, int = 0, int = 0) const {
    return {};
  }
  [[nodiscard]] None shadow(const Camera&, const Light&) const {
    throw std::runtime_error("--budget-ms, --target-error: count pixels by rays, which were not built in");
  }
#endif
};

}  // namespace gnomon::tool::fly
