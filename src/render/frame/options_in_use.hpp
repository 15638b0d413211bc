// What does a frame ask of the source of its shadows?
#pragma once

#include "source/frame_source.hpp"

namespace gnomon::render {

/// The options that differ from leaving them out: what is off, or as if it were not there, is not asked for.
[[nodiscard]] FrameOptionSet options_in_use(const FrameJob& frame) noexcept;

}  // namespace gnomon::render
