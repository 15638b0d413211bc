// Which boxes bound casters and receivers? Axis-aligned boxes, as lists, or as sets that test many at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <span>
#include <type_traits>

namespace gnomon {

/// An axis-aligned box in world units. Flat and single-point boxes are legal; a box with min > max on any
/// axis is empty and takes no part in anything.
struct Box {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};   ///< least coordinates, world units
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};  ///< largest coordinates, world units

  /// True where the box holds no point.
  [[nodiscard]] bool empty() const noexcept { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  /// Grows the box to hold `point` (same space as the box).
  void extend(const glm::dvec3& point) noexcept {
    min = {point.x < min.x ? point.x : min.x, point.y < min.y ? point.y : min.y,
           point.z < min.z ? point.z : min.z};
    max = {point.x > max.x ? point.x : max.x, point.y > max.y ? point.y : max.y,
           point.z > max.z ? point.z : max.z};
  }
  /// Grows the box to hold `other`; an empty `other` changes nothing.
  void extend(const Box& other) noexcept {
    if (other.empty()) return;
    extend(other.min);
    extend(other.max);
  }
  /// Equal in all members.
  bool operator==(const Box&) const = default;
};

class CasterSet;

/// Boxes as the core takes them: a list, or a CasterSet that holds them sorted. Both give
/// the same results bit by bit. The time of a list grows with its length, that of a set hardly does. Refers
/// to either, so that the list or the set must live as long as the call it is passed to.
class Boxes {
 public:
  Boxes() noexcept = default;
  /// `count` boxes from `first` on.
  Boxes(const Box* first, std::size_t count) noexcept : list_(first, count), size_(count) {}
  /// A span, vector or array.
  template <typename List,
            typename = std::enable_if_t<std::is_convertible_v<const List&, std::span<const Box>>>>
  Boxes(const List& list) noexcept : list_(list), size_(list_.size()) {}
  /// The boxes of a set.
  Boxes(const CasterSet& set) noexcept;
  Boxes(const CasterSet&& set) = delete;

  /// Empty boxes included.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// The boxes of a list; empty where a set holds them.
  [[nodiscard]] std::span<const Box> list() const noexcept { return list_; }
  /// nullptr where a list holds the boxes.
  [[nodiscard]] const CasterSet* set() const noexcept { return set_; }

 private:
  std::span<const Box> list_;
  const CasterSet* set_ = nullptr;
  std::size_t size_ = 0;
};

/// Casters and receivers as boxes in world space, each a list or a CasterSet:
/// `{boxes, boxes}`, `{set, set}`, `{set, list}`. Both may be the same; the memory stays the caller's and is
/// only read during the call it is passed to.
struct SceneBounds {
  Boxes casters;    ///< objects that cast shadows
  Boxes receivers;  ///< objects that shadows fall on
};

struct ShadowMap;

/// Eight boxes side by side, so that one plane is tested against all of them in a few instructions: the unit
/// of a CasterSet's memory. Plain data without a meaning of its own.
struct CasterBlock {
  static constexpr std::size_t kLanes = 8;   ///< boxes of a block
  using Lanes = std::array<double, kLanes>;  ///< one number for each box
  std::array<Lanes, 3> min{}, max{};         ///< per axis
  std::uint8_t occupied = 0;                 ///< lanes that hold anything
  std::uint8_t full = 0;      ///< lanes below which no place is empty: all of them can be listed as they lie
  std::uint8_t unusable = 0;  ///< lanes at or below which a box is none that make_plan takes, see usable()
};

