// What make_plan refuses: the contract at the API's edge.
#include "plan/input.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/usable.hpp"
#include "geometry/vector.hpp"
#include "gnomon/bounds.hpp"

namespace gnomon {
namespace {

// Smallest near plane relative to the far plane: beyond it 1 / depth weights lose all meaning.
constexpr double kNearestRatio = 1e-12;

constexpr int kCubeFaces = 6;
constexpr double kPi = 3.141592653589793;

bool is_direction(const glm::dvec3& v) noexcept {
  return usable(v) && largest_component(v) > 0.0;
}

bool any_unusable(const Boxes& boxes) noexcept {
  if (boxes.set() != nullptr) return !boxes.set()->usable();
  for (const Box& box : boxes.list()) {
    if (!usable(box)) return true;
  }
  return false;
}

std::string_view invalid_camera(const Camera& c) noexcept {
  if (!usable(c.position)) return "camera.position";
  if (!is_direction(c.forward)) return "camera.forward";
  if (!usable(c.up)) return "camera.up";
  // As perspective_camera leaves them. Not compared, which raises a floating-point exception.
  if (std::isnan(c.left) && std::isnan(c.right) && std::isnan(c.bottom) && std::isnan(c.top))
    return "camera: fov_y_radians is in (0, pi), not in degrees";
  if (!usable(c.left) || !usable(c.right) || !(c.left < c.right)) return "camera.left, camera.right";
  if (!usable(c.bottom) || !usable(c.top) || !(c.bottom < c.top)) return "camera.bottom, camera.top";
  if (!usable(c.near_depth)) return "camera.near_depth";
  const bool endless = c.far_depth == std::numeric_limits<double>::infinity();
  if (!endless && (!usable(c.far_depth) || !(c.near_depth < c.far_depth))) return "camera.far_depth";
  const double nearest = endless ? 0.0 : kNearestRatio * c.far_depth;
  if (!c.orthographic && !(c.near_depth > 0.0 && c.near_depth >= nearest)) return "camera.near_depth";
  if (c.width < 1 || c.height < 1 || c.width > 1 << 20 || c.height > 1 << 20)
    return "camera.width, camera.height";
  return {};
}

struct InvalidLight {
  std::string_view operator()(const DirectionalLight& l) const noexcept {
    return is_direction(l.direction) ? std::string_view{} : "light.direction";
  }
  std::string_view operator()(const SpotLight& l) const noexcept {
    if (!usable(l.position)) return "light.position";
    if (!is_direction(l.direction)) return "light.direction";
    if (!(l.outer_radians > 0.0 && l.outer_radians < kPi)) return "light.outer_radians";
    return usable(l.range) && l.range > 0.0 ? std::string_view{} : "light.range";
  }
  std::string_view operator()(const PointLight& l) const noexcept {
    if (!usable(l.position)) return "light.position";
    return usable(l.range) && l.range > 0.0 ? std::string_view{} : "light.range";
  }
};

bool usable_splits(const PlanOptions& o) noexcept {
  if (o.split.scheme != SplitScheme::given) return true;
  for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(o.cascades); ++i) {
    if (!usable(o.split.given[i]) || (i > 0 && !(o.split.given[i] >= o.split.given[i - 1]))) return false;
  }
  return true;
}

bool usable_planes(const PlanOptions& o) noexcept {
  for (std::size_t i = 0; i < o.warp.planes.size(); ++i) {
    const WarpPlane& plane = o.warp.planes[i];
    if (plane.thickness == 0.0) continue;
    if (!(plane.thickness > 0.0 && plane.thickness <= kLargest)) return false;
    if (!usable(plane.point_world) || !is_direction(plane.normal)) return false;
    if (o.cascades + static_cast<int>(i) >= kMaxMaps) return false;
  }
  return true;
}

bool usable_budget(const PlanOptions& o, const Light& light) noexcept {
  if (o.resolution.texel_budget == 0) return true;
  const std::int64_t least = std::int64_t{least_budget_side(o)} * least_budget_side(o);
  const int maps = std::holds_alternative<DirectionalLight>(light) ? o.cascades : kCubeFaces;
  return o.resolution.texel_budget >= least * maps;
}

bool usable(const VisibleDepths& depths) noexcept {
  return depths.empty() ? !std::isnan(depths.min + depths.max) : depths.min > 0.0 && depths.max <= kLargest;
}

/// The first option that holds none of its enumerators, such as a byte read from a file.
std::string_view unknown_enumerator(const PlanOptions& o) noexcept {
  if (o.split.partition > Partition::receiver_clusters) return "options.split.partition";
  if (o.split.scheme > SplitScheme::given) return "options.split.scheme";
  if (o.split.range > SplitRange::camera) return "options.split.range";
  if (o.split.selection != MapSelection::view_depth && o.split.selection != MapSelection::finest)
    return "options.split.selection";
  if (o.fit > Fit::warped_stable) return "options.fit";
  if (o.warp.objective > Objective::picture) return "options.warp.objective";
  const ClipSpace& clip = o.clip_space;
  if (clip.ndc_depth > NdcDepth::zero_to_one) return "options.clip_space.ndc_depth";
  if (clip.handedness > Handedness::left) return "options.clip_space.handedness";
  return clip.first_row > FirstRow::y_plus_one ? "options.clip_space.first_row" : std::string_view{};
}

std::string_view invalid_options(const PlanOptions& o) noexcept {
  if (const auto field = unknown_enumerator(o); !field.empty()) return field;
  if (o.resolution.max_size < kLeastMapSize || o.resolution.max_size > kMaxMapSize)
    return "options.resolution.max_size";
  if (o.cascades < 1 || o.cascades > kMaxMaps) return "options.cascades";
  if (!(o.split.lambda >= 0.0 && o.split.lambda <= 1.0)) return "options.split.lambda";
  if (o.split.face_slices < 1 || o.split.face_slices > kMaxMaps) return "options.split.face_slices";
  if (!(o.split.overlap >= 0.0 && o.split.overlap <= 1.0)) return "options.split.overlap";
  if (!(o.resolution.max_error >= 0.0 && o.resolution.max_error <= kLargest))
    return "options.resolution.max_error";
  if (!(o.resolution.prune_error >= kLeastError && o.resolution.prune_error <= kLargest))
    return "options.resolution.prune_error";
  if (!usable_splits(o)) return "options.split.given";
  if (!(o.split.pseudo_near >= 0.0 && o.split.pseudo_near <= kLargest)) return "options.split.pseudo_near";
  if (!(o.filter.texels >= 0.0 && o.filter.texels <= 0.25 * o.resolution.max_size)) {
    return "options.filter.texels";
  }
  if (!(o.filter.world >= 0.0 && o.filter.world <= kLargest)) return "options.filter.world";
  if (!usable(o.warp.focus)) return "options.warp.focus";
  if (!(o.warp.focus_weight >= 1.0 && o.warp.focus_weight <= 1e6)) return "options.warp.focus_weight";
  if (!usable_planes(o)) return "options.warp.planes";
  if (o.resolution.stable_size_steps < 1 || o.resolution.stable_size_steps > 1024)
    return "options.resolution.stable_size_steps";
  if (!(o.light_near_share >= kLeastLightNearShare && o.light_near_share <= kMaxLightNearShare))
    return "options.light_near_share";
  const CadenceOptions& cadence = o.cadence;
  if (cadence.frames < 1 || cadence.frames > kMaxCadenceFrames) return "options.cadence.frames";
  if (!(cadence.largest_step >= 0.0 && cadence.largest_step <= kLargest))
    return "options.cadence.largest_step";
  if (!(cadence.largest_turn >= 0.0 && cadence.largest_turn <= kPi)) return "options.cadence.largest_turn";
  const BiasOptions& b = o.bias;
  for (const double v : {b.constant_texels, b.slope_texels, b.normal_offset_texels, b.max_slope}) {
    if (!(v >= 0.0 && v <= kLargest)) return "options.bias";
  }
  return {};
}

}  // namespace

