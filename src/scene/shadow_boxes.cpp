// Keeps boxes of casters and receivers, by instance.
#include "gnomon/scene/shadow_boxes.hpp"

#include <algorithm>

#include "mesh_parts.hpp"

namespace gnomon {

void ShadowBoxes::add(const Scene& scene) {
  const std::vector<detail::MeshPart> parts = detail::mesh_parts(scene);
  const std::size_t before = all_.size();
  std::vector<Box> own;
  std::size_t next = 0;
  const std::size_t first_part = part_end_.empty() ? 0 : part_end_.back();
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const std::size_t begin = next;
    while (next < parts.size() && parts[next].instance == i) ++next;
    const bool whole = next == begin;
    all_.push_back(instance.bounds_world);
    casters_.push_back(instance.casts ? instance.bounds_world : Box{});
    own.push_back(instance.receives && whole ? instance.bounds_world : Box{});
    part_end_.push_back(first_part + next);
    alike_ = alike_ && instance.casts && instance.receives && whole;
    casts_.push_back(instance.casts);
    receives_.push_back(instance.receives);
  }
  receivers_.insert(receivers_.begin() + static_cast<std::ptrdiff_t>(before), own.begin(), own.end());
  for (const detail::MeshPart& part : parts) receivers_.push_back(part.bounds_world);
}

void ShadowBoxes::place(std::size_t instance, const Box& bounds_world) noexcept {
  all_[instance] = bounds_world;
  if (casts_[instance]) casters_[instance] = bounds_world;
  if (!receives_[instance]) return;
  receivers_[instance] = bounds_world;
  const auto parts = receivers_.begin() + static_cast<std::ptrdiff_t>(all_.size());
  const std::size_t begin = instance > 0 ? part_end_[instance - 1] : 0;
  std::fill(parts + static_cast<std::ptrdiff_t>(begin),
            parts + static_cast<std::ptrdiff_t>(part_end_[instance]), Box{});
}

}  // namespace gnomon
