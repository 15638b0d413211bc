// The smallest map round a body, warped where that gains: of a slice of the view, of a face, of a spot's
// cone. Based on: Wimmer, Scherzer, Purgathofer, "Light Space Perspective Shadow Maps", 2004; Wimmer,
// Scherzer, "Robust Shadow Mapping with Light-Space Perspective Shadow Maps", ShaderX4, 2006 (local lights);
// Brabec, Annen, Seidel, "Practical Shadow Mapping", 2002 (focusing).
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/vector.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"
#include "map/depths.hpp"
#include "map/gain.hpp"
#include "map/history.hpp"
#include "map/light_body.hpp"
#include "map/record.hpp"
#include "map/size.hpp"
#include "map/texel_shape.hpp"
#include "map/turned.hpp"
#include "warp/plane_error.hpp"
#include "warp/registry.hpp"

namespace gnomon {
namespace {

// Room for the view to move in before a map of Fit::warped_stable must be refitted, on each side: of the
// rectangle and of the depths.
constexpr double kRoom = 0.1;
// Narrowest rectangle under a local light, as a slope: below it positions are rounding.
constexpr double kLeastSlope = 1e-8;

// Shortest side of a rectangle, world units: a matrix of floats, which end at 3e38, has its inverse.
constexpr double kLeastSide = 1e-30;

/// A fitted plane with its depths, and the casters it needs.
struct Fitted {
  PlaneMap plane;
  LightDepths depths;
  SweptBody swept;
  TexelsNeeded needed;
  HeightRange heights;
  RowShape rows;
  BorderedPlane bordered;  // where rows are bent or texels round
  RoundTexels round;
};

/// The border as a share of the rectangle's side; the wider of both.
double border_of_body(const ShadowMap& map) noexcept {
  const double border = static_cast<double>(map.filter_margin_texels) / min_of(map.width, map.height);
  return border / (1.0 - 2.0 * border);
}

MapBorder border_of_body(const ShadowMap& map, const Fitted& fitted) noexcept {
  if (fitted.round.used) return {fitted.round.border};
  return {border_of_body(map), fitted.bordered.log_w};
}

/// Widens the rectangle to what shaders can aim at. Only bodies that are tiny for their distance, far below a
/// pixel of any camera wider than a hundredth of a degree, or edge-on to the light are that narrow.
void widen_for_floats(const MapRequest& request, const LightBody& body, PlaneMap& map) noexcept {
  if (request.space.perspective) {
    double offset = 0.0;
    for (const Polytope::Vertex& v : request.body.vertices())
      offset = max_of(offset, largest_component(v.position));
    const double least = max_of(kLeastSlope, kLeastOfOffset * offset / body.farthest) / map.stretch;
    widen(map.a_min, map.a_max, least);
    widen(map.b_min, map.b_max, least);
    return;
  }
  // Of the image, per unit of relative rounding. At most these, w being 1 at least, which hardly any
  // rectangle is too narrow for.
  double across = body.bounds.distance;
  double along = across * map.stretch;
  const auto least = [&](const glm::dvec2& row) {
    return max_of(kLeastSide, kLeastOfOffset * (std::abs(row.x) * across + std::abs(row.y) * along));
  };
  const glm::dvec2 row_a = map.choice.row_a, row_b = map.choice.row_b;
  if (map.a_max - map.a_min >= least(row_a) && map.b_max - map.b_min >= least(row_b)) return;
  across = along = 0.0;
  for (const WarpInput::Point& p : body.points()) {
    const double w = map.w(p.x, p.y), reach = largest_component({p.x, p.y, p.z}) / w;
    across = max_of(across, reach);
    along = max_of(along, reach * map.stretch / w);
  }
  widen(map.a_min, map.a_max, least(row_a));
  widen(map.b_min, map.b_max, least(row_b));
}

/// How much longer the rectangle's sides become by that; 1: not at all.
glm::dvec2 widening(const MapRequest& request, const LightBody& body, const PlaneMap& map) noexcept {
  PlaneMap wide = map;
  widen_for_floats(request, body, wide);
  return {(wide.a_max - wide.a_min) / (map.a_max - map.a_min),
          (wide.b_max - wide.b_min) / (map.b_max - map.b_min)};
}

/// The objective's ratio where the warp's rectangle is widened: the warp's by as much as it may lose by that,
/// the other by as little.
double widened_ratio(const WarpInput& in, const MapRequest& request, const LightBody& body,
                     const PlaneMap& plane, double ratio) noexcept {
  const glm::dvec2 warped = widening(request, body, plane);
  if (warped == glm::dvec2(1.0)) return ratio;
  const glm::dvec2 unwarped = widening(request, body, body.under(in.unwarped));
  if (in.objective == Objective::storage) return ratio * (warped.x * warped.y) / (unwarped.x * unwarped.y);
  return ratio * max_of(warped.x, warped.y) / min_of(unwarped.x, unwarped.y);
}

/// The warp's answer, measured, and used only where it lowers the objective; its plane.
PlaneMap chosen_warp(const PlanContext& c, const MapRequest& request, const LightBody& body,
                     const WarpQuestion& question, MapResult& result) noexcept {
  const WarpInput& in = question.in;
  if (is_unwarped(request.warp)) return question.points.under(in.unwarped);
  const WarpChoice choice = request.warp.choose(in);
  // What is cached from the last frame gains what it did then.
  const bool cached = in.start != nullptr && in.start->use == StartUse::keep;
  double ratio = cached ? choice.gain_ratio : gain_ratio(c, request, question, choice);
  if (pays(request.warp, choice, ratio)) {
    const PlaneMap plane = question.points.under(choice);
    ratio = widened_ratio(in, request, body, &question.points == &body ? plane : body.under(choice), ratio);
    if (pays(request.warp, choice, ratio)) return plane;
  }
  result.omit({OmissionKind::warp_without_gain, request.slot.cascade, ratio, 0.0, 0});
  result.map.warp = &warps::none;
  WarpChoice unwarped = in.unwarped;
  unwarped.gain_ratio = 1.0;
  unwarped.last_ratio = choice.last_ratio;
  unwarped.followed = choice.followed;
  return question.points.under(unwarped);
}

/// The best map of the plane, or the steady way there.
PlaneMap chosen_plane(const PlanContext& c, const MapRequest& request, const LightBody& body,
                      WarpQuestion& question, MapResult& result) noexcept {
  WarpStart start;
  const bool follows = c.how.steady && !is_unwarped(request.warp) && request.warp.follows_start;
  if (follows && find_start(c, request, question, start)) question.in.start = &start;
  PlaneMap plane = chosen_warp(c, request, body, question, result);
  if (follows) result.searched = searched_warp(c, request, plane);
  if (c.how.rotated) plane = question.points.under(turned_to_least_area(question.in, plane.choice));
  if (c.how.steady) return steady_plane(c, request, question, plane, result);
  limit_to_shape(c, question.in.body, plane);
  return plane;
}

/// The same. This and others below are out of line: together they would take more stack than any of them, and
/// searches go deep.
[[gnu::noinline]] PlaneMap chosen_plane(const PlanContext& c, const MapRequest& request,
                                        const LightBody& body, MapResult& result) noexcept {
  if (is_unwarped(request.warp) && !c.how.rotated && !c.how.steady) return body.under(request.unwarped);
  return with_question(c, request, body, [&](WarpQuestion& question) {
    return chosen_plane(c, request, body, question, result);
  });
}

/// The objective by what vertices need.
double objective_of(const PlanContext& c, const TexelsNeeded& needed) noexcept {
  const glm::dvec2 sides = needed.sides;
  return c.options.warp.objective == Objective::storage ? sides.x * sides.y : max_of(sides.x, sides.y);
}

/// Rows of the requested shape where they lower the error. Where the plan chose the warp for them, both or
/// none.
void shape_rows(const PlanContext& c, const MapRequest& request, const LightBody& body, MapResult& result,
                Fitted& fitted) noexcept {
  if (!undoes_warps(*c.how.shape)) return;
  const int map = request.slot.cascade;
  fitted.rows = row_shape(c, fitted.plane, 0.0);
  TexelsNeeded shaped = fitted.needed;
  texels_needed(fitted.rows, body.points(), fitted.plane, shaped);
  const double along = shaped.sides.y / fitted.needed.sides.y;
  if (c.options.warp.warp == nullptr && fitted.plane.choice.kappa > 0.0) {
    PlaneMap flat = body.under(request.unwarped);
    widen_for_floats(request, body, flat);
    TexelsNeeded plain;
    texels_needed(body.points(), flat, pixels_per_slope(c.camera), plain);
    const double ratio = objective_of(c, shaped) / objective_of(c, plain);
    if (!(ratio < 1.0 - kLeastWarpGain)) {
      result.omit({OmissionKind::warp_without_gain, map, ratio, 0.0, 0});
      result.map.warp = &warps::none;
      fitted.plane = flat;
      fitted.needed = plain;
      fitted.rows = {};
    }
  }
  if (fitted.rows.bent() && along < 1.0 - kLeastWarpGain) {
    fitted.needed = shaped;
    return;
  }
  result.omit({OmissionKind::shape_without_gain, map, fitted.rows.bent() ? along : 1.0, 0.0, 0});
  fitted.rows = {};
}

/// The shape with the border that the map has, or linear rows where no room is left for that.
void border_rows(const PlanContext& c, const LightBody& body, MapResult& result, Fitted& fitted) noexcept {
  if (!fitted.rows.bent()) return;
  ShadowMap& map = result.map;
  const double border = static_cast<double>(map.filter_margin_texels) / map.height;
  if (row_shape(c, fitted.plane, border).bent()) {
    fitted.bordered = with_border(fitted.rows, fitted.plane, border);
    map.shape = fitted.rows.shape;
    map.shape_parameters = fitted.bordered.parameters;
    return;
  }
  result.omit({OmissionKind::shape_without_gain, map.cascade, 1.0, 0.0, 0});
  fitted.rows = {};
  texels_needed(body.points(), fitted.plane, pixels_per_slope(c.camera), fitted.needed);
}

/// OpenGL clip space from the light frame, border included.
glm::dmat4 clip_from_light(const ShadowMap& map, const Fitted& fitted) noexcept {
  const glm::dvec2 border = static_cast<double>(map.filter_margin_texels) / glm::dvec2(map.width, map.height);
  if (fitted.rows.bent()) return clip_from_light(fitted.bordered.plane, fitted.depths, {border.x, 0.0});
  if (fitted.round.used) return clip_from_light(fitted.bordered.plane, fitted.depths, 0.0);
  return clip_from_light(fitted.plane, fitted.depths, border);
}

/// Makes the body all that a local light's frustum shows, for a grid that does not follow the view.
void fill_frustum(const MapRequest& request, LightBody& body) noexcept {
  double depth = 0.0, height = body.point[0].z;
  for (const WarpInput::Point& p : body.points()) {
    if (std::isfinite(p.depth)) depth = max_of(depth, p.depth);
    height = min_of(height, p.z);
  }
  body.count = 0;
  for (int i = 0; i < 4; ++i) {
    body.point[static_cast<std::size_t>(body.count++)] = {
        (i & 1) ? request.slope : -request.slope, (i & 2) ? request.slope : -request.slope, height, depth};
  }
  body.bounds = bounds_of(body.points());
}

/// The last frame's map where it still serves: view inside, casters inside.
bool cached_from_before(const PlanContext& c, const MapRequest& request, const LightBody& body,
                        ShadowMap& map, Fitted& fitted) noexcept {
  const PlanHistory::Map& last = *request.last;
  const CachedMap cached = cached_map(c, request, body);
  const double share = border_share(c, request, body, cached.plane);
  if (!cached.holds || border_of(c.options, map.width, map.height, share) > last.filter_margin_texels)
    return false;
  map.filter_margin_texels = last.filter_margin_texels;
  fitted.plane = cached.plane;
  fitted.depths = cached.depths;
  const ServedBody served(c, request, body, cached.plane);
  sweep_for(c, served.request(), served.points(), cached.plane, border_of_body(map, fitted), fitted.swept);
  texels_needed(body.points(), cached.plane, pixels_per_slope(c.camera), fitted.needed);
  fitted.heights = height_range(
      c, served.request(),
      {served.points(), fitted.plane, fitted.swept, border_of_body(map, fitted), cached.depths.bottom});
  if (!(fitted.heights.bottom >= cached.depths.bottom && fitted.heights.height <= cached.depths.height))
    return false;
  return true;
}

/// What the map shows of casters and depths.
[[gnu::noinline]] void fit_depths(const PlanContext& c, const MapRequest& request, const LightBody& body,
                                  const ShadowMap& map, Fitted& fitted) noexcept {
  const ServedBody served(c, request, body, fitted.plane);
  const MapBorder border = border_of_body(map, fitted);
  sweep_for(c, served.request(), served.points(), fitted.plane, border, fitted.swept);
  fitted.heights = height_range(c, served.request(), {served.points(), fitted.plane, fitted.swept, border});
  const double extent =
      max_of(fitted.plane.a_max - fitted.plane.a_min, fitted.plane.b_max - fitted.plane.b_min);
  fitted.depths = request.space.perspective ? LightDepths{fitted.heights.bottom, fitted.heights.height}
                                            : padded(fitted.heights.bottom, fitted.heights.height, extent);
  if (c.how.caches_maps) {
    fitted.depths.bottom -= kRoom * fitted.depths.height;
    fitted.depths.height *= 1.0 + 2.0 * kRoom;
  }
}

/// Fits the rest to the plane.
void fit(const PlanContext& c, const MapRequest& request, const LightBody& body, double obliquity,
         MapResult& result, Fitted& fitted) noexcept {
  ShadowMap& map = result.map;
  widen_for_floats(request, body, fitted.plane);
  if (c.how.caches_maps) grow(fitted.plane, kRoom);
  if (c.how.has_history && !c.how.stable) {
    map.warp = fitted.plane.choice.kappa > 0.0 ? &request.warp : &warps::none;
    if (c.how.caches_maps)
      result.report(has_cached(request) ? PlanEventKind::map_refitted : PlanEventKind::map_appeared, 1.0);
  }
  const double share = border_share(c, request, body, fitted.plane);
  texels_needed(body.points(), fitted.plane, pixels_per_slope(c.camera), fitted.needed);
  shape_rows(c, request, body, result, fitted);
  const MapSize size = map_size(c, request, fitted.plane, fitted.needed, obliquity, share);
  map.width = size.width;
  map.height = size.height;
  map.filter_margin_texels = size.border;
  border_rows(c, body, result, fitted);
  if (c.how.shape->round != nullptr)
    fitted.round = round_texels(c, request, body, fitted.plane, result, fitted.bordered.plane);
  const std::int64_t saved =
      std::int64_t{request.slot.width} * request.slot.height - std::int64_t{size.width} * size.height;
  if (saved > 0) {
    const glm::dvec2 inside = glm::dvec2(size.width, size.height) - 2.0 * size.border;
    result.omit({OmissionKind::resolution_without_gain, request.slot.cascade, size.full_error,
                 fitted.needed.bound(inside, obliquity), saved});
  }
  fit_depths(c, request, body, map, fitted);
}

/// Distance along the light from the map's near to its far plane.
double depth_range(const MapRequest& request, const Fitted& fitted) noexcept {
  if (!request.space.perspective) return fitted.depths.height;
  // Seen from the far end of the body, where w is what the depths were fitted with.
  const double bottom = max_of(fitted.depths.bottom, fitted.heights.bottom);
  return 1.0 / bottom - fitted.heights.nearest;
}

/// A spot's grid that depends on the light alone.
void write_snap_key(const Fitted& fitted, ShadowMap& map) noexcept {
  map.snap_key.depth_near = std::ilogb(fitted.heights.nearest);
  // A texel one world unit from the light.
  map.snap_key.texel =
      glm::dvec2((fitted.plane.a_max - fitted.plane.a_min) / (map.width - 2 * map.filter_margin_texels));
  map.snap_key.valid = true;
}

/// From what was fitted to the map. `cached`: it is the last frame's.
[[gnu::noinline]] void complete(const PlanContext& c, const MapRequest& request, const LightBody& body,
                                double obliquity, bool cached, const Fitted& fitted,
                                MapResult& result) noexcept {
  ShadowMap& map = result.map;
  if (!fitted.heights.has_casters && !request.without_casters) return;
  result.drawn = true;
  if (fitted.heights.too_near > 0)
    result.omit({OmissionKind::depth_near_light, request.slot.cascade, fitted.heights.nearest,
                 static_cast<double>(fitted.heights.too_near), 0});
  // Where no caster is nearer, nothing could shadow those receivers; maps begin a little before the nearest.
  const NearCut& cut = request.near_cut;
  constexpr double kPadding = 1.0 - 1.0 / 256.0;
  const double said = fitted.heights.too_near > 0 ? fitted.heights.nearest : 0.0;
  if (cut.boxes > 0 && fitted.heights.nearest_caster < cut.distance * kPadding &&
      said < cut.distance * kPadding)
    result.omit(near_receivers(cut, request.slot.cascade));
  map.depth_range_world = depth_range(request, fitted);
  const glm::dmat4 gl_from_relative = clip_from_light(map, fitted) * request.space.light_from_relative();
  glm::dvec2 longest = fitted.round.longest;
  if (c.how.shape->serving != nullptr) longest = serve_visible(c, request, gl_from_relative, result);
  complete_record(
      c, request,
      {body, fitted.plane, fitted.swept, fitted.needed, fitted.rows, obliquity, gl_from_relative, longest},
      map);
  if (c.how.has_history) result.gl_from_world = world_matrix(gl_from_relative, c.camera.position);
  if (c.how.stable) {
    write_snap_key(fitted, map);
    // From the world, not by way of the eye: the same key, the same bits.
    const LightFrame& frame = request.space.frame;
    const LightSpace in_world{frame, true, frame.turned(request.apex_world)};
    result.gl_from_world = clip_from_light(map, fitted) * in_world.light_from_relative();
    map.clip_from_world = clip_from_gl_clip(c.options.clip_space) * result.gl_from_world;
  }
  if (cached) {
    map.warp = map.kappa > 0.0 ? &request.warp : &warps::none;
    result.gl_from_world = request.last->gl_from_world;
  }
  // The very bits of the frame that it was fitted in, in every clip space: what is drawn stays as it is.
  if (c.how.caches_maps && c.how.has_history)
    map.clip_from_world = clip_from_gl_clip(c.options.clip_space) * result.gl_from_world;
}

/// The last frame's map where it still serves; false where it does not.
[[gnu::noinline]] bool take_cached(const PlanContext& c, const MapRequest& request, const LightBody& body,
                                   double obliquity, MapResult& result) noexcept {
  Fitted fitted;
  if (!cached_from_before(c, request, body, result.map, fitted)) return false;
  complete(c, request, body, obliquity, true, fitted, result);
  return true;
}

[[gnu::noinline]] void fit_to_plane(const PlanContext& c, const MapRequest& request, const LightBody& body,
                                    const PlaneMap& plane, double obliquity, MapResult& result) noexcept {
  Fitted fitted;
  fitted.plane = plane;
  fit(c, request, body, obliquity, result, fitted);
  complete(c, request, body, obliquity, false, fitted, result);
}

}  // namespace

void focused_map(const PlanContext& c, const MapRequest& request, MapResult& result) noexcept {
  begin_record(c, request, result.map);
  LightBody body = in_light_space(c, request);
  if (c.how.stable) fill_frustum(request, body);
  const double obliquity = pixel_obliquity(c, request.body);
  const bool has_same = c.same_light && has_cached(request), may_stay = c.how.caches_maps && has_same;
  if (may_stay && take_cached(c, request, body, obliquity, result)) return;
  const PlaneMap plane = chosen_plane(c, request, body, result);
  fit_to_plane(c, request, body, plane, obliquity, result);
  if (c.how.steady && has_same && result.drawn) keep_last_bits(c, request, result);
}

}  // namespace gnomon
