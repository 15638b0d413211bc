// Words about pictures that several commands take: their size, how cascades go over into each other, and
// which depth the maps store.
#pragma once

#include <charconv>
#include <stdexcept>
#include <string>
#include <vector>

#include "command.hpp"
#include "gnomon/render/renderer.hpp"

namespace gnomon::tool {

/// --size of a command: WIDTHxHEIGHT, each kLeastPictureSide to kMaxPictureSide.
inline constexpr int kLeastPictureSide = 16, kMaxPictureSide = 16'384;
[[nodiscard]] inline Option size_option(int& width, int& height,
                                        std::string help = "size of a frame in pixels, WIDTHxHEIGHT",
                                        bool* given = nullptr) {
  const auto set = [&width, &height](const std::string& text) {
    const std::size_t x = text.find('x');
    const auto number = [&](std::size_t begin, std::size_t end, int& value) {
      const auto [last, error] = std::from_chars(text.data() + begin, text.data() + end, value);
      return error == std::errc{} && last == text.data() + end && value >= kLeastPictureSide &&
             value <= kMaxPictureSide;
    };
    if (x == std::string::npos || !number(0, x, width) || !number(x + 1, text.size(), height))
      throw std::runtime_error("--size " + text + ": wants WIDTHxHEIGHT, each " +
                               std::to_string(kLeastPictureSide) + " to " + std::to_string(kMaxPictureSide) +
                               ", as in 960x540");
    return true;
  };
  return {.name = "--size",
          .target = ParsedWord{set, std::to_string(width) + "x" + std::to_string(height)},
          .help = std::move(help),
          .given = given};
}

[[nodiscard]] inline std::vector<std::string> transition_names() {
  return {"cut", "blend", "dither"};  // in the order of render::SplitTransition
}

/// In the order of render::MapPasses.
[[nodiscard]] inline std::vector<std::string> map_passes_names() {
  return {"each", "layered", "auto"};
}
/// --map-passes of a command that draws maps.
[[nodiscard]] inline Option map_passes_option(render::MapPasses& passes) {
  return {.name = "--map-passes",
          .target = enum_word(passes, map_passes_names()),
          .help = "how maps are drawn: one pass for each, or one layered pass for all where the driver can",
          .names = map_passes_names()};
}

/// Names of the depth layers behind those of `before`, in their order.
[[nodiscard]] inline std::vector<std::string> layer_names(std::vector<std::string> before = {}) {
  for (const render::DepthLayerInfo& info : render::depth_layers()) before.emplace_back(info.name);
  return before;
}
/// --layer of a command that draws one picture.
[[nodiscard]] inline Option layer_option(render::DepthLayer& layer) {
  return {.name = "--layer",
          .target = enum_word(layer, layer_names()),
          .help = "depth that the maps store; docs/bias.md says which for which scene",
          .names = layer_names()};
}
}  // namespace gnomon::tool
