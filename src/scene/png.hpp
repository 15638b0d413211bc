// PNG files without another library: for programs that are built without OpenImageIO.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::detail {

/// Why the bytes are no PNG that this reader takes; one line, without the picture's name.
class PngError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Width and height in pixels, as the header states them.
struct PngSize {
  std::uint32_t width = 0, height = 0;
};

/// True where the bytes begin as a PNG file does.
[[nodiscard]] bool is_png(std::span<const std::uint8_t> bytes) noexcept;

/// The size in the header, before anything is decoded. Throws PngError where the header is cut off.
[[nodiscard]] PngSize png_size(std::span<const std::uint8_t> bytes);

/// Four bytes a pixel, rows from top to bottom, alpha not multiplied into the colour. Takes every colour type
/// and depth; 16 bits a channel are rounded to 8. Throws PngError where the file is damaged or interlaced.
/// The caller has checked the size.
[[nodiscard]] std::vector<std::uint8_t> decode_png(std::span<const std::uint8_t> bytes);

/// The bytes of a PNG of 8 bits a channel. `channels` is 3 or 4; `pixels` has width x height x channels
/// values.
[[nodiscard]] std::vector<std::uint8_t> encode_png(std::span<const std::uint8_t> pixels, PngSize size,
                                                   int channels);

}  // namespace gnomon::detail