/// Boxes sorted once into a flat tree, eight children to a node and no pointer. It serves plans of scenes
/// with many boxes: SceneBounds takes sets in place of lists, of receivers as well. It culls many casters
/// for many maps. Gives the same plans as lists and the same casters as cull_casters, bit for bit: bounds
/// only grow towards the root and rounding is monotone. A node outside of a plane, or inside, therefore
/// stands for every box below it.
///
/// The memory is the caller's and must outlive the set; the boxes are copied into it. Building takes O(n log
/// n), culling time grows with what lies across the planes, not with what lies inside or outside of them.
///
///     std::vector<gnomon::CasterBlock> blocks(gnomon::CasterSet::block_count(boxes.size()));
///     std::vector<std::uint32_t> indices(gnomon::CasterSet::index_count(boxes.size()));
///     gnomon::CasterSet set(boxes, blocks, indices);
///     gnomon::ShadowPlan plan = gnomon::make_plan(camera, light, {set, set}, options);
class CasterSet {
 public:
  /// How much memory a set of `boxes` boxes needs: about 64 bytes a box. At most 2^32 - 1 boxes.
  [[nodiscard]] static std::size_t block_count(std::size_t boxes) noexcept;
  /// Indices that a set of `boxes` boxes needs.
  [[nodiscard]] static std::size_t index_count(std::size_t boxes) noexcept { return 2 * boxes; }

  /// A set of nothing.
  CasterSet() = default;
  /// Sorts `boxes`; empty ones are kept a place but never listed. Where the memory given is too small the set
  /// stays without boxes and is not usable(): make_plan refuses it.
  CasterSet(std::span<const Box> boxes, std::span<CasterBlock> blocks,
            std::span<std::uint32_t> indices) noexcept;

  /// Boxes in the set, empty ones included.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// False where the memory was too small, or a box has a corner that is no number or beyond 1e30. make_plan
  /// refuses the set then, as it refuses a list with such a box. O(1).
  [[nodiscard]] bool usable() const noexcept { return fits_ && (size_ == 0 || blocks_.back().unusable == 0); }

  /// The tree: level 0 has the boxes, eight to a block, the last level one block. Lane i of block b bounds
  /// block 8 b + i of the level below.
  [[nodiscard]] std::size_t level_count() const noexcept { return levels_; }
  /// Block `at` of a level below level_count().
  [[nodiscard]] const CasterBlock& block(std::size_t level, std::size_t at) const noexcept {
    return blocks_[first_[level] + at];
  }
  /// Which box, in the order given, is in lane `place` % 8 of block `place` / 8 of level 0.
  [[nodiscard]] std::uint32_t index(std::size_t place) const noexcept { return order_[place]; }

  /// Takes new bounds for all boxes, in their first order, and leaves the sorting as it is. Right for any
  /// motion, fast while boxes that were near each other stay so. Needs as many boxes as the set has; else
  /// does nothing.
  void refit(std::span<const Box> boxes) noexcept;
  /// The same for one box, empty or not, before or after; `index` beyond the set does nothing. O(log n).
  void update(std::uint32_t index, const Box& box) noexcept;

  /// Writes the indices of the casters that `map` needs to `out`, in no particular order. Returns how many
  /// there are: those beyond out.size() are counted, not written. No heap.
  std::size_t cull(const ShadowMap& map, std::span<std::uint32_t> out) const noexcept;
  /// The same for planes of one's own, at most kMaxCullPlanes (later ones are not looked at). Casters that
  /// reach the side where dot(xyz, p_world) + w >= 0 of all of them.
  std::size_t cull(std::span<const glm::dvec4> planes, std::span<std::uint32_t> out) const noexcept;

 private:
  // 2^32 boxes in groups of 8: 11 levels.
  static constexpr std::size_t kMaxLevels = 11;

  void join(std::size_t level, std::size_t child) noexcept;
  [[nodiscard]] std::size_t blocks_at(std::size_t level) const noexcept {
    return first_[level + 1] - first_[level];
  }

  std::span<CasterBlock> blocks_;      // level 0, the boxes, first; the root last
  std::span<std::uint32_t> order_;     // place in the tree -> box
  std::span<std::uint32_t> place_of_;  // box -> place in the tree
  std::array<std::size_t, kMaxLevels + 1> first_{};
  std::size_t levels_ = 0, size_ = 0;
  bool fits_ = true;  // into the memory given
};

}  // namespace gnomon
