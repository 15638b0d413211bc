// The colors of masks and errors, the same in the report's pictures and in the window.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "gnomon/render/picture.hpp"

namespace gnomon::tool {

inline constexpr render::Color kSky{214, 224, 234}, kUndecided{160, 60, 160};
inline constexpr render::Color kShadow{40, 42, 50}, kLit{245, 243, 236};
/// Orange and blue differ by brightness as well, and for those who see red and green alike.
inline constexpr render::Color kFalseLight{255, 140, 0}, kFalseShadow{30, 110, 230};

/// Keeps the pixel's alpha.
inline void set_pixel(Image& image, std::size_t pixel, const render::Color& color) noexcept {
  image.rgba[4 * pixel] = color.r;
  image.rgba[4 * pixel + 1] = color.g;
  image.rgba[4 * pixel + 2] = color.b;
}

/// `a` at share 0, `b` at 1; shares beyond are clamped.
[[nodiscard]] inline render::Color mixed(const render::Color& a, const render::Color& b,
                                         double share) noexcept {
  const double s = std::clamp(share, 0.0, 1.0);
  const auto channel = [s](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(from + (to - from) * s + 0.5);
  };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

/// An error of visibility, from -1, false shadow, to 1, false light; the truth pales behind it.
[[nodiscard]] inline render::Color error_color(double truth, double error) noexcept {
  const render::Color ground = mixed(mixed(kShadow, kLit, truth), kSky, 0.5);
  return mixed(ground, error > 0.0 ? kFalseLight : kFalseShadow, error < 0.0 ? -error : error);
}

}  // namespace gnomon::tool
