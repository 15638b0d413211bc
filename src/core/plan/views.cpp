// One plan for several cameras: which of them see receivers, and what they share.
#include "gnomon/plan.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "map/shared_views.hpp"
#include "plan/frame.hpp"
#include "plan/input.hpp"
#include "plan/merge.hpp"

namespace gnomon {
namespace {

/// The first broken field of any camera, or of what they share.
std::string_view first_invalid_field(std::span<const Camera> cameras, const Light& light,
                                     const SceneBounds& bounds, const PlanOptions& options) noexcept {
  if (cameras.empty() || cameras.size() > kMaxViews) return "cameras";
  // Bounds may be many: they are looked at once.
  const auto field = first_invalid_field(cameras[0], light, bounds, options);
  if (!field.empty()) return field;
  for (const Camera& camera : cameras.subspan(1)) {
    if (camera.orthographic != cameras[0].orthographic) return "cameras";
    const auto of_camera = first_invalid_field(camera, light, SceneBounds{}, options);
    if (!of_camera.empty()) return of_camera;
  }
  return {};
}

glm::dvec3 mean_eye(std::span<const Camera> cameras) noexcept {
  glm::dvec3 sum(0.0);
  for (const Camera& camera : cameras) sum += camera.position / static_cast<double>(cameras.size());
  return sum;
}

/// False where the camera sees no receiver.
bool place_view(const Camera& camera, const SceneBounds& bounds, const glm::dvec3& origin,
                SharedView& view) noexcept {
  view.camera = with_finite_far(camera, bounds.receivers);
  view.axes = camera_axes(camera);
  view.eye = camera.position - origin;
  view.body = view_slice(view, view.camera.near_depth, view.camera.far_depth);
  clip(view.body, visible_bounds(view.body, bounds.receivers, origin));
  return !view.body.empty();
}

/// Options that serve all views alike: a point has one view depth for each, but one place in the world.
PlanOptions shared_options(PlanOptions options) noexcept {
  options.split.selection = MapSelection::finest;
  if (divides_parallel(options.split.partition)) options.split.partition = Partition::view_depth;
  if (options.split.scheme == SplitScheme::optimal) options.split.scheme = SplitScheme::logarithmic;
  return options;
}

}  // namespace

ShadowPlan plan_views(std::span<const Camera> cameras, const Light& light, const SceneBounds& bounds,
                      const PlanOptions& options) noexcept {
  ShadowPlan plan;
  plan.invalid_field = first_invalid_field(cameras, light, bounds, options);
  if (!plan.invalid_field.empty()) return plan;
  const PlanOptions shared = shared_options(options);
  if (cameras.size() == 1) return make_plan(cameras[0], light, bounds, shared);
  const glm::dvec3 origin = mean_eye(cameras);
  std::array<SharedView, kMaxViews> seeing;
  std::array<int, kMaxViews> blind{};
  std::size_t seeing_count = 0, blind_count = 0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (place_view(cameras[i], bounds, origin, seeing[seeing_count])) {
      ++seeing_count;
    } else {
      blind[blind_count++] = static_cast<int>(i);
    }
  }
  const std::span<const SharedView> views{seeing.data(), seeing_count};
  if (views.empty()) {
    plan.status = PlanStatus::nothing_visible;
    plan.origin_world = origin;
    plan.clip_space = options.clip_space;
  } else {
    plan = plan_shared(views, mean_camera(views, origin), light, bounds, shared);
  }
  for (std::size_t i = 0; i < blind_count; ++i)
    omit(plan, {OmissionKind::view_without_receiver, -1, static_cast<double>(blind[i]), 0.0, 0});
  if (divides_parallel(options.split.partition)) omit(plan, IgnoredOption::partition);
  if (options.cadence.frames > 1) omit(plan, IgnoredOption::cadence);
  return plan;
}

}  // namespace gnomon
