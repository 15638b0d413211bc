// Which of several maps of the light plane, side by side, have an error below a value?
// Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006, as a Jacobian.
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/vector.hpp"
#include "lanes/wide.hpp"
#include "warp/plane_error.hpp"

namespace gnomon {

void ChoiceLanes::set(std::size_t lane, const WarpChoice& choice) noexcept {
  axis_x[lane] = choice.axis.x;
  axis_y[lane] = choice.axis.y;
  kappa[lane] = choice.kappa;
  centre[lane] = choice.centre;
  a_x[lane] = choice.row_a.x;
  a_y[lane] = choice.row_a.y;
  b_x[lane] = choice.row_b.x;
  b_y[lane] = choice.row_b.y;
}

/// A map for each choice: its w, linear over the light plane, and the gradients of its coordinates A and B
/// times w^2, which are (turn y + x, y - turn x); scaled so that a texel's extents need no other factor.
struct PlaneError::MapLanes {
  alignas(64) DoubleLanes a_turn, a_x, a_y, b_turn, b_x, b_y, w_x, w_y, w_1;
  alignas(64) DoubleLanes area;   // of the rectangle's cell in the light plane where w is 1
  alignas(64) DoubleLanes known;  // 1; 0 where no map can be made with the choice
};

/// Of the body: along each choice's axis, and along both of its rows in the image.
struct PlaneError::ExtentLanes {
  alignas(64) DoubleLanes u_min, u_max, stretch, a_min, a_max, b_min, b_max;
};

GNOMON_WIDE void PlaneError::find_extents(const ChoiceLanes& c, ExtentLanes& extents) const noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::size_t lanes = lanes_;
  auto& [u_min, u_max, stretch, a_min, a_max, b_min, b_max] = extents;
  for (std::size_t l = 0; l < lanes; ++l) {
    u_min[l] = a_min[l] = b_min[l] = kInfinity;
    u_max[l] = a_max[l] = b_max[l] = -kInfinity;
  }
  for (std::size_t i = 0; i < body_.points; ++i) {
    const double x = body_.x[i], y = body_.y[i];
    for (std::size_t l = 0; l < lanes; ++l) {
      const double u = x * c.axis_x[l] + y * c.axis_y[l];
      u_min[l] = min_of(u_min[l], u);
      u_max[l] = max_of(u_max[l], u);
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) stretch[l] = 1.0 + c.kappa[l] * (u_max[l] - u_min[l]);
  for (std::size_t i = 0; i < body_.points; ++i) {
    const double x = body_.x[i], y = body_.y[i];
    for (std::size_t l = 0; l < lanes; ++l) {
      const double u = x * c.axis_x[l] + y * c.axis_y[l] - u_min[l];
      const double s = x * c.axis_y[l] - y * c.axis_x[l] - c.centre[l];
      const double inverse = 1.0 / (1.0 + c.kappa[l] * u), v = u * stretch[l];
      const double a = (c.a_x[l] * s + c.a_y[l] * v) * inverse, b = (c.b_x[l] * s + c.b_y[l] * v) * inverse;
      a_min[l] = min_of(a_min[l], a);
      a_max[l] = max_of(a_max[l], a);
      b_min[l] = min_of(b_min[l], b);
      b_max[l] = max_of(b_max[l], b);
    }
  }
}

GNOMON_WIDE void PlaneError::fit(const ChoiceLanes& choices, const ExtentLanes& extents,
                                 MapLanes& map) const noexcept {
  const std::size_t lanes = lanes_;
  // Copies, which the compiler knows that nothing below writes to.
  const ChoiceLanes c = choices;
  const ExtentLanes of = extents;
  const double distance = distance_, height = height_range_, least_of_all = least_extent(0.0, distance_),
               farthest = farthest_;
  const double most_stretch = input_.most_stretch;
  const double warped_known = complete_ ? 1.0 : 0.0;
  for (std::size_t l = 0; l < lanes; ++l) {
    const double a = of.a_max[l] - of.a_min[l], b = of.b_max[l] - of.b_min[l], extent = max_of(a, b);
    // As least_extent and usable have it.
    const double least = max_of(1e-6 * max_of(extent, height), least_of_all);
    const double side_a = divisor(a, least), side_b = divisor(b, least);
    const double turn = c.a_x[l] * c.b_y[l] - c.a_y[l] * c.b_x[l];
    const double length = of.u_max[l] - of.u_min[l];
    const double shortest = max_of(1e-6 * max_of(side_a, side_b), 1e-9 * farthest);
    const double warped =
        length > shortest && of.stretch[l] <= most_stretch && turn != 0.0 ? warped_known : 0.0;
    const double kept = c.kappa[l] * distance <= kMaxKappaDistance ? warped : 0.0;
    map.known[l] = c.kappa[l] == 0.0 ? 1.0 : kept;
    // The determinant of the map's Jacobian is stretch turn / (side_a side_b w^3). Rows come out multiplied
    // with the area of a cell, and so as extents of texels.
    const double area = side_a * side_b / of.stretch[l] * inverse_or_0(turn), scale_a = area / side_a,
                 scale_b = area / side_b;
    const double ax = c.axis_x[l], ay = c.axis_y[l];
    // Of one that is not usable w might be 0 at a sample.
    const double kappa = map.known[l] != 0.0 ? c.kappa[l] : 0.0;
    const double along_a = c.a_y[l] * of.stretch[l], along_b = c.b_y[l] * of.stretch[l];
    const double w_x = kappa * ax, w_y = kappa * ay, w_1 = 1.0 - kappa * of.u_min[l];
    const double a_x = (c.a_x[l] * ay + along_a * ax) * scale_a,
                 a_y = (along_a * ay - c.a_x[l] * ax) * scale_a;
    const double a_1 = -(c.a_x[l] * c.centre[l] + along_a * of.u_min[l]) * scale_a;
    const double b_x = (c.b_x[l] * ay + along_b * ax) * scale_b,
                 b_y = (along_b * ay - c.b_x[l] * ax) * scale_b;
    const double b_1 = -(c.b_x[l] * c.centre[l] + along_b * of.u_min[l]) * scale_b;
    map.a_turn[l] = a_x * w_y - a_y * w_x;
    map.a_x[l] = a_x * w_1 - a_1 * w_x;
    map.a_y[l] = a_y * w_1 - a_1 * w_y;
    map.b_turn[l] = b_x * w_y - b_y * w_x;
    map.b_x[l] = b_x * w_1 - b_1 * w_x;
    map.b_y[l] = b_y * w_1 - b_1 * w_y;
    map.w_x[l] = w_x;
    map.w_y[l] = w_y;
    map.w_1[l] = w_1;
    map.area[l] = std::abs(area);
  }
}

// For one sample and choice: squared lengths of the rows of d(texel)/d(pixel) over its determinant. The
// gradient of A = S / w is (w grad S - S grad w) / w^2, whose numerator is linear over the plane, and the
// determinant goes by w^-3: no sample takes a division.
#define GNOMON_ROWS                                                                        \
  const double w = map.w_x[l] * x + map.w_y[l] * y + map.w_1[l];                           \
  const double a_x = map.a_turn[l] * y + map.a_x[l], a_y = map.a_y[l] - map.a_turn[l] * x; \
  const double b_x = map.b_turn[l] * y + map.b_x[l], b_y = map.b_y[l] - map.b_turn[l] * x; \
  const double ax = a_x * xx + a_y * yx, ay = a_x * xy + a_y * yy;                         \
  const double bx = b_x * xx + b_y * yx, by = b_x * xy + b_y * yy;                         \
  const double f = w * id, f2 = f * f;                                                     \
  const double row_a = (ax * ax + ay * ay) * f2, row_b = (bx * bx + by * by) * f2

GNOMON_WIDE void PlaneError::find_storage(const MapLanes& map, DoubleLanes& value) const noexcept {
  const std::size_t lanes = lanes_, n = sample_.count;
  alignas(64) DoubleLanes most_a{}, most_b{};
  for (std::size_t i = 0; i < n; ++i) {
    const double x = sample_.x[i], y = sample_.y[i], xx = sample_.xx[i], xy = sample_.xy[i];
    const double yx = sample_.yx[i], yy = sample_.yy[i], id = sample_.inverse_determinant[i];
    for (std::size_t l = 0; l < lanes; ++l) {
      GNOMON_ROWS;
      most_a[l] = max_of(most_a[l], row_a);
      most_b[l] = max_of(most_b[l], row_b);
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) value[l] = most_a[l] * most_b[l];
}

GNOMON_WIDE void PlaneError::find_mean(const MapLanes& map, DoubleLanes& value) const noexcept {
  const std::size_t lanes = lanes_, n = sample_.count;
  alignas(64) DoubleLanes sum{};
  for (std::size_t i = 0; i < n; ++i) {
    const double x = sample_.x[i], y = sample_.y[i], xx = sample_.xx[i], xy = sample_.xy[i];
    const double yx = sample_.yx[i], yy = sample_.yy[i], id = sample_.inverse_determinant[i];
    for (std::size_t l = 0; l < lanes; ++l) {
      GNOMON_ROWS;
      sum[l] += std::sqrt(0.5 * (row_a + row_b));
    }
  }
  const double share = n > 0 ? 1.0 / static_cast<double>(n) : 0.0;
  for (std::size_t l = 0; l < lanes; ++l) value[l] = sum[l] * share;
}

// A texel's squares are the roots of x^2 - 2 half x + area^2, half the sum of both squared extents and the
// product of both: the larger one is above `square` where half is, or where the quadratic is negative there.
GNOMON_WIDE void PlaneError::count_above(const MapLanes& map, double square,
                                         DoubleLanes& count) const noexcept {
  const std::size_t lanes = lanes_, n = sample_.count;
  const double inverse = inverse_or_0(square), enough = static_cast<double>(above_) + 0.5;
  alignas(64) DoubleLanes above;
  for (std::size_t l = 0; l < lanes; ++l) above[l] = map.known[l] != 0.0 ? 0.0 : enough + 0.5;
  // Asked now and then whether all have enough.
  constexpr std::size_t kBetween = 16;
  for (std::size_t begin = 0; begin < n; begin += kBetween) {
    const std::size_t end = begin + kBetween < n ? begin + kBetween : n;
    for (std::size_t i = begin; i < end; ++i) {
      const double x = sample_.x[i], y = sample_.y[i], xx = sample_.xx[i], xy = sample_.xy[i];
      const double yx = sample_.yx[i], yy = sample_.yy[i], id = sample_.inverse_determinant[i];
      for (std::size_t l = 0; l < lanes; ++l) {
        GNOMON_ROWS;
        const double twice = row_a + row_b, area = f * w * w * map.area[l];
        const double beyond = max_of(0.5 * twice - square, (twice - square) - area * (area * inverse));
        // What is no number counts as nothing.
        above[l] += beyond >= 0.0 ? 1.0 : 0.0;
      }
    }
    double least = above[0];
    for (std::size_t l = 1; l < lanes; ++l) least = min_of(least, above[l]);
    if (least > enough) break;
  }
  for (std::size_t l = 0; l < lanes; ++l) count[l] = above[l];
}
#undef GNOMON_ROWS

void PlaneError::below(const ChoiceLanes& choices, double value, LaneAnswers& is_below) noexcept {
  is_below.fill(false);
  const double square = value * value;
  if (sample_.count == 0 || body_.points == 0 || !(square > 0.0)) return;
  ExtentLanes extents;
  MapLanes map;
  find_extents(choices, extents);
  fit(choices, extents, map);
  DoubleLanes found;
  if (!(square < std::numeric_limits<double>::infinity())) {
    for (std::size_t l = 0; l < kDoubleLanes; ++l) is_below[l] = map.known[l] != 0.0;
  } else if (input_.objective == Objective::storage) {
    find_storage(map, found);
    for (std::size_t l = 0; l < kDoubleLanes; ++l)
      is_below[l] = map.known[l] != 0.0 && std::sqrt(found[l]) < value;
  } else if (mean_) {
    find_mean(map, found);
    for (std::size_t l = 0; l < kDoubleLanes; ++l) is_below[l] = map.known[l] != 0.0 && found[l] < value;
  } else {
    count_above(map, square, found);
    for (std::size_t l = 0; l < kDoubleLanes; ++l) is_below[l] = found[l] <= static_cast<double>(above_);
  }
}

}  // namespace gnomon
