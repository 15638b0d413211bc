// LiSPSM with the strength that is best for this body: the objective, exact at the body's vertices, minimised
// over kappa. Based on: Wimmer, Scherzer, Purgathofer, "Light Space Perspective Shadow Maps", 2004; Lloyd et
// al., "Warping and Partitioning for Low Error Shadow Maps", 2006 (the error measure). The search over the
// vertices is this project's.
#include <array>
#include <cmath>
#include <limits>

#include "geometry/elementary.hpp"
#include "geometry/vector.hpp"
#include "geometry/wide.hpp"
#include "gnomon/warp.hpp"
#include "warp/lanes.hpp"

namespace gnomon::warps {
namespace {

// Steps of the coarse search, each a factor in kappa times length. The objective is a product of maxima of
// convex functions, smooth at the scale of a factor two.
constexpr double kCoarseFactor = 2.0;
constexpr double kWeakest = 1.0 / 16.0;  // weaker warps change texel sizes by under 6 %
constexpr int kCoarseSteps = 34;         // up to 2^30 / 16: beyond the ratio far / near of any usable camera
constexpr double kMost = 4.0;            // of the body's own ratio of depths: w need not fall off faster
constexpr int kRefineSteps = 16;         // golden section: 0.618^16 of a factor 4, 0.06 %
constexpr double kTie = 1e-9;            // gains below this are rounding: the weaker warp wins

struct Best {
  double kappa, value;
};

/// warp_error, in lanes: the searches below ask it some fifty times.
class AlongView {
 public:
  explicit AlongView(const WarpInput& input) noexcept
      : lanes_(kWarpLanes), objective_(input.objective), length_(input.y_max - input.y_min) {
    for (const WarpInput::Point& p : input.body) {
      if (count_ == x_.size()) break;
      x_[count_] = p.x - input.centre;
      y_[count_] = p.y - input.y_min;
      per_depth_[count_++] = 1.0 / p.depth;
    }
    for (; count_ < whole_lanes(count_); ++count_) {
      x_[count_] = x_[0];
      y_[count_] = y_[0];
      per_depth_[count_] = per_depth_[0];
    }
  }
  [[nodiscard]] double operator()(double kappa) noexcept {
    find(kappa);
    const LaneRange across = lane_range(image_.data(), count_, lanes_);
    const double w = lane_range(w_.data(), count_, lanes_).high,
                 w2 = lane_range(w2_.data(), count_, lanes_).high;
    return WarpError{(across.high - across.low) * w, length_ / (1.0 + kappa * length_) * w2}.value(
        objective_);
  }

 private:
  GNOMON_WIDE void find(double kappa) noexcept {
    for (std::size_t i = 0; i < count_; ++i) {
      const double w = 1.0 + kappa * y_[i];
      image_[i] = x_[i] / w;
      w_[i] = w * per_depth_[i];
      w2_[i] = w * w_[i];
    }
  }
  std::size_t lanes_;  // kWarpLanes, but not known when this is compiled: as in lane_range
  Objective objective_;
  double length_;
  std::size_t count_ = 0;
  alignas(64) std::array<double, whole_lanes(2 * kMaxVertices)> x_, y_, per_depth_, image_, w_, w2_;
};

Best refine(AlongView& error, double low, double high, Best best) noexcept {
  constexpr double kGolden = 0.6180339887498949;
  double a = elementary::log(low), b = elementary::log(high);
  const auto at = [&](double t) { return error(elementary::exp(t)); };
  double left = b - kGolden * (b - a), right = a + kGolden * (b - a);
  double at_left = at(left), at_right = at(right);
  for (int i = 0; i < kRefineSteps; ++i) {
    if (at_left <= at_right) {
      b = right;
      right = left;
      at_right = at_left;
      left = b - kGolden * (b - a);
      at_left = at(left);
    } else {
      a = left;
      left = right;
      at_left = at_right;
      right = a + kGolden * (b - a);
      at_right = at(right);
    }
  }
  const double value = at_left < at_right ? at_left : at_right;
  return value < best.value * (1.0 - kTie) ? Best{elementary::exp(at_left <= at_right ? left : right), value}
                                           : best;
}

/// The weakest warp that is as good as `best`: under an overhead light the storage is the same for a whole
/// range of strengths, and the weaker end has the smaller worst texel.
double weakest_as_good(AlongView& error, const Best& best) noexcept {
  constexpr int kHalvings = 30;
  constexpr double kLess = 1.0 - 1e-3;
  const double enough = best.value * (1.0 + kTie);
  const auto as_good = [&](double kappa) { return error(kappa) <= enough; };
  if (!(best.kappa > 0.0) || !as_good(best.kappa * kLess)) return best.kappa;
  double worse = 0.0, good = best.kappa;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (worse + good);
    (as_good(middle) ? good : worse) = middle;
  }
  return good;
}

WarpChoice choose(const WarpInput& input) noexcept {
  const double length = input.y_max - input.y_min;
  if (input.flat() || !(length > 0.0)) return input.unwarped;
  AlongView error(input);
  Best best{0.0, error(0.0)};
  const double step = kCoarseFactor;
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
  for (const WarpInput::Point& p : input.body) {
    if (!std::isfinite(p.depth)) continue;
    nearest = min_of(nearest, p.depth);
    farthest = max_of(farthest, p.depth);
  }
  const double strongest = kMost * farthest / (nearest * length);
  double best_grid = 0.0, kappa = kWeakest / length;
  Best grid{0.0, best.value};
  for (int i = 0; i < kCoarseSteps && kappa <= strongest; ++i, kappa *= step) {
    const double value = error(kappa);
    if (value < grid.value * (1.0 - kTie)) {
      grid = {kappa, value};
      best_grid = kappa;
    }
  }
  const double around = best_grid > 0.0 ? best_grid : 0.5 * kWeakest / length;
  return input.along_view(
      weakest_as_good(error, refine(error, around / step, around * step, best_grid > 0.0 ? grid : best)));
}

}  // namespace

const Warp lispsm{"lispsm", "light-space perspective, strength chosen for the visible body", choose, true};

}  // namespace gnomon::warps
