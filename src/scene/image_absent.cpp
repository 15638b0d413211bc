// Pictures where OpenImageIO was not there at build time: PNG by our own reader and writer, and no others.
#include <string>

#include "base/whole_file.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"
#include "image_formats.hpp"
#include "png.hpp"
#include "refusal.hpp"

namespace gnomon {

bool detail::reads_webp() noexcept {
  return false;
}

namespace {

constexpr std::uint64_t kMaxSide = 1u << 16;  // pixels, as with OpenImageIO

[[noreturn]] void refuse(const std::string& where, const std::string& why) {
  throw SceneError(detail::one_line(where + ": picture: " + why));
}

constexpr const char* kAbsent =
    "this program was built without OpenImageIO (Debian package libopenimageio-dev)";

std::vector<std::uint8_t> encoded(const Image& image, std::span<const std::uint8_t> pixels, int channels,
                                  const std::string& where) {
  const auto count = static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.rgba.size() != count * 4)
    refuse(where, "has no pixels, or not as many as its size says");
  return detail::encode_png(
      pixels, {static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height)}, channels);
}

}  // namespace

Image decode_image(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels) {
  if (!detail::is_png(bytes)) refuse(name, std::string("is no PNG; ") + kAbsent);
  try {
    const detail::PngSize size = detail::png_size(bytes);
    const std::uint64_t pixels = std::uint64_t{size.width} * size.height;
    if (pixels == 0 || size.width > kMaxSide || size.height > kMaxSide || pixels > max_pixels) {
      refuse(name, std::to_string(size.width) + " x " + std::to_string(size.height) +
                       " pixels are not within the limit of " + std::to_string(max_pixels));
    }
    return {name, static_cast<int>(size.width), static_cast<int>(size.height), detail::decode_png(bytes)};
  } catch (const detail::PngError& error) {
    refuse(name, std::string("unreadable png: ") + error.what());
  }
}

std::vector<std::uint8_t> encode_png(const Image& image) {
  return encoded(image, image.rgba, 4, image.name);
}

void write_png(const Image& image, const std::filesystem::path& file) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(image.rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    if (i % 4 != 3) rgb.push_back(image.rgba[i]);
  }
  const std::vector<std::uint8_t> bytes = encoded(image, rgb, 3, file.string());
  const std::string why = write_whole_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (!why.empty()) refuse(file.string(), "cannot be written: " + why);
}

void write_exr(const FloatImage&, const std::filesystem::path& file) {
  refuse(file.string(), kAbsent);
}

}  // namespace gnomon
