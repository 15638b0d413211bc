// The best projective map of the light plane for this body: fall-off and rows searched together.
// Based on: the error measure of Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006.
// The search is this project's: the fall-off's two numbers first, sixteen places at a time, by the corners
// and with the best rows for each; then by all samples, or from a warp of the registry where that is better.
#include <array>
#include <cmath>
#include <limits>

#include "geometry/vector.hpp"
#include "warp/plane_error.hpp"
#include "warp/plane_map.hpp"
#include "warp/row_search.hpp"

namespace gnomon::warps {
namespace {

// From the last frame's result on: how far round it, as a fall-off and in radians; and for a search by the
// objective itself how many rounds, and the length of its steps over those from afar.
constexpr double kFollowingRadius = 0.05, kFollowingFan = 0.02, kFollowingReach = 0.3;
constexpr int kFollowingRounds = 2;
// A result that loses or gains this much in a frame is no start: all is searched again.
constexpr double kMostLoss = 1.04, kMostGain = 0.96;

// A warp that gains less is not worth its sampling noise.
constexpr double kLeastGain = 0.02;

/// By more than rounding: of two that mirror each other the first is taken, wherever the world stands and
/// whatever its unit.
constexpr bool less(double a, double b) noexcept {
  constexpr double kTie = 1.0 - 1e-9;
  return a < b * kTie;
}

constexpr std::size_t kLanes = RowLanes::kCount;
// Half a right angle.
constexpr double kEighth = 0.7853981633974483;

/// A step of a search, as shares of its radius: along the fall-off and across it.
struct Step {
  double along, across;
};
// The middle, a ring of half the radius, and one of all of it.
constexpr std::array<Step, kLanes> kRings = {{{0.0, 0.0},
                                              {0.45, 0.217},
                                              {0.111, 0.487},
                                              {-0.312, 0.391},
                                              {-0.5, 0.0},
                                              {-0.312, -0.391},
                                              {0.111, -0.487},
                                              {0.45, -0.217},
                                              {1, 0},
                                              {0.707, 0.707},
                                              {0, 1},
                                              {-0.707, 0.707},
                                              {-1, 0},
                                              {-0.707, -0.707},
                                              {0, -1},
                                              {0.707, -0.707}}};

double length_of(const FallOff& f) noexcept {
  return std::sqrt(f.x * f.x + f.y * f.y);
}

/// The best of these fall-offs by the corners, each with the best of rows all round.
RowChoice best_start(RowSearch& search, const WarpInput& input) noexcept {
  // The best stretch over the body, as a share of its ratio of depths: what 200 random cameras took, at the
  // median.
  const double share = input.objective == Objective::p95 ? 0.65 : 0.55;
  const double ratio = search.ahead(share).y;
  const FallOff fit = input.light.perspective ? search.fitted() : FallOff{0.0, 0.35 * ratio};
  // Along the view, a third aside of it as the best rows are turned and their fall-off with them, and near
  // what pixels cover.
  const std::array<FallOff, kLanes> starts = {{{0.0, 0.0},
                                               {0.0, ratio},
                                               {0.0, 0.6 * ratio},
                                               {0.0, 1.4 * ratio},
                                               {0.0, 2.0 * ratio},
                                               {0.0, -0.5 * ratio},
                                               fit,
                                               {0.75 * fit.x, 0.75 * fit.y},
                                               {1.3 * fit.x, 1.3 * fit.y},
                                               {0.35 * ratio, 0.94 * ratio},
                                               {-0.35 * ratio, 0.94 * ratio},
                                               {0.6 * ratio, 0.6 * ratio},
                                               {-0.6 * ratio, 0.6 * ratio},
                                               {0.3 * ratio, 0.4 * ratio},
                                               {-0.3 * ratio, 0.4 * ratio},
                                               {0.2 * ratio, 1.2 * ratio}}};
  // Two fans of four from an edge of the image on, that meet in a right angle.
  constexpr double kCosine = 0.8314696123025452, kSine = 0.5555702330196022;  // of three sixteenths of pi
  RowLanes lanes;
  for (std::size_t l = 0; l < kLanes; ++l)
    lanes.set(l, {starts[l], {kCosine, kSine}, {-kSine, kCosine}, 0.0});
  search.find_rows(0.5 * kEighth, lanes);
  return lanes.best();
}

/// The best of sixteen fall-offs round `best`, or itself.
RowChoice best_around(RowSearch& search, const RowChoice& best, double radius, double fan) noexcept {
  const double length = length_of(best.fall_off);
  const double x = length > 0.0 ? best.fall_off.x / length : 0.0;
  const double y = length > 0.0 ? best.fall_off.y / length : 1.0;
  RowLanes lanes;
  for (std::size_t l = 0; l < kLanes; ++l) {
    const double along = kRings[l].along * radius, across = kRings[l].across * radius;
    const FallOff at{best.fall_off.x + along * x - across * y, best.fall_off.y + along * y + across * x};
    lanes.set(l, {at, best.row_a, best.row_b, 0.0});
  }
  search.find_rows(fan, lanes);
  const RowChoice found = lanes.best();
  return found.value < best.value ? found : best;
}

WarpChoice choose_optimal(const WarpInput& input) noexcept;

struct Judged {
  WarpChoice choice;
  double value;
};

/// The best of the registry's other warps where it is better than `best`.
void improve_by_others(const WarpInput& input, PlaneError& error, Judged& best) noexcept {
  std::array<WarpChoice, 2 * kWarpLanes> choice;
  std::array<double, 2 * kWarpLanes> value;
  std::size_t count = 0;
  for (const Warp* other : all_warps()) {
    if (other->choose == choose_optimal || count == choice.size()) continue;
    const WarpChoice found = other->choose(input);
    if (!input.is_unwarped(found)) choice[count++] = found;
  }
  error.count_bound();
  for (std::size_t first = 0; first < count; first += kWarpLanes) {
    ChoiceLanes lanes;
    LaneValues values;
    for (std::size_t i = 0; i < kWarpLanes; ++i) lanes.set(i, choice[first + i < count ? first + i : 0]);
    error.values(lanes, values);
    for (std::size_t i = 0; i < kWarpLanes && first + i < count; ++i) value[first + i] = values[i];
  }
  error.count_all();
  for (std::size_t i = 0; i < count; ++i) {
    if (!(value[i] < best.value)) continue;
    const double exact = error.value(choice[i]);
    if (less(exact, best.value) && usable(input.body, choice[i], input.most_stretch))
      best = {choice[i], exact};
  }
}

/// Where a search by the objective itself tries sixteen places at once: over the fall-off and how far both
/// rows lean. Steps along each of these numbers, steps along half of their diagonals, and on along the way
/// that was best in the last round.
class Polish {
 public:
  using At = std::array<double, 4>;
  /// `reach`: of the first steps, over what a search from afar takes.
  explicit Polish(double reach) noexcept {
    for (double& step : step_) step *= reach;
  }
  [[nodiscard]] std::array<At, kLanes> places(int round) const noexcept {
    constexpr double kDiagonal = 0.6, kOn = 1.0, kFarOn = 2.0;
    std::array<At, kLanes> places;
    places.fill(best_);
    for (std::size_t l = 0; l < 8; ++l) places[l][l / 2] += l % 2 == 0 ? step_[l / 2] : -step_[l / 2];
    for (std::size_t bits = 0; bits < 8; ++bits) {
      // The fourth sign is by the others: half of the diagonals, and the other half in the next round.
      const std::size_t fourth = bits ^ (bits >> 1) ^ (bits >> 2) ^ static_cast<std::size_t>(round);
      for (std::size_t i = 0; i < 4; ++i) {
        const bool plus = ((i < 3 ? bits >> i : fourth) & 1U) != 0;
        places[8 + bits][i] += (plus ? kDiagonal : -kDiagonal) * step_[i];
      }
    }
    if (round == 0) {
      places[0] = best_;
      return places;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      places[1][i] = best_[i] + kOn * way_[i];
      places[9][i] = best_[i] + kFarOn * way_[i];
    }
    return places;
  }
  void take(const std::array<At, kLanes>& places, const RowLanes& lanes) noexcept {
    constexpr double kShorter = 0.6;
    const std::size_t found = lanes.least();
    way_ = {};
    if (lanes.value[found] < least_ * RowLanes::kTie) {
      for (std::size_t i = 0; i < 4; ++i) way_[i] = places[found][i] - best_[i];
      best_ = places[found];
      least_ = lanes.value[found];
    }
    for (double& step : step_) step *= kShorter;
  }
  [[nodiscard]] const At& best() const noexcept { return best_; }

