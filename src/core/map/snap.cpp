// Holding the texel grid still: centres in whole texels.
// Based on: Valient, "Stable Rendering of Cascaded Shadow Maps", ShaderX6, 2008.
#include "gnomon/snap.hpp"

#include <cmath>

namespace gnomon {

std::int64_t snap_index(double value, double step) noexcept {
  constexpr double kLargest = 9007199254740992.0;  // 2^53
  const double index = std::floor(value / step + 0.5);
  if (!(index > -kLargest)) return -static_cast<std::int64_t>(kLargest);
  if (index > kLargest) return static_cast<std::int64_t>(kLargest);
  return static_cast<std::int64_t>(index);
}

}  // namespace gnomon
