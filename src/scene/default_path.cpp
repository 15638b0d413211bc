// A flight worth watching for each scene: past near things, with far ones behind them.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

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

CameraPath glass_flight() {
  return flight(0.1, 120.0,
                {{{-11.0, 3.0, -9.0}, {0.0, 0.6, -1.0}},
                 {{-6.0, 2.2, -9.5}, {0.0, 0.8, -1.0}},
                 {{0.0, 1.8, -8.0}, {1.0, 0.8, 0.0}},
                 {{6.0, 2.0, -7.0}, {1.0, 0.6, 0.5}},
                 {{10.0, 2.6, -1.0}, {0.0, 0.4, 0.0}},
                 {{11.0, 4.5, 7.0}, {0.0, 0.5, -1.5}}});
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

void add_corners(const Box& box, const glm::dvec3& center, std::vector<glm::dvec3>& points) {
  for (int corner = 0; corner < 8; ++corner)
    points.push_back(glm::dvec3((corner & 1) != 0 ? box.max.x : box.min.x,
                                (corner & 2) != 0 ? box.max.y : box.min.y,
                                (corner & 4) != 0 ? box.max.z : box.min.z) -
                     center);
}

double extent_of(const Box& box) {
  const glm::dvec3 size = box.max - box.min;
  return box.empty() ? 0.0 : std::max({size.x, size.y, size.z});
}

// Whether most of an instance's surface faces its middle, as a sky does.
bool faces_inwards(const Scene& scene, const Instance& instance) {
  const Primitive& primitive = scene.primitives[instance.primitive];
  const glm::dvec3 middle = (instance.bounds_world.min + instance.bounds_world.max) * 0.5;
  const auto corner = [&](std::uint32_t k) {
    const glm::dvec3 at(scene.positions[scene.indices[primitive.first_index + k]]);
    return glm::dvec3(instance.world_from_object * glm::dvec4(at, 1.0)) - middle;
  };
  double inwards = 0.0, all = 0.0;
  for (std::uint32_t k = 0; k + 2 < primitive.index_count; k += 3) {
    const glm::dvec3 a = corner(k), b = corner(k + 1), c = corner(k + 2);
    const double outwards = glm::dot(glm::cross(b - a, c - a), a + b + c);
    inwards += std::max(-outwards, 0.0);
    all += std::abs(outwards);
  }
  constexpr double kMost = 0.9;
  return (instance.mirrored ? all - inwards : inwards) > kMost * all;
}

// The instances that a scene is about: without grounds and skies that are many times as large as all the
// rest.
std::vector<const Instance*> subject_of(const Scene& scene) {
  constexpr double kBackdrop = 4.0;  // times the extent of the rest
  constexpr double kFlat = 0.02;     // height of a ground, of its extent
  std::vector<const Instance*> subject;
  for (const Instance& instance : scene.instances)
    if (!instance.bounds_world.empty()) subject.push_back(&instance);
  std::sort(subject.begin(), subject.end(), [](const Instance* a, const Instance* b) {
    return extent_of(a->bounds_world) < extent_of(b->bounds_world);
  });
  std::vector<Box> up_to(subject.size());  // round an instance and all smaller ones
  for (std::size_t i = 0; i < subject.size(); ++i) {
    if (i > 0) up_to[i] = up_to[i - 1];
    up_to[i].extend(subject[i]->bounds_world);
  }
  while (subject.size() > 1) {
    const Instance& largest = *subject.back();
    const double rest = extent_of(up_to[subject.size() - 2]), extent = extent_of(largest.bounds_world);
    const bool ground = largest.bounds_world.max.y - largest.bounds_world.min.y < kFlat * extent;
    if (!(rest > 0.0 && extent > kBackdrop * rest) || !(ground || faces_inwards(scene, largest))) break;
    subject.pop_back();
  }
  return subject;
}

// Points that a view of the whole must show, from `center`: the vertices where they are few, else the corners
// of the instances' boxes; those of `bounds` where there is neither.
std::vector<glm::dvec3> content_of(const Scene& scene, const std::vector<const Instance*>& subject,
                                   const Box& bounds, const glm::dvec3& center) {
  constexpr std::uint64_t kMaxPathVertices = 200'000;  // some milliseconds for all directions
  std::uint64_t vertices = 0;
  for (const Instance* instance : subject) vertices += scene.primitives[instance->primitive].index_count;
  std::vector<glm::dvec3> points;
  for (const Instance* const one : subject) {
    const Instance& instance = *one;
    if (vertices > kMaxPathVertices) {
      if (!instance.bounds_world.empty()) add_corners(instance.bounds_world, center, points);
      continue;
    }
    const Primitive& primitive = scene.primitives[instance.primitive];
    for (std::uint32_t k = 0; k < primitive.index_count; ++k) {
      const glm::dvec3 at(scene.positions[scene.indices[primitive.first_index + k]]);
      points.push_back(glm::dvec3(instance.world_from_object * glm::dvec4(at, 1.0)) - center);
    }
  }
  if (points.empty()) add_corners(bounds, center, points);
  return points;
}

// Where a view in this direction, with these tangents of its half angles, must look and from how far to just
// hold all points; and how far the nearest and the farthest of them are from there along the view.
struct Standing {
  glm::dvec3 target{0.0};
  double distance = 0.0, nearest = 0.0, farthest = 0.0;
};
Standing standing(const std::vector<glm::dvec3>& points, const glm::dvec3& to_eye, double slope_x,
                  double slope_y) {
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), to_eye));
  const glm::dvec3 up = glm::cross(to_eye, right);
  // Each edge of the view holds a point aside by x at a depth where x / slope + nearer <= distance. Looking
  // aside lowers this for one edge and raises it for the other: at best both are equal.
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  double right_edge = kNone, left_edge = kNone, top_edge = kNone, bottom_edge = kNone;
  Standing result;
  for (const glm::dvec3& at : points) {
    const double x = glm::dot(right, at) / slope_x, y = glm::dot(up, at) / slope_y,
                 nearer = glm::dot(to_eye, at);
    right_edge = std::max(right_edge, nearer + x);
    left_edge = std::max(left_edge, nearer - x);
    top_edge = std::max(top_edge, nearer + y);
    bottom_edge = std::max(bottom_edge, nearer - y);
    result.nearest = std::max(result.nearest, nearer);
    result.farthest = std::max(result.farthest, -nearer);
  }
  result.target =
      right * ((right_edge - left_edge) * 0.5 * slope_x) + up * ((top_edge - bottom_edge) * 0.5 * slope_y);
  result.distance = std::max((right_edge + left_edge) * 0.5, (top_edge + bottom_edge) * 0.5);
  return result;
}

