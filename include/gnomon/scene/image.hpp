// Pictures to and from files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "gnomon/scene/scene.hpp"

namespace gnomon {

/// Decodes PNG, JPEG or still WebP (if OpenImageIO reads it), recognised by the first bytes. Throws
/// SceneError with `name` in it where the bytes are none of these, damaged, or larger than `max_pixels`
/// (checked before decoding).
[[nodiscard]] Image decode_image(std::span<const std::uint8_t> bytes, const std::string& name,
                                 std::uint64_t max_pixels);

/// Writes an 8-bit RGB PNG (alpha dropped), beside the target first and then renamed, so that no half file is
/// left. Throws SceneError.
void write_png(const Image& image, const std::filesystem::path& file);

/// The bytes of an 8-bit RGBA PNG. Throws SceneError.
[[nodiscard]] std::vector<std::uint8_t> encode_png(const Image& image);

/// A float picture, `channels` interleaved, rows top to bottom; written as 32-bit float EXR. Throws
/// SceneError.
struct FloatImage {
  int width = 0, height = 0, channels = 1;  ///< pixels; values per pixel
  std::vector<float> values;                ///< width x height x channels
  std::vector<std::string> channel_names;   ///< one per channel
};
void write_exr(const FloatImage& image, const std::filesystem::path& file);

}  // namespace gnomon
