// A plan of ours as any engine would hand its maps in.
#pragma once

#include <nlohmann/json.hpp>

#include "gnomon/camera.hpp"
#include "gnomon/plan.hpp"

namespace gnomon::judge::test {

[[nodiscard]] inline nlohmann::json numbers(const glm::dmat4& matrix) {
  nlohmann::json list = nlohmann::json::array();
  for (int i = 0; i < 16; ++i) list.push_back(matrix[i / 4][i % 4]);
  return list;
}

[[nodiscard]] inline nlohmann::json camera_of(const Camera& camera) {
  return {{"view_from_world", numbers(view_from_world(camera))},
          {"clip_from_view", numbers(clip_from_view(camera))},
          {"width", camera.width},
          {"height", camera.height}};
}

/// A capture of one sun. Boxes and the bias are the caller's to add.
[[nodiscard]] inline nlohmann::json plan_capture(const ShadowPlan& plan, const Camera& camera,
                                                 const glm::dvec3& sun) {
  nlohmann::json maps = nlohmann::json::array();
  for (const ShadowMap& map : plan.maps())
    maps.push_back({{"clip_from_world", numbers(map.clip_from_world)},
                    {"width", map.width},
                    {"height", map.height},
                    {"depths", {map.depth_begin, map.depth_end}}});
  return {{"format", "gnomon-capture/1"},
          {"camera", camera_of(camera)},
          {"lights", {{{"type", "directional"}, {"direction", {sun.x, sun.y, sun.z}}}}},
          {"maps", maps}};
}

}  // namespace gnomon::judge::test
