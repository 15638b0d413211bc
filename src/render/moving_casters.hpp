// Which casters move, which are static, and where did any change since the last frame?
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/bounds.hpp"

namespace gnomon::render {

/// A caster is moving from the frame that it first moves in until it has rested for kRestFrames frames. Both
/// changes are a change of the static casters at its place.
class MovingCasters {
 public:
  static constexpr int kRestFrames = 60;  ///< a second at 60 Hz, so that a stride's pauses change nothing

  explicit MovingCasters(std::size_t instances) : moves_(instances), rested_(instances) {}

  void move(std::size_t instance, const Box& from_world, const Box& to_world);
  /// Bounds that the caller names. Whose they are is not known: they count as static.
  void add(std::span<const Box> changed_world);
  /// A frame has brought its maps or pages up to date. `boxes`: of all instances, as they are now.
  void finish_frame(std::span<const Box> boxes);
  /// No map or page holds anything any more.
  void forget_changes() noexcept;

  /// Bounds of casters before and after, since the last frame: of all, and where static casters came or went.
  [[nodiscard]] std::span<const Box> changed_world() const noexcept { return changed_; }
  [[nodiscard]] std::span<const Box> static_changed_world() const noexcept { return static_changed_; }
  [[nodiscard]] bool any() const noexcept { return !moving_.empty(); }
  /// By instance: 1 where it moves, 0 where it is static.
  [[nodiscard]] std::span<const std::uint8_t> moves() const noexcept { return moves_; }

 private:
  std::vector<std::uint8_t> moves_;
  std::vector<int> rested_;  ///< frames, by instance
  std::vector<std::size_t> moving_;
  std::vector<Box> changed_, static_changed_;
};

}  // namespace gnomon::render
