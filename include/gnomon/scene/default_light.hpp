// Which light does a scene get that has none? The sun, or a local light over the middle of the scene.
#pragma once

#include <string_view>
#include <vector>

#include "gnomon/bounds.hpp"
#include "gnomon/light.hpp"

namespace gnomon {

enum class LightKind : unsigned char { sun, spot, point };

/// Names as on the command line: sun, spot, point.
[[nodiscard]] std::string_view to_string(LightKind kind) noexcept;
/// False, and `kind` unchanged, for any other name.
[[nodiscard]] bool light_kind_from_name(std::string_view name, LightKind& kind) noexcept;

/// Kind and direction of a light for a scene that has none.
struct LightPlacement {
  LightKind kind = LightKind::sun;  ///< sun, spot or point
  double elevation_deg = 38.0;      ///< above the horizon
  double azimuth_deg = 140.0;       ///< 0: over -Z; 90: over +X
};

/// Sun: parallel light from that direction. Spot: from that direction at 0.6 of the scene's longest side from
/// its middle, half angle 0.6 radians, range 1.5 sides. Point: over the middle at 0.8 of the scene's height,
/// range 0.75 sides; direction does not matter. In a scene that is one point the range is zero, and in an
/// empty one the position is not a number: make_plan refuses both.
[[nodiscard]] Light default_light(const LightPlacement& placement, const Box& scene) noexcept;

/// The range of a local light that reaches all of the scene: twice the diagonal of the box round both. It is
/// 1 where that box is a point.
[[nodiscard]] double covering_range(const glm::dvec3& position, const Box& scene) noexcept;

/// Local lights, even over the ground of the scene: each third a spot that looks down, the others points.
/// Each lights somewhat more than its part of the ground. Equal input gives equal lights. `count` >= 0. Based
/// on: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018.
[[nodiscard]] std::vector<Light> local_lights(int count, const Box& scene);

}  // namespace gnomon
