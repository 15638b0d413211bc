// How deep a map is along the light: the receivers and every caster that can shadow them.
#include "map/depths.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/light_space.hpp"
#include "gnomon/extend/warp.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"
#include "lanes/elementary.hpp"
#include "lanes/pair.hpp"
#include "lanes/point_pair.hpp"
#include "map/size.hpp"

namespace gnomon {
namespace {

// Room beyond the nearest and farthest depth, relative to the range: float rounding in the shader must not
// push a surface out of the map.
constexpr double kDepthPadding = 1.0 / 1024.0;
// Least depth range of a map, relative to its extents across: a flat scene still needs one.
constexpr double kFlattestDepth = 1e-3;
// Faces of a box steeper than this to the light bound nothing: their height changes by more than the scene's
// size.
constexpr double kSteepestFace = 1e-6;
// Near over far distance of a local light's map whose depths are not fitted: 2^10, as engines tend to ask
// for.
constexpr double kLooseNear = 0x1p-10;

/// The heights of faces over the light plane: `at` + slope_x x + slope_y y.
template <std::size_t count>
struct Faces {
  std::array<double, count> at{}, slope_x{}, slope_y{};
};

/// Of two points of the body: 1 / w at the near side of their border, how far the border reaches in the light
/// plane.
struct Bordered {
  Pair inverse_w, margin;
};

/// What a warp's w is at points, and how far they lie beside its axis.
struct WarpedPlace {
  Pair w, across;
};
WarpedPlace warped_place(const PlaneMap& map, const PointPair& p) noexcept {
  const WarpChoice& choice = map.choice;
  const Pair axis_x(choice.axis.x), axis_y(choice.axis.y);
  return {Pair(1.0) + Pair(choice.kappa) * (p.x * axis_x + p.y * axis_y - Pair(map.u_min)),
          abs(p.x * axis_y - p.y * axis_x - Pair(choice.centre))};
}

/// Of rows that undo the warp: the same texels are the same growth of w anywhere.
Bordered bordered_rows(const PlaneMap& map, const MapBorder& border, double growth,
                       const PointPair& p) noexcept {
  const Pair one(1.0), kappa(map.choice.kappa);
  const auto [w, across] = warped_place(map, p);
  const Pair margin_across = Pair(border.share * (map.a_max - map.a_min)) * w * Pair(1.0 + growth);
  const Pair margin_along = Pair(growth) * w / kappa;
  return {Pair(1.0 + growth) / w, margin_across + margin_along * (one + kappa * across / w)};
}

Bordered bordered(const PlaneMap& map, double margin_image, const PointPair& p) noexcept {
  const Pair one(1.0), kappa(map.choice.kappa), margin(margin_image);
  const auto [w, across] = warped_place(map, p);
  // A move by the border in the image is at most this one in the light plane: across, texels grow with w
  // and lean with the distance from the centre; along, with its square.
  const Pair margin_along = margin * w * w / Pair(map.stretch);
  // The border reaches towards smaller w, too; it never halves it for a border a filter can ask for.
  return {one / max_of(w - kappa * margin_along, Pair(0.5) * w),
          margin * w + margin_along * (one + kappa * across / w)};
}

double larger(Pair p) noexcept {
  return max_of(p.low(), p.high());
}

/// highest_over without a warp, where 1 / w is 1 and the border reaches as far everywhere.
template <std::size_t count>
double highest_unwarped(const FittedPlane& f, double bottom, const Faces<count>& faces,
                        const std::array<double, count>& steepest) noexcept {
  const double margin = 2.0 * border_in_image(f.plane, f.border.share);
  std::array<Pair, count> at, slope_x, slope_y, highest;
  for (std::size_t k = 0; k < count; ++k) {
    at[k] = Pair(faces.at[k]);
    slope_x[k] = Pair(faces.slope_x[k]);
    slope_y[k] = Pair(faces.slope_y[k]);
    highest[k] = Pair(-std::numeric_limits<double>::infinity());
  }
  for_each_two<PointPair>(f.body.points(), [&](std::size_t, const PointPair& p) {
    for (std::size_t k = 0; k < count; ++k)
      highest[k] = max_of(highest[k], at[k] + slope_x[k] * p.x + slope_y[k] * p.y);
  });
  // What is added to all alike may come last: rounding keeps their order.
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count; ++k)
    least = min_of(least, max_of(0.0, larger(highest[k]) + steepest[k] * margin - bottom));
  return max_of(least, max_of(0.0, f.body.bounds.z_max - bottom));
}

/// Largest (z - bottom) / w over the body and its border, of the body itself or, where that is more, of the
/// face on which it is least.
template <std::size_t count>
double highest_over(const FittedPlane& f, double bottom, const Faces<count>& faces) noexcept {
  std::array<double, count> steepest;
  for (std::size_t k = 0; k < count; ++k)
    steepest[k] = std::sqrt(faces.slope_x[k] * faces.slope_x[k] + faces.slope_y[k] * faces.slope_y[k]);
  const bool rows = f.border.log_w > 0.0;
  if (!rows && f.plane.choice.kappa == 0.0) return highest_unwarped(f, bottom, faces, steepest);
  const double margin_image = border_in_image(f.plane, f.border.share);
  const double growth = rows ? elementary::expm1(f.border.log_w) : 0.0;
  std::array<Pair, count> highest;
  highest.fill(Pair(0.0));
  Pair of_body(0.0);
  const Pair low(bottom);
  for_each_two<PointPair>(f.body.points(), [&](std::size_t, const PointPair& p) {
    const Bordered b =
        rows ? bordered_rows(f.plane, f.border, growth, p) : bordered(f.plane, margin_image, p);
    of_body = max_of(of_body, (p.z - low) * b.inverse_w);
    for (std::size_t k = 0; k < count; ++k) {
      const Pair z = Pair(faces.at[k]) + Pair(faces.slope_x[k]) * p.x + Pair(faces.slope_y[k]) * p.y +
                     Pair(steepest[k]) * b.margin;
      highest[k] = max_of(highest[k], (z - low) * b.inverse_w);
    }
  });
  double least = larger(highest[0]);
  for (const Pair& h : highest) least = min_of(least, larger(h));
  return max_of(least, larger(of_body));
}

/// Upper bound of (z - bottom) / w over every caster point above the body: along parallel light, the casters'
/// box ends at the lowest of its faces towards the light, and a face's height over the body is largest at one
/// of the body's vertices, w being positive there.
double caster_height(const CasterReach& reach, const LightFrame& frame, const FittedPlane& f,
                     double bottom) noexcept {
  const glm::dvec3 up = frame.z;
  const glm::dvec3 corner{up.x > 0.0 ? reach.bounds.max.x : reach.bounds.min.x,
                          up.y > 0.0 ? reach.bounds.max.y : reach.bounds.min.y,
                          up.z > 0.0 ? reach.bounds.max.z : reach.bounds.min.z};
  // First the plane across the light through the highest caster, also in the place of faces along the light.
  Faces<4> faces;
  faces.at.fill(reach.top);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(up[axis]) > kSteepestFace)) continue;
    // Compilers divide before they choose, too (lanes/wide.hpp). This changes no bit of what is steep enough.
    constexpr double kNothing = 1e-280;
    const double inverse = 1.0 / (up[axis] + kNothing);
    const auto k = static_cast<std::size_t>(axis) + 1;
    faces.at[k] = corner[axis] * inverse;
    faces.slope_x[k] = -frame.x[axis] * inverse;
    faces.slope_y[k] = -frame.y[axis] * inverse;
  }
  return highest_over(f, bottom, faces);
}

