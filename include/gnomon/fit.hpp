// How is a map fitted to the receivers it serves?
#pragma once

#include <cstdint>
#include <string_view>

namespace gnomon {

enum class Fit : std::uint8_t {
  tight,          ///< the smallest rectangle round the slice's receivers: best texels, a grid that moves with
                  ///< the camera
  rotated,        ///< as tight, and the rectangle may turn: the least area where that lowers the objective
  stable,         ///< a square whose size depends on the slice alone, snapped to whole texels: a stable grid
  warped_stable,  ///< as tight with room to spare, and kept as it is while the view stays inside: with a
                  ///< PlanHistory (history.hpp) a warped grid that rarely changes
};
[[nodiscard]] std::string_view to_string(Fit fit) noexcept;
/// True and `fit` set where `name` is one of tight, rotated, stable, warped_stable.
[[nodiscard]] bool fit_from_name(std::string_view name, Fit& fit) noexcept;

/// The longest distance between two corners of the frustum slice [begin, end] of a camera with these image
/// edges. It is found in view space: the same bits every frame. Image edges as in Camera. This is the
/// side of a square that holds the slice from every direction; never above the diameter of the smallest
/// enclosing sphere.
[[nodiscard]] double longest_chord(double left, double right, double bottom, double top, bool orthographic,
                                   double begin, double end) noexcept;

}  // namespace gnomon
