// `gnomon stress --random`: random cases, checked, and the smallest that fails of each kind as a file.
#pragma once

#include "stress.hpp"

namespace gnomon::tool {

/// Prints counts, times of plans, and a line for each kind of failure. Writes a case file for each kind into
/// the folder `out`. Throws std::runtime_error for files that cannot be read or written. Returns 1 where a
/// case fails, else 0.
int run_random_stress(const StressRequest& request);

}  // namespace gnomon::tool
