// The best projective map of the light plane for this body: fall-off and rows searched together.
// Based on: the error measure of Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006.
// The search is this project's: the fall-off's two numbers first, by the corners alone and with the best rows
// for each, then all four by the error itself, from there or from a warp of the registry that is better.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/vector.hpp"
#include "warp/plane_error.hpp"
#include "warp/plane_map.hpp"
#include "warp/row_search.hpp"

namespace gnomon::warps {
namespace {

// A warp that gains less is not worth its sampling noise.
constexpr double kLeastGain = 0.02;

/// By more than rounding: of two that mirror each other the first is taken, wherever the world stands and
/// whatever its unit.
constexpr bool less(double a, double b) noexcept {
  constexpr double kTie = 1.0 - 1e-9;
  return a < b * kTie;
}

/// What a simplex walks on: `Count` numbers, and the value there.
template <std::size_t Count, typename What>
struct Corner {
  std::array<double, Count> at;
  What what;
  [[nodiscard]] double value() const noexcept { return what.value; }
};

/// Nelder and Mead's simplex from `simplex`, so many evaluations of `look(position, nearest corner)`; the
/// best comes first.
template <std::size_t Count, typename What, typename Look>
void walk(std::array<Corner<Count, What>, Count + 1>& simplex, int evaluations, const Look& look) noexcept {
  using At = std::array<double, Count>;
  const auto mixed = [](const At& a, double by, const At& b, double with) {
    At p;
    for (std::size_t i = 0; i < Count; ++i) p[i] = a[i] * by + b[i] * with;
    return p;
  };
  const auto sort = [&] {
    for (std::size_t i = 1; i <= Count; ++i) {
      for (std::size_t k = i; k > 0 && less(simplex[k].value(), simplex[k - 1].value()); --k)
        std::swap(simplex[k], simplex[k - 1]);
    }
  };
  sort();
  while (evaluations > 0) {
    At centre{};
    for (std::size_t i = 0; i < Count; ++i) centre = mixed(centre, 1.0, simplex[i].at, 1.0 / Count);
    auto& worst = simplex[Count];
    const auto tried = [&](double reach) {
      --evaluations;
      const At p = mixed(centre, 1.0 + reach, worst.at, -reach);
      return Corner<Count, What>{p, look(p, simplex[0].what)};
    };
    const auto reflected = tried(1.0);
    if (less(reflected.value(), simplex[0].value())) {
      const auto expanded = tried(2.0);
      worst = less(expanded.value(), reflected.value()) ? expanded : reflected;
    } else if (less(reflected.value(), simplex[Count - 1].value())) {
      worst = reflected;
    } else {
      const auto contracted = tried(less(reflected.value(), worst.value()) ? 0.5 : -0.5);
      if (less(contracted.value(), worst.value())) {
        worst = contracted;
      } else {
        for (std::size_t i = 1; i <= Count; ++i) {
          const At p = mixed(simplex[0].at, 0.5, simplex[i].at, 0.5);
          simplex[i] = {p, look(p, simplex[0].what)};
          --evaluations;
        }
      }
    }
    sort();
  }
}

using FallOffCorner = Corner<2, RowChoice>;

double length_of(const FallOff& f) noexcept {
  return std::sqrt(f.x * f.x + f.y * f.y);
}

/// A simplex round `best`: steps along the fall-off and across it.
template <typename Look>
RowChoice walk_from(const RowChoice& best, double step, int evaluations, const Look& look) noexcept {
  const double length = length_of(best.fall_off);
  const double x = length > 0.0 ? best.fall_off.x / length : 0.0;
  const double y = length > 0.0 ? best.fall_off.y / length : 1.0;
  const std::array<double, 2> at{best.fall_off.x, best.fall_off.y};
  std::array<FallOffCorner, 3> simplex;
  simplex[0] = {at, best};
  const std::array<double, 2> along{at[0] + step * x, at[1] + step * y};
  const std::array<double, 2> across{at[0] - step * y, at[1] + step * x};
  simplex[1] = {along, look(along, best)};
  simplex[2] = {across, look(across, best)};
  walk<2>(simplex, evaluations - 2, look);
  return simplex[0].what;
}

/// The best of a few fall-offs by the corners, with its rows.
RowChoice best_start(RowSearch& search, const WarpInput& input) noexcept {
  // The best stretch over the body, as a share of its ratio of depths: what 200 random cameras took, at the
  // median.
  const double share = input.objective == Objective::p95 ? 0.65 : 0.55;
  const double ratio = search.ahead(share).y;
  // A third aside of the view: the best rows are turned, and their fall-off with them.
  constexpr double kAside = 0.35, kAhead = 0.94;
  const std::array<FallOff, 5> starts = {
      FallOff{0.0, ratio}, search.fitted(), FallOff{kAside * ratio, kAhead * ratio},
      FallOff{-kAside * ratio, kAhead * ratio}, FallOff{0.0, -0.5 * ratio}};
  RowChoice best = search.round({});
  for (const FallOff& start : starts) {
    const RowChoice rows = search.round(start);
    if (less(rows.value, best.value)) best = rows;
  }
  return best;
}

/// A place from there where no step is better by the corners.
RowChoice by_corners(RowSearch& search, RowChoice best) noexcept {
  const double length = length_of(best.fall_off);
  constexpr int kWideSteps = 3, kNarrowSteps = 5;
  best = walk_from(best, max_of(0.25, 0.2 * length), kWideSteps,
                   [&](const std::array<double, 2>& at, const RowChoice&) {
                     return search.round({at[0], at[1]});
                   });
  return walk_from(search.near(best.fall_off, best), max_of(0.12, 0.06 * length), kNarrowSteps,
                   [&](const std::array<double, 2>& at, const RowChoice& rows) {
                     return search.near({at[0], at[1]}, rows);
                   });
}

WarpChoice choose_optimal(const WarpInput& input) noexcept;

struct Judged {
  WarpChoice choice;
  double value;
};

/// The other warps of the registry, and what each comes to by a part of the samples.
class Others {
 public:
  Others(const WarpInput& input, PlaneError& error) noexcept : input_(input), error_(error) {
    choice_[count_++] = input.unwarped;
    for (const Warp* other : all_warps()) {
      if (other->choose == choose_optimal || count_ == choice_.size()) continue;
      const WarpChoice choice = other->choose(input);
      if (!input.is_unwarped(choice)) choice_[count_++] = choice;
    }
    error.count_some();
    for (std::size_t first = 0; first < count_; first += kWarpLanes) {
      ChoiceLanes lanes;
      LaneValues value;
      for (std::size_t i = 0; i < kWarpLanes; ++i) lanes.set(i, choice_[first + i < count_ ? first + i : 0]);
      error.values(lanes, value);
      for (std::size_t i = 0; i < kWarpLanes && first + i < count_; ++i) value_[first + i] = value[i];
    }
    error.count_all();
  }
  /// Takes the best of them where it is better than `best`, by all samples.
  void improve(Judged& best) noexcept {
    // Nearer than this, a part of the samples does not tell.
    constexpr double kNear = 1.3;
    for (std::size_t i = 1; i < count_; ++i) {
      if (!(value_[i] < best.value * kNear)) continue;
      const double value = error_.value(choice_[i]);
      value_[i] = std::numeric_limits<double>::infinity();
      if (less(value, best.value) && usable(input_.body, choice_[i], input_.most_stretch))
        best = {choice_[i], value};
    }
  }

