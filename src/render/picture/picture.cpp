// Text, legends and contact sheets.
#include "gnomon/render/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "picture/font.hpp"

namespace gnomon::render {
namespace {

/// log2 m = -4, -3 .. 4, as in shaders/pass/shade/heat.frag.
constexpr std::array<glm::dvec3, 9> kHeatStops{{{0.110, 0.078, 0.353},
                                                {0.141, 0.220, 0.573},
                                                {0.161, 0.443, 0.710},
                                                {0.478, 0.710, 0.843},
                                                {0.961, 0.961, 0.949},
                                                {0.992, 0.804, 0.439},
                                                {0.957, 0.514, 0.220},
                                                {0.808, 0.196, 0.149},
                                                {0.463, 0.039, 0.118}}};
constexpr int kHeatEnd = 4;  ///< log2 m at both ends of the scale

/// As in shaders/pass/shade/tint.frag, brightened to what the tint makes of a lit white surface.
constexpr std::array<Color, 8> kCascadeColors{{{255, 110, 95},
                                               {115, 225, 110},
                                               {105, 150, 255},
                                               {255, 215, 80},
                                               {225, 125, 240},
                                               {90, 220, 220},
                                               {255, 165, 90},
                                               {180, 180, 180}}};
constexpr Color kPanel{24, 24, 28}, kInk{240, 240, 236};

int text_scale(int picture_width) {
  return std::max(1, picture_width / 640);
}

std::size_t offset(const Image& image, int x, int y) {
  return (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) *
         4;
}

}  // namespace

Image blank_image(int width, int height, Color color) {
  Image image{"", width, height, {}};
  image.rgba.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4, 255);
  fill_rectangle(image, 0, 0, width, height, color);
  return image;
}

void fill_rectangle(Image& image, int x, int y, int width, int height, Color color) {
  for (int row = std::max(y, 0); row < std::min(y + height, image.height); ++row) {
    for (int column = std::max(x, 0); column < std::min(x + width, image.width); ++column) {
      std::uint8_t* pixel = image.rgba.data() + offset(image, column, row);
      pixel[0] = color.x;
      pixel[1] = color.y;
      pixel[2] = color.z;
    }
  }
}

void paste(Image& to, const Image& from, int x, int y) {
  const int first = std::max(0, -x), last = std::min(from.width, to.width - x);
  if (first >= last) return;
  for (int row = std::max(0, -y); row < std::min(from.height, to.height - y); ++row) {
    const auto begin = from.rgba.begin() + static_cast<std::ptrdiff_t>(offset(from, first, row));
    std::copy(begin, begin + std::ptrdiff_t{4} * (last - first),
              to.rgba.begin() + static_cast<std::ptrdiff_t>(offset(to, x + first, y + row)));
  }
}

