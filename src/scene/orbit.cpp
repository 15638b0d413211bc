// A flight round what a scene is about, or inside of it where it is a room.
#include "orbit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "inside.hpp"

namespace gnomon::detail {
namespace {

constexpr int kKeys = 32, kPerKey = 2;  // keys, and angles looked at from each to the next
constexpr int kAngles = kKeys * kPerKey;

// From the centre to an eye on the orbit, unit length. `rise`: height of the eye, of its distance.
glm::dvec3 towards_eye(double angle, double rise) {
  const double out = std::sqrt(1.0 - rise * rise);
  return {out * std::sin(angle), rise, out * std::cos(angle)};
}

void add_corners(const Box& box, const glm::dvec3& center, std::vector<glm::dvec3>& points) {
  for (int corner = 0; corner < 8; ++corner)
    points.push_back(glm::dvec3((corner & 1) != 0 ? box.max.x : box.min.x,
                                (corner & 2) != 0 ? box.max.y : box.min.y,
                                (corner & 4) != 0 ? box.max.z : box.min.z) -
                     center);
}

// Points that a view of the whole must show, from `center`: the vertices where they are few, else the corners
// of the pieces' boxes; those of `bounds` where there is neither.
std::vector<glm::dvec3> content_of(const Scene& scene, const ViewSubject& subject, const Box& bounds,
                                   const glm::dvec3& center) {
  constexpr std::size_t kMaxPathTriangles = 70'000;  // some milliseconds for all directions
  std::size_t triangles = 0;
  for (const Piece& piece : subject.pieces) triangles += piece.triangles.size();
  std::vector<glm::dvec3> points;
  for (const Piece& piece : subject.pieces) {
    if (triangles > kMaxPathTriangles) {
      add_corners(piece.bounds, center, points);
      continue;
    }
    for (const std::uint32_t first : piece.triangles)
      for (const glm::dvec3& corner : corners_of(scene, *piece.instance, first))
        points.push_back(corner - center);
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

// A closed orbit about the points, from a height that shows the tops of things and, at each place, as near as
// holds all of them in a view of this aspect. Relative to the centre.
CameraPath round_about(const std::vector<glm::dvec3>& points, double aspect, double rise) {
  constexpr double kRoom = 1.06;  // over what the view would just hold: the curve cuts corners between keys
  constexpr double kNearest = 1e-3;  // near plane, of the distance: a corner may come that close
  CameraPath path;
  path.closed = true;
  const double slope = std::tan(path.fov_y_radians / 2.0);
  std::array<Standing, kAngles> around;
  for (std::size_t i = 0; i < kAngles; ++i)
    around[i] = standing(points, towards_eye(2.0 * std::numbers::pi * static_cast<double>(i) / kAngles, rise),
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
    const glm::dvec3 to_eye = towards_eye(2.0 * std::numbers::pi * static_cast<double>(key) / kKeys, rise);
    path.keys.push_back({s.target + to_eye * s.distance, s.target});
    reach = std::max(reach, (s.distance + s.farthest) * 1.1);
    gap = std::min(gap, s.distance - s.nearest);
    widest = std::max(widest, s.distance);
  }
  path.near_depth = std::max(gap * 0.5, widest * kNearest);
  path.far_depth = reach;
  return path;
}

// Whether no line of sight from an eye to its target dips under one of these grounds.
bool is_over(const Scene& scene, const std::vector<Piece>& lands, const CameraPath& path,
             const glm::dvec3& center) {
  constexpr int kSteps = 6;  // from the eye to two thirds of the way
  for (const Piece& land : lands)
    for (const std::uint32_t first : land.triangles) {
      const auto corners = corners_of(scene, *land.instance, first);
      const glm::dvec3 a = corners[0] - center, b = corners[1] - center, c = corners[2] - center;
      const double area = (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
      if (area == 0.0) continue;
      for (const CameraKey& key : path.keys)
        for (int i = 0; i < kSteps; ++i) {
          const glm::dvec3 at = key.position + (key.target - key.position) * (i / 1.5 / kSteps);
          const double v = ((at.x - a.x) * (c.z - a.z) - (at.z - a.z) * (c.x - a.x)) / area,
                       w = ((b.x - a.x) * (at.z - a.z) - (b.z - a.z) * (at.x - a.x)) / area;
          if (v >= 0.0 && w >= 0.0 && v + w <= 1.0 && at.y < a.y + v * (b.y - a.y) + w * (c.y - a.y))
            return false;
        }
    }
  return true;
}

// Puts the fullest picture in the middle of the orbit, as near to the front of the scene (+Z) as that allows,
// and behind it only where the front shows next to nothing. Returns the covered share there.
double show_well(CameraPath& path, const std::vector<SurfaceSample>& samples, double aspect) {
  constexpr int kAside = kKeys / 5;  // keys to each side of the front: 67 degrees
  constexpr std::size_t kOfFront = 2 * kAside + 1;
  constexpr double kNearlyBest = 0.8, kNextToNothing = 0.25;  // of the best
  constexpr int kHeight = 90;                                 // pixels; only their ratio counts
  std::vector<std::size_t> keys;
  for (int aside = 0; aside < kKeys / 2; ++aside) {
    keys.push_back(static_cast<std::size_t>(aside));
    if (aside > 0) keys.push_back(static_cast<std::size_t>(kKeys - aside));
  }
  std::vector<double> shares;
  for (const std::size_t key : keys) {
    CameraPath still = path;
    still.keys = {path.keys[key]};
    shares.push_back(
        covered_share(samples, still.at(0.0, static_cast<int>(std::lround(kHeight * aspect)), kHeight)));
  }
  double best = *std::max_element(shares.begin(), shares.begin() + kOfFront);
  const double best_of_all = *std::max_element(shares.begin(), shares.end());
  if (best < kNextToNothing * best_of_all) best = best_of_all;
  std::size_t chosen = 0;
  while (shares[chosen] < kNearlyBest * best) ++chosen;
  put_in_the_middle(path, keys[chosen]);
  return shares[chosen];
}

// From 25 degrees up, and from higher where what lies flat fills too little, or hills stand before it.
CameraPath outside_path(const Scene& scene, const ViewSubject& subject, const std::vector<glm::dvec3>& points,
                        const std::vector<SurfaceSample>& samples, const glm::dvec3& center, double aspect) {
  constexpr std::array<double, 3> kRises{0.42, 0.64, 0.82};  // sines of 25, 40 and 55 degrees
  constexpr double kEnough = 0.3, kWorthIt = 1.25;
  constexpr double kFlat = 0.4;  // height, of the extent
  const glm::dvec3 size = subject.bounds.max - subject.bounds.min;
  const bool flat = size.y < kFlat * std::max(size.x, size.z);
  CameraPath best;
  double most = 0.0;
  bool clear = false;
  for (const double rise : kRises) {
    CameraPath path = round_about(points, aspect, rise);
    const double share = show_well(path, samples, aspect);
    const bool over = is_over(scene, subject.lands, path, center);
    if (best.keys.empty() || (over && !clear) || (over == clear && share > kWorthIt * most)) {
      best = std::move(path);
      most = share;
      clear = over;
    }
    if (clear && (most >= kEnough || !flat || samples.empty())) break;
  }
  return best;
}

}  // namespace

void put_in_the_middle(CameraPath& path, std::size_t key) {
  const CameraKey wanted = path.keys[key];
  std::size_t best = 0;
  constexpr double kLess = 0.999999;  // than rounding
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t turn = 0; turn < path.keys.size(); ++turn) {
    const Camera middle = path.at(0.5, 1, 1);
    const glm::dvec3 off = middle.position - wanted.position;
    const double distance = glm::dot(off, off);
    if (distance < kLess * least) {
      least = distance;
      best = turn;
    }
    std::rotate(path.keys.begin(), path.keys.begin() + 1, path.keys.end());
  }
  std::rotate(path.keys.begin(), path.keys.begin() + static_cast<std::ptrdiff_t>(best), path.keys.end());
}

CameraPath orbit(const Scene& scene, double aspect) {
  // Of the coordinates: doubles round them by 1e-16, and a smaller scene by more than parts of a pixel.
  constexpr double kLeastSize = 1e-12;
  constexpr double kStandIn = 1e-4;  // of the coordinates, in the place of a scene without size
  constexpr int kSamples = 24'000;   // a scene's extent over 150
  const ViewSubject subject = view_subject(scene);
  const Box& bounds = subject.pieces.empty() ? scene.bounds_world : subject.bounds;
  const glm::dvec3 center = bounds.empty() ? glm::dvec3(0.0) : (bounds.min + bounds.max) * 0.5;
  const double farthest = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
  std::vector<glm::dvec3> points;
  std::vector<SurfaceSample> samples;
  if (!bounds.empty() && glm::length(bounds.max - bounds.min) > 2.0 * farthest * kLeastSize) {
    points = content_of(scene, subject, bounds, center);
    samples = surface_samples(scene, subject.pieces, center, kSamples);
  }
  const double least = farthest > 0.0 ? farthest * kStandIn : 1.0;
  if (points.empty()) add_corners({glm::dvec3(-least), glm::dvec3(least)}, glm::dvec3(0.0), points);
  const std::optional<CameraPath> inside = inside_path(subject, samples, center);
  CameraPath path = inside ? *inside : outside_path(scene, subject, points, samples, center, aspect);
  for (CameraKey& key : path.keys) {
    key.position += center;
    key.target += center;
  }
  if (subject.all && !inside) return path;
  if (inside) path.far_depth = 0.0;
  // Grounds and skies are seen as well, and lie nearer and farther.
  std::vector<Box> boxes;
  for (const Instance& instance : scene.instances)
    if (instance.shown && !instance.bounds_world.empty()) boxes.push_back(instance.bounds_world);
  for (const CameraKey& key : path.keys) {
    const Sight sight = sight_from(key.position, boxes);
    if (!inside) path.near_depth = std::min(path.near_depth, sight.near_depth);
    path.far_depth = std::max(path.far_depth, sight.far_depth);
  }
  return path;
}

}  // namespace gnomon::detail
