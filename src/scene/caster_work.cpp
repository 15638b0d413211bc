// What does drawing each of a scene's instances take?
#include "gnomon/scene/caster_work.hpp"

namespace gnomon {

std::vector<CasterWork> caster_work(const Scene& scene) {
  std::vector<CasterWork> work;
  work.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[instance.primitive];
    const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
    work.push_back({primitive.index_count / 3, material.alpha_mode != AlphaMode::opaque});
  }
  return work;
}

}  // namespace gnomon
