// A shadow mask as a file: exactly, as PFM, or as a grey picture of others.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace gnomon::tool {

/// Single precision, little-endian, to the last bit. `values` has width x height of them, rows from top to
/// bottom. Based on: P. Debevec, "PFM Portable FloatMap Image Format". Throws std::runtime_error.
void write_mask(const std::filesystem::path& file, std::span<const float> values, int width, int height);

/// A mask from `name` below `folder`: a PFM of one channel, or the red of a picture. Throws
/// std::runtime_error, with the name in front, where the size is another, a value is not from 0 to 1, or the
/// file is damaged or outside of the folder.
[[nodiscard]] std::vector<float> read_mask(const std::filesystem::path& folder, const std::string& name,
                                           int width, int height);

}  // namespace gnomon::tool
