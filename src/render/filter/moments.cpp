// Hamburger's and Hausdorff's moment problems, by canonical distributions.
// Based on: Peters, Klein, "Moment Shadow Mapping", 2015; the bounded case is derived here from the condition
// that the polynomial with all four depths as roots has no mean.
#include "filter/moments.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gnomon::render {

ShareInFront share_in_front(const Moments& b, double u) noexcept {
  // Cholesky factors of the Hankel matrix (1 b1 b2; b1 b2 b3; b2 b3 b4).
  const double d22 = b[1] - b[0] * b[0];
  const double l32_d22 = b[2] - b[0] * b[1];
  const double d33_d22 = (b[3] - b[1] * b[1]) * d22 - l32_d22 * l32_d22;
  const double l32 = l32_d22 / d22;
  // c = Hankel^-1 (1, u, u^2): its polynomial has the other two depths as roots.
  double c1 = u - b[0];
  double c2 = u * u - b[1] - l32 * c1;
  c1 /= d22;
  c2 *= d22 / d33_d22;
  c1 -= l32 * c2;
  const double c0 = 1.0 - b[0] * c1 - b[1] * c2;
  const double p = c1 / c2, q = c0 / c2;
  const double root = std::sqrt(std::max(0.25 * p * p - q, 0.0));
  // The root that is nearer to 0 as a quotient: as a difference it would be rounding where p is large.
  const double away = -0.5 * p + (p > 0.0 ? -root : root);
  const double near = root > 0.0 ? q / away : away;
  const glm::dvec2 z{std::min(near, away), std::max(near, away)};
  if (u <= z.x) return {0.0, z};
  // Weight of z.x, or all but that of u, by Lagrange's polynomial.
  if (u <= z.y) return {(z.y * u - b[0] * (z.y + u) + b[1]) / ((z.x - u) * (z.x - z.y)), z};
  return {1.0 - (z.x * z.y - b[0] * (z.x + z.y) + b[1]) / ((u - z.x) * (u - z.y)), z};
}

double share_in_front_bounded(const Moments& b, double u) noexcept {
  const ShareInFront unbounded = share_in_front(b, u);
  if (unbounded.others.x >= -1.0 && unbounded.others.y <= 1.0) return unbounded.share;
  const double free_at = (b[1] - b[3] - u * (b[0] - b[2])) / (b[0] - b[2] - u * (1.0 - b[1]));
  const double first =
      (b[2] - b[1] * (u + free_at + 1.0) + b[0] * (u * free_at + u + free_at) - u * free_at) /
      ((-1.0 - u) * (-1.0 - free_at) * -2.0);
  const double free_weight =
      (b[2] - b[1] * u - b[0] + u) / ((free_at + 1.0) * (free_at - u) * (free_at - 1.0));
  return free_at < u ? first + free_weight : first;
}

namespace {

struct FourthMoment {
  double least, most;
};

FourthMoment range_of_fourth(double near, double far, double share) noexcept {
  const auto mean_of = [share](double a, double b) { return a + share * (b - a); };
  const double near2 = near * near, far2 = far * far;
  const double first = mean_of(near, far), second = mean_of(near2, far2),
               third = mean_of(near * near2, far * far2);
  const double most = second - (first - third) * (first - third) / std::max(1.0 - second, 1e-7);
  const double least = mean_of(near2 * near2, far2 * far2);
  return {least, std::max(most, least)};
}

}  // namespace

StoredTexel packed_moments(const Moments& b) noexcept {
  constexpr double kFlat = 8.0 * 0x1p-24;  // a variance that is all rounding of floats: one depth
  const double mean = std::clamp(b[0], -1.0, 1.0), variance = b[1] - mean * mean;
  if (!(variance > kFlat)) return {0.5 * mean + 0.5, 0.5 * mean + 0.5, 0.5, 0.0};
  const double half_skew = 0.5 * (b[2] - mean * (3.0 * b[1] - 2.0 * mean * mean)) / variance;
  const double root = std::sqrt(half_skew * half_skew + variance);
  const double away = half_skew + (half_skew > 0.0 ? root : -root), toward = -variance / away;
  const double near = std::clamp(mean + std::min(away, toward), -1.0, 1.0),
               far = std::clamp(mean + std::max(away, toward), -1.0, 1.0);
  const double share = std::clamp((mean - near) / std::max(far - near, 1e-7), 0.0, 1.0);
  const FourthMoment fourth = range_of_fourth(near, far, share);
  const double spread = (b[3] - fourth.least) / std::max(fourth.most - fourth.least, 1e-7);
  return {0.5 * near + 0.5, 0.5 * far + 0.5, share, std::sqrt(std::clamp(spread, 0.0, 1.0))};
}

Moments unpacked_moments(const StoredTexel& stored) noexcept {
  const double near = 2.0 * stored[0] - 1.0, far = 2.0 * stored[1] - 1.0, share = stored[2];
  const FourthMoment fourth = range_of_fourth(near, far, share);
  Moments b{};
  double a = 1.0, z = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    a *= near;
    z *= far;
    b[i] = a + share * (z - a);
  }
  b[3] = fourth.least + stored[3] * stored[3] * (fourth.most - fourth.least);
  return b;
}

StoredTexel store_four_moments(double depth, const glm::dvec2&, const FilterSettings& settings) noexcept {
  const double u = 2.0 * depth - 1.0, u2 = u * u;
  const Moments b{u, u2, u2 * u, u2 * u2};
  if (!is_unsigned_unit(settings.format)) return {b[0], b[1], b[2], b[3]};
  return {0.5 + 1.5 * b[0] - 2.0 * b[2], 4.0 * (b[1] - b[3]),
          0.5 + 0.86602540378443865 * b[0] - 0.38490017945975052 * b[2], 0.5 * (b[1] + b[3])};
}

Moments spread_by(double share, Moments b) noexcept {
  constexpr Moments kSpreadOut{0.0, 0.375, 0.0, 0.375};  // the widest distribution whose moments are these
  for (std::size_t i = 0; i < b.size(); ++i) b[i] += share * (kSpreadOut[i] - b[i]);
  return b;
}

Moments moments_of(const StoredTexel& texel, const FilterSettings& settings, double bias) noexcept {
  Moments b{texel[0], texel[1], texel[2], texel[3]};
  if (is_unsigned_unit(settings.format)) {
    const double x = texel[0] - 0.5, z = texel[2] - 0.5;
    b = {-x / 3.0 + 1.7320508075688772 * z, 0.125 * texel[1] + texel[3], -0.75 * x + 1.299038105676658 * z,
         texel[3] - 0.125 * texel[1]};
  }
  // Below these shares the rounded moments of a flat kernel may be no moments at all (20 000 random kernels).
  const bool coarse = is_unsigned_unit(settings.format) && settings.format != TexelFormat::uint32;
  const double least = (coarse ? 8.0 : 64.0) * rounding_of(settings.format);
  return spread_by(std::max(bias, least), b);
}

double receiver_of_moments(const FilterLookup& lookup, const glm::dvec2& box) noexcept {
  // On a slanted plane half of the kernel lies in front of the point: the bound would be right, and dark.
  constexpr double kSlant = 0.5;
  const double slant = kSlant * glm::dot(glm::abs(lookup.depth_gradient), box);
  return 2.0 * std::min(lookup.depth - slant, 1.0) - 1.0;
}

}  // namespace gnomon::render
