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

// Steps of a search, as shares of its radius, along the fall-off and across it: the middle, a ring of half
// the radius, and one of all of it.
constexpr RowLanes::Numbers kAlong = {0.0F, 0.45F,  0.111F, -0.312F, -0.5F, -0.312F, 0.111F, 0.45F,
                                      1.0F, 0.707F, 0.0F,   -0.707F, -1.0F, -0.707F, 0.0F,   0.707F};
constexpr RowLanes::Numbers kAcross = {0.0F, 0.217F, 0.487F, 0.391F, 0.0F, -0.391F, -0.487F, -0.217F,
                                       0.0F, 0.707F, 1.0F,   0.707F, 0.0F, -0.707F, -1.0F,   -0.707F};

double length_of(const FallOff& f) noexcept {
  return std::sqrt(f.x * f.x + f.y * f.y);
}

/// Fall-offs to begin at, as shares of one that goes by the ratio of depths.
struct Starts {
  RowLanes::Numbers x, y;
};
// Along the view, and a third aside of it as the best rows are turned and their fall-off with them.
constexpr Starts kParallelStarts = {
    {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.35F, -0.35F, 0.6F, -0.6F, 0.3F, -0.3F, 0.2F},
    {0.0F, 1.0F, 0.6F, 1.4F, 2.0F, -0.5F, 0.35F, 0.2625F, 0.455F, 0.94F, 0.94F, 0.6F, 0.6F, 0.4F, 0.4F,
     1.2F}};
// Those that together come nearest to the best of many (bench_starts), beside what pixels cover, which takes
// the last three places.
constexpr Starts kLocalByStorage = {{0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.141F, -0.141F, 0.173F, -0.173F, 0.135F,
                                     -0.135F, 0.031F, -0.031F, 0.0F, 0.0F, 0.0F},
                                    {0.0F, 0.52F, 0.12F, -0.12F, -0.2F, 0.141F, 0.141F, -0.1F, -0.1F, 0.502F,
                                     0.502F, 0.116F, 0.116F, 0.0F, 0.0F, 0.0F}};
constexpr Starts kLocalByWorst = {{0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.242F, -0.242F, 0.116F, -0.116F, 0.085F,
                                   -0.085F, 0.135F, -0.135F, 0.0F, 0.0F, 0.0F},
                                  {0.0F, 0.6F, 0.12F, -0.2F, -0.44F, -0.14F, -0.14F, -0.031F, -0.031F, 0.085F,
                                   0.085F, 0.502F, 0.502F, 0.0F, 0.0F, 0.0F}};

/// The best of these fall-offs by the corners, each with the best of rows all round.
RowChoice best_start(RowSearch& search, const WarpInput& input) noexcept {
  const bool local = input.light.perspective;
  // The best stretch over the body, as a share of its ratio of depths: what 200 random cameras took, at the
  // median.
  const double share = local ? 1.0 : input.objective == Objective::p95 ? 0.65 : 0.55;
  const auto ratio = static_cast<float>(search.ahead(share).y);
  const Starts& local_starts = input.objective == Objective::storage ? kLocalByStorage : kLocalByWorst;
  const Starts& starts = local ? local_starts : kParallelStarts;
  // Two fans of four from an edge of the image on, that meet in a right angle.
  constexpr double kCosine = 0.8314696123025452, kSine = 0.5555702330196022;  // of three sixteenths of pi
  RowLanes lanes;
  lanes.fill({{}, {kCosine, kSine}, {-kSine, kCosine}, 0.0});
  for (std::size_t l = 0; l < kLanes; ++l) {
    lanes.x[l] = starts.x[l] * ratio;
    lanes.y[l] = starts.y[l] * ratio;
  }
  if (local) {
    const FallOff fit = search.fitted();
    constexpr std::array<double, 3> kFits = {1.0, 0.75, 1.3};
    for (std::size_t i = 0; i < kFits.size(); ++i) {
      lanes.x[kLanes - 1 - i] = static_cast<float>(kFits[i] * fit.x);
      lanes.y[kLanes - 1 - i] = static_cast<float>(kFits[i] * fit.y);
    }
  }
  search.find_rows(0.5 * kEighth, lanes);
  return lanes.best();
}

