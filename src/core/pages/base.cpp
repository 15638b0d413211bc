// The base of a page plan: which maps its levels lie over, and what each visible point needs of them.
#include "pages/base.hpp"
#include "gnomon/extend/light_space.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <new>
#include <variant>

#include "geometry/light_axes.hpp"
#include "geometry/matrix.hpp"
#include "geometry/usable.hpp"
#include "geometry/visible.hpp"
#include "lanes/elementary.hpp"
#include "measure/measure_grid.hpp"
#include "measure/metric_lanes.hpp"
#include "plan/select.hpp"
#include "resolve/resolve.hpp"

namespace gnomon {
namespace {

// Surfaces on the edge of the base are rounded to either side of it; the side of a page that holds all of it.
constexpr double kEdgeRoom = 1e-6, kWholeSide = 1.0 + 4.0 * kEdgeRoom;

/// Places from 0 to 1 across the map.
void anchor_on_map(PageBase& base) noexcept {
  const glm::dmat4& m = base.map.clip_from_world;
  base.row_w = row_of(m, 3);
  base.row_x = (row_of(m, 0) + base.row_w) * 0.5;
  base.row_y = (row_of(m, 1) + base.row_w) * 0.5;
  base.low = glm::dvec2(-kEdgeRoom);
  base.high = glm::dvec2(1.0 + kEdgeRoom);
  base.shift = glm::dvec2(kEdgeRoom);
  base.side = glm::dvec2(kWholeSide);
}

/// Depths that all bounds lie within, in steps: neither the camera nor what it sees changes them, so that
/// drawn pages stay valid. Not where the bounds are so deep that floats would run out.
void deepen_to_bounds(const SceneBounds& bounds, const glm::dvec3& light_direction,
                      const ClipSpace& clip_space, PageBase& base) noexcept {
  const glm::dvec3 up = grid_frame(light_direction).z;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Boxes& boxes : {bounds.casters, bounds.receivers}) {
    high = max_of(high, casters_inside({}, boxes, glm::dvec3(0.0), up).top);
    low = min_of(low, -casters_inside({}, boxes, glm::dvec3(0.0), -up).top);
  }
  constexpr double kSteps = 16.0, kDeepest = 64.0, kMaxSteps = 0x1p50;
  const double side = max_of(base.unit.x, base.unit.y);
  if (!(high > low && high - low < kDeepest * side)) return;
  const double step = 2.0 * elementary::power_of_two_below(high - low) / kSteps;
  const double first = std::floor(low / step) - 1.0, last = std::ceil(high / step) + 1.0;
  if (!(max_of(std::abs(first), std::abs(last)) < kMaxSteps)) return;
  const double bottom = first * step, height = (last - first) * step;
  glm::dmat4 depth(0.0);
  for (int i = 0; i < 3; ++i) depth[i][2] = -2.0 / height * up[i];
  depth[3] = {0.0, 0.0, 1.0 + 2.0 * bottom / height, 1.0};
  const glm::dmat4 clip = clip_from_gl_clip(clip_space) * depth;
  for (int i = 0; i < 4; ++i) base.map.clip_from_world[i][2] = clip[i][2];
  base.map.depth_range_world = height;
  base.map.snap_key.depth_far = static_cast<std::int64_t>(first);
  base.map.snap_key.depth_near = static_cast<std::int64_t>(last);
}

/// Places in world units across parallel light, from the world's origin on: the same for every camera.
void anchor_in_world(const glm::dvec3& light_direction, PageBase& base) noexcept {
  const ShadowMap& map = base.map;
  const LightFrame frame = grid_frame(light_direction);
  const auto along = [&](const glm::dvec3& axis, int row) {
    const bool turned_round = glm::dot(glm::dvec3(row_of(map.clip_from_world, row)), axis) < 0.0;
    return glm::dvec4(turned_round ? -axis : axis, 0.0);
  };
  base.row_x = along(frame.x, 0);
  base.row_y = along(frame.y, 1);
  base.row_w = {0.0, 0.0, 0.0, 1.0};
  const SnapKey& key = map.snap_key;
  const glm::dvec2 half = 0.5 * key.texel * glm::dvec2(map.width, map.height);
  const glm::dvec2 centre =
      glm::dvec2(glm::dot(glm::dvec3(base.row_x), frame.x) * static_cast<double>(key.x),
                 glm::dot(glm::dvec3(base.row_y), frame.y) * static_cast<double>(key.y)) *
      key.texel;
  base.low = centre - half;
  base.high = centre + half;
  base.unit = 2.0 * half;
  base.side = base.unit;
}

/// The frame that a stable map of a local light lies in: of a face of a cube, or of the only one of a spot.
LightFrame local_frame(const Light& light, const glm::dvec3& light_direction, const ShadowMap& map) noexcept {
  if (map.select_plane_count == 0) return fixed_frame(light_direction);
  return face_frame(std::holds_alternative<PointLight>(light) ? LightFrame{} : fixed_frame(light_direction),
                    map.cascade);
}

/// Near and far distance of a perspective map in powers of two, which rounding that follows the eye leaves as
/// they are.
void snap_distances(const ClipSpace& clip_space, const glm::dvec4& row_w, ShadowMap& map) noexcept {
  const glm::dmat4 clip_from_gl = clip_from_gl_clip(clip_space);
  const glm::dmat4 gl = glm::inverse(clip_from_gl) * map.clip_from_world;
  const glm::dvec4 z = row_of(gl, 2), w = row_of(gl, 3);
  const glm::dvec3 ahead(row_w);
  // z = a w + b over the distance w: -1 at the near and 1 at the far plane.
  const double scale = glm::dot(glm::dvec3(w), ahead), a = glm::dot(glm::dvec3(z), ahead) / scale;
  const double b = (z.w - a * w.w) / scale;
  constexpr double kRounding = 1e-6;
  const double near_distance = elementary::power_of_two_below(-b / (a + 1.0) * (1.0 + kRounding));
  const double far_distance = 2.0 * elementary::power_of_two_below(-b / (a - 1.0) * (1.0 - kRounding));
  if (!(near_distance > 0.0 && far_distance > near_distance && far_distance < kLargest)) return;
  const double range = far_distance - near_distance;
  const glm::dvec4 row_z = row_w * ((far_distance + near_distance) / range) -
                           glm::dvec4(0.0, 0.0, 0.0, 2.0 * far_distance * near_distance / range);
  glm::dmat4 depth(0.0);
  for (int i = 0; i < 4; ++i) {
    depth[i][2] = row_z[i];
    depth[i][3] = row_w[i];
  }
  const glm::dmat4 clip = clip_from_gl * depth;
  for (int i = 0; i < 4; ++i) {
    map.clip_from_world[i][2] = clip[i][2];
    map.clip_from_world[i][3] = clip[i][3];
  }
  map.depth_range_world = range;
}

glm::dvec3 position_of(const Light& light) noexcept {
  const auto* const spot = std::get_if<SpotLight>(&light);
  return spot != nullptr ? spot->position : std::get<PointLight>(light).position;
}

/// Places in slopes across a local light's axis, from the axis on: the same for every camera.
void anchor_in_light(const Light& light, const glm::dvec3& light_direction, const ClipSpace& clip_space,
                     PageBase& base) noexcept {
  const LightFrame frame = local_frame(light, light_direction, base.map);
  const glm::dmat4& m = base.map.clip_from_world;
  const glm::dvec3 apex = position_of(light), ahead = -frame.z;
  const double scale = glm::dot(glm::dvec3(row_of(m, 3)), ahead);
  const auto over_apex = [&](const glm::dvec3& axis) { return glm::dvec4(axis, -glm::dot(axis, apex)); };
  glm::dvec4* const rows[2] = {&base.row_x, &base.row_y};
  const glm::dvec3 axes[2] = {frame.x, frame.y};
  for (int i = 0; i < 2; ++i) {
    const glm::dvec3 row(row_of(m, i));
    const double along = glm::dot(row, axes[i]), across = glm::dot(row, ahead) / scale;
    *rows[i] = over_apex(along < 0.0 ? -axes[i] : axes[i]);
    const double per_slope = std::abs(along) / scale;
    base.low[i] = (-1.0 - across) / per_slope;
    base.high[i] = (1.0 - across) / per_slope;
  }
  base.row_w = over_apex(ahead);
  base.unit = base.side = base.high - base.low;
  base.low -= kEdgeRoom * base.unit;
  base.high += kEdgeRoom * base.unit;
  snap_distances(clip_space, base.row_w, base.map);
}

/// Points on their way to their base's block.
class Needs {
 public:
  explicit Needs(PageContext& context) noexcept
      : c_(context), one_base_(context.base_count == 1 && context.base[0].map.select_plane_count == 0) {}

