// A street of 200 units seen from its end: what the tests of pages plan for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/pages.hpp"

namespace gnomon::test {

/// Its houses, and its ground as the camera sees it.
struct Street {
  Camera camera = perspective_camera({0, 5, 0}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 250, 960, 640);
  Light light = DirectionalLight{{0.3, -1, 0.2}};
  std::vector<Box> boxes = {{{-20, -1, -200}, {20, 30, -1}}};
  std::vector<glm::dvec3> points, normals;
  std::vector<std::uint8_t> feedback;
  PageOptions options;
  const PagePlan* last = nullptr;

  Street() {
    for (int i = 0; i < 4000; ++i) points.push_back({-4.0 + i % 9, 0.0, -8.0 - 0.045 * i});
  }
  [[nodiscard]] PagePlan plan(std::span<std::byte> memory) const {
    const View view{.camera = camera, .points_world = points, .normals_world = normals};
    const PageHistory history{last, feedback};
    return plan_pages(view, light, {boxes, boxes}, options, memory, &history);
  }
};

}  // namespace gnomon::test
