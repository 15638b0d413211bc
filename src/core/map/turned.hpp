// A map's rectangle turned to the least area.
#pragma once

#include "gnomon/warp.hpp"

namespace gnomon {

/// The choice with its rectangle turned to the least area, where that lowers the objective.
[[nodiscard]] WarpChoice turned_to_least_area(const WarpInput& in, const WarpChoice& choice) noexcept;

}  // namespace gnomon
