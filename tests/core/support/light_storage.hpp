// Memory of plan_lights for tests and benchmarks.
#pragma once

#include <cstddef>
#include <vector>

#include "gnomon/lights.hpp"

namespace gnomon::test {

class LightStorage {
 public:
  explicit LightStorage(std::size_t lights, std::size_t points = 0)
      : maps_(lights), work_(lights), places_(kMaxMaps * lights), points_(points) {}
  [[nodiscard]] LightMemory spans() noexcept { return {maps_, work_, places_, points_}; }

 private:
  std::vector<LightMaps> maps_;
  std::vector<LightWork> work_;
  std::vector<LightPlace> places_;
  std::vector<LightPoint> points_;
};

}  // namespace gnomon::test
