// What does the camera of a flight see? By rays where they were built in.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/scene/scene.hpp"
#ifdef GNOMON_HAS_TRACE
#include "gnomon/trace/seen_points.hpp"
#endif

namespace gnomon::tool::fly {

/// Visible points of one scene; none where rays were not built in.
class VisiblePointsOf {
 public:
#ifdef GNOMON_HAS_TRACE
  explicit VisiblePointsOf(const Scene& scene) : tracer_(scene) {}
  std::vector<glm::dvec3> operator()(const Camera& camera, const Light& light) const {
    return trace::seen_points(tracer_, camera, light);
  }

 private:
  trace::Tracer tracer_;
#else
  explicit VisiblePointsOf(const Scene&) {}
  std::vector<glm::dvec3> operator()(const Camera&, const Light&) const {
    return {};
  }
#endif
};

}  // namespace gnomon::tool::fly
