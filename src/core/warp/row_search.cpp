// For a fall-off of the texels over the light plane: which two rows make the map with the least error at the
// body's corners? Based on: the error measure of Lloyd et al., "Warping and Partitioning for Low Error Shadow
// Maps", 2006. With J the Jacobian of the image (X, Y) by the pixel, rows a and b and lengths la and lb of
// the rectangle's sides, the squared extents of a texel in pixels are la^2 |b J|^2 and lb^2 |a J|^2 over (det
// J (a x b))^2: what is by the rows stands apart from what is by the fall-off.
#include "warp/row_search.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/elementary.hpp"
#include "geometry/vector.hpp"
#include "geometry/wide.hpp"

namespace gnomon {
namespace {

// Directions of a fan, and both fans together.
constexpr std::size_t kFan = 8, kBoth = 2 * kFan;
// Square of the sine at which rows lean too close together for a useful map.
constexpr double kLeastSine2 = 0.01;
// Gains below this are rounding: the first of two rows that mirror each other is taken.
constexpr double kTie = 1.0 - 1e-9;
// Shares of an extent below which another is rounding.
constexpr double kFlattest = 1e-6;
// Keeps a square away from zero, and changes no bit of one above 1e-14.
constexpr double kNothing = 1e-30;

/// Cosines and sines of multiples of an angle, from -(Count - 1) / 2 of it upwards.
template <std::size_t Count>
struct Turns {
  std::array<double, Count> cosine, sine;
  explicit constexpr Turns(double step) noexcept : cosine{}, sine{} {
    constexpr auto kSine = elementary::detail::inverse_factorials<12>(1, 2, -1.0);
    constexpr auto kCosine = elementary::detail::inverse_factorials<12>(0, 2, -1.0);
    for (std::size_t i = 0; i < Count; ++i) {
      const double angle = (static_cast<double>(i) - 0.5 * static_cast<double>(Count - 1)) * step;
      sine[i] = angle * elementary::detail::horner(kSine, angle * angle);
      cosine[i] = elementary::detail::horner(kCosine, angle * angle);
    }
  }
};

/// The directions of a fan, and the angles between those of two fans.
struct FanSteps {
  Turns<kFan> turn;
  Turns<kBoth - 1> between;
  explicit constexpr FanSteps(double step) noexcept : turn(step), between(step) {}
};
constexpr double kHalfTurn = 3.141592653589793;
// Two fans of a quarter turn each, and fans that reach the neighbours of what the first found.
constexpr double kRoundStep = kHalfTurn / kBoth, kNearStep = 2.0 * kRoundStep / (kFan - 1);
constexpr FanSteps kRoundFan(kRoundStep), kNearFan(kNearStep);

/// Kappa times length of a fall-off: nearly its exponential less 1, for four multiplications.
double reach_of(double fall_off) noexcept {
  // Beyond 1e9, where float matrices end.
  constexpr double kStrongest = 43.0;
  const double root = 1.0 + min_of(fall_off, kStrongest) * (1.0 / 16.0);
  const double power2 = root * root, power4 = power2 * power2, power8 = power4 * power4;
  return power8 * power8 - 1.0;
}
/// The fall-off whose w has this logarithm of its ratio from end to end.
double fall_off_of(double log_ratio) noexcept {
  return 16.0 * elementary::expm1(log_ratio * (1.0 / 16.0));
}

}  // namespace

/// Two fans: the first for row a, the second for row b.
struct RowSearch::Fan {
  alignas(64) std::array<double, kBoth> x, y;
  // Of the sine of the angle from a's direction i to b's j: at kFan - 1 + j - i.
  std::array<double, kBoth - 1> per_sine2, per_sine4;
  constexpr Fan(double ax, double ay, double bx, double by, const FanSteps& steps) noexcept
      : x{}, y{}, per_sine2{}, per_sine4{} {
    for (std::size_t i = 0; i < kFan; ++i) {
      const double c = steps.turn.cosine[i], s = steps.turn.sine[i];
      x[i] = ax * c - ay * s;
      y[i] = ax * s + ay * c;
      x[kFan + i] = bx * c - by * s;
      y[kFan + i] = bx * s + by * c;
    }
    const double cosine_ab = ax * bx + ay * by, sine_ab = ax * by - ay * bx;
    for (std::size_t i = 0; i < per_sine2.size(); ++i) {
      const double sine = sine_ab * steps.between.cosine[i] + cosine_ab * steps.between.sine[i];
      // A sum, not a choice: compilers divide first and choose then.
      per_sine2[i] = min_of(1.0 / (sine * sine + kNothing), 1.0 / kLeastSine2);
      per_sine4[i] = per_sine2[i] * per_sine2[i];
    }
  }
};

RowSearch::RowSearch(const WarpInput& input, const PlaneError& error) noexcept
    : lanes_(kWarpLanes),
      directions_(kBoth),
      corners_(error.corners()),
      body_(error.body()),
      objective_(input.objective),
      // Less what rounding adds.
      most_reach_((input.most_stretch - 1.0) * (1.0 - 1e-9)),
      pivot_(input.centre, input.light.perspective ? input.y_min : 0.0) {
  const LaneRange x = lane_range(body_.x.data(), body_.count, lanes_),
                  y = lane_range(body_.y.data(), body_.count, lanes_);
  middle_ = {0.5 * (x.low + x.high), 0.5 * (y.low + y.high)};
  // A body that is flat in the light plane has no direction along which it is thinner than this.
  const double longer = max_of(x.high - x.low, y.high - y.low);
  const double least = longer > 0.0 ? kFlattest * longer : 1.0;
  extent_ = {max_of(x.high - x.low, least), max_of(y.high - y.low, least)};
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < body_.count; ++i) {
    const double px = body_.x[i] - middle_.x, py = body_.y[i] - middle_.y;
    xx += px * px;
    xy += px * py;
    yy += py * py;
  }
  // Squared: narrower than a millionth of its length.
  constexpr double kLine = 1e-12;
  line_ = !(xx * yy - xy * xy > kLine * (xx + yy) * (xx + yy));
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
  for (const WarpInput::Point& p : input.body) {
    if (!std::isfinite(p.depth)) continue;
    nearest = min_of(nearest, p.depth);
    farthest = max_of(farthest, p.depth);
  }
  depth_range_ = nearest > 0.0 && farthest > nearest ? elementary::log(farthest / nearest) : 0.0;
}

