// Is a scene a room, and where does one stand in it?
#include "inside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "orbit.hpp"

namespace gnomon::detail {
namespace {

constexpr int kTurns = Surroundings::kTurns;

glm::dvec3 towards(double turn) {  // level, unit; 0: +Z
  const double angle = 2.0 * std::numbers::pi * turn;
  return {std::sin(angle), 0.0, std::cos(angle)};
}

double middle_of_part(int part) {
  return (part + 0.5) / kTurns;
}

// What level parallel rays from eight sides, and those from above, meet first.
struct Outside {
  double front = 0.0;              ///< share of them that meet a front
  std::vector<double> seen_share;  ///< of the samples of each piece; 1 where it has none
};
Outside outside(const ViewSubject& subject, const std::vector<SurfaceSample>& samples,
                const glm::dvec3& origin) {
  constexpr int kCells = 24, kSides = 8;
  constexpr double kSlack = 0.5;  // cells: what lies nearer behind another surface counts as seen
  constexpr double kAway = -0.3;  // cosine: but for what turns its back, as walls within thin walls do
  const glm::dvec3 middle = (subject.bounds.min + subject.bounds.max) * 0.5 - origin;
  const double radius = 0.5 * glm::length(subject.bounds.max - subject.bounds.min);
  const double cell = 2.0 * radius / kCells;
  Outside result;
  std::vector<bool> is_seen(samples.size(), false);
  int front = 0, all = 0;
  for (int side = 0; side <= kSides; ++side) {
    const glm::dvec3 to_eye = side < kSides ? towards(1.0 * side / kSides) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 right =
        side < kSides ? glm::cross(glm::dvec3(0.0, 1.0, 0.0), to_eye) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 up = glm::cross(to_eye, right);
    struct Cell {
      double nearest = -std::numeric_limits<double>::infinity();
      bool front = false;
    };
    std::array<Cell, kCells * kCells> cells{};
    const auto cell_of = [&](const SurfaceSample& sample) -> Cell& {
      const glm::dvec3 at = sample.at - middle;
      const auto index = [&](double along) {
        return static_cast<std::size_t>(std::clamp((along + radius) / cell, 0.0, kCells - 1.0));
      };
      return cells[index(glm::dot(at, up)) * kCells + index(glm::dot(at, right))];
    };
    for (const SurfaceSample& sample : samples) {
      Cell& one = cell_of(sample);
      const double near = glm::dot(sample.at - middle, to_eye);
      if (near > one.nearest) one = {near, glm::dot(sample.normal, to_eye) > 0.0};
    }
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const bool faces = samples[i].two_sided || glm::dot(samples[i].normal, to_eye) > kAway;
      if (faces && glm::dot(samples[i].at - middle, to_eye) > cell_of(samples[i]).nearest - kSlack * cell)
        is_seen[i] = true;
    }
    for (const Cell& one : cells) {
      all += std::isfinite(one.nearest);
      front += std::isfinite(one.nearest) && one.front;
    }
  }
  std::vector<double> seen(subject.pieces.size(), 0.0), of(subject.pieces.size(), 0.0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    of[samples[i].piece] += 1.0;
    if (is_seen[i]) seen[samples[i].piece] += 1.0;
  }
  for (std::size_t i = 0; i < seen.size(); ++i)
    result.seen_share.push_back(of[i] > 0.0 ? seen[i] / of[i] : 1.0);
  result.front = all > 0 ? 1.0 * front / all : 1.0;
  return result;
}

// Whether the scene hides nearly all of its triangles behind its outermost.
bool hides(const ViewSubject& subject, const Outside& seen) {
  constexpr double kMost = 0.65;
  double hidden = 0.0, all = 0.0;
  for (std::size_t i = 0; i < subject.pieces.size(); ++i) {
    const auto triangles = static_cast<double>(subject.pieces[i].triangles.size());
    hidden += triangles * (1.0 - seen.seen_share[i]);
    all += triangles;
  }
  return hidden > kMost * all;
}

// The place with the most room among those that surfaces enclose; nothing where there is none. Relative to
// the samples' origin, as `bounds` is.
std::optional<glm::dvec3> roomiest_place(const std::vector<SurfaceSample>& samples, const Box& bounds) {
  constexpr int kAcross = 7;
  constexpr std::size_t kSome = 6000;  // samples for a first look
  constexpr double kEnclosed = 0.85, kBehind = 0.1;
  constexpr std::size_t kFronts = 24;
  std::vector<SurfaceSample> some;
  for (std::size_t i = 0; i < samples.size(); i += std::max(samples.size() / kSome, std::size_t{1}))
    some.push_back(samples[i]);
  const glm::dvec3 low = bounds.min, size = bounds.max - bounds.min;
  double best = 0.0;
  std::optional<glm::dvec3> place;
  const auto look_from = [&](const glm::dvec3& at) {
    const Surroundings around = surroundings(some, at);
    if (around.enclosed < kEnclosed || around.behind > kBehind) return;
    double room = 0.0;
    for (const double free : around.free) room += std::min(free, glm::length(size)) / kTurns;
    room = room * 0.5 + around.nearest;
    if (room > best) best = room, place = at;
  };
  for (const double height : {0.35, 0.55})
    for (int x = 0; x < kAcross; ++x)
      for (int z = 0; z < kAcross; ++z)
        look_from(low + size * glm::dvec3((x + 0.5) / kAcross, height, (z + 0.5) / kAcross));
  // In front of some surfaces: within a bent tunnel, which a grid would miss.
  for (const double before : {0.01, 0.03})
    for (std::size_t i = 0; i < kFronts; ++i) {
      const SurfaceSample& sample = some[(2 * i + 1) * some.size() / (2 * kFronts)];
      look_from(sample.at + sample.normal * (before * glm::length(size)));
    }
  return place;
}

// A flight round a place, as far out as there is room, that looks across it.
CameraPath round_within(const std::vector<SurfaceSample>& samples, const glm::dvec3& stand) {
  const Surroundings around = surroundings(samples, stand);
  constexpr double kNear = 0.25;  // of the distance to any sample
  constexpr double kBack = 0.7,
                   kPart = 0.5;  // of the free distance: how far back, and how far the target lies
  std::array<double, kTurns> free{};
  for (int i = 0; i < kTurns; ++i) {
    free[static_cast<std::size_t>(i)] = std::isfinite(around.free[i]) ? around.free[i] : around.nearest;
  }
  CameraPath path;
  path.closed = true;
  constexpr double kLonger = 1.000001;  // than rounding
  double longest_view = 0.0;
  std::size_t first = 0;
  for (int i = 0; i < kTurns; ++i) {
    const auto at = [&](int k) { return free[static_cast<std::size_t>((k + kTurns) % kTurns)]; };
    // The curve between keys cuts corners: as far as the ways beside it are free as well.
    const double back = kBack * std::min({at(i - 1), at(i), at(i + 1)});
    const double ahead = at(i + kTurns / 2);
    const glm::dvec3 out = towards(middle_of_part(i));
    path.keys.push_back(
        {stand + out * back, stand - out * (kPart * ahead) - glm::dvec3(0.0, 0.08 * (back + ahead), 0.0)});
    if (back + ahead > kLonger * longest_view) longest_view = back + ahead, first = path.keys.size() - 1;
  }
  put_in_the_middle(path, first);
  double nearest = std::numeric_limits<double>::infinity();
  for (const CameraKey& key : path.keys)
    nearest = std::min(nearest, surroundings(samples, key.position).nearest);
  path.near_depth = kNear * nearest;
  return path;
}

}  // namespace

std::optional<CameraPath> inside_path(const ViewSubject& subject, const std::vector<SurfaceSample>& samples,
                                      const glm::dvec3& origin) {
  constexpr double kFront = 0.5;  // what is seen from behind is no outside
  if (samples.empty()) return std::nullopt;
  const auto place = roomiest_place(samples, {subject.bounds.min - origin, subject.bounds.max - origin});
  if (!place) return std::nullopt;
  const Outside seen = outside(subject, samples, origin);
  if (seen.front >= kFront && !hides(subject, seen)) return std::nullopt;
  return round_within(samples, *place);
}

}  // namespace gnomon::detail
