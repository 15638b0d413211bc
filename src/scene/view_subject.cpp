// What would a person look at in a scene?
#include "view_subject.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "base/weighted_median.hpp"

namespace gnomon::detail {
namespace {

double extent_of(const Box& box) noexcept {
  const glm::dvec3 size = box.max - box.min;
  return box.empty() ? 0.0 : std::max({size.x, size.y, size.z});
}

Box box_of(const std::array<glm::dvec3, 3>& corners) noexcept {
  Box box;
  for (const glm::dvec3& corner : corners) box.extend(corner);
  return box;
}

Box box_of(const std::vector<Piece>& pieces) noexcept {
  Box box;
  for (const Piece& piece : pieces) box.extend(piece.bounds);
  return box;
}

void add(Piece& piece, std::uint32_t first, const std::array<glm::dvec3, 3>& c) {
  piece.triangles.push_back(first);
  piece.bounds.extend(box_of(c));
  piece.normal_area += glm::cross(c[1] - c[0], c[2] - c[0]) * (piece.instance->mirrored ? -0.5 : 0.5);
}

// Whether these triangles only hang on one or two vertices far from the rest of their mesh.
bool hangs_on_strays(const Scene& scene, const Piece& large, const Box& rest) {
  constexpr std::size_t kStrays = 2;
  std::vector<glm::dvec3> strays;
  for (const std::uint32_t first : large.triangles)
    for (const glm::dvec3& at : corners_of(scene, *large.instance, first)) {
      if (glm::clamp(at, rest.min, rest.max) == at ||
          std::find(strays.begin(), strays.end(), at) != strays.end())
        continue;
      if (strays.size() == kStrays) return false;
      strays.push_back(at);
    }
  return true;
}

// An instance, or its few large triangles apart from many small ones: a ground in the mesh of a town.
// Triangles that hang on a stray vertex are omitted.
bool add_pieces(const Scene& scene, const Instance& instance, std::uint32_t stride,
                std::vector<Piece>& pieces) {
  constexpr double kLarger = 4.0;      // times the box round all that are smaller
  constexpr double kWorthALook = 0.1;  // the largest triangle, of the instance's extent
  constexpr std::size_t kFewest = 4;   // the large ones are at most one in so many
  const Primitive& primitive = scene.primitives[instance.primitive];
  Piece all;
  all.instance = &instance;
  std::vector<std::pair<double, std::uint32_t>> by_extent;
  double largest = 0.0;
  for (std::uint32_t k = 0; k + 2 < primitive.index_count; k += 3 * stride) {
    const std::uint32_t first = primitive.first_index + k;
    const auto corners = corners_of(scene, instance, first);
    add(all, first, corners);
    by_extent.emplace_back(extent_of(box_of(corners)), first);
    largest = std::max(largest, by_extent.back().first);
  }
  if (all.triangles.empty() || all.bounds.empty()) return false;
  const std::size_t count = by_extent.size();
  if (stride == 1 && count > kFewest && largest > kWorthALook * all.extent()) {
    std::stable_sort(by_extent.begin(), by_extent.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    Piece small;
    small.instance = &instance;
    for (std::size_t i = 0; i < count; ++i) {
      const auto [extent, first] = by_extent[i];
      if (i >= count - count / kFewest && extent > kLarger * small.extent() && small.extent() > 0.0) {
        Piece large;
        large.instance = &instance;
        for (std::size_t k = i; k < count; ++k)
          add(large, by_extent[k].second, corners_of(scene, instance, by_extent[k].second));
        const bool stray = hangs_on_strays(scene, large, small.bounds);
        pieces.push_back(std::move(small));
        if (!stray) pieces.push_back(std::move(large));
        return stray;
      }
      add(small, first, corners_of(scene, instance, first));
    }
  }
  all.bounds = instance.bounds_world;
  pieces.push_back(std::move(all));
  return false;
}

// The middle of the middles, axis by axis: where most pieces are, however far some strayed.
glm::dvec3 middle_of(const std::vector<Piece>& pieces, const std::vector<double>& weights) {
  glm::dvec3 middle(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::pair<double, double>> at;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      at.emplace_back((pieces[i].bounds.min[axis] + pieces[i].bounds.max[axis]) * 0.5, weights[i]);
    middle[axis] = weighted_median(std::move(at));
  }
  return middle;
}

double distance_to_edge(const glm::dvec3& a, const glm::dvec3& b) noexcept {  // from 0 to a ... b
  const glm::dvec3 along = b - a;
  const double square = glm::dot(along, along);
  return glm::length(a + along * (square > 0.0 ? glm::clamp(-glm::dot(a, along) / square, 0.0, 1.0) : 0.0));
}

double distance_to(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& from) noexcept {
  const glm::dvec3 a = corners[0] - from, b = corners[1] - from, c = corners[2] - from;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  if (glm::dot(glm::cross(a, b), normal) > 0.0 && glm::dot(glm::cross(b, c), normal) > 0.0 &&
      glm::dot(glm::cross(c, a), normal) > 0.0)
    return std::abs(glm::dot(a, normal)) / glm::length(normal);
  return std::min({distance_to_edge(a, b), distance_to_edge(b, c), distance_to_edge(c, a)});
}

// How a piece lies round a point.
struct Around {
  double nearest = 1e300, farthest = 0.0;
  bool faces = false;  // nearly all of it is seen from there
  bool open = false;   // and a good part of the horizon as well
};
Around around(const Scene& scene, const Piece& piece, const glm::dvec3& from) {
  constexpr double kMost = 0.9;             // of the area, as seen from there
  constexpr int kParts = 16, kClosed = 13;  // of the horizon
  std::array<bool, kParts> covered{};
  Around result;
  const bool two_sided = is_two_sided(scene, piece);
  double facing = 0.0, all = 0.0;
  for (const std::uint32_t first : piece.triangles) {
    const auto corners = corners_of(scene, *piece.instance, first);
    result.nearest = std::min(result.nearest, distance_to(corners, from));
    for (const glm::dvec3& corner : corners)
      result.farthest = std::max(result.farthest, glm::length(corner - from));
    const double away =
        glm::dot(glm::cross(corners[1] - corners[0], corners[2] - corners[0]), corners[0] - from);
    facing += std::max(piece.instance->mirrored ? away : -away, 0.0);
    all += std::abs(away);
    const int steps = extent_of(box_of(corners)) > 0.3 * glm::length(corners[0] - from) ? 8 : 1;
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const glm::dvec3 to =
            (corners[0] * (1.0 * i) + corners[1] * (1.0 * j) + corners[2] * (1.0 * (steps - i - j))) /
                (1.0 * steps) -
            from;
        const double turn = std::atan2(to.x, to.z) / (2.0 * std::numbers::pi) + 0.5;
        if (to.y >= 0.0) covered[static_cast<std::size_t>(turn * kParts) % kParts] = true;
      }
  }
  result.faces = two_sided || facing > kMost * all;
  result.open = std::count(covered.begin(), covered.end(), true) < kClosed;
  return result;
}

bool is_level(const Piece& piece) noexcept {
  constexpr double kFlat = 0.03;  // height, of its sides: a long low wall is none
  const glm::dvec3 size = piece.bounds.max - piece.bounds.min;
  return size.y < kFlat * std::sqrt(size.x * size.z);
}

double weight_of(const Piece& piece) noexcept {
  return std::sqrt(static_cast<double>(piece.triangles.size()));
}

// Drops what lies beyond an empty shell round the middle: skies from twice the radius of all within,
// anything else from 6 times where it is a small part.
void drop_far_ones(const Scene& scene, std::vector<Piece>& pieces, std::vector<Piece>& skies) {
  constexpr double kSky = 2.0, kStray = 6.0, kSmallPart = 0.25;
  std::vector<double> weights;
  for (const Piece& piece : pieces) weights.push_back(weight_of(piece));
  const glm::dvec3 middle = middle_of(pieces, weights);
  std::vector<Around> places;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    places.push_back(around(scene, pieces[i], middle));
    order.push_back(i);
  }
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return places[a].nearest < places[b].nearest; });
  std::vector<bool> dropped(pieces.size(), false);
  double radius = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Around& place = places[order[i]];
    if (radius > 0.0 && place.nearest > kStray * radius) {
      double beyond = 0.0, whole = 0.0;
      for (std::size_t k = 0; k < order.size(); ++k) {
        const double weight = places[order[k]].faces && !places[order[k]].open ? 0.0 : weights[order[k]];
        whole += weight;
        if (k >= i) beyond += weight;
      }
      if (beyond <= kSmallPart * whole) {
        for (std::size_t k = i; k < order.size(); ++k) dropped[order[k]] = true;
        break;
      }
    }
    if (radius > 0.0 && place.nearest > kSky * radius && place.faces && !place.open)
      dropped[order[i]] = true;
    else
      radius = std::max(radius, place.farthest);
  }
  std::vector<Piece> kept;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (!dropped[i])
      kept.push_back(std::move(pieces[i]));
    else if (places[i].faces && !places[i].open)
      skies.push_back(std::move(pieces[i]));
  }
  pieces = std::move(kept);
}

