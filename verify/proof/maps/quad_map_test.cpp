// SPDX-License-Identifier: MIT
// The shipped kernels of quads are the reference's linear maps: samples of what `limitcheck prove --scheme
// catmull-clark` proves. [C21]
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "verify/proof/maps/prove_map.h"
#include "verify/proof/topologies/neighbourhood.h"

namespace limitcheck::verify {
namespace {

// Digits of the worst weight. Every kernel must have a row with points.
double expect_equal(const Neighbourhood& quad, const MapOptions& options, std::size_t kernels = 4) {
  double digits = 1e9;
  const std::vector<ProofRow> rows = prove_map(quad, options);
  EXPECT_EQ(rows.size(), kernels) << quad.name;
  for (const ProofRow& row : rows) {
    digits = std::min(digits, row.map.digits);
    EXPECT_TRUE(row.map.equal) << row.topology << ' ' << row.kernel;
    EXPECT_GT(row.points, 0);
    if (!row.map.witness) continue;
    const MapWitness& w = *row.map.witness;
    ADD_FAILURE() << row.topology << ' ' << row.kernel << ' ' << w.point << ": " << w.quantity
                  << " of control point " << w.control_point << " is " << w.found << ", not " << w.expected;
  }
  return digits;
}

TEST(Proof_QuadMap, IsExactAtEveryValence) {
  RecordProperty("claim", "C21");
  for (const auto& valences : {std::array{3, 4, 5, 6}, std::array{7, 3, 8, 3}, std::array{12, 5, 3, 4},
                               std::array{3, 3, 3, 3}, std::array{20, 4, 4, 4}})
    expect_equal(interior_quad(valences), {Arithmetic::kExact, 0, 2});
  expect_equal(interior_quad({4, 4, 4, 4}), {Arithmetic::kExact, 0, 3}, 5);
}

TEST(Proof_QuadMap, IsEqualModuloTwoPrimesToDepthSix) {
  expect_equal(interior_quad({5, 3, 7, 4}), {Arithmetic::kResidues, 0, 6});
  expect_equal(interior_quad({4, 4, 4, 4}), {Arithmetic::kResidues, 0, 6}, 5);
}

TEST(Proof_QuadMap, EqualsTheRecursionAndStamToFortyFiveDigitsWithAllTangents) {
  for (const auto& valences : {std::array{5, 7, 3, 12}, std::array{4, 6, 4, 8}})
    EXPECT_GE(expect_equal(interior_quad(valences), {Arithmetic::kDigits, 0, 2}), 45);
}

TEST(Proof_QuadMap, AtBoundariesIsEqual) {
  const auto quads = boundary_quads({4, 5, 3, 6});
  EXPECT_GT(quads.size(), 50U);
  for (const Neighbourhood& quad : quads) expect_equal(quad, {Arithmetic::kExact, 0, 2});
  for (std::size_t k = 0; k < quads.size(); k += 10) expect_equal(quads[k], {Arithmetic::kDigits, 0, 1});
}

TEST(Proof_QuadMap, BesideCutsAndDartsIsEqual) {
  std::size_t darts = 0;
  for (const Neighbourhood& quad : creased_quads({4, 5, 3, 6})) {
    if (has_dart(quad.mesh)) {
      if (++darts % 10 == 0) expect_equal(quad, {Arithmetic::kDigits, 0, 1});
    } else {
      expect_equal(quad, {Arithmetic::kExact, 0, 2});
    }
  }
  EXPECT_GT(darts, 20U);
}

TEST(Proof_QuadMap, OfTheWindowBesideSemiSharpEdgesIsEqual) {
  for (const Neighbourhood& quad : semi_sharp_quads({4, 5, 3, 6}))
    if (!has_dart(quad.mesh)) expect_equal(quad, {Arithmetic::kExact, 0, 2}, 2);
}

}  // namespace
}  // namespace limitcheck::verify
