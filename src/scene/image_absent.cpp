// What stands in for pictures where OpenImageIO was not there at build time: scenes load without theirs.
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"
#include "image_formats.hpp"
#include "refusal.hpp"

namespace gnomon {

bool detail::reads_webp() noexcept {
  return false;
}

namespace {

[[noreturn]] void refuse(const std::string& name) {
  throw SceneError(detail::one_line(
      name + ": picture: this program was built without OpenImageIO (Debian package libopenimageio-dev)"));
}

}  // namespace

Image decode_image(std::span<const std::uint8_t>, const std::string& name, std::uint64_t) {
  refuse(name);
}

std::vector<std::uint8_t> encode_png(const Image& image) {
  refuse(image.name);
}

void write_png(const Image&, const std::filesystem::path& file) {
  refuse(file.string());
}

void write_exr(const FloatImage&, const std::filesystem::path& file) {
  refuse(file.string());
}

}  // namespace gnomon
