// The best projective map of the light plane for a body: fall-off and rows searched together.
// Based on: the error measure of Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006.
// The search is this project's: fall-offs first, sixteen at a time, by the corners and with the best rows for
// each; then the four sides of the map's rectangle, by the samples near the worst; and a warp of the registry
// where that is better.
#include "warp/map_search.hpp"
#include "gnomon/extend/warp.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "geometry/vector.hpp"
#include "warp/best_choice.hpp"
#include "warp/plane_error.hpp"
#include "warp/plane_map.hpp"
#include "warp/registry.hpp"
#include "warp/row_search.hpp"
#include "warp/side_search.hpp"

namespace gnomon {
namespace {

// A result that loses or gains this much in a frame is no start: all is searched again.
constexpr double kMaxLoss = 1.04, kMaxGain = 0.96;

// A warp that gains less is not worth its sampling noise.
constexpr double kLeastGain = 0.02;

/// By more than rounding: of two that mirror each other the first is taken, wherever the world stands and
/// whatever its unit.
constexpr bool less(double a, double b) noexcept {
  constexpr double kTie = 1.0 - 1e-9;
  return a < b * kTie;
}

// Half a right angle.
constexpr double kEighth = 0.7853981633974483;

// Steps of a search, as shares of its radius, along the fall-off and across it: the middle, a ring of half
// the radius, and one of all of it.
constexpr FloatLanes kAlong = {0.0F, 0.45F,  0.111F, -0.312F, -0.5F, -0.312F, 0.111F, 0.45F,
                               1.0F, 0.707F, 0.0F,   -0.707F, -1.0F, -0.707F, 0.0F,   0.707F};
constexpr FloatLanes kAcross = {0.0F, 0.217F, 0.487F, 0.391F, 0.0F, -0.391F, -0.487F, -0.217F,
                                0.0F, 0.707F, 1.0F,   0.707F, 0.0F, -0.707F, -1.0F,   -0.707F};

double length_of(const FallOff& f) noexcept {
  return std::sqrt(f.x * f.x + f.y * f.y);
}

/// Fall-offs to begin at, as shares of one that goes by the ratio of depths.
struct Starts {
  FloatLanes x, y;
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

/// Fall-offs to begin at with their values by the corners, each with the best of rows all round.
RowLanes first_rows(RowSearch& search, const WarpInput& input) noexcept {
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
  for (std::size_t l = 0; l < kFloatLanes; ++l) {
    lanes.x[l] = starts.x[l] * ratio;
    lanes.y[l] = starts.y[l] * ratio;
  }
  if (local) {
    const FallOff fit = search.fitted();
    constexpr std::array<double, 3> kFits = {1.0, 0.75, 1.3};
    for (std::size_t i = 0; i < kFits.size(); ++i) {
      lanes.x[kFloatLanes - 1 - i] = static_cast<float>(kFits[i] * fit.x);
      lanes.y[kFloatLanes - 1 - i] = static_cast<float>(kFits[i] * fit.y);
    }
  }
  search.find_rows(0.5 * kEighth, lanes);
  return lanes;
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
  for (std::size_t l = 0; l < kFloatLanes; ++l) {
    lanes.x[l] = at_x + (kAlong[l] * along_x - kAcross[l] * along_y);
    lanes.y[l] = at_y + (kAlong[l] * along_y + kAcross[l] * along_x);
  }
  search.find_rows(fan, lanes);
  const RowChoice found = lanes.best();
  return found.value < best.value ? found : best;
}

/// The registry's other warps that are better than `value`, and usable.
OtherChoices others_below(const WarpInput& input, PlaneError& error, double value) noexcept {
  OtherChoices others;
  for (const Warp* other : all_warps()) {
    if (is_searched(*other) || others.count == others.judged.size()) continue;
    const WarpChoice found = other->choose(input);
    if (!input.is_unwarped(found)) others.judged[others.count++].choice = found;
  }
  if (others.count == 0) return others;
  ChoiceLanes lanes;
  for (std::size_t i = 0; i < kDoubleLanes; ++i) lanes.set(i, others.judged[i < others.count ? i : 0].choice);
  LaneAnswers better;
  error.count_bound();
  error.below(lanes, value, better);
  error.count_all();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < others.count; ++i) {
    const WarpChoice& choice = others.judged[i].choice;
    if (!better[i] || !usable(input.body, choice, input.most_stretch)) continue;
    const double exact = error.value(choice);
    if (exact < value) others.judged[kept++] = {choice, exact};
  }
  others.count = kept;
  return others;
}

/// The best of the registry's other warps where it is better than `best`; false where none is.
bool improve_by_others(const OtherChoices& others, Judged& best) noexcept {
  bool improved = false;
  for (std::size_t i = 0; i < others.count; ++i) {
    if (!less(others.judged[i].value, best.value)) continue;
    best = others.judged[i];
    improved = true;
  }
  return improved;
}

/// Ways to turn four sides, as factors of each.
using Ways = std::array<std::array<float, 4>, 4>;
// Storage is a product of what each pair of opposite sides does. The worst texel depends on both pairs at
// once.
constexpr Ways kByPairs = {{{1.0F, 1.0F, 0.0F, 0.0F},
                            {1.0F, -1.0F, 0.0F, 0.0F},
                            {0.0F, 0.0F, 1.0F, 1.0F},
                            {0.0F, 0.0F, 1.0F, -1.0F}}};
constexpr Ways kByFours = {{{1.0F, 1.0F, 1.0F, 1.0F},
                            {1.0F, -1.0F, 1.0F, -1.0F},
                            {1.0F, 1.0F, -1.0F, -1.0F},
                            {1.0F, -1.0F, -1.0F, 1.0F}}};

/// Along each of four ways, as shares of its step, where sixteen candidates are: on both sides along each
/// way, and on half of the diagonals; on the other half in the next round.
using Pattern = std::array<FloatLanes, 4>;
constexpr std::array<Pattern, 2> patterns() noexcept {
  constexpr float kDiagonal = 0.6F;
  std::array<Pattern, 2> result{};
  for (std::size_t round = 0; round < 2; ++round) {
    for (std::size_t way = 0; way < 4; ++way) {
      result[round][way][2 * way] = 1.0F;
      result[round][way][2 * way + 1] = -1.0F;
    }
    for (std::size_t bits = 0; bits < 8; ++bits) {
      // The fourth sign is by the others.
      const std::size_t fourth = bits ^ (bits >> 1) ^ (bits >> 2) ^ round;
      for (std::size_t way = 0; way < 4; ++way) {
        const bool plus = ((way < 3 ? bits >> way : fourth) & 1U) != 0;
        result[round][way][8 + bits] = plus ? kDiagonal : -kDiagonal;
      }
    }
  }
  return result;
}
constexpr std::array<Pattern, 2> kPatterns = patterns();

struct TurnedSides {
  Sides sides;
  double gain;  // of the samples that count: their value over what it was
};

/// Turns the sides of a search's map to where the error is least, from the map as it is on. In each round the
/// best of sixteen candidates is taken where it is better than before.
TurnedSides turned_sides(const SideSearch& search, const Ways& ways, int rounds, float first_step) noexcept {
  // Steps that were taken grow by a fifth; others shrink.
  constexpr float kOn = 1.2F, kCloser = 0.6F, kNone = 0.5F, kFarOn = 2.0F;
  // Candidates, in the places of two of the diagonals: where the sides are, or on along the last move, and
  // farther on.
  constexpr std::size_t kAgain = 8, kFarther = 15;
  Sides sides;
  std::array<float, 4> step, last{};
  step.fill(first_step);
  // A search whose square still falls by a twentieth in two rounds goes on, up to so many times as long.
  constexpr float kMuch = 0.95F;
  constexpr int kLonger = 3;
  float least = std::numeric_limits<float>::infinity(), first = least, one_ago = least, two_ago = least;
  for (int round = 0; round < rounds || (round < kLonger * rounds && least < kMuch * two_ago); ++round) {
    Pattern move = kPatterns[static_cast<std::size_t>(round % 2)];
    for (std::size_t way = 0; way < 4; ++way) {
      for (std::size_t l = 0; l < kFloatLanes; ++l) move[way][l] *= step[way];
      move[way][kAgain] = last[way];
      if (round > 0) move[way][kFarther] = kFarOn * last[way];
    }
    SideLanes lanes;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t l = 0; l < kFloatLanes; ++l)
        lanes.turn[k][l] = (ways[0][k] * move[0][l] + ways[1][k] * move[1][l]) +
                           (ways[2][k] * move[2][l] + ways[3][k] * move[3][l]);
    }
    search.find_values(sides, lanes);
    if (round == 0) first = lanes.value[kAgain];
    const std::size_t found = lanes.least();
    const bool better = lanes.value[found] < least * kSingleTie;
    const bool stays = !better || (round == 0 && found == kAgain);
    for (std::size_t way = 0; way < 4; ++way) {
      last[way] = better ? move[way][found] : 0.0F;
      step[way] *= stays ? kNone : std::abs(last[way]) > 0.5F * step[way] ? kOn : kCloser;
    }
    two_ago = one_ago;
    one_ago = least;
    if (!better) continue;
    least = lanes.value[found];
    sides = lanes.at(found);
  }
  const bool known = first > 0.0F && first < std::numeric_limits<float>::infinity();
  return {sides, known ? std::sqrt(static_cast<double>(least / first)) : 1.0};
}

