// Frames that draw the picture and its mask alone.
#pragma once

#include "gnomon/render/renderer.hpp"

namespace gnomon {

inline render::FrameOptions quiet() {
  render::FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = false;
  return options;
}

}  // namespace gnomon
