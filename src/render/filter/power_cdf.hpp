// A power law through a kernel's least, mean and largest depth.
#pragma once

#include "filter/filter_parts.hpp"

namespace gnomon::render {

/// Lit share at depth d: 1 up to the mean, 0 from the largest depth on, and (1 - t^b) / (1 - m^b) between,
/// where t and m are d and the mean as shares of the way from the least depth to the largest, and
/// b = m / (1 - m). No bound: the right answer may be above or below. A mean outside of [least, largest] is
/// moved to the nearer; where all three agree, a step.
[[nodiscard]] double power_lit(double least, double mean, double largest, double depth) noexcept;

}  // namespace gnomon::render
