// Which lights and cameras does a glTF document have, and which nodes hold them?
#pragma once

#include <glm/mat4x4.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "gnomon/scene/scene.hpp"

namespace gnomon::detail {

struct LightSource {
  enum class Type { directional, spot, point } type = Type::directional;
  std::string name;
  double outer_radians = 0.0, range = 0.0;  // range 0: without end
};

struct CameraSource {
  std::string name;
  bool orthographic = false;
  double fov_y_radians = 0.0, height_world = 0.0, near_depth = 0.0, far_depth = 0.0;  // far may be infinite
};

/// Of KHR_lights_punctual and `cameras`. What is broken is warned of, and missing.
struct ViewSource {
  struct LightNode {
    std::size_t node;
    LightSource light;
  };
  struct CameraNode {
    std::size_t node;
    CameraSource camera;
  };
  std::vector<LightNode> lights;    // in the order of nodes
  std::vector<CameraNode> cameras;  // the same
};
[[nodiscard]] ViewSource read_view_source(const nlohmann::json& source, std::vector<std::string>& warnings);

/// Places them in the scene: those of nodes that are shown. A light without a range gets twice the diagonal
/// of the scene and itself.
void place_views(const ViewSource& source, const std::vector<glm::dmat4>& world_from_node,
                 const std::vector<int>& shown, Scene& scene);

}  // namespace gnomon::detail
