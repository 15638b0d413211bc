// Which boxes bound casters and receivers? Axis-aligned boxes, as lists or sets.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
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

/// Boxes as the core takes them: a list, or a CasterSet (caster_set.hpp) that holds them sorted. Both give
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

}  // namespace gnomon
