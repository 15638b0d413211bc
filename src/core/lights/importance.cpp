// Which part of the view does a light light, and which error would its maps have there?
//
// The error is the mean over pixels of the mean over depths, evenly spaced in their logarithm: that of
// measure(), from few rays. A texel of a map with S texels along a side is 2 t d / S wide at the distance d
// along the map's axis, t being its frustum's slope; a pixel is z / (pixels per slope) wide at the depth z.
#include "lights/importance.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <new>

#include "geometry/body.hpp"
#include "geometry/light_axes.hpp"
#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/light_space.hpp"
#include "gnomon/measure.hpp"
#include "lanes/elementary.hpp"
#include "map/size.hpp"
#include "plan/spot_maps.hpp"
#include "resolve/resolve.hpp"

namespace gnomon {
namespace {

constexpr double kNarrowest = 1e-6;
// A cube's faces overlap; with room for rounding, so that none is missed.
constexpr double kFaceSlope = 1.0 + 2.0 / 512.0;

constexpr int kRays = 4;  // along each side of what the light covers of the image

/// A local light relative to the eye.
struct LocalLight {
  glm::dvec3 apex{0.0};
  double range = 0.0;
  bool has_cone = false;
  bool cube = true;
  glm::dvec3 axis{0.0, -1.0, 0.0};
  double cosine = -1.0;  // of the cone
  double slope = 1.0;    // of a map's frustum
  LightFrame base;       // of the cube

  /// Distance along the axis of the map that shows the point.
  [[nodiscard]] double distance(const glm::dvec3& offset, double along) const noexcept {
    if (!cube) return along;
    return has_cone ? largest_component(base.turned(offset)) : largest_component(offset);
  }
  [[nodiscard]] bool in_cone(const glm::dvec3& offset, double along) const noexcept {
    if (!has_cone) return true;
    const double edge = cosine * cosine * glm::dot(offset, offset);
    return cosine >= 0.0 ? along > 0.0 && along * along >= edge : along >= 0.0 || along * along <= edge;
  }
};

LocalLight local_light(const Light& light, const PlanOptions& options, const glm::dvec3& eye) noexcept {
  LocalLight local;
  if (const auto* point = std::get_if<PointLight>(&light)) {
    local.apex = point->position - eye;
    local.range = point->range;
    return local;
  }
  const auto* spot = std::get_if<SpotLight>(&light);
  if (spot == nullptr) return local;
  local.apex = spot->position - eye;
  local.range = spot->range;
  local.has_cone = true;
  local.axis = safe_normalize(spot->direction, {0.0, -1.0, 0.0});
  local.cosine = elementary::cos(spot->outer_radians);
  local.cube = shown_by_faces(*spot, resolve(options, {.light = light}).options);
  if (local.cube) {
    local.base = fixed_frame(local.axis);
  } else {
    local.slope = max_of(elementary::tan(spot->outer_radians), kNarrowest);
  }
  return local;
}

/// The smallest box round all that the light lights. A cube's maps hold a little more than a cone's box.
Box lit_box(const LocalLight& light) noexcept {
  Box box{light.apex - glm::dvec3(light.range), light.apex + glm::dvec3(light.range)};
  if (light.cube) return box;
  // Farthest along an axis that leaves the cone's own by an angle a: cos(a - outer), or the apex.
  const double sine = std::sqrt(max_of(0.0, 1.0 - light.cosine * light.cosine));
  const auto farthest = [&](double cosine) {
    if (cosine >= light.cosine) return 1.0;
    return max_of(0.0, cosine * light.cosine + sine * std::sqrt(max_of(0.0, 1.0 - cosine * cosine)));
  };
  constexpr double kRoom = 1.0 + 1e-9;
  for (int i = 0; i < 3; ++i) {
    box.max[i] = light.apex[i] + light.range * min_of(1.0, farthest(light.axis[i]) * kRoom);
    box.min[i] = light.apex[i] - light.range * min_of(1.0, farthest(-light.axis[i]) * kRoom);
  }
  return box;
}

std::array<Plane, 6> sides_of(const Box& box) noexcept {
  std::array<Plane, 6> planes;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 normal(0.0);
    normal[i] = 1.0;
    planes[static_cast<std::size_t>(2 * i)] = {normal, -box.min[i]};
    planes[static_cast<std::size_t>(2 * i + 1)] = {-normal, box.max[i]};
  }
  return planes;
}

/// True where a side of the frustum parts it from the light's range.
bool beside_view(const LightView& view, const LocalLight& light) noexcept {
  constexpr double kRounding = 1e-9;
  const double room = light.range + kRounding * (light.range + largest_component(light.apex));
  for (int i = 0; i < view.body.face_count; ++i) {
    const Plane& plane = view.body.plane[static_cast<std::size_t>(i)];
    if (glm::dot(plane.normal, light.apex) + plane.offset < -room) return true;
  }
  return false;
}

/// Bounds of the parts of `boxes` inside `lit`; false where there are none.
bool parts_inside(const LightView& view, const Boxes& boxes, const Box& lit, Box& parts) noexcept {
  const std::array<Plane, 6> planes = sides_of(lit);
  const CasterReach reach = casters_inside(planes, boxes, view.seen.camera.position, {0.0, 1.0, 0.0});
  if (!reach.any) return false;
  for (int i = 0; i < 3; ++i) {
    // Boxes that touch it may lie beside it by their rounding.
    parts.min[i] = clamp_to(reach.bounds.min[i], lit.min[i], lit.max[i]);
    parts.max[i] = clamp_to(reach.bounds.max[i], lit.min[i], lit.max[i]);
  }
  return true;
}

/// Marks the faces of the cube that a convex body may reach: no plane between them parts it from the face.
class FaceFinder {
 public:
  /// `rounding`: distance beyond a plane at which clip() keeps points, world units.
  FaceFinder(const LocalLight& light, double rounding) noexcept : light_(light), rounding_(rounding) {}

