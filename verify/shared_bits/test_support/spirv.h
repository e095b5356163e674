// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>

#include "verify/gl/vulkan.h"

namespace limitcheck::verify::test {

/// A compute shader's module, by glslangValidator. Throws std::runtime_error with its messages.
inline VulkanDevice::Code spirv(const std::string& glsl) {
  namespace fs = std::filesystem;
  const auto content = [](const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string stem = (fs::temp_directory_path() / ("limitcheck-" + std::to_string(getpid()) + "-" +
                                                         std::to_string(std::hash<std::string>()(glsl))))
                               .string();
  std::ofstream(stem + ".comp") << glsl;
  const std::string command = std::string(LIMITCHECK_GLSLANG) + " -V --target-env vulkan1.1 '" + stem +
                              ".comp' -o '" + stem + ".spv' > '" + stem + ".txt'";
  const bool done = std::system(command.c_str()) == 0;
  const std::string said = content(stem + ".txt"), code = done ? content(stem + ".spv") : "";
  for (const char* end : {".comp", ".spv", ".txt"}) fs::remove(stem + end);
  if (!done) throw std::runtime_error(said);
  VulkanDevice::Code words(code.size() / 4);
  std::memcpy(words.data(), code.data(), code.size());
  return words;
}

}  // namespace limitcheck::verify::test
