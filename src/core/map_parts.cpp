// The pieces that tight and stable maps are laid with.
#include "map_parts.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "vector.hpp"

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
// Rounding of positions, relative to their distance from the origin of the world, and of the body's faces.
constexpr double kPositionRounding = 4e-13;
// A body shorter along the axis than this much of its other extents, or of its distance, has its length from
// rounding, and a warp's strength from it would be noise.
constexpr double kShortest = 1e-6, kShortestOfDistance = 1e-9;
// Ratio of the far to the near end's texels beyond which float matrices no longer hold the map together.
constexpr double kStrongest = 1e9;

}  // namespace

LightBody in_light_frame(const PlanContext& c, const LightFrame& frame, const Polytope& body) noexcept {
  LightBody result;
  const double least = max_of(c.camera.near_depth, c.options.near_hint);
  for (const Polytope::Vertex& v : body.vertices()) {
    const double depth = c.camera.orthographic ? 1.0 : max_of(least, glm::dot(c.axes.forward, v.position));
    result.point[static_cast<std::size_t>(result.count++)] = {
        glm::dot(frame.x, v.position), glm::dot(frame.y, v.position), glm::dot(frame.z, v.position), depth};
  }
  return result;
}

LightBody judged_body(const PlanContext& c, const LightFrame& frame, const Polytope& body,
                      Polytope& focus) noexcept {
  LightBody points = in_light_frame(c, frame, body);
  focus.vertex_count = 0;
  if (c.options.focus.empty()) return points;
  focus = body;
  clip(focus, relative_to(c.options.focus, c.camera.position));
  if (focus.empty()) return points;
  for (int i = 0; i < points.count; ++i)
    points.point[static_cast<std::size_t>(i)].depth *= c.options.focus_weight;
  const LightBody inside = in_light_frame(c, frame, focus);
  for (const WarpInput::Point& p : inside.points()) {
    if (points.count < kMaxVertices) points.point[static_cast<std::size_t>(points.count++)] = p;
  }
  return points;
}

double lowest(const LightBody& body) noexcept {
  double z = body.point[0].z;
  for (const WarpInput::Point& p : body.points()) z = min_of(z, p.z);
  return z;
}

bool usable(const WarpInput& in, const WarpChoice& choice) noexcept {
  const PlaneMap map = plane_map(in.body, choice);
  double farthest = 0.0;
  for (const WarpInput::Point& p : in.body) farthest = max_of(farthest, p.depth);
  const double extent = max_of(map.a_max - map.a_min, map.b_max - map.b_min);
  return map.length > kShortest * extent && map.length > kShortestOfDistance * farthest &&
         map.stretch <= kStrongest;
}

glm::dvec2 texels_needed(const PlanContext& c, const LightBody& body, const PlaneMap& plane) noexcept {
  const WarpChoice& choice = plane.choice;
  const glm::dvec2 axis = choice.axis;
  // The image's X and Y per unit of A and B.
  const double area = choice.row_a.x * choice.row_b.y - choice.row_a.y * choice.row_b.x;
  const glm::dvec2 per_a = glm::dvec2(choice.row_b.y, -choice.row_b.x) / area;
  const glm::dvec2 per_b = glm::dvec2(-choice.row_a.y, choice.row_a.x) / area;
  double a_max = 0.0, b_max = 0.0;
  for (const WarpInput::Point& p : body.points()) {
    const double w = plane.w(p.x, p.y);
    const double lean = choice.kappa * (p.x * axis.y - p.y * axis.x - choice.centre) / w;
    const double along = w * w / plane.stretch;  // of one unit of the image's Y
    const auto extent = [&](const glm::dvec2& image) {
      const double u = along * image.y, s = w * image.x + lean * u;
      return std::sqrt(u * u + s * s) / p.depth;
    };
    a_max = max_of(a_max, extent(per_a));
    b_max = max_of(b_max, extent(per_b));
  }
  const double pixels_per_unit = max_of(c.camera.width / (c.camera.right - c.camera.left),
                                        c.camera.height / (c.camera.top - c.camera.bottom));
  return {a_max * (plane.a_max - plane.a_min) * pixels_per_unit,
          b_max * (plane.b_max - plane.b_min) * pixels_per_unit};
}

