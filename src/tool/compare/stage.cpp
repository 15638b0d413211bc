// One scene made ready to be measured: on the GPU, for rays, and with its cameras.
#include "stage.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "animation_words.hpp"
#include "float_channel.hpp"
#include "gnomon/study/expected_error.hpp"
#include "moved_eye.hpp"

namespace gnomon::tool {

Stage::Stage(const Sweep& sweep, const std::string& scene, ExactResults exact)
    : sweep_(sweep),
      exact_(std::move(exact)),
      view_(scene, sweep.light, sweep.camera, limits_of_triangles(sweep.max_triangles), sweep.edits) {
  if (sweep.local_lights > 0) {
    shares_ = TexelShares(local_lights(sweep.local_lights, view_.scene().bounds_world));
    view_.set_light(shares_.light(static_cast<std::size_t>(sweep.local_light)));
  }
  if (!sweep.animation.empty()) {
    animation_ = animation_of(scene, view_.scene().motion, sweep.animation);
    at_rest_ = view_.scene();
  }
  retrace();
  renderer_ = std::make_unique<render::Renderer>(view_.scene());
}

void Stage::retrace() {
  tracer_ = std::make_unique<trace::Tracer>(view_.scene());
}

double Stage::animation_seconds(int frame) const noexcept {
  if (!plays()) return 0.0;
  const Animation& played = at_rest_.motion.animations[static_cast<std::size_t>(animation_)];
  // The middle of one of so many equal parts, as along the camera path.
  return played.duration_s * (frame + 0.5) / sweep_.frames;
}

void Stage::go_to(int frame, At at) {
  at_ = at;
  pose_before(frame, at == At::before ? 1 : 0);
}

void Stage::pose_before(int frame, int viewer_frames) {
  if (!plays()) return;
  constexpr double kViewerSeconds = 1.0 / 60.0;
  const Animation& played = at_rest_.motion.animations[static_cast<std::size_t>(animation_)];
  const double seconds = animation_seconds(frame) - kViewerSeconds * viewer_frames;
  (void)pose(at_rest_, animation_, looped_time(played, seconds), pose_);
  exact_.pose(seconds);
  view_.take(pose_);
  if (!renderer_->apply_pose(pose_)) throw std::runtime_error("the animation's pose does not fit the scene");
}

const Stage::View* Stage::view(const Camera& camera) const noexcept {
  const auto view = std::find_if(views_.begin(), views_.end(), [&](const View& v) {
    return (v.at == at_ || !plays()) && v.camera.position == camera.position &&
           v.camera.forward == camera.forward;
  });
  return view == views_.end() ? nullptr : &*view;
}

ShadowPlan Stage::plan(const SweepEntry& entry, const Camera& camera) const {
  if (entry.captured != nullptr) {
    const CapturedMaps::Frame& frame = *entry.captured->at(camera);
    return moved_eye(frame.plan, frame.camera, camera);
  }
  const View* const view = this->view(camera);
  gnomon::View seen = camera;
  if (view != nullptr && entry.points == PlanPoints::visible) {
    seen.points_world = view->points;
    seen.normals_world = view->normals;
  }
  if (view != nullptr && entry.points == PlanPoints::shadow_edges) seen.points_world = view->edges;
  if (view != nullptr && entry.visible_depths) seen.depths = &view->depths;
  // Once for each plan, as an engine has to: the time of a plan holds it.
  VisibleDepths coarse;
  if (entry.coarse_depths) {
    coarse = coarse_.depths(view_.scene(), camera);
    seen.depths = &coarse;
  }
  const PlanOptions options =
      sweep_.local_lights > 0 && entry.shares_texels
          ? shares_.options_of(static_cast<std::size_t>(sweep_.local_light), seen, view_.bounds(), entry)
          : entry.plan;
  return make_plan(seen, view_.light(), view_.bounds(), options);
}

void Stage::see(int frame) {
  views_.clear();
  const bool looks = std::any_of(sweep_.entries.begin(), sweep_.entries.end(), [](const SweepEntry& entry) {
    return entry.visible_depths || entry.points != PlanPoints::none || entry.by_pages();
  });
  const bool finds_edges =
      std::any_of(sweep_.entries.begin(), sweep_.entries.end(),
                  [](const SweepEntry& entry) { return entry.points == PlanPoints::shadow_edges; });
  if (looks) {
    go_to(frame, At::before);
    views_.push_back(view_through(camera_before(frame)));
    if (finds_edges) views_.back().edges = edges_of(views_.back());
  }
  go_to(frame, At::frame);
  if (!looks) return;
  const std::vector<glm::dvec3> edges = views_.back().edges;
  views_.push_back(view_through(camera(frame)));
  views_.back().edges = edges;
}

std::vector<glm::dvec3> Stage::edges_of(const View& view) {
  constexpr std::size_t kMaxEdges = 4096, kFewest = 64;
  PlanOptions options;
  options.resolution.max_size = sweep_.baseline.technique.map_size;
  render::FrameOptions frame;
  frame.aliasing = frame.heat_map = frame.cascade_tint = frame.time_passes = false;
  renderer_->draw(make_plan(view.camera, view_.light(), view_.bounds(), options), view.camera,
                  filter(sweep_.baseline), frame);
  const FloatImage mask_image = renderer_->mask(), positions = renderer_->positions();
  std::vector<float> mask = channel(mask_image, 0);
  const std::vector<float> maps = channel(mask_image, 1);
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (maps[i] < 0.0f) mask[i] = -1.0f;
  std::vector<glm::dvec3> edges(kMaxEdges);
  edges.resize(shadow_edge_points({view.camera, mask, channel(positions, positions.channels - 1)}, edges));
  // A picture with hardly any shadow says nothing about the next.
  if (edges.size() < kFewest) return view.points;
  // Maps reach no farther than the points: half of them are any that are seen.
  const std::size_t every = std::max<std::size_t>(1, view.points.size() / edges.size());
  for (std::size_t i = every / 2; i < view.points.size(); i += every) edges.push_back(view.points[i]);
  return edges;
}

std::size_t Stage::captured_frame(int frame) const noexcept {
  const std::size_t steps = sweep_.cameras.size() - 1;
  // The middle of one of so many equal parts, as along a path; the first has no frame before it.
  const double at = (frame + 0.5) / sweep_.frames * static_cast<double>(steps);
  return steps == 0 ? 0 : 1 + static_cast<std::size_t>(at);
}

Stage::View Stage::view_through(const Camera& camera) {
  render::FrameOptions surfaces;
  surfaces.aliasing = surfaces.heat_map = surfaces.cascade_tint = surfaces.time_passes = false;
  renderer_->draw(ShadowPlan{}, camera, filter(sweep_.baseline), surfaces);
  const FloatImage positions = renderer_->positions(), normals = renderer_->normals();
  const auto channels = static_cast<std::size_t>(positions.channels);
  View view;
  view.at = at_;
  view.camera = camera;
  // Channels x, y, z relative to the camera, and depth: 0 for the sky.
  for (std::size_t i = 0; i + channels <= positions.values.size(); i += channels) {
    const float *const at = positions.values.data() + i, *const facing = normals.values.data() + i;
    const double depth = at[channels - 1];
    view.depths.add(depth);
    if (!(depth > 0.0 && std::isfinite(depth))) continue;
    view.points.push_back(camera.position + glm::dvec3(at[0], at[1], at[2]));
    view.normals.emplace_back(facing[0], facing[1], facing[2]);
  }
  view.surfaces = std::make_shared<const VisibleSurfaces>(visible_surfaces(positions, nullptr, camera));
  return view;
}

Camera Stage::camera(int frame) const noexcept {
  if (!sweep_.cameras.empty()) return sweep_.cameras[captured_frame(frame)];
  return view_.camera(frame, sweep_.frames, sweep_.width, sweep_.height);
}

Camera Stage::camera_before(int frame) const noexcept {
  if (!sweep_.cameras.empty()) {
    const std::size_t at = captured_frame(frame);
    return sweep_.cameras[at > 0 ? at - 1 : 0];
  }
  return view_.camera_before(frame, sweep_.frames, sweep_.width, sweep_.height);
}

}  // namespace gnomon::tool
