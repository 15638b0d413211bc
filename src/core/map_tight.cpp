// The smallest map round a slice's receivers, warped where that gains.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "least_rectangle.hpp"
#include "light_plane_error.hpp"
#include "map_parts.hpp"
#include "vector.hpp"

namespace gnomon {
namespace {

/// Half opening of the frustum in the plane of view and light: the largest slope of a corner along it.
double tan_half_fov(const PlanContext& c) noexcept {
  const glm::dvec3 across = c.frame.y - c.axes.forward * glm::dot(c.frame.y, c.axes.forward);
  const glm::dvec3 w = safe_normalize(across, c.axes.up);
  const double x = std::abs(glm::dot(w, c.axes.right)), y = std::abs(glm::dot(w, c.axes.up));
  return x * max_of(std::abs(c.camera.left), std::abs(c.camera.right)) +
         y * max_of(std::abs(c.camera.bottom), std::abs(c.camera.top));
}

ViewInLight view_in_light(const PlanContext& c) noexcept {
  const Camera& camera = c.camera;
  const auto turned = [&](const glm::dvec3& v) {
    return glm::dvec3(glm::dot(c.frame.x, v), glm::dot(c.frame.y, v), glm::dot(c.frame.z, v));
  };
  return {turned(c.axes.right),
          turned(c.axes.up),
          turned(c.axes.forward),
          camera.left,
          camera.right,
          camera.bottom,
          camera.top,
          (camera.right - camera.left) / camera.width,
          (camera.top - camera.bottom) / camera.height};
}

/// The body as warps see it; `body_light` is the body in the light frame.
WarpInput warp_input(const PlanContext& c, const LightBody& points, const Polytope& body_light, double begin,
                     double end) noexcept {
  WarpInput in{};
  in.body = points.points();
  in.y_min = in.y_max = points.point[0].y;
  for (const WarpInput::Point& p : in.body) {
    in.y_min = min_of(in.y_min, p.y);
    in.y_max = max_of(in.y_max, p.y);
  }
  in.sin_gamma = c.sin_gamma;
  in.cos_gamma = c.cos_gamma;
  in.depth_begin = max_of(begin, c.options.near_hint);
  in.depth_end = max_of(end, in.depth_begin);
  in.tan_half_fov = tan_half_fov(c);
  in.orthographic = c.camera.orthographic;
  in.objective = c.options.objective;
  in.polytope = &body_light;
  in.view = view_in_light(c);
  return in;
}

// A body shorter along the axis than this much of its other extents, or of its distance, has its length from
// rounding, and a warp's strength from it would be noise.
constexpr double kShortest = 1e-6, kShortestOfDistance = 1e-9;
// Ratio of the far to the near end's texels beyond which float matrices no longer hold the map together.
constexpr double kStrongest = 1e9;
// A gain by the simplified weights above this factor is one by the exact error, too: they differ by the
// obliquity of the view rays alone.
constexpr double kCertainRatio = 0.25;

// A warp that gains less than this is left out: it would come and go with the last bits of the input.
constexpr double kLeastGain = 1e-3;

bool usable(const WarpInput& in, const WarpChoice& choice) noexcept {
  const PlaneMap map = plane_map(in.body, choice);
  double farthest = 0.0;
  for (const WarpInput::Point& p : in.body) farthest = max_of(farthest, p.depth);
  const double extent = max_of(map.a_max - map.a_min, map.b_max - map.b_min);
  return map.length > kShortest * extent && map.length > kShortestOfDistance * farthest &&
         map.stretch <= kStrongest;
}

/// The objective with the choice over the objective without; infinite for a choice that no map can be laid
/// with.
double gain_ratio(const WarpInput& in, const WarpChoice& choice) noexcept {
  if (!usable(in, choice)) return std::numeric_limits<double>::infinity();
  const bool along_y =
      choice.axis.x == 0.0 && choice.centre == 0.0 && choice.row_a.y == 0.0 && choice.row_b.x == 0.0;
  if (along_y && choice.kappa == 0.0) return 1.0;
  if (along_y && in.objective != Objective::p95) {
    const double ratio =
        warp_error(in, choice.kappa).value(in.objective) / warp_error(in, 0.0).value(in.objective);
    if (ratio < kCertainRatio) return ratio;
  }
  LightPlaneError error(in);
  return error.value(choice) / error.value({});
}

/// Asks the warp, measures its answer, and takes it only where it lowers the objective.
WarpChoice chosen_warp(const PlanContext& c, const WarpInput& in, int cascade, const Warp*& warp) noexcept {
  if (warp == &warps::none) return {};
  const WarpChoice choice = warp->choose(in);
  const double ratio = gain_ratio(in, choice);
  if (std::isfinite(ratio) && (ratio < 1.0 - kLeastGain || (!warp->drop_without_gain && choice.kappa > 0.0)))
    return choice;
  omit(c.plan, {OmissionKind::warp_without_gain, cascade, ratio, 0.0, 0});
  warp = &warps::none;
  return {};
}

/// The choice with its rectangle turned to the least area, where that lowers the objective.
WarpChoice turned_to_least_area(const WarpInput& in, const WarpChoice& choice) noexcept {
  const PlaneMap map = plane_map(in.body, choice);
  std::array<glm::dvec2, kMaxVertices> image;
  std::size_t count = 0;
  for (const WarpInput::Point& p : in.body) image[count++] = map.image(p.x, p.y);
  const glm::dvec2 side = least_rectangle_side({image.data(), count});
  WarpChoice turned = choice;
  turned.row_a = side;
  turned.row_b = {-side.y, side.x};
  // Without perspective the area is the objective.
  if (in.orthographic) return turned;
  LightPlaneError error(in);
  return error.value(turned) < error.value(choice) * (1.0 - kLeastGain) ? turned : choice;
}

/// The body with vertices and faces in the light frame.
Polytope turned(const Polytope& body, const LightFrame& frame) noexcept {
  Polytope out = body;
  const auto turn = [&](const glm::dvec3& v) {
    return glm::dvec3(glm::dot(frame.x, v), glm::dot(frame.y, v), glm::dot(frame.z, v));
  };
  for (int i = 0; i < body.vertex_count; ++i) {
    out.vertex[static_cast<std::size_t>(i)].position =
        turn(body.vertex[static_cast<std::size_t>(i)].position);
  }
  for (int f = 0; f < body.face_count; ++f) {
    out.plane[static_cast<std::size_t>(f)].normal = turn(body.plane[static_cast<std::size_t>(f)].normal);
  }
  return out;
}

}  // namespace

double tight_objective(const PlanContext& c, const Polytope& body, double begin, double end) noexcept {
  const LightBody points = in_light_frame(c, c.frame, body);
  const Polytope body_light = turned(body, c.frame);
  const WarpInput in = warp_input(c, points, body_light, begin, end);
  const WarpChoice choice = c.warp.choose(in);
  LightPlaneError error(in);
  const double without = error.value({}), with = usable(in, choice) ? error.value(choice) : without;
  return with < without || !c.warp.drop_without_gain ? with : without;
}

bool lay_tight_map(const PlanContext& c, const Polytope& body, double begin, double end,
                   ShadowMap& map) noexcept {
  const LightBody points = in_light_frame(c, c.frame, body);
  const Polytope body_light = turned(body, c.frame);
  const WarpInput in = warp_input(c, points, body_light, begin, end);
  WarpChoice choice = chosen_warp(c, in, map.cascade, map.warp);
  if (c.options.fit == Fit::rotated) choice = turned_to_least_area(in, choice);
  const PlaneMap plane = plane_map(points.points(), choice);
  map.filter_margin_texels = margin_texels(c.options, map.width, share_per_unit(plane, points.points()));
  const double rim = static_cast<double>(map.filter_margin_texels) / map.width;
  const double rim_of_body = rim / (1.0 - 2.0 * rim);
  // A margin at the far end, where texels are largest: across they grow with w, along with w^2 / stretch = w
  // there.
  const double margin_world =
      rim_of_body * plane.stretch * ((plane.a_max - plane.a_min) + (plane.b_max - plane.b_min));
  const SweptBody swept = sweep(c, body, margin_world);
  if (swept.reach.count == 0) return false;
  const double bottom = lowest(points);
  const double height = caster_height(swept.reach, c.frame, points, plane, bottom, rim_of_body);
  const LightDepths depths =
      padded(bottom, height, max_of(plane.a_max - plane.a_min, plane.b_max - plane.b_min));
  map.depth_range_world = depths.height;
  const glm::dmat4 gl_from_relative = clip_from_light(plane, depths, rim) * light_from_relative(c.frame);
  finish_map(c, points, plane, swept, gl_from_relative, map);
  return true;
}

}  // namespace gnomon