// The largest piece, and the box of the others.
std::size_t largest_of(const std::vector<Piece>& pieces, Box& rest) {
  std::size_t largest = 0;
  for (std::size_t i = 1; i < pieces.size(); ++i)
    if (pieces[i].extent() > pieces[largest].extent()) largest = i;
  rest = {};
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (i != largest) rest.extend(pieces[i].bounds);
  return largest;
}

// Drops sheets behind the rest that are open to one side, and uneven grounds under it.
void drop_backdrops(const Scene& scene, std::vector<Piece>& pieces, std::vector<Piece>& lands) {
  constexpr double kSheet = 1.3, kLand = 1.5;  // times the extent of the rest
  constexpr double kHill = 0.25;               // height of a ground, of its extent
  constexpr double kSpeck = 0.02;              // a rest smaller than this, of a ground, is not looked at
  while (pieces.size() > 1) {
    Box rest;
    const std::size_t at = largest_of(pieces, rest);
    const Piece& largest = pieces[at];
    const double extent = largest.extent(), of_rest = extent_of(rest);
    if (!(of_rest > 0.0) || !(extent > kSheet * of_rest)) return;
    const Around place = around(scene, largest, (rest.min + rest.max) * 0.5);
    const bool sheet = place.faces && place.open && place.nearest > 0.0 && largest.triangles.size() < 10'000;
    const Box& box = largest.bounds;
    const bool land = extent > kLand * of_rest && of_rest > kSpeck * extent &&
                      box.max.y - box.min.y < kHill * extent && largest.normal_area.y > 0.0 &&
                      largest.normal_area.y > 0.8 * glm::length(largest.normal_area) &&
                      box.min.x <= rest.min.x && box.min.z <= rest.min.z && box.max.x >= rest.max.x &&
                      box.max.z >= rest.max.z;
    if (!sheet && !land) return;
    if (land) lands.push_back(std::move(pieces[at]));
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(at));
  }
}