RowSearch::Axis RowSearch::axis_of(const FallOff& fall_off) noexcept {
  Axis result{};
  const double reach =
      min_of(reach_of(std::sqrt(fall_off.x * fall_off.x + fall_off.y * fall_off.y)), most_reach_);
  const glm::dvec2 slope{fall_off.x / extent_.x, fall_off.y / extent_.y};
  const double steepness = std::sqrt(glm::dot(slope, slope));
  result.axis = steepness > 0.0 ? slope / steepness : glm::dvec2(0.0, 1.0);
  for (std::size_t i = 0; i < body_.count; ++i)
    image_x_[i] = body_.x[i] * result.axis.x + body_.y[i] * result.axis.y;
  const LaneRange u = lane_range(image_x_.data(), body_.count, lanes_);
  result.u_min = u.low;
  const double length = u.high - u.low;
  result.kappa = length > 0.0 ? reach / length : 0.0;
  result.stretch = 1.0 + result.kappa * length;
  result.centre = pivot_.x * result.axis.y - pivot_.y * result.axis.x;
  return result;
}

GNOMON_WIDE void RowSearch::find_image(const Axis& axis, RowChoice& rows) noexcept {
  const double axis_x = axis.axis.x, axis_y = axis.axis.y, kappa = axis.kappa, u_min = axis.u_min;
  const double stretch = axis.stretch, centre = axis.centre;
  const std::size_t n = body_.count;
  for (std::size_t i = 0; i < n; ++i) {
    const double u = body_.x[i] * axis_x + body_.y[i] * axis_y - u_min;
    const double inverse = 1.0 / (1.0 + kappa * u);
    image_x_[i] = (body_.x[i] * axis_y - body_.y[i] * axis_x - centre) * inverse;
    image_y_[i] = u * stretch * inverse;
  }
  const LaneRange x = lane_range(image_x_.data(), n, lanes_), y = lane_range(image_y_.data(), n, lanes_);
  const double longer = max_of(x.high - x.low, y.high - y.low);
  const double least = longer > 0.0 ? kFlattest * longer : 1.0;
  rows.image = {max_of(x.high - x.low, least), max_of(y.high - y.low, least)};
  const double scale_x = 1.0 / rows.image.x, scale_y = 1.0 / rows.image.y;
  for (std::size_t i = 0; i < n; ++i) {
    image_x_[i] = (image_x_[i] - x.low) * scale_x;
    image_y_[i] *= scale_y;
  }
}