/// `start` with its sides turned, or as it is, to the last bit.
Judged turned(const WarpInput& input, PlaneError& error, const Judged& start, int rounds,
              float step) noexcept {
  if (!(start.value < std::numeric_limits<double>::infinity())) return start;
  constexpr double kAsExpected = 1.02;
  const Ways& ways = input.objective == Objective::storage ? kByPairs : kByFours;
  Judged best = start;
  // By the samples near the worst; again by all where another sample came to be the worst.
  for (const bool all : {false, true}) {
    if (!all) error.count_worst(start.choice);
    const SideSearch search(input, error, best.choice);
    error.count_all();
    const TurnedSides found = turned_sides(search, ways, rounds, step);
    const double expected = best.value * found.gain;
    const WarpChoice choice = search.choice(found.sides);
    const double value = error.value(choice);
    if (less(value, best.value) && usable(input.body, choice, input.most_stretch)) best = {choice, value};
    if (value <= expected * kAsExpected) break;
  }
  return best;
}

// Of a search's first steps, in radians of the image; and where the last frame's result is the start.
constexpr float kStep = 0.1F, kFollowingStep = 0.03F;
constexpr int kFollowingRounds = 2, kThoroughRounds = 16;
// Those of a percentile take the longest, and those of storage the least.
constexpr int quick_rounds(Objective objective) noexcept {
  constexpr std::array<int, 4> kRounds = {8, 7, 4, 8};
  return kRounds[static_cast<std::size_t>(objective)];
}

