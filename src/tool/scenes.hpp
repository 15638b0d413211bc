// `gnomon scenes`: which scenes come with the program, and how to get one as a file.
#pragma once

#include <filesystem>
#include <string>

namespace gnomon::tool {

/// Prints name, triangles, instances, extents and summary of every builtin scene, as a table or as one line
/// of JSON. Returns the exit code.
int list_scenes(bool json);

/// Writes a builtin scene as a binary glTF file, beside the target first and then renamed. Throws SceneError
/// for an unknown name, std::runtime_error where the file cannot be written. Returns the exit code.
int write_scene(const std::string& name, const std::filesystem::path& out);

}  // namespace gnomon::tool
