// Which value has a curve of keys at a time?
#pragma once

#include <array>
#include <span>

#include "gnomon/scene/animation.hpp"

namespace gnomon::detail {

/// Writes sampler.width numbers to `out`. `turns`: the values are rotations, which come out at unit length or
/// zero. The time must be finite.
void sample(const AnimationSampler& sampler, double time_s, bool turns, std::span<double> out) noexcept;

}  // namespace gnomon::detail