 private:
  At best_{}, way_{}, step_ = {0.2, 0.25, 0.125, 0.125};
  float least_ = std::numeric_limits<float>::infinity();
};

/// Fall-off and the rows' leaning from `start` on, by the objective at the samples near the worst.
Judged polished(RowSearch& search, PlaneError& error, const Judged& start, int rounds,
                double reach) noexcept {
  error.count_worst(start.choice);
  search.count(error.counted());
  error.count_all();
  const RowChoice from = search.rows_of(start.choice);
  const auto leaning = [](const glm::dvec2& row, double by) {
    return glm::dvec2(row.x - row.y * by, row.y + row.x * by);
  };
  const auto rows_at = [&](const Polish::At& at) {
    return RowChoice{{from.fall_off.x + at[0], from.fall_off.y + at[1]},
                     leaning(from.row_a, at[2]),
                     leaning(from.row_b, at[3]),
                     0.0};
  };
  Polish polish(reach);
  for (int round = 0; round < rounds; ++round) {
    const auto places = polish.places(round);
    RowLanes lanes;
    for (std::size_t l = 0; l < kLanes; ++l) lanes.set(l, rows_at(places[l]));
    search.find_values(lanes);
    polish.take(places, lanes);
  }
  const WarpChoice found = search.choice(rows_at(polish.best()));
  const Judged end{found, error.value(found)};
  // The start stays as it is, to the last bit.
  return less(end.value, start.value) ? end : start;
}

/// The best fall-off with its rows by the corners, and by storage then by all samples.
RowChoice searched(RowSearch& search, const PlaneError& error, const WarpInput& input) noexcept {
  RowChoice rows = best_start(search, input);
  double radius = max_of(0.2, 0.16 * length_of(rows.fall_off)), fan = 0.15;
  // A round that gains much goes on nearly as wide; one that gains little is the last.
  // Under a local light the starts are farther off.
  const int least_rounds = input.light.perspective ? 4 : 2;
  constexpr int kMostRounds = 6;
  constexpr double kMuch = 0.5, kLittle = 0.7;
  for (int round = 1; round <= kMostRounds; ++round) {
    const double before = rows.value;
    rows = best_around(search, rows, radius, fan);
    const bool gains_much = rows.value < kMuch * before;
    radius *= gains_much ? 0.8 : 0.45;
    fan *= gains_much ? 0.8 : 0.5;
    if (round >= least_rounds && !(rows.value < kLittle * before)) break;
  }
  if (input.objective != Objective::storage) return rows;
  search.count(error.counted());
  rows.value = std::numeric_limits<double>::infinity();
  return best_around(search, rows, radius, fan);
}

WarpChoice judged_choice(const WarpInput& input, const Judged& best, double without) noexcept {
  const bool gains = best.value < without * (1.0 - kLeastGain);
  WarpChoice choice = gains ? best.choice : input.unwarped;
  choice.gain_ratio = gains ? best.value / without : 1.0;
  return choice;
}

/// The best of a few places near `start`, or `start` itself.
Judged refined(RowSearch& search, PlaneError& error, const WarpInput& input, const Judged& start) noexcept {
  if (input.objective != Objective::storage)
    return polished(search, error, start, kFollowingRounds, kFollowingReach);
  error.count_worst(start.choice);
  search.count(error.counted());
  error.count_all();
  RowChoice rows = search.rows_of(start.choice);
  rows.value = std::numeric_limits<double>::infinity();
  const WarpChoice found = search.choice(best_around(search, rows, kFollowingRadius, kFollowingFan));
  const double value = error.value(found);
  return less(value, start.value) ? Judged{found, value} : start;
}

/// From the last frame's result on. False where that is no start, or no longer a good one.
bool follow(const WarpInput& input, PlaneError& error, WarpChoice& choice) noexcept {
  const WarpStart& start = *input.start;
  const double without = error.value(input.unwarped), expected = without * start.best.gain_ratio;
  Judged best{start.best, error.value(start.best)};
  if (start.moved) {
    RowSearch search(input, error);
    if (search.line()) return false;
    best = refined(search, error, input, best);
  }
  // Another body than in the last frame, for which another one may be better by far.
  if (!(best.value >= expected * kMostGain && best.value <= expected * kMostLoss)) return false;
  choice = judged_choice(input, best, without);
  choice.last_ratio =
      start.has_map ? error.value(start.map) / without : std::numeric_limits<double>::infinity();
  return true;
}

WarpChoice choose_optimal(const WarpInput& input) noexcept {
  if (input.flat() || !(input.y_max - input.y_min > 0.0)) return input.unwarped;
  PlaneError error(input, true);
  if (error.corners().count == 0) return input.unwarped;
  if (WarpChoice choice; input.start != nullptr && follow(input, error, choice)) return choice;
  RowSearch search(input, error);
  const double without = error.value(input.unwarped);
  Judged best{input.unwarped, without};
  if (!search.line()) {
    best.choice = search.choice(searched(search, error, input));
    best.value = error.value(best.choice);
  }
  improve_by_others(input, error, best);
  if (!search.line() && input.objective != Objective::storage) {
    // The corners only hint at a percentile, and their surrogate at the worst texel.
    constexpr int kWorst = 4, kPercentile = 3;
    best = polished(search, error, best, input.objective == Objective::p95 ? kPercentile : kWorst, 1.0);
  }
  return judged_choice(input, best, without);
}

}  // namespace

const Warp optimal{"optimal", "perspective along any axis, searched for the objective", choose_optimal, true,
                   true};

}  // namespace gnomon::warps
