// Numbers that spread over 0 to 1 and never repeat: where rays go through an image. Based on: Roberts, "The
// Unreasonable Effectiveness of Quasirandom Sequences", 2018 (R2).
#pragma once

#include <cstddef>

namespace gnomon {

/// Number `i` of those that follow each other by `step`, modulo 1.
constexpr double spread(double step, std::size_t i) noexcept {
  const double value = 0.5 + step * static_cast<double>(i);
  return value - static_cast<double>(static_cast<int>(value));
}

/// Point `i` of the unit square: even without the aliasing of a grid.
constexpr double even_x(std::size_t i) noexcept {
  return spread(0.7548776662466927, i);
}
constexpr double even_y(std::size_t i) noexcept {
  return spread(0.5698402909980532, i);
}

}  // namespace gnomon
