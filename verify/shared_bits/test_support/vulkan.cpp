// SPDX-License-Identifier: MIT
#include "verify/shared_bits/test_support/vulkan.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <span>
#include <stdexcept>

namespace limitcheck::verify::test {

namespace {

void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS)
    throw std::runtime_error(std::string(what) + " failed: " + std::to_string(static_cast<int>(result)));
}

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// All that a driver lists, by asking for their number first.
template <class T, class Get>
std::vector<T> listed(VkStructureType type, Get&& get) {
  std::uint32_t count = 0;
  get(&count, static_cast<T*>(nullptr));
  T one{};
  one.sType = type;
  std::vector<T> all(count, one);
  get(&count, all.data());
  return all;
}

}  // namespace

std::vector<std::uint32_t> spirv(const std::string& glsl) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::string stem =
      (folder / ("limitcheck-" + std::to_string(std::hash<std::string>()(glsl)))).string();
  std::ofstream(stem + ".comp") << glsl;
  const std::string command = std::string(LIMITCHECK_GLSLANG) + " -V --target-env vulkan1.1 '" + stem +
                              ".comp' -o '" + stem + ".spv' > '" + stem + ".txt'";
  const bool done = std::system(command.c_str()) == 0;
  const std::string said = content(stem + ".txt"), code = done ? content(stem + ".spv") : "";
  for (const char* end : {".comp", ".spv", ".txt"}) std::filesystem::remove(stem + end);
  if (!done) throw std::runtime_error(said);
  std::vector<std::uint32_t> words(code.size() / 4);
  std::memcpy(words.data(), code.data(), code.size());
  return words;
}

VulkanDevice::VulkanDevice(const std::string& icd) {
  setenv("VK_ICD_FILENAMES", icd.c_str(), 1);
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = VK_API_VERSION_1_1;
  VkInstanceCreateInfo made{};
  made.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  made.pApplicationInfo = &application;
  check(vkCreateInstance(&made, nullptr, &instance_), "vkCreateInstance");
  std::uint32_t one = 1;
  const VkResult found = vkEnumeratePhysicalDevices(instance_, &one, &physical_);
  if (found != VK_INCOMPLETE) check(found, "vkEnumeratePhysicalDevices");
  if (one == 0) throw std::runtime_error("no device of Vulkan");

  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR asks{};
  asks.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
  asks.pipelineExecutableInfo = VK_TRUE;
  // Drivers that do not compile for a real machine do not have it.
  const std::array<const char*, 1> extension{VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME};
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical_, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> has(count);
  vkEnumerateDeviceExtensionProperties(physical_, nullptr, &count, has.data());
  const bool tells = std::any_of(
      has.begin(), has.end(), [&](const auto& e) { return std::strcmp(e.extensionName, extension[0]) == 0; });
  VkDeviceCreateInfo device{};
  device.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  device.queueCreateInfoCount = 1;
  device.pQueueCreateInfos = &queue;
  if (tells) {
    device.pNext = &asks;
    device.enabledExtensionCount = 1;
    device.ppEnabledExtensionNames = extension.data();
  }
  check(vkCreateDevice(physical_, &device, nullptr, &device_), "vkCreateDevice");
}

std::string VulkanDevice::name() const {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical_, &properties);
  return properties.deviceName;
}

