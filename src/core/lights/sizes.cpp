// How many texels each light gets.
// Based on: Everett, "Generalized Lagrange Multiplier Method for Solving Problems of Optimum Allocation of
// Resources", 1963: what gains most per cost comes first.
#include "lights/sizes.hpp"

#include <algorithm>

namespace gnomon {
namespace {

void set_ratio(LightWork& light, const SizeLadder& ladder, double keep_gain) noexcept {
  const double gain =
      light.demand * (1.0 / ladder.inside(light.level) - 1.0 / ladder.inside(light.level + 1));
  const double cells =
      static_cast<double>(SizeLadder::cells(light.level + 1) - SizeLadder::cells(light.level));
  light.ratio = gain / (cells * light.maps) * (light.level + 1 <= light.last ? keep_gain : 1.0);
}

/// Less important; of equal ones the later.
bool behind(const LightWork& a, const LightWork& b) noexcept {
  return a.ratio != b.ratio ? a.ratio < b.ratio : a.light > b.light;
}

/// Raises levels up to `top` while cells are left, and returns what is left. The lights are in no order then.
std::int64_t raise(std::span<LightWork> lights, const SizeLadder& ladder, int top, std::int64_t cells,
                   double keep_gain) noexcept {
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
