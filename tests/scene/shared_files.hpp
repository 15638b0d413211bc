// Where the files lie that tests read but the project does not hold.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::test {

/// $GNOMON_SHARED, else shared/ beside the source tree.
inline std::filesystem::path shared_folder() {
  const char* named = std::getenv("GNOMON_SHARED");
  return named != nullptr ? std::filesystem::path(named)
                          : std::filesystem::path(GNOMON_SOURCE_DIR) / ".." / "shared";
}

/// All .gltf and .glb files below `folder`, sorted; none where it is absent.
inline std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> out;
  std::error_code absent;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, absent)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".gltf" || extension == ".glb") out.push_back(entry.path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace gnomon::test
