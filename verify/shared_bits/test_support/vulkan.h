// SPDX-License-Identifier: MIT
// Compute shaders by Vulkan, for tests: what a driver makes of them, and what they compute. Vulkan is optional (Debian:
// mesa-vulkan-drivers libvulkan-dev glslang-tools); no graphics card is needed.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace limitcheck::verify::test {

/// SPIR-V, by glslangValidator. Throws std::runtime_error with its messages.
std::vector<std::uint32_t> spirv(const std::string& glsl);

/// What a driver says of a compiled shader: its figures by their names ("VGPRs", "LDS size"), and its assembly.
struct CompiledShader {
  std::map<std::string, std::uint64_t> figures;
  std::string assembly;
};

/// A device of Vulkan: a driver's first. One driver for a process.
class VulkanDevice {
 public:
  static constexpr std::uint32_t kBindings = 5;

  /// icd: the driver's file. Throws std::runtime_error.
  explicit VulkanDevice(const std::string& icd);
  ~VulkanDevice();
  VulkanDevice(const VulkanDevice&) = delete;
  VulkanDevice& operator=(const VulkanDevice&) = delete;

  std::string name() const;
  /// With uniform buffer 0 and storage buffers 1 to 4.
  CompiledShader compile(const std::vector<std::uint32_t>& code) const;
  /// Runs so many work groups; buffer k, of 16 bytes or more, is binding k and is written back.
  void run(const std::vector<std::uint32_t>& code, std::uint32_t groups,
           std::array<std::vector<std::byte>, kBindings>& buffers) const;

 private:
  struct Pipeline;
  VkInstance instance_ = nullptr;
  VkPhysicalDevice physical_ = nullptr;
  VkDevice device_ = nullptr;
  mutable std::map<std::vector<std::uint32_t>, std::unique_ptr<Pipeline>> kept_;  // of run()
};

}  // namespace limitcheck::verify::test
