// `gnomon stress`: extreme cases and stiff axes, judged.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::tool {

struct StressRequest {
  std::vector<std::string> axes;  ///< names, or all; none, no cases, no filters: all axes and cases
  bool cases = false;
  bool filters = false;  ///< filters at their limits, drawn
  std::string context = "auto";
  int samples = 80;  ///< values per axis
  int scenes = 4;    ///< per value
  std::uint64_t seed = 1;
  std::string out;  ///< folder for stability.jsonl and stability.csv; empty: none
  bool json = false, csv = false;
  long long random = 0;  ///< random cases; above 0: these alone, `out` is the folder for cases that fail
  std::vector<std::string> replay;  ///< case files that are checked as random cases are, alone
};

/// Prints tables, JSON lines or CSV. Throws std::runtime_error for what is no axis and for folders that
/// cannot be written. Returns 1 where a case fails or a number is not finite, else 0.
int run_stress(const StressRequest& request);

}  // namespace gnomon::tool
