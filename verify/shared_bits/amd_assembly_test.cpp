// SPDX-License-Identifier: MIT
// What AMD's compiler makes of the shaders of fast/gpu: Mesa's driver compiles for a card that is not there ("null
// hardware") and shows the assembly. No machine of this kind is needed, and none runs anything here.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "fast/gpu/shaders.h"
#include "verify/shared_bits/test_support/spirv.h"

namespace limitcheck::verify {
namespace {

using fast::gpu::Output;
using fast::gpu::Shader;

constexpr std::array kShaders{Shader::kTriangleGrids, Shader::kTriangleEdges, Shader::kQuads,
                              Shader::kQuadSides, Shader::kQuadPatches};
constexpr std::array kNames{"grids", "edges", "quads", "sides", "patches"};

// In which ways the points of a shader go out.
std::vector<Output> outputs(Shader shader) {
  if (shader == Shader::kTriangleEdges || shader == Shader::kQuadSides)
    return {Output::kInOrder, Output::kPlaced};
  return {Output::kInOrder, Output::kPlaced, Output::kPlacedCompact};
}

const VulkanDevice& navi21() {
  static const VulkanDevice device = [] {
    setenv("RADV_FORCE_FAMILY", "navi21", 1);
    setenv("VK_ICD_FILENAMES", LIMITCHECK_RADV, 1);
    return VulkanDevice();
  }();
  return device;
}

// What a driver says of a compiled shader: its figures by their names ("VGPRs", "LDS size"), and its assembly.
struct CompiledShader {
  std::map<std::string, std::uint64_t> figures;
  std::string assembly;
};
CompiledShader compiled(const std::string& glsl) {
  const VulkanDevice::Code code = test::spirv(glsl);
  std::vector<VulkanDevice::Buffer> buffers{{0, {}, true}, {1, {}}, {2, {}}, {3, {}}, {4, {}}, {5, {}}};
  const auto made = navi21().compiled({code, "main", 1}, buffers);
  const vk::raii::Device& device = navi21().device();
  const vk::PipelineExecutableInfoKHR first(*made.pipeline);
  CompiledShader result;
  for (const auto& figure : device.getPipelineExecutableStatisticsKHR(first))
    result.figures[figure.name] = figure.value.u64;
  auto forms = device.getPipelineExecutableInternalRepresentationsKHR(first);
  std::vector<std::string> texts;
  texts.reserve(forms.size());
  for (auto& form : forms) form.pData = texts.emplace_back(form.dataSize, '\0').data();
  auto count = static_cast<std::uint32_t>(forms.size());
  device.getDispatcher()->vkGetPipelineExecutableInternalRepresentationsKHR(
      *device, reinterpret_cast<const VkPipelineExecutableInfoKHR*>(&first), &count,
      reinterpret_cast<VkPipelineExecutableInternalRepresentationKHR*>(forms.data()));
  for (std::size_t k = 0; k < forms.size(); ++k)
    if (std::strcmp(forms[k].name, "Assembly") == 0) result.assembly = texts[k];
  return result;
}

// Fused multiply-adds, each as it stands in the assembly; and those among them whose product is exact.
struct Fused {
  std::multiset<std::string> all, exact;
};
Fused fused(const std::string& assembly) {
  // v_fma_f32 v1, v2, s3, v4; v_fmac_f32 v1, v2, v3; v_fmamk_f32 v1, v2, 0x41000000, v3 (times the constant);
  // v_fmaak_f32 v1, v2, v3, 0x41000000 (plus it). Small powers of two stand in an instruction as such.
  static const std::regex instruction(
      "v_(pk_)?(fma|mad|mac|fmac|fmamk|fmaak|madmk|madak|fma_mix)[a-z0-9_]*_f(32|16)[^;\n]*");
  static const std::regex by_constant("v_fmamk_f32 [^,]*, [^,]*, 0x([0-9a-f]+),.*");
  static const std::regex by_power(
      "v_fmac?_f32(_e32|_e64)? [^,]*, (-?(0\\.5|1\\.0|2\\.0|4\\.0),.*|[^,]*, -?(0\\.5|1\\.0|2\\.0|4\\.0)(,| "
      ").*)");
  Fused result;
  for (std::sregex_iterator m(assembly.begin(), assembly.end(), instruction), end; m != end; ++m) {
    const std::string line = m->str();
    result.all.insert(line);
    std::smatch constant;
    const bool power =
        std::regex_match(line, constant, by_constant)
            ? (static_cast<std::uint32_t>(std::stoul(constant[1], nullptr, 16)) & 0x7fffffu) == 0
            : std::regex_match(line, by_power);
    if (power) result.exact.insert(line);
  }
  return result;
}

std::string without_precise(std::string text) {
  for (std::size_t at; (at = text.find("precise ")) != std::string::npos;) text.erase(at, 8);
  return text;
}

TEST(ShadersForNavi21, FuseNoProductThatRounds) {
  for (const auto shader : kShaders)
    for (const bool local : {false, true})
      for (const int depth : {3, 5}) {
        // So this compiler fuses where it may, and the test sees it.
        const std::string free = without_precise(fast::gpu::source(shader, depth, local));
        EXPECT_GT(fused(compiled(free).assembly).all.size(), 20) << depth << local;
        for (const Output output : outputs(shader)) {
          const Fused out = fused(compiled(fast::gpu::source(shader, depth, local, output)).assembly);
          EXPECT_EQ(out.all, out.exact)
              << static_cast<int>(shader) << static_cast<int>(output) << depth << local;
        }
      }
}

TEST(ShadersForNavi21, NeedAtMostFortyRegistersAndLittleSharedMemory) {
  for (const auto shader : kShaders)
    for (int way = 0; way < 2 * static_cast<int>(outputs(shader).size()); ++way) {
      const bool local = way % 2 != 0;
      const Output output = outputs(shader)[static_cast<std::size_t>(way / 2)];
      const auto figures = compiled(fast::gpu::source(shader, 5, local, output)).figures;
      const bool quads = shader != Shader::kTriangleGrids && shader != Shader::kTriangleEdges;
      const std::string name = fmt::format("{}_{}_{}", kNames.at(static_cast<std::size_t>(shader)),
                                           local ? "local" : "common", static_cast<int>(output));
      if (!quads) {
        EXPECT_LE(figures.at("VGPRs"), 40) << name;
      }
      EXPECT_EQ(figures.at("Spilled VGPRs") + figures.at("Spilled SGPRs") + figures.at("Scratch size"), 0)
          << name;
      // What the host says, in units of 512 bytes.
      const auto shared = static_cast<std::uint64_t>(4 * fast::gpu::SharedMemory::of(shader, 5).size);
      EXPECT_EQ(figures.at("LDS size"), (shared + 511) / 512 * 512) << name;
      EXPECT_LE(figures.at("LDS size"), 6700) << name;
      for (const char* figure : {"VGPRs", "LDS size", "Instructions"})
        RecordProperty(fmt::format("{}_{}", figure, name), fmt::format("{}", figures.at(figure)));
    }
}

}  // namespace
}  // namespace limitcheck::verify
