// Which part of a depth range shows a surface, and slices that skip what shows none.
#pragma once

#include <span>

#include "gnomon/view.hpp"

namespace gnomon {

/// View depths, world units; empty where begin > end.
struct DepthRange {
  double begin, end;
  [[nodiscard]] bool empty() const noexcept { return !(begin <= end); }
};

/// The part of [begin, end] from its first to its last depth at which a surface is visible.
[[nodiscard]] DepthRange visible_range(const VisibleDepths& depths, double begin, double end) noexcept;

/// Logarithmic slices of what is visible, with the least ratio of far to near depth: skips depths between
/// that show nothing.
void split_visible(const VisibleDepths& depths, DepthRange cover, std::span<double> edges) noexcept;

}  // namespace gnomon
