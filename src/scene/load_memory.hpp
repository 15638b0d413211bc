// A scene, or a camera flight, from bytes that are already in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"

namespace gnomon::detail {

/// load_gltf on bytes. `name` names the scene and stands in front of errors; files are read below `folder`,
/// none where it is empty. `files_hash`, unless nullptr, is set as scene_files_hash() has it. Throws
/// SceneError.
[[nodiscard]] Scene load_gltf_bytes(std::span<const std::uint8_t> bytes, const std::string& scene_name,
                                    const std::string& path_in_errors, const std::filesystem::path& folder,
                                    const LoadLimits& limits, std::uint64_t* files_hash = nullptr);

/// load_camera_path on text; `path_in_errors` stands in front of errors. Throws SceneError.
[[nodiscard]] CameraPath camera_path_from_text(std::string_view text, const std::string& path_in_errors);

}  // namespace gnomon::detail
