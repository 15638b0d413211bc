// Noise without low frequencies: what neighbouring pixels miss they miss differently, so that a small blur,
// or the eye, averages it.
#pragma once

#include <vector>

namespace gnomon::render {

inline constexpr int kBlueNoiseSide = 64;  ///< pixels; the tile repeats

/// One tile, row by row: each of (i + 1/2) / 64^2 once. The same in every run.
[[nodiscard]] std::vector<float> blue_noise();

}  // namespace gnomon::render
