// What stages ask of a warp without knowing which it is.
#pragma once

#include "gnomon/extend/warp.hpp"

namespace gnomon {

/// True for the warp that leaves every map unwarped.
[[nodiscard]] bool is_unwarped(const Warp& warp) noexcept;
/// True for a warp that is searched for, and is no worse than any other one.
[[nodiscard]] bool is_searched(const Warp& warp) noexcept;

}  // namespace gnomon
