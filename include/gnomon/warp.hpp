// The warp: where in the map the texels go. A warp looks at the body in the light's plane and answers with a
// map of that plane; the plan measures it and falls back to none where it gains nothing.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "gnomon/body.hpp"

namespace gnomon {

/// What a parametrization is judged by. All are to be made small.
enum class Objective : std::uint8_t {
  storage,  ///< max m_s times max m_t: texels needed per pixel for m <= 1 along both axes everywhere
  max,      ///< the worst texel
  p95,      ///< the error that 95 % of what is seen stay below: pixels evenly, depths by their logarithm
};
[[nodiscard]] std::string_view to_string(Objective objective) noexcept;
[[nodiscard]] bool objective_from_name(std::string_view name, Objective& objective) noexcept;

/// A perspective camera in the light frame: axes, edges of the image and size of a pixel per unit of depth.
struct ViewInLight {
  glm::dvec3 right, up, forward;
  double image_left, image_right, image_bottom, image_top;
  double pixel_x, pixel_y;
};

/// The body as a warp sees it. Light frame: x, y span the plane across the light, y along the view
/// direction's projection (away from the viewer), z towards the light; the origin is the camera position.
struct WarpInput {
  struct Point {
    double x, y, z;  ///< light frame, world units
    double depth;    ///< view depth, world units; 1 for an orthographic camera
  };
  std::span<const Point> body;  ///< vertices of the visible receivers' body, at least one
  double y_min, y_max;          ///< of the body, along the view direction's projection
  double sin_gamma,
      cos_gamma;  ///< of the angle between view and light direction, from their cross and dot product
  double depth_begin, depth_end;  ///< view depths of the slice, after near_hint
  double tan_half_fov;            ///< effective half opening in the plane of view and light
  bool orthographic;              ///< then there is no perspective to undo
  Objective objective;
  const Polytope* polytope;  ///< the same body with its faces and edges, in the light frame
  /// What of the body error counts `focus_weight` times in; nullptr or empty where there is none. `body` then
  /// has its vertices, too, and all others are `focus_weight` times as deep as they are.
  const Polytope* focus;
  double focus_weight;
  ViewInLight view;
};

/// The answer: a projective map of the light plane. With u the distance along `axis` from the body's near end
/// and s the coordinate across it, w = 1 + kappa u, and the point lands at X = (s - centre) / w, Y = u (1 +
/// kappa length) / w. The map's axes are A = dot(row_a, (X, Y)) and B = dot(row_b, (X, Y)); a rectangle in
/// them round the body's image becomes the map. Every perspective of parallel light rays is of this form.
struct WarpChoice {
  double kappa = 0.0;          ///< 1 / world units, >= 0; 0 is the orthographic map itself
  glm::dvec2 axis{0.0, 1.0};   ///< unit, where texels grow to, in the light frame's x and y
  double centre = 0.0;         ///< of the projection, across the axis, world units
  glm::dvec2 row_a{1.0, 0.0};  ///< with row_b: turns or slants the map; any two independent vectors
  glm::dvec2 row_b{0.0, 1.0};
  /// The objective over that of no warp, where the warp has measured it by itself; 0: the plan measures it.
  double gain_ratio = 0.0;
};

/// One entry of the registry warps.def.
struct Warp {
  std::string_view name;
  std::string_view summary;
  WarpChoice (*choose)(const WarpInput& input) noexcept;
  /// True where the plan may drop the warp because it does not lower the objective. False only for warps kept
  /// to reproduce a paper as it stands.
  bool drop_without_gain;
};

/// All warps, in the order of warps.def.
[[nodiscard]] std::span<const Warp* const> all_warps() noexcept;
/// nullptr where there is none of that name.
[[nodiscard]] const Warp* find_warp(std::string_view name) noexcept;

namespace warps {
#define GNOMON_WARP(name) extern const Warp name;
#include "gnomon/warps.def"
#undef GNOMON_WARP
}  // namespace warps

/// Bounds of the perspective error over a body under w = 1 + kappa (y - y_min): exact at vertices, because
/// each weight is linear-fractional or convex there (Lloyd's m with the simplified weights, Scherzer et al.
/// 2011, section 3). For warps along y only; fast.
struct WarpError {
  double m_s, m_t;  ///< relative: multiply by pixels per unit slope over texels for the error itself
  [[nodiscard]] double value(Objective objective) const noexcept {
    return objective == Objective::storage ? m_s * m_t : (m_s > m_t ? m_s : m_t);
  }
};
[[nodiscard]] WarpError warp_error(const WarpInput& input, double kappa) noexcept;

}  // namespace gnomon
