// SPDX-License-Identifier: MIT
// The kernel of quads on a GPU against the processor's own text on a number without fused multiply-add, bit by bit:
// quads of any valences, regular ones, boundaries, cuts and darts, and sides alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "fast/stream/row_stream.h"
#include "verify/shared_bits/test_support/gl_kernels.h"
#include "verify/shared_bits/test_support/unfused_quads.h"

namespace limitcheck::fast::row_stream {
namespace {

class GlQuadKernel : public GlTest {
 protected:
  static void expect_equal_bits(const std::string& name, int depth) {
    for (const bool local : {false, true}) {
      if (local && depth == 0) continue;
      const ComparedQuads d(gl_quad_kernel(), name, depth, local);
      EXPECT_EQ(d.differ, 0) << name << " depth " << depth << (local ? " local" : "") << " of " << d.compared;
      EXPECT_GT(d.compared, 0) << name;
    }
  }
};

TEST_F(GlQuadKernel, HasTheBitsOfTheProcessorsKernelWithoutFusedMultiplyAdd) {
  for (const int depth : {0, 1, 4})
    for (const char* name : {"quad-cube", "quad-torus:4:3", "pawn", "quad-wheel:5", "quad-fan:3",
                             "creased-cube", "open-crease", "prism:5", "mixed:1"})
      expect_equal_bits(name, depth);
}

TEST_F(GlQuadKernel, HasThemWhereSomeSidesHaveOriginsOfTheirOwn) {
  for (const int depth : {1, 2, 3}) {
    const ComparedQuads d(gl_quad_kernel(), "stretched:4:pawn", depth, std::nullopt);
    EXPECT_EQ(d.differ, 0) << "depth " << depth << " of " << d.compared;
    EXPECT_TRUE(d.local > 0 && d.local < d.items) << d.local << " of " << d.items;
  }
}

// There the processor's kernel takes the limits inside another way, unless the number forbids it.
TEST_F(GlQuadKernel, HasThemAtGreatDepths) {
  for (const char* name : {"quad-fan:3", "creased-cube"}) expect_equal_bits(name, 5);
  for (const char* name : {"quad-fan:4", "quad-torus:4:3"}) expect_equal_bits(name, 7);
  for (const char* name : {"quad-fan:1", "quad-torus:4:3", "open-crease"}) expect_equal_bits(name, 8);
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
