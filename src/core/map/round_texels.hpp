// When do texels of a local light's map lie even in angle? A shape that follows the light's rays
// (Shape::round) is set by them.
#pragma once

#include "map/light_body.hpp"

namespace gnomon {

/// Such texels of one map.
struct RoundTexels {
  bool used = false;
  double border = 0.0;      // how far the map reaches beyond the body's rectangle, over the body's, at most
  glm::dvec2 longest{1.0};  // texels along x and y over linear ones, at most
};

/// Round texels where they lower the objective over the body; the options name a shape that has them.
/// `result`: its map has size and margin; it gets the shape, of OpenGL's clip space, or the reason why not.
/// `whole`: the plane with the rectangle that such a map shows.
[[nodiscard]] RoundTexels round_texels(const PlanContext& c, const MapRequest& request, const LightBody& body,
                                       const PlaneMap& plane, MapResult& result, PlaneMap& whole) noexcept;

}  // namespace gnomon
