// A flight worth watching for each scene: past near things, with far ones behind them.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>
#include <vector>

#include "builtin/builtin.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "orbit.hpp"

namespace gnomon {

namespace {

CameraPath flight(double near_depth, double far_depth, std::vector<CameraKey> keys) {
  CameraPath path;
  path.near_depth = near_depth;
  path.far_depth = far_depth;
  path.keys = std::move(keys);
  return path;
}

// Along a street at the height of its lamps, up over the roofs, and down another street. Streets run midway
// between blocks: at multiples of 100 m.
CameraPath city_flight() {
  return flight(0.5, 2500.0,
                {{{0.0, 4.0, 560.0}, {0.0, 9.0, 440.0}},
                 {{0.0, 6.0, 400.0}, {0.0, 12.0, 280.0}},
                 {{0.0, 14.0, 200.0}, {0.0, 20.0, 60.0}},
                 {{2.0, 60.0, 40.0}, {40.0, 45.0, -120.0}},
                 {{40.0, 130.0, -120.0}, {140.0, 70.0, -300.0}},
                 {{200.0, 120.0, -330.0}, {330.0, 40.0, -480.0}},
                 {{330.0, 130.0, -480.0}, {60.0, 20.0, -260.0}}});
}

CameraPath fence_flight() {
  return flight(0.1, 80.0,
                {{{-15.0, 1.7, 6.0}, {-6.0, 0.9, 0.0}},
                 {{-9.0, 1.5, 4.6}, {-2.0, 0.9, 0.0}},
                 {{-3.0, 1.2, 3.6}, {4.0, 0.8, -1.0}},
                 {{4.0, 1.6, 4.2}, {3.0, 0.6, -3.0}},
                 {{9.0, 3.2, 7.5}, {-1.0, 0.4, -3.0}},
                 {{4.0, 6.0, 13.0}, {0.0, 0.4, -4.0}}});
}

CameraPath hangar_flight() {
  return flight(0.2, 250.0,
                {{{3.0, 2.2, 50.0}, {0.0, 4.0, 20.0}},
                 {{2.0, 3.4, 32.0}, {-1.0, 3.4, 5.0}},
                 {{0.5, 5.0, 14.0}, {-2.0, 2.0, -8.0}},
                 {{-1.0, 6.2, -4.0}, {3.0, 1.0, -20.0}},
                 {{4.0, 6.4, -15.0}, {-6.0, 1.0, -12.0}},
                 {{9.5, 6.6, -9.0}, {-6.0, 1.5, 4.0}},
                 {{11.0, 4.5, 8.0}, {-2.0, 2.0, 24.0}}});
}

CameraPath glass_flight() {
  return flight(0.1, 120.0,
                {{{-11.0, 3.0, -9.0}, {0.0, 0.6, -1.0}},
                 {{-6.0, 2.2, -9.5}, {0.0, 0.8, -1.0}},
                 {{0.0, 1.8, -8.0}, {1.0, 0.8, 0.0}},
                 {{6.0, 2.0, -7.0}, {1.0, 0.6, 0.5}},
                 {{10.0, 2.6, -1.0}, {0.0, 0.4, 0.0}},
                 {{11.0, 4.5, 7.0}, {0.0, 0.5, -1.5}}});
}

CameraPath room_flight() {
  return flight(0.05, 40.0,
                {{{-4.6, 1.7, -3.0}, {0.0, 0.7, 1.0}},
                 {{-2.2, 1.5, -2.6}, {1.5, 0.5, 1.5}},
                 {{0.2, 1.4, -2.4}, {2.5, 0.4, 0.5}},
                 {{2.4, 1.6, -2.2}, {0.5, 0.3, 1.5}},
                 {{4.4, 2.2, -2.8}, {-2.0, 0.2, 1.0}}});
}

CameraPath street_flight() {
  return flight(0.5, 250.0,
                {{{0.0, 4.0, 14.0}, {0.0, 2.5, -20.0}},
                 {{0.5, 3.0, -8.0}, {-4.0, 1.5, -40.0}},
                 {{-1.0, 2.0, -40.0}, {4.0, 1.0, -70.0}},
                 {{0.0, 9.0, -75.0}, {0.0, 0.0, -120.0}},
                 {{2.0, 14.0, -110.0}, {-6.0, 0.0, -150.0}}});
}

CameraPath trees_flight() {
  return flight(0.2, 180.0,
                {{{-56.0, 2.2, 0.0}, {-36.0, 2.4, -1.0}},
                 {{-36.0, 2.0, 0.8}, {-16.0, 2.2, -1.5}},
                 {{-16.0, 1.8, -0.6}, {4.0, 2.0, 3.0}},
                 {{6.0, 2.0, 0.6}, {24.0, 1.8, -4.0}},
                 {{26.0, 2.6, -0.4}, {44.0, 1.6, 6.0}},
                 {{50.0, 7.0, 0.0}, {20.0, 1.0, 0.0}}});
}

CameraPath terrain_flight() {
  constexpr double kAbove = 14.0, kAhead = 90.0;  // metres over the ground, and to the point looked at
  CameraPath path = flight(1.0, 1600.0, {});
  for (int i = 0; i < 8; ++i) {
    const double angle = i * 0.42 - 0.6, radius = 330.0 - i * 32.0;
    const glm::dvec3 over(radius * std::cos(angle), 0.0, radius * std::sin(angle));
    const glm::dvec3 on =
        over + kAhead * glm::normalize(glm::dvec3(-std::sin(angle) - 0.6 * std::cos(angle), 0.0,
                                                  std::cos(angle) - 0.6 * std::sin(angle)));
    // The highest ground around, so that the curve between keys clears it as well.
    double ground = 0.0;
    for (int dx = -40; dx <= 40; dx += 10) {
      for (int dz = -40; dz <= 40; dz += 10)
        ground = std::max(ground, detail::terrain_height(over.x + dx, over.z + dz));
    }
    path.keys.push_back(
        {{over.x, ground + kAbove, over.z}, {on.x, detail::terrain_height(on.x, on.z) + 6.0, on.z}});
  }
  return path;
}

}  // namespace

CameraPath default_path(const Scene& scene, double aspect) {
  const std::string_view name = scene.name;
  if (name == "builtin:city") return city_flight();
  if (name == "builtin:fence") return fence_flight();
  if (name == "builtin:glass") return glass_flight();
  if (name == "builtin:hangar") return hangar_flight();
  if (name == "builtin:room") return room_flight();
  if (name == "builtin:street") return street_flight();
  if (name == "builtin:terrain") return terrain_flight();
  if (name == "builtin:trees") return trees_flight();
  return detail::orbit(scene, aspect);
}

}  // namespace gnomon
