// Which bytes may a scene read? Its own file and regular files in its own folder; nothing else, by any
// spelling.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/fnv.hpp"

namespace gnomon::detail {

using Bytes = std::vector<std::uint8_t>;

/// The bytes of a regular file of at most `max_bytes`. Throws std::runtime_error that says what is wrong,
/// without the path; see read_bounded_file().
[[nodiscard]] Bytes read_regular_file(const std::filesystem::path& file, std::uint64_t max_bytes);

/// The only way from a URI in a scene to bytes. Data URIs are decoded; a relative path is read if the file it
/// leads to, after symbolic links, lies in the folder. `budget` is what all reads together may take.
class SceneFolder {
 public:
  /// An empty `folder` is that of a scene from memory: it has no files.
  SceneFolder(const std::filesystem::path& folder, std::uint64_t file_bytes, std::uint64_t total_bytes);
  /// Throws std::runtime_error that says what is wrong with the URI.
  [[nodiscard]] Bytes read(std::string_view uri);
  /// Of all bytes read, in their order; see fnv_of().
  [[nodiscard]] std::uint64_t hash() const noexcept { return hash_; }

 private:
  std::filesystem::path folder_;  // canonical, or empty
  std::uint64_t file_bytes_;
  std::uint64_t budget_;
  std::uint64_t hash_ = kFnvBasis;
};

}  // namespace gnomon::detail