  void add(const glm::dvec3& point) noexcept {
    const glm::dvec3 offset = point - light_.apex;
    const glm::dvec3 c = light_.has_cone ? light_.base.turned(offset) : offset;
    constexpr double kRounding = 1e-9;
    const double slack = rounding_ + kRounding * (largest_component(c) + largest_component(light_.apex));
    for (int face = 0; face < 6; ++face) {
      const int axis = face / 2;
      const double distance = face % 2 == 0 ? c[axis] : -c[axis], reach = kFaceSlope * distance + slack;
      const double a = c[(axis + 1) % 3], b = c[(axis + 2) % 3];
      std::uint8_t& sides = inside_[static_cast<std::size_t>(face)];
      sides = static_cast<std::uint8_t>(sides | (reach >= a ? 1 : 0) | (reach >= -a ? 2 : 0) |
                                        (reach >= b ? 4 : 0) | (reach >= -b ? 8 : 0) |
                                        (distance >= -slack ? 16 : 0));
    }
  }
  [[nodiscard]] int count() const noexcept {
    int faces = 0;
    for (const std::uint8_t sides : inside_) faces += sides == 31 ? 1 : 0;
    return faces > 0 ? faces : 1;
  }

 private:
  const LocalLight& light_;
  double rounding_;
  std::array<std::uint8_t, 6> inside_{};
};

void count_maps(const LightView& view, const LocalLight& light, const Polytope& body, const Box& parts,
                LightImportance& out) noexcept {
  out.seen_maps = out.all_maps = 1;
  if (!light.cube) return;
  if (!view.options.prune.has(PruneRule::empty_faces)) {
    out.seen_maps = out.all_maps = 6;
    return;
  }
  // A plane of a face has a normal of length 1, which the finder's is not.
  const double rounding = 2.0 * clip_rounding(body);
  FaceFinder seen(light, rounding), all(light, rounding);
  for (const Polytope::Vertex& v : body.vertices()) seen.add(v.position);
  for (int corner = 0; corner < 8; ++corner) {
    all.add({(corner & 1) ? parts.max.x : parts.min.x, (corner & 2) ? parts.max.y : parts.min.y,
             (corner & 4) ? parts.max.z : parts.min.z});
  }
  out.seen_maps = seen.count();
  out.all_maps = all.count();
}

/// A part of the picture, and the mean over it of distance to the light over depth.
struct Coverage {
  double share = 0.0, mean = 0.0;
};

/// Where a body lies in the image: slopes, or world units of an orthographic camera.
struct ImagePart {
  double left, right, bottom, top;
};
ImagePart part_of_image(const LightView& view, const Polytope& body) noexcept {
  const Camera& k = view.seen.camera;
  ImagePart part{k.right, k.left, k.top, k.bottom};
  for (const Polytope::Vertex& v : body.vertices()) {
    const double depth = k.orthographic ? 1.0 : max_of(glm::dot(view.axes.forward, v.position), k.near_depth);
    const double x = glm::dot(view.axes.right, v.position) / depth;
    const double y = glm::dot(view.axes.up, v.position) / depth;
    part = {min_of(part.left, x), max_of(part.right, x), min_of(part.bottom, y), max_of(part.top, y)};
  }
  return {max_of(part.left, k.left), min_of(part.right, k.right), max_of(part.bottom, k.bottom),
          min_of(part.top, k.top)};
}

/// Mean of distance over depth along one ray of the image; negative where the light lights nothing there.
double mean_along(const LightView& view, const LocalLight& light, const Box& parts, double x,
                  double y) noexcept {
  const Camera& k = view.seen.camera;
  const glm::dvec3 image = view.axes.right * x + view.axes.up * y;
  const glm::dvec3 start = k.orthographic ? image : glm::dvec3(0.0);
  const glm::dvec3 step = k.orthographic ? view.axes.forward : view.axes.forward + image;
  double begin = k.near_depth, end = k.far_depth;
  for (int i = 0; i < 3; ++i) {
    if (step[i] == 0.0) {
      if (start[i] < parts.min[i] || start[i] > parts.max[i]) return -1.0;
      continue;
    }
    const double inverse = 1.0 / step[i];
    const double a = (parts.min[i] - start[i]) * inverse, b = (parts.max[i] - start[i]) * inverse;
    begin = max_of(begin, min_of(a, b));
    end = min_of(end, max_of(a, b));
  }
  // The sphere of the range.
  const glm::dvec3 offset = start - light.apex;
  const double square = glm::dot(step, step), half = glm::dot(step, offset);
  const double rest = half * half - square * (glm::dot(offset, offset) - light.range * light.range);
  if (!(rest >= 0.0)) return -1.0;
  const double root = std::sqrt(rest);
  begin = max_of(begin, (-half - root) / square);
  end = min_of(end, (-half + root) / square);
  if (!(begin <= end)) return -1.0;
  // Four depths in the middles of equal steps, of their logarithm where they have one.
  constexpr int kDepths = 4;
  const bool even = k.orthographic || !(begin > 0.0);
  const double factor = even ? 1.0 : std::sqrt(std::sqrt(std::sqrt(end / begin)));
  double depth = begin * factor, sum = 0.0;
  int hits = 0;
  for (int i = 0; i < kDepths; ++i) {
    const double at = even ? begin + (end - begin) * ((i + 0.5) / kDepths) : depth;
    depth *= factor * factor;
    const glm::dvec3 from_light = offset + step * at;
    const double along = glm::dot(light.axis, from_light);
    if (!light.in_cone(from_light, along)) continue;
    sum += light.distance(from_light, along) / (k.orthographic ? 1.0 : at);
    ++hits;
  }
  return hits > 0 ? sum / hits : -1.0;
}

/// For a light that no ray and no point met: its body's corners.
double mean_of_corners(const LightView& view, const LocalLight& light, const Polytope& body) noexcept {
  double sum = 0.0;
  for (const Polytope::Vertex& v : body.vertices()) {
    const glm::dvec3 offset = v.position - light.apex;
    const double depth = max_of(glm::dot(view.axes.forward, v.position), view.seen.camera.near_depth);
    sum += std::abs(light.distance(offset, glm::dot(light.axis, offset))) /
           (view.seen.camera.orthographic ? 1.0 : depth);
  }
  return sum / body.vertex_count;
}

Coverage cover_by_rays(const LightView& view, const LocalLight& light, const Polytope& body,
                       const Box& parts) noexcept {
  const ImagePart part = part_of_image(view, body);
  const Camera& k = view.seen.camera;
  const double width = max_of(0.0, part.right - part.left), height = max_of(0.0, part.top - part.bottom);
  const double cell = width * height / ((k.right - k.left) * (k.top - k.bottom)) / (kRays * kRays);
  double sum = 0.0;
  int hits = 0;
  for (int i = 0; i < kRays * kRays; ++i) {
    const double x = part.left + width * ((i % kRays + 0.5) / kRays);
    const double y = part.bottom + height * ((i / kRays + 0.5) / kRays);
    const double mean = mean_along(view, light, parts, x, y);
    if (mean < 0.0) continue;
    sum += mean;
    ++hits;
  }
  if (hits > 0) return {hits * cell, sum / hits};
  return {0.5 * cell, mean_of_corners(view, light, body)};
}

/// Four points at a time, so that the sum keeps its order whatever the compiler makes of it.
Coverage cover_points(const LightView& view, const LocalLight& light, const Polytope& body) noexcept {
  const auto ax = static_cast<float>(light.apex.x / view.unit),
             ay = static_cast<float>(light.apex.y / view.unit),
             az = static_cast<float>(light.apex.z / view.unit);
  const auto range = static_cast<float>(light.range / view.unit);
  const glm::vec3 axis(light.axis);
  const glm::vec3 bx(light.base.x), by(light.base.y), bz(light.base.z);
  const bool cone = light.has_cone, cube = light.cube, turned = light.cube && light.has_cone;
  const auto cosine = static_cast<float>(light.cosine);
  const float edge = cosine * cosine, square = range * range;
  double sum = 0.0;
  std::size_t hits = 0;
  for (const LightPoint& p : view.points) {
    const float x = p.x - ax, y = p.y - ay, z = p.z - az;
    const float length = x * x + y * y + z * z;
    if (!(length <= square)) continue;
    const float along = x * axis.x + y * axis.y + z * axis.z;
    if (cone && !(cosine >= 0.0f ? along > 0.0f && along * along >= edge * length
                                 : along >= 0.0f || along * along <= edge * length))
      continue;
    float distance = along;
    if (turned) {
      const float u = std::abs(x * bx.x + y * bx.y + z * bx.z), v = std::abs(x * by.x + y * by.y + z * by.z),
                  w = std::abs(x * bz.x + y * bz.y + z * bz.z);
      distance = u > v ? (u > w ? u : w) : (v > w ? v : w);
    } else if (cube) {
      const float u = std::abs(x), v = std::abs(y), w = std::abs(z);
      distance = u > v ? (u > w ? u : w) : (v > w ? v : w);
    }
    sum += static_cast<double>(distance * p.pixel);
    ++hits;
  }
  const double count = static_cast<double>(view.points.size());
  if (hits > 0) return {static_cast<double>(hits) / count, sum / static_cast<double>(hits)};
  return {0.5 / count, mean_of_corners(view, light, body)};
}

/// A sun's plan with maps of this size.
const ShadowPlan& sun_plan(const LightView& view, const Light& light, int size) noexcept {
  PlanOptions options = view.options;
  options.resolution.max_size = size;
  return *::new (view.sun) ShadowPlan(make_plan(view.seen, light, view.bounds, options));
}

/// The most maps that a sun may need at any size: a caster may reach a cascade by a texel of one size and
/// not of another, and parts other than cascades gain by one and not by another.
int most_maps(const LightView& view, const Light& light, int at_least_size) noexcept {
  int most = at_least_size;
  for (int size = view.most_size; size > view.options.resolution.max_size; size /= 2) {
    const bool all = view.options.split.partition == Partition::view_depth && most >= view.options.cascades;
    if (all) break;
    most = std::max(most, sun_plan(view, light, size).map_count);
  }
  return most;
}

/// Shares and errors of all cascades of a sun, which is planned for that at the least size. Out of line: the
/// plan need not make room for what local lights take.
[[gnu::noinline]] LightImportance sun_at_least_size(const LightView& view, const Light& light) noexcept {
  const PlanOptions& options = view.options;
  const ShadowPlan& plan = sun_plan(view, light, options.resolution.max_size);
  LightImportance out;
  if (plan.status == PlanStatus::no_caster) out.outcome = LightOutcome::without_caster;
  if (plan.status != PlanStatus::ok) return out;
  out.outcome = LightOutcome::mapped;
  out.share = 1.0;
  out.seen_maps = out.all_maps = plan.map_count;
  const double inside = options.resolution.max_size - 2.0 * std::ceil(options.filter.texels);
  if (!view.seen.points_world.empty()) {
    const AliasingStats stats = measure(plan, view.seen, view.bounds);
    if (stats.samples > stats.outside && std::isfinite(stats.mean)) {
      out.demand = stats.mean * inside;
      return out;
    }
  }
  double sum = 0.0, whole = 0.0;
  for (const ShadowMap& map : plan.maps()) {
    const double texels = max_of(map.m_s_max * (map.width - 2.0 * map.filter_margin_texels),
                                 map.m_t_max * (map.height - 2.0 * map.filter_margin_texels));
    // m falls as 1 / depth within a cascade.
    const double a = map.depth_begin, b = map.depth_end;
    const bool even = view.seen.camera.orthographic || !(a > 0.0 && b > a * (1.0 + 1e-9));
    const double weight = even ? max_of(b - a, 1e-300) : elementary::log(b / a);
    sum += texels * (even ? weight : 1.0 - a / b);
    whole += weight;
  }
  out.demand = whole > 0.0 ? sum / whole : 0.0;
  return out;
}

LightImportance sun_importance(const LightView& view, const Light& light) noexcept {
  LightImportance out = sun_at_least_size(view, light);
  if (out.outcome == LightOutcome::mapped)
    out.seen_maps = out.all_maps = most_maps(view, light, out.seen_maps);
  return out;
}

}  // namespace

