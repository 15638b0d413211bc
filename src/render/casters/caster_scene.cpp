// What of a drawn scene, or of its panes, moves from frame to frame?
#include <algorithm>

#include "casters/caster_scene.hpp"
#include "frame/pane_pass.hpp"

namespace gnomon::render {
namespace {

/// Moves and bends what differs from the pose before, `last`, which becomes this one; `bend` learns of
/// vertices before the scene has them, `move` of instances in its place. False, and nothing moved, where the
/// pose is not of the scene.
template <class Bend, class Move>
bool apply(const Pose& pose, Pose& last, SceneBuffers& scene, Bend&& bend, Move&& move) {
  const auto within = [](std::size_t begin, std::size_t count, std::size_t end) {
    return begin <= end && count <= end - begin;
  };
  for (const PosedInstance& at : pose.instances) {
    if (at.instance >= scene.boxes().size() || at.bounds_world.empty()) return false;
  }
  for (const PosedVertices& range : pose.vertices) {
    if (!within(range.first_vertex, range.count, scene.vertex_count()) ||
        !within(range.first, range.count, std::min(pose.positions.size(), pose.normals.size())))
      return false;
  }
  const bool comparable =
      last.instances.size() == pose.instances.size() && last.vertices.size() == pose.vertices.size();
  std::vector<bool> bent(pose.instances.empty() ? 0 : scene.boxes().size());
  for (std::size_t i = 0; i < pose.vertices.size(); ++i) {
    const PosedVertices& range = pose.vertices[i];
    const auto positions = std::span(pose.positions).subspan(range.first, range.count),
               normals = std::span(pose.normals).subspan(range.first, range.count);
    const auto same = [&](std::span<const glm::vec3> now, const std::vector<glm::vec3>& before) {
      return comparable && within(last.vertices[i].first, range.count, before.size()) &&
             std::equal(now.begin(), now.end(),
                        before.begin() + static_cast<std::ptrdiff_t>(last.vertices[i].first));
    };
    if (comparable && last.vertices[i].first_vertex == range.first_vertex &&
        same(positions, last.positions) && same(normals, last.normals))
      continue;
    if (range.instance < bent.size()) bend(range, positions);
    scene.bend(range.first_vertex, positions, normals);
    if (range.instance < bent.size()) bent[range.instance] = true;
  }
  for (std::size_t i = 0; i < pose.instances.size(); ++i) {
    const PosedInstance& at = pose.instances[i];
    const bool rests = comparable && !bent[at.instance] && last.instances[i] == at;
    if (rests) continue;
    Instance to;
    to.world_from_object = at.world_from_object;
    to.mirrored = at.mirrored;
    to.bounds_world = at.bounds_world;
    move(at.instance, to);
  }
  last = pose;
  return true;
}

}  // namespace

void CasterScene::move(std::size_t instance, const Instance& to) {
  movers.move(instance, to.bounds_world);
  buffers.move(instance, to);
}

void CasterScene::take_moved(std::span<const Box> moved_world) {
  if (!movers.changed_world().empty()) lists.rebuild_casters();
  movers.add(moved_world);
}

DrawnMaps CasterScene::place(const ShadowPlan& plan, const glm::dvec3& camera_world) {
  const DrawnMaps drawn = drawn_maps(plan, camera_world, buffers.origin_step());
  buffers.place(SceneBuffers::Placed::for_camera, camera_world);
  buffers.place(SceneBuffers::Placed::for_maps, drawn.origin_world);
  return drawn;
}

bool apply_pose(const Pose& pose, CasterScene& casters) {
  return apply(
      pose, casters.posed, casters.buffers,
      [&](const PosedVertices& range, std::span<const glm::vec3> positions) {
        casters.movers.bend(range.instance, range.first_vertex, positions);
      },
      [&](std::size_t instance, const Instance& to) { casters.move(instance, to); });
}

bool apply_pose(const Pose& pose, Pose& last, PanePass& panes) {
  return apply(
      pose, last, panes.scene(), [](const PosedVertices&, std::span<const glm::vec3>) {},
      [&](std::size_t instance, const Instance& to) { panes.move(instance, to); });
}

}  // namespace gnomon::render
