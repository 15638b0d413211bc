// Which limits does the current context's driver have, and is its clock reliable?
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::render {

/// One limit of the driver.
struct Limit {
  std::string name;        ///< as OpenGL names it
  std::int64_t value = 0;  ///< in its own unit
};

/// Limits and clock of a driver.
struct Probe {
  std::vector<Limit> limits;  ///< those that maps and passes can run into
  /// GL_TIME_ELAPSED of a heavy pass against the wall clock around it with nothing else in flight. Software
  /// drivers draw after the query has ended, and their timers run several times too fast.
  bool timers_trusted = false;
  std::string timers_why;                ///< one line, with both times
  double timer_ms = 0.0, wall_ms = 0.0;  ///< of the same pass
  /// Extension by which a vertex shader draws into several layers of an array (MapPasses::layered), as the
  /// driver names it; empty: none.
  std::string layers;
};
/// Draws for some 50 ms in the context that is current. Throws RenderError.
[[nodiscard]] Probe probe_driver();

/// Probe::layers alone, of the context that is current.
[[nodiscard]] std::string layer_extension();

/// Whether the driver gives `maps` maps of this size and so many bytes a texel. Where it draws in software,
/// that much memory must be free as well. Allocates images of that size for a moment, in the current context.
[[nodiscard]] bool memory_takes_maps(int map_size, int maps, double bytes_per_texel);

/// The result of largest_maps.
struct FittingMaps {
  int size = 0;            ///< texels along each side; 0: none fits
  double mebibytes = 0.0;  ///< that all of them take
  std::string why;         ///< the limit that larger maps exceed; empty: they are as large as requested
};
/// Maps of `map_size` texels a side, halved until memory takes `maps` of them and they stay within
/// `limit_mib` (0: no limit), down to 16. Calls memory_takes_maps(), in the current context.
[[nodiscard]] FittingMaps largest_maps(int map_size, int maps, double bytes_per_texel, double limit_mib);

}  // namespace gnomon::render
