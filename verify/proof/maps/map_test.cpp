// SPDX-License-Identifier: MIT
// The shipped kernels are the reference's linear maps: samples of what `limitcheck prove` proves. [C21]
// The situations that proofs range over are the ones they say they are.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/shapes.h"
#include "fast/mesh/adjacency.h"
#include "verify/proof/maps/prove_map.h"
#include "verify/proof/maps/reference_map.h"
#include "verify/proof/numbers/coefficient.h"
#include "verify/proof/topologies/neighbourhood.h"

namespace limitcheck::verify {
namespace {

/// The kernels of a quad that is not regular, and of a pair that is.
constexpr std::size_t kOfQuads = 4, kOfRegularPairs = 6;

/// Digits of the worst weight. Every kernel must have a row with points.
double expect_equal(const Neighbourhood& pair, const MapOptions& options, std::size_t kernels = 5) {
  double digits = 1e9;
  const std::vector<ProofRow> rows = prove_map(pair, options);
  EXPECT_EQ(rows.size(), kernels) << pair.name;
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

TEST(Proof_Map, IsExactWithRationalWeights) {
  RecordProperty("claim", "C21");
  expect_equal(*interior_pair({6, 6, 6, 6}), {Arithmetic::kExact, 0, 4}, kOfRegularPairs);
  for (const auto& valences : {std::array{3, 6, 4, 6}, std::array{4, 3, 6, 4}})
    expect_equal(*interior_pair(valences), {Arithmetic::kExact, 0, 3});
  for (const auto& valences : {std::array{3, 4, 5, 6}, std::array{7, 3, 8, 3}, std::array{12, 5, 3, 4},
                               std::array{3, 3, 3, 3}, std::array{20, 4, 4, 4}})
    expect_equal(interior_quad(valences), {Arithmetic::kExact, 0, 2}, kOfQuads);
  expect_equal(interior_quad({4, 4, 4, 4}), {Arithmetic::kExact, 0, 3});
}

TEST(Proof_Map, OfOtherWeightsIsEqualModuloTwoPrimesToDepthSix) {
  expect_equal(*interior_pair({5, 7, 9, 12}), {Arithmetic::kResidues, 0, 6});
  expect_equal(interior_quad({5, 3, 7, 4}), {Arithmetic::kResidues, 0, 6}, kOfQuads);
  expect_equal(interior_quad({4, 4, 4, 4}), {Arithmetic::kResidues, 0, 6});
}

TEST(Proof_Map, EqualsTheRecursionAndStamToFortyFiveDigitsWithAllTangents) {
  const double digits = expect_equal(*interior_pair({5, 7, 9, 12}), {Arithmetic::kDigits, 0, 3});
  RecordProperty("digits", fmt::format("{:.1f}", digits));
  EXPECT_GE(digits, 45);
  for (const auto& valences : {std::array{5, 7, 3, 12}, std::array{4, 6, 4, 8}})
    EXPECT_GE(expect_equal(interior_quad(valences), {Arithmetic::kDigits, 0, 2}, kOfQuads), 45);
}

TEST(Proof_Map, OfSmallAndLargeValencesIsEqual) {
  for (const auto& valences : {std::array{3, 3, 3, 3}, std::array{3, 4, 12, 5}, std::array{4, 3, 4, 3},
                               std::array{50, 3, 6, 20}, std::array{6, 100, 4, 6}}) {
    const auto pair = interior_pair(valences);
    ASSERT_TRUE(pair) << fmt::format("no mesh has the valences {}", fmt::join(valences, " "));
    expect_equal(*pair, {Arithmetic::kResidues, 0, 3});
  }
}

TEST(Proof_Map, AtBoundariesIsEqual) {
  const auto pairs = boundary_pairs({6, 6, 6, 6});
  EXPECT_GT(pairs.size(), 100U);
  for (const Neighbourhood& pair : pairs) expect_equal(pair, {Arithmetic::kResidues, 0, 2});
  std::size_t to_digits = 0;
  for (const Neighbourhood& pair : pairs) {
    if (pair.name.find_first_of("45") != std::string::npos) continue;
    expect_equal(pair, {Arithmetic::kDigits, 1, 1});
    ++to_digits;
  }
  EXPECT_GT(to_digits, 10U);
}

TEST(Proof_Map, OfAValenceThatResiduesDoNotHaveIsRefused) {
  EXPECT_THROW(prove_map(*interior_pair({23, 6, 6, 6}), {}), data::ArgumentError);
}

// The quick reference map is the slow one.
TEST(Proof_SharedReferenceMap, EqualsTheEvaluatorsAtEveryPoint) {
  std::vector<Neighbourhood> list{*interior_pair({5, 7, 9, 12}), *interior_pair({3, 6, 4, 6}),
                                  *interior_pair({6, 6, 6, 6}), face_alone()};
  const auto boundary = boundary_pairs({5, 4, 7, 8});
  for (std::size_t k = 0; k < boundary.size(); k += 9) list.push_back(boundary[k]);
  for (const Neighbourhood& n : list) {
    SharedReferenceMap<Residue> shared(n.mesh);
    ReferenceMap<Residue, reference::SubdivisionEvaluator<Residue>> plain(n.mesh);
    const auto expect_equal = [&](const fast::LatticePoint& at) {
      const auto &a = shared.at(at), &b = plain.at(at);
      EXPECT_TRUE(a.position == b.position && a.d1 == b.d1 && a.d2 == b.d2)
          << n.name << " face " << at.face << " at " << at.i << ' ' << at.j << " of " << at.denominator;
    };
    for (std::int32_t face = 0; face < (n.mesh.faces.size() == 1 ? 1 : 2); ++face) {
      constexpr std::uint32_t kSize = 16;
      for (std::uint32_t i = 0; i <= kSize; ++i)
        for (std::uint32_t j = 0; i + j <= kSize; ++j) expect_equal({face, i, j, kSize});
      expect_equal({face, 1, 1, 3});
    }
  }
}

TEST(Proof_QuadMap, AtBoundariesIsEqual) {
  const auto quads = boundary_quads({4, 5, 3, 6});
  EXPECT_GT(quads.size(), 50U);
  for (const Neighbourhood& quad : quads) expect_equal(quad, {Arithmetic::kExact, 0, 2}, kOfQuads);
  for (std::size_t k = 0; k < quads.size(); k += 10)
    expect_equal(quads[k], {Arithmetic::kDigits, 0, 1}, kOfQuads);
}

TEST(Proof_QuadMap, BesideCutsAndDartsIsEqual) {
  std::size_t darts = 0;
  for (const Neighbourhood& quad : creased_quads({4, 5, 3, 6})) {
    if (has_dart(quad.mesh)) {
      if (++darts % 10 == 0) expect_equal(quad, {Arithmetic::kDigits, 0, 1}, kOfQuads);
    } else {
      expect_equal(quad, {Arithmetic::kExact, 0, 2}, kOfQuads);
    }
  }
  EXPECT_GT(darts, 20U);
}

TEST(Proof_QuadMap, OfTheWindowBesideSemiSharpEdgesIsEqual) {
  for (const Neighbourhood& quad : semi_sharp_quads({4, 5, 3, 6}))
    if (!has_dart(quad.mesh)) expect_equal(quad, {Arithmetic::kExact, 0, 2}, 2);
}

TEST(Proof_Neighbourhoods, HaveTheInteriorValencesAskedForOrDoNotExist) {
  int missing = 0;
  for (int a = 3; a <= 12; ++a) {
    for (int b = 3; b <= 12; ++b) {
      for (int c = 3; c <= 12; ++c) {
        for (int d = 3; d <= 12; ++d) {
          const auto pair = interior_pair({a, b, c, d});
          if (!pair) {
            // Two neighbours of valence 3 share all three neighbours: the rest of the mesh is decided.
            EXPECT_TRUE(a == 3 || b == 3 || c == 3 || d == 3 || (a == 4 && c == 4))
                << fmt::format("{} {} {} {}", a, b, c, d);
            ++missing;
            continue;
          }
          EXPECT_EQ(pair->name, fmt::format("{} {} {} {}", a, b, c, d));
        }
      }
    }
  }
  RecordProperty("missing", missing);
  fmt::print("{} of 10000 have no mesh\n", missing);
}

TEST(Proof_Neighbourhoods, AtBoundariesHaveOneToFourBoundaryEdgesAndVerticesOfOneToFiveFaces) {
  std::set<int> edges, diagonal_faces, other_faces;
  for (const Neighbourhood& pair : boundary_pairs({6, 6, 6, 6})) {
    const fast::Adjacency adjacency(pair.mesh);
    int boundary = 0;
    for (const int h : {1, 2, 3, 4}) boundary += adjacency.twin(h) < 0 ? 1 : 0;
    edges.insert(boundary);
    for (const int corner : {0, 1, 2, 3})
      if (adjacency.on_boundary(corner))
        (corner % 2 == 0 ? diagonal_faces : other_faces).insert(adjacency.valence(corner) - 1);
    EXPECT_EQ(signature(pair.mesh, 0), pair.name);
  }
  EXPECT_EQ(edges, (std::set{0, 1, 2, 3, 4}));
  EXPECT_EQ(diagonal_faces, (std::set{2, 3, 4, 5}));
  EXPECT_EQ(other_faces, (std::set{1, 2, 3, 4, 5}));
}

TEST(Proof_Neighbourhoods, OfAMeshAreAllItsPairs) {
  EXPECT_EQ(pairs_of(data::icosahedron()).size(), 1U);
  EXPECT_EQ(pairs_of(data::icosahedron()).front().name, "5 5 5 5");
  const auto pairs = pairs_of(data::bipyramid(7));
  ASSERT_EQ(pairs.size(), 3U);  // across the equator, and down a side in two directions
  std::set<std::string> names;
  for (const Neighbourhood& pair : pairs) names.insert(pair.name);
  EXPECT_EQ(names, (std::set<std::string>{"4 7 4 7", "4 4 7 4", "7 4 4 4"}));
}

}  // namespace
}  // namespace limitcheck::verify
