// Which warp do a fall-off and two rows stand for, and which fall-offs are worth a try? In double precision:
// the search among them is in single (row_search.cpp).
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"
#include "gnomon/extend/warp.hpp"
#include "lanes/elementary.hpp"
#include "warp/row_search.hpp"

namespace gnomon {

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

/// Extents of the body's image.
glm::dvec2 RowSearch::image_extent(const Axis& axis) noexcept {
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
  return {max_of(x.high - x.low, least), max_of(y.high - y.low, least)};
}

WarpChoice RowSearch::choice(const RowChoice& rows) noexcept {
  const Axis axis = axis_of(rows.fall_off);
  const glm::dvec2 image = image_extent(axis);
  WarpChoice result;
  result.kappa = axis.kappa;
  result.axis = axis.axis;
  result.centre = axis.centre;
  const auto row = [&](const glm::dvec2& v) {
    const glm::dvec2 whole{v.x / image.x, v.y / image.y};
    return whole / std::sqrt(glm::dot(whole, whole));
  };
  result.row_a = row(rows.row_a);
  result.row_b = row(rows.row_b);
  return result;
}

FallOff RowSearch::ahead(double share) const noexcept {
  return {0.0, fall_off_of(share * depth_range_)};
}

void RowSearch::fit(const PixelLanes& corners) noexcept {
  // Least squares of 1, x, y over the body's unit square, relative to the side of a pixel's square.
  std::array<std::array<double, 4>, 3> m{};
  const auto at = [&](double x, double y) {
    return glm::dvec2((x - middle_.x) / extent_.x, (y - middle_.y) / extent_.y);
  };
  for (std::size_t i = 0; i < corners.count; ++i) {
    // Near enough to the third root, and roots of roots come cheap.
    const double fourth = std::sqrt(std::sqrt(std::abs(corners.inverse_determinant[i])));
    const double inverse = fourth * std::sqrt(std::sqrt(fourth));
    const glm::dvec2 p = at(corners.x[i], corners.y[i]);
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
  if (!(length > 0.0 && std::isfinite(length))) return;
  const double ratio = low > 0.0 ? min_of(elementary::log(high / low), depth_range_) : depth_range_;
  const double scale = fall_off_of(ratio) / length;
  fitted_ = {x * scale, y * scale};
}

}  // namespace gnomon