struct VulkanDevice::Pipeline {
  Pipeline(VkDevice on, const std::vector<std::uint32_t>& code, VkPipelineCreateFlags flags) : device(on) {
    std::array<VkDescriptorSetLayoutBinding, kBindings> bindings{};
    for (std::uint32_t k = 0; k < kBindings; ++k)
      bindings[k] = {k, k == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1,
                     VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    VkDescriptorSetLayoutCreateInfo sets{};
    sets.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    sets.bindingCount = kBindings;
    sets.pBindings = bindings.data();
    check(vkCreateDescriptorSetLayout(device, &sets, nullptr, &set_layout), "vkCreateDescriptorSetLayout");
    VkPipelineLayoutCreateInfo layouts{};
    layouts.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layouts.setLayoutCount = 1;
    layouts.pSetLayouts = &set_layout;
    check(vkCreatePipelineLayout(device, &layouts, nullptr, &layout), "vkCreatePipelineLayout");
    VkShaderModuleCreateInfo text{};
    text.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    text.codeSize = 4 * code.size();
    text.pCode = code.data();
    check(vkCreateShaderModule(device, &text, nullptr, &module), "vkCreateShaderModule");
    VkComputePipelineCreateInfo made{};
    made.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    made.flags = flags;
    made.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    made.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    made.stage.module = module;
    made.stage.pName = "main";
    made.layout = layout;
    check(vkCreateComputePipelines(device, nullptr, 1, &made, nullptr, &pipeline),
          "vkCreateComputePipelines");
  }
  ~Pipeline() {
    vkDestroyPipeline(device, pipeline, nullptr);
    vkDestroyShaderModule(device, module, nullptr);
    vkDestroyPipelineLayout(device, layout, nullptr);
    vkDestroyDescriptorSetLayout(device, set_layout, nullptr);
  }
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  VkDevice device;
  VkDescriptorSetLayout set_layout = nullptr;
  VkPipelineLayout layout = nullptr;
  VkShaderModule module = nullptr;
  VkPipeline pipeline = nullptr;
};

VulkanDevice::~VulkanDevice() {
  kept_.clear();
  vkDestroyDevice(device_, nullptr);
  vkDestroyInstance(instance_, nullptr);
}

CompiledShader VulkanDevice::compile(const std::vector<std::uint32_t>& code) const {
  const Pipeline made(device_, code,
                      VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR |
                          VK_PIPELINE_CREATE_CAPTURE_INTERNAL_REPRESENTATIONS_BIT_KHR);
  const auto figures = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
      vkGetDeviceProcAddr(device_, "vkGetPipelineExecutableStatisticsKHR"));
  const auto forms = reinterpret_cast<PFN_vkGetPipelineExecutableInternalRepresentationsKHR>(
      vkGetDeviceProcAddr(device_, "vkGetPipelineExecutableInternalRepresentationsKHR"));
  if (figures == nullptr || forms == nullptr)
    throw std::runtime_error(name() + " does not say what it compiled");
  VkPipelineExecutableInfoKHR first{};
  first.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR;
  first.pipeline = made.pipeline;

  CompiledShader result;
  for (const auto& figure : listed<VkPipelineExecutableStatisticKHR>(
           VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR,
           [&](std::uint32_t*n, auto*to) { figures(device_, &first, n, to); }))
    result.figures[figure.name] = figure.value.u64;
  auto all = listed<VkPipelineExecutableInternalRepresentationKHR>(
      VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INTERNAL_REPRESENTATION_KHR,
      [&](std::uint32_t* n, auto* to) { forms(device_, &first, n, to); });
  std::vector<std::string> texts;
  texts.reserve(all.size());
  for (auto& form : all) form.pData = texts.emplace_back(form.dataSize, '\0').data();
  auto count = static_cast<std::uint32_t>(all.size());
  forms(device_, &first, &count, all.data());
  for (std::size_t k = 0; k < all.size(); ++k)
    if (std::strcmp(all[k].name, "Assembly") == 0) result.assembly = texts[k];
  return result;
}