/// The best of sixteen fall-offs round `best`, or itself.
RowChoice best_around(RowSearch& search, const RowChoice& best, double radius, double fan) noexcept {
  const double length = length_of(best.fall_off);
  const double x = length > 0.0 ? best.fall_off.x / length : 0.0;
  const double y = length > 0.0 ? best.fall_off.y / length : 1.0;
  const auto along_x = static_cast<float>(x * radius), along_y = static_cast<float>(y * radius);
  const auto at_x = static_cast<float>(best.fall_off.x), at_y = static_cast<float>(best.fall_off.y);
  RowLanes lanes;
  lanes.fill(best);
  for (std::size_t l = 0; l < kLanes; ++l) {
    lanes.x[l] = at_x + (kAlong[l] * along_x - kAcross[l] * along_y);
    lanes.y[l] = at_y + (kAlong[l] * along_y + kAcross[l] * along_x);
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
  std::array<WarpChoice, kWarpLanes> choice;
  std::size_t count = 0;
  for (const Warp* other : all_warps()) {
    if (other->choose == choose_optimal || count == choice.size()) continue;
    const WarpChoice found = other->choose(input);
    if (!input.is_unwarped(found)) choice[count++] = found;
  }
  if (count == 0) return;
  ChoiceLanes lanes;
  for (std::size_t i = 0; i < kWarpLanes; ++i) lanes.set(i, choice[i < count ? i : 0]);
  LaneAnswers better;
  error.count_bound();
  error.below(lanes, best.value, better);
  error.count_all();
  for (std::size_t i = 0; i < count; ++i) {
    if (!better[i]) continue;
    const double exact = error.value(choice[i]);
    if (less(exact, best.value) && usable(input.body, choice[i], input.most_stretch))
      best = {choice[i], exact};
  }
}

/// From now on the search counts the samples near the worst under `choice`.
void count_near_worst(RowSearch& search, PlaneError& error, const WarpChoice& choice) noexcept {
  error.count_worst(choice);
  search.count(error.counted());
  error.count_all();
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
  count_near_worst(search, error, start.choice);
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

/// The best fall-off with its rows, from the best start on: by the samples, or, where the corners' surrogate
/// only hints at the objective, by the corners.
RowChoice searched(RowSearch& search, PlaneError& error, const WarpInput& input) noexcept {
  RowChoice rows = best_start(search, input);
  double radius = max_of(0.2, 0.16 * length_of(rows.fall_off)), fan = 0.15;
  const bool storage = input.objective == Objective::storage;
  if (storage) {
    count_near_worst(search, error, search.choice(rows));
    rows.value = std::numeric_limits<double>::infinity();
  }
  // A round that gains much goes on nearly as wide; one that gains little is the last.
  // Under a local light the starts are farther off.
  constexpr int kByStorage = 3, kLocal = 4, kWorst = 2, kPercentile = 1, kMostRounds = 6;
  const int least_rounds = storage                             ? kByStorage
                           : input.light.perspective           ? kLocal
                           : input.objective == Objective::p95 ? kPercentile
                                                               : kWorst;
  constexpr double kMuch = 0.5, kLittle = 0.7, kNearlyAsWide = 0.8, kCloser = 0.45, kFanCloser = 0.5;
  for (int round = 1; round <= kMostRounds; ++round) {
    const double before = rows.value;
    rows = best_around(search, rows, radius, fan);
    const bool gains_much = std::isfinite(before) && rows.value < kMuch * before;
    radius *= gains_much ? kNearlyAsWide : kCloser;
    fan *= gains_much ? kNearlyAsWide : kFanCloser;
    if (round >= least_rounds && !(rows.value < kLittle * before)) break;
  }
  return rows;
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
  count_near_worst(search, error, start.choice);
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
  if (start.search) {
    RowSearch search(input, error);
    if (search.line()) return false;
    best = refined(search, error, input, best);
  }
  // Another body than in the last frame, for which another one may be better by far.
  if (!(best.value >= expected * kMostGain && best.value <= expected * kMostLoss)) return false;
  choice = judged_choice(input, best, without);
  choice.last_ratio =
      start.has_map ? error.value(start.map) / without : std::numeric_limits<double>::infinity();
  // By the other objectives vertices tell as well, and sooner.
  if (start.has_map && input.objective == Objective::p95) {
    WarpChoice held = choice;
    held.kappa = min_of(held.kappa, start.limit.strongest(plane_map(input.body, choice).length));
    if (held.kappa < choice.kappa) choice.held_ratio = error.value(held) / without;
  }
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
    constexpr int kRounds = 4;
    best = polished(search, error, best, kRounds, 1.0);
  }
  return judged_choice(input, best, without);
}

}  // namespace

const Warp optimal{"optimal", "perspective along any axis, searched for the objective", choose_optimal, true,
                   true};

}  // namespace gnomon::warps
