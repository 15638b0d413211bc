// Pictures of a frame with pages: which level serves what, and what was kept.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/pages.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/render/renderer.hpp"

namespace gnomon::tool {

/// How the texels of a map or of a page came into the frame.
enum class Texels : std::uint8_t { cached, scrolled, drawn };
[[nodiscard]] render::Color color_of(Texels texels) noexcept;

/// Violet is the coarsest level, yellow the finest.
[[nodiscard]] render::Color level_color(std::size_t level, std::size_t levels) noexcept;
/// The lit picture, tinted by the level of the page that serves each pixel.
[[nodiscard]] Image level_picture(const Image& lit, const FloatImage& mask, const FloatImage& normals,
                                  const PagePlan& plan);

/// The map or page that serves a pixel, for cached_picture().
struct Served {
  Texels texels = Texels::drawn;
  double fineness = 1.0;  ///< 0: of the coarsest level, 1: of the finest
};
/// Colours by how the texels came, with lines where one map or page ends. `served`: by index of the mask.
[[nodiscard]] Image cached_picture(const FloatImage& mask, const FloatImage& normals,
                                   std::span<const Served> served);
/// By page of the plan; `drawn` as FramePages has it.
[[nodiscard]] std::vector<Served> served_by(const PagePlan& plan, const std::vector<bool>& drawn);
/// By map of the frame.
[[nodiscard]] std::vector<Served> served_by(const render::FrameStats& stats);

/// Colours with what they stand for, under a title.
struct LegendText {
  std::string title;
  std::vector<std::pair<render::Color, std::string>> fields;
};
/// Legend of level_picture(): some of the levels where there are many.
[[nodiscard]] LegendText level_legend(const PagePlan& plan);
/// Legend of cached_picture(), with counts; `what`: "maps" or "pages".
[[nodiscard]] LegendText cached_legend(std::span<const Served> served, const std::string& what);
/// Legend of the outlines of one level's pages.
[[nodiscard]] LegendText resident_legend(const PagePlan& plan, std::size_t level);

}  // namespace gnomon::tool
