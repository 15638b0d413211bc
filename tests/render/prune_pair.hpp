// A scene drawn twice, with and without leaving out: what the tests of the rules compare.
#pragma once

#include <bit>
#include <vector>

#include "gnomon/render/renderer.hpp"

namespace gnomon::render {

inline constexpr double kLostShare = 1e-4;  ///< of the texels, to small casters

inline std::vector<Box> boxes_of(const Scene& scene) {
  std::vector<Box> boxes;
  for (const Instance& instance : scene.instances) boxes.push_back(instance.bounds_world);
  return boxes;
}

inline FrameOptions mask_only(PruneRules rules) {
  FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  options.prune = rules;
  options.lost_shadow_share = kLostShare;
  return options;
}

inline std::size_t differing(const FloatImage& a, const FloatImage& b) {
  std::size_t count = 0;
  // Of visibility and map the first: a map that is not there changes the numbers of those behind it.
  for (std::size_t i = 0; i < a.values.size(); i += 2)
    count += std::bit_cast<std::uint32_t>(a.values[i]) != std::bit_cast<std::uint32_t>(b.values[i]) ? 1 : 0;
  return count;
}

inline std::size_t shadowed(const FloatImage& mask) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < mask.values.size(); i += 2) count += mask.values[i] < 1.0f ? 1 : 0;
  return count;
}

/// A scene drawn by two renderers, one that leaves out and one that does not.
struct Pair {
  Scene scene;
  std::vector<Box> boxes;
  Renderer pruned, full;
  explicit Pair(Scene of) : scene(std::move(of)), boxes(boxes_of(scene)), pruned(scene), full(scene) {}
  [[nodiscard]] SceneBounds bounds() const noexcept { return {boxes, boxes}; }
};

}  // namespace gnomon::render
