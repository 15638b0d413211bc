// The pieces that tight and stable maps are laid with.
#pragma once

#include <array>
#include <span>

#include "light_map.hpp"
#include "plan_context.hpp"
#include "visible.hpp"

namespace gnomon {

/// The body's vertices in the light frame, with their view depths.
struct LightBody {
  std::array<WarpInput::Point, kMaxVertices> point;
  int count = 0;
  [[nodiscard]] std::span<const WarpInput::Point> points() const noexcept {
    return {point.data(), static_cast<std::size_t>(count)};
  }
};

[[nodiscard]] LightBody in_light_frame(const PlanContext& c, const LightFrame& frame,
                                       const Polytope& body) noexcept;
/// The body's vertices as warps judge them: with the focus's own, all others as much deeper as they count
/// less. `focus`: the part of the body in the focus, relative to the camera; empty where there is none.
[[nodiscard]] LightBody judged_body(const PlanContext& c, const LightFrame& frame, const Polytope& body,
                                    Polytope& focus) noexcept;
/// Lowest z of the body.
[[nodiscard]] double lowest(const LightBody& body) noexcept;

/// False for a choice that no map can be laid with: too strong for float matrices, or its axis is along a
/// body whose length that way is rounding.
[[nodiscard]] bool usable(const WarpInput& in, const WarpChoice& choice) noexcept;

/// A float offset from the camera is rounded by up to 2^-24 of its length: a rectangle narrower than this
/// much of it has texels, 1024 across, that no shader can tell apart, and one 2^10 times narrower still loses
/// every point it was laid round.
inline constexpr double kLeastOfOffset = 0x1p-14;

/// Texels inside the rim, along the map's width and height, under which the bounds of m over the body are 1.
[[nodiscard]] glm::dvec2 texels_needed(const PlanContext& c, const LightBody& body,
                                       const PlaneMap& plane) noexcept;

/// How far a step of one unit across the light moves a point in the map, at most over the body, as a share of
/// the rectangle's side.
[[nodiscard]] double share_per_unit(const PlaneMap& map, std::span<const WarpInput::Point> body) noexcept;

/// Texels along each side of a map of `size` that no receiver may fall into, with `share` of the map's side
/// without them to a world unit.
[[nodiscard]] int margin_texels(const PlanOptions& options, int size, double share) noexcept;
/// The same for this map of the body, where a world unit is `units` of the plane's.
[[nodiscard]] inline int margin_texels(const PlanOptions& options, int size, const PlaneMap& map,
                                       std::span<const WarpInput::Point> body, double units = 1.0) noexcept {
  const bool world = options.filter_radius_world > 0.0;
  return margin_texels(options, size, world ? share_per_unit(map, body) * units : 0.0);
}

/// What casters reach the body: planes of its sweep towards the light, moved out by `margin_world` so that
/// casters which only a filter's kernel reaches are kept, and the casters inside them.
struct SweptBody {
  std::array<Plane, kMaxCullPlanes> plane;
  int plane_count;
  CasterReach reach;
};
[[nodiscard]] SweptBody sweep(const PlanContext& c, const Polytope& body, double margin_world) noexcept;

/// What a map's depths are laid round: the casters that reach the body, and its lowest z; of the whole scene
/// where PruneRule::light_depths is off.
struct DepthExtent {
  CasterReach reach;
  double bottom;
};
[[nodiscard]] DepthExtent depth_extent(const PlanContext& c, const LightBody& body,
                                       const SweptBody& swept) noexcept;

/// Upper bound of (z - bottom) / w over every caster point above the body: along the light, the casters' box
/// ends at the lowest of its faces towards the light, and a face's height over the body is largest at one of
/// the body's vertices, w being positive there. `rim` is the map's margin as a share of its side, `w_far` the
/// largest w.
[[nodiscard]] double caster_height(const CasterReach& reach, const LightFrame& frame, const LightBody& body,
                                   const PlaneMap& map, double bottom, double rim) noexcept;

/// Depth range [bottom, bottom + height) with room to spare.
[[nodiscard]] LightDepths padded(double bottom, double height, double extent) noexcept;

/// Fills in everything of a map that follows from its plane map, its matrix and its swept body.
void finish_map(const PlanContext& c, const LightBody& body, const PlaneMap& plane, const SweptBody& swept,
                const glm::dmat4& gl_from_relative, ShadowMap& map) noexcept;

}  // namespace gnomon
