// How many texels each light gets.
// Based on: Everett, "Generalized Lagrange Multiplier Method for Solving Problems of Optimum Allocation of
// Resources", 1963: what gains most per cost comes first.
#include "lights/sizes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace gnomon {
namespace {

// Up to so many lights the best sizes are searched for: of few, one step may be a large part of the budget.
constexpr std::size_t kFewLights = 32;
// Sizes from 16 to 16384 texels.
constexpr int kMostLevels = 11;
// Searches that take longer keep the best sizes found until then.
constexpr int kMostTrials = 4096;

void set_ratio(LightWork& light, const SizeLadder& ladder, double keep_gain) noexcept {
  const double gain =
      light.demand * (1.0 / ladder.inside(light.level) - 1.0 / ladder.inside(light.level + 1));
  const double cells =
      static_cast<double>(SizeLadder::cells(light.level + 1) - SizeLadder::cells(light.level));
  light.ratio = gain / (cells * light.maps) * (light.level + 1 <= light.last ? keep_gain : 1.0);
}

/// The best levels of few lights: branch and bound, by what the remaining lights gain where a part of a step
/// can be taken.
class FewLights {
 public:
  FewLights(std::span<LightWork> lights, const SizeLadder& ladder, int top, double keep_gain) noexcept
      : lights_(lights) {
    // Expensive lights first: they decide what is left for the others.
    std::sort(lights.begin(), lights.end(), [](const LightWork& a, const LightWork& b) {
      return a.demand * a.maps != b.demand * b.maps ? a.demand * a.maps > b.demand * b.maps
                                                    : a.light < b.light;
    });
    for (std::size_t i = 0; i < lights.size(); ++i) {
      LightWork at = lights[i];
      first_[i] = at.level;
      for (; at.level < std::min(top, at.top); ++at.level) {
        set_ratio(at, ladder, keep_gain);
        const std::int64_t cost = at.maps * (SizeLadder::cells(at.level + 1) - SizeLadder::cells(at.level));
        steps_[step_count_++] = {at.ratio, at.ratio * static_cast<double>(cost), cost, i, at.level};
      }
      end_[i] = at.level;
    }
    std::sort(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(step_count_),
              [](const Step& a, const Step& b) {
                if (a.ratio != b.ratio) return a.ratio > b.ratio;
                return a.light != b.light ? a.light < b.light : a.level < b.level;
              });
    for (std::size_t i = 0; i < step_count_; ++i)
      of_light_[steps_[i].light][static_cast<std::size_t>(steps_[i].level - first_[steps_[i].light])] = i;
  }

  /// Raises the levels by steps of no more than `cells` together.
  void search(std::int64_t cells) noexcept {
    for (std::size_t i = 0; i < lights_.size(); ++i) chosen_[i] = best_[i] = first_[i];
    take_greedily(cells);
    visit(0, cells, 0.0);
    for (std::size_t i = 0; i < lights_.size(); ++i) lights_[i].level = best_[i];
  }

 private:
  struct Step {
    double ratio, gain;
    std::int64_t cost;
    std::size_t light;
    int level;  // before it
  };

