// Which of several warps has the least 95th percentile, at more points than a search takes?
#pragma once

#include "gnomon/extend/warp.hpp"

namespace gnomon {

/// The 95th percentile of the few points of a search is off by up to a tenth. Of `found` and the registry's
/// other warps that are nearly as good, the best by the mean over percentiles of more points.
[[nodiscard]] WarpChoice best_percentile(const WarpInput& input, const WarpChoice& found) noexcept;

}  // namespace gnomon
