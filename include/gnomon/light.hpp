// The lights that cast shadows.
#pragma once

#include <glm/vec3.hpp>
#include <variant>

namespace gnomon {

/// Parallel light. `direction` points the way the light travels, from the light into the scene; any non-zero
/// length.
struct DirectionalLight {
  glm::dvec3 direction{0.0, -1.0, 0.0};  ///< direction of travel, any non-zero length
};

/// A cone of light from `position` along `direction`. `outer_radians` is the half angle of the cone, in (0,
/// pi); nothing beyond `range` world units is lit.
struct SpotLight {
  glm::dvec3 position{0.0};              ///< world space
  glm::dvec3 direction{0.0, -1.0, 0.0};  ///< direction of travel, any non-zero length
  double outer_radians = 0.5;            ///< half angle of the cone, in (0, pi)
  double range = 100.0;                  ///< lit distance, world units
};

/// Light into all directions from `position`, up to `range` world units.
struct PointLight {
  glm::dvec3 position{0.0};  ///< world space
  double range = 100.0;      ///< lit distance, world units
};

using Light = std::variant<DirectionalLight, SpotLight, PointLight>;

}  // namespace gnomon
