// Four lines round a body's image become the sides of another map: what is that map's error? Based on: the
// error measure of Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006. With lines l0 to
// l3, each 0 or more over the body, w is the line through the two points where opposite sides meet:
//   w = alpha l0 + beta l1 = gamma l2 + delta l3,   a = alpha l0 / w,   b = gamma l2 / w,
// and alpha to delta are determinants of three of the lines. No point of the body takes a division, nor does
// a sample.
#include "warp/side_search.hpp"
#include "gnomon/extend/warp.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"
#include "lanes/wide.hpp"
#include "warp/plane_map.hpp"

namespace gnomon {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Keep divisors away from zero, and products within single precision: what goes beyond is far from the best.
constexpr float kNothing = 1e-24F, kFar = 1e14F;
// Alpha to delta are about 1 in the image of a map; nearer to 0, sides meet beside the body.
constexpr float kLeastFactor = 1e-4F;
// How much stronger a search makes a warp at most.
constexpr double kSearchStretch = 100.0;

/// 1 / x, and 0 at 0: without a choice, as in inverse_or_0.
constexpr float inverse_of(float x) noexcept {
  return x / (x * x + kNothing);
}

}  // namespace

Sides SideLanes::at(std::size_t lane) const noexcept {
  Sides sides;
  for (std::size_t k = 0; k < 4; ++k) sides.normal[k] = {x[k][lane], y[k][lane]};
  return sides;
}

/// The candidates' maps.
struct SideSearch::Maps {
  alignas(64) FloatLanes w_x, w_y, w_1;
  // The gradient of a over alpha, times w^2, is (turn y + first, second - turn x), and b's alike.
  alignas(64) FloatLanes turn_a, first_a, second_a, turn_b, first_b, second_b;
  // A texel's extents along a and b go by the other's gradient over these products of alpha to delta; its
  // area by all four.
  alignas(64) FloatLanes per_a, per_b, area;
  alignas(64) FloatLanes usable;  // 1; 0 where the lines make no map
};

SideSearch::SideSearch(const WarpInput& input, const PlaneError& error, const WarpChoice& from) noexcept
    : lanes_(kDoubleLanes),
      candidates_(kFloatLanes),
      body_(error.body()),
      objective_(input.objective),
      // Less what rounding adds.
      most_stretch_(static_cast<float>(min_of(input.most_stretch * (1.0 - 1e-4), kMaxReach))),
      origin_(body_.x[0], body_.y[0]),
      mean_(error.is_mean()),
      above_(error.above()) {
  const PlaneMap map = plane_map(input.body, from);
  const glm::dvec2 axis = from.axis;
  // Over (x, y, 1): across the axis from the centre, along it from u_min, and w.
  const double centre = from.centre - (origin_.x * axis.y - origin_.y * axis.x);
  const double u_min = map.u_min - (origin_.x * axis.x + origin_.y * axis.y);
  const glm::dvec3 across{axis.y, -axis.x, -centre}, along = glm::dvec3(axis.x, axis.y, -u_min) * map.stretch;
  w_ = {from.kappa * axis.x, from.kappa * axis.y, 1.0 - from.kappa * u_min};
  const auto edge_to_edge = [&](const glm::dvec2& row, double low, double high) {
    return (across * row.x + along * row.y - w_ * low) / (high - low);
  };
  a_ = edge_to_edge(from.row_a, map.a_min, map.a_max);
  b_ = edge_to_edge(from.row_b, map.b_min, map.b_max);
  strong_ = map.stretch * kSearchStretch > static_cast<double>(most_stretch_);
  find_points();
  find_samples(error.counted());
}

GNOMON_WIDE void SideSearch::find_points() noexcept {
  const glm::dvec3 a = a_, b = b_, w = w_;
  const double origin_x = origin_.x, origin_y = origin_.y;
  const std::size_t n = body_.count;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = body_.x[i] - origin_x, y = body_.y[i] - origin_y;
    const double inverse = 1.0 / (w.x * x + w.y * y + w.z);
    image_x_[i] = (a.x * x + a.y * y + a.z) * inverse;
    image_y_[i] = (b.x * x + b.y * y + b.z) * inverse;
    point_x_[i] = static_cast<float>(image_x_[i]);
    point_y_[i] = static_cast<float>(image_y_[i]);
    point_w_[i] = static_cast<float>(1.0 / inverse);
  }
  points_ = (body_.points + 3) / 4 * 4;
}

