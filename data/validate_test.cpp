// SPDX-License-Identifier: MIT
#include "data/validate.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>

#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

// A mesh of which only the connections matter.
ControlMesh mesh_of(std::size_t vertices, Faces faces) {
  return {std::vector<std::array<double, 3>>(vertices), std::move(faces)};
}

Faces fan_at_an_edge(int count) {
  Faces faces;
  for (int i = 0; i < count; ++i) faces.push_back({0, 1, 2 + i});
  return faces;
}

// Two tetrahedra that have vertex 0 in common.
ControlMesh two_cones() {
  ControlMesh mesh = tetrahedron();
  const ControlMesh other = tetrahedron();
  for (const auto& p : other.positions) mesh.positions.push_back(p);
  mesh.positions.pop_back();
  for (auto t : triangles_of(other)) {
    for (auto& v : t) v = v == 0 ? 0 : v + 3;
    mesh.faces.push_back(t);
  }
  return mesh;
}

ControlMesh with(ControlMesh mesh, std::size_t vertices, const Faces& faces) {
  mesh.positions.resize(mesh.positions.size() + vertices);
  for (std::size_t f = 0; f < faces.size(); ++f) mesh.faces.push_back(faces[f]);
  return mesh;
}

// Exactly one finding each.
TEST(Validate, EachFaultIsNamedWithItsElementsAndNothingElseIs) {
  using enum MeshFault;
  struct Case {
    ControlMesh mesh;
    MeshFault fault;
    std::vector<std::int64_t> elements;
    std::string message;
  };
  const std::vector<Case> cases{
      {{}, kEmpty, {}, "0 vertices and 0 faces"},
      {mesh_of(3, {}), kEmpty, {}, "a point cloud: 3 vertices and no faces"},
      {mesh_of(4, {{0, 1, 2}, {2, 1, 3}, {1, 0, 4}}),
       kIndexOutOfRange,
       {2, 4},
       "face 2 names vertex 4, the mesh has 4"},
      {mesh_of(3, {{0, 1, 2}, {-1, 0, 1}}),
       kIndexOutOfRange,
       {1, -1},
       "face 1 names vertex -1, the mesh has 3"},
      {mesh_of(3, {{0, 1, 2}, {2147483647, 0, 1}}),
       kIndexOutOfRange,
       {1, 2147483647},
       "face 1 names vertex 2147483647, the mesh has 3"},
      {mesh_of(4, {{0, 1, 2}, {2, 1, 3}, {3, 3, 1}}), kDegenerateFace, {2, 3}, "face 2 names vertex 3 twice"},
      {mesh_of(4, {{0, 1, 2}, {2, 1, 3}, {1, 3, 3}}), kDegenerateFace, {2, 3}, "face 2 names vertex 3 twice"},
      {mesh_of(4, {{0, 1, 2}, {2, 1, 3}, {3, 1, 3}}), kDegenerateFace, {2, 3}, "face 2 names vertex 3 twice"},
      {mesh_of(4, {{0, 1, 2, 3}, {0, 1, 2, 1}}), kDegenerateFace, {1, 1}, "face 1 names vertex 1 twice"},
      {mesh_of(4, {{0, 1, 2, 3}, {0, 1}}), kDegenerateFace, {1, 0}, "face 1 has 2 corners"},
      {mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}),
       kNonmanifoldEdge,
       {0, 1, 0, 1, 2},
       "edge 0–1 has 3 faces (0, 1, 2)"},
      {mesh_of(10, fan_at_an_edge(8)),
       kNonmanifoldEdge,
       {0, 1, 0, 1, 2, 3, 4, 5, 6, 7},
       "edge 0–1 has 8 faces (0, 1, 2, 3, 4, 5, 6, 7)"},
      {mesh_of(14, fan_at_an_edge(12)),
       kNonmanifoldEdge,
       {0, 1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11},
       "edge 0–1 has 12 faces (0, 1, 2, 3, 4, 5, 6, 7, …)"},
      {mesh_of(4, {{0, 1, 2}, {0, 1, 3}}),
       kOrientationClash,
       {0, 1, 0, 1},
       "faces 0 and 1 both run from 0 to 1"},
      {mesh_of(5, {{0, 1, 2}, {0, 3, 4}}), kBowtieVertex, {0, 0, 1}, "vertex 0 joins 2 fans (of faces 0, 1)"},
      {two_cones(), kBowtieVertex, {0, 0, 4}, "vertex 0 joins 2 fans (of faces 0, 4)"},
      {with(wheel(5, 1), 2, {{0, 6, 7}}), kBowtieVertex, {0, 0, 5}, "vertex 0 joins 2 fans (of faces 0, 5)"},
      // Vertex 3 lies inside the edge 0-1 of an otherwise open strip.
      {mesh_of(4, {{0, 2, 1}, {0, 1, 3}, {0, 3, 1}}),
       kLowValence,
       {3},
       "interior vertex 3 has valence 2 (faces 1, 2 back to back)"},
      {mesh_of(5, {{0, 1, 2, 3}, {0, 3, 2, 4}}),
       kLowValence,
       {3},
       "interior vertex 3 has valence 2 (faces 0, 1)"},
      {with(tetrahedron(), 1, {}), kIsolatedVertex, {4}, "no face names vertex 4"}};
  for (const Case& c : cases) {
    const auto findings = validate(c.mesh);
    ASSERT_EQ(findings.size(), 1u) << c.message;
    EXPECT_EQ(code(findings[0].fault), code(c.fault)) << c.message;
    EXPECT_EQ(findings[0].elements, c.elements) << c.message;
    EXPECT_EQ(findings[0].message, c.message);
  }
  EXPECT_EQ(validate_counts(0, 3, 9).at(0).fault, kEmpty);
  EXPECT_TRUE(validate_counts(1, 3, 9).empty());
}

