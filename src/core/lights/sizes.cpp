// How many texels each light gets, and where the maps of all lights lie in the pool.
// Based on: Everett, "Generalized Lagrange Multiplier Method for Solving Problems of Optimum Allocation of
// Resources", 1963: what gains most per cost comes first.
// Samet, "The Quadtree and Related Hierarchical Data Structures", 1984; Knowlton, "A Fast Storage
// Allocator", 1965 (blocks of powers of two).
#include "lights/sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/z_order.hpp"

namespace gnomon {
namespace {

// Up to so many lights the best sizes are searched for: of few, one step may be a large part of the budget.
constexpr std::size_t kFewLights = 32;
// Sizes from 16 to 16384 texels.
constexpr int kMaxLevels = 11;
// Searches that take longer keep the best sizes found until then.
constexpr int kMaxTrials = 4096;

/// What a step counts: texels, or the time they take.
enum class StepUnit : std::uint8_t { cells, milliseconds };

/// How steps are ordered.
struct StepOrder {
  StepUnit unit = StepUnit::cells;
  double keep_gain = 1.0;
};

/// From a light's level to the next one.
struct Step {
  double ratio = 0.0, gain = 0.0;
  std::int64_t cells = 0;
  double milliseconds = 0.0;
  [[nodiscard]] double cost(StepUnit unit) const noexcept {
    return unit == StepUnit::cells ? static_cast<double>(cells) : milliseconds;
  }
  [[nodiscard]] bool fits(const SizeBudget& left) const noexcept {
    return cells <= left.cells && milliseconds <= left.milliseconds;
  }
};

SizeBudget without(SizeBudget left, const Step& step) noexcept {
  left.cells -= step.cells;
  left.milliseconds -= step.milliseconds;
  return left;
}

Step step_of(const LightWork& light, const SizeLadder& ladder, const StepOrder& order) noexcept {
  Step step;
  const double gain =
      light.demand * (1.0 / ladder.inside(light.level) - 1.0 / ladder.inside(light.level + 1));
  const std::int64_t squares = SizeLadder::cells(light.level + 1) - SizeLadder::cells(light.level);
  step.cells = light.maps * squares;
  step.milliseconds = light.price * static_cast<double>(squares);
  const double kept = light.level + 1 <= light.last ? order.keep_gain : 1.0;
  step.ratio = order.unit == StepUnit::cells ? gain / (static_cast<double>(squares) * light.maps) * kept
                                             : gain / step.milliseconds * kept;
  step.gain = step.ratio * step.cost(order.unit);
  return step;
}

/// The best levels of few lights: branch and bound, by what the remaining lights gain where a part of a step
/// can be taken.
class FewLights {
 public:
  FewLights(std::span<LightWork> lights, const SizeLadder& ladder, int top, const StepOrder& order) noexcept
      : lights_(lights), unit_(order.unit) {
    // Expensive lights first: they decide what is left for the others.
    std::sort(lights.begin(), lights.end(), [](const LightWork& a, const LightWork& b) {
      return a.demand * a.maps != b.demand * b.maps ? a.demand * a.maps > b.demand * b.maps
                                                    : a.light < b.light;
    });
    for (std::size_t i = 0; i < lights.size(); ++i) {
      LightWork at = lights[i];
      first_[i] = at.level;
      for (; at.level < std::min(top, at.top); ++at.level) {
        const Step step = step_of(at, ladder, order);
        if (!(step.ratio > 0.0)) break;
        steps_[step_count_++] = {step, i, at.level};
      }
      end_[i] = at.level;
    }
    std::sort(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(step_count_),
              [](const LightStep& a, const LightStep& b) {
                if (a.step.ratio != b.step.ratio) return a.step.ratio > b.step.ratio;
                return a.light != b.light ? a.light < b.light : a.level < b.level;
              });
    for (std::size_t i = 0; i < step_count_; ++i)
      of_light_[steps_[i].light][static_cast<std::size_t>(steps_[i].level - first_[steps_[i].light])] = i;
  }

  /// Raises the levels by steps of no more than the budget together.
  void search(const SizeBudget& budget) noexcept {
    for (std::size_t i = 0; i < lights_.size(); ++i) chosen_[i] = best_[i] = first_[i];
    choose_greedily(budget);
    visit(0, budget, 0.0);
    for (std::size_t i = 0; i < lights_.size(); ++i) lights_[i].level = best_[i];
  }

 private:
  // Sums of the same gains in another order are no better.
  static constexpr double kRounding = 1.0 + 1e-12;

  struct LightStep {
    Step step;
    std::size_t light = 0;
    int level = 0;  // before it
  };

