// A light for a scene that brings none: the sun, or a local light in its direction over the scene's middle.
#include "gnomon/scene/default_light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace gnomon {

std::string_view to_string(LightKind kind) noexcept {
  switch (kind) {
    case LightKind::sun:
      return "sun";
    case LightKind::spot:
      return "spot";
    case LightKind::point:
      return "point";
  }
  return "?";
}

bool light_kind_from_name(std::string_view name, LightKind& kind) noexcept {
  for (const LightKind known : {LightKind::sun, LightKind::spot, LightKind::point}) {
    if (to_string(known) != name) continue;
    kind = known;
    return true;
  }
  return false;
}

Light default_light(const LightPlacement& placement, const Box& scene) noexcept {
  const double elevation = placement.elevation_deg * std::numbers::pi / 180.0;
  const double azimuth = placement.azimuth_deg * std::numbers::pi / 180.0;
  const glm::dvec3 to_light{std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                            -std::cos(elevation) * std::cos(azimuth)};
  if (placement.kind == LightKind::sun) return DirectionalLight{-to_light};
  const glm::dvec3 size = scene.max - scene.min, middle = 0.5 * (scene.min + scene.max);
  const double extent = std::max({size.x, size.y, size.z});
  if (placement.kind == LightKind::spot) {
    constexpr double kHalfAngle = 0.6;
    return SpotLight{middle + 0.6 * extent * to_light, -to_light, kHalfAngle, 1.5 * extent};
  }
  return PointLight{middle + glm::dvec3(0.0, 0.3 * size.y, 0.0), 0.75 * extent};
}

double covering_range(const glm::dvec3& position, const Box& scene) noexcept {
  constexpr double kFarther = 2.0;
  Box all = scene;
  all.extend(position);
  const double diagonal = glm::length(all.max - all.min);
  return diagonal > 0.0 ? kFarther * diagonal : 1.0;
}

std::vector<Light> local_lights(int count, const Box& scene) {
  const auto spread = [](int index, double ratio) {
    const double at = 0.5 + index * ratio;
    return at - std::floor(at);
  };
  const glm::dvec3 size = scene.max - scene.min;
  const double spacing = std::sqrt(size.x * size.z / count);
  std::vector<Light> lights;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 at{scene.min.x + size.x * spread(i, 0.7548776662), scene.min.y + 0.25 * spacing,
                        scene.min.z + size.z * spread(i, 0.5698402910)};
    if (i % 3 == 0) {
      lights.emplace_back(
          SpotLight{at + glm::dvec3(0.0, 0.4 * spacing, 0.0), {0.2, -1.0, 0.1}, 0.7, 2.0 * spacing});
    } else {
      lights.emplace_back(PointLight{at, 1.2 * spacing});
    }
  }
  return lights;
}

}  // namespace gnomon