// All findings of a mesh that has several of one kind.
TEST(Validate, OneCauseMayHaveAFindingAtEachOfItsElements) {
  ControlMesh turned = octahedron();
  std::swap(turned.faces[5][0], turned.faces[5][1]);
  struct Case {
    ControlMesh mesh;
    MeshFault fault;
    std::size_t count;
  };
  for (const Case& c : {Case{turned, MeshFault::kOrientationClash, 3},
                        Case{mesh_of(3, {{0, 1, 2}, {0, 2, 1}}), MeshFault::kLowValence, 3},
                        Case{mesh_of(4, {{0, 1, 2, 3}, {3, 2, 1, 0}}), MeshFault::kLowValence, 4}}) {
    const auto findings = validate(c.mesh);
    ASSERT_EQ(findings.size(), c.count);
    for (const MeshFinding& finding : findings) EXPECT_EQ(finding.fault, c.fault);
  }
}

TEST(Validate, MoreThan32BitIndicesCanNameIsRefused) {
  const std::int64_t most = std::numeric_limits<std::int32_t>::max();
  EXPECT_TRUE(validate_counts(most, most / 3, most).empty());
  EXPECT_EQ(validate_counts(most + 1, 1, 3).at(0).fault, MeshFault::kTooLarge);
  EXPECT_EQ(validate_counts(3, most / 3 + 1, most + 2).at(0).fault, MeshFault::kTooLarge);
}

// Without the two faces that are left out the four others round vertex 0 make two fans: no verdict on those.
TEST(Validate, AFaceLeftOutTakesNoVertexWithItThatWasWhole) {
  const auto findings =
      validate(mesh_of(7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 7}, {0, 4, 5}, {0, 5, 6}, {0, 6, 8}}));
  ASSERT_EQ(findings.size(), 2u);
  for (const MeshFinding& finding : findings) EXPECT_EQ(finding.fault, MeshFault::kIndexOutOfRange);
}

