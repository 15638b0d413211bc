// Do maps that several cameras share hold what each of them sees?
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "check.hpp"
#include "gnomon/motion.hpp"
#include "judge.hpp"

namespace gnomon::stress {
namespace {

/// The eye of a case, another beside it, and one there that looks aside: a pair of glasses, a second player.
std::vector<Camera> cameras_of(const Case& input, bool aside) {
  // As far apart as a thousandth of what is seen, or as the nearest that is: by what the case is of.
  constexpr double kShare = 1e-3;
  const CameraAxes axes = camera_axes(input.camera);
  const double apart = std::max(kShare * input.camera.far_depth, std::abs(input.camera.near_depth));
  std::vector<Camera> cameras{input.camera, input.camera};
  cameras[1].position += apart * axes.right;
  if (!aside) return cameras;
  cameras.push_back(cameras[1]);
  cameras[2].forward = axes.right;
  cameras[2].up = axes.up;
  return cameras;
}

bool same(const ShadowMap& a, const ShadowMap& b) {
  return a.clip_from_world == b.clip_from_world &&
         a.clip_from_camera_relative == b.clip_from_camera_relative && a.depth_begin == b.depth_begin &&
         a.depth_end == b.depth_end && a.width == b.width && a.height == b.height &&
         a.cull_plane_count == b.cull_plane_count && a.m_max == b.m_max &&
         std::equal(a.cull_planes.begin(), a.cull_planes.begin() + a.cull_plane_count, b.cull_planes.begin());
}

/// One camera has the plan of make_plan, whose maps are chosen among by what they hold.
void check_alone(const Case& input, Report& report) {
  if (input.options.split.scheme == SplitScheme::optimal) return;  // logarithmic where cameras may be several
  PlanOptions options = input.options;
  options.split.selection = MapSelection::finest;
  // Several views divide parallel light by depth alone, and so does one that is planned as they are.
  if (options.split.partition != Partition::tetrahedron) options.split.partition = Partition::view_depth;
  const ShadowPlan alone = make_plan(input.camera, input.light, input.bounds(), options);
  const ShadowPlan plan = plan_views({&input.camera, 1}, input.light, input.bounds(), input.options);
  bool equal = plan.status == alone.status && plan.map_count == alone.map_count;
  for (int i = 0; equal && i < plan.map_count; ++i)
    equal = same(plan.map[static_cast<std::size_t>(i)], alone.map[static_cast<std::size_t>(i)]);
  if (!equal)
    report.add("views_of_one_differ", 1.0,
               std::to_string(plan.map_count) + " maps, by make_plan " + std::to_string(alone.map_count));
}

}  // namespace

ShadowPlan as_seen_by(const ShadowPlan& plan, const Camera& camera) {
  ShadowPlan own = plan;
  own.origin_world = camera.position;
  for (int i = 0; i < own.map_count; ++i) {
    ShadowMap& map = own.map[static_cast<std::size_t>(i)];
    map = rebased(map, camera.position);
  }
  return own;
}

void check_views(const Case& input, Report& report) {
  check_alone(input, report);
  for (const bool aside : {false, true}) {
    const std::vector<Camera> cameras = cameras_of(input, aside);
    report.begin_with(aside ? "three views: " : "two views: ");
    const ShadowPlan plan = quiet("plan_views", report, [&] {
      return plan_views(cameras, input.light, input.bounds(), input.options);
    });
    if (plan.status == PlanStatus::invalid_input) {
      report.add("views_refused", 1.0, std::string(plan.invalid_field));
      continue;
    }
    check_numbers(input, plan, report);
    if (!all_finite(plan)) continue;
    ++report.counts().view_plans;
    for (const Camera& camera : cameras) {
      Case own = input;
      own.camera = camera;
      check_points(own, as_seen_by(plan, camera), seen_places(own), report);
    }
  }
  report.begin_with({});
}

}  // namespace gnomon::stress
