// For fall-offs of the texels over the light plane: which numbers of a body and its samples does a search for
// rows go by?
#include "warp/row_search.hpp"
#include "gnomon/extend/warp.hpp"

#include <cmath>
#include <limits>

#include "geometry/vector.hpp"
#include "lanes/elementary.hpp"
#include "lanes/wide.hpp"

namespace gnomon {
namespace {

// Beyond what bodies have, but where rounding alone makes them: from a sample to the body, in its extents.
constexpr double kFarSample = 16.0;

}  // namespace

bool is_line(const WarpInput& input, const BodyLanes& body) noexcept {
  const LaneRange x = lane_range(body.x.data(), body.count, kDoubleLanes),
                  y = lane_range(body.y.data(), body.count, kDoubleLanes);
  const double middle_x = 0.5 * (x.low + x.high), middle_y = 0.5 * (y.low + y.high);
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < body.count; ++i) {
    const double px = body.x[i] - middle_x, py = body.y[i] - middle_y;
    xx += px * px;
    xy += px * py;
    yy += py * py;
  }
  double farthest = 0.0;
  for (const WarpInput::Point& p : input.body) {
    if (std::isfinite(p.depth)) farthest = max_of(farthest, p.depth);
  }
  // Squared, narrower than a millionth of its length; or no longer than its distance rounds, as `usable` has
  // it.
  constexpr double kLine = 1e-12, kPointSize = 1e-9;
  return !(xx * yy - xy * xy > kLine * (xx + yy) * (xx + yy)) ||
         !(max_of(x.high - x.low, y.high - y.low) > kPointSize * farthest);
}

RowSearch::RowSearch(const WarpInput& input, const PlaneError& error) noexcept
    : lanes_(kDoubleLanes),
      fall_offs_(kFloatLanes),
      body_(error.body()),
      objective_(input.objective),
      // Less what rounding adds.
      most_reach_(min_of((input.most_stretch - 1.0) * (1.0 - 1e-9), kMaxReach)),
      pivot_(input.centre, input.light.perspective ? input.y_min : 0.0) {
  const LaneRange x = lane_range(body_.x.data(), body_.count, lanes_),
                  y = lane_range(body_.y.data(), body_.count, lanes_);
  middle_ = {0.5 * (x.low + x.high), 0.5 * (y.low + y.high)};
  // A body that is flat in the light plane has no direction along which it is thinner than this.
  const double longer = max_of(x.high - x.low, y.high - y.low);
  const double least = longer > 0.0 ? kFlattest * longer : 1.0;
  extent_ = {max_of(x.high - x.low, least), max_of(y.high - y.low, least)};
  // Any pivot serves with other rows, and one that is far away drowns the body's own numbers.
  constexpr double kFarthest = 4.0;
  const glm::dvec2 room = extent_ * kFarthest;
  pivot_ = {clamp_to(pivot_.x, middle_.x - room.x, middle_.x + room.x),
            clamp_to(pivot_.y, middle_.y - room.y, middle_.y + room.y)};
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
  for (const WarpInput::Point& p : input.body) {
    if (!std::isfinite(p.depth)) continue;
    nearest = min_of(nearest, p.depth);
    farthest = max_of(farthest, p.depth);
  }
  depth_range_ = nearest > 0.0 && farthest > nearest ? elementary::log(farthest / nearest) : 0.0;
  PixelLanes corners;
  error.find_corners(corners);
  std::size_t smallest = 0;
  for (std::size_t i = 1; i < corners.count; ++i) {
    if (std::abs(corners.inverse_determinant[i]) > std::abs(corners.inverse_determinant[smallest]))
      smallest = i;
  }
  origin_ = {corners.x[smallest], corners.y[smallest]};
  const double scale_x = 1.0 / extent_.x, scale_y = 1.0 / extent_.y;
  points_ = (body_.points + 3) / 4 * 4;
  for (std::size_t i = 0; i < points_; ++i) {
    point_x_[i] = static_cast<float>((body_.x[i] - origin_.x) * scale_x);
    point_y_[i] = static_cast<float>((body_.y[i] - origin_.y) * scale_y);
  }
  find_samples(corners);
  if (input.light.perspective) fit(corners);
}

GNOMON_WIDE void RowSearch::find_samples(const PixelLanes& samples) noexcept {
  samples_ = samples.count;
  const double scale_x = 1.0 / extent_.x, scale_y = 1.0 / extent_.y, area = extent_.x * extent_.y;
  const double origin_x = origin_.x, origin_y = origin_.y;
  // The lanes past the last sample hold copies of the first.
  const std::size_t n = whole_lanes(samples_);
  alignas(64) std::array<double, kMaxCorners> xx, xy, yy, sum;
  for (std::size_t i = 0; i < n; ++i) {
    const double inverse = samples.inverse_determinant[i] * area;
    const double ax = samples.xx[i] * scale_x * inverse, ay = samples.xy[i] * scale_x * inverse;
    const double bx = samples.yx[i] * scale_y * inverse, by = samples.yy[i] * scale_y * inverse;
    xx[i] = ax * ax + ay * ay;
    xy[i] = ax * bx + ay * by;
    yy[i] = bx * bx + by * by;
    sum[i] = xx[i] + yy[i];
  }
  const double most = n > 0 ? lane_range(sum.data(), n, lanes_).high : 0.0;
  // Relative to the largest: what is far below it plays no part.
  constexpr double kLeast = 1e-280;
  const double scale = most > kLeast ? 1.0 / most : 0.0, area_scale = area * scale;
  for (std::size_t i = 0; i < n; ++i) {
    form_.x[i] = static_cast<float>(clamp_to((samples.x[i] - origin_x) * scale_x, -kFarSample, kFarSample));
    form_.y[i] = static_cast<float>(clamp_to((samples.y[i] - origin_y) * scale_y, -kFarSample, kFarSample));
    form_.xx[i] = static_cast<float>(xx[i] * scale);
    form_.xy[i] = static_cast<float>(xy[i] * scale);
    form_.yy[i] = static_cast<float>(yy[i] * scale);
    form_.inverse[i] = static_cast<float>(samples.inverse_determinant[i] * area_scale);
  }
}

}  // namespace gnomon
