// Everything of a map's record that follows from its plane, its matrix and its swept body.
#include "map/record.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/light_space.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/extend/warp.hpp"
#include "gnomon/study/bias.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"
#include "lanes/pair.hpp"
#include "map/size.hpp"

namespace gnomon {
namespace {

void write_planes(const PlanContext& c, const SweptBody& swept, ShadowMap& map) noexcept {
  for (int i = 0; i < swept.plane_count; ++i) {
    const Plane& p = swept.plane[static_cast<std::size_t>(i)];
    map.cull_planes[static_cast<std::size_t>(i)] =
        glm::dvec4(p.normal, p.offset - glm::dot(p.normal, c.camera.position));
  }
  // Equal plans have equal records.
  for (std::size_t i = static_cast<std::size_t>(swept.plane_count); i < map.cull_planes.size(); ++i)
    map.cull_planes[i] = glm::dvec4(0.0);
  map.cull_plane_count = swept.plane_count;
}

/// What longest_sides takes of a point of the body; the distance is 1 for parallel light.
struct Corner {
  glm::dvec2 v, on_plane;
  double w, distance, v_length, length;
};

/// The largest square of (Wi Vj + Wj Vi) / 2 over all pairs of corners, under parallel light.
double square_of_pairs(const std::array<Corner, kMaxBodyPoints>& corner, std::size_t count) noexcept {
  // One more, of nothing, so that every pair of neighbours may be asked at once.
  std::array<double, kMaxBodyPoints + 1> v_x, v_y, w;
  for (std::size_t i = 0; i < count; ++i) {
    v_x[i] = corner[i].v.x;
    v_y[i] = corner[i].v.y;
    w[i] = corner[i].w;
  }
  v_x[count] = v_y[count] = w[count] = 0.0;
  Pair most(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const Pair x_i(v_x[i]), y_i(v_y[i]), w_i(w[i]);
    for (std::size_t j = i; j < count; j += 2) {
      const Pair w_j = Pair::from(&w[j]);
      const Pair x = Pair::from(&v_x[j]) * w_i + x_i * w_j, y = Pair::from(&v_y[j]) * w_i + y_i * w_j;
      most = max_of(most, x * x + y * y);
    }
  }
  return max_of(most.low(), most.high()) * 0.25;
}

/// Bounds of the extents across the light that the rectangle's sides have anywhere on the body. They need not
/// be largest at a vertex: under a warp not where the body is wide, under a local light not off its axis.
///
/// With d the distance along a local light's axis (else 1), W = w d, S the coordinate across the warp's axis
/// times d, and (X, Y) the image of a side, the side is W V / d long with V = (d X + kappa S Y / stretch, W Y
/// / stretch). W, V and d are linear over the body, so that W V and d are sums over pairs of vertices, with
/// weights that are not negative, of (Wi Vj + Wj Vi) / 2 and (di + dj) / 2: no quotient of the sums exceeds
/// the largest of a pair. Rows that undo w along the warp stand for a W over d that is the same everywhere.
/// Across a ray the side is shorter by the sine of its angle to the ray, whose cosine
/// is bounded from below in the same way.
glm::dvec2 longest_sides(const LightSpace& space, const LightBody& body, const PlaneMap& plane,
                         const RowShape& rows) noexcept {
  std::array<Corner, kMaxBodyPoints> corner;
  const WarpChoice& choice = plane.choice;
  const glm::dvec2 axis = choice.axis;
  const double area = choice.row_a.x * choice.row_b.y - choice.row_a.y * choice.row_b.x;
  const auto longest = [&](const glm::dvec2& image, const RowShape& rows_across) {
    std::size_t count = 0;
    double most_w = 0.0, most_v = 0.0, square = 0.0;
    for (const WarpInput::Point& p : body.points()) {
      const double d = space.perspective ? 1.0 / p.z : 1.0, w = plane.w(p.x, p.y);
      const glm::dvec2 at{p.x * axis.y - p.y * axis.x, p.x * axis.x + p.y * axis.y};
      const double along = image.y / plane.stretch;
      const glm::dvec2 v{d * (image.x + choice.kappa * (at.x - choice.centre) * along), w * d * along};
      const double weight = w * rows_across.lengthening(plane, p.x, p.y);
      Corner& here = corner[count++];
      here.v = v;
      here.w = weight * d;
      here.distance = d;
      const double v_square = glm::dot(v, v);
      most_w = max_of(most_w, weight * weight);
      most_v = max_of(most_v, v_square);
      square = max_of(square, weight * weight * v_square);
      if (!space.perspective) continue;
      here.on_plane = at * d;
      here.v_length = std::sqrt(v_square);
      here.length = d * std::sqrt(1.0 + glm::dot(at, at));
    }
    // As a rule one vertex has the largest of both: no pair exceeds it.
    if (!space.perspective)
      return std::sqrt(most_w * most_v <= square ? square : square_of_pairs(corner, count));
    double least_cosine = 1.0, most_cosine = -1.0;
    square = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const Corner& a = corner[i];
      // Without a warp the vertices themselves bound both.
      const std::size_t end = choice.kappa > 0.0 ? count : i + 1;
      for (std::size_t j = i; j < end; ++j) {
        const Corner& b = corner[j];
        const glm::dvec2 both = b.v * a.w + a.v * b.w;
        const double inverse = 1.0 / (a.distance + b.distance);
        square = max_of(square, glm::dot(both, both) * (inverse * inverse));
        const double cosine = (glm::dot(a.v, b.on_plane) + glm::dot(b.v, a.on_plane)) /
                              (a.v_length * b.length + b.v_length * a.length);
        least_cosine = min_of(least_cosine, cosine);
        most_cosine = max_of(most_cosine, cosine);
      }
    }
    const double cosine = max_of(0.0, max_of(least_cosine, -most_cosine));
    return std::sqrt(square * max_of(0.0, 1.0 - cosine * cosine));
  };
  return {longest(glm::dvec2(choice.row_b.y, -choice.row_b.x) / area, {}) * (plane.a_max - plane.a_min),
          longest(glm::dvec2(-choice.row_a.y, choice.row_a.x) / area, rows) * (plane.b_max - plane.b_min)};
}

/// Extents of texels: at the body's centre, and a bound of them over the body.
void write_texels(const PlanContext& c, const MapRequest& request, const MapParts& parts,
                  ShadowMap& map) noexcept {
  const LightSpace& space = request.space;
  glm::dvec3 centre(0.0);
  for (const Polytope::Vertex& v : request.body.vertices()) centre += v.position;
  centre /= static_cast<double>(request.body.vertex_count);
  const glm::dvec3 way = space.ray(space.frame.turned(centre));
  const glm::dvec3 travel = space.frame.x * way.x + space.frame.y * way.y + space.frame.z * way.z;
  map.texel_world = map.texel_world_max =
      texel_extent_world(parts.gl_from_relative, map.texels(),
                         space.perspective ? safe_normalize(travel, -space.frame.z) : -space.frame.z, centre);
  if (space.perspective || parts.plane.choice.kappa != 0.0 || parts.longest != glm::dvec2(1.0)) {
    const glm::dvec2 longest = longest_sides(space, parts.body, parts.plane, parts.rows) /
                               (glm::dvec2(map.width, map.height) - 2.0 * map.filter_margin_texels) *
                               parts.longest;
    // The hull round what several views see may have its centre where a warp of what they see shows nothing.
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (!(map.texel_world.x < kInfinity && map.texel_world.y < kInfinity)) map.texel_world = longest;
    map.texel_world_max = {max_of(map.texel_world.x, longest.x), max_of(map.texel_world.y, longest.y)};
  }
  const double texel = max_of(map.texel_world.x, map.texel_world.y);
  const BiasOptions& bias = c.options.bias;
  map.bias_world = {bias.constant_texels * texel, bias.slope_texels * texel,
                    bias.normal_offset_texels * texel};
}

/// The matrix in the plan's clip space.
glm::dmat4 clip_from_gl(const ClipSpace& target, const glm::dmat4& gl_from_relative) noexcept {
  const bool same = target.ndc_depth == NdcDepth::minus_one_to_one && !target.reversed_z && !target.y_down &&
                    target.handedness == Handedness::right;
  // What a product with 1 makes of it: no zero has a sign.
  return same ? gl_from_relative + 0.0 : clip_from_gl_clip(target) * gl_from_relative;
}

}  // namespace

