// Which view depths a plan covers, and where it divides them.
#pragma once

#include <span>

#include "plan_context.hpp"

namespace gnomon {

/// View depths, world units; empty where begin > end.
struct DepthRange {
  double begin, end;
  [[nodiscard]] bool empty() const noexcept { return !(begin <= end); }
};

/// Fills in the borders between the cascades, edges.size() - 1 of them, by the options' scheme; `body` is
/// everything in view, relative to the camera. Sets c.seen first.
void choose_edges(PlanContext& c, const Polytope& body, std::span<double> edges) noexcept;

/// The part of [begin, end] from its first to its last depth at which a surface is seen; all of it where that
/// is not known.
[[nodiscard]] DepthRange seen_between(const PlanContext& c, double begin, double end) noexcept;

}  // namespace gnomon