  /// `normal`: nullptr where there is none.
  void add(const glm::dvec3& point, const glm::dvec3* normal) noexcept {
    if (c_.point_count == c_.memory.points.size()) return;
    const std::size_t index = c_.point_count++;
    const int base = one_base_ ? 0 : base_holding(point);
    if (base < 0) {
      leave_out(index);
      return;
    }
    if (base != base_ || count_ == kMetricLanes) flush();
    base_ = base;
    index_[count_] = static_cast<std::uint32_t>(index);
    block_.point.set(count_, point);
    has_normals_ = normal != nullptr;
    if (normal != nullptr) block_.normal.set(count_, *normal);
    ++count_;
  }
  void flush() noexcept;

 private:
  [[nodiscard]] int base_holding(const glm::dvec3& point) const noexcept {
    for (int i = 0; i < c_.base_count; ++i) {
      const PageBase& base = c_.base[static_cast<std::size_t>(i)];
      if (base.holds(point) && inside_select_planes(base.map, point, c_.camera.position)) return i;
    }
    return -1;
  }
  void leave_out(std::size_t index) noexcept {
    c_.memory.points[index] = {0.0, 0.0, 0.0f, 0.0f, kOutside, 0};
    ++c_.outside;
  }
  void store(const PageBase& base, std::size_t lane, const glm::dvec2& m_per_map) noexcept;

