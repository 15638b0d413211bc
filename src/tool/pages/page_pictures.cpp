// Pictures of a frame with pages: which level serves what, and what was kept.
#include "page_pictures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "gnomon/render/picture.hpp"
#include "picture_colors.hpp"

namespace gnomon::tool {
namespace {

using render::Color;

/// Blue and orange of Okabe and Ito, and their yellow between: apart by brightness as well.
constexpr std::array<Color, 3> kStates{{{0, 114, 178}, {240, 228, 66}, {230, 159, 0}}};
constexpr std::array<const char*, 3> kStateNames{"kept from earlier frames",
                                                 "kept, and moved by whole texels", "drawn in this frame"};
constexpr Color kNoMap{150, 152, 158};

bool is_surface(const FloatImage& normals, std::size_t pixel) {
  return normals.values[4 * pixel + 3] > 0.0f;
}

int index_at(const FloatImage& mask, std::size_t pixel) {
  return static_cast<int>(mask.values[2 * pixel + 1]);
}

double fineness_of(std::size_t level, std::size_t levels) {
  return levels < 2 ? 1.0 : static_cast<double>(level) / static_cast<double>(levels - 1);
}

}  // namespace

Color color_of(Texels texels) noexcept {
  return kStates[static_cast<std::size_t>(texels)];
}

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
    // Dark pixels keep enough of the colour to differ.
    constexpr double kLeast = 0.45;
    set_pixel(image, i, mixed({0, 0, 0}, color, kLeast + (1.0 - kLeast) * luma));
  }
  return image;
}

Image cached_picture(const FloatImage& mask, const FloatImage& normals, std::span<const Served> served) {
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
    served.push_back({i < drawn.size() && !drawn[i] ? Texels::cached : Texels::drawn,
                      fineness_of(plan.pages[i].level, plan.levels.size())});
  return served;
}

std::vector<Served> served_by(const render::FrameStats& stats) {
  std::vector<Served> served;
  for (std::size_t i = 0; i < static_cast<std::size_t>(stats.map_count); ++i) {
    const render::MapStats& map = stats.map[i];
    served.push_back({map.held ? Texels::cached : map.scrolled ? Texels::scrolled : Texels::drawn, 1.0});
  }
  return served;
}

LegendText level_legend(const PagePlan& plan) {
  std::vector<std::size_t> pages(plan.levels.size(), 0);
  for (const Page& page : plan.pages) ++pages[page.level];
  LegendText legend;
  // As many as a small picture has room for, evenly chosen.
  constexpr std::size_t kMaxFields = 8;
  const std::size_t count = std::min(plan.levels.size(), kMaxFields);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t level = count < 2 ? 0 : i * (plan.levels.size() - 1) / (count - 1);
    const ShadowMap& map = plan.levels[level];
    legend.fields.emplace_back(
        level_color(level, plan.levels.size()),
        fmt::format("level {}: texel {:.3g} x {:.3g}, {} page{}", level, map.texel_world.x, map.texel_world.y,
                    pages[level], pages[level] == 1 ? "" : "s"));
  }
  legend.title = plan.levels.empty() ? "no pages: " + std::string(to_string(plan.status))
                                     : fmt::format("{} pages on {} levels, {}", plan.pages.size(),
                                                   plan.levels.size(), plan.policy->name);
  return legend;
}

LegendText cached_legend(std::span<const Served> served, const std::string& what) {
  LegendText legend;
  for (const Texels texels : {Texels::cached, Texels::scrolled, Texels::drawn}) {
    const auto count = std::count_if(served.begin(), served.end(),
                                     [texels](const Served& by) { return by.texels == texels; });
    // Pages are never scrolled.
    if (texels == Texels::scrolled && count == 0) continue;
    legend.fields.emplace_back(color_of(texels),
                               fmt::format("{}: {}", kStateNames[static_cast<std::size_t>(texels)], count));
  }
  const bool levels =
      std::any_of(served.begin(), served.end(), [](const Served& by) { return by.fineness < 1.0; });
  legend.title = fmt::format("{} {}{}", served.size(), what, levels ? "; darker: coarser level" : "");
  return legend;
}

LegendText resident_legend(const PagePlan& plan, std::size_t level) {
  const auto count = static_cast<std::size_t>(std::count_if(
      plan.pages.begin(), plan.pages.end(), [level](const Page& page) { return page.level == level; }));
  const ShadowMap& map = plan.levels[level];
  return {fmt::format("level {} of {}: {} x {} texels, {} page{} resident", level, plan.levels.size(),
                      map.width, map.height, count, count == 1 ? "" : "s"),
          {{color_of(Texels::cached), kStateNames[0]}, {color_of(Texels::drawn), kStateNames[2]}}};
}

}  // namespace gnomon::tool