GNOMON_WIDE void SideSearch::find_samples(const PixelLanes& samples) noexcept {
  const glm::dvec3 a = a_, b = b_, w = w_;
  const double origin_x = origin_.x, origin_y = origin_.y;
  samples_ = samples.count;
  // The lanes past the last sample hold copies of the first.
  const std::size_t n = whole_lanes(samples_);
  alignas(64) std::array<double, PixelLanes::kMost> xx, xy, yy, sum, inverse;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = samples.x[i] - origin_x, y = samples.y[i] - origin_y;
    const double per_w = 1.0 / (w.x * x + w.y * y + w.z);
    const double image_x = (a.x * x + a.y * y + a.z) * per_w, image_y = (b.x * x + b.y * y + b.z) * per_w;
    const double a_x = (a.x - image_x * w.x) * per_w, a_y = (a.y - image_x * w.y) * per_w;
    const double b_x = (b.x - image_y * w.x) * per_w, b_y = (b.y - image_y * w.y) * per_w;
    const double ax = a_x * samples.xx[i] + a_y * samples.yx[i],
                 ay = a_x * samples.xy[i] + a_y * samples.yy[i];
    const double bx = b_x * samples.xx[i] + b_y * samples.yx[i],
                 by = b_x * samples.xy[i] + b_y * samples.yy[i];
    const double determinant = samples.inverse_determinant[i] / (a_x * b_y - a_y * b_x);
    const double squared = determinant * determinant;
    form_.x[i] = static_cast<float>(image_x);
    form_.y[i] = static_cast<float>(image_y);
    xx[i] = (ax * ax + ay * ay) * squared;
    xy[i] = (ax * bx + ay * by) * squared;
    yy[i] = (bx * bx + by * by) * squared;
    sum[i] = xx[i] + yy[i];
    inverse[i] = determinant;
  }
  const double most = n > 0 ? lane_range(sum.data(), n, lanes_).high : 0.0;
  // Relative to the largest: what is far below it plays no part.
  constexpr double kLeast = 1e-280;
  const double scale = most > kLeast ? 1.0 / most : 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    form_.xx[i] = static_cast<float>(xx[i] * scale);
    form_.xy[i] = static_cast<float>(xy[i] * scale);
    form_.yy[i] = static_cast<float>(yy[i] * scale);
    form_.inverse[i] = static_cast<float>(inverse[i] * scale);
  }
  for (std::size_t i = 0; mean_ && i < n; ++i) {
    const float x = form_.x[i], y = form_.y[i];
    turn_first_[i] = form_.xx[i] * y - form_.xy[i] * x;
    turn_second_[i] = form_.xy[i] * y - form_.yy[i] * x;
    turn_turn_[i] = turn_first_[i] * y - turn_second_[i] * x;
  }
}

GNOMON_WIDE void SideSearch::turn(const Sides& sides, SideLanes& candidates) const noexcept {
  SideLanes& __restrict c = candidates;
  const std::size_t lanes = candidates_ & ~(kFloatLanes - 1);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto x = static_cast<float>(sides.normal[k].x), y = static_cast<float>(sides.normal[k].y);
    for (std::size_t l = 0; l < lanes; ++l) {
      const Turn turn(c.turn[k][l]);
      c.x[k][l] = x * turn.cosine - y * turn.sine;
      c.y[k][l] = x * turn.sine + y * turn.cosine;
    }
  }
}