TEST(Validate, TheSameThreeVerticesTwiceAreADuplicateInAnyOrder) {
  constexpr std::array<std::array<int, 3>, 4> orders = {{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}}};
  for (std::int64_t original = 0; original < 4; ++original) {
    for (const auto& order : orders) {
      ControlMesh mesh = tetrahedron();
      const auto t = triangles_of(mesh)[original];
      mesh.faces.push_back({t[order[0]], t[order[1]], t[order[2]]});
      const auto findings = validate(mesh);
      ASSERT_EQ(findings.size(), 1u);
      EXPECT_EQ(findings[0].fault, MeshFault::kDuplicateFace);
      EXPECT_EQ(findings[0].elements, (std::vector<std::int64_t>{original, 4}));
      EXPECT_EQ(findings[0].face, 4);
    }
  }
}

TEST(Validate, EveryIndependentFaultIsReported) {
  // Two tetrahedra apart, a NaN in the one, an extra face on an edge of the other, an isolated vertex.
  ControlMesh mesh = two_components();
  mesh.positions[1][0] = std::nan("");
  const auto before = static_cast<std::int32_t>(mesh.positions.size());
  mesh.positions.push_back({9, 9, 9});
  mesh.positions.push_back({8, 8, 8});
  mesh.faces.push_back({0, 1, before});
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
  const Faces& faces = mesh.faces;
  const auto has = [&](std::size_t f, std::int32_t v) {
    return std::count(faces[f].begin(), faces[f].end(), v) > 0;
  };
  // How many faces run from a to b.
  const auto runs = [&](std::size_t f, std::int32_t a, std::int32_t b) {
    int count = 0;
    for (std::size_t k = 0; k < faces[f].size(); ++k)
      count += faces[f][k] == a && faces[f][(k + 1) % faces[f].size()] == b;
    return count;
  };
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (faces[f].size() < 3) return false;
    for (std::size_t k = 0; k < faces[f].size(); ++k) {
      const std::int32_t a = faces[f][k], b = faces[f][(k + 1) % faces[f].size()];
      if (a < 0 || a >= vertices || std::count(faces[f].begin(), faces[f].end(), a) != 1) return false;
      int along = 0, against = 0;
      for (std::size_t g = 0; g < faces.size(); ++g) along += runs(g, a, b), against += runs(g, b, a);
      if (along != 1 || against > 1) return false;
    }
  }
  for (std::int32_t v = 0; v < vertices; ++v) {
    // The faces at v must be connected through edges at v; if all these have two faces, there are three or
    // more.
    std::vector<std::size_t> at;
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (has(f, v)) at.push_back(f);
    if (at.empty()) return false;
    const auto share_an_edge = [&](std::size_t f, std::size_t g) {
      for (std::int32_t w = 0; w < vertices; ++w)
        if ((runs(f, v, w) > 0 && runs(g, w, v) > 0) || (runs(f, w, v) > 0 && runs(g, v, w) > 0)) return true;
      return false;
    };
    std::vector<bool> in(at.size(), false);
    in[0] = true;
    for (std::size_t round = 0; round < at.size(); ++round)
      for (std::size_t i = 0; i < at.size(); ++i)
        for (std::size_t j = 0; j < at.size(); ++j)
          if (in[i] && !in[j] && share_an_edge(at[i], at[j])) in[j] = true;
    if (std::count(in.begin(), in.end(), false) > 0) return false;
    bool closed = true;
    for (std::int32_t w = 0; w < vertices; ++w) {
      int edges = 0;
      for (const std::size_t f : at) edges += runs(f, v, w) + runs(f, w, v);
      closed = closed && edges != 1;
    }
    if (closed && at.size() < 3) return false;
  }
  return true;
}