// Round about what can be seen, from a height that shows the tops of things and, at each place, as near as
// holds all of it in a view of this aspect.
CameraPath orbit(const Scene& scene, double aspect) {
  constexpr int kKeys = 32, kPerKey = 2;  // keys, and angles looked at from each to the next
  constexpr int kAngles = kKeys * kPerKey;
  constexpr double kRoom = 1.06;  // over what the view would just hold: the curve cuts corners between keys
  // Of the coordinates: doubles round them by 1e-16, and a smaller scene by more than parts of a pixel.
  constexpr double kLeastSize = 1e-12;
  constexpr double kStandIn = 1e-4;  // of the coordinates, in the place of a scene without size
  constexpr double kNearest = 1e-3;  // near plane, of the distance: a corner may come that close
  CameraPath path;
  path.closed = true;
  const std::vector<const Instance*> subject = subject_of(scene);
  Box bounds;
  for (const Instance* instance : subject) bounds.extend(instance->bounds_world);
  if (subject.empty()) bounds = scene.bounds_world;
  const glm::dvec3 center = bounds.empty() ? glm::dvec3(0.0) : (bounds.min + bounds.max) * 0.5;
  const double farthest = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
  std::vector<glm::dvec3> points;
  if (!bounds.empty() && glm::length(bounds.max - bounds.min) > 2.0 * farthest * kLeastSize)
    points = content_of(scene, subject, bounds, center);
  const double least = farthest > 0.0 ? farthest * kStandIn : 1.0;
  if (points.empty()) add_corners({glm::dvec3(-least), glm::dvec3(least)}, glm::dvec3(0.0), points);
  const double slope = std::tan(path.fov_y_radians / 2.0);
  std::array<Standing, kAngles> around;
  for (std::size_t i = 0; i < kAngles; ++i)
    around[i] = standing(points, towards_eye(2.0 * std::numbers::pi * static_cast<double>(i) / kAngles),
                         slope * aspect, slope);
  double widest = 0.0, reach = 0.0, gap = std::numeric_limits<double>::infinity();
  for (std::size_t key = 0; key < kKeys; ++key) {
    // As far as any angle to the key before or after it needs.
    Standing s = around[key * kPerKey];
    for (std::size_t i = 0; i <= 2 * kPerKey; ++i) {
      const Standing& one = around[(key * kPerKey + i + kAngles - kPerKey) % kAngles];
      s.distance = std::max(s.distance, one.distance * kRoom);
      s.nearest = std::max(s.nearest, one.nearest);
      s.farthest = std::max(s.farthest, one.farthest);
    }
    const glm::dvec3 to_eye = towards_eye(2.0 * std::numbers::pi * static_cast<double>(key) / kKeys);
    path.keys.push_back({center + s.target + to_eye * s.distance, center + s.target});
    reach = std::max(reach, (s.distance + s.farthest) * 1.1);
    gap = std::min(gap, s.distance - s.nearest);
    widest = std::max(widest, s.distance);
  }
  path.near_depth = std::max(gap * 0.5, widest * kNearest);
  path.far_depth = reach;
  std::vector<Box> boxes;
  for (const Instance& instance : scene.instances)
    if (!instance.bounds_world.empty()) boxes.push_back(instance.bounds_world);
  if (subject.size() == boxes.size()) return path;
  // Grounds and skies are seen as well, and lie nearer and farther.
  for (const CameraKey& key : path.keys) {
    const Sight sight = sight_from(key.position, boxes);
    path.near_depth = std::min(path.near_depth, sight.near_depth);
    path.far_depth = std::max(path.far_depth, sight.far_depth);
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
  if (name == "builtin:terrain") return terrain_flight();
  if (name == "builtin:trees") return trees_flight();
  return orbit(scene, aspect);
}

}  // namespace gnomon