GNOMON_WIDE void SideSearch::fit(const SideLanes& candidates, Maps& maps) const noexcept {
  Maps& __restrict m = maps;
  // Copies, which the compiler knows that nothing below writes to.
  alignas(64) const std::array<FloatLanes, 4> n_x = candidates.x, n_y = candidates.y;
  const std::size_t lanes = candidates_ & ~(kFloatLanes - 1), n = points_;
  alignas(64) FloatLanes least_0, least_1, least_2, least_3, low, high;
  for (std::size_t l = 0; l < lanes; ++l) {
    least_0[l] = least_1[l] = least_2[l] = least_3[l] = low[l] = kInfinity;
    high[l] = -kInfinity;
  }
  for (std::size_t i = 0; i < n; i += 2) {
    const float x = point_x_[i], y = point_y_[i];
    const float next_x = point_x_[i + 1], next_y = point_y_[i + 1];
    for (std::size_t l = 0; l < lanes; ++l) {
#define GNOMON_TOUCH(k) \
  least_##k[l] =        \
      min_of(least_##k[l], min_of(n_x[k][l] * x + n_y[k][l] * y, n_x[k][l] * next_x + n_y[k][l] * next_y))
      GNOMON_TOUCH(0);
      GNOMON_TOUCH(1);
      GNOMON_TOUCH(2);
      GNOMON_TOUCH(3);
#undef GNOMON_TOUCH
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) {
    const float x0 = n_x[0][l], y0 = n_y[0][l], z0 = -least_0[l], x1 = n_x[1][l], y1 = n_y[1][l],
                z1 = -least_1[l];
    const float x2 = n_x[2][l], y2 = n_y[2][l], z2 = -least_2[l], x3 = n_x[3][l], y3 = n_y[3][l],
                z3 = -least_3[l];
    // Where opposite sides meet.
    const float px = y0 * z1 - z0 * y1, py = z0 * x1 - x0 * z1, pz = x0 * y1 - y0 * x1;
    const float qx = y2 * z3 - z2 * y3, qy = z2 * x3 - x2 * z3, qz = x2 * y3 - y2 * x3;
    const float d023 = x0 * qx + y0 * qy + z0 * qz, d123 = x1 * qx + y1 * qy + z1 * qz;
    const float d013 = px * x3 + py * y3 + pz * z3, d012 = px * x2 + py * y2 + pz * z2;
    const float sign = d023 > 0.0F ? 1.0F : -1.0F;
    const float alpha = -d123 * sign, beta = d023 * sign, gamma = d013 * sign, delta = -d012 * sign;
    m.w_x[l] = alpha * x0 + beta * x1;
    m.w_y[l] = alpha * y0 + beta * y1;
    m.w_1[l] = alpha * z0 + beta * z1;
    m.usable[l] = min_of(min_of(alpha, beta), min_of(gamma, delta)) > kLeastFactor ? 1.0F : 0.0F;
    const float per_a = inverse_of(alpha * beta * delta), per_b = inverse_of(beta * gamma * delta);
    m.per_a[l] = per_a * per_a;
    m.per_b[l] = per_b * per_b;
    m.area[l] = inverse_of(alpha * beta * gamma * delta);
    m.turn_a[l] = x0 * m.w_y[l] - y0 * m.w_x[l];
    m.first_a[l] = x0 * m.w_1[l] - z0 * m.w_x[l];
    m.second_a[l] = y0 * m.w_1[l] - z0 * m.w_y[l];
    m.turn_b[l] = x2 * m.w_y[l] - y2 * m.w_x[l];
    m.first_b[l] = x2 * m.w_1[l] - z2 * m.w_x[l];
    m.second_b[l] = y2 * m.w_1[l] - z2 * m.w_y[l];
  }
  if (!strong_) return;
  // w of both maps together.
  for (std::size_t i = 0; i < n; ++i) {
    const float x = point_x_[i], y = point_y_[i], before = point_w_[i];
    for (std::size_t l = 0; l < lanes; ++l) {
      const float both = (m.w_x[l] * x + m.w_y[l] * y + m.w_1[l]) * before;
      low[l] = min_of(low[l], both);
      high[l] = max_of(high[l], both);
    }
  }
  const float most_stretch = most_stretch_;
  for (std::size_t l = 0; l < lanes; ++l)
    m.usable[l] = low[l] > 0.0F && high[l] <= most_stretch * low[l] ? m.usable[l] : 0.0F;
}

// Macros write out what the loops over lanes do for two samples at a time: half as many numbers of the
// candidates to fetch.

// For one sample and candidate: the squared extents of a texel along both sides, but for the factors of the
// whole map. Samples lie in the image: neither w nor a gradient is large.
#define GNOMON_EXTENTS(at, k)                                                                        \
  const float w##k = m.w_x[l] * at.x + m.w_y[l] * at.y + m.w_1[l], square##k = w##k * w##k;          \
  const float ax##k = m.turn_a[l] * at.y + m.first_a[l], ay##k = m.second_a[l] - m.turn_a[l] * at.x; \
  const float bx##k = m.turn_b[l] * at.y + m.first_b[l], by##k = m.second_b[l] - m.turn_b[l] * at.x; \
  const float extent_a##k =                                                                          \
      (bx##k * (bx##k * at.xx + by##k * (2.0F * at.xy)) + by##k * by##k * at.yy) * square##k;        \
  const float extent_b##k =                                                                          \
      (ax##k * (ax##k * at.xx + ay##k * (2.0F * at.xy)) + ay##k * ay##k * at.yy) * square##k
// Half the sum of both squared extents, and their product's root: the larger of the two squares. Rounding
// alone leaves the spread below 0.
#define GNOMON_LARGER(at, k)                                                                        \
  GNOMON_EXTENTS(at, k);                                                                            \
  const float half##k = min_of(0.5F * (m.per_a[l] * extent_a##k + m.per_b[l] * extent_b##k), kFar); \
  const float area##k = min_of(std::abs(m.area[l] * square##k * w##k * at.inverse), kFar);          \
  const float spread##k = (half##k - area##k) * (half##k + area##k);                                \
  const float larger##k = half##k + std::sqrt(std::abs(spread##k))

GNOMON_WIDE void SideSearch::find_storage(const Maps& maps, SideLanes& candidates) const noexcept {
  const Maps& __restrict m = maps;
  SideLanes& __restrict c = candidates;
  const std::size_t lanes = candidates_ & ~(kFloatLanes - 1), n = samples_;
  alignas(64) FloatLanes most_a{}, most_b{};
  for (std::size_t i = 0; i < n; i += 2) {
    const Form::Form f0 = form_.at(i), f1 = form_.at(i + 1);
    for (std::size_t l = 0; l < lanes; ++l) {
      GNOMON_EXTENTS(f0, 0);
      GNOMON_EXTENTS(f1, 1);
      most_a[l] = max_of(most_a[l], max_of(extent_a0, extent_a1));
      most_b[l] = max_of(most_b[l], max_of(extent_b0, extent_b1));
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) {
    const float storage = min_of(most_a[l] * m.per_a[l], kFar) * min_of(most_b[l] * m.per_b[l], kFar);
    c.value[l] = m.usable[l] > 0.0F ? storage : kInfinity;
  }
}

GNOMON_WIDE void SideSearch::find_worst(const Maps& maps, SideLanes& candidates) const noexcept {
  const Maps& __restrict m = maps;
  SideLanes& __restrict c = candidates;
  const std::size_t lanes = candidates_ & ~(kFloatLanes - 1), n = samples_;
  alignas(64) FloatLanes worst{};
  for (std::size_t i = 0; i < n; i += 2) {
    const Form::Form f0 = form_.at(i), f1 = form_.at(i + 1);
    for (std::size_t l = 0; l < lanes; ++l) {
      GNOMON_LARGER(f0, 0);
      GNOMON_LARGER(f1, 1);
      worst[l] = max_of(worst[l], max_of(larger0, larger1));
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) c.value[l] = m.usable[l] > 0.0F ? worst[l] : kInfinity;
}

GNOMON_WIDE void SideSearch::find_percentile(const Maps& maps, SideLanes& candidates) const noexcept {
  const Maps& __restrict m = maps;
  SideLanes& __restrict c = candidates;
  const std::size_t lanes = candidates_ & ~(kFloatLanes - 1), n = samples_, above = above_;
  // The largest few, largest first.
  alignas(64) std::array<FloatLanes, PlaneError::kMaxAboveFirst + 1> top{};
  for (std::size_t i = 0; i < n; ++i) {
    const Form::Form f0 = form_.at(i);
    for (std::size_t l = 0; l < lanes; ++l) {
      GNOMON_LARGER(f0, 0);
      float rest = larger0;
      for (auto& level : top) {
        const float next = min_of(level[l], rest);
        level[l] = max_of(level[l], rest);
        rest = next;
      }
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) c.value[l] = m.usable[l] > 0.0F ? top[above][l] : kInfinity;
}

// A texel's squared extents together are a sum over both gradients (turn y + first, second - turn x), of
// which each is a quadratic form of turn, first and second with six numbers of the sample: for all of a
// candidate's factors, six products a sample.
GNOMON_WIDE void SideSearch::find_mean(const Maps& maps, SideLanes& candidates) const noexcept {
  const Maps& __restrict m = maps;
  SideLanes& __restrict c = candidates;
  const std::size_t lanes = candidates_ & ~(kFloatLanes - 1), n = samples_;
  alignas(64) FloatLanes turn2, first2, second2, turn_first, turn_second, first_second, sum{};
  for (std::size_t l = 0; l < lanes; ++l) {
    const float a_turn = m.per_b[l] * m.turn_a[l], a_first = m.per_b[l] * m.first_a[l];
    const float b_turn = m.per_a[l] * m.turn_b[l], b_first = m.per_a[l] * m.first_b[l];
    turn2[l] = 0.5F * (a_turn * m.turn_a[l] + b_turn * m.turn_b[l]);
    first2[l] = 0.5F * (a_first * m.first_a[l] + b_first * m.first_b[l]);
    second2[l] =
        0.5F * (m.per_b[l] * m.second_a[l] * m.second_a[l] + m.per_a[l] * m.second_b[l] * m.second_b[l]);
    turn_first[l] = a_turn * m.first_a[l] + b_turn * m.first_b[l];
    turn_second[l] = a_turn * m.second_a[l] + b_turn * m.second_b[l];
    first_second[l] = a_first * m.second_a[l] + b_first * m.second_b[l];
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Form::Form f = form_.at(i);
    const float tt = turn_turn_[i], tf = turn_first_[i], ts = turn_second_[i];
    for (std::size_t l = 0; l < lanes; ++l) {
      const float w = m.w_x[l] * f.x + m.w_y[l] * f.y + m.w_1[l];
      const float turned = turn2[l] * tt + turn_first[l] * tf + turn_second[l] * ts;
      const float straight = first2[l] * f.xx + first_second[l] * f.xy + second2[l] * f.yy;
      // Rounding alone leaves it below 0; w is not, where the candidate is usable.
      sum[l] += w * std::sqrt(std::abs(turned + straight));
    }
  }
  const float share = n > 0 ? 1.0F / static_cast<float>(n) : 0.0F;
  for (std::size_t l = 0; l < lanes; ++l) {
    const float mean = sum[l] * share;
    c.value[l] = m.usable[l] > 0.0F ? min_of(mean * mean, kFar) : kInfinity;
  }
}
#undef GNOMON_LARGER
#undef GNOMON_EXTENTS

void SideSearch::find_values(const Sides& sides, SideLanes& candidates) const noexcept {
  Maps maps;
  turn(sides, candidates);
  fit(candidates, maps);
  if (objective_ == Objective::storage) {
    find_storage(maps, candidates);
  } else if (mean_) {
    find_mean(maps, candidates);
  } else if (above_ == 0) {
    find_worst(maps, candidates);
  } else {
    find_percentile(maps, candidates);
  }
}

WarpChoice SideSearch::choice(const Sides& sides) const noexcept {
  std::array<glm::dvec3, 4> line;  // over (x, y, 1) from the origin
  for (std::size_t k = 0; k < 4; ++k) {
    const glm::dvec2 n = sides.normal[k];
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < body_.points; ++i)
      least = min_of(least, n.x * image_x_[i] + n.y * image_y_[i]);
    line[k] = a_ * n.x + b_ * n.y - w_ * least;
  }
  const glm::dvec3 meeting = glm::cross(line[2], line[3]);
  const double beta = glm::dot(line[0], meeting), sign = beta > 0.0 ? 1.0 : -1.0;
  const glm::dvec3 w = sign * (line[1] * beta - line[0] * glm::dot(line[1], meeting));
  const double steepness = std::sqrt(w.x * w.x + w.y * w.y);
  WarpChoice result;
  // Compilers divide before they choose, too (lanes/wide.hpp).
  constexpr double kLeastLength = 1e-200;
  result.axis = steepness > 0.0 ? glm::dvec2(w.x, w.y) / divisor(steepness, kLeastLength) : glm::dvec2(0.0, 1.0);
  const glm::dvec2 axis = result.axis;
  double u_min = std::numeric_limits<double>::infinity(), u_max = -u_min;
  for (std::size_t i = 0; i < body_.points; ++i) {
    const double u = axis.x * (body_.x[i] - origin_.x) + axis.y * (body_.y[i] - origin_.y);
    u_min = min_of(u_min, u);
    u_max = max_of(u_max, u);
  }
  const double w_min = w.z + steepness * u_min;
  result.kappa = w_min > 0.0 ? steepness / divisor(w_min, kLeastLength) : 0.0;
  result.centre = origin_.x * axis.y - origin_.y * axis.x;
  // Over the warp's image: X is across the axis, from the origin, and Y along it from u_min, both over w.
  const double stretch = 1.0 + result.kappa * (u_max - u_min);
  const auto row = [&](const glm::dvec3& l) {
    const double across = l.x * axis.y - l.y * axis.x, along = l.x * axis.x + l.y * axis.y;
    const glm::dvec2 v{across, (along - (l.z + along * u_min) * result.kappa) / stretch};
    return v / std::sqrt(glm::dot(v, v));
  };
  result.row_a = row(line[0]);
  result.row_b = row(line[2]);
  return result;
}

}  // namespace gnomon
