// Everything that a random frame is drawn from: its scene as it stands at a step, its plan, its renderers.
#include "frame_stage.hpp"

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "base/random.hpp"
#include "frame_scene.hpp"

namespace gnomon::stress {
namespace {

constexpr double kSecondsPerStep = 0.37;
constexpr std::size_t kMostPoints = std::size_t{1} << 17;

std::unique_ptr<render::Renderer> renderer_of(const TranslucentParts& parts, bool panes) {
  auto renderer = std::make_unique<render::Renderer>(parts.opaque);
  if (panes) renderer->add_panes(parts.panes);
  return renderer;
}

Box bounds_of(const Scene& scene) {
  Box bounds;
  for (const Instance& instance : scene.instances) {
    bounds.extend(instance.bounds_world.min);
    bounds.extend(instance.bounds_world.max);
  }
  return bounds;
}

int scale_of(const Scene& scene) {
  const Box bounds = bounds_of(scene);
  return std::ilogb(glm::length(bounds.max - bounds.min));
}

}  // namespace

FrameStage::FrameStage(const nlohmann::ordered_json& frame)
    : setting_(read_frame(frame)), rest_(scene_of_frame(frame)) {
  if (rest_.instances.empty()) throw CaseError("objects: needs at least one");
  if (setting_.panes) {
    parts_ = split_translucent(rest_);
    if (parts_.opaque.instances.empty()) throw CaseError("objects: needs one that is no pane");
  } else {
    parts_.opaque = rest_;
  }
  moves_by_itself_.assign(parts_.opaque.instances.size(), 0);
  if (!setting_.panes) {
    for (const DeformedMesh& mesh : rest_.motion.meshes) moves_by_itself_[mesh.instance] = 1;
    for (const MovedInstance& moved : rest_.motion.instances) moves_by_itself_[moved.instance] = 1;
  }
  keeping_ = anew();
  redrawing_ = anew();
  camera_ = setting_.input.camera;
}

std::unique_ptr<render::Renderer> FrameStage::anew() const {
  return renderer_of(parts_, setting_.panes && !parts_.panes.instances.empty());
}

void FrameStage::advance() {
  ++step_;
  camera_ = setting_.input.camera;
  camera_.position += static_cast<double>(step_) * setting_.camera_step;
  if (step_ > 0 && !setting_.panes) {
    pose_all();
    move_instances();
  }
  boxes_ = ShadowBoxes(parts_.opaque);
  boxes_.add(parts_.panes);
}

void FrameStage::pose_all() {
  if (rest_.motion.animations.empty()) return;
  Pose at;
  (void)pose(rest_, 0, looped_time(rest_.motion.animations[0], kSecondsPerStep * step_), at);
  apply_pose(at, parts_.opaque);
  (void)keeping_->apply_pose(at);
  (void)redrawing_->apply_pose(at);
}

/// One or two instances, of those that no animation moves; never the first, which is the ground.
void FrameStage::move_instances() {
  Random random(setting_.move_seed * 64 + static_cast<std::uint64_t>(step_));
  const int count = random.pick(3);
  for (int i = 0; i < count; ++i) {
    const auto all = static_cast<int>(parts_.opaque.instances.size());
    const auto chosen = static_cast<std::size_t>(random.pick(all));
    const double x = random.between(-1.0, 1.0), y = random.between(-0.2, 0.4), z = random.between(-1.0, 1.0);
    if (chosen == 0 || moves_by_itself_[chosen] != 0) continue;
    const glm::dvec3 by = setting_.scale * glm::dvec3(x, y, z);
    Instance& instance = parts_.opaque.instances[chosen];
    instance.world_from_object = glm::translate(glm::dmat4(1.0), by) * instance.world_from_object;
    instance.bounds_world = {instance.bounds_world.min + by, instance.bounds_world.max + by};
    (void)keeping_->move_instance(chosen, instance);
    (void)redrawing_->move_instance(chosen, instance);
  }
}

std::vector<glm::dvec3> FrameStage::seen_points() {
  render::FrameOptions options = setting_.options;
  options.prune = kPruneNothing;
  const render::FilterSettings hard = render::default_settings(render::filters::hard);
  redrawing_->draw(ShadowPlan{}, camera_, redrawing_->prepare(hard), options);
  const FloatImage positions = redrawing_->positions(), normals = redrawing_->normals();
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < positions.values.size(); i += 4) {
    if (normals.values[i + 3] > 0.0f)
      points.push_back(camera_.position +
                       glm::dvec3(positions.values[i], positions.values[i + 1], positions.values[i + 2]));
  }
  return points;
}

bool FrameStage::plan_by_pages(const View& view, const SceneBounds& bounds) {
  memory_.resize(page_memory(setting_.pages.capacity, kMostPoints));
  pages_ = plan_pages(view, setting_.input.light, bounds, setting_.pages, memory_);
  refused_ = pages_.invalid_field;
  return pages_.status != PlanStatus::invalid_input;
}

bool FrameStage::plan_one_light(const View& view, const SceneBounds& bounds) {
  const LightRequest request{setting_.input.light};
  LightOptions pool;
  pool.plan = setting_.input.options;
  pool.pool_width = pool.pool_height = 2048;
  pool.most_size = 512;
  memory_.resize(light_memory(1, view.points_world.size()));
  lights_ = plan_lights(view, {&request, 1}, bounds, pool, memory_);
  refused_ = lights_.invalid_field;
  if (lights_.status == PlanStatus::invalid_input) return false;
  maps_ = {};
  if (!lights_.lights.empty() && lights_.lights[0].map_count > 0) {
    maps_ = make_plan(camera_, setting_.input.light, bounds, light_options(pool, lights_.lights[0]));
    refused_ = maps_.invalid_field;
    return maps_.status != PlanStatus::invalid_input;
  }
  maps_.status = PlanStatus::no_caster;
  return true;
}

bool FrameStage::plan() {
  const std::vector<glm::dvec3> points =
      by_pages() || setting_.visible_points ? seen_points() : std::vector<glm::dvec3>{};
  View view{.camera = camera_};
  view.points_world = points;
  const SceneBounds bounds = boxes_.bounds();
  if (by_pages()) return plan_by_pages(view, bounds);
  if (setting_.source.kind == render::SourceKind::lights) return plan_one_light(view, bounds);
  maps_ = make_plan(view, setting_.input.light, bounds, setting_.input.options);
  refused_ = maps_.invalid_field;
  return maps_.status != PlanStatus::invalid_input;
}

render::FrameStats FrameStage::draw(render::Renderer& renderer, const render::FrameOptions& options) const {
  const render::PreparedFilter filter = renderer.prepare(setting_.filter, setting_.source);
  if (by_pages()) return renderer.draw(pages_, camera_, filter, options);
  if (setting_.source.kind != render::SourceKind::lights)
    return renderer.draw(maps_, camera_, filter, options);
  const render::DrawnLight light{setting_.input.light, &maps_};
  return renderer.draw({lights_, {&light, 1}}, camera_, filter, options);
}

bool FrameStage::same_scale() const noexcept {
  return setting_.panes || scale_of(rest_) == scale_of(parts_.opaque);
}

}  // namespace gnomon::stress
