// `gnomon compare`: every technique of a sweep on every frame of every scene, a row of results each.
#pragma once

#include <string>

#include "sweep.hpp"

namespace gnomon::tool {

/// A sweep, or a part of one, into a folder.
struct CompareRequest : SweepRequest {
  std::size_t shard = 0, shards = 1;  ///< of the rows, each `shards`-th from `shard` on
  double map_memory_mib = 0.0;        ///< that a technique's maps may take; 0: what there is
  bool resume = false;                ///< rows that the folder has are not measured again

  [[nodiscard]] bool is_mine(std::uint64_t row) const noexcept { return row % shards == shard; }
};

/// Where it went.
struct Compared {
  std::string rows, page;  ///< files; no page: one of several shards
};
/// Appends to `results.jsonl` in the sweep's folder, and writes the report unless this is one of several
/// shards. Throws std::runtime_error.
Compared compare(const CompareRequest& request);

}  // namespace gnomon::tool