LightView light_view(const View& seen, const SceneBounds& bounds, const PlanOptions& options,
                     std::span<LightPoint> memory, Polytope& body, ShadowPlan* sun, int most_size) noexcept {
  const Camera& camera = seen.camera;
  const std::span<const glm::dvec3> points_world = seen.points_world;
  const CameraAxes axes = camera_axes(camera);
  body = frustum_slice(camera, axes, camera.near_depth, camera.far_depth);
  LightView view{seen, bounds, options, axes, body, {}, false, {}, 1.0, sun, most_size};
  view.box = bounds_of(view.body);
  const Boxes &c = bounds.casters, &r = bounds.receivers;
  view.one_list = c.set() == r.set() && c.list().data() == r.list().data() && c.size() == r.size();
  double farthest = 0.0;
  for (const glm::dvec3& point : points_world)
    farthest = max_of(farthest, largest_component(point - camera.position));
  if (farthest > 0.0) view.unit = elementary::power_of_two_below(farthest);
  for (std::size_t i = 0; i < points_world.size(); ++i) {
    const glm::dvec3 p = points_world[i] - camera.position;
    const double depth = max_of(glm::dot(axes.forward, p), camera.near_depth);
    const glm::dvec3 q = p / view.unit;
    memory[i] = {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
                 static_cast<float>(camera.orthographic ? view.unit : view.unit / depth)};
  }
  view.points = memory.first(points_world.size());
  return view;
}

