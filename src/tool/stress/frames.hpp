// `gnomon stress --frames`: random frames, drawn and checked, and the smallest that fails of each kind as
// files.
#pragma once

#include <cstdint>
#include <string>

#include "gnomon/render/context.hpp"

namespace gnomon::tool {

struct FrameStressRequest {
  std::uint64_t frames = 0;  ///< random frames
  std::uint64_t seed = 1;
  std::string out;  ///< folder for frames that fail; empty: see failure_folder()
  render::ContextKind context = render::ContextKind::automatic;
};

/// True where the text is a frame, not a case.
[[nodiscard]] bool is_frame_file(const std::string& text);

/// Checks the frame of this text again, prints a line for each finding, and returns whether there is one.
/// `name` stands in front of messages. Throws CaseError.
bool replay_frame(const std::string& text, const std::string& name, render::ContextKind context);

/// Prints counts, the time, and a line for each kind of failure. Writes into `out` for each kind the frame,
/// its scene as a glTF file, and a state of `gnomon view` where the viewer has such a camera. Throws
/// std::runtime_error for files that cannot be written. Returns 1 where a frame fails, else 0.
int run_frame_stress(const FrameStressRequest& request);

}  // namespace gnomon::tool
