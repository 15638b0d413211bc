// Which box holds a primitive's vertices?
#pragma once

#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "gnomon/scene/scene.hpp"

namespace gnomon::detail {

/// Round the transformed vertices.
[[nodiscard]] inline Box transformed_bounds(const Scene& scene, const Primitive& primitive,
                                            const glm::dmat4& world_from_object) noexcept {
  Box box;
  const std::size_t end = static_cast<std::size_t>(primitive.first_index) + primitive.index_count;
  for (std::size_t i = primitive.first_index; i < end; ++i) {
    box.extend(
        glm::dvec3(world_from_object * glm::dvec4(glm::dvec3(scene.positions[scene.indices[i]]), 1.0)));
  }
  return box;
}

template <typename T>
[[nodiscard]] bool is_finite(const glm::vec<3, T>& v) noexcept {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
[[nodiscard]] inline bool is_finite(const Box& box) noexcept {
  return is_finite(box.min) && is_finite(box.max);
}

}  // namespace gnomon::detail
