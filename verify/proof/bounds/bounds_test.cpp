// SPDX-License-Identifier: MIT
// The proved bounds hold for every error that can be found, and would not if they forgot a rounding.
#include "verify/proof/bounds/bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reference/loop/stam.h"
#include "verify/proof/maps/reference_map.h"

namespace limitcheck::verify {
namespace {

constexpr ProvedKernel kKernels[] = {ProvedKernel::kSlidingWindow, ProvedKernel::kCrackEdge,
                                     ProvedKernel::kCrackCentre, ProvedKernel::kRowStream,
                                     ProvedKernel::kRowStreamEdge};

std::vector<Neighbourhood> some_topologies() {
  std::vector<Neighbourhood> list;
  for (const auto& valence :
       {std::array{6, 6, 6, 6}, std::array{3, 6, 4, 6}, std::array{5, 7, 9, 12}, std::array{20, 5, 50, 6}})
    list.push_back(*interior_pair(valence));
  const auto boundary = boundary_pairs({6, 6, 6, 6});
  for (std::size_t k = 0; k < boundary.size(); k += 7) list.push_back(boundary[k]);
  return list;
}

// Expected: no error beyond its point's bound, for any kernel.
TEST(Proof_Bounds, HoldForTheWorstErrorsThatASearchFinds) {
  double largest = 0;
  for (const Neighbourhood& n : some_topologies()) {
    for (const ProvedKernel kernel : kKernels) {
      for (int depth = 0; depth <= (kernel == ProvedKernel::kCrackCentre ? 0 : 4); ++depth) {
        const KernelBounds bounds = bound_kernel(kernel, n, depth);
        const WorstObserved worst = search_worst(n, bounds, 160, 1);
        EXPECT_LE(worst.position_share, 1) << n.name << ' ' << name_of(kernel) << " depth " << depth;
        EXPECT_LE(worst.tangent_share, 1) << n.name << ' ' << name_of(kernel) << " depth " << depth;
        EXPECT_LT(bounds.position(), 1e-6) << n.name << ' ' << name_of(kernel) << " depth " << depth;
        if (depth > 0) largest = std::max(largest, bounds.position() / worst.position);
      }
    }
  }
  RecordProperty("largest_slack_of_positions", std::to_string(largest));
  EXPECT_LT(largest, 10) << "a bound this loose would say little";
}

// The rows that the bounds carry are those of the reference.
TEST(Proof_Bounds, AreAboutTheLinearMapOfTheReference) {
  const Neighbourhood n = *interior_pair({5, 7, 9, 12});
  ReferenceMap<double, reference::StamEvaluator<double>> reference(n.mesh);
  double worst = 0;
  for (const ProvedKernel kernel : kKernels) {
    for (const PointBound& p : bound_kernel(kernel, n, 3).points) {
      if (!p.has_tangents) continue;
      // du, dv span the plane of d1, d2: solve by the two control points with the largest determinant
      const auto& row = reference.at(p.at);
      double best = 0;
      std::size_t a = 0, b = 1;
      for (std::size_t i = 0; i < row.d1.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const double det = std::abs(row.d1[i] * row.d2[j] - row.d1[j] * row.d2[i]);
          if (det > best) best = det, a = i, b = j;
        }
      }
      const double det = row.d1[a] * row.d2[b] - row.d1[b] * row.d2[a];
      for (const TangentBound* t : {&p.du, &p.dv}) {
        const double c1 = (t->weights[a] * row.d2[b] - t->weights[b] * row.d2[a]) / det;
        const double c2 = (row.d1[a] * t->weights[b] - row.d1[b] * t->weights[a]) / det;
        for (std::size_t i = 0; i < row.d1.size(); ++i)
          worst = std::max(worst, std::abs(t->weights[i] - c1 * row.d1[i] - c2 * row.d2[i]) / t->size);
      }
    }
  }
  EXPECT_LT(worst, 1e-12);
}

// 2^-13 is what choosing a local origin rounds by; it leaves again. What stays is the rounding near it.
TEST(Proof_Bounds, OfLocalOriginsAreOfTheSizeOfAFewRoundings) {
  const Neighbourhood n = *interior_pair({6, 6, 6, 6});
  const double at_3 = bound_kernel(ProvedKernel::kRowStream, n, 3).position();
  const double at_4 = bound_kernel(ProvedKernel::kRowStream, n, 4).position();
  EXPECT_GT(at_4, at_3);
  EXPECT_LT(at_4, 2 * at_3);
  EXPECT_LT(at_4, 0x1p-20);
}

TEST(Proof_Bounds, OfTheWindowAreProportionalToTheBoxDownToUnderflow) {
  const Neighbourhood n = *interior_pair({5, 7, 9, 12});
  const double one = bound_kernel(ProvedKernel::kSlidingWindow, n, 3).position();
  EXPECT_NEAR(bound_kernel(ProvedKernel::kSlidingWindow, n, 3, 0x1p40).position() / one, 0x1p41, 0x1p10);
  const KernelBounds tiny = bound_kernel(ProvedKernel::kSlidingWindow, n, 3, 0x1p-130);
  EXPECT_GT(tiny.position(), one * 0x1p-129) << "the smallest floats are further apart";
  EXPECT_LE(search_worst(n, tiny, 200, 3, 0x1p-130).position_share, 1);
}

// A mesh of another size is scaled by a power of two before row streaming; local origins lie on a
// grid of 2^-12.
TEST(Proof_Bounds, OfRowStreamingAreNearlyProportionalToTheBox) {
  const Neighbourhood n = *interior_pair({5, 7, 9, 12});
  for (const int depth : {3, 4}) {
    const double half = bound_kernel(ProvedKernel::kRowStream, n, depth, .5).position();
    for (const double reach : {1., 2.})
      EXPECT_NEAR(bound_kernel(ProvedKernel::kRowStream, n, depth, reach).position() / (2 * reach * half), 1,
                  .02)
          << "depth " << depth << " reach " << reach;
  }
}

/// Bounds that forget something, against errors that the kernels really make.
double share_with(const RoundingModel& model, ProvedKernel kernel, int depth) {
  double share = 0;
  for (const auto& valence : {std::array{6, 6, 6, 6}, std::array{5, 7, 9, 12}}) {
    const Neighbourhood n = *interior_pair(valence);
    const KernelBounds bounds = bound_kernel(kernel, n, depth, kUnitBox, model);
    const WorstObserved worst = search_worst(n, bounds, 2000, 7);
    share = std::max({share, worst.position_share, worst.tangent_share});
  }
  return share;
}

TEST(Proof_BoundFaults, HalfTheUnitIsExceededByBothKernels) {
  RoundingModel half;
  half.unit = 0x1p-25;
  for (const ProvedKernel kernel : kKernels) {
    double share = 0;
    for (int depth = 0; depth <= 1; ++depth) share = std::max(share, share_with(half, kernel, depth));
    if (kernel == ProvedKernel::kCrackCentre) continue;  // no point of few operations
    EXPECT_GT(share, 1.5) << name_of(kernel);
  }
}
TEST(Proof_BoundFaults, AForgottenNarrowingIsExceeded) {
  RoundingModel model;
  model.narrowing = false;
  for (const ProvedKernel kernel : {ProvedKernel::kSlidingWindow, ProvedKernel::kRowStream})
    EXPECT_GT(share_with(model, kernel, 0), 1) << name_of(kernel);
}
TEST(Proof_BoundFaults, ForgottenSumsAreExceeded) {
  RoundingModel model;
  model.sums = false;
  EXPECT_GT(share_with(model, ProvedKernel::kSlidingWindow, 1), 1);
  EXPECT_GT(share_with(model, ProvedKernel::kRowStream, 1), 1);
}

}  // namespace
}  // namespace limitcheck::verify
