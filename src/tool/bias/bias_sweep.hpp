// `gnomon bias --sweep`: which bias is right for the scene nobody tuned it on?
#pragma once

#include <string>
#include <vector>

#include "compare/sweep.hpp"

namespace gnomon::tool {

/// One light of every scene.
struct SweptLight {
  std::string name;  ///< as on the command line
  LightPlacement placement;
};

/// Views are every scene under every light. Settings are the product of the numbers.
struct BiasSweep {
  std::vector<TechniqueFilter> filters;
  std::vector<TechniqueWarp> warps;
  std::vector<int> map_sizes;
  std::vector<SweptLight> lights;
  /// Values for the members of BiasOptions.
  std::vector<double> constants, slopes, normal_offsets, max_slopes;
};

/// The options of a sweep; each needs --sweep.
[[nodiscard]] std::vector<Option> bias_sweep_options(BiasSweep& sweep);

/// Draws every setting in every view, and prints a table. The first row is BiasOptions{}; the others are
/// compared with it view by view. `request`: scenes, layers and cascades; with Measuring::json a line is
/// printed for each drawing. Without scenes: all built-in ones. Throws std::runtime_error.
void sweep_biases(const BiasSweep& sweep, SweepRequest request);

}  // namespace gnomon::tool
