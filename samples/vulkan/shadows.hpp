// gnomon's maps in Vulkan: one image with a layer for each map, one uniform buffer for both passes. All that
// an engine adds to draw by a plan is here and in shadows.cpp, depth.vert and scene.frag.
#pragma once

#include <array>
#include <span>

#include "device.hpp"
#include "gnomon/gnomon.hpp"

namespace sample {

/// Clip space of the maps: Vulkan's, with reversed depths as the rest of the engine has them.
inline constexpr gnomon::ClipSpace kMapClipSpace{gnomon::NdcDepth::zero_to_one, true, true};

/// The plan as shaders read it; the same layout as in depth.vert and scene.frag.
struct ShadowData {
  std::array<glm::mat4, gnomon::kMaxMaps> clip_from_point;  ///< for drawing; points relative to the eye
  std::array<glm::vec4, gnomon::kMaxMaps> depth_bias;       ///< x: taken off depths at look-ups, 0..1
  gnomon::ShaderBlock block;                                ///< for look-ups
};

/// Pixels of a push constant: what a draw of depths needs.
struct DepthPush {
  glm::vec4 eye;  ///< vertices of the world minus this: points relative to the eye
  int map;
};

class Shadows {
 public:
  /// `vertices`: those of box i begin at 36 i.
  Shadows(Device& device, int map_size, int maps, VkBuffer vertices);
  /// How maps are drawn. layered: an instance of each caster for each map, whose vertex shader chooses the
  /// layer. multiview: the same by the device itself, for no more maps than it has views.
  enum class Passes { one_per_map, layered, multiview };
  [[nodiscard]] bool has(Passes passes) const {
    return pipelines_[static_cast<std::size_t>(passes)] != VK_NULL_HANDLE;
  }
  /// Records the upload of the plan and the drawing of its maps. They are then ready to be sampled.
  void record(VkCommandBuffer commands, VkDescriptorSet bound, const gnomon::ShadowPlan& plan,
              const gnomon::BiasOptions& bias, std::span<const gnomon::Box> casters, Passes passes);
  /// True where the device holds this plan's matrices to the last bit.
  [[nodiscard]] bool holds(const gnomon::ShadowPlan& plan);

  [[nodiscard]] const Buffer& data() const { return data_; }
  [[nodiscard]] const Image& maps() const { return maps_; }

 private:
  void begin(VkCommandBuffer commands, VkImageView view, Passes passes, float slope_factor) const;

  Device& device_;
  Buffer data_, read_;
  Image maps_;
  VkBuffer vertices_;
  std::array<VkPipeline, 3> pipelines_{};  // by Passes
};

}  // namespace sample
