// Which strength of a warp along the view is best for a body's vertices, by the simplified error of
// warp_error?
#include "warp/along_view.hpp"
#include "gnomon/extend/warp.hpp"

#include <cmath>
#include <limits>

#include "geometry/vector.hpp"
#include "lanes/lanes.hpp"
#include "lanes/wide.hpp"

namespace gnomon {
namespace {

// Steps of the coarse search, each a factor in kappa times length. The objective is a product of maxima of
// convex functions, smooth at the scale of a factor two.
constexpr double kCoarseFactor = 2.0;
constexpr double kWeakest = 1.0 / 16.0;  // weaker warps change texel sizes by under 6 %
constexpr int kCoarseSteps = 34;         // up to 2^30 / 16: beyond the ratio far / near of any usable camera
constexpr double kMost = 4.0;            // of the body's own ratio of depths: w need not fall off faster
constexpr double kTie = 1e-9;            // gains below this are rounding: the weaker warp wins

// A factor 4 in sixteen steps and a bit, two of those in as many, and again: to a thousandth.
constexpr int kRefinements = 3;
constexpr std::array<double, kRefinements> kRefineFactors = {1.0849624, 1.0096416, 1.0011294};

// Of the quick search: no warp and strengths a factor apart, as kappa times length; then factors between two
// of those, an eighth of the way apart.
constexpr float kQuickFactor = 2.2F, kQuickEighth = 1.1035628F, kQuickFirst = 0.4775F;
constexpr std::size_t kQuick = 16;
constexpr std::array<float, kQuick> powers(float first, float factor) noexcept {
  std::array<float, kQuick> result{};
  for (float& power : result) {
    power = first;
    first *= factor;
  }
  return result;
}
constexpr std::array<float, kQuick> quick_reaches() noexcept {
  std::array<float, kQuick> reaches = powers(static_cast<float>(kWeakest) / kQuickFactor, kQuickFactor);
  reaches[0] = 0.0F;
  return reaches;
}
constexpr std::array<float, kQuick> kQuickReaches = quick_reaches();
constexpr std::array<float, kQuick> kQuickFactors = powers(kQuickFirst, kQuickEighth);

std::size_t first_of_least(const std::array<float, kQuick>& value) noexcept {
  constexpr float kSame = 1.0F - 1e-5F;  // gains below this are rounding
  return first_of_least_lane(value, kSame);
}

}  // namespace

AlongView::AlongView(Objective objective, double centre) noexcept
    : strengths_(kAtOnce), objective_(objective), centre_(centre) {}

AlongView::AlongView(const WarpInput& input) noexcept : AlongView(input.objective, input.centre) {
  for (const WarpInput::Point& p : input.body) add(p.x, p.y, p.depth);
}

void AlongView::add(double x, double y, double depth) noexcept {
  if (count_ == x_.size()) return;
  x_[count_] = x - centre_;
  y_[count_] = y;
  per_depth_[count_++] = 1.0 / depth;
}

void AlongView::begin() noexcept {
  double low = std::numeric_limits<double>::infinity(), high = -low, least = low, most = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    low = min_of(low, y_[i]);
    high = max_of(high, y_[i]);
    most = max_of(most, per_depth_[i]);
    // Infinite depths do not count.
    least = per_depth_[i] > 0.0 ? min_of(least, per_depth_[i]) : least;
  }
  y_min_ = low;
  length_ = high - low;
  nearest_ = 1.0 / most;
  farthest_ = 1.0 / least;
}

