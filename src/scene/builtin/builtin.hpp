// The scenes built in code: each function gives the bytes of a GLB file, the same at every call.
#pragma once

#include <string>

namespace gnomon::detail {

[[nodiscard]] std::string build_city();
[[nodiscard]] std::string build_fence();
[[nodiscard]] std::string build_glass();
[[nodiscard]] std::string build_hangar();
[[nodiscard]] std::string build_room();
[[nodiscard]] std::string build_street();
[[nodiscard]] std::string build_terrain();
[[nodiscard]] std::string build_trees();

/// Height of the terrain scene's ground above the world's origin at (x, z), metres.
[[nodiscard]] double terrain_height(double x, double z);

}  // namespace gnomon::detail
