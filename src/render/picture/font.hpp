// The glyphs that draw_text knows.
#pragma once

#include <array>
#include <cstdint>

namespace gnomon::render {

inline constexpr int kGlyphWidth = 5, kGlyphHeight = 8;
/// Columns left to right, lowest bit on top.
using Glyph = std::array<std::uint8_t, kGlyphWidth>;
[[nodiscard]] const Glyph& glyph_of(char character) noexcept;

}  // namespace gnomon::render
