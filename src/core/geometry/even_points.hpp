// Numbers that spread over 0 to 1 and never repeat: where rays go through an image. Based on: Roberts, "The
// Unreasonable Effectiveness of Quasirandom Sequences", 2018 (R2).
#pragma once

#include <cstddef>

namespace gnomon {

/// Number `i`, a whole one, of those that follow each other by `step`, modulo 1.
constexpr double spread(double step, double i) noexcept {
  const double value = 0.5 + step * i;
  return value - static_cast<double>(static_cast<int>(value));
}

/// Steps along x and y: point `i` of the unit square is even without the aliasing of a grid.
inline constexpr double kEvenX = 0.7548776662466927, kEvenY = 0.5698402909980532;
constexpr double even_x(std::size_t i) noexcept {
  return spread(kEvenX, static_cast<double>(i));
}
constexpr double even_y(std::size_t i) noexcept {
  return spread(kEvenY, static_cast<double>(i));
}

}  // namespace gnomon
