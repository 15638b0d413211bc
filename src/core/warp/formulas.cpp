// The published strengths of a warp.
// Based on: Lloyd, "Logarithmic Perspective Shadow Maps", thesis, 2007, sections 5.1 and 5.2; Martin and Tan,
// "Anti- aliasing and Continuity with Trapezoidal Shadow Maps", 2004. The storage optimum is derived for this
// project.
#include "warp/formulas.hpp"

#include <cmath>
#include <limits>

#include "geometry/vector.hpp"
#include "lanes/elementary.hpp"

namespace gnomon {

double storage_optimal_kappa(const FrustumProfile& p) noexcept {
  const double n = p.near_depth, f = p.far_depth;
  if (!(n > 0.0 && f > n)) return 0.0;
  const double y0 = min_of(n * p.k_low, f * p.k_low), y1 = f * p.k_high;
  // Whole length, top of the near plane, bottom of the far plane, from the near edge.
  const double length = y1 - y0, near_top = n * p.k_high - y0, far_bottom = max_of(0.0, f * p.k_low - y0);
  const double a = length + far_bottom - 3.0 * near_top;
  if (!(a > 0.0)) return 0.0;
  const double b = 2.0 * (length * far_bottom - near_top * (length + far_bottom));
  const double e = near_top * length * far_bottom;
  const double root = std::sqrt(b * b + 4.0 * a * e);
  const double stationary = b <= 0.0 ? (root - b) / (2.0 * a) : 2.0 * e / (b + root);
  // Equal error along the axis at both ends.
  const double middle = std::sqrt(n) * std::sqrt(f);
  const double equal = middle * p.k_high + (p.k_low >= 0.0 ? n : f) * p.k_low;
  const double distance = max_of(equal, stationary);
  return distance > 0.0 ? 1.0 / distance : 0.0;
}

double lloyd_eta(double gamma, double theta) noexcept {
  constexpr double kRightAngle = 1.5707963267948966;
  constexpr double kAtTheta = -0.2;  // eta where the light runs along the frustum's edge
  const double off = theta / 3.0, full = theta + 0.3 * (kRightAngle - theta);
  if (gamma < off) return -1.0;
  if (gamma < theta) return -1.0 + (kAtTheta + 1.0) * (gamma - off) / (theta - off);
  if (gamma < full)
    return kAtTheta - kAtTheta * elementary::sin(kRightAngle * (gamma - theta) / (full - theta));
  return 0.0;
}

double kappa_length_from_eta(double eta, double alpha) noexcept {
  const double root = std::sqrt(alpha);
  if (eta < 0.0) return (alpha - 1.0) * (eta + 1.0) / (1.0 + root - eta * (alpha - 1.0));
  return (root - 1.0) * (eta * root + 1.0);
}

double trapezoid_distance(double lambda, double delta) noexcept {
  const double rest = 1.6 * lambda - 2.0 * delta;
  return rest > 0.0 ? 0.4 * lambda * delta / rest : std::numeric_limits<double>::infinity();
}

}  // namespace gnomon
