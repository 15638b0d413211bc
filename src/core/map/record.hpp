// Everything of a map's record that follows from its plane, its matrix and its swept body.
#pragma once

#include "cull/sweep.hpp"
#include "map/light_body.hpp"
#include "map/texel_shape.hpp"

namespace gnomon {

/// What a map's record is made from.
struct MapParts {
  const LightBody& body;
  const PlaneMap& plane;
  const SweptBody& swept;
  const TexelsNeeded& needed;
  const RowShape& rows;
  double obliquity;
  const glm::dmat4& gl_from_relative;
  glm::dvec2 longest{1.0};  // texels of the shape along x and y over those that plane and rows give, at most
};

/// Fills in `map`, whose size, border and shape, of OpenGL's clip space, are set.
void complete_record(const PlanContext& c, const MapRequest& request, const MapParts& parts,
                     ShadowMap& map) noexcept;

/// A record with what was decided before fitting.
void begin_record(const PlanContext& c, const MapRequest& request, ShadowMap& map) noexcept;

/// World space from what is relative to the camera.
[[nodiscard]] glm::dmat4 world_matrix(const glm::dmat4& from_relative, const glm::dvec3& eye_world) noexcept;

}  // namespace gnomon
