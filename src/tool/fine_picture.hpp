// How fine is the picture of a shadow that techniques are chosen by?
#pragma once

#include <algorithm>

#include "gnomon/camera.hpp"

namespace gnomon::tool {

/// The same camera with a picture as fine as texels may be: up to four times as fine as the frame, and not
/// over 1280 pixels wide. A coarser one shows too few errors of texels that are finer, and of narrow shadows.
[[nodiscard]] inline Camera fine_picture(Camera camera) noexcept {
  constexpr double kMostFiner = 4.0, kWidth = 1280.0;
  const double scale = std::min(kMostFiner, kWidth / camera.width);
  camera.width = std::max(static_cast<int>(camera.width * scale), 1);
  camera.height = std::max(static_cast<int>(camera.height * scale), 1);
  return camera;
}

}  // namespace gnomon::tool
