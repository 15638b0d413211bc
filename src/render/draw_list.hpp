// Which instances each view of a frame draws, as indirect draw commands.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "caster_culling.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/renderer.hpp"
#include "scene_buffers.hpp"

namespace gnomon::render {

/// Commands [begin, end) of DrawLists' buffer, drawn with the state of one batch.
struct BatchRange {
  std::uint32_t batch = 0, begin = 0, end = 0;
};

/// The draw lists of all maps and of the camera, built on the CPU and sent in one go before the first pass: a
/// buffer that changes between passes makes the driver wait for the pass before.
class DrawLists {
 public:
  explicit DrawLists(const SceneBuffers& scene);

  /// Rebuilds and uploads everything for this frame.
  void build(const CullingJob& job, const Camera& camera);
  /// What the maps hold is gone: the next build() draws them whole.
  void forget_maps() noexcept { culling_.forget(); }

  [[nodiscard]] std::span<const BatchRange> map(int index) const noexcept {
    return view(static_cast<std::size_t>(index));
  }
  [[nodiscard]] std::span<const BatchRange> camera() const noexcept { return view(kCameraView); }
  [[nodiscard]] const MapStats& map_stats(int index) const noexcept {
    return stats_[static_cast<std::size_t>(index)];
  }
  /// Whether the map is drawn on top of what it holds.
  [[nodiscard]] bool adds_to(int index) const noexcept { return adds_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] const std::array<PruneSaving, kPruneRuleCount>& saved() const noexcept { return saved_; }
  [[nodiscard]] const MapStats& camera_stats() const noexcept { return stats_[kCameraView]; }

  /// Draws commands [begin, end) with the state that is bound.
  void draw(std::uint32_t begin, std::uint32_t end) const noexcept;

 private:
  static constexpr std::size_t kCameraView = kMaxMaps;
  [[nodiscard]] std::span<const BatchRange> view(std::size_t v) const noexcept {
    return {ranges_.data() + first_range_[v], first_range_[v + 1] - first_range_[v]};
  }
  void add_view(std::size_t v, std::span<const std::uint8_t> draws);
  void mark_visible(const Camera& camera);

  const SceneBuffers& scene_;
  CasterCulling culling_;
  std::array<PruneSaving, kPruneRuleCount> saved_{};
  std::array<bool, kMaxMaps> adds_{};
  std::vector<std::uint8_t> visible_;   ///< scratch: by instance
  std::vector<std::uint32_t> objects_;  ///< object of each drawn instance, all views one after the other
  std::vector<DrawCommand> commands_;
  std::vector<BatchRange> ranges_;
  std::array<std::size_t, kMaxMaps + 2> first_range_{};
  std::array<MapStats, kMaxMaps + 1> stats_{};
  Buffer object_buffer_, command_buffer_;
  std::size_t object_capacity_ = 0, command_capacity_ = 0;
};

}  // namespace gnomon::render
