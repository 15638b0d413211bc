// Where does the camera see a surface on which the light could fall?
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/trace/tracer.hpp"

namespace gnomon::trace {

/// Visible points for View::points_world: first hits of rays between the camera's near and far
/// depth. The rays go through the centres of columns x rows equal parts of the image, row by row. Surfaces
/// that face away from the light or lie beyond it are omitted: no shadow map serves them. Empty without
/// columns or rows.
[[nodiscard]] std::vector<glm::dvec3> seen_points(const Tracer& tracer, const Camera& camera,
                                                  const Light& light, int columns = 64, int rows = 36);

}  // namespace gnomon::trace
