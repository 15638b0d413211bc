// `gnomon compare`: every technique of a sweep on every frame of every scene, a row of results each.
#pragma once

#include <string>

#include "sweep.hpp"

namespace gnomon::tool {

/// Where it went.
struct Compared {
  std::string rows, page;  ///< files; no page: one of several shards
};
/// Appends to `results.jsonl` in the sweep's folder, and writes the report unless this is one of several
/// shards. Throws std::runtime_error.
Compared compare(const CompareRequest& request);

}  // namespace gnomon::tool
