// Vulkan's boiler-plate.
#include "device.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace sample {
namespace {

void check(VkResult result, const char* call) {
  if (result != VK_SUCCESS) throw VulkanError(std::string(call) + " failed with " + std::to_string(result));
}

constexpr const char* kNoDevice =
    "no device with Vulkan 1.2, dynamic rendering and synchronization 2 (Debian: mesa-vulkan-drivers)";
constexpr std::array kExtensions{VK_KHR_DYNAMIC_RENDERING_EXTENSION_NAME,
                                 VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME};
constexpr const char* kValidation = "VK_LAYER_KHRONOS_validation";

bool has_layer(const char* name) {
  std::uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(), [name](const VkLayerProperties& layer) {
    return std::strcmp(layer.layerName, name) == 0;
  });
}

bool has_extensions(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> has(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, has.data());
  return std::all_of(kExtensions.begin(), kExtensions.end(), [&has](const char* name) {
    return std::any_of(has.begin(), has.end(), [name](const VkExtensionProperties& extension) {
      return std::strcmp(extension.extensionName, name) == 0;
    });
  });
}

}  // namespace

void Device::make_instance(bool validated) {
  if (validated && !has_layer(kValidation))
    throw VulkanError(std::string("no layer ") + kValidation + " (Debian: vulkan-validationlayers)");
  VkDebugUtilsMessengerCreateInfoEXT messenger{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  messenger.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT |
                          VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                          VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  messenger.pUserData = messages_.get();
  messenger.pfnUserCallback = [](VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                 const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) -> VkBool32 {
    auto& messages = *static_cast<Messages*>(user);
    if (messages.count++ == 0) messages.first = data->pMessage;
    return VK_FALSE;
  };
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.apiVersion = VK_API_VERSION_1_2;
  const char* const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  if (validated) {
    info.pNext = &messenger;  // of making and destroying the instance
    info.enabledLayerCount = info.enabledExtensionCount = 1;
    info.ppEnabledLayerNames = &kValidation;
    info.ppEnabledExtensionNames = &extension;
  }
  const VkResult made = vkCreateInstance(&info, nullptr, &instance_);
  if (made == VK_ERROR_INCOMPATIBLE_DRIVER) throw VulkanError(kNoDevice);
  check(made, "vkCreateInstance");
  if (!validated) return;
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  check(create(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
  calls_.insert_label = reinterpret_cast<PFN_vkQueueInsertDebugUtilsLabelEXT>(
      vkGetInstanceProcAddr(instance_, "vkQueueInsertDebugUtilsLabelEXT"));
}

void Device::choose_device() {
  std::uint32_t count = 0;
  vkEnumeratePhysicalDevices(instance_, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  vkEnumeratePhysicalDevices(instance_, &count, devices.data());
  for (const VkPhysicalDevice device : devices) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    if (properties.apiVersion < VK_API_VERSION_1_2 || !has_extensions(device)) continue;
    physical_ = device;
    const std::uint32_t version = properties.apiVersion;
    name_ = std::string(properties.deviceName) + ", Vulkan " + std::to_string(VK_API_VERSION_MAJOR(version)) +
            "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
            std::to_string(VK_API_VERSION_PATCH(version));
    break;
  }
  if (physical_ == VK_NULL_HANDLE) throw VulkanError(kNoDevice);

  VkPhysicalDeviceVulkan11Features v11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES};
  VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &v11};
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v12, {}};
  vkGetPhysicalDeviceFeatures2(physical_, &features);
  multiview_ = v11.multiview == VK_TRUE;
  layer_by_vertex_ = v12.shaderOutputLayer == VK_TRUE;

  VkPhysicalDeviceDynamicRenderingFeaturesKHR rendering{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES_KHR};
  VkPhysicalDeviceSynchronization2FeaturesKHR synchronization{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES_KHR, &rendering};
  rendering.dynamicRendering = synchronization.synchronization2 = VK_TRUE;
  VkPhysicalDeviceVulkan12Features use12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                         &synchronization};
  use12.shaderOutputLayer = v12.shaderOutputLayer;
  VkPhysicalDeviceVulkan11Features use11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES, &use12};
  use11.multiview = v11.multiview;
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = 0;  // every driver's first family draws
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &use11};
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = kExtensions.size();
  info.ppEnabledExtensionNames = kExtensions.data();
  check(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
  vkGetDeviceQueue(device_, 0, 0, &queue_);
}

