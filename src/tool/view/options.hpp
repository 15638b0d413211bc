// The words of `gnomon view`, and what they become.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "gnomon/render/context.hpp"
#include "state.hpp"

namespace gnomon::tool::view {

struct Options {
  State state;
  bool scene_given = false;  ///< a scene or a state stands on the command line
  int width = 1280, height = 720;
  std::filesystem::path out;         ///< not empty: the picture goes there, and no window opens
  std::filesystem::path screenshot;  ///< not empty: what the window shows last goes there
  std::filesystem::path tour;        ///< not empty: the tour's pictures go into this folder
  std::filesystem::path benchmark;   ///< not empty: a flight's figures go there, and the window closes
  int frames = 120;                  ///< of the benchmark
  std::string results;               ///< of `gnomon compare`, to be shown; empty: none
  render::ContextKind context = render::ContextKind::automatic;  ///< of `out`
  int exit_after = 0;                                            ///< frames; 0: until the window is closed
  double ui_scale = 0.0;  ///< of text and widgets; 0: as the display has it
  std::uint64_t max_triangles = 0;
};

/// Draws the state to Options::out. Returns the exit code.
int draw_to_file(const Options& options);

/// Opens a window. Returns the exit code.
int open_window(const Options& options);

}  // namespace gnomon::tool::view