GNOMON_WIDE void RowSearch::find_pixels(const Axis& axis, const glm::dvec2& image) noexcept {
  const double axis_x = axis.axis.x, axis_y = axis.axis.y, kappa = axis.kappa, u_min = axis.u_min;
  const double centre = axis.centre, scale_x = 1.0 / image.x, scale_y = axis.stretch / image.y;
  const double area = image.x * image.y / axis.stretch;
  const std::size_t n = whole_lanes(corners_.count);
  for (std::size_t i = 0; i < n; ++i) {
    const double u = corners_.x[i] * axis_x + corners_.y[i] * axis_y - u_min;
    const double s = corners_.x[i] * axis_y - corners_.y[i] * axis_x - centre;
    const double w = 1.0 + kappa * u, inverse = 1.0 / w, lean = kappa * s * inverse;
    const double sx = corners_.xx[i] * axis_y - corners_.yx[i] * axis_x;
    const double sy = corners_.xy[i] * axis_y - corners_.yy[i] * axis_x;
    const double ux = corners_.xx[i] * axis_x + corners_.yx[i] * axis_y;
    const double uy = corners_.xy[i] * axis_x + corners_.yy[i] * axis_y;
    const double across = inverse * scale_x, along = inverse * inverse * scale_y;
    const double xx = (sx - lean * ux) * across, xy = (sy - lean * uy) * across;
    const double yx = ux * along, yy = uy * along;
    const double inverse_determinant = std::abs(w * w * w * area * corners_.inverse_determinant[i]);
    const double square = inverse_determinant * inverse_determinant;
    xx_[i] = (xx * xx + xy * xy) * square;
    xy_[i] = 2.0 * (xx * yx + xy * yy) * square;
    yy_[i] = (yx * yx + yy * yy) * square;
    area_[i] = inverse_determinant;
  }
}

/// Squared lengths of the rectangle's sides across each direction of both fans.
GNOMON_WIDE void RowSearch::find_sides(const Fan& fan) noexcept {
  const std::size_t directions = directions_, n = body_.count;
  alignas(64) std::array<double, kBoth> low, high;
  for (std::size_t d = 0; d < directions; ++d)
    low[d] = high[d] = fan.x[d] * image_x_[0] + fan.y[d] * image_y_[0];
  // Four at a time, as each round waits for the one before it.
  for (std::size_t i = 0; i < n; i += 4) {
    const double x0 = image_x_[i], x1 = image_x_[i + 1], x2 = image_x_[i + 2], x3 = image_x_[i + 3];
    const double y0 = image_y_[i], y1 = image_y_[i + 1], y2 = image_y_[i + 2], y3 = image_y_[i + 3];
    for (std::size_t d = 0; d < directions; ++d) {
      const double x = fan.x[d], y = fan.y[d];
      const double v0 = x * x0 + y * y0, v1 = x * x1 + y * y1, v2 = x * x2 + y * y2, v3 = x * x3 + y * y3;
      low[d] = min_of(low[d], min_of(min_of(v0, v1), min_of(v2, v3)));
      high[d] = max_of(high[d], max_of(max_of(v0, v1), max_of(v2, v3)));
    }
  }
  for (std::size_t d = 0; d < directions; ++d) side_[d] = (high[d] - low[d]) * (high[d] - low[d]);
}

