// Which boxes of a scene cast shadows, and on which do they fall?
#pragma once

#include <vector>

#include "gnomon/bounds.hpp"
#include "gnomon/scene/scene.hpp"

namespace gnomon {

/// The boxes of a scene's instances, as plans take them.
class ShadowBoxes {
 public:
  ShadowBoxes() = default;
  /// The boxes of the instances as they stand.
  explicit ShadowBoxes(const Scene& scene) {
    for (const Instance& instance : scene.instances) add(instance);
  }
  /// Adds one more instance, after all others.
  void add(const Instance& instance) {
    all_.push_back(instance.bounds_world);
    casters_.push_back(instance.casts ? instance.bounds_world : Box{});
    receivers_.push_back(instance.receives ? instance.bounds_world : Box{});
    alike_ = alike_ && instance.casts && instance.receives;
    casts_.push_back(instance.casts);
    receives_.push_back(instance.receives);
  }
  /// Places one instance elsewhere; bounds() follow in place. `instance`: its number, below all().size().
  void place(std::size_t instance, const Box& bounds_world) noexcept {
    all_[instance] = bounds_world;
    if (casts_[instance]) casters_[instance] = bounds_world;
    if (receives_[instance]) receivers_[instance] = bounds_world;
  }
  /// The boxes of all instances.
  [[nodiscard]] const std::vector<Box>& all() const noexcept { return all_; }
  /// Casters and receivers, by instance: empty where one is none.
  [[nodiscard]] SceneBounds bounds() const noexcept {
    return alike_ ? SceneBounds{all_, all_} : SceneBounds{casters_, receivers_};
  }

 private:
  std::vector<Box> all_, casters_, receivers_;
  std::vector<bool> casts_, receives_;
  bool alike_ = true;
};

}  // namespace gnomon