HeightRange parallel_heights(const PlanContext& c, const MapRequest& request, const FittedPlane& f) noexcept {
  const LightFrame& frame = request.space.frame;
  HeightRange range;
  CasterReach reach = casters_inside(f.swept.planes(), c.bounds.casters, c.camera.position, frame.z);
  range.has_casters = reach.any;
  if (!reach.any) {
    // A map for no caster at all is as deep as its receivers.
    reach = {bounds_of(request.body), f.body.bounds.z_max, false};
  }
  range.bottom = f.body.bounds.z_min;
  if (!c.options.prune.has(PruneRule::light_depths)) {
    const CasterReach all = casters_inside({}, c.bounds.casters, c.camera.position, frame.z);
    if (all.any) reach = all;
    range.bottom =
        min_of(range.bottom, -casters_inside({}, c.bounds.receivers, c.camera.position, -frame.z).top);
  }
  range.height = caster_height(reach, frame, f, f.measured_from.value_or(range.bottom));
  return range;
}

HeightRange perspective_heights(const PlanContext& c, const MapRequest& request,
                                const FittedPlane& f) noexcept {
  const LightFrame& frame = request.space.frame;
  const glm::dvec3 apex =
      frame.x * request.space.apex.x + frame.y * request.space.apex.y + frame.z * request.space.apex.z;
  HeightRange range;
  double far_distance = f.body.farthest * (1.0 + kDepthPadding);
  const double least = kLeastNearShare * f.body.farthest,
               stand_in = c.options.light_near_share * f.body.farthest;
  const NearBoxes casters = nearest_inside(f.swept.planes(), request.body, c.bounds.casters,
                                           c.camera.position, frame.z, apex, least);
  range.has_casters = casters.too_near > 0 || casters.nearest < std::numeric_limits<double>::infinity();
  range.too_near = casters.too_near;
  const double nearest = casters.too_near > 0 ? min_of(casters.nearest, stand_in) : casters.nearest;
  // A single distance still needs a range: rounding of float over it.
  double near_distance =
      min_of(f.body.nearest * (1.0 - kDepthPadding), far_distance * (1.0 - kFlattestDepth));
  near_distance = min_of(near_distance, max_of(nearest * (1.0 - kDepthPadding), least));
  if (!c.options.prune.has(PruneRule::light_depths)) {
    far_distance = max_of(far_distance, request.range * (1.0 + kDepthPadding));
    near_distance = min_of(near_distance, kLooseNear * far_distance);
  }
  if (c.how.stable) {
    // Whole powers of two, so that stored depths do not change while the nearest caster moves a little.
    near_distance = std::ldexp(1.0, std::ilogb(near_distance));
    far_distance = request.range * (1.0 + kDepthPadding);
  }
  range.nearest = near_distance;
  range.nearest_caster = casters.too_near > 0 ? least : nearest;
  range.bottom = 1.0 / far_distance;
  const double from = f.measured_from.value_or(range.bottom);
  range.height = highest_over(f, from, Faces<1>{{1.0 / near_distance}});
  return range;
}

}  // namespace

