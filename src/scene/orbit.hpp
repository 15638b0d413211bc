// A flight round what a scene is about, or inside of it where it is a room.
#pragma once

#include "gnomon/scene/camera_path.hpp"

namespace gnomon::detail {

/// default_path() of a scene that has no flight of its own.
[[nodiscard]] CameraPath orbit(const Scene& scene, double aspect);

/// Rotates the keys of a closed path so that its middle (time 0.5), which stands for all of it, is at this
/// key, or as near as its keys allow.
void put_in_the_middle(CameraPath& path, std::size_t key);

}  // namespace gnomon::detail
