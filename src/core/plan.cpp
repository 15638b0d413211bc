// From a camera, a light and bounds to the shadow maps worth drawing: the pipeline, stage by stage.
#include "gnomon/plan.hpp"

#include <cmath>
#include <limits>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "light_map.hpp"
#include "plan_input.hpp"
#include "vector.hpp"
#include "visible.hpp"

namespace gnomon {
namespace {

// Room beyond the nearest and farthest depth, relative to the range: float rounding in the shader must not
// push a surface out of the map.
constexpr double kDepthPadding = 1.0 / 1024.0;
// Least depth range of a map, relative to its extents across: a flat scene still needs one.
constexpr double kFlattestDepth = 1e-3;
// Faces of a box steeper than this to the light bound nothing: their height changes by more than the scene's size.
constexpr double kSteepestFace = 1e-6;
// Rounding of positions, relative to their distance from the origin of the world.
constexpr double kPositionRounding = 1e-14;

/// What all cascades share.
struct Context {
  const Camera& camera;
  const SceneBounds& bounds;
  const PlanOptions& options;
  CameraAxes axes;
  glm::dvec3 light_direction;  // unit
  LightFrame frame;
  bool stable;
  double sin_gamma, cos_gamma;
  ShadowPlan& plan;
};

void omit(ShadowPlan& plan, const Omission& omission) noexcept {
  if (plan.omission_count < kMaxOmissions)
    plan.omission[static_cast<std::size_t>(plan.omission_count)] = omission;
  ++plan.omission_count;
}

std::int64_t texels_of(const PlanOptions& options) noexcept {
  return std::int64_t{options.map_size} * options.map_size;
}

/// Depth range that is divided among the cascades, from the body of everything in view.
void depths_to_cover(const Context& c, const Polytope& body, double& begin, double& end) noexcept {
  const double n = c.camera.near_depth, f = c.camera.far_depth;
  begin = n;
  end = f;
  const bool whole = c.options.split_range == SplitRange::camera ||
                     (c.options.split_range == SplitRange::automatic && c.stable);
  if (whole) return;
  double low = f, high = n;
  for (const Polytope::Vertex& v : body.vertices()) {
    const double depth = glm::dot(c.axes.forward, v.position);
    low = min_of(low, depth);
    high = max_of(high, depth);
  }
  begin = clamp_to(low, n, f);
  end = clamp_to(high, begin, f);
  // Saving less than this share of the depths is not worth a line.
  constexpr double kWorthTelling = 0.01;
  if (begin > n * (1.0 + kWorthTelling)) omit(c.plan, {OmissionKind::depth_without_receiver, -1, n, begin, 0});
  if (end < f * (1.0 - kWorthTelling)) omit(c.plan, {OmissionKind::depth_without_receiver, -1, end, f, 0});
}

/// The body's vertices in the light frame, with their view depths.
struct LightBody {
  std::array<WarpInput::Point, kMaxVertices> point;
  int count = 0;
  [[nodiscard]] std::span<const WarpInput::Point> points() const noexcept {
    return {point.data(), static_cast<std::size_t>(count)};
  }
};

LightBody in_light_frame(const Context& c, const LightFrame& frame, const Polytope& body) noexcept {
  LightBody result;
  const double least = max_of(c.camera.near_depth, c.options.near_hint);
  for (const Polytope::Vertex& v : body.vertices()) {
    const double depth = c.camera.orthographic ? 1.0 : max_of(least, glm::dot(c.axes.forward, v.position));
    result.point[static_cast<std::size_t>(result.count++)] = {
        glm::dot(frame.x, v.position), glm::dot(frame.y, v.position), glm::dot(frame.z, v.position), depth};
  }
  return result;
}

/// Half opening of the frustum in the plane of view and light: the largest slope of a corner along it.
double tan_half_fov(const Context& c) noexcept {
  const glm::dvec3 across = c.frame.y - c.axes.forward * glm::dot(c.frame.y, c.axes.forward);
  const glm::dvec3 w = safe_normalize(across, c.axes.up);
  const double x = std::abs(glm::dot(w, c.axes.right)), y = std::abs(glm::dot(w, c.axes.up));
  return x * max_of(std::abs(c.camera.left), std::abs(c.camera.right)) +
         y * max_of(std::abs(c.camera.bottom), std::abs(c.camera.top));
}

WarpInput warp_input(const Context& c, const LightBody& body, double begin, double end) noexcept {
  WarpInput in{};
  in.body = body.points();
  in.y_min = in.y_max = body.point[0].y;
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
  return in;
}

/// Asks the warp, measures its answer, and takes it only where it lowers the objective.
double chosen_kappa(const Context& c, const WarpInput& in, int cascade, const Warp*& warp) noexcept {
  if (warp == &warps::none) return 0.0;
  const double kappa = warp->choose(in).kappa;
  const double before = warp_error(in, 0.0).value(in.objective);
  const double after = kappa > 0.0 ? warp_error(in, kappa).value(in.objective) : before;
  const bool usable = kappa > 0.0 && std::isfinite(after);
  if (usable && (after < before || !warp->drop_without_gain)) return kappa;
  omit(c.plan, {OmissionKind::warp_without_gain, cascade, before > 0.0 ? after / before : 1.0, 0.0, 0});
  warp = &warps::none;
  return 0.0;
}

/// Upper bound of (z - bottom) / w over every caster point above the body: along the light, the casters' box ends at the
/// lowest of its faces towards the light, and a face's height over the body is largest at one of the body's vertices,
/// w being positive there. `rim` is the map's margin as a share of its side, `w_far` the largest w.
double caster_height(const CasterReach& reach, const LightFrame& frame, const LightBody& body,
                     const LightRectangle& rectangle, double kappa, double bottom, double rim) noexcept {
  const double length = rectangle.y_max - rectangle.y_min, width = rectangle.right - rectangle.left;
  const double w_far = 1.0 + kappa * length;
  const glm::dvec3 up = frame.z;
  const glm::dvec3 corner{up.x > 0.0 ? reach.bounds.max.x : reach.bounds.min.x,
                          up.y > 0.0 ? reach.bounds.max.y : reach.bounds.min.y,
                          up.z > 0.0 ? reach.bounds.max.z : reach.bounds.min.z};
  double lowest_face = std::numeric_limits<double>::infinity(), body_height = 0.0;
  // Face 3 stands for the plane across the light through the highest caster.
  for (int face = 0; face < 4; ++face) {
    // z of the face at (x, y) across the light: at + slope_x x + slope_y y.
    double at = reach.top, slope_x = 0.0, slope_y = 0.0;
    if (face < 3) {
      if (!(std::abs(up[face]) > kSteepestFace)) continue;
      at = corner[face] / up[face];
      slope_x = -frame.x[face] / up[face];
      slope_y = -frame.y[face] / up[face];
    }
    double highest = 0.0;
    for (const WarpInput::Point& p : body.points()) {
      const double w = 1.0 + kappa * (p.y - rectangle.y_min);
      const double margin_x = rim * width * w, margin_y = rim * length * w * w / w_far;
      const double z = at + slope_x * p.x + slope_y * p.y + std::abs(slope_x) * margin_x + std::abs(slope_y) * margin_y;
      // The margin reaches towards smaller w, too; it never halves it for a margin a filter can ask for.
      const double least_w = max_of(w - kappa * margin_y, 0.5 * w);
      highest = max_of(highest, (z - bottom) / least_w);
      body_height = max_of(body_height, (p.z - bottom) / w);
    }
    lowest_face = min_of(lowest_face, highest);
  }
  return max_of(lowest_face, body_height);
}

double lowest(const LightBody& body) noexcept {
  double z = body.point[0].z;
  for (const WarpInput::Point& p : body.points()) z = min_of(z, p.z);
  return z;
}

int margin_texels(const PlanOptions& options) noexcept {
  return static_cast<int>(std::ceil(options.filter_radius_texels));
}

/// Everything of a map that follows from its matrix.
void finish(const Context& c, const LightBody& body, const LightFrame& frame,
            const glm::dmat4& gl_from_relative, ShadowMap& map) noexcept {
  const glm::dmat4 from_gl = clip_from_gl_clip(c.options.clip_space);
  const glm::dmat4 from_relative = from_gl * gl_from_relative;
  map.clip_from_camera_relative = glm::mat4(from_relative);
  map.clip_from_world = from_relative;
  map.clip_from_world[3] = from_relative * glm::dvec4(-c.camera.position, 1.0);
  map.light_world = glm::dvec4(-c.light_direction, 0.0);
  glm::dvec3 centre(0.0);
  double y_far = body.point[0].y;
  for (const WarpInput::Point& p : body.points()) {
    centre += glm::dvec3{p.x, p.y, p.z};
    y_far = max_of(y_far, p.y);
  }
  centre /= static_cast<double>(body.count);
  const auto texel_at = [&](const glm::dvec3& p) {
    return texel_extent_world(gl_from_relative, map.width, map.height, c.light_direction,
                              frame.x * p.x + frame.y * p.y + frame.z * p.z);
  };
  // w, and with it both extents, is largest at the far end.
  map.texel_world_max = texel_at({centre.x, y_far, centre.z});
  map.texel_world = texel_at(centre);
  const double texel = max_of(map.texel_world.x, map.texel_world.y);
  map.bias_world = {c.options.bias.constant_texels * texel, c.options.bias.slope_texels * texel,
                    c.options.bias.normal_offset_texels * texel};
}

/// Bounds of the error in pixels per texel, and the storage, from the warp's relative error.
void judge(const Context& c, const WarpInput& in, double kappa, ShadowMap& map) noexcept {
  const double pixels_x = c.camera.width / (c.camera.right - c.camera.left);
  const double pixels_y = c.camera.height / (c.camera.top - c.camera.bottom);
  const WarpError error = warp_error(in, kappa);
  const double usable = map.width - 2.0 * map.filter_margin_texels;
  map.m_s_max = error.m_s * pixels_x / usable;
  map.m_t_max = error.m_t * pixels_y / usable;
  map.storage = map.m_s_max * map.m_t_max * static_cast<double>(map.width) * map.height /
                (static_cast<double>(c.camera.width) * c.camera.height);
}

void store_cull_planes(const Context& c, std::span<const Plane> planes, double margin_world,
                       ShadowMap& map) noexcept {
  const double slack = margin_world + kPositionRounding * largest_component(c.camera.position);
  for (const Plane& plane : planes) {
    map.cull_planes[static_cast<std::size_t>(map.cull_plane_count++)] =
        glm::dvec4(plane.normal, plane.offset + slack - glm::dot(plane.normal, c.camera.position));
  }
}

/// Swept planes of the body, moved out so that casters which only a kernel reaches are kept.
int caster_planes(const Polytope& body, const glm::dvec3& light_direction, double margin_world,
                  std::array<Plane, kMaxCullPlanes>& planes) noexcept {
  const int count = swept_planes(body, -light_direction, planes);
  for (int i = 0; i < count; ++i) planes[static_cast<std::size_t>(i)].offset += margin_world;
  return count;
}

/// Depth range [bottom, bottom + height) with room to spare.
LightDepths padded(double bottom, double height, double extent) noexcept {
  const double range = max_of(height, kFlattestDepth * extent);
  return {bottom - kDepthPadding * range, range * (1.0 + 2.0 * kDepthPadding)};
}

bool tight_map(const Context& c, const Polytope& body, double begin, double end, ShadowMap& map) noexcept {
  const LightBody points = in_light_frame(c, c.frame, body);
  const WarpInput in = warp_input(c, points, begin, end);
  map.kappa = chosen_kappa(c, in, map.cascade, map.warp);
  const LightRectangle rectangle = rectangle_round(points.points(), map.kappa);
  map.filter_margin_texels = margin_texels(c.options);
  const double rim = static_cast<double>(map.filter_margin_texels) / map.width;
  // Largest texel on the body: x grows with w, y with its square.
  const double length = rectangle.y_max - rectangle.y_min;
  const double w_far = 1.0 + map.kappa * length;
  const double texel =
      max_of((rectangle.right - rectangle.left) * w_far, length * w_far) / (map.width * (1.0 - 2.0 * rim));
  const double margin_world = texel * map.filter_margin_texels;
  std::array<Plane, kMaxCullPlanes> planes;
  const int plane_count = caster_planes(body, c.light_direction, margin_world, planes);
  const std::span<const Plane> swept{planes.data(), static_cast<std::size_t>(plane_count)};
  const CasterReach reach = casters_inside(swept, c.bounds.casters, c.camera.position, c.frame.z);
  if (reach.count == 0) return false;
  const double bottom = lowest(points);
  const double height = caster_height(reach, c.frame, points, rectangle, map.kappa, bottom, rim / (1.0 - 2.0 * rim));
  const double extent = max_of(rectangle.right - rectangle.left, length);
  const LightDepths depths = padded(bottom, height, extent);
  map.depth_range_world = depths.height;
  const glm::dmat4 gl_from_relative =
      clip_from_light(rectangle, map.kappa, depths, rim, rim) * light_from_relative(c.frame);
  store_cull_planes(c, swept, 0.0, map);
  finish(c, points, c.frame, gl_from_relative, map);
  judge(c, in, map.kappa, map);
  return true;
}

bool stable_map(const Context& c, const Polytope& body, double begin, double end, ShadowMap& map) noexcept {
  const LightFrame& frame = c.frame;
  map.warp = &warps::none;
  map.filter_margin_texels = margin_texels(c.options);
  // Rounded up so that its own rounding can never change the grid; one texel is the room that snapping moves
  // within.
  constexpr double kSizeSteps = 1024.0;
  const double chord = longest_chord(c.camera.left, c.camera.right, c.camera.bottom, c.camera.top,
                                     c.camera.orthographic, begin, end);
  const double unit = std::exp2(std::floor(std::log2(chord))) / kSizeSteps;
  const double side = std::ceil(chord / unit) * unit;
  const double texel = side / (map.width - 1 - 2 * map.filter_margin_texels);
  const double half = 0.5 * texel * map.width;
  // Centre of the whole slice, in absolute light coordinates, to the nearest texel.
  const Polytope slice = frustum_slice(c.camera, c.axes, begin, end);
  Box box;
  for (const Polytope::Vertex& v : slice.vertices()) {
    box.extend({glm::dot(frame.x, v.position), glm::dot(frame.y, v.position), glm::dot(frame.z, v.position)});
  }
  const glm::dvec3 eye{glm::dot(frame.x, c.camera.position), glm::dot(frame.y, c.camera.position),
                       glm::dot(frame.z, c.camera.position)};
  map.snap_key.x = snap_index(eye.x + 0.5 * (box.min.x + box.max.x), texel);
  map.snap_key.y = snap_index(eye.y + 0.5 * (box.min.y + box.max.y), texel);

  std::array<Plane, kMaxCullPlanes> planes;
  const double margin_world = texel * map.filter_margin_texels;
  const int plane_count = caster_planes(body, c.light_direction, margin_world, planes);
  const std::span<const Plane> swept{planes.data(), static_cast<std::size_t>(plane_count)};
  const CasterReach reach = casters_inside(swept, c.bounds.casters, c.camera.position, frame.z);
  if (reach.count == 0) return false;
  const LightBody points = in_light_frame(c, frame, body);
  const double bottom = lowest(points);
  const LightRectangle square{0.0, side, 0.0, side};
  const double height =
      caster_height(reach, frame, points, square, 0.0, bottom, static_cast<double>(map.filter_margin_texels) / map.width);
  // Depths in whole steps of a sixteenth of the side: the stored depths hold still, too.
  const double step = side / 16.0;
  const LightDepths wanted = padded(bottom, height, side);
  map.snap_key.depth_far = static_cast<std::int64_t>(std::floor((eye.z + wanted.bottom) / step));
  map.snap_key.depth_near =
      static_cast<std::int64_t>(std::ceil((eye.z + wanted.bottom + wanted.height) / step));
  map.snap_key.valid = true;

  const double x = static_cast<double>(map.snap_key.x) * texel,
               y = static_cast<double>(map.snap_key.y) * texel;
  const LightRectangle rectangle{x - half - eye.x, x + half - eye.x, y - half - eye.y, y + half - eye.y};
  const LightDepths depths{static_cast<double>(map.snap_key.depth_far) * step - eye.z,
                           static_cast<double>(map.snap_key.depth_near - map.snap_key.depth_far) * step};
  map.depth_range_world = depths.height;
  const glm::dmat4 gl_from_relative =
      clip_from_light(rectangle, 0.0, depths, 0.0, 0.0) * light_from_relative(frame);
  store_cull_planes(c, swept, 0.0, map);
  finish(c, points, frame, gl_from_relative, map);
  WarpInput in = warp_input(c, points, begin, end);
  in.y_max = in.y_min + side;
  judge(c, in, 0.0, map);
  map.m_s_max = max_of(map.m_s_max, 0.0);
  return true;
}

/// `all` is the body of everything in view.
void plan_cascade(const Context& c, const Polytope& all, int cascade, double begin, double end) noexcept {
  Polytope body = all;
  clip(body, Plane{c.axes.forward, -begin});
  clip(body, Plane{-c.axes.forward, end});
  if (c.bounds.receivers.size() > 1 && !body.empty()) {
    clip(body, visible_bounds(body, c.bounds.receivers, c.camera.position));
  }
  if (body.empty()) {
    omit(c.plan, {OmissionKind::cascade_without_receiver, cascade, begin, end, texels_of(c.options)});
    return;
  }
  ShadowMap& map = c.plan.map[static_cast<std::size_t>(c.plan.map_count)];
  map = ShadowMap{};
  map.cascade = cascade;
  map.depth_begin = begin;
  map.depth_end = end;
  map.width = map.height = c.options.map_size;
  map.warp = c.options.warp != nullptr ? c.options.warp : &warps::lispsm;
  const bool drawn =
      c.stable ? stable_map(c, body, begin, end, map) : tight_map(c, body, begin, end, map);
  if (drawn) {
    ++c.plan.map_count;
  } else {
    omit(c.plan, {OmissionKind::cascade_without_caster, cascade, begin, end, texels_of(c.options)});
  }
}

}  // namespace

ShadowPlan make_plan(const Camera& camera, const Light& light, const SceneBounds& bounds,
                     const PlanOptions& options) noexcept {
  ShadowPlan plan;
  plan.invalid_field = first_invalid_field(camera, light, bounds, options);
  if (!plan.invalid_field.empty()) return plan;
  const auto* directional = std::get_if<DirectionalLight>(&light);
  if (directional == nullptr) {
    plan.invalid_field = "light (only directional lights are planned so far)";
    return plan;
  }
  plan.origin_world = camera.position;
  plan.light_direction = safe_normalize(directional->direction, {0.0, -1.0, 0.0});
  plan.clip_space = options.clip_space;

  const CameraAxes axes = camera_axes(camera);
  const bool stable = options.fit == Fit::stable;
  const glm::dvec3 across = glm::cross(axes.forward, plan.light_direction);
  const Context context{
      camera,
      bounds,
      options,
      axes,
      plan.light_direction,
      stable ? fixed_frame(plan.light_direction) : view_aligned_frame(plan.light_direction, axes),
      stable,
      std::sqrt(glm::dot(across, across)),
      glm::dot(axes.forward, plan.light_direction),
      plan};
  Polytope body = frustum_slice(camera, axes, camera.near_depth, camera.far_depth);
  clip(body, visible_bounds(body, bounds.receivers, camera.position));
  if (body.empty()) {
    plan.status = PlanStatus::nothing_visible;
    return plan;
  }
  double begin = 0.0, end = 0.0;
  depths_to_cover(context, body, begin, end);
  if (stable && options.warp != nullptr && options.warp != &warps::none) {
    omit(plan, {OmissionKind::warp_in_stable_fit, -1, 0.0, 0.0, 0});
  }
  std::array<double, kMaxMaps + 1> edges{};
  split_depths(begin, end, {options.split, options.lambda, options.near_hint},
               {edges.data(), static_cast<std::size_t>(options.cascades + 1)});
  for (int i = 0; i < options.cascades; ++i) {
    plan_cascade(context, body, i, edges[static_cast<std::size_t>(i)], edges[static_cast<std::size_t>(i) + 1]);
  }
  plan.status = plan.map_count > 0 ? PlanStatus::ok : PlanStatus::no_caster;
  return plan;
}

}  // namespace gnomon
