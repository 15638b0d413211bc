// Parts the surfaces that let light through from the rest of a scene.
#include "gnomon/scene/translucent.hpp"

#include <algorithm>

namespace gnomon {

TranslucentParts split_translucent(const Scene& scene) {
  TranslucentParts parts{scene, scene};
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

}  // namespace gnomon
