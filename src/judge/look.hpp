// What does one map make of the surfaces in view? The numbers that all checks read, once for each frame.
#pragma once

#include <span>
#include <vector>

#include "judge/capture.hpp"
#include "judge/seen.hpp"

namespace gnomon::judge {

/// Of a map's side in ndc, and of its depths: what a look-up rounds by.
inline constexpr double kRim = 1e-6;

/// A point in a map.
struct Look {
  glm::dvec3 clip{0.0};  ///< after the division by w
  double w = 0.0;
  glm::dvec2 texel{0.0};                  ///< from the map's first corner at ndc -1, -1
  glm::dvec3 along_x{0.0}, along_y{0.0};  ///< gradients of the texel's coordinates, texels per world unit
  glm::dvec3 texel_x{0.0}, texel_y{0.0};  ///< sides of a texel across the light, world units
  double depth_per_world = 0.0;           ///< of 0..1, along the light's travel
  /// True where the map shows the point: in front of the light, and off the rim by no more than rounding.
  [[nodiscard]] bool inside() const noexcept;
};

[[nodiscard]] Look look_at(const CapturedMap& map, const ClipSpace& space, const Light& light,
                           const glm::dvec3& point);

/// The axes of a perspective map, from its matrix alone.
struct PerspectiveAxes {
  bool perspective = false;  ///< false: parallel, and nothing else is set
  glm::dvec3 forward{0.0};   ///< unit
  glm::dvec2 middle{0.0};    ///< where the axis is in the map: ndc
  glm::dvec2 focal{1.0};     ///< 1 over the tangent of half the field of view
};
[[nodiscard]] PerspectiveAxes perspective_axes(const CapturedMap& map) noexcept;

/// All maps of one light over the points of one frame.
struct LightLooks {
  const CapturedFrame* frame = nullptr;
  const CapturedScene* scene = nullptr;
  const SeenSurfaces* seen = nullptr;
  int light = 0;
  std::vector<std::size_t> map;       ///< indices of its maps in the frame
  std::vector<std::vector<Look>> of;  ///< by map of this light, then by point
  std::vector<char> lit;              ///< by point: on the lit side, whatever its depth
  /// By point: on the lit side, no deeper than maps serve, and at a map's depths or within a caster's reach.
  std::vector<char> counts;
  std::vector<int> chosen;   ///< by point: map of this light that the selection takes, -1: none
  std::vector<int> holding;  ///< by point: first map that holds it, in depth, too; -1: none
  [[nodiscard]] MapSelection selection() const { return frame->selection[static_cast<std::size_t>(light)]; }
  [[nodiscard]] const Light& source() const { return frame->lights[static_cast<std::size_t>(light)]; }
  [[nodiscard]] const CapturedMap& map_at(std::size_t i) const { return frame->maps[map[i]]; }
};

[[nodiscard]] LightLooks looks_of(const Capture& capture, const CapturedFrame& frame,
                                  const CapturedScene& scene, const SeenSurfaces& seen, int light);

/// From one point to the next that is tested against every caster: a few points of very many casters tell as
/// much.
[[nodiscard]] std::size_t step_over_casters(std::size_t points, const CapturedScene& scene) noexcept;

/// Radius of the ball round the part of the view at the map's depths, up to `deepest`, world units.
[[nodiscard]] double slice_radius(const CapturedFrame& frame, const CapturedMap& map,
                                  double deepest) noexcept;
/// How far along a way from a point, world units per length of `way`, the map's depth is `depth`, 0..1.
[[nodiscard]] double way_to_depth(const CapturedMap& map, const ClipSpace& space, const glm::dvec3& point,
                                  const glm::dvec3& way, double depth) noexcept;
/// Depth that a clip z becomes, 0 near .. 1 far, whatever the convention.
[[nodiscard]] double depth_of(double z, const ClipSpace& space) noexcept;
/// Whether such a depth is in 0..1, but for rounding.
[[nodiscard]] bool in_range(double depth) noexcept;
/// The middle of the sorted values, or another share of them; 0 of none.
[[nodiscard]] double quantile(std::vector<double> values, double share = 0.5);

}  // namespace gnomon::judge