GNOMON_WIDE void RowSearch::best_by_storage(const Fan& fan, RowChoice& rows) noexcept {
  const std::size_t directions = directions_, half = directions_ / 2, n = whole_lanes(corners_.count);
  alignas(64) std::array<double, kBoth> xx, xy, yy, most{};
  for (std::size_t d = 0; d < directions; ++d) {
    xx[d] = fan.x[d] * fan.x[d];
    xy[d] = fan.x[d] * fan.y[d];
    yy[d] = fan.y[d] * fan.y[d];
  }
  for (std::size_t i = 0; i < n; i += 4) {
    const double xx0 = xx_[i], xx1 = xx_[i + 1], xx2 = xx_[i + 2], xx3 = xx_[i + 3];
    const double xy0 = xy_[i], xy1 = xy_[i + 1], xy2 = xy_[i + 2], xy3 = xy_[i + 3];
    const double yy0 = yy_[i], yy1 = yy_[i + 1], yy2 = yy_[i + 2], yy3 = yy_[i + 3];
    for (std::size_t d = 0; d < directions; ++d) {
      const double v0 = xx[d] * xx0 + xy[d] * xy0 + yy[d] * yy0, v1 = xx[d] * xx1 + xy[d] * xy1 + yy[d] * yy1;
      const double v2 = xx[d] * xx2 + xy[d] * xy2 + yy[d] * yy2, v3 = xx[d] * xx3 + xy[d] * xy3 + yy[d] * yy3;
      most[d] = max_of(most[d], max_of(max_of(v0, v1), max_of(v2, v3)));
    }
  }
  for (std::size_t d = 0; d < directions; ++d) most[d] *= side_[d];
  // Of the pairs with each second row: the least, and which first row it has.
  alignas(64) std::array<double, kFan> least, at;
  for (std::size_t b = 0; b < half; ++b) {
    least[b] = std::numeric_limits<double>::infinity();
    at[b] = 0.0;
  }
  for (std::size_t a = 0; a < kFan; ++a) {
    const double first = most[a], index = static_cast<double>(a);
    const double* const per_sine = fan.per_sine4.data() + kFan - 1 - a;
    for (std::size_t b = 0; b < half; ++b) {
      const double v = first * most[kFan + b] * per_sine[b];
      const double enough = least[b] * kTie;
      at[b] = v < enough ? index : at[b];
      least[b] = v < enough ? v : least[b];
    }
  }
  std::size_t b = 0;
  for (std::size_t l = 1; l < kFan; ++l) b = least[l] < least[b] * kTie ? l : b;
  write_rows(fan, static_cast<std::size_t>(at[b]), b, least[b], rows);
}

// The larger squared extent is half + root(half^2 - area^2). Below a value v it is where half < v and
// 2 v half < v^2 + area^2: no root for the many pairs that are worse than the best so far.
GNOMON_WIDE void RowSearch::best_by_worst(const Fan& fan, RowChoice& rows) noexcept {
  const std::size_t directions = directions_, fan_size = directions_ / 2, n = whole_lanes(corners_.count);
  alignas(64) std::array<double, PlaneError::kMaxCorners * kBoth> extent;
  alignas(64) std::array<double, kBoth> xx, xy, yy;
  for (std::size_t d = 0; d < directions; ++d) {
    xx[d] = fan.x[d] * fan.x[d];
    xy[d] = fan.x[d] * fan.y[d];
    yy[d] = fan.y[d] * fan.y[d];
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double at_xx = xx_[i], at_xy = xy_[i], at_yy = yy_[i];
    double* const at = extent.data() + i * kBoth;
    for (std::size_t d = 0; d < directions; ++d) at[d] = xx[d] * at_xx + xy[d] * at_xy + yy[d] * at_yy;
  }
  double best = std::numeric_limits<double>::infinity();
  std::size_t best_a = 0, best_b = 0;
  // The middle first: where a walk goes on from, it is likely to stay the best.
  for (const std::size_t a : {kFan / 2, kFan / 2 - 1, kFan / 2 + 1, kFan / 2 - 2, kFan / 2 + 2, kFan / 2 - 3,
                              kFan / 2 + 3, std::size_t{0}}) {
    const double* const per_sine = fan.per_sine2.data() + kFan - 1 - a;
    alignas(64) std::array<double, kFan> by_a, by_b, texel, most, room;
    for (std::size_t b = 0; b < fan_size; ++b) {
      by_a[b] = 0.5 * side_[a] * per_sine[b];
      by_b[b] = 0.5 * side_[kFan + b] * per_sine[b];
      texel[b] = side_[a] * side_[kFan + b] * per_sine[b];
      most[b] = 0.0;
      room[b] = best;
    }
    if (best < std::numeric_limits<double>::infinity()) {
      const double square = best * best, twice = 2.0 * best;
      for (std::size_t i = 0; i < n; i += 2) {
        const double* const at = extent.data() + i * kBoth;
        const double a0 = at[a], a1 = at[kBoth + a], area0 = area_[i] * area_[i];
        const double area1 = area_[i + 1] * area_[i + 1];
        for (std::size_t b = 0; b < fan_size; ++b) {
          const double half0 = by_a[b] * at[kFan + b] + by_b[b] * a0;
          const double half1 = by_a[b] * at[kBoth + kFan + b] + by_b[b] * a1;
          const double straight = min_of(best - half0, best - half1);
          const double curved = min_of((square + texel[b] * area0) - twice * half0,
                                       (square + texel[b] * area1) - twice * half1);
          room[b] = min_of(room[b], min_of(straight, curved));
        }
      }
      double widest = room[0];
      for (std::size_t b = 1; b < kFan; ++b) widest = max_of(widest, room[b]);
      if (!(widest > 0.0)) continue;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double* const at = extent.data() + i * kBoth;
      const double at_a = at[a], area = area_[i] * area_[i];
      for (std::size_t b = 0; b < fan_size; ++b) {
        const double half = by_a[b] * at[kFan + b] + by_b[b] * at_a;
        const double spread = half * half - texel[b] * area;
        most[b] = max_of(most[b], half + std::sqrt(max_of(spread, 0.0)));
      }
    }
    for (std::size_t b = 0; b < kFan; ++b) {
      if (!(most[b] < best * kTie)) continue;
      best = most[b];
      best_a = a;
      best_b = b;
    }
  }
  write_rows(fan, best_a, best_b, best, rows);
}

