// `gnomon plan`: cases in, one shadow plan per line out.
#pragma once

#include <string>
#include <vector>

namespace gnomon::tool {

struct PlanRequest {
  std::vector<std::string> files;  ///< "-" is standard input, one case per line
  int repeats = 0;                 ///< 0: no timing
  bool pretty = false;             ///< several lines per plan
  bool log_perspective = false;    ///< add what a logarithmic perspective map would come to
};

/// Prints the plans in the order of the files and lines. Stops at the first bad case, by std::runtime_error
/// that names it; the plans before it are printed by then. Returns the exit code.
int run_plan(const PlanRequest& request);

}  // namespace gnomon::tool
