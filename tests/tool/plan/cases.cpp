// Cases for tests: the project's own files, and a small one to change.
#include "cases.hpp"

#include <algorithm>

namespace gnomon::test {

std::vector<std::filesystem::path> case_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(GNOMON_TEST_DATA "/cases"))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

json base_case() {
  return json::parse(R"({
    "camera": {"position": [0, 2, 12], "forward": [0, -0.15, -1], "up": [0, 1, 0], "fov_y_deg": 60,
               "aspect": 1.5, "near": 0.5, "far": 100, "width": 1200, "height": 800},
    "light": {"type": "directional", "direction": [0.3, -1, -0.2]},
    "receivers": {"min": [-10, 0, -10], "max": [10, 0, 10]},
    "casters": [{"min": [-1, 0, -1], "max": [1, 3, 1]}]
  })");
}

json base_case_with(const std::string& pointer, const json& value) {
  json result = base_case();
  const json::json_pointer place(pointer);
  if (!value.is_null()) {
    result[place] = value;
  } else {
    result[place.parent_pointer()].erase(place.back());
  }
  return result;
}

}  // namespace gnomon::test
