// Many lights on the GPU: their numbers, their maps, and the lists by which pixels find them.
#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "frame/frame_block.hpp"
#include "gl/gl_object.hpp"
#include "gnomon/lights.hpp"

namespace gnomon::render {

class LightLists {
 public:
  /// The driver has as many storage buffers in fragment shaders as shade_clusters.frag reads.
  [[nodiscard]] static bool are_supported() noexcept;

  void clear() noexcept;
  /// Adds a light: `block` is the one that a frame of it alone would have.
  void add(const Light& light, const FrameBlock& block, const glm::vec3& color);
  /// Sends everything and binds it where shade_clusters.frag reads it. False, with nothing bound, where
  /// lists cannot be made.
  [[nodiscard]] bool send(const Camera& camera, const ClusterOptions& options);

 private:
  /// Mirrors OwnLight of shaders/pass/mask/source/clusters.glsl.
  struct OwnLight {
    glm::vec4 light, light_place, light_cone, bias, layer, selection, brightness;
  };
  [[nodiscard]] LightClusters list(const Camera& camera, const ClusterOptions& options);

  std::vector<Light> lights_;
  std::vector<OwnLight> own_;
  std::vector<MapBlock> maps_;
  std::vector<std::uint32_t> begin_, listed_;
  std::vector<ClusterEntry> entries_;
  Buffer own_buffer_, map_buffer_, begin_buffer_, list_buffer_;
};

}  // namespace gnomon::render
