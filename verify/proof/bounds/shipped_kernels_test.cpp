// SPDX-License-Identifier: MIT
// What ships, on every vector target, is what was proved; and what is not is seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "fast/stream/kernel/targets.h"
#include "verify/proof/bounds/bounds.h"
#include "verify/proof/topologies/neighbourhood.h"

namespace limitcheck::verify {
namespace {

constexpr std::array kKernels{ProvedKernel::kSlidingWindow, ProvedKernel::kCrackEdge,
                              ProvedKernel::kCrackCentre,   ProvedKernel::kRowStream,
                              ProvedKernel::kRowStreamEdge, ProvedKernel::kRowStreamPatch};

/// Of every kernel that the topology has: the largest share of a normal's bound.
double expect_held(const Neighbourhood& n, int last_depth, bool regular) {
  double largest = 0;
  for (const ProvedKernel kernel : kKernels) {
    const bool triangles = n.mesh.faces.are_triangles();
    if (kernel == ProvedKernel::kCrackCentre ? !triangles
                                             : kernel == ProvedKernel::kRowStreamPatch && !regular)
      continue;
    const ShippedProof shipped = prove_bound(kernel, n, 0, last_depth, 1).shipped;
    EXPECT_EQ(shipped.unlike, "") << n.name << ' ' << name_of(kernel);
    EXPECT_LE(shipped.position_share, 1) << n.name << ' ' << name_of(kernel);
    EXPECT_LE(shipped.normal_share, 1) << n.name << ' ' << name_of(kernel);
    EXPECT_EQ(shipped.targets.empty(), !std::string(name_of(kernel)).starts_with("row-stream"));
    largest = std::max(largest, shipped.normal_share);
  }
  return largest;
}

TEST(Proof_Shipped, TrianglesAreWithinTheirBoundsWithTheSameBitsOnEveryTarget) {
  std::vector<Neighbourhood> pairs{*interior_pair({6, 6, 6, 6}), *interior_pair({5, 7, 4, 8}), face_alone()};
  pairs.push_back(boundary_pairs({6, 5, 6, 7})[5]);
  double largest = 0;
  for (const Neighbourhood& pair : pairs) largest = std::max(largest, expect_held(pair, 4, false));
  EXPECT_GT(largest, .04) << "a bound this loose would say little";
}

TEST(Proof_Shipped, QuadsAreWithinTheirBoundsWithTheSameBitsOnEveryTarget) {
  double largest = expect_held(interior_quad({4, 4, 4, 4}), 4, true);
  for (const Neighbourhood& quad : {interior_quad({3, 5, 4, 8}), boundary_quads({4, 5, 3, 6})[7],
                                    creased_quads({4, 5, 3, 6})[1], creased_quads({4, 5, 3, 6})[8]})
    largest = std::max(largest, expect_held(quad, 2, false));
  EXPECT_GT(largest, .04) << "a bound this loose would say little";
}

TEST(Proof_Shipped, NamesTheTargetsThatRan) {
  std::string expected;
  for (const auto& kernel : fast::row_stream::kernels())
    expected += (expected.empty() ? "" : " ") + std::string(kernel.name);
  EXPECT_EQ(prove_bound(ProvedKernel::kRowStream, face_alone(), 0, 0, 1).shipped.targets, expected);
}

}  // namespace
}  // namespace limitcheck::verify
