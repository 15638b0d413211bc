// The published strengths of a warp, each as the distance N of the projection centre from the near edge of
// the frustum in the light plane (kappa = 1 / N), or kappa itself where N may be infinite.
#pragma once

namespace gnomon {

/// A frustum's profile in the plane of view and light, in light-plane units per unit of view depth: largest
/// and smallest slope of its edges along the warp axis, k = sin(gamma) +- tan(theta) cos(gamma) for a
/// symmetric one.
struct FrustumProfile {
  double near_depth, far_depth;
  double k_low, k_high;
};

/// Strength that minimises max m_s times max m_t over the profile, exactly; 0 where no warp does. Derived
/// from Lloyd's error measure; turns off at tan(gamma) = tan(theta) (1 + 3/alpha) / (3 (1 - 1/alpha)).
[[nodiscard]] double storage_optimal_kappa(const FrustumProfile& profile) noexcept;

/// Lloyd's warp parameter eta in [-1, 1] (-1 none, 0 LiSPSM, 1 PSM) as he lets it fall off with the angle
/// between view and light. Angles in radians; `theta` is the half opening in their plane. (Lloyd, thesis
/// 2007, section 5.2)
[[nodiscard]] double lloyd_eta(double gamma, double theta) noexcept;

/// kappa times the body's length for a warp parameter eta and alpha = far / near. (Lloyd, thesis
/// 2007, 5.14-5.16)
[[nodiscard]] double kappa_length_from_eta(double eta, double alpha) noexcept;

/// N of a trapezoidal shadow map: puts the focus, `delta` from the top of a trapezoid of height `lambda`, on
/// the line that leaves 80 % of the map to what lies nearer; infinite for delta >= 0.8 lambda. (Martin and
/// Tan 2004)
[[nodiscard]] double trapezoid_distance(double lambda, double delta) noexcept;

}  // namespace gnomon
