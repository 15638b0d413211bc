// One frame of a flight that is drawn with pages: its row and its pictures.
#pragma once

#include "flight.hpp"
#include "gnomon/render/renderer.hpp"
#include "page_pictures.hpp"
#include "report.hpp"

namespace gnomon::tool::fly {

/// A frame's row, and its pictures with their legends yet to come.
struct DrawnPages {
  FrameRow row;
  Image lit, heat, levels, cached;
  LegendText level_text, cached_text;
};
/// Draws the surfaces, plans the pages that they need, and draws those that the renderer has not kept from
/// earlier frames. `filter`: prepared for Source::pages. Throws std::runtime_error where the plan refuses.
[[nodiscard]] DrawnPages draw_with_pages(const Options& options, const Flight& flight, const Camera& camera,
                                         const Light& light, render::Renderer& renderer,
                                         const render::PreparedFilter& filter);

}  // namespace gnomon::tool::fly
