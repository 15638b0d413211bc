// Which part of the world may a map serve?
#pragma once

#include "gnomon/plan.hpp"

namespace gnomon {

/// Inside the planes that part the maps of a cube or of a view's faces, but for the rounding of positions
/// that count from `origin_world`; true where there are none.
[[nodiscard]] bool inside_select_planes(const ShadowMap& map, const glm::dvec3& point_world,
                                        const glm::dvec3& origin_world) noexcept;

}  // namespace gnomon
