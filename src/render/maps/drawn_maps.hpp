// How are casters drawn into the maps of a frame, so that an unchanged map gets the same bits again?
#pragma once

#include <array>
#include <glm/mat4x4.hpp>

#include "gnomon/plan.hpp"

namespace gnomon::render {

/// How casters are drawn into one map: from positions relative to DrawnMaps::origin_world.
struct DrawnMap {
  glm::mat4 clip_from_position{1.0f};
  int width = 0, height = 0;
  glm::mat4 shape{0.0f};    ///< as shaders take it
  bool bent = false;        ///< the shape bends lines: triangles are drawn by bounding rectangles
  float even_scale = 0.0f;  ///< of clip z to depths that are even along the light; 0: divided by w
  bool operator==(const DrawnMap&) const = default;
};
struct DrawnMaps {
  glm::dvec3 origin_world{0.0};
  std::array<DrawnMap, kMaxMaps> map;
};
/// Whether the map shows the scene as a mirror does. Its depth grows away from the light in either case.
[[nodiscard]] bool is_mirrored(const glm::mat4& clip_from_position) noexcept;
/// `step`: the origin is the camera's position to the nearest multiple of it, so that it stays where it is
/// while the camera moves a little, and with it every bit of a map that does.
[[nodiscard]] DrawnMaps drawn_maps(const ShadowPlan& plan, const glm::dvec3& camera_world,
                                   double step) noexcept;

}  // namespace gnomon::render
