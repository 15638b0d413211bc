// Which part of the scene's boxes a convex region holds.
#include "geometry/visible.hpp"
#include "gnomon/extend/body.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/box_walk.hpp"
#include "geometry/vector.hpp"
#include "lanes/elementary.hpp"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dvec3 clamp_to(const glm::dvec3& v, const Box& box) noexcept {
  return {gnomon::clamp_to(v.x, box.min.x, box.max.x), gnomon::clamp_to(v.y, box.min.y, box.max.y),
          gnomon::clamp_to(v.z, box.min.z, box.max.z)};
}

/// Of two zeros with other signs the order of the boxes would choose.
Box without_signed_zeros(const Box& box) noexcept {
  return {box.min + 0.0, box.max + 0.0};
}

/// A box in a table, which takes no time to make.
struct Corners {
  glm::dvec3 min, max;
  operator Box() const noexcept { return {min, max}; }
};

/// Grows to hold what of each box is in the region. Each box adds what lies inside itself and the region's
/// own box, to the last bit: so the answer depends on no order, and what cannot add anything may be left out.
class VisibleQuery {
 public:
  static constexpr bool kCuts = true;

  /// `later`: boxes are cut at the end, when the others have left little of them to ask.
  VisibleQuery(const Polytope& region, bool later) noexcept
      : region_(region), limit_(bounds_of(region)), later_(later) {}

  [[nodiscard]] std::uint32_t wanted(const CasterBlock& block) const noexcept {
    return lanes_beyond(low_, high_, block);
  }
  [[nodiscard]] std::uint32_t inside(const CasterBlock& block, std::uint32_t lanes, bool) noexcept {
    for_each_bit(lanes, [&](std::size_t lane) { add(lane_box(block, lane)); });
    return 0;
  }
  void across(const CasterBlock& block, std::uint32_t lanes) noexcept {
    for_each_bit(lanes, [&](std::size_t lane) {
      const Box box = lane_box(block, lane);
      if (!later_) {
        if (beyond(box)) cut(box);
        return;
      }
      if (waiting_count_ == kRoom) cut_waiting();
      waiting_[waiting_count_++] = {box.min, box.max};
    });
  }
  [[nodiscard]] Box answer() noexcept {
    cut_waiting();
    return without_signed_zeros(all_);
  }

 private:
  static constexpr std::size_t kRoom = 64;

  void cut_waiting() noexcept {
    for (std::size_t i = 0; i < waiting_count_; ++i) {
      if (const Box box = waiting_[i]; beyond(box)) cut(box);
    }
    waiting_count_ = 0;
  }
  [[nodiscard]] bool beyond(const Box& box) const noexcept {
    return box.min.x < low_.x || box.min.y < low_.y || box.min.z < low_.z || box.max.x > high_.x ||
           box.max.y > high_.y || box.max.z > high_.z;
  }
  void cut(const Box& box) noexcept {
    Polytope part = region_;
    clip(part, box);
    if (const Box held = bounds_of(part); !held.empty())
      add({clamp_to(held.min, box), clamp_to(held.max, box)});
  }
  void add(const Box& box) noexcept {
    all_.extend(Box{clamp_to(box.min, limit_), clamp_to(box.max, limit_)});
    // Nothing goes beyond the region's own box.
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = all_.min[axis] <= limit_.min[axis] ? -kInfinity : all_.min[axis];
      high_[axis] = all_.max[axis] >= limit_.max[axis] ? kInfinity : all_.max[axis];
    }
  }

  const Polytope& region_;
  Box limit_, all_;
  bool later_;
  std::size_t waiting_count_ = 0;
  glm::dvec3 low_{kInfinity}, high_{-kInfinity};  // boxes within these add nothing
  std::array<Corners, kRoom> waiting_;
};

/// Grows to hold each box that reaches the region.
class ReachQuery {
 public:
  static constexpr bool kCuts = false;

