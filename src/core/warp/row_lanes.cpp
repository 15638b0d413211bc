// Of each of sixteen fall-offs side by side: which two rows, of some near its own, make the best map?
// Based on: the error measure of Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006.
// With J the Jacobian of the image (X, Y) by the pixel, rows a and b and lengths la and lb of the rectangle's
// sides, the squared extents of a texel in pixels are la^2 |b J|^2 and lb^2 |a J|^2 over (det J (a x b))^2:
// what is by the rows stands apart from what is by the fall-off.
#include <cmath>
#include <limits>

#include "geometry/vector.hpp"
#include "lanes/wide.hpp"
#include "warp/row_search.hpp"

namespace gnomon {
namespace {

// Directions that are tried for each row.
constexpr std::size_t kFan = 4;
// Square of the sine at which rows lean too close together for a useful map.
constexpr float kLeastSine2 = 0.01F;
// Keep divisors away from zero, and products within single precision: what goes beyond is far from the best.
constexpr float kNothing = 1e-30F, kFar = 1e14F, kWidest = 1e7F;
// Beyond what bodies have, but where rounding alone makes them: w squared (kMaxReach), and gradients. Form
// and sides then stay below 1e38: (kSteepest 16)^2 kMostSquare 16, as samples are 16 extents off at most.
constexpr float kMostSquare = 1e9F, kSteepest = 1e12F;
// Growth of w over what points are counted in, at which w rounds by an eighth.
constexpr float kSteepestW = 1e6F;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

void RowLanes::set(std::size_t lane, const RowChoice& rows) noexcept {
  x[lane] = static_cast<float>(rows.fall_off.x);
  y[lane] = static_cast<float>(rows.fall_off.y);
  a_x[lane] = static_cast<float>(rows.row_a.x);
  a_y[lane] = static_cast<float>(rows.row_a.y);
  b_x[lane] = static_cast<float>(rows.row_b.x);
  b_y[lane] = static_cast<float>(rows.row_b.y);
}

void RowLanes::fill(const RowChoice& rows) noexcept {
  x.fill(static_cast<float>(rows.fall_off.x));
  y.fill(static_cast<float>(rows.fall_off.y));
  a_x.fill(static_cast<float>(rows.row_a.x));
  a_y.fill(static_cast<float>(rows.row_a.y));
  b_x.fill(static_cast<float>(rows.row_b.x));
  b_y.fill(static_cast<float>(rows.row_b.y));
}

std::size_t RowLanes::least() const noexcept {
  return first_of_least_lane(value, kSingleTie);
}

RowChoice RowLanes::at(std::size_t i) const noexcept {
  return {{x[i], y[i]}, {a_x[i], a_y[i]}, {b_x[i], b_y[i]}, value[i]};
}

/// The candidates' maps. w, and the numerators of X and Y, are linear over the samples' numbers.
struct RowSearch::Maps {
  static constexpr std::size_t kBoth = 2 * kFan;
  alignas(64) FloatLanes reach, u_min, u_max;
  alignas(64) FloatLanes u_x, u_y;       // along the axis
  alignas(64) FloatLanes s_x, s_y, s_1;  // across it
  alignas(64) FloatLanes w_x, w_y, w_1;
  alignas(64) FloatLanes x_low, x_high, y_low, y_high;  // of the image
  // The gradient of X times w^2 is (turn_x y + first_x, second_x - turn_x x), and Y's alike; then both over
  // the image's extents and times its area, so that they come out as extents of texels.
  alignas(64) FloatLanes turn_x, first_x, second_x, turn_y, first_y, second_y;
  alignas(64) FloatLanes area;  // of the image's rectangle, in the plane where w is 1
  // Directions of both rows, over the unit square and over X and Y, and squared lengths of the sides across.
  alignas(64) std::array<FloatLanes, kBoth> unit_x, unit_y, x, y, side;
  alignas(64) std::array<FloatLanes, kBoth> xx, xy, yy;  // of those over X and Y
  alignas(64) std::array<FloatLanes, kFan * kFan> pair;  // values
};

GNOMON_WIDE void RowSearch::find_axes(const RowLanes& candidates, Maps& maps) const noexcept {
  Maps& __restrict m = maps;
  const RowLanes& __restrict c = candidates;
  const std::size_t lanes = fall_offs_ & ~(kFloatLanes - 1);
  const std::size_t n = points_;
  const double unit = 1.0 / max_of(extent_.x, extent_.y);
  const auto extent_x = static_cast<float>(extent_.x * unit);
  const auto extent_y = static_cast<float>(extent_.y * unit);
  const auto x_1 = static_cast<float>((origin_.x - pivot_.x) * unit);
  const auto y_1 = static_cast<float>((origin_.y - pivot_.y) * unit);
  const auto most_reach = static_cast<float>(most_reach_);
  for (std::size_t l = 0; l < lanes; ++l) {
    const float length = std::sqrt(c.x[l] * c.x[l] + c.y[l] * c.y[l]);
    m.reach[l] = min_of(reach_of(length), most_reach);
    const float slope_x = c.x[l] * extent_y, slope_y = (length > 0.0F ? c.y[l] : 1.0F) * extent_x;
    const float inverse = 1.0F / std::sqrt(divisor(slope_x * slope_x + slope_y * slope_y, kNothing));
    const float axis_x = slope_x * inverse, axis_y = slope_y * inverse;
    m.u_x[l] = axis_x * extent_x;
    m.u_y[l] = axis_y * extent_y;
    m.s_x[l] = axis_y * extent_x;
    m.s_y[l] = -axis_x * extent_y;
    m.s_1[l] = x_1 * axis_y - y_1 * axis_x;
    m.u_min[l] = kInfinity;
    m.u_max[l] = -kInfinity;
  }
  for (std::size_t i = 0; i < n; i += 4) {
    const float x0 = point_x_[i], x1 = point_x_[i + 1], x2 = point_x_[i + 2], x3 = point_x_[i + 3];
    const float y0 = point_y_[i], y1 = point_y_[i + 1], y2 = point_y_[i + 2], y3 = point_y_[i + 3];
    for (std::size_t l = 0; l < lanes; ++l) {
      const float x = m.u_x[l], y = m.u_y[l];
      const float u0 = x * x0 + y * y0, u1 = x * x1 + y * y1, u2 = x * x2 + y * y2, u3 = x * x3 + y * y3;
      m.u_min[l] = min_of(m.u_min[l], min_of(min_of(u0, u1), min_of(u2, u3)));
      m.u_max[l] = max_of(m.u_max[l], max_of(max_of(u0, u1), max_of(u2, u3)));
    }
  }
  // Along an axis over which the body is narrower than its numbers round, a larger kappa would make w of
  // rounding alone, and could make it 0.
  float farthest = 1.0F;
  for (std::size_t i = 0; i < n; ++i)
    farthest = max_of(farthest, max_of(std::abs(point_x_[i]), std::abs(point_y_[i])));
  for (std::size_t l = 0; l < lanes; ++l) {
    const float most = kSteepestW / divisor((std::abs(m.u_x[l]) + std::abs(m.u_y[l])) * farthest, kNothing);
    const float kappa = min_of(m.reach[l] / divisor(m.u_max[l] - m.u_min[l], kNothing), most);
    m.w_x[l] = kappa * m.u_x[l];
    m.w_y[l] = kappa * m.u_y[l];
    m.w_1[l] = 1.0F - kappa * m.u_min[l];
  }
}

// The gradient of X = S / w is (w grad S - S grad w) / w^2: its numerator is linear over the plane, and each
// component over one coordinate alone. No sample takes a division.
GNOMON_WIDE void RowSearch::find_image(Maps& maps) const noexcept {
  Maps& __restrict m = maps;
  const std::size_t lanes = fall_offs_ & ~(kFloatLanes - 1);
  const std::size_t n = points_;
  for (std::size_t l = 0; l < lanes; ++l) {
    m.x_low[l] = m.y_low[l] = kInfinity;
    m.x_high[l] = m.y_high[l] = -kInfinity;
    m.turn_x[l] = m.s_x[l] * m.w_y[l] - m.s_y[l] * m.w_x[l];
    m.first_x[l] = m.s_x[l] * m.w_1[l] - m.s_1[l] * m.w_x[l];
    m.second_x[l] = m.s_y[l] * m.w_1[l] - m.s_1[l] * m.w_y[l];
    m.turn_y[l] = m.u_x[l] * m.w_y[l] - m.u_y[l] * m.w_x[l];
    m.first_y[l] = m.u_x[l] * m.w_1[l] + m.u_min[l] * m.w_x[l];
    m.second_y[l] = m.u_y[l] * m.w_1[l] + m.u_min[l] * m.w_y[l];
  }
  for (std::size_t i = 0; i < n; i += 2) {
    const float x0 = point_x_[i], x1 = point_x_[i + 1], y0 = point_y_[i], y1 = point_y_[i + 1];
    for (std::size_t l = 0; l < lanes; ++l) {
      const float inverse0 = 1.0F / (m.w_x[l] * x0 + m.w_y[l] * y0 + m.w_1[l]);
      const float inverse1 = 1.0F / (m.w_x[l] * x1 + m.w_y[l] * y1 + m.w_1[l]);
      const float s0 = (m.s_x[l] * x0 + m.s_y[l] * y0 + m.s_1[l]) * inverse0;
      const float s1 = (m.s_x[l] * x1 + m.s_y[l] * y1 + m.s_1[l]) * inverse1;
      const float u0 = (m.u_x[l] * x0 + m.u_y[l] * y0 - m.u_min[l]) * inverse0;
      const float u1 = (m.u_x[l] * x1 + m.u_y[l] * y1 - m.u_min[l]) * inverse1;
      m.x_low[l] = min_of(m.x_low[l], min_of(s0, s1));
      m.x_high[l] = max_of(m.x_high[l], max_of(s0, s1));
      m.y_low[l] = min_of(m.y_low[l], min_of(u0, u1));
      m.y_high[l] = max_of(m.y_high[l], max_of(u0, u1));
    }
  }
}

/// Directions round the candidates' rows, and gradients scaled to what texels of those rows take.
GNOMON_WIDE void RowSearch::find_directions(const RowLanes& candidates, float step,
                                            Maps& maps) const noexcept {
  Maps& __restrict m = maps;
  const RowLanes& __restrict c = candidates;
  constexpr std::size_t kBoth = 2 * kFan;
  const std::size_t lanes = fall_offs_ & ~(kFloatLanes - 1);
  for (std::size_t d = 0; d < kFan; ++d) {
    const Turn turn((static_cast<float>(d) - 0.5F * static_cast<float>(kFan - 1)) * step);
    for (std::size_t l = 0; l < lanes; ++l) {
      m.unit_x[d][l] = c.a_x[l] * turn.cosine - c.a_y[l] * turn.sine;
      m.unit_y[d][l] = c.a_x[l] * turn.sine + c.a_y[l] * turn.cosine;
      m.unit_x[kFan + d][l] = c.b_x[l] * turn.cosine - c.b_y[l] * turn.sine;
      m.unit_y[kFan + d][l] = c.b_x[l] * turn.sine + c.b_y[l] * turn.cosine;
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) {
    // Of a narrower image only rounding is left.
    constexpr float kNarrowest = 1e-6F;
    const float width = max_of(m.x_high[l] - m.x_low[l], kNarrowest * max_of(m.x_high[l], -m.x_low[l]));
    const float height = max_of(m.y_high[l] - m.y_low[l], kNarrowest * m.y_high[l]);
    const float scale_x = 1.0F / divisor(width, kNothing), scale_y = 1.0F / divisor(height, kNothing);
    const float area = std::abs(m.first_x[l] * m.second_y[l] - m.second_x[l] * m.first_y[l]) / m.w_1[l];
    const float per_area = 1.0F / divisor(area, kNothing);
    const float per_x = min_of(height * per_area, kWidest), per_y = min_of(width * per_area, kWidest);
    m.turn_x[l] = max_of(min_of(m.turn_x[l] * per_x, kSteepest), -kSteepest);
    m.first_x[l] = max_of(min_of(m.first_x[l] * per_x, kSteepest), -kSteepest);
    m.second_x[l] = max_of(min_of(m.second_x[l] * per_x, kSteepest), -kSteepest);
    m.turn_y[l] = max_of(min_of(m.turn_y[l] * per_y, kSteepest), -kSteepest);
    m.first_y[l] = max_of(min_of(m.first_y[l] * per_y, kSteepest), -kSteepest);
    m.second_y[l] = max_of(min_of(m.second_y[l] * per_y, kSteepest), -kSteepest);
    m.area[l] = per_x * width;
    for (std::size_t d = 0; d < kBoth; ++d) {
      m.x[d][l] = m.unit_x[d][l] * scale_x;
      m.y[d][l] = m.unit_y[d][l] * scale_y;
      m.xx[d][l] = m.unit_x[d][l] * m.unit_x[d][l];
      m.xy[d][l] = 2.0F * m.unit_x[d][l] * m.unit_y[d][l];
      m.yy[d][l] = m.unit_y[d][l] * m.unit_y[d][l];
    }
  }
}

/// Squared lengths of the rectangle's sides across each direction. The body's image is found again, four
/// points at a time: all of it would take 9 kB of stack.
GNOMON_WIDE void RowSearch::find_sides(Maps& maps) const noexcept {
  Maps& __restrict m = maps;
  constexpr std::size_t kBoth = 2 * kFan;
  const std::size_t lanes = fall_offs_ & ~(kFloatLanes - 1), n = points_;
  alignas(64) std::array<FloatLanes, kBoth> low, high;
  for (std::size_t d = 0; d < kBoth; ++d) {
    for (std::size_t l = 0; l < lanes; ++l) {
      low[d][l] = kInfinity;
      high[d][l] = -kInfinity;
    }
  }
  alignas(64) std::array<FloatLanes, 4> x, y;
  for (std::size_t i = 0; i < n; i += 4) {
    for (std::size_t k = 0; k < 4; ++k) {
      const float at_x = point_x_[i + k], at_y = point_y_[i + k];
      for (std::size_t l = 0; l < lanes; ++l) {
        const float inverse = 1.0F / (m.w_x[l] * at_x + m.w_y[l] * at_y + m.w_1[l]);
        x[k][l] = (m.s_x[l] * at_x + m.s_y[l] * at_y + m.s_1[l]) * inverse;
        y[k][l] = (m.u_x[l] * at_x + m.u_y[l] * at_y - m.u_min[l]) * inverse;
      }
    }
    for (std::size_t d = 0; d < kBoth; ++d) {
      for (std::size_t l = 0; l < lanes; ++l) {
        const float by_x = m.x[d][l], by_y = m.y[d][l];
        const float v0 = by_x * x[0][l] + by_y * y[0][l], v1 = by_x * x[1][l] + by_y * y[1][l];
        const float v2 = by_x * x[2][l] + by_y * y[2][l], v3 = by_x * x[3][l] + by_y * y[3][l];
        low[d][l] = min_of(low[d][l], min_of(min_of(v0, v1), min_of(v2, v3)));
        high[d][l] = max_of(high[d][l], max_of(max_of(v0, v1), max_of(v2, v3)));
      }
    }
  }
  for (std::size_t d = 0; d < kBoth; ++d) {
    for (std::size_t l = 0; l < lanes; ++l)
      m.side[d][l] = (high[d][l] - low[d][l]) * (high[d][l] - low[d][l]);
  }
}

// Macros write out what the loops over lanes do for each of a few directions: of arrays there, or of inner
// loops over them, compilers keep nothing in registers and vectorize no lane.

// For one sample and candidate: the form of a row's squared extent, of which the side across and the area are
// left out.
#define GNOMON_FORM(at, k)                                                                           \
  const float w##k = m.w_x[l] * at.x + m.w_y[l] * at.y + m.w_1[l];                                   \
  const float square##k = min_of(w##k * w##k, kMostSquare);                                          \
  const float ax##k = m.turn_x[l] * at.y + m.first_x[l], ay##k = m.second_x[l] - m.turn_x[l] * at.x; \
  const float bx##k = m.turn_y[l] * at.y + m.first_y[l], by##k = m.second_y[l] - m.turn_y[l] * at.x; \
  const float jx##k = ax##k * at.xx + ay##k * at.xy, jy##k = ax##k * at.xy + ay##k * at.yy;          \
  const float kx##k = bx##k * at.xx + by##k * at.xy, ky##k = bx##k * at.xy + by##k * at.yy;          \
  const float xx##k = (ax##k * jx##k + ay##k * jy##k) * square##k;                                   \
  const float xy##k = (bx##k * jx##k + by##k * jy##k) * square##k;                                   \
  const float yy##k = (bx##k * kx##k + by##k * ky##k) * square##k

GNOMON_WIDE void RowSearch::find_products(Maps& maps) const noexcept {
  Maps& __restrict m = maps;
  const std::size_t lanes = fall_offs_ & ~(kFloatLanes - 1);
  const std::size_t n = samples_;
  alignas(64) std::array<FloatLanes, 2 * kFan> most;
  for (std::size_t d = 0; d < 2 * kFan; ++d) {
    for (std::size_t l = 0; l < lanes; ++l) most[d][l] = 0.0F;
  }
  // Two at a time: half as many numbers of the candidates to fetch.
  for (std::size_t i = 0; i < n; i += 2) {
    const Form::Form f0 = form_.at(i), f1 = form_.at(i + 1);
    for (std::size_t l = 0; l < lanes; ++l) {
      GNOMON_FORM(f0, 0);
      GNOMON_FORM(f1, 1);
      for (std::size_t d = 0; d < 2 * kFan; ++d) {
        const float v0 = m.xx[d][l] * xx0 + m.xy[d][l] * xy0 + m.yy[d][l] * yy0;
        const float v1 = m.xx[d][l] * xx1 + m.xy[d][l] * xy1 + m.yy[d][l] * yy1;
        most[d][l] = max_of(most[d][l], max_of(v0, v1));
      }
    }
  }
  for (std::size_t a = 0; a < kFan; ++a) {
    for (std::size_t b = 0; b < kFan; ++b) {
      for (std::size_t l = 0; l < lanes; ++l) {
        m.pair[a * kFan + b][l] =
            min_of(m.side[a][l] * most[a][l], kFar) * min_of(m.side[kFan + b][l] * most[kFan + b][l], kFar);
      }
    }
  }
}

// The sum of the squares of both squared extents, of which each is a root of a quadratic: at most twice the
// larger square, and that without a root.
GNOMON_WIDE void RowSearch::find_sums(Maps& maps) const noexcept {
  Maps& __restrict m = maps;
  const std::size_t lanes = fall_offs_ & ~(kFloatLanes - 1), n = samples_;
  alignas(64) std::array<FloatLanes, kFan * kFan> product;
  for (std::size_t a = 0; a < kFan; ++a) {
    for (std::size_t b = 0; b < kFan; ++b) {
      for (std::size_t l = 0; l < lanes; ++l) {
        const float sine = m.unit_x[a][l] * m.unit_y[kFan + b][l] - m.unit_y[a][l] * m.unit_x[kFan + b][l];
        product[a * kFan + b][l] = 2.0F * m.side[a][l] * m.side[kFan + b][l] * (sine * sine);
        m.pair[a * kFan + b][l] = 0.0F;
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Form::Form at = form_.at(i);
    for (std::size_t l = 0; l < lanes; ++l) {
      GNOMON_FORM(at, 0);
      const float root = min_of(square0 * w0 * at.inverse * m.area[l], kFar), area = root * root;
#define GNOMON_EXTENT(d) \
  const float e##d = min_of(m.xx[d][l] * xx0 + m.xy[d][l] * xy0 + m.yy[d][l] * yy0, kFar)
      GNOMON_EXTENT(0);
      GNOMON_EXTENT(1);
      GNOMON_EXTENT(2);
      GNOMON_EXTENT(3);
      GNOMON_EXTENT(4);
      GNOMON_EXTENT(5);
      GNOMON_EXTENT(6);
      GNOMON_EXTENT(7);
#undef GNOMON_EXTENT
#define GNOMON_PAIR(a, b)                                        \
  {                                                              \
    const std::size_t k = (a)*kFan + (b)-kFan;                   \
    const float sum = m.side[a][l] * e##b + m.side[b][l] * e##a; \
    const float squares = sum * sum - product[k][l] * area;      \
    m.pair[k][l] = max_of(m.pair[k][l], squares);                \
  }
#define GNOMON_PAIRS(a) GNOMON_PAIR(a, 4) GNOMON_PAIR(a, 5) GNOMON_PAIR(a, 6) GNOMON_PAIR(a, 7)
      GNOMON_PAIRS(0)
      GNOMON_PAIRS(1)
      GNOMON_PAIRS(2)
      GNOMON_PAIRS(3)
#undef GNOMON_PAIRS
#undef GNOMON_PAIR
    }
  }
}

GNOMON_WIDE void RowSearch::find_rows(double step, RowLanes& candidates) noexcept {
  Maps m;
  RowLanes& __restrict c = candidates;
  find_axes(c, m);
  find_image(m);
  find_directions(c, static_cast<float>(step), m);
  find_sides(m);
  if (objective_ == Objective::storage) {
    find_products(m);
  } else {
    find_sums(m);
  }
  pick_rows(step, m, c);
}

/// The best pair of each candidate.
GNOMON_WIDE void RowSearch::pick_rows(double step, const Maps& maps, RowLanes& candidates) const noexcept {
  const Maps& __restrict m = maps;
  const RowLanes& __restrict c = candidates;
  // On this stack, where the compiler knows that what is written is none of what is read.
  alignas(64) FloatLanes best_a_x, best_a_y, best_b_x, best_b_y, least;
  const std::size_t lanes = fall_offs_ & ~(kFloatLanes - 1);
  std::array<Turn, 2 * kFan - 1> turn;
  for (std::size_t k = 0; k < turn.size(); ++k)
    turn[k] = Turn((static_cast<float>(k) - static_cast<float>(kFan - 1)) * static_cast<float>(step));
  for (std::size_t l = 0; l < lanes; ++l) {
    const float across = c.a_x[l] * c.b_y[l] - c.a_y[l] * c.b_x[l];
    const float straight = c.a_x[l] * c.b_x[l] + c.a_y[l] * c.b_y[l];
    // Of the sine of the angle between the rows, which goes by how far apart they are in their fans.
#define GNOMON_FACTOR(k)                                                   \
  const float sine##k = across * turn[k].cosine + straight * turn[k].sine; \
  const float square##k = sine##k * sine##k;                               \
  const float per##k = 1.0F / divisor(square##k, kLeastSine2);             \
  const float factor##k = square##k > kLeastSine2 ? per##k * per##k : kWidest
    GNOMON_FACTOR(0);
    GNOMON_FACTOR(1);
    GNOMON_FACTOR(2);
    GNOMON_FACTOR(3);
    GNOMON_FACTOR(4);
    GNOMON_FACTOR(5);
    GNOMON_FACTOR(6);
#undef GNOMON_FACTOR
    float best = kInfinity, a_x = m.unit_x[0][l], a_y = m.unit_y[0][l];
    float b_x = m.unit_x[kFan][l], b_y = m.unit_y[kFan][l];
#define GNOMON_PAIR(a, b, apart)                                   \
  {                                                                \
    const float value = m.pair[(a)*kFan + (b)][l] * factor##apart; \
    const bool better = value < best * kSingleTie;                 \
    best = better ? value : best;                                  \
    a_x = better ? m.unit_x[a][l] : a_x;                           \
    a_y = better ? m.unit_y[a][l] : a_y;                           \
    b_x = better ? m.unit_x[kFan + (b)][l] : b_x;                  \
    b_y = better ? m.unit_y[kFan + (b)][l] : b_y;                  \
  }
    GNOMON_PAIR(0, 0, 3)
    GNOMON_PAIR(0, 1, 4)
    GNOMON_PAIR(0, 2, 5)
    GNOMON_PAIR(0, 3, 6)
    GNOMON_PAIR(1, 0, 2)
    GNOMON_PAIR(1, 1, 3)
    GNOMON_PAIR(1, 2, 4)
    GNOMON_PAIR(1, 3, 5)
    GNOMON_PAIR(2, 0, 1)
    GNOMON_PAIR(2, 1, 2)
    GNOMON_PAIR(2, 2, 3)
    GNOMON_PAIR(2, 3, 4)
    GNOMON_PAIR(3, 0, 0)
    GNOMON_PAIR(3, 1, 1)
    GNOMON_PAIR(3, 2, 2)
    GNOMON_PAIR(3, 3, 3)
#undef GNOMON_PAIR
    best_a_x[l] = a_x;
    best_a_y[l] = a_y;
    best_b_x[l] = b_x;
    best_b_y[l] = b_y;
    least[l] = best;
  }
  candidates.a_x = best_a_x;
  candidates.a_y = best_a_y;
  candidates.b_x = best_b_x;
  candidates.b_y = best_b_y;
  candidates.value = least;
}

#undef GNOMON_FORM

}  // namespace gnomon
