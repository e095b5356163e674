// SPDX-License-Identifier: MIT
// The proved bounds hold for every error that can be found, and would not if they forgot a rounding.
// Proved float errors of the quad kernels: never exceeded, and not far off.
// What ships, on every vector target, is what was proved; and what is not is seen.
// Float errors as facts about the true surface.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "fast/stream/kernel/targets.h"
#include "reference/loop/stam.h"
#include "reference/number/number_exact.h"
#include "verify/proof/bounds/bounds.h"
#include "verify/proof/maps/reference_map.h"
#include "verify/proof/numbers/quad_weights.h"
#include "verify/proof/proof_set.h"
#include "verify/proof/topologies/neighbourhood.h"

namespace limitcheck::verify {
namespace {

constexpr ProvedKernel kTriangleKernels[] = {ProvedKernel::kSlidingWindow, ProvedKernel::kCrackEdge,
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
    for (const ProvedKernel kernel : kTriangleKernels) {
      for (int depth = 0; depth <= (kernel == ProvedKernel::kCrackCentre ? 0 : 4); ++depth) {
        const KernelBounds bounds = bound_kernel(kernel, n, depth);
        const BoundProof worst = search_worst(n, bounds, 160, 1);
        EXPECT_LE(worst.share, 1) << n.name << ' ' << name_of(kernel) << " depth " << depth;
        EXPECT_LT(bounds.position(), 1e-6) << n.name << ' ' << name_of(kernel) << " depth " << depth;
        if (depth > 0) largest = std::max(largest, bounds.position() / worst.position_worst);
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
  for (const ProvedKernel kernel : kTriangleKernels) {
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
  EXPECT_LE(search_worst(n, tiny, 200, 3, 0x1p-130).share, 1);
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
    share = std::max(share, search_worst(n, bounds, 2000, 7).share);
  }
  return share;
}

TEST(Proof_BoundFaults, HalfTheUnitIsExceededByBothKernels) {
  RoundingModel half{.unit = 0x1p-25};
  for (const ProvedKernel kernel : kTriangleKernels) {
    double share = 0;
    for (int depth = 0; depth <= 1; ++depth) share = std::max(share, share_with(half, kernel, depth));
    if (kernel == ProvedKernel::kCrackCentre) continue;  // no point of few operations
    EXPECT_GT(share, 1.5) << name_of(kernel);
  }
}
TEST(Proof_BoundFaults, AForgottenNarrowingOrSumIsExceeded) {
  for (const ProvedKernel kernel : {ProvedKernel::kSlidingWindow, ProvedKernel::kRowStream}) {
    EXPECT_GT(share_with({.narrowing = false}, kernel, 0), 1) << name_of(kernel);
    EXPECT_GT(share_with({.sums = false}, kernel, 1), 1) << name_of(kernel);
  }
}

constexpr std::array kQuadKernels{ProvedKernel::kSlidingWindow, ProvedKernel::kCrackEdge,
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
    for (const ProvedKernel kernel : kQuadKernels) expect_bounded(kernel, quad, 3);
    if (valences[0] == 4) expect_bounded(ProvedKernel::kRowStreamPatch, quad, 3);
  }
}

TEST(Proof_QuadBounds, HoldAtBoundariesCutsAndSemiSharpEdges) {
  for (const ProvedKernel kernel : kQuadKernels) {
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
    EXPECT_LT(bound_kernel(kernel, quad, 2, kUnitBox, {.sums = false}).position(), whole);
    EXPECT_LT(bound_kernel(kernel, quad, 2, kUnitBox, {.narrowing = false}).position(), whole);
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

/// Of every kernel that the topology has: the largest share of a normal's bound.
double expect_held(const Neighbourhood& n, int last_depth, bool regular) {
  double largest = 0;
  for (const ProvedKernel kernel : kProvedKernels) {
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
  for (const Neighbourhood& pair : pairs)
    largest = std::max(largest, expect_held(pair, 4, &pair == pairs.data()));
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

// Bound: five roundings of a coordinate in the box, an ulp of 2^-24 each, are 3e-7 of its side; the bounds
// proved per topology are below 6e-7 of the unit box. Worst seen: see the properties.
TEST(Certified, PositionsOfBothKernelsLieWithin3e7OfTheTrueSurface) {
  CertifiedErrors worst;
  for (const ProvedKernel kernel : {ProvedKernel::kSlidingWindow, ProvedKernel::kRowStream}) {
    for (const std::string& name : data::stock_shapes()) {
      const auto mesh = data::named_mesh(name);
      for (const int depth : {1, 4}) {
        const CertifiedErrors errors = compare_certified(kernel, mesh, depth, 12);
        EXPECT_GT(errors.points, 2) << name;
        EXPECT_LT(errors.position, 3e-7)
            << name << " face " << errors.face << ' ' << errors.l1 << ' ' << errors.l2;
        EXPECT_LT(errors.radius, 1e-15) << name;
        EXPECT_GT(errors.position, 0) << name;
        worst.position = std::max(worst.position, errors.position);
        worst.normal = std::max(worst.normal, errors.normal);
      }
    }
  }
  RecordProperty("worst_position", fmt::format("{:.3g} of the diagonal", worst.position));
  RecordProperty("worst_normal", fmt::format("{:.3g} degrees", worst.normal));
  EXPECT_LT(worst.normal, .1);
  fmt::print("certified: {:.3g} of the diagonal, {:.3g} degrees\n", worst.position, worst.normal);
}

TEST(Certified, QuadKernelsAreNearTheTrueSurface) {
  CertifiedErrors worst;
  auto lines = stock_shape_lines({ProvedKernel::kSlidingWindow, ProvedKernel::kRowStream}, 3,
                                 data::Scheme::kCatmullClark);
  certify(lines, 12);
  for (const CertifiedLine& line : lines) {
    EXPECT_GT(line.errors.points, 2) << line.mesh;
    EXPECT_LT(line.errors.position, 3e-7) << line.mesh << ' ' << line.kernel << " face " << line.errors.face
                                          << ' ' << line.errors.l1 << ' ' << line.errors.l2;
    EXPECT_GT(line.errors.position, 0) << line.mesh;
    worst.position = std::max(worst.position, line.errors.position);
    worst.normal = std::max(worst.normal, line.errors.normal);
  }
  RecordProperty("worst_position", fmt::format("{:.3g} of the diagonal", worst.position));
  EXPECT_LT(worst.normal, .1);
  fmt::print("certified quads: {:.3g} of the diagonal, {:.3g} degrees\n", worst.position, worst.normal);
}

TEST(Certified, SeesAMovedControlPoint) {
  // The kernel's own mesh is not the one asked about: one coordinate two float steps off.
  auto mesh = data::named_mesh("icosahedron");
  mesh.positions[0][0] += 1e-9;
  EXPECT_THROW(compare_certified(ProvedKernel::kRowStream, mesh, 2, 10), data::ArgumentError);
}

}  // namespace
}  // namespace limitcheck::verify
