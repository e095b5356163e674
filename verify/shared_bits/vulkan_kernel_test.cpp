// SPDX-License-Identifier: MIT
// The shaders of fast/gpu by Vulkan, on Mesa's driver for the processor: the bits that they have by OpenGL.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <map>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "fast/gpu/shaders.h"
#include "verify/shared_bits/test_support/spirv.h"
#include "verify/shared_bits/test_support/unfused_quads.h"

namespace limitcheck::fast::row_stream {
namespace {

using gpu::BatchUniforms;
using gpu::Shader;
using Bytes = std::vector<std::byte>;
using BatchPlacement = row_stream::BatchPlacement<float>;
constexpr int kTogether = 4;
constexpr const char* kName = "vulkan";

std::size_t side(int depth) {
  return (std::size_t{1} << depth) + 1;
}

Bytes bytes_of(const auto& all) {
  const auto bytes = std::as_bytes(std::span(all));
  return {bytes.begin(), bytes.end()};
}

const verify::VulkanDevice& device() {
  static const verify::VulkanDevice lavapipe = [] {
    setenv("VK_ICD_FILENAMES", LIMITCHECK_LAVAPIPE, 1);
    return verify::VulkanDevice();
  }();
  return lavapipe;
}

// One dispatch; returns what it wrote.
Bytes run(Shader shader, bool local, const BatchUniforms& batch, std::span<const float> given,
          std::size_t groups, std::size_t points, Bytes third, Bytes fourth) {
  static std::map<std::tuple<Shader, int, bool>, verify::VulkanDevice::Code> all;
  const int most = gpu::compiled_for(batch.depth);
  auto& code = all[{shader, most, local}];
  if (code.empty()) code = verify::test::spirv(gpu::source(shader, most, local));
  third.resize(std::max<std::size_t>(third.size(), 16)),
      fourth.resize(std::max<std::size_t>(fourth.size(), 16));
  std::array<verify::VulkanDevice::Buffer, 5> buffers{{{0, bytes_of(std::array{batch}), true},
                                                       {1, bytes_of(given)},
                                                       {2, Bytes(24 * points)},
                                                       {3, std::move(third)},
                                                       {4, std::move(fourth)}}};
  device().run(std::array{verify::VulkanDevice::Dispatch{code, "main", static_cast<std::int64_t>(groups)}},
               buffers);
  return buffers[2].content;
}

Bytes run_edges(int depth, const BatchPlacement& placement, std::span<const float> given,
                std::vector<gpu::EdgeEnds> ends) {
  return run(Shader::kTriangleEdges, placement.local, BatchUniforms::of(depth, placement, kTogether), given,
             ends.size(), ends.size() * side(depth), bytes_of(ends), {});
}

const Kernel kTriangles{
    kName,
    kTogether,
    false,
    [](float* input, int depth, const BatchPlacement& placement, float*, const Target<float>& target) {
      const std::span<const float> given(input, static_cast<std::size_t>(input_size(depth)) * kTogether);
      std::array<std::int32_t, 5 * kTogether> edge_of;
      std::iota(edge_of.begin(), edge_of.end(), 0);
      Bytes edges;
      if (placement.local) edges = run_edges(depth, placement, given, gpu::edges_of_grids(depth, kTogether));
      const Bytes points =
          run(Shader::kTriangleGrids, placement.local, BatchUniforms::of(depth, placement, kTogether), given,
              kTogether, kTogether * side(depth) * side(depth), std::move(edges), bytes_of(edge_of));
      std::memcpy(target.base, points.data(), points.size());  // Compared has the grids one after the other
      return kName;
    },
    [](const float* input, int depth, const BatchPlacement& placement, float*, float* out, std::ptrdiff_t) {
      const std::span<const float> given(input, static_cast<std::size_t>(edge_input_size(depth)) * kTogether);
      const Bytes points = run_edges(depth, placement, given, gpu::edges_by_themselves(depth, kTogether));
      std::memcpy(out, points.data(), points.size());
    },
    nullptr};

template <Shader shader>
const char* run_quads(const QuadBatch<float>& batch, const Placement<float>& placement, float*,
                      const QuadTarget<float>& target) {
  constexpr bool patches = shader == Shader::kQuadPatches, alone = shader == Shader::kQuadSides;
  const bool local = !patches && batch.local;
  const std::size_t n = side(batch.depth), numbers = 6 * n * (alone ? 1 : n);
  const auto of = [&](int sides) { return BatchUniforms::of(batch, placement, kTogether, sides); };
  const std::span<const float> given(batch.input,
                                     static_cast<std::size_t>(quad_input_size(batch.depth)) * kTogether);
  Bytes sides;
  if (local && !alone)
    sides = run(Shader::kQuadSides, true, of(4), given, 4 * kTogether, 4 * kTogether * n, {}, {});
  const Bytes points =
      run(shader, local, of(alone ? 1 : 4), given, kTogether, kTogether * numbers / 6, std::move(sides), {});
  for (std::size_t k = 0; k < kTogether; ++k)
    std::memcpy(target.lane[k], points.data() + 4 * numbers * k, 4 * numbers);
  return kName;
}
const QuadKernel kQuads{kName,
                        kTogether,
                        false,
                        &run_quads<Shader::kQuads>,
                        &run_quads<Shader::kQuadPatches>,
                        &run_quads<Shader::kQuadSides>,
                        nullptr,
                        nullptr};

TEST(VulkanKernel, HasTheBitsOfTheProcessorsKernelWithoutFusedMultiplyAdd) {
  for (const bool local : {false, true})
    for (const int depth : {1, 4})
      for (const char* name : {"octahedron", "wheel:7", "fan:1", "sheet", "random:1"}) {
        Compared mesh(kTriangles, name, depth, local);
        mesh.grids();
        mesh.edges();
        EXPECT_EQ(mesh.differ, 0) << name << " depth " << depth << (local ? " local" : "") << " of "
                                  << mesh.compared;
        EXPECT_GT(mesh.compared, 0);
      }
}

TEST(VulkanKernel, HasThemOfQuads) {
  for (const bool local : {false, true})
    for (const int depth : {1, 4, 5})
      for (const char* name : {"quad-torus:4:3", "pawn", "quad-fan:3", "creased-cube", "open-crease"}) {
        if (depth == 5 && name != std::string("creased-cube")) continue;
        const ComparedQuads d(kQuads, name, depth, local);
        EXPECT_EQ(d.differ, 0) << name << " depth " << depth << (local ? " local" : "") << " of "
                               << d.compared;
        EXPECT_GT(d.compared, 0) << name;
      }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
