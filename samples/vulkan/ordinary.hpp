// The cascades that engines ship: practical splits, a sphere round each slice of the camera's frustum,
// snapped to whole texels.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <span>

#include "gnomon/gnomon.hpp"

namespace sample {

struct OrdinaryCascades {
  static constexpr int kCount = 4;
  std::array<glm::dmat4, kCount> clip_from_world;
  std::array<double, kCount> ends;  ///< view depths
};

/// `lambda`: 0 uniform .. 1 logarithmic splits between the camera's near and far plane.
/// Based on: Zhang et al., "Parallel-Split Shadow Maps for Large-scale Virtual Environments", 2006; Valient,
/// "Stable Rendering of Cascaded Shadow Maps", ShaderX6, 2008.
[[nodiscard]] OrdinaryCascades ordinary_cascades(const gnomon::Camera& camera,
                                                 const glm::dvec3& light_direction,
                                                 std::span<const gnomon::Box> casters, int map_size,
                                                 double lambda, const gnomon::ClipSpace& clip_space);

}  // namespace sample
