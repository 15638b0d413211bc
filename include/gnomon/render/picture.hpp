// Pictures that explain themselves: text, legends, contact sheets. On the CPU, on 8-bit images.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "gnomon/scene/scene.hpp"

namespace gnomon::render {

/// 8-bit sRGB.
using Color = glm::u8vec3;

[[nodiscard]] Image blank_image(int width, int height, Color color);
/// Fills the rectangle, clipped to the image.
void fill_rectangle(Image& image, int x, int y, int width, int height, Color color);
/// Copies `from` to (x, y), clipped to `to`.
void paste(Image& to, const Image& from, int x, int y);
/// The image at another size no larger than it is, each pixel the average of those it covers.
[[nodiscard]] Image shrunk(const Image& image, int width, int height);

/// Glyphs of 5 x 7 dots, `scale` pixels a dot; one glyph and its gap are 6 dots wide. Characters outside of
/// printable ASCII are drawn as a box.
void draw_text(Image& image, int x, int y, std::string_view text, Color color, int scale = 1);
[[nodiscard]] int text_width(std::string_view text, int scale = 1) noexcept;
[[nodiscard]] int text_height(int scale = 1) noexcept;

/// The colour of aliasing error m: white at 1, warm above (undersampled), cold below (oversampled), on a log2
/// scale that ends at 1/16 and 16. Zero, negative and not-a-number count as 1/16, infinity as 16.
[[nodiscard]] Color heat_color(double m) noexcept;
/// The scale of heat_color with its ticks, sized to a picture of this width.
[[nodiscard]] Image heat_legend(int picture_width);
/// The same in the lower left corner of a picture.
void draw_heat_legend(Image& image);
/// Colour fields with what they stand for, in the lower left corner: the depth interval of each map.
struct LegendEntry {
  Color color;            ///< of the field
  std::string_view text;  ///< beside the field
};
void draw_legend(Image& image, std::string_view title, std::span<const LegendEntry> entries);
/// The colour that the cascade tint gives to a map.
[[nodiscard]] Color cascade_color(int map) noexcept;

}  // namespace gnomon::render