std::string_view first_invalid_points(const View& view) noexcept {
  for (const glm::dvec3& point : view.points_world) {
    if (!usable(point)) return "view.points_world";
  }
  if (!view.normals_world.empty() && view.normals_world.size() != view.points_world.size())
    return "view.normals_world";
  for (const glm::dvec3& normal : view.normals_world) {
    // A length of 1 but for the rounding of an 8-bit normal.
    const double length2 = glm::dot(normal, normal);
    if (!(length2 > 0.9 && length2 < 1.1)) return "view.normals_world";
  }
  return {};
}

std::string_view first_invalid_field(const View& view, const Light& light, const SceneBounds& bounds,
                                     const PlanOptions& options) noexcept {
  if (const auto field = invalid_camera(view.camera); !field.empty()) return field;
  if (light.valueless_by_exception()) return "light";
  const auto light_field =
      std::holds_alternative<DirectionalLight>(light) ? InvalidLight{}(*std::get_if<DirectionalLight>(&light))
      : std::holds_alternative<SpotLight>(light)      ? InvalidLight{}(*std::get_if<SpotLight>(&light))
                                                      : InvalidLight{}(*std::get_if<PointLight>(&light));
  if (!light_field.empty()) return light_field;
  if (any_unusable(bounds.casters)) return "bounds.casters";
  if (any_unusable(bounds.receivers)) return "bounds.receivers";
  if (const auto field = invalid_options(options); !field.empty()) return field;
  if (view.depths != nullptr && !usable(*view.depths)) return "view.depths";
  if (const auto field = first_invalid_points(view); !field.empty()) return field;
  return usable_budget(options, light) ? std::string_view{} : "options.resolution.texel_budget";
}

}  // namespace gnomon
