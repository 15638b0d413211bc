// What of a drawn scene, or of its panes, moves from frame to frame?
#include <algorithm>

#include "frame/renderer_impl.hpp"

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

void Renderer::Impl::move(std::size_t instance, const Instance& to) {
  movers.move(instance, to.bounds_world);
  scene.move(instance, to);
}

bool Renderer::move_instance(std::size_t instance, const Instance& to) {
  if (instance >= impl_->scene.boxes().size() || to.bounds_world.empty()) return false;
  impl_->posed = {};
  impl_->move(instance, to);
  return true;
}

bool Renderer::apply_pose(const Pose& pose) {
  Impl& impl = *impl_;
  return apply(
      pose, impl.posed, impl.scene,
      [&](const PosedVertices& range, std::span<const glm::vec3> positions) {
        impl.movers.bend(range.instance, range.first_vertex, positions);
      },
      [&](std::size_t instance, const Instance& to) { impl.move(instance, to); });
}

bool Renderer::move_pane(std::size_t instance, const Instance& to) {
  Impl& impl = *impl_;
  if (!impl.panes || instance >= impl.panes->scene().boxes().size() || to.bounds_world.empty()) return false;
  impl.pane_posed = {};
  impl.panes->move(instance, to);
  return true;
}

bool Renderer::apply_pane_pose(const Pose& pose) {
  Impl& impl = *impl_;
  if (!impl.panes) return pose.instances.empty() && pose.vertices.empty();
  return apply(
      pose, impl.pane_posed, impl.panes->scene(), [](const PosedVertices&, std::span<const glm::vec3>) {},
      [&](std::size_t instance, const Instance& to) { impl.panes->move(instance, to); });
}

}  // namespace gnomon::render
