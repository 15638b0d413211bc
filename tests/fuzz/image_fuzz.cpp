// Do any bytes, taken for a picture, become as many pixels as they promise or a refusal of one line? Both
// readers are asked: the one of this build, and our own of PNG, which builds without OpenImageIO have.
#include <algorithm>

#include "fuzz.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"
#include "inflate.hpp"
#include "png.hpp"

namespace {

using gnomon::fuzz::require;
using Bytes = std::span<const std::uint8_t>;
constexpr std::uint64_t kPixels = 1 << 16;

void reader_of_this_build(Bytes bytes) {
  try {
    const gnomon::Image image = gnomon::decode_image(bytes, "fuzz", kPixels);
    const auto pixels = static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
    require(pixels > 0 && pixels <= kPixels, "pixels within the limit");
    require(image.rgba.size() == pixels * 4, "as many pixels as the size says");
  } catch (const gnomon::SceneError& refusal) {
    gnomon::fuzz::require_one_line(refusal.what());
  }
}

void our_reader_of_png(Bytes bytes) {
  if (!gnomon::detail::is_png(bytes)) return;
  try {
    const gnomon::detail::PngSize size = gnomon::detail::png_size(bytes);
    const std::uint64_t pixels = std::uint64_t{size.width} * size.height;
    if (pixels == 0 || pixels > kPixels) return;  // the caller checks the size
    const auto rgba = gnomon::detail::decode_png(bytes);
    require(rgba.size() == pixels * 4, "as many pixels of PNG as the size says");
    const auto again = gnomon::detail::decode_png(gnomon::detail::encode_png(rgba, size, 4));
    require(again == rgba, "what was read is written and read again");
  } catch (const gnomon::detail::PngError& refusal) {
    gnomon::fuzz::require_one_line(refusal.what());
  }
}

/// The bytes as data, as a stream that holds some, and as pixels.
void compressed(Bytes bytes) {
  const auto back = gnomon::detail::inflate(gnomon::detail::deflate(bytes), bytes.size());
  require(std::equal(back.begin(), back.end(), bytes.begin(), bytes.end()), "data survive being compressed");
  for (const std::size_t size : {std::size_t{1}, std::size_t{300}, std::size_t{1} << 16}) {
    const auto held = gnomon::detail::inflate(bytes, size);
    require(held.empty() || held.size() == size, "a stream holds all or nothing");
  }
  if (bytes.size() < 5) return;
  const std::uint32_t pixels = static_cast<std::uint32_t>((bytes.size() - 1) / 4);
  const gnomon::detail::PngSize size{1 + bytes[0] % pixels, pixels / (1 + bytes[0] % pixels)};
  const Bytes drawn = bytes.subspan(1, std::size_t{size.width} * size.height * 4);
  const auto read = gnomon::detail::decode_png(gnomon::detail::encode_png(drawn, size, 4));
  require(std::equal(read.begin(), read.end(), drawn.begin(), drawn.end()), "any pixels are read as written");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  reader_of_this_build({data, size});
  our_reader_of_png({data, size});
  compressed({data, size});
  return 0;
}
