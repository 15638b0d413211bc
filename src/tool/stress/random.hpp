// `gnomon stress --random`: random cases, checked, and the smallest that fails of each kind as a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "gnomon/render/context.hpp"

namespace gnomon::tool {

/// `out`, or gnomon_stress_seed_N in the folder for temporary files where it is empty.
[[nodiscard]] inline std::filesystem::path failure_folder(const std::string& out, std::uint64_t seed) {
  return out.empty() ? std::filesystem::temp_directory_path() / ("gnomon_stress_seed_" + std::to_string(seed))
                     : std::filesystem::path(out);
}

struct RandomStressRequest {
  std::uint64_t random = 0;  ///< random cases
  std::uint64_t seed = 1;
  std::string out;                  ///< folder for cases that fail; empty: see failure_folder()
  std::vector<std::string> replay;  ///< case and frame files that are checked as random ones, in their place
  render::ContextKind context = render::ContextKind::automatic;  ///< of frames
};

/// Prints counts, times of plans, and a line for each kind of failure. Writes a case file for each kind into
/// the folder `out`. Throws std::runtime_error for files that cannot be read or written. Returns 1 where a
/// case fails, else 0.
int run_random_stress(const RandomStressRequest& request);

}  // namespace gnomon::tool
