// Which casters move, which are static, and where did any change since the last frame?
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "casters/caster_shapes.hpp"
#include "gnomon/bounds.hpp"

namespace gnomon::render {

/// A caster is moving from the frame that it first moves in until it has rested for kRestFrames frames. Both
/// changes are a change of the static casters at its place.
class MovingCasters {
 public:
  static constexpr int kRestFrames = 60;  ///< a second at 60 Hz, so that a stride's pauses change nothing

  explicit MovingCasters(const SceneBuffers& scene)
      : scene_(scene), shapes_(scene), moves_(scene.boxes().size()), rested_(scene.boxes().size()) {}

  /// Before the scene moves it.
  void move(std::size_t instance, const Box& to_world);
  /// Before the scene bends vertices of an instance, which moves then.
  void bend(std::size_t instance, std::uint32_t first, std::span<const glm::vec3> positions);
  /// Bounds that the caller names. Whose they are is not known: they count as static.
  void add(std::span<const Box> changed_world);
  /// A frame has brought its maps or pages up to date.
  void finish_frame();
  /// No map or page holds anything any more.
  void forget_changes() noexcept;

  /// Bounds of casters before and after, since the last frame: of all, and where static casters came or went.
  [[nodiscard]] std::span<const Box> changed_world() const noexcept { return changed_; }
  [[nodiscard]] std::span<const Box> static_changed_world() const noexcept { return static_changed_; }
  /// The same by the shapes of casters, and by the bounds that the caller named. Valid until the next change.
  [[nodiscard]] std::span<const MovedCaster> moved() { return shapes_.moved(); }
  [[nodiscard]] std::span<const Box> named_world() const noexcept { return named_; }
  [[nodiscard]] bool any() const noexcept { return !moving_.empty(); }
  /// By instance: 1 where it moves, 0 where it is static.
  [[nodiscard]] std::span<const std::uint8_t> moves() const noexcept { return moves_; }

 private:
  const SceneBuffers& scene_;
  CasterShapes shapes_;
  std::vector<std::uint8_t> moves_;
  std::vector<int> rested_;  ///< frames, by instance
  std::vector<std::size_t> moving_;
  std::vector<Box> changed_, static_changed_, named_;
};

}  // namespace gnomon::render
