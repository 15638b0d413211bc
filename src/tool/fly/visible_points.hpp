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

/// Visible points of one scene; none where rays were not built in.
class VisiblePointsOf {
 public:
#ifdef GNOMON_HAS_TRACE
  explicit VisiblePointsOf(const Scene& scene) : tracer_(scene) {}
  /// One for each of so many columns and rows of the picture.
  std::vector<glm::dvec3> operator()(const Camera& camera, const Light& light, int columns = 64,
                                     int rows = 36) const {
    return trace::seen_points(tracer_, camera, light, columns, rows);
  }

 private:
  trace::Tracer tracer_;
#else
  explicit VisiblePointsOf(const Scene&) {}
  std::vector<glm::dvec3> operator()(const Camera&, const Light&, int = 0, int = 0) const {
    return {};
  }
#endif
};

/// The shadow in one scene, for choose_technique. Throws std::runtime_error where rays were not built in.
class SeenShadowOf {
 public:
#ifdef GNOMON_HAS_TRACE
  explicit SeenShadowOf(const Scene& scene) : tracer_(scene) {}
  trace::SeenShadow operator()(const Camera& camera, const Light& light) const {
    return trace::seen_shadow(tracer_, camera, light);
  }

 private:
  trace::Tracer tracer_;
#else
  struct None {
    [[nodiscard]] ShadowPicture picture() const noexcept { return {}; }
  };
  explicit SeenShadowOf(const Scene&) {
    throw std::runtime_error("--budget-ms, --target-error: count pixels by rays, which were not built in");
  }
  None operator()(const Camera&, const Light&) const {
    return {};
  }
#endif
};

}  // namespace gnomon::tool::fly
