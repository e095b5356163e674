// SPDX-License-Identifier: MIT
#include "data/validate.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>

#include "data/shapes.h"
#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

// A mesh of which only the connections matter.
ControlMesh mesh_of(std::size_t vertices, std::vector<std::array<std::int32_t, 3>> triangles) {
  return {std::vector<std::array<double, 3>>(vertices), std::move(triangles)};
}

// Expects exactly one finding of this fault with these elements.
void expect_only(const ControlMesh& mesh, MeshFault fault, const std::vector<std::int64_t>& elements,
                 const std::string& message) {
  const auto findings = validate(mesh);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(code(findings[0].fault), code(fault));
  EXPECT_EQ(findings[0].elements, elements);
  EXPECT_EQ(findings[0].message, message);
}

TEST(Validate, AnEmptyMeshIsRefused) {
  expect_only({}, MeshFault::kEmpty, {}, "0 vertices and 0 faces");
  expect_only(mesh_of(3, {}), MeshFault::kEmpty, {}, "3 vertices and 0 faces");
  EXPECT_EQ(validate_counts(0, 3).at(0).fault, MeshFault::kEmpty);
  EXPECT_TRUE(validate_counts(1, 3).empty());
}

TEST(Validate, MoreThan32BitIndicesCanNameIsRefused) {
  const std::int64_t most = std::numeric_limits<std::int32_t>::max();
  EXPECT_TRUE(validate_counts(most, most / 3).empty());
  EXPECT_EQ(validate_counts(most + 1, 1).at(0).fault, MeshFault::kTooLarge);
  EXPECT_EQ(validate_counts(3, most / 3 + 1).at(0).fault, MeshFault::kTooLarge);
}

TEST(Validate, AnIndexOutOfRangeNamesItsFaceAndNothingElse) {
  expect_only(mesh_of(4, {{0, 1, 2}, {2, 1, 3}, {1, 0, 4}}), MeshFault::kIndexOutOfRange, {2, 4},
              "face 2 names vertex 4, the mesh has 4");
  expect_only(mesh_of(3, {{0, 1, 2}, {-1, 0, 1}}), MeshFault::kIndexOutOfRange, {1, -1},
              "face 1 names vertex -1, the mesh has 3");
  expect_only(mesh_of(3, {{0, 1, 2}, {2147483647, 0, 1}}), MeshFault::kIndexOutOfRange, {1, 2147483647},
              "face 1 names vertex 2147483647, the mesh has 3");
}

// Without the two faces that are left out the four others round vertex 0 make two fans: no verdict on those.
TEST(Validate, AFaceLeftOutTakesNoVertexWithItThatWasWhole) {
  const auto findings =
      validate(mesh_of(7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 7}, {0, 4, 5}, {0, 5, 6}, {0, 6, 8}}));
  ASSERT_EQ(findings.size(), 2u);
  for (const MeshFinding& finding : findings) EXPECT_EQ(finding.fault, MeshFault::kIndexOutOfRange);
}

TEST(Validate, EveryCoordinateMustBeFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf}) {
    for (int axis = 0; axis < 3; ++axis) {
      ControlMesh mesh = tetrahedron();
      mesh.positions[2][axis] = bad;
      const auto findings = validate(mesh);
      ASSERT_EQ(findings.size(), 1u);
      EXPECT_EQ(findings[0].fault, MeshFault::kNotFinite);
      EXPECT_EQ(findings[0].vertex, 2);
    }
  }
}

TEST(Validate, AFaceWithARepeatedVertexIsDegenerate) {
  for (const std::array<std::int32_t, 3> t :
       {std::array{3, 3, 1}, std::array{1, 3, 3}, std::array{3, 1, 3}}) {
    expect_only(mesh_of(4, {{0, 1, 2}, {2, 1, 3}, t}), MeshFault::kDegenerateFace, {2, 3},
                "face 2 names vertex 3 twice");
  }
}

TEST(Validate, TheSameThreeVerticesTwiceAreADuplicateInAnyOrder) {
  constexpr std::array<std::array<int, 3>, 4> orders = {{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}}};
  for (std::int64_t original = 0; original < 4; ++original) {
    for (const auto& order : orders) {
      ControlMesh mesh = tetrahedron();
      const auto t = mesh.triangles[original];
      mesh.triangles.push_back({t[order[0]], t[order[1]], t[order[2]]});
      const auto findings = validate(mesh);
      ASSERT_EQ(findings.size(), 1u);
      EXPECT_EQ(findings[0].fault, MeshFault::kDuplicateFace);
      EXPECT_EQ(findings[0].elements, (std::vector<std::int64_t>{original, 4}));
      EXPECT_EQ(findings[0].face, 4);
    }
  }
}