  PageContext& c_;
  bool one_base_;
  int base_ = -1;
  std::size_t count_ = 0;
  bool has_normals_ = false;
  std::array<std::uint32_t, kMetricLanes> index_{};
  MetricBlock block_;
};

/// The next float above a number >= 0, so that a rounded need is never too small.
float rounded_up(double value) noexcept {
  constexpr double kLargestFloat = 3e38;
  if (!(value < kLargestFloat)) return std::numeric_limits<float>::infinity();
  const auto rounded = static_cast<float>(value);
  return rounded >= value ? rounded : std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) + 1u);
}

void Needs::store(const PageBase& base, std::size_t lane, const glm::dvec2& m_per_map) noexcept {
  const glm::dvec3 point = block_.point[lane];
  if (!base.holds(point)) {
    leave_out(index_[lane]);
    return;
  }
  const glm::dvec2 at = base.place(point);
  c_.memory.points[index_[lane]] = {at.x,
                                    at.y,
                                    rounded_up(m_per_map.x / base.unit.x),
                                    rounded_up(m_per_map.y / base.unit.y),
                                    static_cast<std::uint32_t>(base_ * kLadder),
                                    0};
}

void Needs::flush() noexcept {
  if (count_ == 0) return;
  // One texel across the map, so that errors are in pixels per map.
  const PageBase& base = c_.base[static_cast<std::size_t>(base_)];
  ShadowMap whole = base.map;
  whole.width = whole.height = 1;
  judge_perspective(MetricFrame(whole, c_.camera, c_.axes), block_, count_);
  if (has_normals_) judge_surface(MetricFrame(whole, c_.camera, c_.axes), block_, count_);
  for (std::size_t i = 0; i < count_; ++i) {
    const double light = has_normals_ ? block_.cos_light[i] : 0.0;
    const bool at_surface = has_normals_ && block_.cos_eye[i] > 0.0;
    if (at_surface && light < 0.0) {
      store(base, i, {0.0, 0.0});  // turned from the light: any level serves
    } else if (at_surface && light >= c_.options.least_light_sine) {
      store(base, i, {block_.surface.s[i], block_.surface.t[i]});
    } else {
      if (at_surface) ++c_.edge_on;
      store(base, i, {block_.perspective.s[i], block_.perspective.t[i]});
    }
  }
  count_ = 0;
}

