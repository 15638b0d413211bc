// Which casters move, which are static, and where did any change since the last frame?
#include "casters/moving_casters.hpp"

#include <algorithm>

namespace gnomon::render {

void MovingCasters::move(std::size_t instance, const Box& to_world) {
  const Box from_world = scene_.boxes()[instance];
  shapes_.keep(instance);
  changed_.push_back(from_world);
  changed_.push_back(to_world);
  rested_[instance] = 0;
  if (moves_[instance] != 0) return;
  moves_[instance] = 1;
  moving_.push_back(instance);
  static_changed_.push_back(from_world);
}

void MovingCasters::bend(std::size_t instance, std::uint32_t first, std::span<const glm::vec3> positions) {
  shapes_.bend(instance, first, positions);
}

void MovingCasters::add(std::span<const Box> changed_world) {
  changed_.insert(changed_.end(), changed_world.begin(), changed_world.end());
  static_changed_.insert(static_changed_.end(), changed_world.begin(), changed_world.end());
  named_.insert(named_.end(), changed_world.begin(), changed_world.end());
}

void MovingCasters::finish_frame() {
  forget_changes();
  const auto settles = [&](std::size_t instance) {
    if (++rested_[instance] <= kRestFrames) return false;
    moves_[instance] = 0;
    static_changed_.push_back(scene_.boxes()[instance]);
    return true;
  };
  moving_.erase(std::remove_if(moving_.begin(), moving_.end(), settles), moving_.end());
}

void MovingCasters::forget_changes() noexcept {
  changed_.clear();
  static_changed_.clear();
  named_.clear();
  shapes_.forget_moves();
}

}  // namespace gnomon::render