double share_per_unit(const PlaneMap& map, std::span<const WarpInput::Point> body) noexcept {
  const WarpChoice& c = map.choice;
  double a = 0.0, b = 0.0;
  for (const WarpInput::Point& p : body) {
    const double inverse = 1.0 / map.w(p.x, p.y);
    const double lean = c.kappa * (p.x * c.axis.y - p.y * c.axis.x - c.centre) * inverse;
    const auto steepness = [&](const glm::dvec2& row) {
      const double along = (row.y * map.stretch * inverse - row.x * lean) * inverse;
      return std::sqrt(row.x * row.x * inverse * inverse + along * along);
    };
    a = max_of(a, steepness(c.row_a));
    b = max_of(b, steepness(c.row_b));
  }
  return max_of(a / (map.a_max - map.a_min), b / (map.b_max - map.b_min));
}

int margin_texels(const PlanOptions& options, int size, double share) noexcept {
  double wanted = options.filter_radius_texels;
  if (options.filter_radius_world > 0.0) {
    // Kernels wider than the side end up with the most there is; the rim makes the side itself smaller.
    const double reach = options.filter_radius_world * min_of(share, 1.0 / options.filter_radius_world);
    wanted = max_of(wanted, reach * size / (1.0 + 2.0 * reach));
  }
  return static_cast<int>(std::ceil(min_of(wanted, 0.25 * size)));
}

SweptBody sweep(const PlanContext& c, const Polytope& body, double margin_world) noexcept {
  SweptBody swept;
  swept.plane_count = swept_planes(body, -c.light_direction, swept.plane);
  double farthest = largest_component(c.camera.position);
  for (const Polytope::Vertex& v : body.vertices())
    farthest = max_of(farthest, largest_component(v.position));
  // A caster that touches the body counts, whatever rounding makes of the touch.
  const double slack = margin_world + kPositionRounding * farthest;
  for (int i = 0; i < swept.plane_count; ++i) swept.plane[static_cast<std::size_t>(i)].offset += slack;
  swept.reach = casters_inside({swept.plane.data(), static_cast<std::size_t>(swept.plane_count)},
                               c.bounds.casters, c.camera.position, c.frame.z);
  // A map that is laid for no caster at all is as deep as its receivers.
  if (!swept.reach.any && !c.options.prune.has(PruneRule::casterless_cascades)) {
    swept.reach = {bounds_of(body), -std::numeric_limits<double>::infinity(), true};
    for (const Polytope::Vertex& v : body.vertices())
      swept.reach.top = max_of(swept.reach.top, glm::dot(c.frame.z, v.position));
  }
  return swept;
}

DepthExtent depth_extent(const PlanContext& c, const LightBody& body, const SweptBody& swept) noexcept {
  DepthExtent extent{swept.reach, lowest(body)};
  if (c.options.prune.has(PruneRule::light_depths)) return extent;
  const glm::dvec3 up = c.frame.z;
  const CasterReach all = casters_inside({}, c.bounds.casters, c.camera.position, up);
  if (all.any) extent.reach = all;
  const double below = casters_inside({}, c.bounds.receivers, c.camera.position, -up).top;
  extent.bottom = min_of(extent.bottom, -below);
  return extent;
}

