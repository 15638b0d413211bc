// What others hand in to be measured: the maps that an engine planned, or the masks that it drew, by frames.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/plan.hpp"

namespace gnomon::tool {

/// Maps of the sun in a right-handed world, frame by frame.
struct CapturedMaps {
  struct Frame {
    Camera camera;
    ShadowPlan plan;
  };
  std::vector<Frame> frames;        ///< at least one, each with maps
  glm::dvec3 light_direction{0.0};  ///< of travel, unit length
  /// The frame that sees the same picture; nullptr: none. Matrices may be rounded to single precision.
  [[nodiscard]] const Frame* at(const Camera& camera) const noexcept;
};

/// Names of the mask files of one frame, below their folder.
struct GivenMasks {
  struct Frame {
    // The view that it is of, as rows have it.
    std::string scene, light, camera, animation;
    double light_elevation_deg = 0.0, light_azimuth_deg = 0.0;
    int frame = 0, frames = 1;
    std::string mask;                    ///< of the frame
    std::string before;                  ///< one step of a viewer earlier through its own camera; empty: none
    std::string moved;                   ///< that shadow looked up at the frame's points; empty: none
    double ms = 0.0;                     ///< whole time of the frame's shadow; 0: not measured
    double ms_low = 0.0, ms_high = 0.0;  ///< its interval
  };
  std::filesystem::path folder;
  std::vector<Frame> frames;
};

}  // namespace gnomon::tool
