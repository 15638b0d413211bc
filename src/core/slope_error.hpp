// What a map of a light with a position is judged by: the perspective error of any projective map of the
// light's slopes, at points of the body.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "gnomon/body.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/warp.hpp"
#include "light_frame.hpp"

namespace gnomon {

/// One frustum of a light with a position: a whole spot or one face of a cube. The slopes of a point are its
/// x and y in the frame over its distance along the frustum's axis; they are the post-projective coordinates
/// in which the light's rays are parallel.
struct LightFrustum {
  glm::dvec3 apex;   // relative to the camera
  LightFrame frame;  // z against the frustum's axis
  double slope;      // the frustum is |x| <= slope * distance, |y| <= slope * distance

  [[nodiscard]] double distance(const glm::dvec3& point) const noexcept;
  [[nodiscard]] glm::dvec2 slopes(const glm::dvec3& point) const noexcept;
  /// Way of the ray with these slopes, one unit of distance long along the axis.
  [[nodiscard]] glm::dvec3 ray(double x, double y) const noexcept;
};

/// A body's vertices as slopes; in WarpInput::Point z is 0 and depth 1, as nothing here depends on them.
struct SlopeBody {
  std::array<WarpInput::Point, kMaxVertices> point;
  int count = 0;
  double nearest = 0.0, farthest = 0.0;  // distances along the axis
  [[nodiscard]] std::span<const WarpInput::Point> points() const noexcept {
    return {point.data(), static_cast<std::size_t>(count)};
  }
};

/// Points of a body with d(slopes)/d(pixel) on a surface that faces the half vector.
class SlopeError {
 public:
  static constexpr int kMaxSamples = 192;

  /// `camera` has its position at the origin, as the body does. Samples vertices and middles of edges, or for
  /// Objective::p95 points spread evenly over the pixels and the logarithm of depth.
  SlopeError(const Camera& camera, const CameraAxes& axes, const LightFrustum& light, const Polytope& body,
             Objective objective, double least_depth) noexcept;

  /// The objective in pixels per texel over a map whose sides are one texel; infinite for an unusable choice.
  [[nodiscard]] double value(const WarpChoice& choice, std::span<const WarpInput::Point> body) noexcept;
  /// Largest extents along the map's x and y, over the samples of the last value().
  [[nodiscard]] double m_s() const noexcept { return s_; }
  [[nodiscard]] double m_t() const noexcept { return t_; }

 private:
  void add(const glm::dvec3& point) noexcept;
  void add_vertices_and_edges(const Polytope& body) noexcept;
  void add_visible_points(const Polytope& body) noexcept;
  [[nodiscard]] double longest_of_samples() noexcept;

  const Camera& camera_;
  const CameraAxes& axes_;
  const LightFrustum& light_;
  Objective objective_;
  double least_depth_;
  int count_ = 0;
  double s_ = 0.0, t_ = 0.0;
  // Slopes, d(slopes)/d(pixel) and the inverse of its determinant.
  alignas(32) std::array<double, kMaxSamples> x_, y_, xx_, xy_, yx_, yy_, inverse_determinant_;
  // Squared extents under the choice last asked for.
  alignas(32) std::array<double, kMaxSamples> s_squared_, t_squared_, longest_squared_;
};

/// What a search over warps starts from.
struct SlopeWarpSearch {
  std::span<const WarpInput::Point> body;
  WarpChoice unwarped;   // the choice to beat
  glm::dvec2 view_axis;  // unit: the view direction as the light sees it at the point nearest to the viewer
  glm::dvec2 nearest;    // slopes of that point
  double published;      // stretch of the published formula, >= 1
  double most_stretch;   // beyond it the map's rim nears the horizon
};

/// The warp that `warp` stands for under a light with a position; its ratio is its objective over that of the
/// unwarped map.
struct FoundWarp {
  WarpChoice choice;
  double ratio;
};
[[nodiscard]] FoundWarp find_slope_warp(SlopeError& error, const SlopeWarpSearch& search,
                                        const Warp& warp) noexcept;

}  // namespace gnomon