void Device::load_calls() {
  const auto load = [this](auto& call, const char* name) {
    call = reinterpret_cast<std::remove_reference_t<decltype(call)>>(vkGetDeviceProcAddr(device_, name));
  };
  load(calls_.begin_rendering, "vkCmdBeginRenderingKHR");
  load(calls_.end_rendering, "vkCmdEndRenderingKHR");
  load(calls_.barrier, "vkCmdPipelineBarrier2KHR");
  load(calls_.submit, "vkQueueSubmit2KHR");
}

void Device::make_layout() {
  std::array<VkDescriptorSetLayoutBinding, 2> bindings{};
  bindings[0] = {0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1,
                 VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
  bindings[1] = {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
  VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  set.bindingCount = bindings.size();
  set.pBindings = bindings.data();
  check(vkCreateDescriptorSetLayout(device_, &set, nullptr, &bindings_), "vkCreateDescriptorSetLayout");
  const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, 128};
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = layout.pushConstantRangeCount = 1;
  layout.pSetLayouts = &bindings_;
  layout.pPushConstantRanges = &push;
  check(vkCreatePipelineLayout(device_, &layout, nullptr, &layout_), "vkCreatePipelineLayout");

  const std::array<VkDescriptorPoolSize, 2> sizes{
      {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1}, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1}}};
  VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  pool.maxSets = 1;
  pool.poolSizeCount = sizes.size();
  pool.pPoolSizes = sizes.data();
  check(vkCreateDescriptorPool(device_, &pool, nullptr, &descriptors_), "vkCreateDescriptorPool");
  VkCommandPoolCreateInfo commands{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  commands.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  check(vkCreateCommandPool(device_, &commands, nullptr, &commands_), "vkCreateCommandPool");
}

Device::Device(bool validated) {
  make_instance(validated);
  choose_device();
  load_calls();
  make_layout();
}

Device::~Device() {
  vkDeviceWaitIdle(device_);
  std::for_each(at_end_.rbegin(), at_end_.rend(), [](const auto& destroy) { destroy(); });
  vkDestroyCommandPool(device_, commands_, nullptr);
  vkDestroyDescriptorPool(device_, descriptors_, nullptr);
  vkDestroyPipelineLayout(device_, layout_, nullptr);
  vkDestroyDescriptorSetLayout(device_, bindings_, nullptr);
  vkDestroyDevice(device_, nullptr);
  if (messenger_ != VK_NULL_HANDLE)
    reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"))(instance_, messenger_, nullptr);
  vkDestroyInstance(instance_, nullptr);
}

VkDeviceMemory Device::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags) {
  VkPhysicalDeviceMemoryProperties properties;
  vkGetPhysicalDeviceMemoryProperties(physical_, &properties);
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.allocationSize = needs.size;
  while (info.memoryTypeIndex < properties.memoryTypeCount &&
         ((needs.memoryTypeBits >> info.memoryTypeIndex & 1u) == 0 ||
          (properties.memoryTypes[info.memoryTypeIndex].propertyFlags & flags) != flags))
    ++info.memoryTypeIndex;
  if (info.memoryTypeIndex == properties.memoryTypeCount)
    throw VulkanError("no memory of the kind that is needed");
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(device_, &info, nullptr, &memory), "vkAllocateMemory");
  at_end_.emplace_back([device = device_, memory] { vkFreeMemory(device, memory, nullptr); });
  return memory;
}