/// The best start. Out of line, as the eight below: what turns its sides need not make room for the search.
[[gnu::noinline]] Judged best_start(const WarpInput& input, const PlaneError& error) noexcept {
  RowSearch search(input, error);
  constexpr double kRadius = 0.16, kLeastRadius = 0.2, kFan = 0.15;
  RowChoice rows = first_rows(search, input).best();
  rows = best_around(search, rows, max_of(kLeastRadius, kRadius * length_of(rows.fall_off)), kFan);
  const WarpChoice choice = search.choice(rows);
  return {choice, error.value(choice)};
}

/// From the best start on.
Judged quick_search(const WarpInput& input, PlaneError& error) noexcept {
  return turned(input, error, best_start(input, error), quick_rounds(input.objective), kStep);
}

/// The better ones first; those that are alike stay in order.
void sort(std::array<Judged, kFloatLanes>& maps) noexcept {
  for (std::size_t i = 1; i < maps.size(); ++i) {
    const Judged next = maps[i];
    std::size_t k = i;
    for (; k > 0 && less(next.value, maps[k - 1].value); --k) maps[k] = maps[k - 1];
    maps[k] = next;
  }
}

[[gnu::noinline]] void find_starts(const WarpInput& input, const PlaneError& error,
                                   std::array<Judged, kFloatLanes>& starts) noexcept {
  RowSearch search(input, error);
  const RowLanes first = first_rows(search, input);
  for (std::size_t l = 0; l < kFloatLanes; ++l) {
    starts[l].choice = search.choice(first.at(l));
    starts[l].value = error.value(starts[l].choice);
  }
}

