// Four lines round a body's image become the sides of another map: what is that map's error? Sixteen side by
// side, so that a search turns the lines in many ways at once.
#pragma once

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"
#include "warp/plane_error.hpp"
#include "warp/single.hpp"

namespace gnomon {

/// Lines that touch the body's image, one on each side: unit normals towards the body. The first two are
/// opposite sides, and the others.
struct Sides {
  std::array<glm::dvec2, 4> normal{{{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}};
};

/// Candidates of a search, side by side, in single precision: their errors need three digits.
struct SideLanes {
  alignas(64) std::array<FloatLanes, 4> turn;  // of each side, in radians, from where the search is: up to 1
  alignas(64) std::array<FloatLanes, 4> x, y;  // the normals, once they are turned
  alignas(64) FloatLanes value;                // the square of the objective: only to be compared with others
  /// The first of the best.
  [[nodiscard]] std::size_t least() const noexcept { return first_of_least_lane(value, kSingleTie); }
  [[nodiscard]] Sides at(std::size_t lane) const noexcept;
};

/// Turns a map's sides. Four lines round the body's image give every projective map that fits the body. In
/// the image under a map that is nearly the best, a step of a line is worth the same however strong the warp.
class SideSearch {
 public:
  /// The image is the one under `from`, scaled to a unit square: Sides{} is `from` itself. The samples that
  /// `error` counts now count, of the first set. The body is no line (is_line), and `from` is usable.
  SideSearch(const WarpInput& input, const PlaneError& error, const WarpChoice& from) noexcept;

  /// Each candidate's normals, turned from `sides`, and its value by the objective of the samples that count;
  /// infinite where the lines make no map.
  void find_values(const Sides& sides, SideLanes& candidates) const noexcept;
  [[nodiscard]] WarpChoice choice(const Sides& sides) const noexcept;

 private:
  static constexpr std::size_t kMaxPoints = BodyLanes::kMost;
  using Form = FormLanes<PixelLanes::kMost>;
  struct Maps;
  void find_points() noexcept;
  void find_samples(const PixelLanes& samples) noexcept;
  void turn(const Sides& sides, SideLanes& candidates) const noexcept;
  void fit(const SideLanes& candidates, Maps& maps) const noexcept;
  void find_storage(const Maps& maps, SideLanes& candidates) const noexcept;
  void find_worst(const Maps& maps, SideLanes& candidates) const noexcept;
  void find_percentile(const Maps& maps, SideLanes& candidates) const noexcept;
  void find_mean(const Maps& maps, SideLanes& candidates) const noexcept;

  // Always the same, but not known when this is compiled: as in lane_range.
  std::size_t lanes_, candidates_;
  const BodyLanes& body_;
  Objective objective_;
  float most_stretch_;  // of the strongest warp
  bool strong_;         // the image is near that limit
  glm::dvec2 origin_;
  bool mean_;  // of the samples, in place of the worst
  // Of the image, over (x, y, 1) of the light plane from the origin: its coordinates are a / w and b / w.
  glm::dvec3 a_, b_, w_;
  std::size_t points_ = 0, samples_ = 0, above_ = 0;
  // The body's points in the image, in fours; and a warp's w at them.
  alignas(64) std::array<double, kMaxPoints> image_x_, image_y_;
  alignas(64) std::array<float, kMaxPoints> point_x_, point_y_, point_w_;
  Form form_;  // of the samples, in the image
  // Of a mean: what goes by the gradients' turns.
  alignas(64) std::array<float, PixelLanes::kMost> turn_turn_, turn_first_, turn_second_;
};

}  // namespace gnomon