Buffer Device::make_buffer(std::size_t bytes, VkBufferUsageFlags usage, bool on_host) {
  Buffer buffer{VK_NULL_HANDLE, bytes, nullptr};
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = bytes;
  info.usage = usage;
  check(vkCreateBuffer(device_, &info, nullptr, &buffer.handle), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device_, buffer.handle, &needs);
  const VkDeviceMemory memory =
      allocate(needs, on_host ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT
                              : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  at_end_.emplace_back(
      [device = device_, handle = buffer.handle] { vkDestroyBuffer(device, handle, nullptr); });
  check(vkBindBufferMemory(device_, buffer.handle, memory, 0), "vkBindBufferMemory");
  if (on_host) {
    void* mapped = nullptr;
    check(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    buffer.mapped = static_cast<std::byte*>(mapped);
  }
  return buffer;
}

Image Device::make_image(VkFormat format, VkExtent2D size, std::uint32_t layers, VkImageUsageFlags usage) {
  Image image;
  image.format = format;
  image.size = size;
  image.aspect = format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {size.width, size.height, 1};
  info.mipLevels = 1;
  info.arrayLayers = layers;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage;
  check(vkCreateImage(device_, &info, nullptr, &image.handle), "vkCreateImage");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device_, image.handle, &needs);
  const VkDeviceMemory memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  at_end_.emplace_back(
      [device = device_, handle = image.handle] { vkDestroyImage(device, handle, nullptr); });
  check(vkBindImageMemory(device_, image.handle, memory, 0), "vkBindImageMemory");
  const auto view = [&](std::uint32_t first, std::uint32_t count) {
    VkImageViewCreateInfo of{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    of.image = image.handle;
    of.viewType = VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    of.format = format;
    of.subresourceRange = {image.aspect, 0, 1, first, count};
    VkImageView made = VK_NULL_HANDLE;
    check(vkCreateImageView(device_, &of, nullptr, &made), "vkCreateImageView");
    at_end_.emplace_back([device = device_, made] { vkDestroyImageView(device, made, nullptr); });
    return made;
  };
  image.view = view(0, layers);
  for (std::uint32_t i = 0; i < layers; ++i) image.layer_views.push_back(view(i, 1));
  return image;
}

VkPipeline Device::make_pipeline(const PipelineOf& of) {
  std::vector<VkPipelineShaderStageCreateInfo> stages;
  const auto add_stage = [&](Spirv code, VkShaderStageFlagBits stage) {
    if (code.empty()) return;
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = code.size_bytes();
    info.pCode = code.data();
    VkPipelineShaderStageCreateInfo made{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    made.stage = stage;
    made.pName = "main";
    check(vkCreateShaderModule(device_, &info, nullptr, &made.module), "vkCreateShaderModule");
    stages.push_back(made);
  };
  add_stage(of.vertex, VK_SHADER_STAGE_VERTEX_BIT);
  add_stage(of.fragment, VK_SHADER_STAGE_FRAGMENT_BIT);

  constexpr std::uint32_t kFloats = 3 * sizeof(float);
  const VkVertexInputBindingDescription binding{0, 2 * kFloats, VK_VERTEX_INPUT_RATE_VERTEX};
  // Depths need positions alone.
  const std::array<VkVertexInputAttributeDescription, 2> attributes{
      {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0}, {1, 0, VK_FORMAT_R32G32B32_SFLOAT, kFloats}}};
  VkPipelineVertexInputStateCreateInfo vertices{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  vertices.vertexBindingDescriptionCount = 1;
  vertices.pVertexBindingDescriptions = &binding;
  vertices.vertexAttributeDescriptionCount = of.fragment.empty() ? 1 : 2;
  vertices.pVertexAttributeDescriptions = attributes.data();
  VkPipelineInputAssemblyStateCreateInfo assembly{
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.depthBiasEnable = of.fragment.empty() ? VK_TRUE : VK_FALSE;
  raster.lineWidth = 1.0f;
  VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
  depth.depthCompareOp = VK_COMPARE_OP_GREATER_OR_EQUAL;
  VkPipelineColorBlendAttachmentState all_channels{};
  all_channels.colorWriteMask = 0xf;
  const std::vector<VkPipelineColorBlendAttachmentState> blends(of.colors.size(), all_channels);
  VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blend.attachmentCount = static_cast<std::uint32_t>(blends.size());
  blend.pAttachments = blends.data();
  std::vector<VkDynamicState> dynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  if (raster.depthBiasEnable == VK_TRUE) dynamic.push_back(VK_DYNAMIC_STATE_DEPTH_BIAS);
  VkPipelineDynamicStateCreateInfo states{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  states.dynamicStateCount = static_cast<std::uint32_t>(dynamic.size());
  states.pDynamicStates = dynamic.data();
  VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.viewMask = of.view_mask;
  rendering.colorAttachmentCount = static_cast<std::uint32_t>(of.colors.size());
  rendering.pColorAttachmentFormats = of.colors.data();
  rendering.depthAttachmentFormat = VK_FORMAT_D32_SFLOAT;

  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
  info.stageCount = static_cast<std::uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &vertices;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &states;
  info.layout = layout_;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateGraphicsPipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "vkCreateGraphicsPipelines");
  for (const VkPipelineShaderStageCreateInfo& stage : stages)
    vkDestroyShaderModule(device_, stage.module, nullptr);
  at_end_.emplace_back([device = device_, pipeline] { vkDestroyPipeline(device, pipeline, nullptr); });
  return pipeline;
}

VkSampler Device::make_comparing_sampler() {
  VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = info.minFilter = VK_FILTER_LINEAR;
  info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.compareEnable = VK_TRUE;
  info.compareOp = VK_COMPARE_OP_GREATER_OR_EQUAL;
  VkSampler sampler = VK_NULL_HANDLE;
  check(vkCreateSampler(device_, &info, nullptr, &sampler), "vkCreateSampler");
  at_end_.emplace_back([device = device_, sampler] { vkDestroySampler(device, sampler, nullptr); });
  return sampler;
}

VkDescriptorSet Device::bind(const Buffer& uniforms, const Image& image, VkSampler sampler) {
  VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  info.descriptorPool = descriptors_;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &bindings_;
  VkDescriptorSet set = VK_NULL_HANDLE;
  check(vkAllocateDescriptorSets(device_, &info, &set), "vkAllocateDescriptorSets");
  const VkDescriptorBufferInfo buffer{uniforms.handle, 0, VK_WHOLE_SIZE};
  const VkDescriptorImageInfo sampled{sampler, image.view, kSample.layout};
  std::array<VkWriteDescriptorSet, 2> writes{};
  for (std::uint32_t i = 0; i < 2; ++i) {
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstSet = set;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
  }
  writes[0].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  writes[0].pBufferInfo = &buffer;
  writes[1].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  writes[1].pImageInfo = &sampled;
  vkUpdateDescriptorSets(device_, writes.size(), writes.data(), 0, nullptr);
  return set;
}

void Device::run(const std::function<void(VkCommandBuffer)>& record) {
  VkCommandBufferAllocateInfo allocate_info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  allocate_info.commandPool = commands_;
  allocate_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate_info.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(device_, &allocate_info, &commands), "vkAllocateCommandBuffers");
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  record(commands);
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  VkCommandBufferSubmitInfo submitted{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
  submitted.commandBuffer = commands;
  VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  submit.commandBufferInfoCount = 1;
  submit.pCommandBufferInfos = &submitted;
  check(calls_.submit(queue_, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit2");
  check(vkQueueWaitIdle(queue_), "vkQueueWaitIdle");
  vkFreeCommandBuffers(device_, commands_, 1, &commands);
}

void Device::label(const char* text) {
  if (calls_.insert_label == nullptr) return;
  VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
  label.pLabelName = text;
  calls_.insert_label(queue_, &label);
}

void Device::barrier(VkCommandBuffer commands, const Image& image, const Use& from, const Use& to) const {
  VkImageMemoryBarrier2 of{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  of.srcStageMask = from.stages;
  of.srcAccessMask = from.access;
  of.dstStageMask = to.stages;
  of.dstAccessMask = to.access;
  of.oldLayout = from.layout;
  of.newLayout = to.layout;
  of.srcQueueFamilyIndex = of.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  of.image = image.handle;
  of.subresourceRange = {image.aspect, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS};
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &of;
  calls_.barrier(commands, &info);
}

void Device::barrier(VkCommandBuffer commands, const Use& from, const Use& to) const {
  VkMemoryBarrier2 of{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  of.srcStageMask = from.stages;
  of.srcAccessMask = from.access;
  of.dstStageMask = to.stages;
  of.dstAccessMask = to.access;
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &of;
  calls_.barrier(commands, &info);
}

}  // namespace sample
