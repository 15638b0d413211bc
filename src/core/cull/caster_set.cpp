// Which of very many boxes does a plan or a map need? A tree that answers for all of them at once.
// Based on: Assarsson, Moeller, "Optimized View Frustum Culling Algorithms for Bounding Boxes", 2000 (planes
// that a node is inside of are not asked again below it); Wald, Benthin, Boulos, "Getting Rid of Packets",
// 2008 (nodes with as many children as a vector has lanes). The exact agreement by monotone rounding is this
// project's.
#include "gnomon/bounds.hpp"

#include "gnomon/shadow_map.hpp"

#include <algorithm>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <utility>

#include "geometry/usable.hpp"
#include "gnomon/plan.hpp"
#include "lanes/casters.hpp"

namespace gnomon {
namespace {

/// A box's middle times two; any number where it has none, so that sorting always has an order.
double middle(const Box& box, int axis) noexcept {
  const double sum = box.min[axis] + box.max[axis];
  return sum == sum ? sum : 0.0;
}

int longest_axis(std::span<const Box> boxes, std::span<const std::uint32_t> order) noexcept {
  glm::dvec3 low(0.0), high(0.0);
  bool first = true;
  for (const std::uint32_t i : order) {
    const glm::dvec3 m{middle(boxes[i], 0), middle(boxes[i], 1), middle(boxes[i], 2)};
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = first || m[axis] < low[axis] ? m[axis] : low[axis];
      high[axis] = first || m[axis] > high[axis] ? m[axis] : high[axis];
    }
    first = false;
  }
  const glm::dvec3 extent = high - low;
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

/// Orders boxes so that each run of 8, 64, 512 ... of them lies close together: halves along the longest
/// axis, cut at whole subtrees.
void sort(std::span<const Box> boxes, std::span<std::uint32_t> order) noexcept {
  while (order.size() > kLanes) {
    std::size_t subtree = kLanes;
    while (subtree * kLanes < order.size()) subtree *= kLanes;
    const std::size_t subtrees = (order.size() + subtree - 1) / subtree;
    const std::size_t half = subtrees / 2 * subtree;
    const int axis = longest_axis(boxes, order);
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) noexcept {
                       return middle(boxes[a], axis) < middle(boxes[b], axis);
                     });
    sort(boxes, order.first(half));
    order = order.subspan(half);
  }
}

/// One walk down the tree.
struct Walk {
  std::span<const glm::dvec4> planes;
  std::span<const CasterBlock> blocks;
  std::span<const std::uint32_t> order;
  std::span<const std::size_t> first;  // block of each level
  std::span<std::uint32_t> out;
  std::size_t count = 0;

  void list(std::size_t place) noexcept {
    if (count < out.size()) out[count] = order[place];
    ++count;
  }
  void list_range(std::size_t place, std::size_t places) noexcept {
    const std::size_t room = count < out.size() ? out.size() - count : 0;
    std::copy_n(order.begin() + static_cast<std::ptrdiff_t>(place), std::min(room, places),
                out.begin() + static_cast<std::ptrdiff_t>(std::min(count, out.size())));
    count += places;
  }

  /// `asked`: bit per plane that the whole block is not known to be inside of.
  void visit(std::size_t level, std::size_t at, std::uint32_t asked) noexcept {
    const CasterBlock& block = blocks[first[level] + at];
    std::uint32_t kept = block.occupied;
    std::array<std::uint32_t, kMaxCullPlanes> across;
    std::uint32_t open = 0;  // lanes across any plane
    for (std::uint32_t rest = asked; rest != 0 && kept != 0; rest &= rest - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(rest));
      kept &= ~lanes<Ask::outside>(planes[k], block);
      if (level == 0) continue;
      across[k] = lanes<Ask::across>(planes[k], block);
      open |= across[k];
    }
    if (level == 0) {
      for_each_bit(kept, [&](std::size_t lane) { list(at * kLanes + lane); });
      return;
    }
    for_each_bit(kept, [&](std::size_t lane) {
      const std::size_t child = at * kLanes + lane;
      const std::uint32_t bit = 1u << lane;
      if ((open & bit) == 0 && (block.full & bit) != 0) {
        const std::size_t places = std::size_t{1} << (3 * level);
        list_range(child * places, places);
        return;
      }
      std::uint32_t still = 0;
      for_each_bit(asked, [&](std::size_t k) { still |= (across[k] >> lane & 1u) << k; });
      visit(level - 1, child, still);
    });
  }
};

void set_box(CasterBlock& block, std::size_t lane, const Box& box) noexcept {
  set_lane(block, lane, box);
  const auto bit = static_cast<std::uint8_t>(1u << lane);
  block.unusable = static_cast<std::uint8_t>(usable(box) ? block.unusable & ~bit : block.unusable | bit);
}

}  // namespace

Boxes::Boxes(const CasterSet& set) noexcept : set_(&set), size_(set.size()) {}

std::size_t CasterSet::block_count(std::size_t boxes) noexcept {
  std::size_t total = 0;
  while (boxes > 0) {
    boxes = (boxes + kLanes - 1) / kLanes;
    total += boxes;
    if (boxes == 1) break;
  }
  return total;
}