/// log2 of the ratio of both needs in quarters of an octave, from -8 to 8 octaves.
class AspectHistogram {
 public:
  void add(double ratio) noexcept {
    constexpr double kWidest = 255.0;
    if (!(ratio > 1.0 / kWidest && ratio < kWidest)) return;
    const int bin = static_cast<int>(std::floor(elementary::log2(ratio) * kPerOctave)) + kMiddle;
    ++bins_[static_cast<std::size_t>(bin)];
    ++count_;
  }
  /// The ratio for which the fewest texels are wasted: a need off it by d octaves costs 2^|d| of the texels.
  [[nodiscard]] double best() const noexcept {
    if (count_ == 0) return 1.0;
    std::array<double, kBins> cost_of;  // of a need this many bins off
    for (int bins = 0; bins < kBins; ++bins)
      cost_of[static_cast<std::size_t>(bins)] = elementary::exp2(bins / static_cast<double>(kPerOctave));
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int at = 0; at < kBins; ++at) {
      double cost = 0.0;
      for (int bin = 0; bin < kBins; ++bin) {
        cost += bins_[static_cast<std::size_t>(bin)] * cost_of[static_cast<std::size_t>(std::abs(bin - at))];
      }
      if (!(cost < least)) continue;
      least = cost;
      best = at;
    }
    return elementary::exp2((best - kMiddle + 0.5) / kPerOctave);
  }

 private:
  static constexpr int kPerOctave = 4, kMiddle = 8 * kPerOctave, kBins = 2 * kMiddle;
  std::array<std::uint32_t, kBins> bins_{};
  std::uint32_t count_ = 0;
};

/// Brings a grid that does not follow the camera, whose base shows the camera's whole range, to where points
/// are.
void narrow(PageContext& c, std::uint32_t index) noexcept {
  PageBase& base = c.base[index];
  if (!base.fixed) return;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec2 low(kInfinity), high(-kInfinity);
  c.for_each_point([&](const PagePoint& point, std::size_t) {
    if (point.level / kLadder != index) return;
    low = {min_of(low.x, point.x), min_of(low.y, point.y)};
    high = {max_of(high.x, point.x), max_of(high.y, point.y)};
  });
  if (!(low.x <= high.x)) return;
  // Room round the points for surfaces between them; a single point has the room of the base's rounding.
  constexpr double kRoom = 1.0 / 16.0, kLeast = 1e-6;
  const double whole = max_of(base.high.x - base.low.x, base.high.y - base.low.y);
  const double room = kRoom * max_of(max_of(high.x - low.x, high.y - low.y), kLeast * whole);
  base.low = {max_of(base.low.x, low.x - room), max_of(base.low.y, low.y - room)};
  base.high = {min_of(base.high.x, high.x + room), min_of(base.high.y, high.y + room)};
  const double extent = max_of(base.high.x - base.low.x, base.high.y - base.low.y);
  // A power of two, so that all cameras share the ladder.
  base.side = glm::dvec2(2.0 * elementary::power_of_two_below(extent));
}

/// How much the needs along y exceed those along x, over all points of a base. A few hundred points suffice.
double aspect_of(PageContext& c, std::uint32_t base) noexcept {
  constexpr std::size_t kPoints = 256;
  AspectHistogram histogram;
  const std::size_t stride = std::max<std::size_t>(1, c.point_count / kPoints);
  for (std::size_t i = 0; i < c.point_count; i += stride) {
    const PagePoint& point = c.memory.points[i];
    if (point.level == kOutside || point.level / kLadder != base || !(point.need_x > 0.0f)) continue;
    histogram.add(static_cast<double>(point.need_y) / point.need_x);
  }
  return histogram.best();
}

}  // namespace

