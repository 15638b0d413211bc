// Is every element of a matrix a number?
#pragma once

#include <cmath>

namespace gnomon::test {

template <class Matrix>
[[nodiscard]] bool all_finite(const Matrix& m) {
  for (int column = 0; column < Matrix::length(); ++column) {
    for (int row = 0; row < Matrix::col_type::length(); ++row) {
      if (!std::isfinite(m[column][row])) return false;
    }
  }
  return true;
}

}  // namespace gnomon::test
