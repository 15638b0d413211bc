// The aliasing error at many points side by side, so that vector units work on several at once.
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "gnomon/camera.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/plan.hpp"
#include "lanes/lanes.hpp"

namespace gnomon {

/// Points a block holds: enough to fill vectors, few enough for all lanes to stay in the first-level cache.
inline constexpr std::size_t kMetricLanes = 6 * kDoubleLanes;
using Lanes = std::array<double, kMetricLanes>;

struct VectorLanes {
  Lanes x, y, z;
  void set(std::size_t i, const glm::dvec3& v) noexcept {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
  [[nodiscard]] glm::dvec3 operator[](std::size_t i) const noexcept { return {x[i], y[i], z[i]}; }
};

/// What all points of a map share.
struct MetricFrame {
  MetricFrame(const ShadowMap& map, const Camera& camera, const CameraAxes& axes) noexcept;

  glm::dmat4 clip_from_world;
  TexelGrid texels;
  glm::dvec3 eye, forward;
  glm::dvec3 pixel_x, pixel_y;  ///< d(world)/d(pixel) per unit of depth; orthographic: as it stands
  glm::dvec4 light_world;
  bool light_from_matrix;  ///< light_world is not the light of the matrix
  double light_sense;      ///< for light_from_matrix: 1 or -1, of the gradients' cross product
  bool orthographic;
};

/// Extents of a texel, as in PointAliasing.
struct ExtentLanes {
  Lanes longest, shortest, s, t, area, anisotropy;
};

/// A block of points on its way: fill `point` (and `normal`, for judge_surface) of the first `count`.
struct MetricBlock {
  VectorLanes point, normal;
  VectorLanes eye_ray, light_ray;  ///< unit, away from the eye and from the light
  Lanes depth;                     ///< that pixel_x and pixel_y grow by; 1 for an orthographic camera
  Lanes ndc_x, ndc_y;              ///< where the map shows the point
  Lanes inverse_w;
  std::array<Lanes, 4> shape;    ///< d(texel)/d(ndc): x by x, x by y, y by x, y by y
  VectorLanes texel_x, texel_y;  ///< d(texel)/d(world)
  Lanes inside;                  ///< > 0 where the map holds the point
  Lanes sum2;                    ///< squared length of the sum of both rays
  ExtentLanes perspective;
  Lanes cos_eye, cos_light;  ///< of the normal with the ways back to the eye and to the light
  ExtentLanes surface;
};

/// On the surface that faces the half vector of eye and light: everything but the last two lines.
void judge_perspective(const MetricFrame& frame, MetricBlock& block, std::size_t count) noexcept;
/// On the surface with `normal`, after judge_perspective.
void judge_surface(const MetricFrame& frame, MetricBlock& block, std::size_t count) noexcept;

}  // namespace gnomon
