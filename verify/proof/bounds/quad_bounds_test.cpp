// SPDX-License-Identifier: MIT
// Proved float errors of the quad kernels: never exceeded, and not far off.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "reference/number/number_exact.h"
#include "verify/proof/bounds/bounds.h"
#include "verify/proof/numbers/quad_weights.h"
#include "verify/proof/topologies/neighbourhood.h"

namespace limitcheck::verify {
namespace {

constexpr std::array kKernels{ProvedKernel::kSlidingWindow, ProvedKernel::kCrackEdge,
                              ProvedKernel::kRowStream, ProvedKernel::kRowStreamEdge};

void expect_bounded(ProvedKernel kernel, const Neighbourhood& quad, int last_depth) {
  const BoundProof proof = prove_bound(kernel, quad, 0, last_depth, 80);
  fmt::print("{} {}: bound {:.3g}, worst {:.3g}, share {:.3f}, tangent {:.3g}, worst {:.3g}\n", quad.name,
             name_of(kernel), proof.position_bound, proof.position_worst, proof.share, proof.tangent_bound,
             proof.tangent_worst);
  EXPECT_TRUE(proof.alike) << quad.name << ' ' << name_of(kernel);
  EXPECT_LE(proof.share, 1) << quad.name << ' ' << name_of(kernel);
  EXPECT_GT(proof.share, .05) << "the bound means something";
  EXPECT_LT(proof.position_bound, 2e-6) << quad.name << ' ' << name_of(kernel);
  EXPECT_LT(proof.tangent_bound, 1e-3) << quad.name << ' ' << name_of(kernel);
}

TEST(Proof_QuadBounds, HoldForEveryKernel) {
  for (const auto& valences : {std::array{4, 4, 4, 4}, std::array{3, 5, 4, 8}}) {
    const Neighbourhood quad = interior_quad(valences);
    for (const ProvedKernel kernel : kKernels) expect_bounded(kernel, quad, 3);
    if (valences[0] == 4) expect_bounded(ProvedKernel::kRowStreamPatch, quad, 3);
  }
}

TEST(Proof_QuadBounds, HoldAtBoundariesCutsAndSemiSharpEdges) {
  for (const ProvedKernel kernel : kKernels) {
    expect_bounded(kernel, boundary_quads({4, 5, 3, 6})[7], 2);
    expect_bounded(kernel, creased_quads({4, 5, 3, 6})[8], 2);
  }
  expect_bounded(ProvedKernel::kSlidingWindow, semi_sharp_quads({4, 5, 3, 6})[40], 2);
}

// Both ends of D A are held, so it is straight, and its middle is 0 as seen from the side's own origin: what
// that origin was rounded by must leave the bound again.
TEST(Proof_QuadBounds, HoldOnAStraightSide) {
  int found = 0;
  for (const Neighbourhood& quad : creased_quads({4, 4, 4, 4})) {
    if (quad.name != "4 4 4 4 AB CD DA A+ D+") continue;
    ++found;
    for (const ProvedKernel kernel : {ProvedKernel::kRowStream, ProvedKernel::kRowStreamEdge})
      expect_bounded(kernel, quad, 2);
  }
  EXPECT_EQ(found, 1);
}

// A kernel whose sums, products or constants are taken as exact has smaller bounds: each counts.
TEST(Proof_QuadBounds, CountEveryKindOfRounding) {
  const Neighbourhood quad = interior_quad({3, 5, 4, 8});
  for (const ProvedKernel kernel : {ProvedKernel::kSlidingWindow, ProvedKernel::kRowStream}) {
    const double whole = bound_kernel(kernel, quad, 2).position();
    RoundingModel no_sums, no_narrowing;
    no_sums.sums = false;
    no_narrowing.narrowing = false;
    EXPECT_LT(bound_kernel(kernel, quad, 2, kUnitBox, no_sums).position(), whole);
    EXPECT_LT(bound_kernel(kernel, quad, 2, kUnitBox, no_narrowing).position(), whole);
  }
}

// What the bounds take the weights of control vertices to be known to.
TEST(Proof_QuadBounds, WeightsInDoubleAreRightToFortyBits) {
  using fast::VertexKind;
  using reference::Decimal50;
  double worst = 0;
  const auto compare = [&](int n, bool open, VertexKind kind) {
    const auto given = fast::star_weights<double>(n, open, kind);
    const auto exact = fast::star_weights<Decimal50>(n, open, kind);
    const auto apart = [&](const std::vector<double>& a, const std::vector<Decimal50>& b) {
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t k = 0; k < a.size(); ++k)
        worst = std::max(worst, std::abs(Decimal50(Decimal50(a[k]) - b[k]).convert_to<double>()));
    };
    apart(given.du, exact.du);
    apart(given.dv, exact.dv);
    apart(given.position, exact.position);
  };
  for (int n = 1; n <= 50; ++n) {
    if (n >= 3) compare(n, false, VertexKind::kPlain);
    compare(n, true, VertexKind::kPlain);
    compare(n, true, VertexKind::kHeld);
    if (n >= 3 && n <= 20) compare(n, true, VertexKind::kDart);
  }
  RecordProperty("worst", fmt::format("{:.2e}", worst));
  EXPECT_LT(worst, 0x1p-40);
}

}  // namespace
}  // namespace limitcheck::verify
