// How low does the error of a warp along the view come, at most, whatever its strength?
// Based on: the error measure of Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006.
// With rows Jx and Jy of the Jacobian of the light plane by the pixel, its determinant D, stretch = 1 + kappa
// length and t = kappa x / w, texels are length w^2 |Jx - t Jy| / (stretch D) and width w |Jy| / D pixels
// long.
#include "warp/least_along_view.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"
#include "geometry/wide.hpp"
#include "warp/lanes.hpp"

namespace gnomon {
namespace {

constexpr std::size_t kAtOnce = 16, kMostPoints = whole_lanes(2 * kMaxVertices);
using Strengths = std::array<float, kAtOnce>;

// Of kappa times length: 0 and strengths a factor apart; then shares of the best of those, from one neighbour
// to the other.
constexpr float kFirst = 0.0625F, kFactor = 2.2F, kFinest = 0.4775F, kFine = 1.1035628F;
constexpr Strengths powers(float first, float factor) noexcept {
  Strengths result{};
  for (float& power : result) {
    power = first;
    first *= factor;
  }
  return result;
}
constexpr Strengths with_none() noexcept {
  Strengths reaches = powers(kFirst / kFactor, kFactor);
  reaches[0] = 0.0F;
  return reaches;
}
constexpr Strengths kReaches = with_none(), kShares = powers(kFinest, kFine);

/// Points over the body's length and half its width, and the squares of Jx / D, their product with Jy / D
/// and the squares of that, over the largest.
struct Corners {
  std::array<float, kMostPoints> body_x, body_y, x, y, xx, xy, yy;
  std::size_t points, corners;
  float wider;  // half the width over the length
};

GNOMON_WIDE void find_squares(const Corners& c, std::size_t strengths, bool storage, float across,
                              const Strengths& reach, Strengths& square) noexcept {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto min_of = [](float a, float b) { return a < b ? a : b; };
  const auto max_of = [](float a, float b) { return a > b ? a : b; };
  const std::size_t lanes = strengths & ~(kAtOnce - 1);
  alignas(64) Strengths k, left, right, most_s, most_t;
  for (std::size_t l = 0; l < lanes; ++l) {
    k[l] = reach[l];
    left[l] = kInfinity;
    right[l] = -kInfinity;
    most_s[l] = most_t[l] = 0.0F;
  }
  for (std::size_t i = 0; i < c.points; ++i) {
    const float x = c.body_x[i], y = c.body_y[i];
    for (std::size_t l = 0; l < lanes; ++l) {
      const float image = x / (1.0F + k[l] * y);
      left[l] = min_of(left[l], image);
      right[l] = max_of(right[l], image);
    }
  }
  for (std::size_t i = 0; i < c.corners; ++i) {
    const float x = c.x[i] * c.wider, y = c.y[i], xx = c.xx[i], xy = c.xy[i], yy = c.yy[i];
    for (std::size_t l = 0; l < lanes; ++l) {
      const float w = 1.0F + k[l] * y, w2 = w * w, t = k[l] * x / w;
      most_s[l] = max_of(most_s[l], w2 * yy);
      most_t[l] = max_of(most_t[l], w2 * w2 * (xx - t * (xy + xy - t * yy)));
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) {
    const float stretch = 1.0F + k[l], width = right[l] - left[l];
    const float s = width * width * most_s[l], t = most_t[l] / (stretch * stretch);
    const float product = s * t, larger = max_of(across * s, t);
    square[l] = storage ? product : larger;
  }
}

/// `scale`: what the squares of Jx / D and the other two are to be multiplied with, so that none exceeds 1.
Corners corners_of(const WarpInput& input, const PlaneError& error, double half_width, double length,
                   double& scale) noexcept {
  const BodyLanes& body = error.body();
  const PixelLanes& at = error.corners();
  Corners c;
  c.points = body.points;
  c.corners = at.count;
  c.wider = static_cast<float>(half_width / length);
  const double per_x = 1.0 / half_width, per_y = 1.0 / length, y_min = input.y_min;
  for (std::size_t i = 0; i < c.points; ++i) {
    c.body_x[i] = static_cast<float>((body.x[i] - input.centre) * per_x);
    c.body_y[i] = static_cast<float>((body.y[i] - y_min) * per_y);
  }
  std::array<double, kMostPoints> xx, xy, yy;
  double most = 0.0;
  for (std::size_t i = 0; i < c.corners; ++i) {
    const double inverse2 = at.inverse_determinant[i] * at.inverse_determinant[i];
    xx[i] = (at.xx[i] * at.xx[i] + at.xy[i] * at.xy[i]) * inverse2;
    xy[i] = (at.xx[i] * at.yx[i] + at.xy[i] * at.yy[i]) * inverse2;
    yy[i] = (at.yx[i] * at.yx[i] + at.yy[i] * at.yy[i]) * inverse2;
    most = max_of(most, xx[i] + yy[i]);
  }
  scale = inverse_or_0(most);
  for (std::size_t i = 0; i < c.corners; ++i) {
    c.x[i] = static_cast<float>((at.x[i] - input.centre) * per_x);
    c.y[i] = static_cast<float>((at.y[i] - y_min) * per_y);
    c.xx[i] = static_cast<float>(xx[i] * scale);
    c.xy[i] = static_cast<float>(xy[i] * scale);
    c.yy[i] = static_cast<float>(yy[i] * scale);
  }
  return c;
}

/// Whether the image of the body may have next to no width at one strength, between two that are tried: where
/// it lies along a line aslant of the view, or far aside of what warps project from.
bool may_vanish(const BodyLanes& body, double half_width) noexcept {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0, left = body.x[0], right = left;
  for (std::size_t i = 0; i < body.points; ++i) {
    left = min_of(left, body.x[i]);
    right = max_of(right, body.x[i]);
    const double dx = body.x[i] - body.x[0], dy = body.y[i] - body.y[0];
    x += dx;
    y += dy;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  const double mean = 1.0 / static_cast<double>(body.points);
  xx -= x * x * mean;
  xy -= x * y * mean;
  yy -= y * y * mean;
  // Of the square of the correlation.
  constexpr double kMost = 0.8;
  return right - left < half_width || !(xy * xy < kMost * xx * yy);
}

}  // namespace

double least_along_view(const WarpInput& input, const PlaneError& error) noexcept {
  const double length = input.y_max - input.y_min;
  if (input.objective == Objective::p95 || !(length > 0.0) || error.corners().count == 0) return 0.0;
  double half_width = 0.0;
  for (std::size_t i = 0; i < error.body().points; ++i)
    half_width = max_of(half_width, std::abs(error.body().x[i] - input.centre));
  // The lean of texels aside of the middle goes by the width: of a wider body by strengths below those tried.
  constexpr double kMostWidths = 4.0;
  if (!(half_width > 0.0) || half_width > kMostWidths * length || may_vanish(error.body(), half_width))
    return 0.0;
  double scale = 0.0;
  const Corners corners = corners_of(input, error, half_width, length, scale);
  const bool storage = input.objective == Objective::storage;
  const auto across = static_cast<float>(half_width * half_width / (length * length));
  // Gains below this are rounding.
  constexpr float kSame = 1.0F - 1e-5F;
  Strengths square, reach;
  find_squares(corners, kAtOnce, storage, across, kReaches, square);
  const std::size_t coarse = first_of_least_lane(square, kSame);
  if (coarse + 1 == kAtOnce) return 0.0;
  float least = square[coarse];
  const float middle = coarse > 0 ? kReaches[coarse] : 0.5F * kReaches[1];
  for (std::size_t l = 0; l < kAtOnce; ++l) reach[l] = middle * kShares[l];
  find_squares(corners, kAtOnce, storage, across, reach, square);
  const float fine = square[first_of_least_lane(square, kSame)];
  least = fine < least ? fine : least;
  if (!(least < std::numeric_limits<float>::infinity())) return 0.0;
  const double root = std::sqrt(static_cast<double>(least));
  return storage ? root * half_width * length / scale : root * length / std::sqrt(scale);
}

}  // namespace gnomon
