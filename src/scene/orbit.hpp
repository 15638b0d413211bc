// A flight round what a scene is about, or inside of it where it is a room.
#pragma once

#include "gnomon/scene/camera_path.hpp"

namespace gnomon::detail {

/// default_path() of a scene that has no flight of its own.
[[nodiscard]] CameraPath orbit(const Scene& scene, double aspect);

}  // namespace gnomon::detail
