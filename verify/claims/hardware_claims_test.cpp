// SPDX-License-Identifier: MIT
// Section 4: "The sliding window method is a good candidate for implementing subdivision surface tessellation in
// hardware", counted on row streaming as compute shaders: what a work group needs, and what a point costs. [C92]
#include <gtest/gtest.h>

#include <fmt/core.h>
#include <algorithm>
#include <cstdint>
#include <regex>
#include <string>
#include <vector>

#include "fast/gpu/shaders.h"
#include "fast/stream/kernel/kernel.h"
#include "verify/claims/test_support/figures.h"

namespace limitcheck::verify {
namespace {

using fast::gpu::Shader;

// As the shader itself declares it.
std::int64_t shared_bytes(int depth) {
  static const std::regex declared("shared float memory\\[MEMORY\\];"), defined("#define MEMORY (\\d+)\n");
  const std::string text = fast::gpu::source(Shader::kTriangleGrids, depth, false);
  std::smatch number;
  EXPECT_TRUE(std::regex_search(text, declared) && std::regex_search(text, number, defined));
  static const std::regex others("\\bshared\\b(?! float memory)[^/\n]*;");
  EXPECT_FALSE(std::regex_search(text, others)) << "more of it";
  return 4 * std::stoll(number[1]);
}

// A grid with a point more on each side, and the level that it comes from, as floats: what a work group would share
// that keeps whole levels.
std::int64_t whole_bytes(int depth) {
  const auto points = [](std::int64_t side) { return (side + 3) * (side + 3); };
  return 12 * (points(std::int64_t{1} << depth) + points(std::int64_t{1} << (depth - 1)));
}

// An H100, of its maker's tables: 228 KB and at most 32 groups a multiprocessor, 1 KB of which each group takes beyond
// its own.
int groups_at_a_time(std::int64_t bytes) {
  return static_cast<int>(std::min<std::int64_t>(32, 228 * 1024 / (bytes + 1024)));
}

TEST(Sec4_Hardware, ARowAtATimeSharesTwoToTheDepthWhereWholeLevelsShareFour) {
  for (int depth = 4; depth < fast::gpu::kMaxDepth; ++depth) {
    // What each further level adds doubles but for what the corners take, which is the same at each.
    const auto added = [](int d) { return shared_bytes(d) - shared_bytes(d - 1); };
    EXPECT_EQ(added(depth + 1) - added(depth), 2 * (added(depth) - added(depth - 1))) << depth;
    EXPECT_LT(shared_bytes(depth + 1), 2 * shared_bytes(depth)) << depth;
    EXPECT_GT(whole_bytes(depth + 1), 3 * whole_bytes(depth)) << depth;
  }
  EXPECT_LE(shared_bytes(5), 6700);
  EXPECT_LE(shared_bytes(fast::gpu::kMaxDepth), 32768) << "what OpenGL promises";
  EXPECT_GT(whole_bytes(6), 32768);
  EXPECT_EQ(groups_at_a_time(shared_bytes(5)), 32);
  EXPECT_LE(groups_at_a_time(whole_bytes(6)), 4);
  for (const int depth : {3, 5, 6, 8}) {
    record("{}", shared_bytes(depth), "shared_at_depth_{}", depth);
    record("{}", whole_bytes(depth), "whole_at_depth_{}", depth);
    record("{}", groups_at_a_time(shared_bytes(depth)), "groups_at_depth_{}", depth);
    record("{}", groups_at_a_time(whole_bytes(depth)), "whole_groups_at_depth_{}", depth);
  }
}

std::int64_t operations = 0;

struct Counted {
  float x = 0;
  friend Counted operator+(Counted a, Counted b) { return ++operations, Counted{a.x + b.x}; }
  friend Counted operator-(Counted a, Counted b) { return ++operations, Counted{a.x - b.x}; }
  friend Counted operator*(Counted a, Counted b) { return ++operations, Counted{a.x * b.x}; }
};
struct CountedNumber {
  using Scalar = float;
  using V = Counted;
  static constexpr int lanes = 1;
  static constexpr bool kLinear = false, kHasSeed = true, kInRegisters = false;
  static V load(const float* p) { return {*p}; }
  static void store(V v, float* p) { *p = v.x; }
  static V splat(double x) { return {static_cast<float>(x)}; }
  static V fma(V a, V b, V c) { return ++operations, V{a.x * b.x + c.x}; }
  static V fms(V a, V b, V c) { return fma(a, b, {-c.x}); }
  static V fnma(V a, V b, V c) { return fma({-a.x}, b, c); }
  static V inverse_root_seed(V x) { return ++operations, x; }
  static V select(V chosen, V a, V b) { return chosen.x == 0 ? b : a; }
  static void scatter_vertex(const auto& /*vertex*/, const auto& /*to*/) {}
  static void scatter_couple(const auto& /*a*/, const auto& /*b*/, const auto& /*to*/) {}
  static void expect(const auto& /*to*/) {}
};

// The kernel's own text, which the shaders have bit by bit (GlKernel.HasTheBits..), counts its operations.
TEST(Sec4_Hardware, APointCostsTheSameWhateverTheDepth) {
  namespace rs = fast::row_stream;
  double before = 0;
  for (int depth = 2; depth <= fast::gpu::kMaxDepth; ++depth) {
    const rs::BatchPlacement<float> placement;
    std::vector<float> input(static_cast<std::size_t>(rs::input_size(depth))),
        work(static_cast<std::size_t>(rs::work_size(depth))),
        row(static_cast<std::size_t>(6 * ((1 << depth) + 1)));
    operations = 0;
    const rs::Target<float> target{row.data(), 0, 0, nullptr, nullptr};
    rs::generic::Stream<CountedNumber>(input.data(), depth, placement, work.data(), {target}).run();
    const double side = 1 << depth, of_a_point = static_cast<double>(operations) / ((side + 1) * (side + 1));
    if (depth > 2) {
      EXPECT_LT(of_a_point, before) << depth;
    }
    before = of_a_point;
    record("{:.0f}", of_a_point, "operations_at_depth_{}", depth);
  }
  EXPECT_LT(before, 100);
}

}  // namespace
}  // namespace limitcheck::verify