Image shrunk(const Image& image, int width, int height) {
  Image out = blank_image(width, height, kPanel);
  for (int y = 0; y < height; ++y) {
    const int y0 = y * image.height / height, y1 = std::max(y0 + 1, (y + 1) * image.height / height);
    for (int x = 0; x < width; ++x) {
      const int x0 = x * image.width / width, x1 = std::max(x0 + 1, (x + 1) * image.width / width);
      std::array<int, 3> sum{};
      for (int v = y0; v < y1; ++v) {
        for (int u = x0; u < x1; ++u) {
          for (std::size_t c = 0; c < 3; ++c) sum[c] += image.rgba[offset(image, u, v) + c];
        }
      }
      const int count = (y1 - y0) * (x1 - x0);
      for (std::size_t c = 0; c < 3; ++c) {
        out.rgba[offset(out, x, y) + c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
      }
    }
  }
  return out;
}

void draw_text(Image& image, int x, int y, std::string_view text, Color color, int scale) {
  for (const char character : text) {
    const Glyph& glyph = glyph_of(character);
    for (int column = 0; column < kGlyphWidth; ++column) {
      for (int row = 0; row < kGlyphHeight; ++row) {
        if (((glyph[static_cast<std::size_t>(column)] >> row) & 1) == 0) continue;
        fill_rectangle(image, x + column * scale, y + row * scale, scale, scale, color);
      }
    }
    x += (kGlyphWidth + 1) * scale;
  }
}

int text_width(std::string_view text, int scale) noexcept {
  return text.empty() ? 0 : (static_cast<int>(text.size()) * (kGlyphWidth + 1) - 1) * scale;
}
int text_height(int scale) noexcept {
  return kGlyphHeight * scale;
}

Color heat_color(double m) noexcept {
  const double bounded =
      m > 0.0 ? std::clamp(std::log2(m), -1.0 * kHeatEnd, 1.0 * kHeatEnd) : -1.0 * kHeatEnd;
  const double at = bounded + kHeatEnd;
  const auto i = std::min(static_cast<std::size_t>(at), kHeatStops.size() - 2);
  const double t = at - static_cast<double>(i);
  return Color((kHeatStops[i] * (1.0 - t) + kHeatStops[i + 1] * t) * 255.0 + 0.5);
}

Color cascade_color(int map) noexcept {
  return kCascadeColors[static_cast<std::size_t>(map) % kCascadeColors.size()];
}

Image heat_legend(int picture_width) {
  constexpr std::array<std::string_view, 2 * kHeatEnd + 1> kTicks{"1/16", "1/8", "1/4", "1/2", "1",
                                                                  "2",    "4",   "8",   "16"};
  constexpr std::string_view kTitle = "m: screen pixels per shadow texel", kCold = "oversampled",
                             kWarm = "undersampled";
  const int s = text_scale(picture_width), pad = 6 * s, step = 30 * s, bar = 2 * kHeatEnd * step,
            bar_height = 10 * s;
  const int line = text_height(s) + 4 * s;
  const int width = bar + step + 2 * pad, bar_left = pad + step / 2, bar_top = pad + line;
  Image image = blank_image(width, 2 * pad + 3 * line + bar_height, kPanel);
  draw_text(image, (width - text_width(kTitle, s)) / 2, pad, kTitle, kInk, s);
  for (int x = 0; x < bar; ++x) {
    const double log_m = (x + 0.5) / step - kHeatEnd;
    fill_rectangle(image, bar_left + x, bar_top, 1, bar_height, heat_color(std::exp2(log_m)));
  }
  for (int i = 0; i <= 2 * kHeatEnd; ++i) {
    const std::string_view tick = kTicks[static_cast<std::size_t>(i)];
    const int x = bar_left + i * step;
    fill_rectangle(image, x - s / 2, bar_top + bar_height, s, 3 * s, kInk);
    draw_text(image, x - text_width(tick, s) / 2, bar_top + bar_height + 4 * s, tick, kInk, s);
  }
  const int last = bar_top + bar_height + line + 2 * s;
  draw_text(image, bar_left, last, kCold, heat_color(0.4), s);
  draw_text(image, bar_left + bar - text_width(kWarm, s), last, kWarm, heat_color(3.0), s);
  return image;
}

void draw_heat_legend(Image& image) {
  const Image legend = heat_legend(image.width);
  const int pad = 6 * text_scale(image.width);
  paste(image, legend, pad, image.height - legend.height - pad);
}

void draw_legend(Image& image, std::string_view title, std::span<const LegendEntry> entries) {
  const int s = text_scale(image.width), pad = 6 * s, line = text_height(s) + 4 * s,
            field = 2 * text_height(s);
  int widest = text_width(title, s);
  for (const LegendEntry& entry : entries) widest = std::max(widest, field + pad + text_width(entry.text, s));
  const int width = widest + 2 * pad,
            height = 2 * pad + line * (static_cast<int>(entries.size()) + 1) - 4 * s;
  const int left = pad;
  int y = image.height - height - pad;
  fill_rectangle(image, left, y, width, height, kPanel);
  y += pad;
  draw_text(image, left + pad, y, title, kInk, s);
  for (const LegendEntry& entry : entries) {
    y += line;
    fill_rectangle(image, left + pad, y, field, text_height(s), entry.color);
    draw_text(image, left + 2 * pad + field, y, entry.text, kInk, s);
  }
}

}  // namespace gnomon::render
