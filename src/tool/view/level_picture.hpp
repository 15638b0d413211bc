// One level of a page plan as a picture: its resident pages, each at its place.
#pragma once

#include <functional>
#include <vector>

#include "page_pictures.hpp"
#include "pictures.hpp"

namespace gnomon::tool::view {

/// Depths of the resident pages of one level, with outlines by what was kept. `drawn`: as FramePages has it.
[[nodiscard]] MapPicture level_map_picture(const PagePlan& plan, std::size_t level,
                                           const std::vector<bool>& drawn,
                                           const std::function<FloatImage(std::size_t)>& depths_of_page,
                                           int width, int height);

/// legend() of a view that shows pages; `level`: that View::map shows.
[[nodiscard]] Image page_legend(View view, const PagePlan& plan, const std::vector<bool>& drawn,
                                std::size_t level, int picture_width);

}  // namespace gnomon::tool::view