 private:
  const WarpInput& input_;
  PlaneError& error_;
  std::array<WarpChoice, 2 * kWarpLanes> choice_;
  std::array<double, 2 * kWarpLanes> value_;
  std::size_t count_ = 0;
};

/// Fall-off and the rows' leaning, by the error itself.
Judged polished(RowSearch& search, PlaneError& error, const Judged& start, int evaluations) noexcept {
  struct Value {
    double value;
  };
  const RowChoice from = search.rows_of(start.choice);
  const auto leaning = [](const glm::dvec2& row, double by) {
    return glm::dvec2(row.x - row.y * by, row.y + row.x * by);
  };
  const auto choice_at = [&](const std::array<double, 4>& at) {
    RowChoice rows = from;
    rows.fall_off = {at[0], at[1]};
    rows.row_a = leaning(from.row_a, at[2]);
    rows.row_b = leaning(from.row_b, at[3]);
    return search.choice(rows);
  };
  const auto look = [&](const std::array<double, 4>& at, const Value&) {
    return Value{error.value(choice_at(at))};
  };
  error.count_worst(start.choice);
  constexpr std::array<double, 4> kStep = {0.08, -0.1, 0.05, 0.05};
  std::array<Corner<4, Value>, 5> simplex;
  const std::array<double, 4> at{from.fall_off.x, from.fall_off.y, 0.0, 0.0};
  simplex[0] = {at, {start.value}};
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<double, 4> p = at;
    p[i] += kStep[i];
    simplex[i + 1] = {p, look(p, {})};
  }
  walk<4>(simplex, evaluations - 4, look);
  error.count_all();
  const WarpChoice found = choice_at(simplex[0].at);
  const Judged end{found, error.value(found)};
  // The start stays as it is, to the last bit.
  return less(end.value, start.value) ? end : start;
}

WarpChoice choose_optimal(const WarpInput& input) noexcept {
  if (input.flat() || !(input.y_max - input.y_min > 0.0)) return input.unwarped;
  PlaneError error(input, true);
  if (error.corners().count == 0) return input.unwarped;
  RowSearch search(input, error);
  const double without = error.value(input.unwarped);
  Judged best{input.unwarped, without};
  // The corners only hint at a percentile: its walk is longer.
  const int steps = input.objective == Objective::p95 ? 18 : 14;
  if (!search.line()) {
    best.choice = search.choice(by_corners(search, best_start(search, input)));
    best.value = error.value(best.choice);
  }
  Others(input, error).improve(best);
  if (!search.line()) best = polished(search, error, best, steps);
  const bool gains = best.value < without * (1.0 - kLeastGain);
  WarpChoice choice = gains ? best.choice : input.unwarped;
  choice.gain_ratio = gains ? best.value / without : 1.0;
  return choice;
}

}  // namespace

const Warp optimal{"optimal", "perspective along any axis, searched for the objective", choose_optimal, true};

}  // namespace gnomon::warps