// Changes the meshes at random and asks both; most of the changed ones are wrong somewhere.
void expect_agreement(const std::vector<ControlMesh>& starts, int count) {
  SplitMix64 random(7);
  int valid = 0, total = 0;
  for (int i = 0; i < count; ++i) {
    ControlMesh mesh = starts[random.next() % starts.size()];
    for (int change = static_cast<int>(random.next() % 4); change > 0; --change) {
      const auto any_vertex = [&] {
        return static_cast<std::int32_t>(random.next() % mesh.positions.size());
      };
      const std::size_t face = random.next() % mesh.faces.size();
      switch (random.next() % 5) {
        case 0:
          mesh.faces[face][random.next() % mesh.faces[face].size()] = any_vertex();
          break;
        case 1:
          mesh.faces.push_back({any_vertex(), any_vertex(), any_vertex()});
          break;
        case 2:
          if (mesh.faces.size() > 1) {
            Faces fewer;
            for (std::size_t f = 0; f < mesh.faces.size(); ++f)
              if (f != face) fewer.push_back(mesh.faces[f]);
            mesh.faces = fewer;
          }
          break;
        case 3:
          std::swap(mesh.faces[face][0], mesh.faces[face][1]);
          break;
        case 4:
          std::rotate(mesh.faces[face].begin(), mesh.faces[face].begin() + 1, mesh.faces[face].end());
          break;
      }
    }
    const bool expected = valid_by_definition(mesh);
    ASSERT_EQ(validate(mesh).empty(), expected) << "soup " << i;
    valid += expected;
    ++total;
  }
  testing::Test::RecordProperty("valid", valid);
  EXPECT_GT(valid, total / 10);
  EXPECT_LT(valid, total * 9 / 10);
}

TEST(Validate, AgreesWithTheDefinitionsOnRandomTriangleSoups) {
  const std::vector<ControlMesh> starts = {tetrahedron(), octahedron(), wheel(3, 1),  wheel(5, 1),
                                           fan(4, 1),     strip(4),     bipyramid(3), sheet(2, 2)};
  expect_agreement(starts, 20000);
}

TEST(Validate, AgreesWithTheDefinitionsOnRandomPolygonSoups) {
  // The last is two quads that share two edges: their common vertex is inside and has valence 2.
  expect_agreement({quad_cube(), quad_fan(1, 1), quad_fan(3, 1), quad_wheel(3, 1), polygon_prism(3),
                    polygon_prism(5), mesh_of(5, {{0, 1, 2, 3}, {0, 3, 2, 4}})},
                   10000);
}

TEST(Validate, PolygonsAreForCatmullClark) {
  const ControlMesh prism = polygon_prism(5);
  EXPECT_TRUE(validate(prism).empty());
  EXPECT_TRUE(validate(prism, Scheme::kCatmullClark).empty());
  const auto findings = validate(prism, Scheme::kLoop);
  ASSERT_EQ(findings.size(), 7U);
  EXPECT_EQ(findings[0].fault, MeshFault::kPolygon);
  EXPECT_EQ(findings[0].message, "face 0 has 5 corners; Loop's scheme takes triangles only");
  EXPECT_TRUE(validate(tetrahedron(), Scheme::kCatmullClark).empty());
}

TEST(Validate, AHubOfAMillionFacesAndAMillionFacedSheetTakeOnePass) {
  // No time is asserted; a quadratic method would not end. The figures are recorded.
  for (const ControlMesh& mesh : {wheel(1'000'000, 1), bipyramid(500'000), sheet(1000, 500)}) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(validate(mesh).empty());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::cout << mesh.faces.size() << " faces validated in " << seconds.count() << " s\n";
  }
}

TEST(Validate, AMillionFacesOnOneEdgeAreOneFinding) {
  Faces faces;
  for (int i = 0; i < 1'000'000; ++i) faces.push_back({0, 1, 2 + i});
  EXPECT_EQ(validate(mesh_of(1'000'002, faces)).size(), 1u);
}

}  // namespace
}  // namespace limitcheck::data
