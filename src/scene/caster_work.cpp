// What does drawing each of a scene's instances take?
#include "gnomon/scene/caster_work.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "view_subject.hpp"

namespace gnomon {

std::vector<CasterWork> caster_work(const Scene& scene) {
  std::vector<CasterWork> work;
  work.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[instance.primitive];
    const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
    CasterWork one{primitive.index_count / 3, material.alpha_mode != AlphaMode::opaque};
    for (std::uint32_t i = 0; i < one.triangles; ++i) {
      const auto c = detail::corners_of(scene, instance, primitive.first_index + 3 * i);
      const double area = 0.5 * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
      one.area_world += std::isfinite(area) ? area : 0.0;
    }
    work.push_back(one);
  }
  return work;
}

}  // namespace gnomon
