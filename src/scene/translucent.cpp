// Parts the surfaces that let light through from the rest of a scene.
#include "gnomon/scene/translucent.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace gnomon {

TranslucentParts split_translucent(const Scene& scene) {
  TranslucentParts parts{scene, scene, {}, {}};
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const auto material = static_cast<std::size_t>(scene.primitives[scene.instances[i].primitive].material);
    (is_translucent(scene.materials[material]) ? parts.pane_instances : parts.opaque_instances).push_back(i);
  }
  const auto keep = [&](Scene& part, bool translucent) {
    part.motion = {};
    std::erase_if(part.instances, [&](const Instance& instance) {
      const auto material = static_cast<std::size_t>(scene.primitives[instance.primitive].material);
      return is_translucent(scene.materials[material]) != translucent;
    });
    part.bounds_world = {};
    for (const Instance& instance : part.instances)
      if (!instance.bounds_world.empty()) part.bounds_world.extend(instance.bounds_world);
  };
  keep(parts.opaque, false);
  keep(parts.panes, true);
  return parts;
}

Pose pose_of_part(const Pose& pose, std::span<const std::uint32_t> instances) {
  Pose part;
  // Both lists are in the order of the scene.
  const auto place = [&](std::uint32_t instance) {
    const auto at = std::lower_bound(instances.begin(), instances.end(), instance);
    const bool found = at != instances.end() && *at == instance;
    return found ? std::optional(static_cast<std::uint32_t>(at - instances.begin())) : std::nullopt;
  };
  for (const PosedInstance& posed : pose.instances) {
    const auto at = place(posed.instance);
    if (!at) continue;
    part.instances.push_back(posed);
    part.instances.back().instance = *at;
  }
  for (const PosedVertices& range : pose.vertices) {
    const auto at = place(range.instance);
    if (!at) continue;
    PosedVertices own = range;
    own.instance = *at;
    own.first = part.positions.size();
    const auto begin = static_cast<std::ptrdiff_t>(range.first), end = begin + range.count;
    part.positions.insert(part.positions.end(), pose.positions.begin() + begin, pose.positions.begin() + end);
    part.normals.insert(part.normals.end(), pose.normals.begin() + begin, pose.normals.begin() + end);
    part.vertices.push_back(own);
  }
  return part;
}

}  // namespace gnomon