HeightRange height_range(const PlanContext& c, const MapRequest& request,
                         const FittedPlane& fitted) noexcept {
  return request.space.perspective ? perspective_heights(c, request, fitted)
                                   : parallel_heights(c, request, fitted);
}

LightDepths padded(double bottom, double height, double extent) noexcept {
  const double range = max_of(height, kFlattestDepth * extent);
  return {bottom - kDepthPadding * range, range * (1.0 + 2.0 * kDepthPadding)};
}

void sweep_for(const PlanContext& c, const MapRequest& request, const LightBody& body, const PlaneMap& plane,
               const MapBorder& border, SweptBody& swept) noexcept {
  // The border at the far end, where texels are largest: across they grow with w, along with w^2 / stretch =
  // w there, and w itself grows over the border. Under a local light a step in slopes is that step times the
  // distance, at most.
  constexpr double kNearestHorizon = 0.1;
  const double growth = plane.stretch / max_of(1.0 - border.share * (plane.stretch - 1.0), kNearestHorizon);
  double reach = border_in_image(plane, border.share) * growth;
  if (border.log_w > 0.0) {
    reach = 0.0;
    const double growth_of_w = elementary::expm1(border.log_w);
    for_each_two<PointPair>(body.points(), [&](std::size_t, const PointPair& p) {
      reach = max_of(reach, larger(bordered_rows(plane, border, growth_of_w, p).margin));
    });
  }
  reach *= body.farthest;
  const glm::dvec4 light = request.space.light();
  const LightFrame& frame = request.space.frame;
  sweep(request.body, glm::dvec4(frame.x * light.x + frame.y * light.y + frame.z * light.z, light.w), reach,
        c.camera.position, swept);
}

}  // namespace gnomon
