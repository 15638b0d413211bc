// The error of a projective map of the light plane, at points of the body: what searches over warps minimise.
#pragma once

#include <array>
#include <cstddef>

#include "gnomon/warp.hpp"
#include "warp/lanes.hpp"

namespace gnomon {

/// Points of the light plane, and d(light plane)/d(pixel) there on a surface that faces the half vector.
template <std::size_t Most>
struct PixelLanes {
  static constexpr std::size_t kMost = Most;
  alignas(64) std::array<double, Most> x, y, xx, xy, yx, yy, inverse_determinant;
  std::size_t count = 0;
  /// Copies of the first fill the last lanes.
  void fill_lanes() noexcept {
    for (std::size_t i = count; count > 0 && i < whole_lanes(count); ++i) {
      for (auto* lane : {&x, &y, &xx, &xy, &yx, &yy, &inverse_determinant}) (*lane)[i] = (*lane)[0];
    }
  }
};

/// The light-plane positions of a body's vertices, in whole lanes.
struct BodyLanes {
  alignas(64) std::array<double, whole_lanes(2 * kMaxVertices)> x, y;
  std::size_t count = 0;  // a multiple of kWarpLanes
  explicit BodyLanes(const WarpInput& input) noexcept;
};

/// Points of a body in the light plane with d(light plane)/d(pixel) on a surface that faces the half vector,
/// so that the perspective error of any map of the plane is a product of two 2x2 matrices away.
class PlaneError {
 public:
  static constexpr std::size_t kMaxSamples = 192, kMaxCorners = 64;
  using Corners = PixelLanes<kMaxCorners>;

  /// Samples the body for `input.objective`: vertices and middles of edges, where the largest errors are
  /// (under a local light of faces, too, as its rays fan out), or points spread evenly over the pixels and
  /// the logarithm of depth. `searched`: the choices come from a search, which would end where no sample is;
  /// where rays fan out wide, the inside of the body counts then as well. `set`: other points of the same
  /// spread, from 0 on.
  explicit PlaneError(const WarpInput& input, bool searched = false, int set = 0) noexcept;

  /// The objective under `choice`, up to a factor that is the same for every choice; infinite for an unusable
  /// one.
  [[nodiscard]] double value(const WarpChoice& choice) noexcept;
  /// From now on counts only the points whose error is near the worst under `choice`: for choices near it.
  void count_worst(const WarpChoice& choice) noexcept;
  void count_all() noexcept {
    sample_.count = all_;
    sample_.fill_lanes();
  }
  /// The body's vertices: few points that bound the error nearly everywhere.
  [[nodiscard]] const Corners& corners() const noexcept { return corners_; }
  [[nodiscard]] const BodyLanes& body() const noexcept { return body_; }

 private:
  struct Pixel {
    double x, y, xx, xy, yx, yy, determinant;
  };
  /// A pixel counts as `pixels` times as wide as it is there. False where nothing is known of it.
  bool pixel_at(const glm::dvec3& point, double pixels, Pixel& pixel) const noexcept;
  [[nodiscard]] const Polytope& from_pseudo_near(const Polytope& body, Polytope& counted) const noexcept;
  bool add(const glm::dvec3& point, double pixels) noexcept;
  void add_corners(const Polytope& body, double pixels) noexcept;
  void add_edges(const Polytope& body, double pixels) noexcept;
  void add_faces(const Polytope& body, double pixels) noexcept;
  void add_visible_points(int set) noexcept;
  void find_rows(const WarpChoice& choice) noexcept;
  [[nodiscard]] double storage_squared() const noexcept;
  [[nodiscard]] double worst_squared() noexcept;

  const WarpInput& input_;
  std::size_t all_ = 0;  // of the samples
  std::size_t lanes_;    // kWarpLanes, but not known when this is compiled: as in lane_range
  double height_range_ = 0.0, distance_ = 0.0;  // of the body, as plane_map takes them
  bool complete_ = true;                        // no vertex was refused
  double share_ = 1.0;  // of the samples that may exceed the value asked for: 0.05 for p95
  static_assert(kMaxSamples >= whole_lanes(2 * kMaxVertices));
  BodyLanes body_;
  Corners corners_;
  PixelLanes<kMaxSamples> sample_;
  // Of d(texel)/d(pixel) under the choice last asked for: squared lengths of its rows over the square of its
  // determinant, and the inverse of that. Before, the body's image.
  alignas(64) std::array<double, kMaxSamples> row_x_, row_y_, inverse_;
};

}  // namespace gnomon