// Adds those level pieces that do not reach far beyond the rest: together, where they lie at its foot.
void add_levels(std::vector<Piece>& levels, ViewSubject& subject) {
  constexpr double kFoot = 0.2;                  // of the rest's height
  constexpr double kGround = 1.15, kRoof = 1.6;  // times the extent of the rest
  constexpr double kUnder = 0.9;                 // of the rest's sides, that a ground has at least
  const Box rest = box_of(subject.pieces);
  const auto grows = [&rest](Box box) {
    box.extend(rest);
    return extent_of(box) / extent_of(rest);
  };
  const double foot = rest.min.y + kFoot * (rest.max.y - rest.min.y);
  Box ground;
  for (const Piece& level : levels)
    if (level.bounds.min.y <= foot) ground.extend(level.bounds);
  const glm::dvec3 of_ground = ground.max - ground.min, of_rest = rest.max - rest.min;
  subject.grounded =
      !ground.empty() && of_ground.x >= kUnder * of_rest.x && of_ground.z >= kUnder * of_rest.z;
  for (Piece& level : levels) {
    const bool joins = level.bounds.min.y <= foot ? grows(ground) <= kGround : grows(level.bounds) <= kRoof;
    if (!joins) subject.all = false;
    const bool hides = level.bounds.min.y <= foot && level.bounds.max.y > level.bounds.min.y;
    if (joins)
      subject.pieces.push_back(std::move(level));
    else if (hides)
      subject.lands.push_back(std::move(level));
  }
}

}  // namespace

double Piece::extent() const noexcept {
  return extent_of(bounds);
}

bool is_two_sided(const Scene& scene, const Piece& piece) noexcept {
  const auto material = static_cast<std::size_t>(scene.primitives[piece.instance->primitive].material);
  return material < scene.materials.size() && scene.materials[material].double_sided;
}

std::array<glm::dvec3, 3> corners_of(const Scene& scene, const Instance& instance,
                                     std::uint32_t first) noexcept {
  const auto corner = [&](std::uint32_t k) {
    const glm::dvec3 at(scene.positions[scene.indices[first + k]]);
    return glm::dvec3(instance.world_from_object * glm::dvec4(at, 1.0));
  };
  return {corner(0), corner(1), corner(2)};
}

ViewSubject view_subject(const Scene& scene) {
  // Of more, some stand for all.
  constexpr std::uint64_t kMaxLookedAt = 2'000'000;
  const auto stride = static_cast<std::uint32_t>(1 + scene.triangle_count() / kMaxLookedAt);
  ViewSubject subject;
  std::vector<Piece> all, levels;
  bool stray = false;
  for (const Instance& instance : scene.instances)
    if (instance.shown && !instance.bounds_world.empty())
      stray = add_pieces(scene, instance, stride, all) || stray;
  for (Piece& piece : all) (is_level(piece) ? levels : subject.pieces).push_back(std::move(piece));
  const std::size_t standing = subject.pieces.size();
  if (standing > 0 && extent_of(box_of(subject.pieces)) > 0.0) {
    drop_far_ones(scene, subject.pieces, subject.skies);
    drop_backdrops(scene, subject.pieces, subject.lands);
    subject.all = subject.pieces.size() == standing;
    add_levels(levels, subject);
  } else {
    for (Piece& level : levels) subject.pieces.push_back(std::move(level));
  }
  subject.all = subject.all && !stray;
  subject.bounds = box_of(subject.pieces);
  return subject;
}

}  // namespace gnomon::detail
