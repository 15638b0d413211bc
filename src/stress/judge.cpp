// How far a plan is from what exact arithmetic makes of the same parameters, and what of it survives in
// float.
#include "judge.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gnomon::stress {
namespace {

/// What a map shows, and where exact arithmetic puts its points.
class ExactMap {
 public:
  ExactMap(const Input& input, const ShadowPlan& plan, const ShadowMap& map)
      : input_(input), map_(map), matrix_(relative_matrix(map.clip_from_world, plan.origin_world)) {
    const bool directional = map.light_world.w == 0.0;
    if (input.receivers.size() == 1)
      body_ = visible_vertices(input.camera, input.receivers[0], map.depth_begin, map.depth_end);
    // Of a light with a position the body is cut by the light's cone, too: its matrix stands as it is.
    if (directional && !body_.empty()) {
      if (map.snap_key.valid)
        take_grid();
      else
        refit();
    }
  }
  [[nodiscard]] const std::vector<Real3>& body() const noexcept { return body_; }
  [[nodiscard]] const Real4x4& matrix() const noexcept { return matrix_; }

  [[nodiscard]] Real2 texel(const Real3& p) const {
    if (grid_) return grid_texel(p);
    const Real w = refitted_ ? divisor(p) : exact_place(matrix_, map_.width, map_.height, p).w;
    Real2 ndc;
    for (int i = 0; i < 2; ++i) ndc[i] = (row(i, p) / w) * scale_[i] + shift_[i];
    return {(ndc.x * 0.5L + 0.5L) * map_.width, (ndc.y * 0.5L + 0.5L) * map_.height};
  }

 private:
  [[nodiscard]] Real row(int i, const Real3& p) const {
    return matrix_[0][i] * p.x + matrix_[1][i] * p.y + matrix_[2][i] * p.z + matrix_[3][i];
  }
  [[nodiscard]] Real along(const Real3& p) const {
    return matrix_[0][3] * p.x + matrix_[1][3] * p.y + matrix_[2][3] * p.z;
  }
  [[nodiscard]] Real divisor(const Real3& p) const { return 1.0L + (along(p) - least_); }

  /// The map's directions are its choice; that w is 1 at the body's near end and that the rectangle ends at
  /// the margin on all four sides is not.
  void refit() {
    least_ = along(body_.front());
    for (const Real3& p : body_) least_ = std::min(least_, along(p));
    refitted_ = true;
    for (int i = 0; i < 2; ++i) {
      Real low = std::numeric_limits<Real>::infinity(), high = -low;
      for (const Real3& p : body_) {
        const Real x = row(i, p) / divisor(p);
        low = std::min(low, x);
        high = std::max(high, x);
      }
      const Real rim = Real(map_.filter_margin_texels) / (i == 0 ? map_.width : map_.height);
      const Real full = 2.0L * (1.0L - 2.0L * rim);
      // What is narrower than floats can aim at is widened, and only its middle is known.
      scale_[i] = high - low < full && may_be_widened(i) ? 1.0L : full / (high - low);
      shift_[i] = -0.5L * (low + high) * scale_[i];
    }
  }

  /// Rectangles this narrow for their distance may be wider than the body.
  [[nodiscard]] bool may_be_widened(int axis) const {
    constexpr double kNarrow = 0x1p-11;  // eight times what the core widens to
    Real farthest = 0.0L;
    for (const Real3& p : body_) farthest = std::max(farthest, glm::dot(p, p));
    const double side = map_.texel_world[axis] * (axis == 0 ? map_.width : map_.height);
    return side < kNarrow * static_cast<double>(std::sqrt(farthest));
  }

  /// A stable map's grid: whole texels from the world's origin, along the matrix's own directions.
  void take_grid() {
    grid_ = true;
    for (int i = 0; i < 2; ++i) {
      const Real3 r{matrix_[0][i], matrix_[1][i], matrix_[2][i]};
      axis_[i] = r / std::sqrt(glm::dot(r, r));
    }
  }
  [[nodiscard]] Real2 grid_texel(const Real3& p) const {
    const Real3 world = p + Real3(input_.camera.position);
    const Real2 texel(map_.snap_key.texel);
    return {glm::dot(axis_[0], world) / texel.x - Real(map_.snap_key.x) + 0.5L * map_.width,
            glm::dot(axis_[1], world) / texel.y - Real(map_.snap_key.y) + 0.5L * map_.height};
  }

