// The best projective map of the light plane for a body: what `optimal` and `optimal_thorough` search for.
#pragma once

#include "gnomon/extend/warp.hpp"

namespace gnomon {

enum class SearchEffort {
  quick,     ///< from the best start: some microseconds
  thorough,  ///< from eight starts, the better ones for longer: six to nine times as long
};
/// Never worse by the objective than any other warp of the registry, but for those that search themselves.
/// From `input.start` on, where that is a good start.
[[nodiscard]] WarpChoice search_map(const WarpInput& input, SearchEffort effort) noexcept;

}  // namespace gnomon
