// The middle of what was timed.
#pragma once

#include <algorithm>
#include <vector>

namespace gnomon {

/// Of an even number the upper of the two in the middle; there must be one.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace gnomon
