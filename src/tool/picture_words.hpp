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

/// Reads the pixels of --size. Throws std::runtime_error where `text` is not WIDTHxHEIGHT, each within
/// [least, most].
inline void read_picture_size(const std::string& text, int least, int most, int& width, int& height) {
  const std::size_t x = text.find('x');
  const auto number = [&](std::size_t begin, std::size_t end, int& value) {
    const auto [last, error] = std::from_chars(text.data() + begin, text.data() + end, value);
    return error == std::errc{} && last == text.data() + end && value >= least && value <= most;
  };
  if (x == std::string::npos || !number(0, x, width) || !number(x + 1, text.size(), height))
    throw std::runtime_error("--size " + text + ": wants WIDTHxHEIGHT, each " + std::to_string(least) +
                             " to " + std::to_string(most) + ", as in 960x540");
}

[[nodiscard]] inline std::vector<std::string> transition_names() {
  return {"cut", "blend", "dither"};  // in the order of render::SplitTransition
}
/// `name` is one of transition_names().
[[nodiscard]] inline render::SplitTransition transition_from_name(const std::string& name) {
  if (name == "blend") return render::SplitTransition::blend;
  return name == "dither" ? render::SplitTransition::dither : render::SplitTransition::cut;
}

/// In the order of render::MapPasses.
[[nodiscard]] inline std::vector<std::string> map_passes_names() {
  return {"each", "layered", "auto"};
}
/// --map-passes of a command that draws maps; `name` is one of map_passes_names().
[[nodiscard]] inline Option map_passes_option(std::string& name) {
  return {.name = "--map-passes",
          .target = &name,
          .help = "how maps are drawn: one pass for each, or one layered pass for all where the driver can",
          .names = map_passes_names()};
}
[[nodiscard]] inline render::MapPasses map_passes_from_name(const std::string& name) {
  if (name == "each") return render::MapPasses::each;
  return name == "layered" ? render::MapPasses::layered : render::MapPasses::automatic;
}

/// Names of the depth layers behind those of `before`, in their order.
[[nodiscard]] inline std::vector<std::string> layer_names(std::vector<std::string> before = {}) {
  for (const render::DepthLayerInfo& info : render::depth_layers()) before.emplace_back(info.name);
  return before;
}
/// --layer of a command that draws one picture; `name` is one of layer_names().
[[nodiscard]] inline Option layer_option(std::string& name) {
  return {.name = "--layer",
          .target = &name,
          .help = "depth that the maps store; docs/bias.md says which for which scene",
          .names = layer_names()};
}
/// `name` is one of layer_names().
[[nodiscard]] inline render::DepthLayer layer_from_name(const std::string& name) {
  const render::DepthLayerInfo* const info = render::find_depth_layer(name);
  return info != nullptr ? info->layer : render::DepthLayer::front;
}

}  // namespace gnomon::tool
