// Where does the camera see a surface on which the light could fall?
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/trace/tracer.hpp"

namespace gnomon::trace {

/// What rays through the centres of columns x rows equal parts of the image first hit between the camera's
/// near and far depth, row by row, for SceneDetail and measure_seen. Surfaces that are turned from the light
/// or that it does not reach are left out: no shadow map is asked about them. Empty without columns or rows.
[[nodiscard]] std::vector<glm::dvec3> seen_points(const Tracer& tracer, const Camera& camera,
                                                  const Light& light, int columns = 64, int rows = 36);

}  // namespace gnomon::trace
