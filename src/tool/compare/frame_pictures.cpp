// The pictures of a frame that the report shows: the truth, the mask, where they differ, the error per pixel.
#include "frame_pictures.hpp"

#include <algorithm>
#include <functional>

#include "gnomon/render/picture.hpp"
#include "gnomon/scene/image.hpp"

namespace gnomon::tool {
namespace {

using render::Color;

constexpr Color kSky{214, 224, 234}, kTurnedAway{70, 74, 84}, kUndecided{160, 60, 160};
constexpr Color kShadow{40, 42, 50}, kLit{245, 243, 236};
// Told apart by those who see red and green alike, and by brightness.
constexpr Color kFalseLit{255, 140, 0}, kFalseShadow{30, 110, 230};

Color mixed(const Color& a, const Color& b, double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const auto channel = [s](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(from + (to - from) * s + 0.5);
  };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

/// A picture of the frame's size: `lit` colours the pixels that a ray decides, by their number.
Image painted(const FrameTruth& truth, const std::function<Color(std::size_t)>& lit) {
  Image image = render::blank_image(truth.points.width, truth.points.height, kSky);
  for (std::size_t i = 0; i < truth.points.pixels.size(); ++i) {
    Color color = kSky;
    switch (truth.points.pixels[i].state) {
      case trace::PixelState::sky:
        break;
      case trace::PixelState::turned_away:
      case trace::PixelState::unlit:
        color = kTurnedAway;
        break;
      case trace::PixelState::undecided:
        color = kUndecided;
        break;
      case trace::PixelState::facing:
        color = truth.hard.pixels[i] == trace::Verdict::undecided ? kUndecided : lit(i);
        break;
    }
    std::copy_n(&color[0], 3, image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  return image;
}

}  // namespace

report::Pictures write_pictures(const std::filesystem::path& folder, std::size_t scene, std::size_t entry,
                                const FrameTruth& truth, const Seen& seen) {
  std::filesystem::create_directories(folder / "pictures");
  const std::string of_scene = "pictures/scene" + std::to_string(scene);
  const std::string of_entry = of_scene + "_technique" + std::to_string(entry);
  const report::Pictures names{of_scene + "_image.png", of_scene + "_truth.png", of_entry + "_mask.png",
                               of_entry + "_difference.png", of_entry + "_heat.png"};
  const auto light_at = [](float visibility) {
    return mixed(kShadow, kLit, static_cast<double>(visibility));
  };
  write_png(seen.image, folder / names.image);
  write_png(painted(truth, [&](std::size_t i) { return light_at(truth.judged[i]); }), folder / names.truth);
  write_png(painted(truth, [&](std::size_t i) { return light_at(seen.mask[i]); }), folder / names.mask);
  const auto difference = [&](std::size_t i) {
    // The truth pales behind what is wrong with it.
    const Color ground = mixed(light_at(truth.judged[i]), kSky, 0.5);
    const double error = static_cast<double>(seen.mask[i]) - static_cast<double>(truth.judged[i]);
    return mixed(ground, error > 0.0 ? kFalseLit : kFalseShadow, std::abs(error));
  };
  write_png(painted(truth, difference), folder / names.difference);
  Image heat = seen.heat;
  render::draw_heat_legend(heat);
  write_png(heat, folder / names.heat);
  return names;
}

}  // namespace gnomon::tool
