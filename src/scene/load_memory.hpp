// A scene from bytes that are already in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "gnomon/scene/load.hpp"

namespace gnomon::detail {

/// load_gltf on bytes. `name` names the scene and stands in front of errors; files are read below `folder`,
/// none where it is empty. Throws SceneError.
[[nodiscard]] Scene load_gltf_bytes(std::span<const std::uint8_t> bytes, const std::string& scene_name,
                                    const std::string& path_in_errors, const std::filesystem::path& folder,
                                    const LoadLimits& limits);

}  // namespace gnomon::detail