GNOMON_WIDE void AlongView::find(const Strengths& kappa) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::size_t strengths = strengths_;
  alignas(64) Strengths k, left, right, most, most2;
  for (std::size_t l = 0; l < strengths; ++l) {
    k[l] = kappa[l];
    left[l] = kInfinity;
    right[l] = -kInfinity;
    most[l] = most2[l] = 0.0;
  }
  for (std::size_t i = 0; i < count_; ++i) {
    const double x = x_[i], y = y_[i] - y_min_, per_depth = per_depth_[i];
    for (std::size_t l = 0; l < strengths; ++l) {
      const double w = 1.0 + k[l] * y, image = x / w, r = w * per_depth;
      left[l] = min_of(left[l], image);
      right[l] = max_of(right[l], image);
      most[l] = max_of(most[l], r);
      most2[l] = max_of(most2[l], w * r);
    }
  }
  const bool storage = counts_texels(objective_);
  for (std::size_t l = 0; l < strengths; ++l) {
    const double s = (right[l] - left[l]) * most[l], t = length_ / (1.0 + k[l] * length_) * most2[l];
    const double product = s * t, larger = max_of(s, t);
    value_[l] = storage ? product : larger;
  }
}

double AlongView::unwarped() noexcept {
  begin();
  find(Strengths{});
  return value_[0];
}

/// The best of strengths a factor apart, and no warp.
AlongViewBest AlongView::coarse() noexcept {
  const double strongest = kMost * farthest_ / (nearest_ * length_);
  AlongViewBest best{0.0, std::numeric_limits<double>::infinity()};
  double next = 0.0;
  int steps = 0;
  while (steps == 0 || (next <= strongest && steps < kCoarseSteps)) {
    Strengths kappa{};
    std::size_t count = 0;
    for (; count < kAtOnce; ++count) {
      // 0 first, then as many as are usable.
      if (steps > 0 && !(next <= strongest && steps <= kCoarseSteps)) break;
      kappa[count] = next;
      next = steps == 0 ? kWeakest / length_ : next * kCoarseFactor;
      ++steps;
    }
    find(kappa);
    for (std::size_t l = 0; l < count; ++l) {
      if (value_[l] < best.value * (1.0 - kTie)) best = {kappa[l], value_[l]};
    }
  }
  return best;
}

AlongViewBest AlongView::best() noexcept {
  begin();
  if (!(length_ > 0.0)) return {0.0, unwarped()};
  const AlongViewBest fine = refined(coarse());
  return {weakest_as_good(fine), fine.value};
}

AlongViewBest AlongView::quick() noexcept {
  begin();
  if (count_ == 0 || !(length_ > 0.0)) return {0.0, unwarped()};
  double widest = 0.0;
  for (std::size_t i = 0; i < count_; ++i) widest = max_of(widest, std::abs(x_[i]));
  const double scale_x = widest > 0.0 ? widest : length_;
  const double per_x = 1.0 / scale_x, per_length = 1.0 / length_;
  Shares shares;
  for (std::size_t i = 0; i < count_; ++i) {
    shares.x[i] = static_cast<float>(x_[i] * per_x);
    shares.y[i] = static_cast<float>((y_[i] - y_min_) * per_length);
    shares.per_depth[i] = static_cast<float>(per_depth_[i] * nearest_);
  }
  shares.wider = static_cast<float>(scale_x * per_length);
  QuickStrengths value;
  find_quick(shares, kQuickReaches, value);
  const std::size_t coarse = first_of_least(value);
  float best = kQuickReaches[coarse], least = value[coarse];
  const float middle = coarse > 0 ? best : 0.5F * kQuickReaches[1];
  QuickStrengths reach;
  for (std::size_t l = 0; l < kAtOnce; ++l) reach[l] = middle * kQuickFactors[l];
  find_quick(shares, reach, value);
  const std::size_t fine = first_of_least(value);
  if (value[fine] < least) {
    best = reach[fine];
    least = value[fine];
  }
  const double per_pixel = 1.0 / nearest_, texel = length_ * per_pixel;
  const double scale = counts_texels(objective_) ? texel * scale_x * per_pixel : texel;
  return {static_cast<double>(best) * per_length, static_cast<double>(least) * scale};
}

