// The pictures of a frame that the report shows: the truth, the mask, where they differ, the error per pixel.
#include "frame_pictures.hpp"

#include <algorithm>
#include <functional>

#include "gnomon/render/picture.hpp"
#include "gnomon/scene/image.hpp"
#include "picture_colors.hpp"

namespace gnomon::tool {
namespace {

using render::Color;

constexpr Color kTurnedAway{70, 74, 84};

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
                                const FrameTruth& truth, const FramePictures& drawn) {
  std::filesystem::create_directories(folder / "pictures");
  const std::string of_scene = "pictures/scene" + std::to_string(scene);
  const std::string of_entry = of_scene + "_technique" + std::to_string(entry);
  const report::Pictures names{of_scene + "_image.png", of_scene + "_truth.png", of_entry + "_mask.png",
                               of_entry + "_difference.png", of_entry + "_heat.png"};
  const auto light_at = [](float visibility) {
    return mixed(kShadow, kLit, static_cast<double>(visibility));
  };
  write_png(drawn.image, folder / names.image);
  write_png(painted(truth, [&](std::size_t i) { return light_at(truth.seen.mask[i]); }),
            folder / names.truth);
  write_png(painted(truth, [&](std::size_t i) { return light_at(drawn.mask[i]); }), folder / names.mask);
  const auto difference = [&](std::size_t i) {
    const auto exact = static_cast<double>(truth.seen.mask[i]);
    return error_color(exact, static_cast<double>(drawn.mask[i]) - exact);
  };
  write_png(painted(truth, difference), folder / names.difference);
  Image heat = drawn.heat;
  render::draw_heat_legend(heat);
  write_png(heat, folder / names.heat);
  return names;
}

}  // namespace gnomon::tool
