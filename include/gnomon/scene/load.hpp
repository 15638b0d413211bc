// Scenes from glTF files and from code.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "gnomon/scene/scene.hpp"

namespace gnomon {

/// A file that cannot be loaded. what() is one line: path, element, what is wrong.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Caps that keep a hostile or mistaken file from taking the machine. Exceeding one throws SceneError.
struct LoadLimits {
  std::uint64_t file_bytes = 1ull << 30;   ///< one file, 1 GiB
  std::uint64_t total_bytes = 2ull << 30;  ///< all files a scene refers to, 2 GiB
  std::uint64_t triangles = 20'000'000;    ///< over all instances
  std::uint64_t vertices = 40'000'000;     ///< stored
  std::uint64_t pixels = 1ull << 28;       ///< over all images
  std::uint32_t nodes = 1'000'000;         ///< visited, instances included
  /// Keys, morph targets and joint weights of animations, numbers of four bytes.
  std::uint64_t animation_numbers = 1ull << 26;
};

/// The defaults, for scenes of up to so many triangles over all instances.
[[nodiscard]] LoadLimits limits_of_triangles(std::uint64_t triangles) noexcept;

/// Loads a .gltf or .glb file. Reads no file outside the scene's own folder. Throws SceneError.
[[nodiscard]] Scene load_gltf(const std::filesystem::path& path, const LoadLimits& limits = {});

/// A scene built in code. `build_glb` gives it as a binary glTF file; `load_builtin` reads that through
/// load_gltf's own path, so that a builtin scene is a glTF scene.
struct BuiltinScene {
  std::string_view name;     ///< behind "builtin:"
  std::string_view summary;  ///< one line
};
[[nodiscard]] std::span<const BuiltinScene> builtin_scenes() noexcept;
[[nodiscard]] std::string build_glb(std::string_view name);  ///< throws SceneError for an unknown name
[[nodiscard]] Scene load_builtin(std::string_view name);

/// `builtin:NAME` or a path. Throws SceneError.
[[nodiscard]] Scene load_scene(const std::string& spec, const LoadLimits& limits = {});

/// Hash of a scene's file and all files it names (FNV-1a, 64 bits): it changes when their content changes,
/// whatever their dates. 0 for builtin scenes, which are the program's. Loads a file to learn which others it
/// names. Throws what load_scene() throws.
[[nodiscard]] std::uint64_t scene_files_hash(const std::string& spec, const LoadLimits& limits = {});

}  // namespace gnomon
