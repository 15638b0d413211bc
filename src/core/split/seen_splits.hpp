// Where do the cascades divide what is seen, so that the picture shows the least error?
#pragma once

#include <span>

#include "gnomon/extend/body.hpp"

namespace gnomon {

/// Moves the inner `edges` to where the picture's error is least that points of these view depths show.
/// `known`: they are of surfaces. Then the mean error counts at them, as one map over a part of them has it:
/// a constant, which a warp leaves, and the part's length over the point's depth. Else how many there are
/// says nothing. The depths between the nearest and the middle of the farthest and the end, in the logarithm,
/// are then divided logarithmically. `depths`: in any order, at most SeenPoints::kMost. Fewer than two inside
/// the edges leave those as they are.
void split_seen(std::span<const double> depths, bool known, std::span<double> edges) noexcept;

}  // namespace gnomon
