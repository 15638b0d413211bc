// Which view depths of the last frame showed a surface, so that no shadow map is spent on the others.
// Based on: Lauritzen, Salvi, Lefohn, "Sample Distribution Shadow Maps", 2010; bins on an absolute scale and
// the tracker are this project's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace gnomon {

/// Bins are evenly spaced in the logarithm of depth, the same for every camera: eight per doubling (9 %),
/// from 2^-20 to 2^24 world units. Nearer and farther depths count in the first or last one.
inline constexpr int kDepthBinsPerDoubling = 8;
inline constexpr int kLowestDepthExponent = -20, kHighestDepthExponent = 24;
inline constexpr int kDepthBins = (kHighestDepthExponent - kLowestDepthExponent) * kDepthBinsPerDoubling;
/// Depths this share nearer than the nearest and farther than the farthest visible one are covered, too.
inline constexpr double kDepthSafety = 1.0 / 64.0;

/// The visible view depths of a frame: how many pixels fall into each bin, and the nearest and farthest of
/// them.
struct VisibleDepths {
  std::array<std::uint32_t, kDepthBins> count{};  ///< pixels of each bin (depth_bin)
  /// Nearest visible depth, world units. min > max: nothing is visible.
  double min = std::numeric_limits<double>::infinity();
  double max = 0.0;  ///< farthest visible depth, world units

  /// True where nothing is visible.
  [[nodiscard]] bool empty() const noexcept { return !(min <= max); }
  /// Counts one pixel. No surface, and not counted: 0, below, infinite, not a number.
  void add(double view_depth) noexcept;
  /// Counts a picture's pixels; the sky is 0 or infinity.
  void add(std::span<const float> view_depths) noexcept;
};

/// Bin of a depth above 0, and the depth where a bin begins.
[[nodiscard]] int depth_bin(double view_depth) noexcept;
[[nodiscard]] double depth_bin_begin(int bin) noexcept;

/// For renderers that only know the nearest and the farthest: every bin between them counts one pixel. Empty
/// unless 0 < min <= max < infinity.
[[nodiscard]] VisibleDepths visible_between(double min, double max) noexcept;

/// Follows the visible depths from frame to frame: what comes into view counts at once, what leaves it is
/// given up slowly, and edges move in whole bins, so that splits do not wobble. Plain data; start with an
/// empty one and clear it at a cut.
class DepthTracker {
 public:
  /// Frames that the nearest and the farthest edge take to move inwards by one bin, at least 1: with 4, a
  /// visible range that halves is followed within 32 frames.
  int frames_per_bin = 4;
  /// Frames for which a depth between them that shows nothing any more still counts, at least 1.
  int hold_frames = 30;

  /// Takes the next frame. One that shows nothing changes nothing. Each depth counts with a bin's room on
  /// either side: 9 %, for the camera's own motion until the frame is drawn.
  void update(const VisibleDepths& frame) noexcept;
  /// The depths to plan with; empty before the first surface.
  [[nodiscard]] const VisibleDepths& depths() const noexcept { return depths_; }
  /// Forgets all frames: call it at a cut.
  void clear() noexcept { *this = {}; }

 private:
  void move_edges(int first_seen, int last_seen) noexcept;

  VisibleDepths depths_;
  std::array<std::uint16_t, kDepthBins> frames_unseen_{};
  int first_ = -1, last_ = -1;  // bins; -1: none yet
  int first_wait_ = 0, last_wait_ = 0;
};

}  // namespace gnomon
