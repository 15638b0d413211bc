// Which strength of a warp along the view is best for a body's vertices, by the simplified error of
// warp_error?
#include "warp/along_view.hpp"

#include <cmath>
#include <limits>

#include "geometry/vector.hpp"
#include "geometry/wide.hpp"

namespace gnomon {
namespace {

// Steps of the coarse search, each a factor in kappa times length. The objective is a product of maxima of
// convex functions, smooth at the scale of a factor two.
constexpr double kCoarseFactor = 2.0;
constexpr double kWeakest = 1.0 / 16.0;  // weaker warps change texel sizes by under 6 %
constexpr int kCoarseSteps = 34;         // up to 2^30 / 16: beyond the ratio far / near of any usable camera
constexpr double kMost = 4.0;            // of the body's own ratio of depths: w need not fall off faster
constexpr double kTie = 1e-9;            // gains below this are rounding: the weaker warp wins
constexpr float kQuickTie = 1.0F - 1e-5F;

// A factor 4 in sixteen steps and a bit, two of those in as many, and again: to a thousandth.
constexpr int kRefinements = 3;
constexpr std::array<double, kRefinements> kRefineFactors = {1.0849624, 1.0096416, 1.0011294};

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
  const bool storage = objective_ == Objective::storage;
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
  const AlongViewBest fine = refined(coarse(), kRefineFactors.size());
  return {weakest_as_good(fine), fine.value};
}

GNOMON_WIDE void AlongView::find_quick(const QuickBody& body, const QuickStrengths& reach,
                                       QuickStrengths& value) const noexcept {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::size_t strengths = strengths_;
  alignas(64) QuickStrengths k, left, right, most, most2;
  for (std::size_t l = 0; l < strengths; ++l) {
    k[l] = reach[l];
    left[l] = kInfinity;
    right[l] = -kInfinity;
    most[l] = most2[l] = 0.0F;
  }
  for (std::size_t i = 0; i < count_; ++i) {
    const float x = body.x[i], y = body.y[i], share = body.share[i];
    for (std::size_t l = 0; l < strengths; ++l) {
      const float w = 1.0F + k[l] * y, image = x / w, r = w * share, r2 = w * r;
      left[l] = image < left[l] ? image : left[l];
      right[l] = image > right[l] ? image : right[l];
      most[l] = r > most[l] ? r : most[l];
      most2[l] = r2 > most2[l] ? r2 : most2[l];
    }
  }
  const bool storage = objective_ == Objective::storage;
  const float s_scale = body.s_scale, t_scale = body.t_scale;
  for (std::size_t l = 0; l < strengths; ++l) {
    const float s = (right[l] - left[l]) * most[l] * s_scale, t = most2[l] / (1.0F + k[l]) * t_scale;
    const float product = s * t, larger = s > t ? s : t;
    value[l] = storage ? product : larger;
  }
}

AlongViewBest AlongView::quick() noexcept {
  begin();
  // Beyond this, w^2 leaves single precision.
  constexpr double kWidest = 1e12;
  const double ratio = farthest_ / nearest_;
  if (count_ == 0 || !(length_ > 0.0 && ratio < kWidest)) return {0.0, unwarped()};
  QuickBody body;
  for (std::size_t i = 0; i < count_; ++i) body.width = max_of(body.width, std::abs(x_[i]));
  const double larger = max_of(body.width, length_), per_x = body.width > 0.0 ? 1.0 / body.width : 0.0;
  const double per_y = 1.0 / length_;
  for (std::size_t i = 0; i < count_; ++i) {
    body.x[i] = static_cast<float>(x_[i] * per_x);
    body.y[i] = static_cast<float>((y_[i] - y_min_) * per_y);
    body.share[i] = static_cast<float>(per_depth_[i] * nearest_);
  }
  body.s_scale = static_cast<float>(body.width / larger);
  body.t_scale = static_cast<float>(length_ / larger);
  // Strengths a factor apart from the weakest to the strongest; then as many between the best one's
  // neighbours.
  const auto weakest = static_cast<float>(kWeakest), strongest = static_cast<float>(kMost * ratio);
  float factor = strongest / weakest;
  for (std::size_t l = 1; l < kAtOnce; l *= 2) factor = std::sqrt(factor);
  QuickStrengths reach, value;
  reach[0] = 0.0F;
  reach[1] = weakest;
  for (std::size_t l = 2; l < kAtOnce; ++l) reach[l] = reach[l - 1] * factor;
  const auto least = [&] {
    std::size_t first = 0;
    for (std::size_t l = 1; l < kAtOnce; ++l) first = value[l] < value[first] * kQuickTie ? l : first;
    return first;
  };
  find_quick(body, reach, value);
  const std::size_t coarse = least();
  float best = reach[coarse], found = value[coarse];
  const float step = std::sqrt(std::sqrt(std::sqrt(factor)));
  // Half of the strengths below the best, half above.
  const float middle = coarse > 0 ? best : 0.5F * weakest;
  reach[0] = middle * std::sqrt(step) / factor;
  for (std::size_t l = 1; l < kAtOnce; ++l) reach[l] = reach[l - 1] * step;
  find_quick(body, reach, value);
  const std::size_t fine = least();
  if (value[fine] < found * kQuickTie) {
    best = reach[fine];
    found = value[fine];
  }
  const double scale = larger / nearest_;
  const AlongViewBest quick{best * per_y, found * (objective_ == Objective::storage ? scale * scale : scale)};
  // A body that is flat under the light has no width at one strength alone.
  constexpr float kSharp = 1.1F;
  const float below = fine > 0 ? value[fine - 1] : 0.0F, above = fine + 1 < kAtOnce ? value[fine + 1] : 0.0F;
  const bool sharp = below > found * kSharp || above > found * kSharp;
  return sharp ? refined(quick, kRefineFactors.size()) : quick;
}

AlongViewBest AlongView::refined(AlongViewBest best, std::size_t rounds) noexcept {
  double middle = best.kappa > 0.0 ? best.kappa : 0.5 * kWeakest / length_;
  for (std::size_t round = 0; round < rounds; ++round) {
    const double factor = kRefineFactors[round];
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
