// SPDX-License-Identifier: MIT
#include "data/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "data/error.h"
#include "data/known_answers.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

// What can be counted at a vertex straight from the list of triangles.
struct Counts {
  std::vector<int> faces, neighbours;
  int edges = 0, boundary_edges = 0;

  explicit Counts(const ControlMesh& mesh) : faces(mesh.positions.size()), neighbours(mesh.positions.size()) {
    std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
    for (const auto& t : triangles_of(mesh)) {
      for (int k = 0; k < 3; ++k) {
        ++faces[t[k]];
        ++uses[std::minmax(t[k], t[(k + 1) % 3])];
      }
    }
    for (const auto& [edge, count] : uses) {
      ++neighbours[edge.first];
      ++neighbours[edge.second];
      ++edges;
      boundary_edges += count == 1;
    }
  }
  bool interior(std::size_t v) const { return faces[v] == neighbours[v]; }
};

int euler(const ControlMesh& mesh) {
  return static_cast<int>(mesh.positions.size()) - Counts(mesh).edges + static_cast<int>(mesh.faces.size());
}

void expect_valid(const ControlMesh& mesh, const std::string& name) {
  const auto findings = validate(mesh);
  EXPECT_TRUE(findings.empty()) << name << ": " << findings[0].message;
  for (const auto& p : mesh.positions) {
    for (const double x : p) EXPECT_EQ(x, static_cast<double>(static_cast<float>(x))) << name;
  }
}

TEST(Shapes, ClosedOnesHaveTheirEulerCharacteristicAndPointOutwards) {
  const std::vector<std::pair<ControlMesh, int>> all = {
      {tetrahedron(), 2}, {octahedron(), 2},   {icosahedron(), 2}, {cube(), 2},
      {bipyramid(3), 2},  {bipyramid(200), 2}, {torus(12, 6), 0},  {torus(3, 3), 0}};
  for (const auto& [mesh, characteristic] : all) {
    expect_valid(mesh, std::to_string(mesh.faces.size()));
    EXPECT_EQ(Counts(mesh).boundary_edges, 0);
    EXPECT_EQ(euler(mesh), characteristic);
    double volume = 0;  // six times; positive if the faces are counter-clockwise from outside
    for (const auto& t : triangles_of(mesh)) {
      const auto &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
      volume += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    EXPECT_GT(volume, 0);
  }
}

TEST(Shapes, TheTetrahedronIsTheOneOfTheKnownAnswers) {
  for (const auto& answer : load_known_answers().closed_meshes) {
    if (answer.id != "exact_tetrahedron") continue;
    EXPECT_EQ(control_mesh(answer.vertices, answer.faces).positions, tetrahedron().positions);
    EXPECT_EQ(Faces(answer.faces), tetrahedron().faces);
  }
}

TEST(Shapes, TheHubOfAWheelHasItsValenceAndEverythingElseIsRegular) {
  for (const int n : {3, 4, 5, 6, 7, 12, 50, 200, 1000}) {
    for (const int rings : {1, 2, 3}) {
      const ControlMesh mesh = wheel(n, rings);
      expect_valid(mesh, "wheel " + std::to_string(n));
      EXPECT_EQ(mesh.faces.size(), static_cast<std::size_t>(n) * rings * rings);
      const Counts counts(mesh);
      EXPECT_EQ(counts.neighbours[0], n);
      EXPECT_TRUE(counts.interior(0));
      for (std::size_t v = 1; v < mesh.positions.size(); ++v) {
        if (counts.interior(v)) {
          ASSERT_EQ(counts.neighbours[v], 6) << n << " " << rings << " " << v;
        }
      }
      EXPECT_EQ(counts.boundary_edges, n * rings);
      EXPECT_EQ(euler(mesh), 1);
    }
  }
}

TEST(Shapes, VertexZeroOfAFanIsOnTheBoundaryWithItsFaces) {
  for (int k = 1; k <= 12; ++k) {
    for (const int rings : {1, 2, 3}) {
      const ControlMesh mesh = fan(k, rings);
      expect_valid(mesh, "fan " + std::to_string(k));
      const Counts counts(mesh);
      EXPECT_EQ(counts.faces[0], k);
      EXPECT_EQ(counts.neighbours[0], k + 1);
      for (std::size_t v = 1; v < mesh.positions.size(); ++v) {
        if (counts.interior(v)) {
          ASSERT_EQ(counts.neighbours[v], 6);
        }
      }
      EXPECT_EQ(euler(mesh), 1);
    }
  }
}

TEST(Shapes, TheRaggedDiscHasBoundaryVerticesOfOneToEightFaces) {
  const ControlMesh mesh = ragged_disc();
  expect_valid(mesh, "ragged disc");
  const Counts counts(mesh);
  std::set<int> faces;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (!counts.interior(v)) faces.insert(counts.faces[v]);
  }
  EXPECT_EQ(faces, (std::set<int>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(counts.faces[0], 7);
  EXPECT_EQ(euler(mesh), 1);
}

TEST(Shapes, FlatOnesAreWhatTheySay) {
  EXPECT_EQ(euler(sheet(5, 3)), 1);
  EXPECT_EQ(sheet(5, 3).faces.size(), 30u);
  EXPECT_EQ(euler(holes()), -1);  // a disc with two holes
  EXPECT_EQ(euler(two_components()), 3);
  EXPECT_EQ(triangle().faces.size(), 1u);
  EXPECT_EQ(triangle_pair().faces.size(), 2u);
  for (const int n : {1, 2, 3, 8}) {
    const ControlMesh mesh = strip(n);
    expect_valid(mesh, "strip");
    EXPECT_EQ(mesh.faces.size(), static_cast<std::size_t>(n));
    EXPECT_EQ(Counts(mesh).boundary_edges, n + 2);
  }
  for (const ControlMesh& mesh :
       {sheet(1, 1), sheet(5, 3), holes(), two_components(), triangle(), triangle_pair()}) {
    expect_valid(mesh, "flat");
  }
}

// Seen from above (+z), the side to which the normals of the flat shapes point, no triangle is folded over.
TEST(Shapes, FlatOnesAreNotFoldedOver) {
  for (const ControlMesh& mesh : {wheel(3), wheel(7), wheel(200), fan(1), fan(2), fan(3), fan(8), sheet(4, 4),
                                  strip(7), holes(), ragged_disc()}) {
    for (const auto& t : triangles_of(mesh)) {
      const auto &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
      EXPECT_GT((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0)
          << mesh.faces.size() << " faces: " << t[0] << " " << t[1] << " " << t[2];
    }
  }
}

TEST(Shapes, ParametersOutOfRangeAreRefused) {
  const std::vector<std::function<ControlMesh()>> bad = {[] { return wheel(2); },
                                                         [] { return wheel(5, 0); },
                                                         [] { return wheel(1'000'000, 100); },
                                                         [] { return fan(0); },
                                                         [] { return bipyramid(2); },
                                                         [] { return torus(2, 6); },
                                                         [] { return torus(6, 2); },
                                                         [] { return sheet(0, 1); },
                                                         [] { return sheet(100'000, 100'000); },
                                                         [] { return strip(0); },
                                                         [] { return strip(-1); },
                                                         [] { return torus(2'000'000'000, 2'000'000'000); },
                                                         [] { return fan(5, 2'000'000'000); }};
  for (const auto& make : bad) EXPECT_THROW(make(), InputError);
}

}  // namespace
}  // namespace limitcheck::data
