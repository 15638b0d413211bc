// Do any bytes, taken for a picture, become as many pixels as they promise or a refusal of one line?
#include "fuzz.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::uint64_t kPixels = 1 << 16;
  try {
    const gnomon::Image image = gnomon::decode_image({data, size}, "fuzz", kPixels);
    const auto pixels = static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
    gnomon::fuzz::require(pixels > 0 && pixels <= kPixels, "pixels within the limit");
    gnomon::fuzz::require(image.rgba.size() == pixels * 4, "as many pixels as the size says");
  } catch (const gnomon::SceneError& refusal) {
    gnomon::fuzz::require_one_line(refusal.what());
  }
  return 0;
}
