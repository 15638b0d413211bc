// When do texels of a local light's map lie even in angle? A shape that follows the light's rays
// (Shape::round) is set by them.
#pragma once

#include "map/light_body.hpp"

namespace gnomon {

/// Such texels of one map.
struct RoundTexels {
  bool used = false;
  PlaneMap plane;                // with the rectangle that the whole map shows
  ShapeParameters parameters{};  // of OpenGL's clip space
  double border = 0.0;           // how far that reaches beyond the body's rectangle, over the body's, at most
  glm::dvec2 longest{1.0};       // texels along x and y over linear ones, at most
};

/// Round texels where they lower the objective over the body. `result`: its map has size and margin; it gets
/// the shape, or the reason why not.
[[nodiscard]] RoundTexels round_texels(const PlanContext& c, const MapRequest& request, const LightBody& body,
                                       const PlaneMap& plane, MapResult& result) noexcept;

}  // namespace gnomon
