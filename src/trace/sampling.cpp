// Points spread evenly over a kernel or a light's disc, and work spread over the processor's cores.
// Based on: Shirley, Chiu, A Low Distortion Map Between Disk and Square, 1997.
#include "sampling.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

namespace gnomon::trace {
namespace {

/// A hash with full avalanche (Wellons' lowbias32), as a number in [0,1).
double hashed(std::uint32_t x) noexcept {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x / 4294967296.0;
}

glm::dvec2 to_disc(const glm::dvec2& unit) noexcept {
  const glm::dvec2 p = 2.0 * unit - 1.0;
  if (p.x == 0.0 && p.y == 0.0) return {0.0, 0.0};
  constexpr double kQuarter = std::numbers::pi / 4.0;
  const bool x_leads = std::abs(p.x) > std::abs(p.y);
  const double radius = x_leads ? p.x : p.y;
  const double angle = x_leads ? kQuarter * (p.y / p.x) : 2.0 * kQuarter - kQuarter * (p.x / p.y);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

glm::dvec2 stratified(std::uint32_t pixel, int index, int count) noexcept {
  const std::uint32_t seed = pixel * 2654435761u + static_cast<std::uint32_t>(index) * 2u;
  const glm::dvec2 jitter(hashed(seed), hashed(seed + 1u));
  const int side = static_cast<int>(std::lround(std::sqrt(count)));
  if (side * side != count) {
    const double column = (index + jitter.x) / count;
    return {column, std::fmod(index * (std::numbers::phi - 1.0) + jitter.y / count, 1.0)};
  }
  return {(index % side + jitter.x) / side, (index / side + jitter.y) / side};
}

glm::dvec2 to_kernel(KernelShape shape, const glm::dvec2& unit) noexcept {
  switch (shape) {
    case KernelShape::box:
      break;
    case KernelShape::disc:
      return to_disc(unit);
    case KernelShape::gauss: {
      // Box and Muller, the radius' distribution cut where the kernel ends.
      constexpr double kCut = 3.0;
      const double inside = 1.0 - std::exp(-0.5 * kCut * kCut);
      const double radius = std::sqrt(-2.0 * std::log(1.0 - inside * unit.x));
      const double angle = 2.0 * std::numbers::pi * unit.y;
      return {radius * std::cos(angle), radius * std::sin(angle)};
    }
  }
  return 2.0 * unit - 1.0;
}

void for_each_row(int rows, const std::function<void(int row)>& work) {
  std::atomic<int> next{0};
  const auto run = [&] {
    for (int row = next++; row < rows; row = next++) work(row);
  };
  const int cores = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, std::max(rows, 1));
  std::vector<std::jthread> others;
  for (int i = 1; i < cores; ++i) others.emplace_back(run);
  run();
}

}  // namespace gnomon::trace