  explicit ReachQuery(const glm::dvec3& up) noexcept : up_(up) {}

  [[nodiscard]] std::uint32_t wanted(const CasterBlock& block) const noexcept {
    if (top_ == -kInfinity) return 0xff;
    return lanes_beyond(all_.min, all_.max, block) | lanes_above(reaches(block, up_), top_);
  }
  [[nodiscard]] std::uint32_t inside(const CasterBlock& block, std::uint32_t lanes, bool leaf) noexcept {
    const CasterBlock::Lanes tops = reaches(block, up_);
    std::uint32_t higher = 0;
    for_each_bit(lanes, [&](std::size_t lane) {
      all_.extend(lane_box(block, lane));
      // The corner of a node is of no box of it, mostly.
      if (leaf) top_ = max_of(top_, tops[lane]);
    });
    if (!leaf) higher = lanes_above(tops, top_) & lanes;
    return higher;
  }
  [[nodiscard]] CasterReach answer() const noexcept {
    return {without_signed_zeros(all_), top_ + 0.0, !all_.empty()};
  }

 private:
  glm::dvec3 up_;
  Box all_;
  double top_ = -kInfinity;
};

class PointQuery {
 public:
  static constexpr bool kCuts = false;

  explicit PointQuery(const glm::dvec3& point) noexcept : point_(point) {}
  [[nodiscard]] std::uint32_t wanted(const CasterBlock& block) const noexcept {
    if (found_) return 0;
    std::uint32_t held = 0xff;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double p = point_[static_cast<int>(axis)];
      for (std::size_t i = 0; i < kLanes; ++i)
        held &= ~(static_cast<std::uint32_t>(!(p >= block.min[axis][i] && p <= block.max[axis][i])) << i);
    }
    return held;
  }
  [[nodiscard]] std::uint32_t inside(const CasterBlock&, std::uint32_t lanes, bool leaf) noexcept {
    found_ = found_ || leaf;
    return leaf ? 0 : lanes;
  }
  [[nodiscard]] bool answer() const noexcept { return found_; }

 private:
  glm::dvec3 point_;
  bool found_ = false;
};

/// The boxes with the nearest corners, sorted, as many as there is room for.
class NearestQuery {
 public:
  static constexpr bool kCuts = false;

  struct Candidate {
    double distance;
    Corners box;
  };
  /// Room for boxes to be cut, and one more that tells how near the next one is.
  static constexpr std::size_t kMost = 65;

  NearestQuery(const glm::dvec3& toward, const glm::dvec3& apex, std::size_t room) noexcept
      : toward_(toward), apex_(apex), room_(room) {}

  [[nodiscard]] std::uint32_t wanted(const CasterBlock& block) const noexcept {
    if (count_ < room_) return 0xff;
    std::uint32_t nearer = 0;
    for (std::size_t i = 0; i < kLanes; ++i)
      nearer |= static_cast<std::uint32_t>(distance(lane_box(block, i)) < found_[count_ - 1].distance) << i;
    return nearer;
  }
  [[nodiscard]] std::uint32_t inside(const CasterBlock& block, std::uint32_t lanes, bool leaf) noexcept {
    if (!leaf) return lanes;
    for_each_bit(lanes, [&](std::size_t lane) {
      const Box box = lane_box(block, lane);
      const double d = distance(box);
      if (count_ == room_ && !(d < found_[count_ - 1].distance)) return;
      std::size_t at = count_ < room_ ? count_++ : count_ - 1;
      for (; at > 0 && d < found_[at - 1].distance; --at) found_[at] = found_[at - 1];
      found_[at] = {d, {box.min, box.max}};
    });
    return 0;
  }
  [[nodiscard]] std::span<const Candidate> found() const noexcept { return {found_.data(), count_}; }
  /// Of the box's nearest corner.
  [[nodiscard]] double distance(const Box& box) const noexcept {
    const glm::dvec3 corner{toward_.x > 0.0 ? box.max.x : box.min.x, toward_.y > 0.0 ? box.max.y : box.min.y,
                            toward_.z > 0.0 ? box.max.z : box.min.z};
    return glm::dot(toward_, apex_ - corner);
  }

