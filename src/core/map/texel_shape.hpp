// How do a map's texels lie? Rows that undo the warp, texels round a light, or columns and rows that serve
// visible points: by the shape that the options name, where that lowers the error.
#pragma once

#include "gnomon/extend/warp.hpp"
#include "map/context.hpp"
#include "map/light_body.hpp"
#include "warp/plane_map.hpp"

namespace gnomon {

/// Rows of one map.
struct RowShape {
  const Shape* shape = &shapes::linear;
  double log_growth = 0.0;  // logarithm of w at the rectangle's far end over w at its near end

  [[nodiscard]] bool bent() const noexcept { return !shape->affine; }
  /// How much longer a row is at a point of the light plane than rows of one size over the rectangle.
  [[nodiscard]] double lengthening(const PlaneMap& plane, double x, double y) const noexcept;
};

/// Linear where the requested shape is of no use to a map of this plane. `border`: share of the map's height
/// that it keeps free at either end.
[[nodiscard]] RowShape row_shape(const PlanContext& c, const PlaneMap& plane, double border) noexcept;
/// Weakens a warp to the strongest that a shape can undo.
void limit_to_shape(const PlanContext& c, std::span<const WarpInput::Point> body, PlaneMap& plane) noexcept;
/// From what linear texels need to what these need.
void texels_needed(const RowShape& rows, std::span<const WarpInput::Point> body, const PlaneMap& plane,
                   TexelsNeeded& needed) noexcept;

/// The plane with a border along y in its rectangle, as rows of the shape leave it, and the parameters.
struct BorderedPlane {
  PlaneMap plane;
  ShapeParameters parameters;
  double log_w = 0.0;  // logarithm of w's growth over the border at either end
};
[[nodiscard]] BorderedPlane with_border(const RowShape& rows, const PlaneMap& plane, double border) noexcept;

/// Texels of one map that lie even in angle round a local light.
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

/// Sets the map's shape by the points visible in its depths, where that lowers the objective. `map` has its
/// size and margin; `gl_from_relative`: its matrix for linear texels, from points relative to the camera.
/// Returns how much longer the longest texels become along x and y.
[[nodiscard]] glm::dvec2 serve_visible(const PlanContext& c, const MapRequest& request,
                                       const glm::dmat4& gl_from_relative, MapResult& result) noexcept;

}  // namespace gnomon
