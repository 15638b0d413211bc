// The error of a projective map of the light plane, at points of the body: what searches over warps minimise.
#pragma once

#include <array>
#include <span>

#include "gnomon/warp.hpp"

namespace gnomon {

/// Points of a body in the light plane with d(light plane)/d(pixel) on a surface that faces the half vector,
/// so that the perspective error of any map of the plane is a product of two 2x2 matrices away.
class PlaneError {
 public:
  static constexpr int kMaxSamples = 192;

  /// Samples the body for `input.objective`: vertices and middles of edges, where the largest errors are
  /// (under a local light of faces, too, as its rays fan out), or points spread evenly over the pixels and
  /// the logarithm of depth.
  explicit PlaneError(const WarpInput& input) noexcept;

  /// The objective under `choice`, up to a factor that is the same for every choice; infinite for an unusable
  /// one.
  [[nodiscard]] double value(const WarpChoice& choice) noexcept;

 private:
  /// A pixel counts as `pixels` times as wide as it is there.
  bool add(const glm::dvec3& point, double pixels) noexcept;
  void add_vertices_and_edges(const Polytope& body, double pixels) noexcept;
  void add_faces(const Polytope& body, double pixels) noexcept;
  void add_visible_points() noexcept;
  [[nodiscard]] double storage_squared() const noexcept;
  [[nodiscard]] double worst_squared() noexcept;

  const WarpInput& input_;
  int count_ = 0;
  bool complete_ = true;  // no vertex was refused
  double share_ = 1.0;    // of the samples that may exceed the value asked for: 0.05 for p95
  // Where, and d(light plane)/d(pixel).
  alignas(32) std::array<double, kMaxSamples> x_, y_, xx_, xy_, yx_, yy_, inverse_determinant_;
  // Of d(texel)/d(pixel) under the choice last asked for: squared lengths of its rows, inverse of its
  // determinant.
  alignas(32) std::array<double, kMaxSamples> row_x_, row_y_, inverse_;
};

}  // namespace gnomon
