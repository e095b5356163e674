// SPDX-License-Identifier: MIT
#include "verify/gl/vulkan.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace limitcheck::verify {

namespace {

constexpr std::uint32_t kVersion = VK_API_VERSION_1_2;

vk::raii::Instance instance(const vk::raii::Context& context) {
  const vk::ApplicationInfo application("limitcheck", 0, nullptr, 0, kVersion);
  return {context, vk::InstanceCreateInfo({}, &application)};
}

vk::DescriptorType kind_of(const VulkanDevice::Buffer& buffer) {
  return buffer.uniform ? vk::DescriptorType::eUniformBuffer : vk::DescriptorType::eStorageBuffer;
}

// Memory that the processor sees, too.
struct Mapped {
  Mapped(const vk::raii::Device& device, const vk::raii::PhysicalDevice& physical,
         const VulkanDevice::Buffer& from)
      : size(from.content.size()),
        buffer(device, vk::BufferCreateInfo({}, size,
                                            from.uniform ? vk::BufferUsageFlagBits::eUniformBuffer
                                                         : vk::BufferUsageFlagBits::eStorageBuffer)) {
    using Flag = vk::MemoryPropertyFlagBits;
    constexpr vk::MemoryPropertyFlags wanted = Flag::eHostVisible | Flag::eHostCoherent;
    const vk::MemoryRequirements needs = buffer.getMemoryRequirements();
    const vk::PhysicalDeviceMemoryProperties has = physical.getMemoryProperties();
    std::uint32_t type = 0;  // Vulkan promises that there is one
    while ((needs.memoryTypeBits >> type & 1) == 0 ||
           (has.memoryTypes.at(type).propertyFlags & wanted) != wanted)
      ++type;
    memory = vk::raii::DeviceMemory(device, vk::MemoryAllocateInfo(needs.size, type));
    buffer.bindMemory(*memory, 0);
    here = memory.mapMemory(0, VK_WHOLE_SIZE);
    std::memcpy(here, from.content.data(), size);
  }

  std::size_t size;
  vk::raii::Buffer buffer;
  vk::raii::DeviceMemory memory = nullptr;
  void* here = nullptr;
};

}  // namespace

VulkanDevice::VulkanDevice() : instance_(instance(context_)) {
  vk::raii::PhysicalDevices all(instance_);
  const auto computes = [](const vk::raii::PhysicalDevice& d) {
    const auto families = d.getQueueFamilyProperties();
    return std::find_if(families.begin(), families.end(),
                        [](const vk::QueueFamilyProperties& family) {
                          return (family.queueFlags & vk::QueueFlagBits::eCompute) != vk::QueueFlags();
                        }) -
           families.begin();
  };
  std::erase_if(all, [&](const vk::raii::PhysicalDevice& d) {
    return computes(d) == static_cast<std::ptrdiff_t>(d.getQueueFamilyProperties().size());
  });
  if (all.empty())
    throw std::runtime_error("no device of Vulkan that computes: Debian package mesa-vulkan-drivers");
  const auto card = std::find_if(all.begin(), all.end(), [](const vk::raii::PhysicalDevice& d) {
    return d.getProperties().deviceType != vk::PhysicalDeviceType::eCpu;
  });
  physical_ = std::move(card != all.end() ? *card : all.front());
  family_ = static_cast<std::uint32_t>(computes(physical_));

  const auto properties =
      physical_.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
  const vk::PhysicalDeviceProperties& p = properties.get<vk::PhysicalDeviceProperties2>().properties;
  name_ = fmt::format("{}, Vulkan {}.{}.{}, {}", p.deviceName.data(), VK_API_VERSION_MAJOR(p.apiVersion),
                      VK_API_VERSION_MINOR(p.apiVersion), VK_API_VERSION_PATCH(p.apiVersion),
                      properties.get<vk::PhysicalDeviceDriverProperties>().driverInfo.data());

  // Drivers that do not compile for a real machine do not have it.
  std::vector<const char*> extensions{VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME};
  const auto has = physical_.enumerateDeviceExtensionProperties();
  tells_ = std::any_of(has.begin(), has.end(), [&](const vk::ExtensionProperties& e) {
    return std::string_view(e.extensionName) == extensions[0];
  });
  if (!tells_) extensions.clear();
  const vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR asks(VK_TRUE);
  const float priority = 1;
  const vk::DeviceQueueCreateInfo queue({}, family_, 1, &priority);
  const vk::PhysicalDeviceFeatures features = physical_.getFeatures();
  device_ = vk::raii::Device(
      physical_, vk::DeviceCreateInfo({}, queue, {}, extensions, &features, tells_ ? &asks : nullptr));
}

std::int64_t VulkanDevice::most_bytes_of_a_buffer() const {
  return physical_.getProperties().limits.maxStorageBufferRange;
}