  const Input& input_;
  const ShadowMap& map_;
  Real4x4 matrix_;
  std::vector<Real3> body_;
  bool refitted_ = false, grid_ = false;
  Real least_ = 0.0L;
  Real2 scale_{1.0L}, shift_{0.0L};
  Real3 axis_[2];
};

double distance(const Real2& a, const Real2& b) {
  return static_cast<double>(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)));
}

template <typename Clip>
Real2 texel_of(const ShadowMap& map, const Clip& clip) {
  return {(Real(clip.x) / clip.w * 0.5L + 0.5L) * map.width,
          (Real(clip.y) / clip.w * 0.5L + 0.5L) * map.height};
}

/// How far the map's own ray through `p` (relative to the camera) leads from the light's.
double drift(const ShadowMap& map, const ExactMap& exact, const ShadowPlan& plan, const Input& input,
             const Real3& p) {
  Real3 above;
  if (map.light_world.w == 0.0) {
    const auto* light = std::get_if<DirectionalLight>(&input.light);
    const Real3 travel = glm::normalize(Real3(light->direction));
    above = p - travel * Real(map.depth_range_world);
  } else {
    const Real3 apex = Real3(glm::dvec3(map.light_world)) - Real3(plan.origin_world);
    above = apex + (p - apex) * 0.5L;
  }
  const Place here = exact_place(exact.matrix(), map.width, map.height, p);
  const Place there = exact_place(exact.matrix(), map.width, map.height, above);
  return distance(here.texel, there.texel);
}

void worst(double& so_far, double value) {
  if (!(value <= so_far)) so_far = value;
}

void judge_points(const Input& input, const ShadowPlan& plan, int index, Judgement& out) {
  const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
  const ExactMap exact(input, plan, map);
  const glm::mat4 absolute(map.clip_from_world);
  constexpr int kBetween = 12;
  for (const glm::dvec3& p : points_of(input, plan, index, kBetween, 1)) {
    const Real3 relative = Real3(p) - Real3(plan.origin_world);
    const Real2 expected = exact.texel(relative);
    const double turned = drift(map, exact, plan, input, relative);
    worst(out.drift_texels, turned);
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
    worst(out.error_texels, std::max(distance(texel_of(map, clip), expected), turned));
    worst(out.float_absolute_texels,
          distance(texel_of(map, absolute * glm::vec4(glm::vec3(p), 1.0f)), expected));
    const glm::vec3 offset(p - plan.origin_world);
    worst(out.float_relative_texels,
          distance(texel_of(map, map.clip_from_camera_relative * glm::vec4(offset, 1.0f)), expected));
  }
}

/// Over the ball round the body, and over all coordinates that reach it.
void judge_condition(const Input& input, const ShadowPlan& plan, int index, Judgement& out) {
  const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
  const std::vector<glm::dvec3> points = points_of(input, plan, index, 0, 1);
  if (points.empty()) return;
  const Real4x4 matrix = relative_matrix(map.clip_from_world, plan.origin_world);
  Real3 centre(0.0L);
  for (const glm::dvec3& p : points) centre += Real3(p) - Real3(plan.origin_world);
  centre /= static_cast<Real>(points.size());
  Real radius = 0.0L, farthest = 0.0L;
  for (const glm::dvec3& p : points) {
    const Real3 away = Real3(p) - Real3(plan.origin_world) - centre;
    radius = std::max(radius, std::sqrt(glm::dot(away, away)));
    farthest = std::max(farthest, std::sqrt(glm::dot(Real3(p), Real3(p))));
  }
  if (!(radius > 0.0L)) radius = map.depth_range_world;
  Real4x4 over_body(radius);
  over_body[3] = Real4(centre, 1.0L);
  worst(out.condition, condition_number(matrix * over_body));
  Real4x4 over_world(std::max(farthest, radius));
  over_world[3] = Real4(0.0L, 0.0L, 0.0L, 1.0L);
  worst(out.condition_world, condition_number(Real4x4(map.clip_from_world) * over_world));
}

