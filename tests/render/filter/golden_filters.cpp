// Reads the golden rows of the filters.
#include "golden_filters.hpp"

#include <fstream>
#include <stdexcept>

namespace gnomon::render {

const nlohmann::json& golden_filters() {
  static const nlohmann::json file = [] {
    std::ifstream in(GNOMON_TEST_DATA "/golden/filters.json");
    if (!in) throw std::runtime_error("tests/data/golden/filters.json cannot be read");
    return nlohmann::json::parse(in);
  }();
  return file;
}

std::vector<GoldenRow> golden_rows() {
  std::vector<GoldenRow> rows;
  for (const nlohmann::json& each : golden_filters().at("rows")) {
    GoldenRow row;
    row.kernel.name = each.at("kernel").get<std::string>();
    const nlohmann::json& kernel = golden_filters().at("kernels").at(row.kernel.name);
    row.kernel.depth = kernel.at("z").get<std::vector<double>>();
    row.kernel.weight = kernel.at("w").get<std::vector<double>>();
    row.depth = each.at("d").get<double>();
    for (const auto& [name, value] : each.items()) {
      if (value.is_number()) row.answers[name] = value.get<double>();
    }
    rows.push_back(row);
  }
  return rows;
}

StoredTexel mean_over(const GoldenKernel& kernel, const FilterSettings& settings) {
  const Filter& filter = *settings.filter;
  StoredTexel sum = filter.reference.nothing != nullptr ? filter.reference.nothing(settings) : StoredTexel{};
  for (std::size_t i = 0; i < kernel.depth.size(); ++i) {
    const StoredTexel texel = filter.reference.store(kernel.depth[i], glm::dvec2(0.0), settings);
    if (filter.reference.join != nullptr) {
      filter.reference.join(sum, texel, kernel.weight[i], settings);
    } else {
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += kernel.weight[i] * texel[c];
    }
  }
  return sum;
}

}  // namespace gnomon::render