// The squared extents of a texel together: at most twice the larger one, and cheaper by its root. Good enough
// where the corners only hint at the objective.
GNOMON_WIDE void RowSearch::best_by_sum(const Fan& fan, RowChoice& rows) noexcept {
  const std::size_t directions = directions_, fan_size = directions_ / 2, n = corners_.count;
  alignas(64) std::array<double, kBoth> xx, xy, yy, extent;
  for (std::size_t d = 0; d < directions; ++d) {
    xx[d] = fan.x[d] * fan.x[d];
    xy[d] = fan.x[d] * fan.y[d];
    yy[d] = fan.y[d] * fan.y[d];
  }
  alignas(64) std::array<double, kFan * kFan> most{};
  for (std::size_t i = 0; i < n; ++i) {
    const double at_xx = xx_[i], at_xy = xy_[i], at_yy = yy_[i];
    for (std::size_t d = 0; d < directions; ++d) extent[d] = xx[d] * at_xx + xy[d] * at_xy + yy[d] * at_yy;
    for (std::size_t a = 0; a < kFan; ++a) {
      const double side_a = side_[a], extent_a = extent[a];
      double* const most_a = most.data() + a * kFan;
      for (std::size_t b = 0; b < fan_size; ++b)
        most_a[b] = max_of(most_a[b], side_a * extent[kFan + b] + side_[kFan + b] * extent_a);
    }
  }
  double best = std::numeric_limits<double>::infinity();
  std::size_t best_a = 0, best_b = 0;
  for (std::size_t a = 0; a < kFan; ++a) {
    const double* const per_sine = fan.per_sine2.data() + kFan - 1 - a;
    for (std::size_t b = 0; b < kFan; ++b) {
      const double v = most[a * kFan + b] * per_sine[b];
      if (!(v < best * kTie)) continue;
      best = v;
      best_a = a;
      best_b = b;
    }
  }
  write_rows(fan, best_a, best_b, best, rows);
}

void RowSearch::write_rows(const Fan& fan, std::size_t a, std::size_t b, double squared,
                           RowChoice& rows) const noexcept {
  rows.row_a = {fan.x[a], fan.y[a]};
  rows.row_b = {fan.x[kFan + b], fan.y[kFan + b]};
  rows.value = std::sqrt(squared);
}

RowChoice RowSearch::best(const FallOff& fall_off, const Fan& fan) noexcept {
  RowChoice rows;
  rows.fall_off = fall_off;
  const Axis axis = axis_of(fall_off);
  find_image(axis, rows);
  find_pixels(axis, rows.image);
  find_sides(fan);
  if (objective_ == Objective::storage) {
    best_by_storage(fan, rows);
  } else if (objective_ == Objective::max) {
    best_by_worst(fan, rows);
  } else {
    best_by_sum(fan, rows);
  }
  // Numbers that are none lose every comparison.
  if (!(rows.value < std::numeric_limits<double>::infinity()))
    rows.value = std::numeric_limits<double>::infinity();
  return rows;
}

RowChoice RowSearch::round(const FallOff& fall_off) noexcept {
  // The first quadrant and the second, less half a step.
  constexpr double kMiddle = 0.5 * (kFan - 1) * kRoundStep;
  static constexpr Turns<2> kFirst(2.0 * kMiddle);
  static constexpr Fan kFans(kFirst.cosine[1], kFirst.sine[1], -kFirst.sine[1], kFirst.cosine[1], kRoundFan);
  return best(fall_off, kFans);
}

RowChoice RowSearch::near(const FallOff& fall_off, const RowChoice& rows) noexcept {
  return best(fall_off, Fan(rows.row_a.x, rows.row_a.y, rows.row_b.x, rows.row_b.y, kNearFan));
}