/// As find, in single precision and over shares of the body's extents.
GNOMON_WIDE void AlongView::find_quick(const Shares& shares, const QuickStrengths& reach,
                                       QuickStrengths& value) const noexcept {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto min_of = [](float a, float b) { return a < b ? a : b; };
  const auto max_of = [](float a, float b) { return a > b ? a : b; };
  const std::size_t strengths = strengths_ & ~(kAtOnce - 1);
  const bool storage = counts_texels(objective_);
  const float wider = shares.wider;
  alignas(64) QuickStrengths k, left, right, most, most2;
  for (std::size_t l = 0; l < strengths; ++l) {
    k[l] = reach[l];
    left[l] = kInfinity;
    right[l] = -kInfinity;
    most[l] = most2[l] = 0.0F;
  }
  for (std::size_t i = 0; i < count_; ++i) {
    const float x = shares.x[i], y = shares.y[i], per_depth = shares.per_depth[i];
    for (std::size_t l = 0; l < strengths; ++l) {
      const float w = 1.0F + k[l] * y, image = x / w, r = w * per_depth;
      left[l] = min_of(left[l], image);
      right[l] = max_of(right[l], image);
      most[l] = max_of(most[l], r);
      most2[l] = max_of(most2[l], w * r);
    }
  }
  for (std::size_t l = 0; l < strengths; ++l) {
    const float s = (right[l] - left[l]) * most[l], t = most2[l] / (1.0F + k[l]);
    const float product = s * t, across = s * wider, larger = max_of(across, t);
    value[l] = storage ? product : larger;
  }
}

AlongViewBest AlongView::refined(AlongViewBest best) noexcept {
  double middle = best.kappa > 0.0 ? best.kappa : 0.5 * kWeakest / length_;
  for (const double factor : kRefineFactors) {
    // Half of the strengths below the middle, half above.
    Strengths kappa;
    const double root = std::sqrt(factor);
    kappa[kAtOnce / 2] = middle * root;
    kappa[kAtOnce / 2 - 1] = middle / root;
    for (std::size_t l = kAtOnce / 2 + 1; l < kAtOnce; ++l) kappa[l] = kappa[l - 1] * factor;
    for (std::size_t l = kAtOnce / 2 - 1; l > 0; --l) kappa[l - 1] = kappa[l] / factor;
    find(kappa);
    std::size_t least = 0;
    for (std::size_t l = 1; l < kAtOnce; ++l) {
      if (value_[l] < value_[least] * (1.0 - kTie)) least = l;
    }
    middle = kappa[least];
    if (value_[least] < best.value * (1.0 - kTie)) best = {middle, value_[least]};
  }
  return best;
}

/// The weakest warp that is as good as `best`: under an overhead light the storage is the same for a whole
/// range of strengths, and the weaker end has the smaller worst texel.
double AlongView::weakest_as_good(const AlongViewBest& best) noexcept {
  constexpr int kRounds = 7;  // of a seventeenth each: to rounding
  constexpr double kLess = 1.0 - 1e-3;
  const double enough = best.value * (1.0 + kTie);
  if (!(best.kappa > 0.0)) return best.kappa;
  double worse = 0.0, good = best.kappa;
  for (int i = 0; i < kRounds; ++i) {
    Strengths kappa;
    for (std::size_t l = 0; l < kAtOnce; ++l)
      kappa[l] = worse + (good - worse) * (static_cast<double>(l + 1) / (kAtOnce + 1.0));
    if (i == 0) kappa[kAtOnce - 1] = good * kLess;
    find(kappa);
    if (i == 0 && !(value_[kAtOnce - 1] <= enough)) return best.kappa;
    std::size_t first = 0;
    while (first < kAtOnce && !(value_[first] <= enough)) ++first;
    if (first > 0) worse = kappa[first - 1];
    if (first < kAtOnce) good = kappa[first];
  }
  return good;
}

}  // namespace gnomon
