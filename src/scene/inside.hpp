// Is a scene a room, and where does one stand in it?
#pragma once

#include <optional>

#include "gnomon/scene/camera_path.hpp"
#include "surface_samples.hpp"

namespace gnomon::detail {

/// A closed flight within a space that surfaces enclose: always across its middle, the longest view halfway.
/// Nothing where the scene is looked at from outside. `origin`: of the samples.
[[nodiscard]] std::optional<CameraPath> inside_path(const ViewSubject& subject,
                                                    const std::vector<SurfaceSample>& samples,
                                                    const glm::dvec3& origin);

}  // namespace gnomon::detail