namespace {

// Memory that the processor sees, too.
struct Buffer {
  Buffer(VkDevice on, VkPhysicalDevice of, VkBufferUsageFlags usage, std::span<const std::byte> content)
      : device(on), size(std::max<std::size_t>(content.size(), 16)) {
    VkBufferCreateInfo made{};
    made.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    made.size = size;
    made.usage = usage;
    check(vkCreateBuffer(device, &made, nullptr, &buffer), "vkCreateBuffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, buffer, &needs);
    VkPhysicalDeviceMemoryProperties has;
    vkGetPhysicalDeviceMemoryProperties(of, &has);
    constexpr VkMemoryPropertyFlags wanted =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkMemoryAllocateInfo room{};
    room.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    room.allocationSize = needs.size;
    while (room.memoryTypeIndex + 1 < has.memoryTypeCount &&
           ((needs.memoryTypeBits >> room.memoryTypeIndex & 1) == 0 ||
            (has.memoryTypes[room.memoryTypeIndex].propertyFlags & wanted) != wanted))
      ++room.memoryTypeIndex;
    check(vkAllocateMemory(device, &room, nullptr, &memory), "vkAllocateMemory");
    check(vkBindBufferMemory(device, buffer, memory, 0), "vkBindBufferMemory");
    check(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &here), "vkMapMemory");
    std::memcpy(here, content.data(), content.size());
  }
  ~Buffer() {
    vkDestroyBuffer(device, buffer, nullptr);
    vkFreeMemory(device, memory, nullptr);
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  VkDevice device;
  VkDeviceSize size;
  VkBuffer buffer = nullptr;
  VkDeviceMemory memory = nullptr;
  void* here = nullptr;
};

}  // namespace

void VulkanDevice::run(const std::vector<std::uint32_t>& code, std::uint32_t groups,
                       std::array<std::vector<std::byte>, kBindings>& buffers) const {
  std::unique_ptr<Pipeline>& kept = kept_[code];
  if (kept == nullptr) kept = std::make_unique<Pipeline>(device_, code, 0);
  const Pipeline& made = *kept;
  const std::array<VkDescriptorPoolSize, 2> sizes{
      {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1}, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kBindings - 1}}};
  VkDescriptorPoolCreateInfo pools{};
  pools.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pools.maxSets = 1;
  pools.poolSizeCount = sizes.size();
  pools.pPoolSizes = sizes.data();
  VkDescriptorPool pool = nullptr;
  check(vkCreateDescriptorPool(device_, &pools, nullptr, &pool), "vkCreateDescriptorPool");
  VkDescriptorSetAllocateInfo sets{};
  sets.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  sets.descriptorPool = pool;
  sets.descriptorSetCount = 1;
  sets.pSetLayouts = &made.set_layout;
  VkDescriptorSet set = nullptr;
  check(vkAllocateDescriptorSets(device_, &sets, &set), "vkAllocateDescriptorSets");
  std::vector<std::unique_ptr<Buffer>> bound;
  for (std::uint32_t k = 0; k < kBindings; ++k) {
    const bool uniform = k == 0;
    const Buffer& b = *bound.emplace_back(std::make_unique<Buffer>(
        device_, physical_, uniform ? VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
        buffers[k]));
    const VkDescriptorBufferInfo info{b.buffer, 0, b.size};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.dstBinding = k;
    write.descriptorCount = 1;
    write.descriptorType = uniform ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = &info;
    vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
  }
  VkCommandPoolCreateInfo commands{};
  commands.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  VkCommandPool command_pool = nullptr;
  check(vkCreateCommandPool(device_, &commands, nullptr, &command_pool), "vkCreateCommandPool");
  VkCommandBufferAllocateInfo one{};
  one.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  one.commandPool = command_pool;
  one.commandBufferCount = 1;
  VkCommandBuffer command = nullptr;
  check(vkAllocateCommandBuffers(device_, &one, &command), "vkAllocateCommandBuffers");
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  check(vkBeginCommandBuffer(command, &begin), "vkBeginCommandBuffer");
  vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE, made.pipeline);
  vkCmdBindDescriptorSets(command, VK_PIPELINE_BIND_POINT_COMPUTE, made.layout, 0, 1, &set, 0, nullptr);
  vkCmdDispatch(command, groups, 1, 1);
  check(vkEndCommandBuffer(command), "vkEndCommandBuffer");
  VkQueue queue = nullptr;
  vkGetDeviceQueue(device_, 0, 0, &queue);
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &command;
  check(vkQueueSubmit(queue, 1, &submit, nullptr), "vkQueueSubmit");
  check(vkQueueWaitIdle(queue), "vkQueueWaitIdle");
  vkDestroyCommandPool(device_, command_pool, nullptr);
  vkDestroyDescriptorPool(device_, pool, nullptr);
  for (std::uint32_t k = 0; k < kBindings; ++k)
    if (!buffers[k].empty()) std::memcpy(buffers[k].data(), bound[k]->here, buffers[k].size());
}

}  // namespace limitcheck::verify::test
