// SPDX-License-Identifier: MIT
// Compute shaders by Vulkan: where Debian's libvulkan-dev was there when this was built. The library and a driver are
// looked for when a device is asked for.
#pragma once

#include <vulkan/vulkan_raii.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace limitcheck::verify {

/// A device that computes: a graphics card if there is one, else what the first driver has. For one thread at a time.
/// What Vulkan refuses is a std::runtime_error.
class VulkanDevice {
 public:
  using Code = std::vector<std::uint32_t>;  // a module of SPIR-V with one entry point, a compute shader

  VulkanDevice();

  /// Device and driver: "llvmpipe (LLVM 15.0.6, 256 bits), Vulkan 1.3.230, Mesa 22.3.6".
  const std::string& name() const { return name_; }
  std::int64_t most_bytes_of_a_buffer() const;

  /// Binding of set 0, a storage buffer or a uniform one. Nothing runs on one of no bytes.
  struct Buffer {
    std::uint32_t binding;
    std::vector<std::byte> content;
    bool uniform = false;
  };
  /// Work group k of a dispatch is gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x, some of the last row too many.
  struct Dispatch {
    const Code& code;
    const char* entry;
    std::int64_t groups;
    std::span<const std::int32_t> pushed = {};  // push constants
  };
  /// One after the other, each sees what those before it wrote. The buffers have their content then.
  void run(std::span<const Dispatch> dispatches, std::span<Buffer> buffers) const;

  struct Pipeline {
    vk::raii::ShaderModule module;
    vk::raii::DescriptorSetLayout sets;
    vk::raii::PipelineLayout layout;
    vk::raii::Pipeline pipeline;
  };
  /// Where the driver can say what it compiled, it keeps that.
  Pipeline compiled(const Dispatch& dispatch, std::span<const Buffer> buffers) const;
  const vk::raii::Device& device() const { return device_; }

 private:
  vk::raii::Context context_;
  vk::raii::Instance instance_;
  vk::raii::PhysicalDevice physical_ = nullptr;
  std::uint32_t family_ = 0;
  bool tells_ = false;  // what it compiled
  std::string name_;
  vk::raii::Device device_ = nullptr;
  mutable std::map<Code, Pipeline> kept_;  // of run()
};

}  // namespace limitcheck::verify