/// From eight starts on, and longer from those that come to more.
[[gnu::noinline]] Judged thorough_search(const WarpInput& input, PlaneError& error) noexcept {
  struct Level {
    std::size_t starts;
    int rounds;
    float step;
  };
  constexpr std::array<Level, 4> kLevels = {{{8, 3, 0.2F}, {4, 6, 0.1F}, {2, 10, 0.05F}, {1, 16, 0.05F}}};
  std::array<Judged, kFloatLanes> best;
  find_starts(input, error, best);
  for (const Level& level : kLevels) {
    sort(best);
    for (std::size_t i = 0; i < level.starts; ++i)
      best[i] = turned(input, error, best[i], level.rounds, level.step);
  }
  return best[0];
}

WarpChoice judged_choice(const WarpInput& input, const Judged& best, double without) noexcept {
  const bool gains = best.value < without * (1.0 - kLeastGain);
  WarpChoice choice = gains ? best.choice : input.unwarped;
  choice.gain_ratio = gains ? best.value / without : 1.0;
  return choice;
}

/// What the last frame drew: WarpChoice::last_ratio.
double last_ratio(const WarpInput& input, const PlaneError& error, double without) noexcept {
  if (input.start == nullptr) return 0.0;
  const WarpStart& start = *input.start;
  return start.has_map ? error.value(start.map) / without : std::numeric_limits<double>::infinity();
}

/// From the last frame's result on. False where that is no start, or no longer a good one.
bool follow(const WarpInput& input, PlaneError& error, double without, WarpChoice& choice) noexcept {
  const WarpStart& start = *input.start;
  const double expected = without * start.best.gain_ratio;
  Judged best{start.best, error.value(start.best)};
  // Another body than in the last frame, for which another one may be better by far.
  if (!(best.value >= expected * kMaxGain && best.value <= expected * kMaxLoss)) return false;
  if (weaken(best.choice, plane_map(input.body, best.choice), input.most_stretch))
    best.value = error.value(best.choice);
  if (start.use == StartUse::search) {
    if (is_line(input, error.body())) return false;
    best = turned(input, error, best, kFollowingRounds, kFollowingStep);
  }
  choice = judged_choice(input, best, without);
  choice.followed = true;
  return true;
}

/// The last frame's result as it is.
WarpChoice kept(const WarpInput& input) noexcept {
  const WarpChoice& best = input.start->best;
  WarpChoice choice = best.gain_ratio < 1.0 ? best : input.unwarped;
  choice.gain_ratio = best.gain_ratio;
  choice.last_ratio = best.last_ratio;
  choice.followed = true;
  return choice;
}

}  // namespace

WarpChoice search_map(const WarpInput& given, SearchEffort effort) noexcept {
  if (given.flat() || !(given.y_max - given.y_min > 0.0)) return given.unwarped;
  const StartUse use = given.start != nullptr ? given.start->use : StartUse::none;
  if (use == StartUse::keep) return kept(given);
  WarpInput input = given;
  if (given.start != nullptr) input.most_stretch = min_of(given.most_stretch, given.start->most_stretch);
  PlaneError error(input, true);
  if (error.corner_count() == 0) return input.unwarped;
  const double without = error.value(input.unwarped);
  const double last = last_ratio(input, error, without);
  WarpChoice choice;
  if (use == StartUse::none || !follow(input, error, without, choice)) {
    Judged best{input.unwarped, without};
    const bool quick = effort == SearchEffort::quick, line = is_line(input, error.body());
    if (!line) best = quick ? quick_search(input, error) : thorough_search(input, error);
    // After the search: a warp that is better than a start is often no better to start from. Others that are
    // nearly as good may be better at other points.
    const double nearly = min_of(best.value * nearly_as_good(input, error), without);
    const OtherChoices others = others_below(input, error, max_of(best.value, nearly));
    if (improve_by_others(others, best) && !line)
      best = turned(input, error, best, quick ? quick_rounds(input.objective) : kThoroughRounds, kStep);
    best = best_choice(input, error, best, others);
    choice = judged_choice(input, best, without);
  }
  choice.last_ratio = last;
  return choice;
}

}  // namespace gnomon
