// What does one camera see? The camera, and what is known of the surfaces in view: depths and points.
// Based on: Lauritzen, Salvi, Lefohn, "Sample Distribution Shadow Maps", 2010; bins on an absolute scale and
// the tracker are this project's.
// Coarse depths based on: Hasselgren, Andersson, Akenine-Möller, "Masked Software Occlusion Culling", 2016;
// the visible depth range from occlusion culling: Scherzer, Wimmer, Purgathofer, "A Survey of Real-Time Hard
// Shadow Mapping Methods", 2011.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"

namespace gnomon {

struct VisibleDepths;

/// A camera and the surfaces it sees. A Camera converts to it; the rest is optional, stays the caller's, and
/// is read during a call only.
struct View {
  Camera camera;  ///< where the eye stands and what its image shows
  /// View depths at which the camera sees a surface, of this frame or tracked over the last ones; nullptr:
  /// unknown, and so are empty ones.
  const VisibleDepths* depths = nullptr;
  /// Points of surfaces that the camera sees, world space. They are of a depth buffer of this frame or the
  /// last, read at every tenth pixel, say, or the first hits of rays. Empty: unknown. Time grows with their
  /// number.
  std::span<const glm::dvec3> points_world = {};
  /// Unit normals of the same points towards the eye, or empty: unknown. Pages serve the surfaces that they
  /// describe. Objective::picture does not count points that are turned from the light: no map serves them.
  std::span<const glm::dvec3> normals_world = {};
};

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

/// Follows the visible depths from frame to frame. Depths that come into view count at once, and those that
/// leave it are given up slowly. Edges move in whole bins, so that splits do not wobble. Plain data; start
/// with an empty one and clear it at a cut.
class DepthTracker {
 public:
  /// Frames that the nearest and the farthest edge take to move inwards by one bin, at least 1. One bin of
  /// room stays. With 4, a visible range that halves is followed within 32 frames to that bin.
  int frames_per_bin = 4;
  /// Frames for which a depth between them that shows nothing any more still counts, at least 1.
  int hold_frames = 30;

  /// Takes the next frame. One that shows nothing changes nothing. Each depth counts with a bin's room on
  /// either side: 9 %, for the camera's own motion until the frame is drawn.
  void update(const VisibleDepths& frame) noexcept;
  /// The depths to plan with; empty before the first surface.
  [[nodiscard]] const VisibleDepths& depths() const noexcept { return depths_; }
  /// Forgets all frames, and keeps both numbers above: call it at a cut.
  void clear() noexcept;

 private:
  void move_edges(int first_seen, int last_seen) noexcept;

  VisibleDepths depths_;
  std::array<std::uint16_t, kDepthBins> frames_unseen_{};
  int first_ = -1, last_ = -1;  // bins; -1: none yet
  int first_wait_ = 0, last_wait_ = 0;
};

/// A tile is a square of so many pixels along each side.
inline constexpr int kCoarseTilePixels = 8;

/// Triangles of one object. Vertices are read through `indices`, three for each triangle and all in range.
struct CoarseMesh {
  std::span<const glm::vec3> positions;    ///< object space
  std::span<const std::uint32_t> indices;  ///< a multiple of three
  glm::dmat4 world_from_object{1.0};       ///< affine
  bool occludes = true;                    ///< false: has holes (alpha-masked) and hides nothing
  bool double_sided = false;               ///< true: back faces are drawn, too
  bool mirrored = false;                   ///< the transform turns the winding round
};

/// Knowledge of one tile; scratch memory of coarse_depths().
struct CoarseTile {
  std::uint64_t covered = 0;                                ///< pixels of the layer that is being filled
  float layer = 0.0f;                                       ///< farthest depth of that layer
  float farthest = std::numeric_limits<float>::infinity();  ///< nothing behind it shows in any pixel
};
/// Tiles that coarse_depths() needs for the camera's image: 32 400 of 16 bytes for 1920 x 1080. 0 where the
/// image has no pixels.
[[nodiscard]] std::size_t coarse_tile_count(const Camera& camera) noexcept;

/// Depths that may show a surface of `meshes`, or anything within `boxes`. Never skips the depth of a pixel
/// that shows one. Triangles hide what lies behind tiles whose every pixel centre they cover, and what is
/// within a tile of such an edge counts as visible. Boxes hide nothing, and count from their nearest to their
/// farthest depth. The counts are of tiles, not of pixels. Empty, and unknown to make_plan, where nothing
/// is in view or `tiles` has fewer than coarse_tile_count(). So it is where the camera has
/// no image or a near plane that is not in front of it.
///
/// Time grows with triangles and with the tiles that each covers: docs/performance.md. A camera of the same
/// view and fewer pixels takes less, and may then miss what shows in less than one of them. Pure; allocates
/// nothing.
[[nodiscard]] VisibleDepths coarse_depths(const Camera& camera, std::span<const CoarseMesh> meshes,
                                          std::span<const Box> boxes, std::span<CoarseTile> tiles) noexcept;

}  // namespace gnomon