TEST(Validate, AnEdgeOfThreeFacesNamesThemAll) {
  expect_only(mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), MeshFault::kNonmanifoldEdge, {0, 1, 0, 1, 2},
              "edge 0–1 has 3 faces (0, 1, 2)");
}

TEST(Validate, AnEdgeOfManyFacesNamesTheFirstEightInItsMessage) {
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int i = 0; i < 12; ++i) triangles.push_back({0, 1, 2 + i});
  expect_only(mesh_of(14, triangles), MeshFault::kNonmanifoldEdge,
              {0, 1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11},
              "edge 0–1 has 12 faces (0, 1, 2, 3, 4, 5, 6, 7, …)");
  triangles.resize(8);
  expect_only(mesh_of(10, triangles), MeshFault::kNonmanifoldEdge, {0, 1, 0, 1, 2, 3, 4, 5, 6, 7},
              "edge 0–1 has 8 faces (0, 1, 2, 3, 4, 5, 6, 7)");
}

TEST(Validate, TwoFacesAlongAnEdgeInTheSameDirectionClash) {
  expect_only(mesh_of(4, {{0, 1, 2}, {0, 1, 3}}), MeshFault::kOrientationClash, {0, 1, 0, 1},
              "faces 0 and 1 both run from 0 to 1");
  ControlMesh mesh = octahedron();
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  const auto findings = validate(mesh);
  ASSERT_EQ(findings.size(), 3u);  // its three edges
  for (const MeshFinding& finding : findings) EXPECT_EQ(finding.fault, MeshFault::kOrientationClash);
}

TEST(Validate, AVertexBetweenTwoFansIsABowtie) {
  expect_only(mesh_of(5, {{0, 1, 2}, {0, 3, 4}}), MeshFault::kBowtieVertex, {0, 0, 1},
              "vertex 0 joins 2 fans (of faces 0, 1)");
}

TEST(Validate, AVertexBetweenTwoClosedFansIsABowtie) {
  ControlMesh mesh = tetrahedron();
  const ControlMesh other = tetrahedron();
  for (const auto& p : other.positions) mesh.positions.push_back(p);
  mesh.positions.pop_back();
  for (auto t : other.triangles) {
    for (auto& v : t) v = v == 0 ? 0 : v + 3;
    mesh.triangles.push_back(t);
  }
  expect_only(mesh, MeshFault::kBowtieVertex, {0, 0, 4}, "vertex 0 joins 2 fans (of faces 0, 4)");
}

TEST(Validate, AVertexBetweenAClosedAndAnOpenFanIsABowtie) {
  ControlMesh mesh = wheel(5, 1);
  mesh.positions.resize(mesh.positions.size() + 2);
  mesh.triangles.push_back({0, 6, 7});
  expect_only(mesh, MeshFault::kBowtieVertex, {0, 0, 5}, "vertex 0 joins 2 fans (of faces 0, 5)");
}

TEST(Validate, AnInteriorVertexOfValenceTwoIsRefused) {
  // Vertex 3 lies inside the edge 0-1 of an otherwise open strip: faces {0,1,3} and {0,3,1} back to back.
  const ControlMesh mesh = mesh_of(4, {{0, 2, 1}, {0, 1, 3}, {0, 3, 1}});
  expect_only(mesh, MeshFault::kLowValence, {3}, "interior vertex 3 has valence 2 (faces 1, 2 back to back)");
  const auto pillow = validate(mesh_of(3, {{0, 1, 2}, {0, 2, 1}}));
  ASSERT_EQ(pillow.size(), 3u);
  for (const MeshFinding& finding : pillow) EXPECT_EQ(finding.fault, MeshFault::kLowValence);
}

TEST(Validate, AVertexWithoutFacesIsIsolated) {
  ControlMesh mesh = tetrahedron();
  mesh.positions.push_back({0, 0, 0});
  expect_only(mesh, MeshFault::kIsolatedVertex, {4}, "no face names vertex 4");
}

TEST(Validate, EveryIndependentFaultIsReported) {
  // Two tetrahedra apart, a NaN in the one, an extra face on an edge of the other, an isolated vertex.
  ControlMesh mesh = two_components();
  mesh.positions[1][0] = std::nan("");
  const auto before = static_cast<std::int32_t>(mesh.positions.size());
  mesh.positions.push_back({9, 9, 9});
  mesh.positions.push_back({8, 8, 8});
  mesh.triangles.push_back({0, 1, before});
  const auto findings = validate(mesh);
  ASSERT_EQ(findings.size(), 3u);
  EXPECT_EQ(findings[0].fault, MeshFault::kNotFinite);
  EXPECT_EQ(findings[1].fault, MeshFault::kNonmanifoldEdge);
  EXPECT_EQ(findings[2].fault, MeshFault::kIsolatedVertex);
}

