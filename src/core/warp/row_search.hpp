// For a fall-off of the texels over the light plane: which two rows make the map with the least error at the
// body's corners? Read off fans of directions, so that a search is left with the fall-off's two numbers.
#pragma once

#include "warp/plane_error.hpp"

namespace gnomon {

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
  glm::dvec2 image{1.0, 1.0};  ///< extents of the image
  double value = 0.0;          ///< the objective at the corners
};

class RowSearch {
 public:
  /// `error` must outlive the search. Its corners are more than 0.
  RowSearch(const WarpInput& input, const PlaneError& error) noexcept;

  /// The best of all rows, to a sixteenth of a half turn.
  [[nodiscard]] RowChoice round(const FallOff& fall_off) noexcept;
  /// The best of the rows near these.
  [[nodiscard]] RowChoice near(const FallOff& fall_off, const RowChoice& rows) noexcept;
  /// The body is a line or a point in the light plane: the width of its image is rounding, and no row is
  /// better than another.
  [[nodiscard]] bool line() const noexcept { return line_; }
  [[nodiscard]] WarpChoice choice(const RowChoice& rows) noexcept;
  /// The choice's own fall-off and rows.
  [[nodiscard]] RowChoice rows_of(const WarpChoice& choice) noexcept;
  /// The fall-off under which texels go by what pixels cover, by least squares.
  [[nodiscard]] FallOff fitted() const noexcept;
  /// A fall-off along the view whose w has this share of the logarithm of the ratio of depths.
  [[nodiscard]] FallOff ahead(double share) const noexcept;

 private:
  struct Fan;
  struct Axis {
    glm::dvec2 axis;
    double u_min, kappa, stretch, centre;
  };
  [[nodiscard]] Axis axis_of(const FallOff& fall_off) noexcept;
  [[nodiscard]] RowChoice best(const FallOff& fall_off, const Fan& fan) noexcept;
  void find_image(const Axis& axis, RowChoice& rows) noexcept;
  void find_pixels(const Axis& axis, const glm::dvec2& image) noexcept;
  void find_sides(const Fan& fan) noexcept;
  void write_rows(const Fan& fan, std::size_t a, std::size_t b, double squared,
                  RowChoice& rows) const noexcept;
  void best_by_storage(const Fan& fan, RowChoice& rows) noexcept;
  void best_by_sum(const Fan& fan, RowChoice& rows) noexcept;
  void best_by_worst(const Fan& fan, RowChoice& rows) noexcept;

  // Always the same, but not known when this is compiled: as in lane_range.
  std::size_t lanes_, directions_;
  const PixelLanes& corners_;
  const BodyLanes& body_;
  Objective objective_;
  double most_reach_;           // kappa times length
  glm::dvec2 middle_, extent_;  // of the body
  glm::dvec2 pivot_;            // that the axis turns about
  bool line_;
  double depth_range_;  // logarithm of the ratio of the farthest to the nearest depth
  // Squared lengths of the rectangle's sides, for each direction of both fans.
  alignas(64) std::array<double, 2 * kWarpLanes> side_;
  // Of the body's image, scaled to a unit square.
  alignas(64) std::array<double, whole_lanes(2 * kMaxVertices)> image_x_, image_y_;
  // Of the corners: the squared extent of a map's side for rows (a, b) is xx a^2 + xy a b + yy b^2 times the
  // square of the other side's length, and the texel's area in pixels.
  alignas(64) std::array<double, PlaneError::kMaxCorners> xx_, xy_, yy_, area_;
};

}  // namespace gnomon
