// What the tables over the cases share: the cases themselves, what their ratios are relative to, and means.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "gnomon/casefile/casefile.hpp"
#include "gnomon/gnomon.hpp"
#include "median.hpp"

namespace gnomon {

struct NamedCase : Case {
  std::string name;
};

/// All of tests/data/cases, by name.
inline std::vector<NamedCase> load_cases() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(GNOMON_TEST_DATA "/cases"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<NamedCase> cases;
  for (const auto& file : files) cases.push_back({load_case(file), file.stem().string()});
  return cases;
}

/// The error with tight, unwarped maps: one, or several that part the camera's range practically at lambda
/// 0.9.
inline AliasingStats unwarped_error(const Case& c, int cascades) {
  PlanOptions o;
  o.cascades = cascades;
  o.warp.warp = &warps::none;
  o.split.scheme = SplitScheme::practical;
  o.split.lambda = 0.9;
  o.split.range = SplitRange::camera;
  return measure(make_plan(c.camera, c.light, c.bounds(), o), c.camera, c.bounds());
}

inline double geometric_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += std::log(v);
  return std::exp(sum / static_cast<double>(values.size()));
}

}  // namespace gnomon