const char* kind_name(OmissionKind kind) {
  switch (kind) {
    case OmissionKind::cascade_without_receiver:
      return "cascade without receiver";
    case OmissionKind::cascade_without_caster:
      return "cascade without caster";
    case OmissionKind::depth_without_receiver:
      return "depths without receiver";
    case OmissionKind::depth_not_visible:
      return "depths not visible";
    case OmissionKind::warp_without_gain:
      return "warp without gain";
    case OmissionKind::warp_in_stable_fit:
      return "warp in stable fit";
    case OmissionKind::part_without_caster:
      return "part without caster";
    case OmissionKind::partition_without_gain:
      return "partition without gain";
    case OmissionKind::partition_in_stable_fit:
      return "partition in stable fit";
    case OmissionKind::face_without_receiver:
      return "face without receiver";
    case OmissionKind::face_without_caster:
      return "face without caster";
    case OmissionKind::resolution_without_gain:
      return "texels finer than requested";
    case OmissionKind::receiver_near_light:
      return "receivers near the light";
    case OmissionKind::depth_near_light:
      return "depths near the light";
    case OmissionKind::view_without_receiver:
      return "view without receiver";
    case OmissionKind::pages_coarsened:
      return "pages coarsened";
    case OmissionKind::points_left_coarser:
      return "points left to coarser pages";
    case OmissionKind::points_beyond_levels:
      return "points beyond the deepest level";
    case OmissionKind::shape_without_gain:
      return "shape without gain";
    case OmissionKind::plane_without_receiver:
      return "plane without receiver";
    case OmissionKind::plane_without_caster:
      return "plane without caster";
    case OmissionKind::cascade_without_gain:
      return "cascade without gain";
    case OmissionKind::cascade_on_planes:
      return "cascade on planes";
    case OmissionKind::faces_less_divided:
      return "faces less divided";
    case OmissionKind::option_ignored:
      return "option without use";
  }
  return "?";
}

}  // namespace

namespace {

/// A grid over a map of a light with a position, at shares of its range: few points of a body are in a narrow
/// cone.
void add_grid(const ShadowPlan& plan, const ShadowMap& map, std::vector<glm::dvec3>& points) {
  const Real4x4 relative_from_clip = glm::inverse(relative_matrix(map.clip_from_world, plan.origin_world));
  const Real3 apex = Real3(glm::dvec3(map.light_world)) - Real3(plan.origin_world);
  for (const Real x : {-0.9L, 0.1L, 0.8L}) {
    for (const Real y : {-0.8L, 0.0L, 0.9L}) {
      const Real4 far_clip = relative_from_clip * Real4(x, y, 1.0L, 1.0L);
      const Real3 ray = Real3(far_clip) / far_clip.w - apex;
      for (const Real share : {0.1L, 0.4L, 0.95L})
        points.push_back(glm::dvec3(apex + ray * share + Real3(plan.origin_world)));
    }
  }
}

}  // namespace

std::vector<glm::dvec3> points_of(const Input& input, const ShadowPlan& plan, int index, int between,
                                  std::uint64_t seed) {
  const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
  std::vector<glm::dvec3> points;
  if (map.light_world.w != 0.0) add_grid(plan, map, points);
  for (const Box& box : input.receivers) {
    if (box.empty()) continue;
    const std::vector<Real3> corners = visible_vertices(input.camera, box, map.depth_begin, map.depth_end);
    const auto add = [&](const Real3& p) {
      const glm::dvec3 world(p + Real3(plan.origin_world));
      // Of a light with a position a map shows a part of the body.
      if (plan.selection == MapSelection::view_depth || map_holds(plan, map, world)) points.push_back(world);
    };
    for (const Real3& p : corners) add(p);
    Random random(seed);
    for (int i = 0; i < between && !corners.empty(); ++i) {
      const auto count = static_cast<int>(corners.size());
      Real3 p(0.0L);
      Real sum = 0.0L;
      for (int k = 0; k < 3; ++k) {
        const Real weight = random.unit() + 1e-3;
        p += corners[static_cast<std::size_t>(random.pick(count))] * weight;
        sum += weight;
      }
      add(p / sum);
    }
  }
  return points;
}