namespace {

[[gnu::noinline]] LightImportance local_importance(const LightView& view, const Light& light) noexcept {
  const LocalLight local = local_light(light, view.options, view.seen.camera.position);
  LightImportance out;
  // As make_plan: a range that is rounding of the position lights no pixel.
  constexpr double kLeastRange = 1e-12;
  if (local.range <= kLeastRange * largest_component(local.apex)) return out;
  const Box lit = lit_box(local);
  for (int i = 0; i < 3; ++i) {
    if (lit.max[i] < view.box.min[i] || lit.min[i] > view.box.max[i]) return out;
  }
  if (beside_view(view, local)) return out;
  Box parts;
  if (!parts_inside(view, view.bounds.receivers, lit, parts)) return out;
  Polytope body = view.body;
  clip(body, parts);
  if (body.empty()) return out;
  out.outcome = LightOutcome::without_caster;
  Box casters;
  if (!view.one_list && !parts_inside(view, view.bounds.casters, lit, casters)) return out;
  out.outcome = LightOutcome::mapped;
  count_maps(view, local, body, parts, out);
  const Coverage seen =
      view.points.empty() ? cover_by_rays(view, local, body, parts) : cover_points(view, local, body);
  out.share = min_of(seen.share, 1.0);
  out.demand = 2.0 * local.slope * pixels_per_slope(view.seen.camera) * seen.mean;
  return out;
}

}  // namespace

LightImportance importance_of(const LightView& view, const Light& light) noexcept {
  return std::holds_alternative<DirectionalLight>(light) ? sun_importance(view, light)
                                                         : local_importance(view, light);
}

}  // namespace gnomon