  void take_greedily(std::int64_t cells) noexcept {
    best_gain_ = 0.0;
    for (std::size_t i = 0; i < step_count_; ++i) {
      const Step& step = steps_[i];
      if (best_[step.light] != step.level || step.cost > cells) continue;
      cells -= step.cost;
      ++best_[step.light];
      best_gain_ += step.gain;
    }
  }
  /// No levels of the lights from `light` on gain more.
  [[nodiscard]] double bound(std::size_t light, std::int64_t cells) const noexcept {
    double gain = 0.0;
    for (std::size_t i = 0; i < step_count_; ++i) {
      const Step& step = steps_[i];
      if (step.light < light) continue;
      if (step.cost > cells) return gain + step.ratio * static_cast<double>(cells);
      cells -= step.cost;
      gain += step.gain;
    }
    return gain;
  }
  void visit(std::size_t light, std::int64_t cells, double gain) noexcept {
    if (light == lights_.size()) {
      if (gain <= best_gain_) return;
      best_gain_ = gain;
      best_ = chosen_;
      return;
    }
    struct Child {
      double bound, gain;
      std::int64_t cells;
      int level;
    };
    std::array<Child, kMostLevels> children;
    std::size_t count = 0;
    Child next{0.0, gain, cells, first_[light]};
    for (;;) {
      next.bound = next.gain + bound(light + 1, next.cells);
      children[count++] = next;
      const auto taken = static_cast<std::size_t>(next.level - first_[light]);
      if (next.level >= end_[light]) break;
      const Step& step = steps_[of_light_[light][taken]];
      if (step.cost > next.cells) break;
      next = {0.0, next.gain + step.gain, next.cells - step.cost, next.level + 1};
    }
    // The most promising level first.
    for (std::size_t i = 1; i < count; ++i) {
      for (std::size_t k = i; k > 0 && children[k].bound > children[k - 1].bound; --k)
        std::swap(children[k], children[k - 1]);
    }
    // Sums of the same gains in another order are no better.
    constexpr double kRounding = 1.0 + 1e-12;
    for (std::size_t i = 0; i < count; ++i) {
      if (!(children[i].bound > best_gain_ * kRounding) || ++trials_ > kMostTrials) return;
      chosen_[light] = children[i].level;
      visit(light + 1, children[i].cells, children[i].gain);
    }
  }

  std::span<LightWork> lights_;
  std::array<Step, kFewLights * kMostLevels> steps_;
  std::size_t step_count_ = 0;
  std::array<std::array<std::size_t, kMostLevels>, kFewLights> of_light_;
  std::array<int, kFewLights> first_, end_, chosen_, best_;
  double best_gain_ = 0.0;
  int trials_ = 0;
};

/// Less important; of equal ones the later.
bool behind(const LightWork& a, const LightWork& b) noexcept {
  return a.ratio != b.ratio ? a.ratio < b.ratio : a.light > b.light;
}

/// Raises levels up to `top` while cells are left, and returns what is left. The lights are in no order then.
std::int64_t raise(std::span<LightWork> lights, const SizeLadder& ladder, int top, std::int64_t cells,
                   double keep_gain) noexcept {
  if (lights.size() <= kFewLights) {
    std::int64_t before = 0, after = 0;
    for (const LightWork& light : lights) before += light.maps * SizeLadder::cells(light.level);
    FewLights(lights, ladder, top, keep_gain).search(cells);
    for (const LightWork& light : lights) after += light.maps * SizeLadder::cells(light.level);
    return cells - (after - before);
  }
  const auto first = lights.begin();
  auto end = first;
  for (LightWork& light : lights) {
    if (light.level >= std::min(top, light.top)) continue;
    set_ratio(light, ladder, keep_gain);
    std::swap(light, *end++);
  }
  std::make_heap(first, end, behind);
  while (end != first) {
    std::pop_heap(first, end, behind);
    LightWork& light = *(end - 1);
    const std::int64_t cost =
        light.maps * (SizeLadder::cells(light.level + 1) - SizeLadder::cells(light.level));
    if (cost > cells) {
      --end;
      continue;
    }
    cells -= cost;
    if (++light.level >= std::min(top, light.top)) {
      --end;
      continue;
    }
    set_ratio(light, ladder, keep_gain);
    std::push_heap(first, end, behind);
  }
  return cells;
}

}  // namespace

bool choose_sizes(std::span<LightWork> lights, const SizeLadder& ladder, std::int64_t cells,
                  double keep_gain) noexcept {
  for (LightWork& light : lights) {
    light.level = 0;
    cells -= light.maps;
  }
  if (cells < 0) return false;
  // No light above the floor before all are at it: else more cells could take from one to lift another.
  cells = raise(lights, ladder, ladder.floor, cells, keep_gain);
  const bool all = std::all_of(lights.begin(), lights.end(), [&](const LightWork& light) {
    return light.level >= std::min(ladder.floor, light.top);
  });
  if (all) raise(lights, ladder, ladder.top, cells, keep_gain);
  std::sort(lights.begin(), lights.end(),
            [](const LightWork& a, const LightWork& b) { return a.light < b.light; });
  return true;
}

}  // namespace gnomon
