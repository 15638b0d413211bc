// `gnomon compare`: every technique of a sweep on every frame of every scene, a row of results each.
#pragma once

#include "sweep.hpp"

namespace gnomon::tool {

/// Appends to `results.jsonl` in the sweep's folder, and writes the report unless this is one of several
/// shards. Throws std::runtime_error. Returns the exit code.
int run_compare(const CompareRequest& request, bool json);

}  // namespace gnomon::tool
