// The part of Vulkan that every program needs: an instance with validation, a device, memory, pipelines. It
// is Vulkan 1.2 with dynamic rendering and synchronization 2: RenderDoc hides 1.3 on some drivers.
// Nothing here is about shadows.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace sample {

/// A call of Vulkan failed, or there is no device for this program. what() is one line.
class VulkanError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Buffer {
  VkBuffer handle = VK_NULL_HANDLE;
  std::size_t bytes = 0;
  std::byte* mapped = nullptr;  ///< memory of the host; nullptr: the device's own
};

struct Image {
  VkImage handle = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;     ///< of all layers, as an array
  std::vector<VkImageView> layer_views;  ///< of one layer each
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkExtent2D size{};
  VkImageAspectFlags aspect = 0;
};

/// How an image or a buffer is used before or after a barrier.
struct Use {
  VkPipelineStageFlags2 stages;
  VkAccessFlags2 access;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

using Spirv = std::span<const std::uint32_t>;

/// The differences between pipelines. All of them take vertices of a position and a normal, compare depths by
/// GREATER_OR_EQUAL, draw both sides of triangles, and leave viewport, scissor and depth bias to the
/// commands.
struct PipelineOf {
  Spirv vertex, fragment;  ///< no fragment shader: depths alone
  std::vector<VkFormat> colors;
  std::uint32_t view_mask = 0;  ///< multiview: a bit for each layer
};

/// A device, one queue of it, and one layout of bindings: 0 a uniform buffer, 1 a sampled image; push
/// constants of 128 bytes. Whatever it makes lives as long as it does.
class Device {
 public:
  explicit Device(bool validated);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool multiview() const { return multiview_; }
  /// Vertex shaders may choose the layer that they draw into.
  [[nodiscard]] bool layer_by_vertex() const { return layer_by_vertex_; }
  /// Warnings and errors of the validation layers, and the first of them.
  [[nodiscard]] int messages() const { return messages_->count; }
  [[nodiscard]] const std::string& first_message() const { return messages_->first; }

  [[nodiscard]] Buffer make_buffer(std::size_t bytes, VkBufferUsageFlags usage, bool on_host);
  [[nodiscard]] Image make_image(VkFormat format, VkExtent2D size, std::uint32_t layers,
                                 VkImageUsageFlags usage);
  [[nodiscard]] VkPipeline make_pipeline(const PipelineOf& of);
  [[nodiscard]] VkSampler make_comparing_sampler();
  [[nodiscard]] VkDescriptorSet bind(const Buffer& uniforms, const Image& image, VkSampler sampler);
  [[nodiscard]] VkPipelineLayout layout() const { return layout_; }

  /// Records commands, submits them, and waits for their end.
  void run(const std::function<void(VkCommandBuffer)>& record);
  /// A label between submissions, for tools that listen; nothing without validation.
  void label(const char* text);
  void begin_rendering(VkCommandBuffer commands, const VkRenderingInfo& info) const {
    calls_.begin_rendering(commands, &info);
  }
  void end_rendering(VkCommandBuffer commands) const { calls_.end_rendering(commands); }
  /// Waits in the command buffer: what `from` wrote may be read by `to`, and the image goes from one layout
  /// to the other.
  void barrier(VkCommandBuffer commands, const Image& image, const Use& from, const Use& to) const;
  void barrier(VkCommandBuffer commands, const Use& from, const Use& to) const;  ///< of all buffers

 private:
  struct Messages {
    int count = 0;
    std::string first;
  };
  struct Calls {  // of extensions
    PFN_vkQueueInsertDebugUtilsLabelEXT insert_label = nullptr;
    PFN_vkCmdBeginRenderingKHR begin_rendering = nullptr;
    PFN_vkCmdEndRenderingKHR end_rendering = nullptr;
    PFN_vkCmdPipelineBarrier2KHR barrier = nullptr;
    PFN_vkQueueSubmit2KHR submit = nullptr;
  };
  [[nodiscard]] VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags);
  void make_instance(bool validated);
  void choose_device();
  void load_calls();
  void make_layout();

  std::unique_ptr<Messages> messages_ = std::make_unique<Messages>();
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  Calls calls_;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool commands_ = VK_NULL_HANDLE;
  VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout bindings_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  std::string name_;
  bool multiview_ = false, layer_by_vertex_ = false;
  std::vector<std::function<void()>> at_end_;  // in the order of making
};

inline constexpr Use kNothing{VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE};
inline constexpr Use kDrawDepth{
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL};
inline constexpr Use kDrawColor{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                                VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
inline constexpr Use kSample{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                             VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
inline constexpr Use kUniform{VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                              VK_ACCESS_2_UNIFORM_READ_BIT};
inline constexpr Use kWriteByCopy{VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
inline constexpr Use kReadByCopy{VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                                 VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
inline constexpr Use kReadByHost{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};

}  // namespace sample
