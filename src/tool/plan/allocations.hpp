// How often this thread has asked for heap memory through operator new: how `--repeat` proves that a plan
// asks never.
#pragma once

#include <cstdint>

namespace gnomon::tool {

/// Calls of operator new on this thread since it began.
[[nodiscard]] std::uint64_t allocation_count() noexcept;

}  // namespace gnomon::tool
