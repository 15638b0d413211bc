// The golden kernels and rows of tests/data/golden/filters.json: depths with weights, and what each filter
// answers.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gnomon/render/filter.hpp"

namespace gnomon::render {

struct GoldenKernel {
  std::string name;
  std::vector<double> depth, weight;
};
struct GoldenRow {
  GoldenKernel kernel;
  double depth = 0.0;  ///< of the receiver
  std::map<std::string, double> answers;
  [[nodiscard]] double answer(const std::string& filter) const { return answers.at(filter); }
};

/// The whole file.
[[nodiscard]] const nlohmann::json& golden_filters();
[[nodiscard]] std::vector<GoldenRow> golden_rows();
/// What a blur over the kernel leaves of the filter's stored texels; surfaces that face the light.
[[nodiscard]] StoredTexel mean_over(const GoldenKernel& kernel, const FilterSettings& settings);

}  // namespace gnomon::render
