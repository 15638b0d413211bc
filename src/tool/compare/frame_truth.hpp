// What all techniques of a frame are compared with: exact rays, and what the camera shows.
#pragma once

#include <cstdint>
#include <vector>

#include "gnomon/study/expected_error.hpp"
#include "gnomon/trace/seen_shadow.hpp"
#include "stage.hpp"

namespace gnomon::tool {

/// What all techniques of a frame are compared with.
struct FrameTruth {
  int frame = 0;
  Camera camera, before;
  trace::SurfacePoints points;
  trace::HardReference hard;
  trace::SeenShadow seen;  ///< the same as pictures
  /// Its mask one step of a viewer earlier, through the same pixels; equal where the scene is at rest.
  std::vector<float> lit_before;
  std::uint64_t undecided = 0;
  /// The light over whole pixels; empty where it was not asked for.
  struct Pixels {
    std::vector<float> light, light_before;  ///< of the frame, and of the one before through its own camera
    std::vector<std::uint8_t> several;       ///< 1: the pixel shows several surfaces
    std::vector<int> seen_at;  ///< pixel of the frame before that shows the same point; -1: none does
  };
  Pixels pixels = {};
};
/// Draws the frame once with `entry` to learn what is visible, and traces it. `pixel_samples`: rays through
/// each pixel, for FrameTruth::pixels; 0: none.
[[nodiscard]] FrameTruth frame_truth(Stage& stage, int frame, const SweepEntry& entry, int pixel_samples = 0);

}  // namespace gnomon::tool
