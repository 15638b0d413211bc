// The views of pages: which level serves what, what was kept, and what lies in a level.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "gnomon/pages.hpp"
#include "gnomon/render/renderer.hpp"
#include "pictures.hpp"

namespace gnomon::tool::view {

/// How the texels of a map or of a page came into the frame.
enum class Texels : std::uint8_t { kept, scrolled, drawn };

/// Violet is the coarsest level, yellow the finest.
[[nodiscard]] render::Color level_color(std::size_t level, std::size_t levels) noexcept;
/// The lit picture, tinted by the level of the page that serves each pixel.
[[nodiscard]] Image level_picture(const Image& lit, const FloatImage& mask, const FloatImage& normals,
                                  const PagePlan& plan);

/// What serves a pixel, for kept_picture().
struct Served {
  Texels texels = Texels::drawn;
  double fineness = 1.0;  ///< 0: of the coarsest level, 1: of the finest
};
/// Colours by how the texels came, with lines where one map or page ends. `served`: by index of the mask.
[[nodiscard]] Image kept_picture(const FloatImage& mask, const FloatImage& normals,
                                 std::span<const Served> served);
/// By page of the plan; `drawn` as FramePages has it.
[[nodiscard]] std::vector<Served> served_by(const PagePlan& plan, const std::vector<bool>& drawn);
/// By map of the frame.
[[nodiscard]] std::vector<Served> served_by(const render::FrameStats& stats);

/// Depths of the resident pages of one level, each at its place, with outlines by what was kept.
[[nodiscard]] MapPicture level_map_picture(const PagePlan& plan, std::size_t level,
                                           const std::vector<bool>& drawn,
                                           const std::function<FloatImage(std::size_t)>& depths_of_page,
                                           int width, int height);

/// legend() of a view that shows pages; `level`: that View::map shows.
[[nodiscard]] Image page_legend(View view, const PagePlan& plan, const std::vector<bool>& drawn,
                                std::size_t level, int picture_width);
/// legend() of View::kept; `what`: "maps" or "pages".
[[nodiscard]] Image kept_legend(std::span<const Served> served, const std::string& what, int picture_width);

}  // namespace gnomon::tool::view
