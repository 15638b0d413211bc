// The smallest map round a slice's receivers, warped where that gains.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "least_rectangle.hpp"
#include "light_plane_error.hpp"
#include "map_parts.hpp"
#include "plan_budget.hpp"
#include "steady.hpp"
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

/// What warps are asked about a body, with what it refers to.
struct Question {
  Polytope focus, body_light;
  LightBody points;
  WarpInput in;
  Question(const PlanContext& c, const Polytope& body, double begin, double end) noexcept;
  Question(const Question&) = delete;
  Question& operator=(const Question&) = delete;
};

Question::Question(const PlanContext& c, const Polytope& body, double begin, double end) noexcept
    : body_light(turned(body, c.frame)), points(judged_body(c, c.frame, body, focus)), in{} {
  focus = turned(focus, c.frame);
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
  in.focus = &focus;
  in.focus_weight = c.options.focus_weight;
  in.view = view_in_light(c);
}

// A gain by the simplified weights above this factor is one by the exact error, too: they differ by the
// obliquity of the view rays alone.
constexpr double kCertainRatio = 0.25;

// A warp that gains less than this is left out: it would come and go with the last bits of the input.
constexpr double kLeastGain = 1e-3;

/// The objective with the choice over the objective without; infinite for a choice that no map can be laid
/// with.
double gain_ratio(const WarpInput& in, const WarpChoice& choice) noexcept {
  if (!usable(in, choice)) return std::numeric_limits<double>::infinity();
  if (choice.gain_ratio > 0.0) return choice.gain_ratio;
  const bool along_y =
      choice.axis.x == 0.0 && choice.centre == 0.0 && choice.row_a.y == 0.0 && choice.row_b.x == 0.0;
  if (along_y && choice.kappa == 0.0) return 1.0;
  if (along_y && in.objective != Objective::p95) {
    const double ratio =
        warp_error(in, choice.kappa).value(in.objective) / warp_error(in, 0.0).value(in.objective);
    if (ratio < kCertainRatio) return ratio;
  }
  LightPlaneError error(in);
  const double without = error.value({});
  return without > 0.0 ? error.value(choice) / without : std::numeric_limits<double>::infinity();
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

}  // namespace

double tight_objective(const PlanContext& c, const Polytope& body, double begin, double end) noexcept {
  const Question question(c, body, begin, end);
  const WarpInput& in = question.in;
  const WarpChoice choice = c.warp.choose(in);
  LightPlaneError error(in);
  const double without = error.value({}), with = usable(in, choice) ? error.value(choice) : without;
  return with < without || !c.warp.drop_without_gain ? with : without;
}

PlaneMap tight_plane(const PlanContext& c, const Polytope& body, double begin, double end) noexcept {
  const Question question(c, body, begin, end);
  const WarpInput& in = question.in;
  const WarpChoice choice = c.warp.choose(in);
  const double ratio = gain_ratio(in, choice);
  const bool taken = std::isfinite(ratio) && (ratio < 1.0 - kLeastGain || !c.warp.drop_without_gain);
  return plane_map(in.body, taken ? choice : WarpChoice{});
}