  void choose_greedily(SizeBudget left) noexcept {
    best_gain_ = 0.0;
    for (std::size_t i = 0; i < step_count_; ++i) {
      const LightStep& next = steps_[i];
      if (best_[next.light] != next.level || !next.step.fits(left)) continue;
      left = without(left, next.step);
      ++best_[next.light];
      best_gain_ += next.step.gain;
    }
  }
  /// No levels of the lights from `light` on gain more.
  [[nodiscard]] double bound(std::size_t light, const SizeBudget& budget) const noexcept {
    double gain = 0.0,
           left = unit_ == StepUnit::cells ? static_cast<double>(budget.cells) : budget.milliseconds;
    for (std::size_t i = 0; i < step_count_; ++i) {
      const LightStep& next = steps_[i];
      if (next.light < light) continue;
      const double cost = next.step.cost(unit_);
      if (cost > left) return gain + next.step.ratio * left;
      left -= cost;
      gain += next.step.gain;
    }
    return gain;
  }
  void visit(std::size_t light, const SizeBudget& left, double gain) noexcept {
    if (light == lights_.size()) {
      if (gain <= best_gain_ * kRounding) return;
      best_gain_ = gain;
      best_ = chosen_;
      return;
    }
    struct Child {
      double bound, gain;
      SizeBudget left;
      int level;
    };
    std::array<Child, kMaxLevels> children;
    std::size_t count = 0;
    Child next{0.0, gain, left, first_[light]};
    for (;;) {
      next.bound = next.gain + bound(light + 1, next.left);
      children[count++] = next;
      const auto taken = static_cast<std::size_t>(next.level - first_[light]);
      if (next.level >= end_[light]) break;
      const Step& step = steps_[of_light_[light][taken]].step;
      if (!step.fits(next.left)) break;
      next = {0.0, next.gain + step.gain, without(next.left, step), next.level + 1};
    }
    // The most promising level first.
    for (std::size_t i = 1; i < count; ++i) {
      for (std::size_t k = i; k > 0 && children[k].bound > children[k - 1].bound; --k)
        std::swap(children[k], children[k - 1]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (!(children[i].bound > best_gain_ * kRounding) || ++trials_ > kMaxTrials) return;
      chosen_[light] = children[i].level;
      visit(light + 1, children[i].left, children[i].gain);
    }
  }

  std::span<LightWork> lights_;
  StepUnit unit_;
  std::array<LightStep, kFewLights * kMaxLevels> steps_;
  std::size_t step_count_ = 0;
  std::array<std::array<std::size_t, kMaxLevels>, kFewLights> of_light_;
  std::array<int, kFewLights> first_, end_, chosen_, best_;
  double best_gain_ = 0.0;
  int trials_ = 0;
};

/// Less important; of equal ones the later.
bool behind(const LightWork& a, const LightWork& b) noexcept {
  return a.ratio != b.ratio ? a.ratio < b.ratio : a.light > b.light;
}

std::int64_t cells_of(std::span<const LightWork> lights) noexcept {
  std::int64_t cells = 0;
  for (const LightWork& light : lights) cells += light.maps * SizeLadder::cells(light.level);
  return cells;
}

/// Raises levels up to `top` within the budget of all maps, by steps that gain something: no light without
/// demand grows. The lights are in no order then.
void raise(std::span<LightWork> lights, const SizeLadder& ladder, int top, const SizeBudget& budget,
           const StepOrder& order) noexcept {
  SizeBudget left{budget.cells - cells_of(lights), budget.milliseconds - milliseconds_of(lights)};
  if (lights.size() <= kFewLights) {
    FewLights(lights, ladder, top, order).search(left);
    return;
  }
  const auto first = lights.begin();
  auto end = first;
  for (LightWork& light : lights) {
    if (light.level >= std::min(top, light.top)) continue;
    light.ratio = step_of(light, ladder, order).ratio;
    if (light.ratio > 0.0) std::swap(light, *end++);
  }
  std::make_heap(first, end, behind);
  while (end != first) {
    std::pop_heap(first, end, behind);
    LightWork& light = *(end - 1);
    const Step step = step_of(light, ladder, order);
    if (!step.fits(left)) {
      --end;
      continue;
    }
    left = without(left, step);
    if (++light.level >= std::min(top, light.top)) {
      --end;
      continue;
    }
    light.ratio = step_of(light, ladder, order).ratio;
    if (light.ratio > 0.0)
      std::push_heap(first, end, behind);
    else
      --end;
  }
}

void choose(std::span<LightWork> lights, const SizeLadder& ladder, const SizeBudget& budget,
            const StepOrder& order) noexcept {
  // No light above the floor before all are at it: else more cells could take from one to lift another.
  for (LightWork& light : lights) light.level = ladder.floor;
  if (cells_of(lights) <= budget.cells && milliseconds_of(lights) <= budget.milliseconds)
    return raise(lights, ladder, ladder.top, budget, order);
  for (LightWork& light : lights) light.level = 0;
  raise(lights, ladder, ladder.floor, budget, order);
}

double error_of(std::span<const LightWork> lights, const SizeLadder& ladder) noexcept {
  double error = 0.0;
  for (const LightWork& light : lights) error += light.demand / ladder.inside(light.level);
  return error;
}

/// Within a budget of milliseconds, from the levels that a budget of cells alone leads to.
void choose_by_time(std::span<LightWork> lights, const SizeLadder& ladder, const SizeBudget& budget,
                    double keep_gain) noexcept {
  const bool priced =
      std::all_of(lights.begin(), lights.end(), [](const LightWork& l) { return l.price > 0.0; });
  const bool fits = milliseconds_of(lights) <= budget.milliseconds;
  if (!priced) return;  // texels take no time
  const double error = error_of(lights, ladder);
  for (LightWork& light : lights) light.other = light.level;
  choose(lights, ladder, budget, {StepUnit::milliseconds, keep_gain});
  if (!fits || error_of(lights, ladder) < error) return;
  for (LightWork& light : lights) light.level = light.other;
}

}  // namespace

double milliseconds_of(std::span<const LightWork> lights) noexcept {
  double sum = 0.0;
  for (const LightWork& light : lights)
    sum += light.fixed + light.price * static_cast<double>(SizeLadder::cells(light.level));
  return sum;
}

bool choose_sizes(std::span<LightWork> lights, const SizeLadder& ladder, const SizeBudget& budget,
                  double keep_gain) noexcept {
  for (LightWork& light : lights) light.level = 0;
  if (cells_of(lights) > budget.cells || milliseconds_of(lights) > budget.milliseconds) return false;
  choose(lights, ladder, {budget.cells}, {StepUnit::cells, keep_gain});
  if (std::isfinite(budget.milliseconds)) choose_by_time(lights, ladder, budget, keep_gain);
  std::sort(lights.begin(), lights.end(),
            [](const LightWork& a, const LightWork& b) { return a.light < b.light; });
  return true;
}

TexelRect PoolGrid::rectangle(std::uint32_t square, int level) const noexcept {
  const std::uint32_t cell = square >> (2 * top), inside = square & ((1u << (2 * top)) - 1u);
  const int column = static_cast<int>(cell) % columns, row = static_cast<int>(cell) / columns;
  const int side = least << level, cell_side = least << top;
  return {column * cell_side + static_cast<int>(gathered_bits(inside)) * least,
          row * cell_side + static_cast<int>(gathered_bits(inside >> 1)) * least, side, side};
}

void TakenRuns::add(std::uint32_t begin, std::uint32_t length) noexcept {
  runs_[count_++] = {begin, begin + length};
}

bool TakenRuns::sort(std::uint32_t squares) noexcept {
  std::sort(runs_.begin(), runs_.begin() + static_cast<std::ptrdiff_t>(count_),
            [](const LightPlace& a, const LightPlace& b) { return a.begin < b.begin; });
  std::uint32_t end = 0;
  for (const LightPlace& run : runs_.first(count_)) {
    if (run.begin < end || run.end < run.begin || run.end > squares) return false;
    end = run.end;
  }
  return true;
}

bool TakenRuns::take(Cursor& cursor, std::uint32_t length, std::uint32_t squares,
                     std::uint32_t& begin) noexcept {
  for (;;) {
    const std::uint32_t at = (cursor.at + length - 1) & ~(length - 1);
    while (cursor.run < count_ && runs_[cursor.run].end <= at) ++cursor.run;
    if (at > squares || squares - at < length) return false;
    cursor.at = at;
    if (cursor.run == count_ || runs_[cursor.run].begin >= at + length) break;
    cursor.at = runs_[cursor.run].end;
  }
  begin = cursor.at;
  cursor.at += length;
  // Runs that touch become one: in a pool filled in order there is only one.
  if (cursor.run > 0 && runs_[cursor.run - 1].end == begin) {
    runs_[cursor.run - 1].end = cursor.at;
    return true;
  }
  const auto place = runs_.begin() + static_cast<std::ptrdiff_t>(cursor.run);
  std::move_backward(place, runs_.begin() + static_cast<std::ptrdiff_t>(count_),
                     runs_.begin() + static_cast<std::ptrdiff_t>(count_ + 1));
  *place = {begin, cursor.at};
  ++count_;
  ++cursor.run;
  return true;
}

}  // namespace gnomon