CasterSet::CasterSet(std::span<const Box> boxes, std::span<CasterBlock> blocks,
                     std::span<std::uint32_t> indices) noexcept {
  if (boxes.empty() || boxes.size() > UINT32_MAX || blocks.size() < block_count(boxes.size()) ||
      indices.size() < index_count(boxes.size())) {
    fits_ = boxes.empty();
    return;
  }
  size_ = boxes.size();
  blocks_ = blocks.first(block_count(size_));
  order_ = indices.first(size_);
  place_of_ = indices.subspan(size_, size_);
  std::size_t nodes = size_;
  do {
    nodes = (nodes + kLanes - 1) / kLanes;
    first_[levels_ + 1] = first_[levels_] + nodes;
    ++levels_;
  } while (nodes > 1);
  for (std::size_t i = 0; i < size_; ++i) order_[i] = static_cast<std::uint32_t>(i);
  // Empty boxes last, where they keep no other box apart.
  const auto held = std::partition(order_.begin(), order_.end(),
                                   [&](std::uint32_t i) noexcept { return !boxes[i].empty(); });
  sort(boxes, order_.first(static_cast<std::size_t>(held - order_.begin())));
  for (std::size_t place = 0; place < size_; ++place) {
    place_of_[order_[place]] = static_cast<std::uint32_t>(place);
  }
  for (CasterBlock& block : blocks_) block = CasterBlock{};
  refit(boxes);
}

void CasterSet::refit(std::span<const Box> boxes) noexcept {
  if (boxes.size() != size_) return;
  for (std::size_t place = 0; place < size_; ++place) {
    set_box(blocks_[place / kLanes], place % kLanes, boxes[order_[place]]);
  }
  for (std::size_t level = 1; level < levels_; ++level) {
    for (std::size_t child = 0; child < blocks_at(level - 1); ++child) join(level, child);
  }
}

void CasterSet::update(std::uint32_t index, const Box& box) noexcept {
  if (index >= size_) return;
  std::size_t node = place_of_[index];
  set_box(blocks_[node / kLanes], node % kLanes, box);
  for (std::size_t level = 1; level < levels_; ++level) {
    node /= kLanes;
    join(level, node);
  }
}

/// Takes the bounds of a block one level below into its lane at `level`.
void CasterSet::join(std::size_t level, std::size_t child) noexcept {
  const CasterBlock& from = blocks_[first_[level - 1] + child];
  CasterBlock& to = blocks_[first_[level] + child / kLanes];
  const std::size_t lane = child % kLanes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for_each_bit(from.occupied, [&](std::size_t i) {
      low = std::min(low, from.min[axis][i]);
      high = std::max(high, from.max[axis][i]);
    });
    to.min[axis][lane] = low;
    to.max[axis][lane] = high;
  }
  const auto bit = static_cast<std::uint8_t>(1u << lane);
  const auto set = [&](std::uint8_t& flags, bool value) {
    flags = static_cast<std::uint8_t>(value ? flags | bit : flags & ~bit);
  };
  set(to.occupied, from.occupied != 0);
  set(to.full, from.full == 0xff);
  set(to.unusable, from.unusable != 0);
}

std::size_t CasterSet::cull(const ShadowMap& map, std::span<std::uint32_t> out) const noexcept {
  return cull(std::span(map.cull_planes).first(static_cast<std::size_t>(map.cull_plane_count)), out);
}

std::size_t CasterSet::cull(std::span<const glm::dvec4> planes, std::span<std::uint32_t> out) const noexcept {
  if (size_ == 0) return 0;
  const std::size_t asked = std::min<std::size_t>(planes.size(), kMaxCullPlanes);
  Walk walk{planes, blocks_, order_, first_, out};
  walk.visit(levels_ - 1, 0, asked == 32 ? ~0u : (1u << asked) - 1u);
  return walk.count;
}

std::size_t cull_casters(const ShadowMap& map, std::span<const Box> casters,
                         std::span<std::uint32_t> out) noexcept {
  // A copy, since the order changes: what eight boxes were outside of, the next in the list often are, too.
  std::array<glm::dvec4, kMaxCullPlanes> planes = map.cull_planes;
  const auto plane_count = static_cast<std::size_t>(map.cull_plane_count);
  CasterBlock block;
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < casters.size(); begin += kLanes) {
    const std::size_t filled = std::min(kLanes, casters.size() - begin);
    block.occupied = 0;
    for (std::size_t lane = 0; lane < filled; ++lane) set_lane(block, lane, casters[begin + lane]);
    std::uint32_t kept = block.occupied;
    for (std::size_t k = 0; k < plane_count && kept != 0; ++k) {
      kept &= ~lanes<Ask::outside>(planes[k], block);
      if (kept == 0) std::swap(planes[k], planes[0]);
    }
    for_each_bit(kept, [&](std::size_t lane) {
      if (count < out.size()) out[count] = static_cast<std::uint32_t>(begin + lane);
      ++count;
    });
  }
  return count;
}

}  // namespace gnomon
