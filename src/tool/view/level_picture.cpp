// One level of a page plan as a picture: its resident pages, each at its place.
#include "level_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "picture_colors.hpp"

namespace gnomon::tool::view {
namespace {

using render::Color;

constexpr Color kEmpty{24, 24, 28};

/// Columns and rows of the resident pages of a level.
struct Extent {
  std::int32_t left = std::numeric_limits<std::int32_t>::max(), bottom = left, right = -1, top = -1;
  [[nodiscard]] double columns() const { return right - left + 1.0; }
  [[nodiscard]] double rows() const { return top - bottom + 1.0; }
};

Extent extent_of(const PagePlan& plan, std::size_t level) {
  Extent extent;
  for (const Page& page : plan.pages) {
    if (page.level != level) continue;
    extent.left = std::min(extent.left, page.column);
    extent.right = std::max(extent.right, page.column);
    extent.bottom = std::min(extent.bottom, page.row);
    extent.top = std::max(extent.top, page.row);
  }
  return extent;
}

/// A page of the level that is shown: its depths, and its upper left corner and side in the picture.
struct PlacedPage {
  FloatImage depths;
  glm::dvec2 corner{0.0};
  double side = 1.0;
  bool drawn = false;
};

/// Depths of what the page serves, without its border.
void paint_page(const PlacedPage& page, int border, float nearest, float farthest, Image& image) {
  const int served = page.depths.width - 2 * border;
  const auto edge = [](double at, int most) { return std::clamp(static_cast<int>(std::ceil(at)), 0, most); };
  for (int y = edge(page.corner.y, image.height); y < edge(page.corner.y + page.side, image.height); ++y) {
    for (int x = edge(page.corner.x, image.width); x < edge(page.corner.x + page.side, image.width); ++x) {
      const double across = (x - page.corner.x) / page.side, down = (y - page.corner.y) / page.side;
      const int column = border + std::min(static_cast<int>(across * served), served - 1),
                row = border + std::min(static_cast<int>((1.0 - down) * served), served - 1);
      const float depth = page.depths.values[static_cast<std::size_t>(row * page.depths.width + column)];
      const double share =
          farthest > nearest ? static_cast<double>((depth - nearest) / (farthest - nearest)) : 0.0;
      constexpr Color kNothing{58, 60, 70}, kFar{70, 72, 80};
      set_pixel(
          image,
          static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x),
          depth >= 1.0f ? kNothing : mixed(kLit, kFar, share));
    }
  }
}

void add_square(const PlacedPage& page, const glm::u8vec4& color, std::vector<ScreenLine>& lines) {
  // Inside, so that neighbours keep their colours.
  const double in = page.side > 8.0 ? 1.0 : 0.0;
  const glm::dvec2 a = page.corner + in, c = page.corner + (page.side - in), b(c.x, a.y), d(a.x, c.y);
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, d), std::pair(d, a)})
    lines.push_back({from, to, color, 1.5});
}

}  // namespace

MapPicture level_map_picture(const PagePlan& plan, std::size_t level, const std::vector<bool>& drawn,
                             const std::function<FloatImage(std::size_t)>& depths_of_page, int width,
                             int height) {
  MapPicture picture{render::blank_image(width, height, kEmpty), {}};
  const Extent extent = extent_of(plan, level);
  if (extent.right < extent.left) return picture;
  constexpr double kRoom = 0.94;
  const double side = kRoom * std::min(width / extent.columns(), height / extent.rows());
  const glm::dvec2 corner(0.5 * (width - side * extent.columns()), 0.5 * (height - side * extent.rows()));
  std::vector<PlacedPage> pages;
  float nearest = 1.0f, farthest = 0.0f;
  for (std::size_t i = 0; i < plan.pages.size(); ++i) {
    const Page& page = plan.pages[i];
    if (page.level != level) continue;
    // Rows count upwards.
    pages.push_back({depths_of_page(i),
                     corner + side * glm::dvec2(page.column - extent.left, extent.top - page.row), side,
                     i < drawn.size() && drawn[i]});
    for (const float depth : pages.back().depths.values) {
      if (depth >= 1.0f) continue;
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
  }
  for (const PlacedPage& page : pages) {
    paint_page(page, plan.border_texels, nearest, farthest, picture.image);
    add_square(page, {color_of(page.drawn ? Texels::drawn : Texels::cached), 255}, picture.lines);
  }
  return picture;
}

Image page_legend(View view, const PagePlan& plan, const std::vector<bool>& drawn, std::size_t level,
                  int picture_width) {
  const bool tint = view == View::cascades || (view == View::map && plan.levels.empty());
  if (!tint && view != View::kept && view != View::map) return legend(view, {}, picture_width);
  const LegendText text = tint                ? level_legend(plan)
                          : view == View::map ? resident_legend(plan, level)
                                              : cached_legend(served_by(plan, drawn), "pages");
  return field_legend(text.title, text.fields, picture_width);
}

}  // namespace gnomon::tool::view
