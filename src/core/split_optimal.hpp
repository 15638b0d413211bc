// Splits for the receivers that are really there.
#pragma once

#include <span>

#include "gnomon/body.hpp"
#include "plan_context.hpp"

namespace gnomon {

/// Moves the inner edges, which come in as logarithmic splits of [edges.front(), edges.back()], to where the
/// plan's objective is least for this body (relative to the camera): the sum over the maps for
/// Objective::storage, the worst map for the others.
void optimise_splits(const PlanContext& c, const Polytope& body, std::span<double> edges) noexcept;

}  // namespace gnomon
