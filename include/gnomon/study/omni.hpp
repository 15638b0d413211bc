// All directions round a point light on a few flat maps: cube, dual paraboloid, tetrahedron. Where does a
// direction land, how large is a texel there, and which of the three is best for what a camera sees?
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string_view>

#include "gnomon/light.hpp"
#include "gnomon/metric.hpp"

namespace gnomon {

/// Maps lie fixed in the world: a direction is a world-space offset from the light, of any length but zero.
enum class OmniMapping : std::uint8_t {
  cube,             ///< six squares in the order +x -x +y -y +z -z; projective
  dual_paraboloid,  ///< two discs, map 0 for z >= 0; not projective: straight edges become arcs
  tetrahedron,      ///< four triangles; projective
};
[[nodiscard]] std::string_view to_string(OmniMapping mapping) noexcept;

/// 6, 2 or 4.
[[nodiscard]] int omni_map_count(OmniMapping mapping) noexcept;

/// A place on one of the maps; u and v in [-1, 1] over the map's rectangle, of which a disc or a triangle
/// uses a part.
struct OmniPoint {
  int map = 0;         ///< index of the map, below omni_map_count()
  glm::dvec2 uv{0.0};  ///< in [-1, 1]
};

/// Where a direction lands. On a border the lower map takes it; the zero vector lands anywhere, finite.
[[nodiscard]] OmniPoint omni_from_direction(OmniMapping mapping, const glm::dvec3& direction) noexcept;
/// The unit direction that lands at `point`.
[[nodiscard]] glm::dvec3 direction_from_omni(OmniMapping mapping, const OmniPoint& point) noexcept;

/// Gradients of u and v over the direction: d(uv) / d(offset from the light) at an offset of that length.
/// Across the ray; along it nothing changes.
struct OmniJacobian {
  glm::dvec3 u, v;  ///< per world unit
};
[[nodiscard]] OmniJacobian omni_jacobian(OmniMapping mapping, int map, const glm::dvec3& direction) noexcept;

/// Texels along the sides of each map's rectangle when all maps together have `texels` of them. Squares for
/// the cube and the paraboloids, whose corners outside of the disc are paid for; rectangles of square texels
/// for the tetrahedron, whose triangles are packed head to tail, two to a rectangle.
[[nodiscard]] glm::dvec2 omni_size(OmniMapping mapping, double texels) noexcept;

/// OpenGL clip space of one face of the tetrahedron (0..3) from offsets to the light, with depths from
/// `near_distance` to `far_distance` along the face's axis (0 < near < far). The face is the triangle with
/// corners (-1, -1), (1, -1), (0, 1) of it. A filter's kernel needs the triangle's surroundings, which the
/// matrix shows, too. Based on: Liao, "Shadow Mapping for Omnidirectional Light Using Tetrahedron Mapping",
/// GPU Pro, 2010.
[[nodiscard]] glm::dmat4 tetrahedron_clip_from_light(int face, double near_distance,
                                                     double far_distance) noexcept;

/// Perspective aliasing at a point under `mapping` with `texels` in all: the fields that
/// measure_perspective() fills in, by the same definition. A point on the light counts as outside.
[[nodiscard]] PointAliasing omni_aliasing(OmniMapping mapping, double texels,
                                          const glm::dvec3& light_position, const Camera& camera,
                                          const glm::dvec3& point_world) noexcept;

/// Error over what the camera sees within the light's range, for each mapping; storage as in AliasingStats,
/// summed over the maps.
struct OmniComparison {
  AliasingStats cube, dual_paraboloid, tetrahedron;  ///< each at the same number of texels
};
/// Compares the mappings at an equal number of texels, unfocused: every map shows all of its directions.
/// Samples as measure() does. Zeros where nothing in view is within range.
[[nodiscard]] OmniComparison compare_omni(const PointLight& light, const Camera& camera,
                                          const SceneBounds& bounds, double texels,
                                          const MeasureGrid& grid = {}) noexcept;

}  // namespace gnomon
