// The error of a projective map of the light plane, at points of the body: what searches over warps minimise.
#pragma once

#include <array>
#include <cstddef>

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"
#include "lanes/lanes.hpp"
#include "warp/error_samples.hpp"
#include "warp/plane_map.hpp"

namespace gnomon {

/// Slope of an image's edge from which on rays fan out wide: 60 degrees. The worst texel may lie between
/// them.
inline constexpr double kWideSlope = 1.75;
/// Cosine between the eye's rays and the light's below which they come to meet: the half vector turns fast
/// between them, and the worst texel may lie anywhere.
inline constexpr double kOpposedCosine = -0.35;

/// Maps of the light plane, side by side. Rows may have any length.
struct ChoiceLanes {
  alignas(64) std::array<double, kDoubleLanes> axis_x, axis_y, kappa, centre, a_x, a_y, b_x, b_y;
  void set(std::size_t lane, const WarpChoice& choice) noexcept;
};
using LaneAnswers = std::array<bool, kDoubleLanes>;

/// The light-plane positions of a body's points, in whole lanes.
struct BodyLanes {
  static constexpr std::size_t kMost = whole_lanes(kMaxBodyPoints);
  alignas(64) std::array<double, kMost> x, y;
  std::size_t points = 0;  // of the body
  std::size_t count = 0;   // a multiple of kDoubleLanes
  explicit BodyLanes(const WarpInput& input) noexcept;
};

/// Points of a body in the light plane with d(light plane)/d(pixel) on a surface that faces the half vector,
/// so that the perspective error of any map of the plane is a product of two 2x2 matrices away.
class PlaneError {
 public:
  static constexpr std::size_t kMaxSamples = PixelLanes::kMost;
  /// No more samples than that may exceed the value asked for: of any set, and of the first.
  static constexpr std::size_t kMaxAbove = 9, kMaxAboveFirst = 4;

  /// Samples the body for `input.objective`: vertices and middles of edges, where the largest errors are
  /// (under a local light of faces, too, as its rays fan out), or points spread evenly over the pixels and
  /// the logarithm of depth, or points that are seen. `searched`: the choices come from a search, which would
  /// end where no sample is; where rays fan out wide, the inside of the body counts then as well. `set`:
  /// other points of the same spread, below kRaySets.
  explicit PlaneError(const WarpInput& input, bool searched = false, int set = 0) noexcept;
  /// From now on counts another set of visible points.
  void take_set(int set) noexcept;

  /// The objective under `choice`, up to a factor that is the same for every choice; infinite for an unusable
  /// one.
  [[nodiscard]] double value(const WarpChoice& choice) const noexcept;
  /// Whether the objective under each of these choices is below `value`, but for rounding; false where
  /// `usable` is false as well.
  void below(const ChoiceLanes& choices, double value, LaneAnswers& is_below) noexcept;
  /// From now on counts only the points whose error is near the worst under `choice`: for choices near it.
  void count_worst(const WarpChoice& choice) noexcept;
  void count_all() noexcept {
    sample_.count = all_;
    above_ = above(all_);
    sample_.fill_lanes();
  }
  /// From now on counts some points alone, at first the vertices, where the objective there is never above
  /// the objective at all points.
  void count_bound() noexcept;
  /// The body's vertices: few points that bound the error nearly everywhere. Before count_worst alone.
  void find_corners(PixelLanes& corners) const noexcept;
  [[nodiscard]] std::size_t corner_count() const noexcept { return corner_count_; }
  [[nodiscard]] const BodyLanes& body() const noexcept { return body_; }
  /// The samples that count, and how many of them may exceed the value asked for.
  [[nodiscard]] const PixelLanes& counted() const noexcept { return sample_; }
  [[nodiscard]] std::size_t above() const noexcept { return above_; }
  /// The value is the mean over the samples.
  [[nodiscard]] bool is_mean() const noexcept { return mean_; }
  /// Some samples may exceed the value.
  [[nodiscard]] bool is_percentile() const noexcept { return share_ > 0.0; }

 private:
  /// Of a percentile's samples, of those that are seen, and of those that lack a vertex, corners are no part.
  [[nodiscard]] bool corners_are_samples() const noexcept { return share_ == 0.0 && !mean_ && complete_; }
  void add_samples(bool searched, int set) noexcept;
  /// Of d(texel)/d(pixel) under a choice: squared lengths of its rows over the square of its determinant, and
  /// the inverse of that. Not kept: searches go deep, and stacks may be small.
  struct Rows {
    alignas(64) std::array<double, kMaxSamples> x, y, inverse;
  };
  void find_rows(const WarpChoice& choice, Rows& rows) const noexcept;
  [[nodiscard]] double squared(const WarpChoice& choice, Rows& rows) const noexcept;
  [[nodiscard]] std::size_t above(std::size_t samples) const noexcept;
  struct ExtentLanes;
  struct MapLanes;
  void find_extents(const ChoiceLanes& choices, ExtentLanes& extents) const noexcept;
  void fit(const ChoiceLanes& choices, const ExtentLanes& extents, MapLanes& map) const noexcept;
  void find_storage(const MapLanes& map, DoubleLanes& value) const noexcept;
  void count_above(const MapLanes& map, double square, DoubleLanes& count) const noexcept;
  void find_mean(const MapLanes& map, DoubleLanes& value) const noexcept;
  [[nodiscard]] double storage_squared(const Rows& rows) const noexcept;
  [[nodiscard]] double worst_squared(Rows& rows) const noexcept;
  void find_larger(Rows& rows) const noexcept;

  const WarpInput& input_;
  std::size_t all_ = 0;    // of the samples
  std::size_t above_ = 0;  // of those counted, as many as may exceed the value asked for
  std::size_t lanes_;      // kDoubleLanes, but not known when this is compiled: as in lane_range
  std::size_t corner_count_ = 0;
  double height_range_ = 0.0, distance_ = 0.0;  // of the body, as plane_map takes them
  double farthest_ = 0.0;                       // depth of the body, where it counts
  bool complete_ = true;                        // no vertex was refused
  bool mean_ = false;                           // over the samples
  double share_ = 1.0;  // of the samples that may exceed the value asked for: 0.05 for p95
  BodyLanes body_;
  PixelLanes sample_;
};

}  // namespace gnomon
