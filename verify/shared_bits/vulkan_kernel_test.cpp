// SPDX-License-Identifier: MIT
// The shaders of fast/gpu by Vulkan, on Mesa's driver for the processor: the bits that they have by OpenGL.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "fast/gpu/shaders.h"
#include "verify/shared_bits/test_support/unfused.h"
#include "verify/shared_bits/test_support/vulkan.h"

namespace limitcheck::fast::row_stream {
namespace {

using gpu::Shader;
using Bytes = std::vector<std::byte>;
constexpr int kTogether = 4;

Bytes bytes_of(const auto& all) {
  const auto bytes = std::as_bytes(std::span(all));
  return {bytes.begin(), bytes.end()};
}

const std::vector<std::uint32_t>& code(Shader shader, int most, bool local) {
  static std::map<std::tuple<Shader, int, bool>, std::vector<std::uint32_t>> all;
  auto& words = all[{shader, most, local}];
  if (words.empty()) words = verify::test::spirv(gpu::source(shader, most, local));
  return words;
}

// One dispatch on a device of its own kind; returns what it wrote.
Bytes run(Shader shader, int depth, const KernelPlacement<float>& placement, std::span<const float> given,
          std::size_t groups, std::size_t points, Bytes third, Bytes fourth) {
  static const verify::test::VulkanDevice device(LIMITCHECK_LAVAPIPE);
  std::array<Bytes, 5> buffers{bytes_of(std::array{gpu::BatchUniforms::of(depth, placement, kTogether)}),
                               bytes_of(given), Bytes(24 * points), std::move(third), std::move(fourth)};
  device.run(code(shader, gpu::compiled_for(depth), placement.has_local_origin(depth)),
             static_cast<std::uint32_t>(groups), buffers);
  return buffers[2];
}

Bytes run_edges(int depth, const KernelPlacement<float>& placement, std::span<const float> given,
                std::vector<gpu::EdgeEnds> ends) {
  const std::size_t side = (std::size_t{1} << depth) + 1;
  return run(Shader::kTriangleEdges, depth, placement, given, ends.size(), ends.size() * side, bytes_of(ends),
             {});
}

const Kernel kVulkan{
    "vulkan",
    kTogether,
    false,
    [](float* input, int depth, const KernelPlacement<float>& placement, float*,
       const Target<float>& target) {
      const std::size_t side = (std::size_t{1} << depth) + 1;
      const std::span<const float> given(input, static_cast<std::size_t>(input_size(depth)) * kTogether);
      std::array<std::int32_t, 5 * kTogether> edge_of;
      std::iota(edge_of.begin(), edge_of.end(), 0);
      Bytes edges;
      if (placement.has_local_origin(depth))
        edges = run_edges(depth, placement, given, gpu::edges_of_grids(depth, kTogether));
      const Bytes points = run(Shader::kTriangleGrids, depth, placement, given, kTogether,
                               kTogether * side * side, std::move(edges), bytes_of(edge_of));
      std::memcpy(target.base, points.data(), points.size());  // Compared has the grids one after the other
      return "vulkan";
    },
    [](const float* input, int depth, const KernelPlacement<float>& placement, float*, float* out,
       std::ptrdiff_t) {
      const std::span<const float> given(input, static_cast<std::size_t>(edge_input_size(depth)) * kTogether);
      const Bytes points = run_edges(depth, placement, given, gpu::edges_by_themselves(depth, kTogether));
      std::memcpy(out, points.data(), points.size());
    },
    nullptr};

TEST(VulkanKernel, HasTheBitsOfTheProcessorsKernelWithoutFusedMultiplyAdd) {
  for (const bool local : {false, true})
    for (const int depth : {1, 4})
      for (const char* name : {"octahedron", "wheel:7", "fan:1", "sheet", "random:1"}) {
        Compared mesh(kVulkan, name, depth, local);
        mesh.grids();
        mesh.edges();
        EXPECT_EQ(mesh.differ, 0) << name << " depth " << depth << (local ? " local" : "") << " of "
                                  << mesh.compared;
        EXPECT_GT(mesh.compared, 0);
      }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
