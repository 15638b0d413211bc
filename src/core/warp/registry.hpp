// What stages ask of a warp without knowing which it is.
#pragma once

#include "gnomon/extend/warp.hpp"
#include "gnomon/options.hpp"

namespace gnomon {

/// The shape that the options name.
[[nodiscard]] inline const Shape& requested_shape(const PlanOptions& options) noexcept {
  return options.warp.shape != nullptr ? *options.warp.shape : shapes::linear;
}
/// True for a shape that undoes what warps do along the view.
[[nodiscard]] inline bool undoes_warps(const Shape& shape) noexcept {
  return !shape.affine && shape.serving == nullptr && shape.round == nullptr;
}
/// The warp that the options name, and the default one where they name none: of a shape that undoes the
/// viewer's perspective along the view, the whole of that perspective.
[[nodiscard]] const Warp& requested_warp(const PlanOptions& options) noexcept;
/// True for the warp that leaves every map unwarped.
[[nodiscard]] bool is_unwarped(const Warp& warp) noexcept;
/// True for a warp that is searched for, and is no worse than any other one.
[[nodiscard]] bool is_searched(const Warp& warp) noexcept;

}  // namespace gnomon