glm::dmat4 world_matrix(const glm::dmat4& from_relative, const glm::dvec3& eye_world) noexcept {
  return counted_from(from_relative, -eye_world);
}

void begin_record(const PlanContext& c, const MapRequest& request, ShadowMap& map) noexcept {
  const MapSlot& slot = request.slot;
  map.cascade = slot.cascade;
  map.width = slot.width;
  map.height = slot.height;
  map.depth_begin = slot.depth_begin;
  map.depth_end = slot.depth_end;
  map.overlap = slot.overlap;
  map.warp = &request.warp;
  map.select_plane_count = slot.select_count;
  for (int i = 0; i < slot.select_count; ++i) {
    const Plane& plane = slot.select[static_cast<std::size_t>(i)];
    map.select_planes[static_cast<std::size_t>(i)] =
        glm::dvec4(plane.normal, plane.offset - glm::dot(plane.normal, c.camera.position));
  }
}

void complete_record(const PlanContext& c, const MapRequest& request, const MapParts& parts,
                     ShadowMap& map) noexcept {
  map.kappa = parts.plane.choice.kappa;
  const LightSpace& space = request.space;
  const glm::dmat4 from_relative = clip_from_gl(c.options.clip_space, parts.gl_from_relative);
  map.clip_from_camera_relative = glm::mat4(from_relative);
  map.clip_from_world = world_matrix(from_relative, c.camera.position);
  map.light_world = space.perspective ? glm::dvec4(request.apex_world, 1.0) : glm::dvec4(space.frame.z, 0.0);
  write_texels(c, request, parts, map);
  write_planes(c, parts.swept, map);
  if (!map.shape->affine)
    map.shape_parameters =
        parameters_in(clip_from_gl_clip(c.options.clip_space), *map.shape, map.shape_parameters);
  const glm::dvec2 inside = glm::dvec2(map.width, map.height) - 2.0 * map.filter_margin_texels;
  map.m_s_max = parts.needed.sides.x / inside.x * parts.longest.x;
  map.m_t_max = parts.needed.sides.y / inside.y * parts.longest.y;
  map.m_max = parts.needed.bound(inside / parts.longest, parts.obliquity);
  map.storage = map.m_s_max * map.m_t_max * static_cast<double>(map.width) * map.height /
                (static_cast<double>(c.camera.width) * c.camera.height);
}

}  // namespace gnomon
