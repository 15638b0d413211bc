// The views of pages: which level serves what, what was kept, and what lies in a level.
#include "page_pictures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gnomon/render/picture.hpp"
#include "picture_colors.hpp"

namespace gnomon::tool::view {
namespace {

using render::Color;

/// Blue and orange of Okabe and Ito, and their yellow between: apart by brightness as well.
constexpr std::array<Color, 3> kStates{{{0, 114, 178}, {240, 228, 66}, {230, 159, 0}}};
constexpr std::array<const char*, 3> kStateNames{"kept from earlier frames",
                                                 "kept, and moved by whole texels", "drawn in this frame"};
constexpr Color kNoMap{150, 152, 158}, kEmpty{24, 24, 28};

Color color_of(Texels texels) {
  return kStates[static_cast<std::size_t>(texels)];
}

glm::u8vec4 opaque(const Color& color) {
  return {color.r, color.g, color.b, 255};
}

bool is_surface(const FloatImage& normals, std::size_t pixel) {
  return normals.values[4 * pixel + 3] > 0.0f;
}

int index_at(const FloatImage& mask, std::size_t pixel) {
  return static_cast<int>(mask.values[2 * pixel + 1]);
}

double fineness_of(std::size_t level, std::size_t levels) {
  return levels < 2 ? 1.0 : static_cast<double>(level) / static_cast<double>(levels - 1);
}

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

Color level_color(std::size_t level, std::size_t levels) noexcept {
  // Violet to yellow over green: brightness rises all the way, for every kind of eye.
  constexpr std::array<Color, 5> kStops{
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double at = fineness_of(level, levels) * (kStops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  return mixed(kStops[stop], kStops[stop + 1], at - static_cast<double>(stop));
}

Image level_picture(const Image& lit, const FloatImage& mask, const FloatImage& normals,
                    const PagePlan& plan) {
  Image image = lit;
  for (std::size_t i = 0; i < mask.values.size() / 2; ++i) {
    const int page = index_at(mask, i);
    if (!is_surface(normals, i) || page < 0 || page >= static_cast<int>(plan.pages.size())) continue;
    const Color color = level_color(plan.pages[static_cast<std::size_t>(page)].level, plan.levels.size());
    const double luma =
        (0.2126 * lit.rgba[4 * i] + 0.7152 * lit.rgba[4 * i + 1] + 0.0722 * lit.rgba[4 * i + 2]) / 255.0;
    // Dark pixels keep enough of the colour to be told apart.
    constexpr double kLeast = 0.45;
    set_pixel(image, i, mixed({0, 0, 0}, color, kLeast + (1.0 - kLeast) * luma));
  }
  return image;
}

Image kept_picture(const FloatImage& mask, const FloatImage& normals, std::span<const Served> served) {
  Image image = render::blank_image(mask.width, mask.height, kSky);
  const auto width = static_cast<std::size_t>(mask.width);
  for (std::size_t i = 0; i < mask.values.size() / 2; ++i) {
    if (!is_surface(normals, i)) continue;
    const int index = index_at(mask, i);
    if (index < 0 || index >= static_cast<int>(served.size())) {
      set_pixel(image, i, mixed(kShadow, kNoMap, static_cast<double>(mask.values[2 * i])));
      continue;
    }
    const Served& by = served[static_cast<std::size_t>(index)];
    // Shadow shows through, and coarser levels are darker.
    constexpr double kCoarsest = 0.55, kInShadow = 0.72;
    double bright = kCoarsest + (1.0 - kCoarsest) * by.fineness;
    bright *= kInShadow + (1.0 - kInShadow) * static_cast<double>(mask.values[2 * i]);
    const bool ends = (i % width != 0 && is_surface(normals, i - 1) && index_at(mask, i - 1) != index) ||
                      (i >= width && is_surface(normals, i - width) && index_at(mask, i - width) != index);
    set_pixel(image, i, mixed({0, 0, 0}, color_of(by.texels), ends ? 0.35 * bright : bright));
  }
  return image;
}

std::vector<Served> served_by(const PagePlan& plan, const std::vector<bool>& drawn) {
  std::vector<Served> served;
  for (std::size_t i = 0; i < plan.pages.size(); ++i)
    served.push_back({i < drawn.size() && !drawn[i] ? Texels::kept : Texels::drawn,
                      fineness_of(plan.pages[i].level, plan.levels.size())});
  return served;
}

std::vector<Served> served_by(const render::FrameStats& stats) {
  std::vector<Served> served;
  for (std::size_t i = 0; i < static_cast<std::size_t>(stats.map_count); ++i) {
    const render::MapStats& map = stats.map[i];
    served.push_back({map.held ? Texels::kept : map.scrolled ? Texels::scrolled : Texels::drawn, 1.0});
  }
  return served;
}

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
    add_square(page, opaque(color_of(page.drawn ? Texels::drawn : Texels::kept)), picture.lines);
  }
  return picture;
}

namespace {

Image level_legend(const PagePlan& plan, int picture_width) {
  std::vector<std::size_t> pages(plan.levels.size(), 0);
  for (const Page& page : plan.pages) ++pages[page.level];
  std::vector<std::pair<Color, std::string>> fields;
  // As many as a small picture has room for, evenly chosen.
  constexpr std::size_t kMostFields = 8;
  const std::size_t count = std::min(plan.levels.size(), kMostFields);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t level = count < 2 ? 0 : i * (plan.levels.size() - 1) / (count - 1);
    const ShadowMap& map = plan.levels[level];
    fields.emplace_back(level_color(level, plan.levels.size()),
                        fmt::format("level {}: texel {:.3g} x {:.3g}, {} page{}", level, map.texel_world.x,
                                    map.texel_world.y, pages[level], pages[level] == 1 ? "" : "s"));
  }
  return field_legend(plan.levels.empty() ? "no pages: " + std::string(to_string(plan.status))
                                          : fmt::format("{} pages on {} levels, {}", plan.pages.size(),
                                                        plan.levels.size(), plan.policy->name),
                      fields, picture_width);
}

}  // namespace

Image kept_legend(std::span<const Served> served, const std::string& what, int picture_width) {
  std::vector<std::pair<Color, std::string>> fields;
  for (const Texels texels : {Texels::kept, Texels::scrolled, Texels::drawn}) {
    const auto count = std::count_if(served.begin(), served.end(),
                                     [texels](const Served& by) { return by.texels == texels; });
    // Pages are never scrolled.
    if (texels == Texels::scrolled && count == 0) continue;
    fields.emplace_back(color_of(texels),
                        fmt::format("{}: {}", kStateNames[static_cast<std::size_t>(texels)], count));
  }
  const bool levels =
      std::any_of(served.begin(), served.end(), [](const Served& by) { return by.fineness < 1.0; });
  return field_legend(fmt::format("{} {}{}", served.size(), what, levels ? "; darker: coarser level" : ""),
                      fields, picture_width);
}

Image page_legend(View view, const PagePlan& plan, const std::vector<bool>& drawn, std::size_t level,
                  int picture_width) {
  if (view == View::cascades) return level_legend(plan, picture_width);
  if (view == View::kept) return kept_legend(served_by(plan, drawn), "pages", picture_width);
  if (view != View::map) return legend(view, {}, picture_width);
  if (plan.levels.empty()) return level_legend(plan, picture_width);
  const auto count = static_cast<std::size_t>(std::count_if(
      plan.pages.begin(), plan.pages.end(), [level](const Page& page) { return page.level == level; }));
  const ShadowMap& map = plan.levels[level];
  return field_legend(fmt::format("level {} of {}: {} x {} texels, {} page{} resident", level,
                                  plan.levels.size(), map.width, map.height, count, count == 1 ? "" : "s"),
                      {{color_of(Texels::kept), kStateNames[0]}, {color_of(Texels::drawn), kStateNames[2]}},
                      picture_width);
}

}  // namespace gnomon::tool::view
