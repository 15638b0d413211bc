// Reads the golden numbers and the cases of tests/data.
#pragma once

#include <fstream>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace gnomon::test {

using Json = nlohmann::json;

/// tests/data/golden/<name>.json, kept for the whole run; throws where it cannot be read.
[[nodiscard]] inline const Json& golden(const std::string& name) {
  static std::map<std::string, Json> read;
  const auto [entry, added] = read.try_emplace(name);
  if (added) {
    std::ifstream file(std::string(GNOMON_TEST_DATA) + "/golden/" + name + ".json");
    if (!file) throw std::runtime_error("no golden numbers " + name);
    entry->second = Json::parse(file);
  }
  return entry->second;
}

/// A number; the files write infinity as the string "inf".
[[nodiscard]] inline double number(const Json& value) {
  if (value.is_string() && value.get<std::string>() == "inf") return std::numeric_limits<double>::infinity();
  return value.get<double>();
}
[[nodiscard]] inline glm::dvec3 vec3(const Json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}
/// From rows.
[[nodiscard]] inline glm::dmat4 mat4(const Json& rows) {
  glm::dmat4 m;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      m[column][row] =
          rows.at(static_cast<std::size_t>(row)).at(static_cast<std::size_t>(column)).get<double>();
    }
  }
  return m;
}

}  // namespace gnomon::test
