// For fall-offs of the texels over the light plane: which two rows make the map with the least error? Sixteen
// fall-offs side by side, so that a search tries many at once.
#pragma once

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"
#include "lanes/elementary.hpp"
#include "warp/plane_error.hpp"
#include "warp/single.hpp"

namespace gnomon {

/// Shares of an extent below which another is rounding.
inline constexpr double kFlattest = 1e-6;
/// Kappa times length, beyond which float matrices end, has this fall-off at most.
inline constexpr float kStrongest = 43.0F;

/// Kappa times length of a fall-off: nearly its exponential less 1, for four multiplications.
template <typename Number>
Number reach_of(Number fall_off) noexcept {
  const auto strongest = static_cast<Number>(kStrongest);
  const Number root = 1 + (fall_off < strongest ? fall_off : strongest) * static_cast<Number>(0.0625);
  const Number power2 = root * root, power4 = power2 * power2, power8 = power4 * power4;
  return power8 * power8 - 1;
}
/// The fall-off whose w has this logarithm of its ratio from end to end.
inline double fall_off_of(double log_ratio) noexcept {
  return 16.0 * elementary::expm1(log_ratio * (1.0 / 16.0));
}

/// How texels grow over the body: about the logarithm of w's ratio from end to end, as a vector along the
/// direction it grows in, with the body scaled to a unit square. 0 is no warp, and opposite directions meet
/// there.
struct FallOff {
  double x = 0.0, y = 0.0;
};

/// A map by its fall-off and its rows: unit vectors over the image scaled to a unit square.
struct RowChoice {
  FallOff fall_off;
  glm::dvec2 row_a{1.0, 0.0}, row_b{0.0, 1.0};
  double value = 0.0;  ///< of the search: only to be compared with others of the same samples
};

/// Candidates of a search, side by side, in single precision: their errors need three digits.
struct RowLanes {
  alignas(64) FloatLanes x, y;                // fall-off
  alignas(64) FloatLanes a_x, a_y, b_x, b_y;  // rows
  alignas(64) FloatLanes value;
  void set(std::size_t lane, const RowChoice& rows) noexcept;
  void fill(const RowChoice& rows) noexcept;
  /// The first of the best.
  [[nodiscard]] std::size_t least() const noexcept;
  [[nodiscard]] RowChoice best() const noexcept { return at(least()); }
  [[nodiscard]] RowChoice at(std::size_t lane) const noexcept;
};

/// The body is a line or a point in the light plane: the width of its image is rounding, and no map is better
/// than another.
[[nodiscard]] bool is_line(const WarpInput& input, const BodyLanes& body) noexcept;

class RowSearch {
 public:
  /// `error` must outlive the search, has corners, and has counted no worst samples before.
  RowSearch(const WarpInput& input, const PlaneError& error) noexcept;

  /// Replaces each candidate's rows by the best of those near them: four for each row, `step` apart, in
  /// radians. The value goes by storage, or else by both extents of the worst texel together.
  void find_rows(double step, RowLanes& candidates) noexcept;

  [[nodiscard]] WarpChoice choice(const RowChoice& rows) noexcept;
  /// The fall-off under which texels go by what pixels cover, by least squares. Of a local light alone.
  [[nodiscard]] FallOff fitted() const noexcept { return fitted_; }
  /// A fall-off along the view whose w has this share of the logarithm of the ratio of depths.
  [[nodiscard]] FallOff ahead(double share) const noexcept;

 private:
  static constexpr std::size_t kMaxPoints = BodyLanes::kMost, kMaxCorners = whole_lanes(2 * kMaxVertices);
  using Form = FormLanes<kMaxCorners>;
  struct Axis {
    glm::dvec2 axis;
    double u_min, kappa, stretch, centre;
  };
  struct Maps;
  void find_samples(const PixelLanes& samples) noexcept;
  void fit(const PixelLanes& corners) noexcept;
  [[nodiscard]] Axis axis_of(const FallOff& fall_off) noexcept;
  [[nodiscard]] glm::dvec2 image_extent(const Axis& axis) noexcept;
  void find_axes(const RowLanes& candidates, Maps& maps) const noexcept;
  void find_image(Maps& maps) const noexcept;
  void find_directions(const RowLanes& candidates, float step, Maps& maps) const noexcept;
  void find_sides(Maps& maps) const noexcept;
  void find_products(Maps& maps) const noexcept;
  void find_sums(Maps& maps) const noexcept;
  void pick_rows(double step, const Maps& maps, RowLanes& candidates) const noexcept;

  // Always the same, but not known when this is compiled: as in lane_range.
  std::size_t lanes_, fall_offs_;
  const BodyLanes& body_;
  Objective objective_;
  double most_reach_;           // kappa times length
  glm::dvec2 middle_, extent_;  // of the body
  glm::dvec2 pivot_;            // that the axis turns about
  glm::dvec2 origin_;           // of the numbers below: where pixels are smallest
  FallOff fitted_;
  double depth_range_;  // logarithm of the ratio of the farthest to the nearest depth
  alignas(64) std::array<double, kMaxPoints> image_x_, image_y_;
  // The body's points, from the origin, as shares of its extents; in fours.
  std::size_t points_ = 0, samples_ = 0;
  std::array<float, kMaxPoints> point_x_, point_y_;
  Form form_;  // of the samples, alike
};

}  // namespace gnomon
