// The warp: where in the map the texels go. A warp reads the body in the light plane and returns a map of
// that plane; the plan measures it and falls back to none where it gains nothing.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/light_space.hpp"
#include "gnomon/options.hpp"

namespace gnomon {

struct HeldDepths;

/// The camera along the light frame's axes. Its own axes, edges of the image, and size of a pixel per unit of
/// depth (orthographic: in world units).
struct ViewInLight {
  glm::dvec3 right, up, forward;                            ///< unit
  double image_left, image_right, image_bottom, image_top;  ///< as Camera::left and so on
  double pixel_x, pixel_y;                                  ///< slopes, or world units where orthographic
};

/// A projective map of the light plane. u is the distance along `axis` from the body's near end, s the
/// coordinate across it, and w = 1 + kappa u. The point lands at X = (s - centre) / w, Y = u (1 + kappa
/// length) / w. The map's axes are A = dot(row_a, (X, Y)) and B = dot(row_b, (X, Y)); a rectangle in them
/// round the body's image becomes the map. Every perspective of parallel light rays is of this form.
struct WarpChoice {
  double kappa = 0.0;          ///< 1 / unit of the light plane, >= 0; 0 is the map without a warp
  glm::dvec2 axis{0.0, 1.0};   ///< unit, where texels grow to, in the light plane
  double centre = 0.0;         ///< of the projection, across the axis
  glm::dvec2 row_a{1.0, 0.0};  ///< with row_b: turns or slants the map; any two independent vectors
  glm::dvec2 row_b{0.0, 1.0};  ///< with row_a
  /// The objective over that of no warp, where the warp has measured it itself; 0: the plan measures it.
  double gain_ratio = 0.0;
  /// The objective of WarpStart::map over that of no warp, infinite without such a map; 0: not measured.
  double last_ratio = 0.0;
  bool followed = false;  ///< found from WarpStart::best on
};

/// How a search uses the last frame's warp.
enum class StartUse : std::uint8_t {
  none,     ///< not at all: the search begins from nothing
  keep,     ///< returns it as it is: the ratios that were measured still hold
  measure,  ///< measures it again and returns it
  search,   ///< goes on from it
};

/// The last frame's warp and map in this frame's light plane, where a search may start. Rows may have any
/// length.
struct WarpStart {
  StartUse use = StartUse::none;  ///< what the search does with the last result
  WarpChoice best;                ///< what the last frame's search returned, with its ratios
  WarpChoice map;                 ///< the map that was drawn, which changes in small steps only
  bool has_map = false;           ///< `map` is known and can be drawn again; StartUse::keep needs none
  /// 1 + kappa length of the strongest warp whose texels change smoothly under the camera's motion; infinite
  /// where nothing moves.
  double most_stretch = std::numeric_limits<double>::infinity();
};

/// The body as a warp sees it. The light plane's x and y (light_space.hpp) span the map; y runs along the
/// view direction as the light sees it, away from the viewer. Parallel light: the origin is the camera's
/// position.
struct WarpInput {
  /// A vertex of the body, in light space.
  struct Point {
    double x, y;   ///< light plane
    double z;      ///< height towards the light: h of LightSpace
    double depth;  ///< extent in the light plane of a unit slope of the image: view depth (orthographic: 1)
                   ///< over distance from a local light. Infinite where the map must hold the point and its
                   ///< error does not count: nearer than pseudo_near
  };
  std::span<const Point> body;    ///< vertices of the visible receivers' body, at least one
  double y_min, y_max;            ///< of the body
  double sin_gamma, cos_gamma;    ///< of the angle between view and light ray
  double depth_begin, depth_end;  ///< view depths of the slice, after pseudo_near, world units
  double tan_half_fov;            ///< effective half opening in the plane of view and light
  bool orthographic;              ///< the camera is
  Objective objective;            ///< error to minimise
  const Polytope* polytope;       ///< the same body with its faces and edges, along the light frame's axes
  /// Sub-volume whose error is weighted by focus_weight; nullptr or empty: none. `body` then includes its
  /// vertices, and all others count as focus_weight times as deep as they are.
  const Polytope* focus;
  double focus_weight;  ///< 1 or more
  ViewInLight view;     ///< the camera
  LightSpace light;     ///< how points become light-plane coordinates
  double centre;       ///< x of the line along y that warps along the view project from; 0 for parallel light
  double scale_near;   ///< Point::depth at the body's point nearest to the viewer
  double depth_per_y;  ///< growth of Point::depth along y at constant height
  WarpChoice unwarped;       ///< the map without a warp, to be beaten
  double pseudo_near = 0.0;  ///< view depth from which error counts; 0: everywhere
  /// 1 + kappa length of the strongest warp that a map can take: beyond it the plan drops the warp.
  double most_stretch = 1e9;
  /// The plane that plane_optimal serves, along the light frame's axes; nullptr: the body's face that lies
  /// largest under the light.
  const Plane* receiver = nullptr;
  /// Points of visible surfaces inside the body, along the light frame's axes, each for an equal share of the
  /// image: what Objective::picture counts. Not empty where `objective` is that.
  std::span<const glm::dvec3> seen = {};
  /// Where boxes of receivers are, for the searches of core: the body holds air between them. They count
  /// points in boxes by Objective::p95, and compare other warps there by max. nullptr: only the body is
  /// known.
  const HeldDepths* held = nullptr;
  /// Where a search may begin, in place of at everything; nullptr: nothing is known.
  const WarpStart* start = nullptr;

  /// Neither camera nor light has a perspective to undo.
  [[nodiscard]] bool flat() const noexcept { return orthographic && !light.perspective; }
  /// The choice is the map without a warp.
  [[nodiscard]] bool is_unwarped(const WarpChoice& choice) const noexcept {
    return choice.kappa == 0.0 && choice.axis == unwarped.axis && choice.row_a == unwarped.row_a;
  }
  /// A warp along y of this strength.
  [[nodiscard]] WarpChoice along_view(double kappa) const noexcept {
    WarpChoice choice;
    choice.kappa = kappa;
    choice.centre = centre;
    return choice;
  }
};

/// A linear function of the light-space point (x, y, h).
struct LightLinear {
  glm::dvec3 slope;  ///< per unit of x, y and h
  double constant;   ///< value at the origin
};
/// In light space, what is `offset` + dot(`slope`, p) for points along the light frame's axes. Under a local
/// light divided by the distance from the light, which keeps every zero and every ratio of two such
/// functions.
[[nodiscard]] LightLinear light_linear(const LightSpace& light, const glm::dvec3& slope,
                                       double offset) noexcept;

/// Whether texels needed are what bounds over a body count for this objective; else the longest extent.
[[nodiscard]] constexpr bool counts_texels(Objective objective) noexcept {
  return objective == Objective::storage || objective == Objective::picture;
}

/// Bounds of the perspective error over a body under w = 1 + kappa (y - y_min). Exact at vertices, because
/// each weight is linear-fractional or convex there (Lloyd's m with the simplified weights, Scherzer et al.
/// 2011, section 3). For warps along y through input.centre only; fast.
struct WarpError {
  double m_s, m_t;  ///< relative: multiply by pixels per unit slope over texels for the error itself
  /// The bound of this objective. A bound over the body says nothing of `picture`: texels stand for it.
  [[nodiscard]] double value(Objective objective) const noexcept {
    return counts_texels(objective) ? m_s * m_t : (m_s > m_t ? m_s : m_t);
  }
};
[[nodiscard]] WarpError warp_error(const WarpInput& input, double kappa) noexcept;

}  // namespace gnomon
