// What make_plan refuses: the contract at the API's edge.
#include "plan_input.hpp"

#include <cmath>
#include <limits>

#include "gnomon/caster_set.hpp"
#include "usable.hpp"
#include "vector.hpp"

namespace gnomon {
namespace {

// Smallest near plane relative to the far plane: beyond it 1 / depth weights lose all meaning.
constexpr double kNearestRatio = 1e-12;

constexpr int kCubeFaces = 6;

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
    if (!(l.outer_radians > 0.0 && l.outer_radians < 3.141592653589793)) return "light.outer_radians";
    return usable(l.range) && l.range > 0.0 ? std::string_view{} : "light.range";
  }
  std::string_view operator()(const PointLight& l) const noexcept {
    if (!usable(l.position)) return "light.position";
    return usable(l.range) && l.range > 0.0 ? std::string_view{} : "light.range";
  }
};

bool usable_splits(const PlanOptions& o) noexcept {
  if (o.split != SplitScheme::given) return true;
  if (o.given_splits.size() + 1 != static_cast<std::size_t>(o.cascades)) return false;
  for (std::size_t i = 0; i < o.given_splits.size(); ++i) {
    if (!usable(o.given_splits[i]) || (i > 0 && !(o.given_splits[i] >= o.given_splits[i - 1]))) return false;
  }
  return true;
}

bool usable_budget(const PlanOptions& o, const Light& light) noexcept {
  if (o.texel_budget == 0) return true;
  const std::int64_t least = std::int64_t{least_budget_side(o)} * least_budget_side(o);
  const int maps = std::holds_alternative<DirectionalLight>(light) ? o.cascades : kCubeFaces;
  return o.texel_budget >= least * maps;
}

bool usable(const VisibleDepths& depths) noexcept {
  return depths.empty() ? !std::isnan(depths.min + depths.max) : depths.min > 0.0 && depths.max <= kLargest;
}

std::string_view invalid_options(const PlanOptions& o) noexcept {
  if (o.map_size < kLeastMapSize || o.map_size > kMostMapSize) return "options.map_size";
  if (o.cascades < 1 || o.cascades > kMaxMaps) return "options.cascades";
  if (!(o.lambda >= 0.0 && o.lambda <= 1.0)) return "options.lambda";
  if (!(o.split_overlap >= 0.0 && o.split_overlap <= 1.0)) return "options.split_overlap";
  if (!(o.target_m >= 0.0 && o.target_m <= kLargest)) return "options.target_m";
  if (!(o.prune_m >= kLeastPruneM && o.prune_m <= kLargest)) return "options.prune_m";
  if (!usable_splits(o)) return "options.given_splits";
  if (o.visible_depths != nullptr && !usable(*o.visible_depths)) return "options.visible_depths";
  if (!(o.near_hint >= 0.0 && o.near_hint <= kLargest)) return "options.near_hint";
  if (!(o.filter_radius_texels >= 0.0 && o.filter_radius_texels <= 0.25 * o.map_size)) {
    return "options.filter_radius_texels";
  }
  if (!(o.filter_radius_world >= 0.0 && o.filter_radius_world <= kLargest))
    return "options.filter_radius_world";
  if (!usable(o.focus)) return "options.focus";
  if (!(o.focus_weight >= 1.0 && o.focus_weight <= 1e6)) return "options.focus_weight";
  if (o.stable_size_steps < 1 || o.stable_size_steps > 1024) return "options.stable_size_steps";
  const BiasOptions& b = o.bias;
  for (const double v : {b.constant_texels, b.slope_texels, b.normal_offset_texels, b.max_slope}) {
    if (!(v >= 0.0 && v <= kLargest)) return "options.bias";
  }
  return {};
}

}  // namespace

std::string_view first_invalid_field(const Camera& camera, const Light& light, const SceneBounds& bounds,
                                     const PlanOptions& options) noexcept {
  if (const auto field = invalid_camera(camera); !field.empty()) return field;
  if (light.valueless_by_exception()) return "light";
  const auto light_field =
      std::holds_alternative<DirectionalLight>(light) ? InvalidLight{}(*std::get_if<DirectionalLight>(&light))
      : std::holds_alternative<SpotLight>(light)      ? InvalidLight{}(*std::get_if<SpotLight>(&light))
                                                      : InvalidLight{}(*std::get_if<PointLight>(&light));
  if (!light_field.empty()) return light_field;
  if (any_unusable(bounds.casters)) return "bounds.casters";
  if (any_unusable(bounds.receivers)) return "bounds.receivers";
  if (const auto field = invalid_options(options); !field.empty()) return field;
  return usable_budget(options, light) ? std::string_view{} : "options.texel_budget";
}

}  // namespace gnomon
