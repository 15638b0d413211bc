// How long does each pass of a frame take?
#pragma once

#include <glad/gl.h>

#include <chrono>

#include "gnomon/render/renderer.hpp"

namespace gnomon::render {

/// Runs passes, and measures each where that is requested.
struct PassTimer {
  FrameStats& stats;
  bool on;
  template <typename Work>
  void operator()(Pass pass, Work&& work) const {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    work();
    if (!on) return;
    glFinish();
    stats.milliseconds[static_cast<std::size_t>(pass)] =
        std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  }
};

}  // namespace gnomon::render
