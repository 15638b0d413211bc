// The engine's own pass: the street as the camera sees it, with the shadows of the maps, read back.
#pragma once

#include "device.hpp"
#include "shadows.hpp"
#include "street.hpp"

namespace sample {

class View {
 public:
  View(Device& device, int width, int height, VkBuffer vertices, std::uint32_t vertex_count,
       const Shadows& shadows);
  [[nodiscard]] VkDescriptorSet bound() const { return bound_; }
  /// Records the pass and the copies to the host.
  void record(VkCommandBuffer commands, const gnomon::Camera& camera);
  /// After the commands ran.
  [[nodiscard]] Drawn read() const;

 private:
  Device& device_;
  VkBuffer vertices_;
  std::uint32_t vertex_count_;
  Image color_, lit_, depth_;
  Buffer color_read_, lit_read_;
  VkPipeline pipeline_;
  VkDescriptorSet bound_;
};

}  // namespace sample