// The method that needs no cleverness: every property straight from its definition, by comparing
// all with all.
bool valid_by_definition(const ControlMesh& mesh) {
  const auto vertices = static_cast<std::int32_t>(mesh.positions.size());
  const auto& faces = mesh.triangles;
  const auto has = [](const auto& t, std::int32_t v) { return t[0] == v || t[1] == v || t[2] == v; };
  for (const auto& t : faces) {
    for (int k = 0; k < 3; ++k) {
      if (t[k] < 0 || t[k] >= vertices || t[k] == t[(k + 1) % 3]) return false;
      int along = 0, against = 0;
      for (const auto& u : faces) {
        for (int j = 0; j < 3; ++j) {
          along += u[j] == t[k] && u[(j + 1) % 3] == t[(k + 1) % 3];
          against += u[j] == t[(k + 1) % 3] && u[(j + 1) % 3] == t[k];
        }
      }
      if (along != 1 || against > 1) return false;
    }
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t g = 0; g < f; ++g) {
      if (has(faces[f], faces[g][0]) && has(faces[f], faces[g][1]) && has(faces[f], faces[g][2]))
        return false;
    }
  }
  for (std::int32_t v = 0; v < vertices; ++v) {
    // The faces at v must be connected through edges at v.
    std::vector<std::size_t> at;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (has(faces[f], v)) at.push_back(f);
    }
    if (at.empty()) return false;
    std::vector<bool> in(at.size(), false);
    in[0] = true;
    for (std::size_t round = 0; round < at.size(); ++round) {
      for (std::size_t i = 0; i < at.size(); ++i) {
        for (std::size_t j = 0; j < at.size(); ++j) {
          if (!in[i] || in[j]) continue;
          int common = 0;
          for (const std::int32_t w : faces[at[i]]) common += has(faces[at[j]], w);
          if (common >= 2) in[j] = true;
        }
      }
    }
    for (const bool reached : in) {
      if (!reached) return false;
    }
  }
  return true;
}

TEST(Validate, AgreesWithTheDefinitionsOnRandomTriangleSoups) {
  SplitMix64 random(7);
  const std::vector<ControlMesh> starts = {tetrahedron(), octahedron(), wheel(3, 1),  wheel(5, 1),
                                           fan(4, 1),     strip(4),     bipyramid(3), sheet(2, 2)};
  int valid = 0, total = 0;
  for (int i = 0; i < 20000; ++i) {
    ControlMesh mesh = starts[random.next() % starts.size()];
    for (int change = static_cast<int>(random.next() % 4); change > 0; --change) {
      const auto any_vertex = [&] {
        return static_cast<std::int32_t>(random.next() % mesh.positions.size());
      };
      const std::size_t face = random.next() % mesh.triangles.size();
      switch (random.next() % 5) {
        case 0:
          mesh.triangles[face][random.next() % 3] = any_vertex();
          break;
        case 1:
          mesh.triangles.push_back({any_vertex(), any_vertex(), any_vertex()});
          break;
        case 2:
          if (mesh.triangles.size() > 1) mesh.triangles.erase(mesh.triangles.begin() + face);
          break;
        case 3:
          std::swap(mesh.triangles[face][0], mesh.triangles[face][1]);
          break;
        case 4:
          std::swap(mesh.triangles[face], mesh.triangles[0]);
          break;
      }
    }
    const bool expected = valid_by_definition(mesh);
    ASSERT_EQ(validate(mesh).empty(), expected) << "soup " << i;
    valid += expected;
    ++total;
  }
  RecordProperty("valid", valid);
  EXPECT_GT(valid, total / 10);
  EXPECT_LT(valid, total * 9 / 10);
}

TEST(Validate, AHubOfAMillionFacesAndAMillionFacedSheetTakeOnePass) {
  // No time is asserted; a quadratic method would not end. The figures are recorded.
  for (const ControlMesh& mesh : {wheel(1'000'000, 1), bipyramid(500'000), sheet(1000, 500)}) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(validate(mesh).empty());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::cout << mesh.triangles.size() << " faces validated in " << seconds.count() << " s\n";
  }
}

TEST(Validate, AMillionFacesOnOneEdgeAreOneFinding) {
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int i = 0; i < 1'000'000; ++i) triangles.push_back({0, 1, 2 + i});
  EXPECT_EQ(validate(mesh_of(1'000'002, triangles)).size(), 1u);
}

}  // namespace
}  // namespace limitcheck::data