 private:
  glm::dvec3 toward_, apex_;
  std::size_t room_, count_ = 0;
  std::array<Candidate, kMost> found_;
};

/// Coarse answers first leave little to ask of the fine levels: every other level is worth a walk of its own.
template <typename Query>
void walk_down(BoxWalk<Query>& walk, const Boxes& boxes) noexcept {
  if (boxes.set() != nullptr) {
    for (std::size_t level = boxes.set()->level_count(); level > 3;) walk.coarse(level -= 2);
  }
  walk.whole();
}

/// Calls `use` with each box that is not empty, until it returns false.
template <typename Use>
void for_each_box(const Boxes& boxes, Use&& use) noexcept {
  const CasterSet* const set = boxes.set();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box box = set != nullptr ? lane_box(set->block(0, i / kLanes), i % kLanes) : boxes.list()[i];
    if (!box.empty() && !use(box)) return;
  }
}

}  // namespace

bool several(const Boxes& boxes) noexcept {
  if (boxes.size() < 2) return false;
  int count = 0;
  for_each_box(boxes, [&](const Box&) { return ++count < 2; });
  return count == 2;
}

Box visible_bounds(const Polytope& region, const Boxes& boxes, const glm::dvec3& origin) noexcept {
  if (!several(boxes)) {
    Box only;
    for_each_box(boxes, [&](const Box& box) {
      only = relative_to(box, origin);
      return false;
    });
    return only;
  }
  if (region.empty()) return {};
  // Cutting a box costs as much as asking a hundred. In a tree, cut ones also tell where not to look.
  VisibleQuery query(region, boxes.set() == nullptr);
  BoxWalk walk({region.plane.data(), static_cast<std::size_t>(region.face_count)}, boxes, origin, query);
  walk_down(walk, boxes);
  return query.answer();
}

void clip_part(Polytope& part, const Boxes& boxes, const glm::dvec3& origin) noexcept {
  if (!part.empty() && several(boxes)) clip(part, visible_bounds(part, boxes, origin));
}

namespace {

/// casters_inside of a single box, by the same sums.
CasterReach box_inside(std::span<const Plane> planes, const Box& world, const glm::dvec3& origin,
                       const glm::dvec3& up) noexcept {
  const CasterReach none{{}, -kInfinity, false};
  if (world.empty()) return none;
  const Box box = without_signed_zeros(relative_to(world, origin));
  const double corner[3][2] = {{box.min.x, box.max.x}, {box.min.y, box.max.y}, {box.min.z, box.max.z}};
  const auto reach = [&](const glm::dvec3& n) {
    return corner[0][n.x > 0.0] * n.x + corner[1][n.y > 0.0] * n.y + corner[2][n.z > 0.0] * n.z;
  };
  for (const Plane& plane : planes.first(std::min(planes.size(), kMaxPlanes))) {
    const double inward = reach(plane.normal);
    if (inward + plane.offset < -kTouching * (std::abs(inward) + std::abs(plane.offset))) return none;
  }
  return {box, reach(up) + 0.0, true};
}

}  // namespace

CasterReach casters_inside(std::span<const Plane> planes, const Boxes& casters, const glm::dvec3& origin,
                           const glm::dvec3& up) noexcept {
  if (casters.list().size() == 1) return box_inside(planes, casters.list()[0], origin, up);
  ReachQuery query(up);
  BoxWalk walk(planes, casters, origin, query);
  walk_down(walk, casters);
  return query.answer();
}

