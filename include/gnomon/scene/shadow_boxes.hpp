// Which boxes of a scene cast shadows, and on which do they fall?
#pragma once

#include <cstddef>
#include <vector>

#include "gnomon/bounds.hpp"
#include "gnomon/scene/scene.hpp"

namespace gnomon {

/// The boxes of a scene's instances, as plans take them. A receiver of many triangles has the boxes of its
/// parts in place of its own: less air, and texels where there are surfaces.
class ShadowBoxes {
 public:
  ShadowBoxes() = default;
  /// The boxes of the instances as they stand.
  explicit ShadowBoxes(const Scene& scene) { add(scene); }
  /// Adds the instances of one more scene, after all others.
  void add(const Scene& scene);
  /// Places one instance elsewhere, as one box from then on; bounds() follow in place. `instance`: its
  /// number, below all().size().
  void place(std::size_t instance, const Box& bounds_world) noexcept;
  /// The boxes of all instances.
  [[nodiscard]] const std::vector<Box>& all() const noexcept { return all_; }
  /// Casters by instance: empty where one is none. Receivers: in any order, and some may be empty.
  [[nodiscard]] SceneBounds bounds() const noexcept {
    return alike_ ? SceneBounds{all_, all_} : SceneBounds{casters_, receivers_};
  }

 private:
  std::vector<Box> all_, casters_;
  std::vector<Box> receivers_;         ///< by instance: empty where one has parts. Then all parts
  std::vector<std::size_t> part_end_;  ///< of an instance's parts; they begin where those before it end
  std::vector<bool> casts_, receives_;
  bool alike_ = true;
};

}  // namespace gnomon