double caster_height(const CasterReach& reach, const LightFrame& frame, const LightBody& body,
                     const PlaneMap& map, double bottom, double rim) noexcept {
  const double extent_a = map.a_max - map.a_min, extent_b = map.b_max - map.b_min;
  const glm::dvec3 up = frame.z;
  const glm::dvec3 corner{up.x > 0.0 ? reach.bounds.max.x : reach.bounds.min.x,
                          up.y > 0.0 ? reach.bounds.max.y : reach.bounds.min.y,
                          up.z > 0.0 ? reach.bounds.max.z : reach.bounds.min.z};
  // Of every vertex: 1 / w at the near side of its margin, how far the margin reaches in the light plane, and
  // its own height.
  std::array<double, kMaxVertices> inverse_w, margin;
  double body_height = 0.0;
  const auto count = static_cast<std::size_t>(body.count);
  const double margin_image = rim * (extent_a + extent_b), kappa = map.choice.kappa;
  for (std::size_t i = 0; i < count; ++i) {
    const WarpInput::Point& p = body.point[i];
    const double w = map.w(p.x, p.y);
    // A move by the margin in the image is at most this one in the light plane: across, texels grow with w
    // and lean with the distance from the centre; along, with its square.
    const double across = std::abs(p.x * map.choice.axis.y - p.y * map.choice.axis.x - map.choice.centre);
    const double margin_along = margin_image * w * w / map.stretch;
    margin[i] = margin_image * w + margin_along * (1.0 + kappa * across / w);
    // The margin reaches towards smaller w, too; it never halves it for a margin a filter can ask for.
    inverse_w[i] = 1.0 / max_of(w - kappa * margin_along, 0.5 * w);
    body_height = max_of(body_height, (p.z - bottom) * inverse_w[i]);
  }
  double lowest_face = std::numeric_limits<double>::infinity();
  // Face 3 stands for the plane across the light through the highest caster.
  for (int face = 0; face < 4; ++face) {
    // z of the face at (x, y) across the light: at + slope_x x + slope_y y.
    double at = reach.top, slope_x = 0.0, slope_y = 0.0;
    if (face < 3) {
      if (!(std::abs(up[face]) > kSteepestFace)) continue;
      const double inverse = 1.0 / up[face];
      at = corner[face] * inverse;
      slope_x = -frame.x[face] * inverse;
      slope_y = -frame.y[face] * inverse;
    }
    const double steepest = std::sqrt(slope_x * slope_x + slope_y * slope_y);
    double highest = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const WarpInput::Point& p = body.point[i];
      const double z = at + slope_x * p.x + slope_y * p.y + steepest * margin[i];
      highest = max_of(highest, (z - bottom) * inverse_w[i]);
    }
    lowest_face = min_of(lowest_face, highest);
  }
  return max_of(lowest_face, body_height);
}

LightDepths padded(double bottom, double height, double extent) noexcept {
  const double range = max_of(height, kFlattestDepth * extent);
  return {bottom - kDepthPadding * range, range * (1.0 + 2.0 * kDepthPadding)};
}

void finish_map(const PlanContext& c, const LightBody& body, const PlaneMap& plane, const SweptBody& swept,
                const glm::dmat4& gl_from_relative, ShadowMap& map) noexcept {
  for (int i = 0; i < swept.plane_count; ++i) {
    const Plane& p = swept.plane[static_cast<std::size_t>(i)];
    map.cull_planes[static_cast<std::size_t>(i)] =
        glm::dvec4(p.normal, p.offset - glm::dot(p.normal, c.camera.position));
  }
  map.cull_plane_count = swept.plane_count;
  map.kappa = plane.choice.kappa;
  const LightFrame& frame = c.frame;
  const glm::dmat4 from_gl = clip_from_gl_clip(c.options.clip_space);
  const glm::dmat4 from_relative = from_gl * gl_from_relative;
  map.clip_from_camera_relative = glm::mat4(from_relative);
  map.clip_from_world = from_relative;
  map.clip_from_world[3] = from_relative * glm::dvec4(-c.camera.position, 1.0);
  map.light_world = glm::dvec4(-c.light_direction, 0.0);
  glm::dvec3 centre(0.0);
  const glm::dvec2 axis = plane.choice.axis;
  for (const WarpInput::Point& p : body.points()) {
    centre += glm::dvec3{p.x, p.y, p.z};
  }
  centre /= static_cast<double>(body.count);
  const auto texel_at = [&](const glm::dvec3& p) {
    return texel_extent_world(gl_from_relative, map.width, map.height, c.light_direction,
                              frame.x * p.x + frame.y * p.y + frame.z * p.z);
  };
  // w, and with it both extents, is largest at the far end.
  const double to_far = plane.u_min + plane.length - (centre.x * axis.x + centre.y * axis.y);
  map.texel_world_max = texel_at({centre.x + axis.x * to_far, centre.y + axis.y * to_far, centre.z});
  map.texel_world = texel_at(centre);
  const double texel = max_of(map.texel_world.x, map.texel_world.y);
  map.bias_world = {c.options.bias.constant_texels * texel, c.options.bias.slope_texels * texel,
                    c.options.bias.normal_offset_texels * texel};
  const glm::dvec2 needed = texels_needed(c, body, plane);
  const double rim = 2.0 * map.filter_margin_texels;
  map.m_s_max = needed.x / (map.width - rim);
  map.m_t_max = needed.y / (map.height - rim);
  map.storage = map.m_s_max * map.m_t_max * static_cast<double>(map.width) * map.height /
                (static_cast<double>(c.camera.width) * c.camera.height);
}

}  // namespace gnomon