VulkanDevice::Pipeline VulkanDevice::compiled(const Dispatch& dispatch,
                                              std::span<const Buffer> buffers) const {
  constexpr auto stage = vk::ShaderStageFlagBits::eCompute;
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (const Buffer& b : buffers) bindings.emplace_back(b.binding, kind_of(b), 1, stage);
  const vk::PushConstantRange pushed(stage, 0, static_cast<std::uint32_t>(dispatch.pushed.size_bytes()));
  const std::uint32_t ranges = dispatch.pushed.empty() ? 0 : 1;
  vk::raii::ShaderModule module(device_, vk::ShaderModuleCreateInfo({}, dispatch.code));
  vk::raii::DescriptorSetLayout sets(device_, vk::DescriptorSetLayoutCreateInfo({}, bindings));
  vk::raii::PipelineLayout layout(device_, vk::PipelineLayoutCreateInfo({}, 1, &*sets, ranges, &pushed));
  const vk::PipelineCreateFlags tells = vk::PipelineCreateFlagBits::eCaptureStatisticsKHR |
                                        vk::PipelineCreateFlagBits::eCaptureInternalRepresentationsKHR;
  vk::raii::Pipeline pipeline(
      device_, nullptr,
      vk::ComputePipelineCreateInfo(tells_ ? tells : vk::PipelineCreateFlags(),
                                    vk::PipelineShaderStageCreateInfo({}, stage, *module, dispatch.entry),
                                    *layout));
  return {std::move(module), std::move(sets), std::move(layout), std::move(pipeline)};
}

void VulkanDevice::run(std::span<const Dispatch> dispatches, std::span<Buffer> buffers) const {
  std::vector<const Pipeline*> pipelines;
  for (const Dispatch& d : dispatches) {
    auto found = kept_.find(d.code);
    if (found == kept_.end()) found = kept_.emplace(d.code, compiled(d, buffers)).first;
    pipelines.push_back(&found->second);
  }
  if (pipelines.empty()) return;

  std::vector<Mapped> mapped;
  for (const Buffer& b : buffers) mapped.emplace_back(device_, physical_, b);
  constexpr std::uint32_t kMost = 64;  // of either kind
  const std::array<vk::DescriptorPoolSize, 2> sizes{
      {{vk::DescriptorType::eUniformBuffer, kMost}, {vk::DescriptorType::eStorageBuffer, kMost}}};
  const vk::raii::DescriptorPool pool(
      device_, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes));
  const vk::raii::DescriptorSets sets(device_,
                                      vk::DescriptorSetAllocateInfo(*pool, *pipelines.front()->sets));
  for (std::size_t k = 0; k < buffers.size(); ++k) {
    const vk::DescriptorBufferInfo info(*mapped[k].buffer, 0, VK_WHOLE_SIZE);
    device_.updateDescriptorSets(
        vk::WriteDescriptorSet(*sets[0], buffers[k].binding, 0, kind_of(buffers[k]), {}, info), {});
  }

  const vk::raii::CommandPool command_pool(device_, vk::CommandPoolCreateInfo({}, family_));
  const vk::raii::CommandBuffers commands(
      device_, vk::CommandBufferAllocateInfo(*command_pool, vk::CommandBufferLevel::ePrimary, 1));
  const vk::raii::CommandBuffer& command = commands[0];
  command.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
  for (std::size_t k = 0; k < dispatches.size(); ++k) {
    const Dispatch& d = dispatches[k];
    constexpr auto point = vk::PipelineBindPoint::eCompute;
    command.bindPipeline(point, *pipelines[k]->pipeline);
    command.bindDescriptorSets(point, *pipelines[k]->layout, 0, *sets[0], {});
    if (!d.pushed.empty())
      command.pushConstants<std::int32_t>(*pipelines[k]->layout, vk::ShaderStageFlagBits::eCompute, 0,
                                          d.pushed);
    constexpr std::int64_t kInARow = 65535;  // that every driver does
    const std::int64_t rows = (d.groups + kInARow - 1) / kInARow;
    if (rows > 0)
      command.dispatch(static_cast<std::uint32_t>(std::min(d.groups, kInARow)),
                       static_cast<std::uint32_t>(rows), 1);
    using Access = vk::AccessFlagBits;
    using Stage = vk::PipelineStageFlagBits;
    command.pipelineBarrier(Stage::eComputeShader, Stage::eComputeShader | Stage::eHost, {},
                            vk::MemoryBarrier(Access::eShaderWrite,
                                              Access::eShaderRead | Access::eShaderWrite | Access::eHostRead),
                            {}, {});
  }
  command.end();
  const vk::raii::Queue queue = device_.getQueue(family_, 0);
  queue.submit(vk::SubmitInfo({}, {}, *command));
  queue.waitIdle();
  for (std::size_t k = 0; k < buffers.size(); ++k)
    std::memcpy(buffers[k].content.data(), mapped[k].here, mapped[k].size);
}

}  // namespace limitcheck::verify