WarpChoice RowSearch::choice(const RowChoice& rows) noexcept {
  const Axis axis = axis_of(rows.fall_off);
  WarpChoice result;
  result.kappa = axis.kappa;
  result.axis = axis.axis;
  result.centre = axis.centre;
  const auto row = [&](const glm::dvec2& v) {
    const glm::dvec2 whole{v.x / rows.image.x, v.y / rows.image.y};
    return whole / std::sqrt(glm::dot(whole, whole));
  };
  result.row_a = row(rows.row_a);
  result.row_b = row(rows.row_b);
  return result;
}

RowChoice RowSearch::rows_of(const WarpChoice& choice) noexcept {
  double u_min = std::numeric_limits<double>::infinity(), u_max = -u_min;
  for (std::size_t i = 0; i < body_.count; ++i) {
    const double u = body_.x[i] * choice.axis.x + body_.y[i] * choice.axis.y;
    u_min = min_of(u_min, u);
    u_max = max_of(u_max, u);
  }
  const double reach = choice.kappa * (u_max - u_min);
  RowChoice rows;
  const glm::dvec2 grown = choice.axis * extent_;
  const glm::dvec2 way = grown * (fall_off_of(elementary::log1p(reach)) / std::sqrt(glm::dot(grown, grown)));
  rows.fall_off = {way.x, way.y};
  // Another centre shears the image: 1 / w is linear in its Y.
  const Axis axis = axis_of(rows.fall_off);
  const double shear = (choice.centre - axis.centre) * choice.kappa / (1.0 + reach);
  find_image(axis, rows);
  const auto row = [&](const glm::dvec2& v) {
    const glm::dvec2 scaled{v.x * rows.image.x, (v.y + v.x * shear) * rows.image.y};
    const double length = std::sqrt(glm::dot(scaled, scaled));
    return length > 0.0 ? scaled / length : glm::dvec2(1.0, 0.0);
  };
  rows.row_a = row(choice.row_a);
  rows.row_b = row(choice.row_b);
  return rows;
}

FallOff RowSearch::ahead(double share) const noexcept {
  return {0.0, fall_off_of(share * depth_range_)};
}

FallOff RowSearch::fitted() const noexcept {
  // Least squares of 1, x, y over the body's unit square, relative to the side of a pixel's square.
  std::array<std::array<double, 4>, 3> m{};
  const auto at = [&](double x, double y) {
    return glm::dvec2((x - middle_.x) / extent_.x, (y - middle_.y) / extent_.y);
  };
  for (std::size_t i = 0; i < corners_.count; ++i) {
    // Near enough to the third root, and roots of roots come cheap.
    const double fourth = std::sqrt(std::sqrt(std::abs(corners_.inverse_determinant[i])));
    const double inverse = fourth * std::sqrt(std::sqrt(fourth));
    const glm::dvec2 p = at(corners_.x[i], corners_.y[i]);
    const std::array<double, 3> row{inverse, p.x * inverse, p.y * inverse};
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = j; k < 3; ++k) m[j][k] += row[j] * row[k];
      m[j][3] += row[j];
    }
  }
  // Flat bodies leave a row undetermined.
  constexpr double kRidge = 1e-6;
  for (std::size_t j = 1; j < 3; ++j) m[j][j] += kRidge * m[0][0];
  const double ab = m[0][1] / m[0][0], ac = m[0][2] / m[0][0];
  const double bb = m[1][1] - ab * m[0][1], bc = m[1][2] - ab * m[0][2], b = m[1][3] - ab * m[0][3];
  const double cc = m[2][2] - ac * m[0][2], c = m[2][3] - ac * m[0][3];
  const double rest = cc - bc / bb * bc;
  const double y = (c - bc / bb * b) / rest, x = (b - bc * y) / bb;
  const double constant = (m[0][3] - m[0][1] * x - m[0][2] * y) / m[0][0];
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (std::size_t i = 0; i < body_.count; ++i) {
    const glm::dvec2 p = at(body_.x[i], body_.y[i]);
    low = min_of(low, constant + x * p.x + y * p.y);
    high = max_of(high, constant + x * p.x + y * p.y);
  }
  const double length = std::sqrt(x * x + y * y);
  if (!(length > 0.0 && std::isfinite(length))) return {};
  const double ratio = low > 0.0 ? min_of(elementary::log(high / low), depth_range_) : depth_range_;
  const double scale = fall_off_of(ratio) / length;
  return {x * scale, y * scale};
}

}  // namespace gnomon
