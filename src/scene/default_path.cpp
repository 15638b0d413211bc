// A flight worth watching for each scene: past near things, with far ones behind them.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string_view>

#include "builtin/builtin.hpp"
#include "gnomon/scene/camera_path.hpp"

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

constexpr double kRise = 0.42;  // of the orbit's distance: 25 degrees up

// From the centre to an eye on the orbit, unit length.
glm::dvec3 towards_eye(double angle) {
  const double out = std::sqrt(1.0 - kRise * kRise);
  return {out * std::sin(angle), kRise, out * std::cos(angle)};
}

// How near an eye in this direction may come to the centre so that a square view of half angle atan(`slope`)
// still holds a box of these half extents, and how much nearer than the centre its nearest corner is.
struct Standing {
  double distance, nearest;
};
Standing standing(const glm::dvec3& half, const glm::dvec3& to_eye, double slope) {
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), to_eye));
  const glm::dvec3 up = glm::cross(to_eye, right);
  Standing result{0.0, 0.0};
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at((corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                        (corner & 4) != 0 ? half.z : -half.z);
    const double aside = std::max(std::abs(glm::dot(right, at)), std::abs(glm::dot(up, at)));
    const double nearer = glm::dot(to_eye, at);
    result.distance = std::max(result.distance, aside / slope + nearer);
    result.nearest = std::max(result.nearest, nearer);
  }
  return result;
}

// Round about what can be seen, from a height that shows the tops of things and as near as holds all of it.
CameraPath orbit(const Box& bounds) {
  constexpr int kKeys = 8;
  constexpr int kAngles = 64;     // looked at for the distance; the curve's own cut corners are within kRoom
  constexpr double kRoom = 1.06;  // over what the view would just hold
  constexpr double kLeastPart = 1e-4;  // of the coordinates: nearer is lost in their rounding
  constexpr double kNearest = 1e-3;    // near plane, of the distance: a corner may come that close
  CameraPath path;
  path.closed = true;
  const glm::dvec3 center = bounds.empty() ? glm::dvec3(0.0) : (bounds.min + bounds.max) * 0.5;
  glm::dvec3 half = bounds.empty() ? glm::dvec3(0.0) : (bounds.max - bounds.min) * 0.5;
  const double farthest = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
  if (!(glm::length(half) > farthest * kLeastPart))
    half = glm::dvec3(farthest > 0.0 ? farthest * kLeastPart : 1.0);
  double distance = 0.0, nearest = 0.0;
  for (int i = 0; i < kAngles; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kAngles;
    const Standing s = standing(half, towards_eye(angle), std::tan(path.fov_y_radians / 2.0));
    distance = std::max(distance, s.distance);
    nearest = std::max(nearest, s.nearest);
  }
  distance *= kRoom;
  for (int i = 0; i < kKeys; ++i) {
    path.keys.push_back({center + towards_eye(2.0 * std::numbers::pi * i / kKeys) * distance, center});
  }
  path.near_depth = std::max((distance - nearest) * 0.5, distance * kNearest);
  path.far_depth = (distance + nearest) * 1.1;
  return path;
}

}  // namespace

CameraPath default_path(const Scene& scene) {
  const std::string_view name = scene.name;
  if (name == "builtin:city") return city_flight();
  if (name == "builtin:fence") return fence_flight();
  if (name == "builtin:hangar") return hangar_flight();
  if (name == "builtin:terrain") return terrain_flight();
  if (name == "builtin:trees") return trees_flight();
  return orbit(scene.bounds_world);
}

}  // namespace gnomon