bool all_finite(const ShadowPlan& plan) {
  for (const ShadowMap& map : plan.maps()) {
    for (int c = 0; c < 4; ++c) {
      for (int r = 0; r < 4; ++r) {
        if (!std::isfinite(map.clip_from_world[c][r]) || !std::isfinite(map.clip_from_camera_relative[c][r]))
          return false;
      }
    }
    for (const double v :
         {map.depth_begin, map.depth_end, map.kappa, map.texel_world.x, map.texel_world.y,
          map.texel_world_max.x, map.texel_world_max.y, map.depth_range_world, map.bias_world.constant,
          map.bias_world.slope, map.bias_world.normal_offset, map.m_s_max, map.m_t_max, map.storage}) {
      if (!std::isfinite(v)) return false;
    }
    for (int i = 0; i < map.cull_plane_count; ++i) {
      const glm::dvec4 p = map.cull_planes[static_cast<std::size_t>(i)];
      if (!std::isfinite(p.x + p.y + p.z + p.w)) return false;
    }
  }
  return true;
}

Judgement judge(const Input& input, const ShadowPlan& plan) {
  Judgement out;
  out.finite = all_finite(plan);
  for (int i = 0; i < plan.map_count; ++i) {
    judge_points(input, plan, i, out);
    judge_condition(input, plan, i, out);
    const ShadowMap& map = plan.map[static_cast<std::size_t>(i)];
    const double side = std::max(map.width, map.height);
    const double ulp = std::nextafter(side, 2.0 * side) - side;
    worst(out.error_ulp, out.error_texels / ulp);
  }
  return out;
}

double texel_density(const ShadowMap& map, const glm::dvec3& point) {
  const glm::dvec4 clip = map.clip_from_world * glm::dvec4(point, 1.0);
  if (!(clip.w > 0.0)) return 0.0;
  glm::dvec3 row[2];
  for (int i = 0; i < 2; ++i) {
    for (int c = 0; c < 3; ++c)
      row[i][c] = (map.clip_from_world[c][i] - clip[i] / clip.w * map.clip_from_world[c][3]) / clip.w;
    row[i] *= 0.5 * (i == 0 ? map.width : map.height);
  }
  return glm::length(glm::cross(row[0], row[1]));
}

std::string used_by(const Input& input, const ShadowPlan& plan) {
  if (plan.status == PlanStatus::invalid_input) return "refused: " + std::string(plan.invalid_field);
  if (plan.status != PlanStatus::ok) return std::string(to_string(plan.status));
  bool cube = std::holds_alternative<PointLight>(input.light) || plan.map_count > 1;
  for (const Omission& o : plan.omitted())
    cube =
        cube || o.kind == OmissionKind::face_without_receiver || o.kind == OmissionKind::face_without_caster;
  if (!std::holds_alternative<DirectionalLight>(input.light) && cube)
    return "cube, " + std::to_string(plan.map_count) + " faces";
  std::string names;
  for (const ShadowMap& map : plan.maps()) {
    const std::string name(map.warp->name);
    if (names.find(name) == std::string::npos) names += (names.empty() ? "" : "+") + name;
  }
  return names;
}

std::string left_out_of(const ShadowPlan& plan) {
  std::vector<std::pair<OmissionKind, int>> kinds;
  for (const Omission& o : plan.omitted()) {
    const auto at =
        std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.first == o.kind; });
    if (at == kinds.end())
      kinds.emplace_back(o.kind, 1);
    else
      ++at->second;
  }
  std::string text;
  for (const auto& [kind, times] : kinds) {
    text += (text.empty() ? "" : ", ") + std::string(kind_name(kind));
    if (times > 1) text += " x" + std::to_string(times);
  }
  return text;
}

}  // namespace gnomon::stress
