// `gnomon calibrate`: what shadows cost on this machine, fitted to a sweep, and held against others.
#pragma once

#include <string>
#include <vector>

namespace gnomon::tool {

struct CalibrateRequest {
  std::vector<std::string> folders;  ///< with results.jsonl; empty: a sweep is measured first
  std::string model = "out/cost_model.json";
  bool check = false;  ///< the model is read and held against the folders, else fitted to them and written
  std::string out = "out/calibrate";  ///< of the sweep that is measured
  std::string context = "auto";
};

/// Prints what was fitted, or the planner's picks beside the measured front. Throws std::runtime_error.
int run_calibrate(const CalibrateRequest& request, bool json);

}  // namespace gnomon::tool