namespace {

/// A plane map with its depths, and the casters it needs.
struct Laid {
  PlaneMap plane;
  LightDepths depths;
  SweptBody swept;
  double m_at_full_size = 0.0;  // bound of m before pruning
};

/// The rim of a map round its rectangle, as a share of the rectangle's side; the wider of both.
double rim_of_body(const ShadowMap& map) noexcept {
  const double rim = static_cast<double>(map.filter_margin_texels) / min_of(map.width, map.height);
  return rim / (1.0 - 2.0 * rim);
}

/// The casters that reach the body or its kernels. A margin at the far end, where texels are largest: across
/// they grow with w, along with w^2 / stretch = w there.
SweptBody swept_for(const PlanContext& c, const Polytope& body, const PlaneMap& plane,
                    const ShadowMap& map) noexcept {
  return sweep(
      c, body,
      rim_of_body(map) * plane.stretch * ((plane.a_max - plane.a_min) + (plane.b_max - plane.b_min)));
}

/// The last frame's map where it still serves: view inside, casters inside.
bool lay_as_before(const PlanContext& c, const Polytope& body, const LightBody& points, Laid& laid,
                   ShadowMap& map) noexcept {
  const PlanHistory::Map* last = remembered(c, map);
  if (last == nullptr) return false;
  map.filter_margin_texels = last->filter_margin_texels;
  const HeldMap held = held_map(c, *last, points, static_cast<double>(map.filter_margin_texels) / map.width);
  if (!held.holds ||
      margin_texels(c.options, map.width, held.plane, points.points()) > map.filter_margin_texels)
    return false;
  laid = {held.plane, held.depths, swept_for(c, body, held.plane, map)};
  const DepthExtent extent = depth_extent(c, points, laid.swept);
  const double height =
      caster_height(extent.reach, c.frame, points, held.plane, held.depths.bottom, rim_of_body(map));
  return extent.bottom >= held.depths.bottom && height <= held.depths.height;
}

/// The best map of the plane, or the steady way there.
PlaneMap chosen_plane(const PlanContext& c, const Polytope& body, const LightBody& points, double begin,
                      double end, ShadowMap& map) noexcept {
  const bool steady = c.history != nullptr && c.options.fit != Fit::warped_stable;
  if (&c.warp == &warps::none && c.options.fit != Fit::rotated && !steady)
    return plane_map(points.points(), {});
  const Question question(c, body, begin, end);
  const WarpInput& in = question.in;
  WarpChoice choice = chosen_warp(c, in, map.cascade, map.warp);
  if (c.options.fit == Fit::rotated) choice = turned_to_least_area(in, choice);
  return steady ? steady_plane(c, in, choice, map) : plane_map(in.body, choice);
}

/// Widens the rectangle to what shaders can aim at. Only bodies that are tiny for their distance, far below a
/// pixel of any camera wider than a hundredth of a degree, or edge-on to the light are that narrow.
void widen_for_floats(PlaneMap& map, std::span<const WarpInput::Point> body) noexcept {
  double across = 0.0, along = 0.0;  // of the image, per unit of relative rounding
  for (const WarpInput::Point& p : body) {
    const double reach = largest_component({p.x, p.y, p.z}) / map.w(p.x, p.y);
    across = max_of(across, reach);
    along = max_of(along, reach * map.stretch / map.w(p.x, p.y));
  }
  const auto least = [&](const glm::dvec2& row) {
    return kLeastOfOffset * (std::abs(row.x) * across + std::abs(row.y) * along);
  };
  widen(map.a_min, map.a_max, least(map.choice.row_a));
  widen(map.b_min, map.b_max, least(map.choice.row_b));
}

/// The rim that kernels need on a map of this size.
int margin_of(const PlanContext& c, int width, int height, double share) noexcept {
  // Of a kernel in world units the longer side has more texels; the shorter side has room for no more than a
  // quarter of its own.
  const int longer = width > height ? width : height, shorter = width + height - longer;
  const int margin = margin_texels(c.options, longer, share);
  return margin < shorter / 4 ? margin : margin_texels(c.options, shorter, share);
}

/// Makes the map as small as c.prune_m lets it. What it shows does not depend on its size.
double shrink(const PlanContext& c, const LightBody& points, const PlaneMap& plane, double share,
              ShadowMap& map) noexcept {
  const glm::dvec2 needed = texels_needed(c, points, plane);
  const double rim = 2.0 * margin_of(c, map.width, map.height, share);
  const double before = max_of(needed.x / (map.width - rim), needed.y / (map.height - rim));
  const auto side = [&](double texels, int full) {
    return least_side({texels, c.prune_m}, full, c.options,
                      [&](int size) { return margin_texels(c.options, size, share); });
  };
  // The rim of a kernel in world units is the same share of both sides.
  const bool square = c.options.filter_radius_world > 0.0;
  const double most = max_of(needed.x, needed.y);
  map.width = side(square ? most : needed.x, map.width);
  map.height = side(square ? most : needed.y, map.height);
  return before;
}

// Room for the view to move in before a map that stands still must be laid anew, on each side: of the
// rectangle and of the depths.
constexpr double kRoom = 0.1;

void lay_anew(const PlanContext& c, const Polytope& body, const LightBody& points, double begin, double end,
              Laid& laid, ShadowMap& map) noexcept {
  const bool still = c.options.fit == Fit::warped_stable;
  laid.plane = chosen_plane(c, body, points, begin, end, map);
  widen_for_floats(laid.plane, points.points());
  if (still) grow(laid.plane, kRoom);
  if (c.history != nullptr) {
    map.warp = laid.plane.choice.kappa > 0.0 ? &c.warp : &warps::none;
    if (still)
      add_event(*c.history, remembered(c, map) ? PlanEventKind::map_relaid : PlanEventKind::map_appeared,
                map.cascade, 1.0);
  }
  const double share =
      c.options.filter_radius_world > 0.0 ? share_per_unit(laid.plane, points.points()) : 0.0;
  if (c.prune_m > 0.0) laid.m_at_full_size = shrink(c, points, laid.plane, share, map);
  map.filter_margin_texels = margin_of(c, map.width, map.height, share);
  laid.swept = swept_for(c, body, laid.plane, map);
  const DepthExtent extent = depth_extent(c, points, laid.swept);
  const double height =
      caster_height(extent.reach, c.frame, points, laid.plane, extent.bottom, rim_of_body(map));
  laid.depths = padded(extent.bottom, height,
                       max_of(laid.plane.a_max - laid.plane.a_min, laid.plane.b_max - laid.plane.b_min));
  if (!still) return;
  laid.depths.bottom -= kRoom * laid.depths.height;
  laid.depths.height *= 1.0 + 2.0 * kRoom;
}

}  // namespace

bool lay_tight_map(const PlanContext& c, const Polytope& body, double begin, double end,
                   ShadowMap& map) noexcept {
  const LightBody points = in_light_frame(c, c.frame, body);
  Laid laid;
  const bool held = c.options.fit == Fit::warped_stable && lay_as_before(c, body, points, laid, map);
  if (!held) lay_anew(c, body, points, begin, end, laid, map);
  if (!laid.swept.reach.any) return false;
  map.depth_range_world = laid.depths.height;
  const glm::dvec2 rim = static_cast<double>(map.filter_margin_texels) / glm::dvec2(map.width, map.height);
  const glm::dmat4 gl_from_relative =
      clip_from_light(laid.plane, laid.depths, rim) * light_from_relative(c.frame);
  finish_map(c, points, laid.plane, laid.swept, gl_from_relative, map);
  if (c.prune_m > 0.0) omit_texels(c.options, laid.m_at_full_size, map, c.plan);
  if (c.history == nullptr) return true;
  glm::dmat4 gl_from_world = gl_from_relative;
  gl_from_world[3] = gl_from_relative * glm::dvec4(-c.camera.position, 1.0);
  if (held) {
    map.warp = map.kappa > 0.0 ? &c.warp : &warps::none;
    // The very bits of the last frame: what is drawn stays as it is.
    gl_from_world = c.history->map[static_cast<std::size_t>(map.cascade)].gl_from_world;
    map.clip_from_world = clip_from_gl_clip(c.options.clip_space) * gl_from_world;
  }
  remember(*c.history, map.cascade, map, gl_from_world);
  return true;
}

}  // namespace gnomon