double depth_in_reach(const Camera& camera, const Boxes& boxes, double aside) noexcept {
  const CasterReach held = casters_inside({}, boxes, camera.position, {0.0, 0.0, 1.0});
  const Box& box = held.bounds;
  const glm::dvec3 corner(max_of(-box.min.x, box.max.x), max_of(-box.min.y, box.max.y),
                          max_of(-box.min.z, box.max.z));
  const double farthest = max_of(camera.near_depth, held.any ? glm::length(corner) + aside : 0.0);
  constexpr double kStepsPerOctave = 2.0;
  const auto next_step = [](double ratio) {
    return elementary::exp2(std::ceil(elementary::log2(ratio) * kStepsPerOctave) / kStepsPerOctave);
  };
  // Of the near plane's depth, of the image's height: a slice thinner than this is of no use to anyone.
  constexpr double kThinnest = 1.0 / 1024.0;
  const double n = camera.near_depth, height = camera.top - camera.bottom;
  const double reach = camera.orthographic
                           ? n + height * next_step(max_of((farthest - n) / height, kThinnest))
                           : n * next_step(max_of(farthest / n, 1.0 + kThinnest));
  // The logarithm's rounding must cut nothing off; and a ratio that overflows has no next step.
  return std::isfinite(reach) ? max_of(reach, farthest) : farthest;
}

bool in_some_box(const Boxes& boxes, const glm::dvec3& point_world) noexcept {
  PointQuery query(point_world);
  BoxWalk({}, boxes, glm::dvec3(0.0), query).whole();
  return query.answer();
}

namespace {

/// Least dot(toward, apex - p) over the part of a box inside the planes; infinity where there is none.
double nearest_part(const Box& box, std::span<const Plane> planes, const glm::dvec3& toward,
                    const glm::dvec3& apex, const Box& limit) noexcept {
  // A box that is enormous beside the scene would be cut with the rounding of its own size.
  Polytope part = box_polytope({clamp_to(box.min, limit), clamp_to(box.max, limit)});
  for (const Plane& plane : planes) clip(part, plane);
  double nearest = kInfinity;
  for (const Polytope::Vertex& v : part.vertices())
    nearest = min_of(nearest, glm::dot(toward, apex - v.position));
  return nearest;
}

}  // namespace

NearBoxes nearest_inside(std::span<const Plane> planes, const Polytope& body, const Boxes& boxes,
                         const glm::dvec3& origin, const glm::dvec3& toward, const glm::dvec3& apex,
                         double least) noexcept {
  // What the planes hold ends before: at the light and the body, and at a border no wider than a few of both.
  constexpr double kBeyond = 64.0;
  double reach = largest_component(apex);
  for (const Polytope::Vertex& v : body.vertices()) reach = max_of(reach, largest_component(v.position));
  const Box limit{glm::dvec3(-kBeyond * reach), glm::dvec3(kBeyond * reach)};
  // Few are cut as a rule: the room for many is asked for only where it is needed.
  constexpr std::size_t kFew = 9;
  for (const std::size_t room : {kFew, NearestQuery::kMost}) {
    NearestQuery query(toward, apex, room);
    BoxWalk(planes, boxes, origin, query).whole();
    const auto found = query.found();
    NearBoxes result{kInfinity, 0};
    for (std::size_t i = 0; i < found.size(); ++i) {
      // Those that follow are no nearer.
      if (!(found[i].distance < result.nearest)) return result;
      if (i + 1 == room) {
        result.nearest = max_of(found[i].distance, least);
        break;
      }
      const double cut = nearest_part(found[i].box, planes, toward, apex, limit);
      if (!(cut < kInfinity)) continue;
      const double nearest = max_of(found[i].distance, cut);
      if (nearest < least) {
        ++result.too_near;
      } else {
        result.nearest = min_of(result.nearest, nearest);
      }
    }
    if (found.size() < room || room == NearestQuery::kMost) return result;
  }
  return {kInfinity, 0};
}

}  // namespace gnomon