PlanStatus plan_base(const Light& light, const SceneBounds& bounds, const ResolvedPages& how, PageContext& c,
                     PagePlan& out) noexcept {
  const ClipSpace clip_space = how.base.clip_space;
  const bool stable = how.base.fit == Fit::stable;
  // Where the levels will be written: stacks may be small.
  const ShadowPlan& plan =
      *::new (c.memory.levels.data()) ShadowPlan(make_plan(c.camera, light, bounds, how.base));
  out.invalid_field = plan.invalid_field;
  out.origin_world = plan.origin_world;
  out.light_direction = plan.light_direction;
  for (const Omission& omission : plan.omitted()) {
    const bool about_maps = omission.kind == OmissionKind::face_without_receiver ||
                            omission.kind == OmissionKind::face_without_caster;
    if (about_maps || omission.kind == OmissionKind::depth_near_light)
      out.omission[static_cast<std::size_t>(out.omission_count++)] = omission;
  }
  for (const Omission& omission : how.ignored.entries())
    out.omission[static_cast<std::size_t>(out.omission_count++)] = omission;
  if (plan.status != PlanStatus::ok) return plan.status;
  c.base_count = plan.map_count;
  c.select_by_map = plan.selection != MapSelection::view_depth;
  for (int i = 0; i < c.base_count; ++i) {
    PageBase& base = c.base[static_cast<std::size_t>(i)];
    base.map = plan.map[static_cast<std::size_t>(i)];
    base.fixed = stable;
    if (stable && std::holds_alternative<DirectionalLight>(light)) {
      anchor_in_world(plan.light_direction, base);
      deepen_to_bounds(bounds, plan.light_direction, clip_space, base);
    } else if (stable) {
      anchor_in_light(light, plan.light_direction, clip_space, base);
    } else {
      anchor_on_map(base);
    }
    // Shifts of bases that stay at their place are final.
    out.places[static_cast<std::size_t>(base.map.cascade)] = {
        base.row_x + base.row_w * base.shift.x, base.row_y + base.row_w * base.shift.y, base.row_w};
  }
  return plan.status;
}

void add_points(const SceneBounds& bounds, PageContext& c) noexcept {
  Needs needs(c);
  const View& seen = c.view;
  for (std::size_t i = 0; i < seen.points_world.size(); ++i)
    needs.add(seen.points_world[i], seen.normals_world.empty() ? nullptr : &seen.normals_world[i]);
  if (seen.points_world.empty()) {
    // Nothing is known: the receivers' boxes, as far as the memory goes.
    constexpr int kDepths = 32;
    const double rays = static_cast<double>(c.memory.points.size()) / (kDepths + 1);
    const double aspect = static_cast<double>(c.camera.width) / c.camera.height;
    const int columns = static_cast<int>(clamp_to(std::sqrt(rays * aspect), 1.0, 512.0));
    const int rows = static_cast<int>(clamp_to(rays / columns, 1.0, 512.0));
    for_each_visible(c.camera, c.axes, bounds.receivers, {columns, rows, kDepths},
                     [&](const glm::dvec3& point, double) { needs.add(point, nullptr); });
  }
  needs.flush();
  for (int i = 0; i < c.base_count; ++i) narrow(c, static_cast<std::uint32_t>(i));
}

void size_base(int trial, PageContext& c) noexcept {
  c.sample_count = 0;
  // Sizes over one step of the ladder, evenly spread in any order (van der Corput), and the grids' places
  // with them.
  constexpr double kGolden = 0.6180339887498949, kFarthestShift = 0.125;
  double size = 0.0;
  for (int bit = 1, rest = trial; rest > 0; ++bit, rest /= 2) size += std::ldexp(rest % 2, -bit);
  const double turn = kGolden * trial;
  const double shift = kFarthestShift * (turn - std::floor(turn));
  for (int i = 0; i < c.base_count; ++i) {
    PageBase& base = c.base[static_cast<std::size_t>(i)];
    if (base.fixed) continue;
    // The coarsest level is one page, wherever it begins.
    const double grown = (kWholeSide + kFarthestShift) * elementary::exp2(size / c.steps);
    const double aspect = aspect_of(c, static_cast<std::uint32_t>(i));
    base.side = glm::dvec2(max_of(aspect, 1.0), max_of(1.0 / aspect, 1.0)) * grown;
    base.shift = glm::dvec2(shift, kFarthestShift - shift) + kEdgeRoom;
  }
}

}  // namespace gnomon
