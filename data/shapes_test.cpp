// SPDX-License-Identifier: MIT
// Shapes have the faces, valences and boundaries that their descriptions say.
#include "data/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "data/error.h"
#include "data/generators/awkward_meshes.h"
#include "data/generators/polygon_meshes.h"
#include "data/summary.h"
#include "data/test_meshes.h"
#include "data/test_support/known_answers.h"

namespace limitcheck::data {
namespace {

using Counts = std::map<int, std::int64_t>;

std::int64_t faces_at(const ControlMesh& mesh, std::int32_t vertex) {
  return std::count(mesh.faces.corners().begin(), mesh.faces.corners().end(), vertex);
}

// Six times the volume, by fans from the first corners: positive where faces point outwards.
double volume(const ControlMesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    const auto& a = mesh.positions[face[0]];
    for (std::size_t k = 2; k < face.size(); ++k) {
      const auto &b = mesh.positions[face[k - 1]], &c = mesh.positions[face[k]];
      sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
  }
  return sum;
}

TEST(Shapes, ClosedOnesHaveTheirEulerCharacteristicAndPointOutwards) {
  const std::vector<std::pair<ControlMesh, int>> all = {
      {tetrahedron(), 2}, {octahedron(), 2},   {icosahedron(), 2}, {cube(), 2},
      {bipyramid(3), 2},  {bipyramid(200), 2}, {torus(12, 6), 0},  {torus(3, 3), 0}};
  for (const auto& [mesh, characteristic] : all) {
    expect_sound(mesh, std::to_string(mesh.faces.size()));
    EXPECT_EQ(summarise(mesh).boundary_edges, 0);
    EXPECT_EQ(summarise(mesh).euler, characteristic);
    EXPECT_GT(volume(mesh), 0);
  }
}

TEST(Shapes, TheTetrahedronIsTheOneOfTheKnownAnswers) {
  for (const auto& answer : load_known_answers().closed_meshes)
    if (answer.id == "exact_tetrahedron") {
      EXPECT_EQ(control_mesh(answer.vertices, Faces(answer.faces)), tetrahedron());
    }
}

TEST(Shapes, TheHubOfAWheelHasItsValenceAndEverythingElseIsRegular) {
  for (const int n : {3, 4, 5, 6, 7, 12, 50, 200, 1000})
    for (const int rings : {1, 2, 3}) {
      const ControlMesh mesh = wheel(n, rings);
      expect_sound(mesh, "wheel " + std::to_string(n));
      EXPECT_EQ(mesh.faces.size(), static_cast<std::size_t>(n) * rings * rings);
      EXPECT_EQ(faces_at(mesh, 0), n);
      const MeshSummary s = summarise(mesh);
      Counts inside{{6, n * rings * (rings - 1) / 2}};
      if (rings == 1) inside.clear();
      ++inside[n];
      EXPECT_EQ(s.valence, inside) << n << " " << rings;
      EXPECT_EQ(s.boundary_edges, n * rings);
      EXPECT_EQ(s.euler, 1);
    }
}

TEST(Shapes, VertexZeroOfAFanIsOnTheBoundaryWithItsFaces) {
  for (int k = 1; k <= 12; ++k)
    for (const int rings : {1, 2, 3}) {
      const ControlMesh mesh = fan(k, rings);
      expect_sound(mesh, "fan " + std::to_string(k));
      EXPECT_EQ(faces_at(mesh, 0), k);
      const MeshSummary s = summarise(mesh);
      EXPECT_GT(s.boundary_faces.at(k), 0);
      for (const auto& [valence, count] : s.valence) EXPECT_EQ(valence, 6) << k << " " << rings;
      EXPECT_EQ(s.euler, 1);
    }
}

TEST(Shapes, TheRaggedDiscHasBoundaryVerticesOfOneToEightFaces) {
  const ControlMesh mesh = ragged_disc();
  expect_sound(mesh, "ragged disc");
  const MeshSummary s = summarise(mesh);
  std::set<int> faces;
  for (const auto& [count, vertices] : s.boundary_faces) faces.insert(count);
  EXPECT_EQ(faces, (std::set<int>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(faces_at(mesh, 0), 7);
  EXPECT_EQ(s.euler, 1);
}

TEST(Shapes, FlatOnesAreWhatTheySay) {
  EXPECT_EQ(summarise(sheet(5, 3)).euler, 1);
  EXPECT_EQ(sheet(5, 3).faces.size(), 30u);
  EXPECT_EQ(summarise(holes()).euler, -1);  // a disc with two holes
  EXPECT_EQ(summarise(two_components()).euler, 3);
  EXPECT_EQ(triangle().faces.size(), 1u);
  EXPECT_EQ(triangle_pair().faces.size(), 2u);
  for (const int n : {1, 2, 3, 8}) {
    expect_sound(strip(n), "strip");
    EXPECT_EQ(strip(n).faces.size(), static_cast<std::size_t>(n));
    EXPECT_EQ(summarise(strip(n)).boundary_edges, n + 2);
  }
  for (const ControlMesh& mesh :
       {sheet(1, 1), sheet(5, 3), holes(), two_components(), triangle(), triangle_pair()})
    expect_sound(mesh, "flat");
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

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(AwkwardMeshes, AreValidAndExactInFloat) {
  for (const ControlMesh& mesh :
       {handles(1), handles(2), handles(3), three_components(), touching_components(), flat(), needles(),
        far_box(), zero_edge(), stellated(), tiny_box(), huge_box(), crowd(1), crowd(1000)})
    expect_sound(mesh, std::to_string(mesh.faces.size()));
}

TEST(AwkwardMeshes, HandlesHaveTheirGenusAndAreIrregular) {
  for (const int genus : {1, 2, 7}) {
    const ControlMesh mesh = handles(genus);
    const MeshSummary s = summarise(mesh);
    EXPECT_EQ(s.euler, 2 - 2 * genus);
    EXPECT_EQ(s.boundary_edges, 0);
    EXPECT_EQ(s.components, 1);
    EXPECT_GE(s.valence.size(), 4U);
    EXPECT_EQ(mesh.faces.size(), static_cast<std::size_t>(36 * genus + 28));
  }
}

TEST(AwkwardMeshes, HaveTheComponentsThatTheyAreNamedFor) {
  EXPECT_EQ(summarise(three_components()).components, 3);
  const ControlMesh touching = touching_components();
  EXPECT_EQ(summarise(touching).components, 2);
  EXPECT_EQ(summarise(touching).coincident_vertices, 1);
  EXPECT_EQ(summarise(crowd(50)).components, 50);
}

TEST(AwkwardMeshes, HaveTheGeometryThatTheyAreNamedFor) {
  for (const auto& p : flat().positions) EXPECT_EQ(p[2], 0);

  const ControlMesh thin = needles();
  for (const auto& t : triangles_of(thin)) {
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, distance(thin.positions[t[k]], thin.positions[t[(k + 1) % 3]]));
    double width = 0;  // across the long axis
    for (int k = 0; k < 3; ++k)
      width = std::max(width, std::abs(thin.positions[t[k]][1] - thin.positions[t[(k + 1) % 3]][1]));
    EXPECT_GE(longest / width, 1e4);
  }

  const ControlMesh edge = zero_edge();
  EXPECT_EQ(edge.positions[0], edge.positions[1]);
  EXPECT_TRUE(std::any_of(triangles_of(edge).begin(), triangles_of(edge).end(), [](const auto& t) {
    return std::count_if(t.begin(), t.end(), [](std::int32_t v) { return v < 2; }) == 2;
  }));

  EXPECT_NEAR(std::abs(tiny_box().positions[0][0]) / 1e-25, 1, 0.05);
  EXPECT_NEAR(std::abs(huge_box().positions[0][0]) / 1e20, 0.75, 0.05);
  const ControlMesh box = far_box();
  EXPECT_GE(distance(box.positions[0], {}) / distance(box.positions[0], box.positions[7]), 60);
}

TEST(AwkwardMeshes, OfTheStellatedOctahedronMostVerticesHaveValenceThree) {
  EXPECT_EQ(summarise(stellated()).valence, (Counts{{3, 8}, {8, 6}}));
}

using Sizes = std::map<std::size_t, int>;

// Valid, exact in float, and with its counts; `what` names the shape.
void expect(const ControlMesh& mesh, const std::string& what, int euler, const Sizes& sizes,
            const Counts& interior, const Counts& boundary = {}) {
  expect_valid(mesh, what, Scheme::kCatmullClark);
  expect_sound(mesh, what);
  const MeshSummary s = summarise(mesh);
  EXPECT_EQ(s.euler, euler) << what;
  EXPECT_EQ(sizes_of(mesh), sizes) << what;
  EXPECT_EQ(s.valence, interior) << what;
  EXPECT_EQ(s.boundary_faces, boundary) << what;
}

TEST(PolygonMeshes, HaveTheFacesAndValencesThatTheirDescriptionsSay) {
  expect(quad_cube(), "cube", 2, {{4, 6}}, {{3, 8}});
  expect(quad_torus(3, 3), "torus", 0, {{4, 9}}, {{4, 9}});
  expect(quad_torus(12, 6), "torus", 0, {{4, 72}}, {{4, 72}});
  for (const int n : {3, 4, 5, 7, 50}) {
    Counts interior{{4, 2 * n}};
    ++interior[n];
    expect(quad_wheel(n, 1), "wheel " + std::to_string(n), 1, {{4, 4 * n}}, interior, {{1, n}, {2, 3 * n}});
    Sizes sizes{{4, n}};
    sizes[n] += 2;
    expect(polygon_prism(n), "prism " + std::to_string(n), 2, sizes, {{3, 2 * n}});
  }
  expect(quad_fan(1, 1), "fan 1", 1, {{4, 4}}, {{4, 1}}, {{1, 4}, {2, 4}});
  for (const int k : {3, 5, 8}) {
    Counts boundary{{1, k + 2}, {2, 3 * k + 1}};
    ++boundary[k];
    expect(quad_fan(k, 1), "fan " + std::to_string(k), 1, {{4, 4 * k}}, {{4, 2 * k - 1}}, boundary);
  }
}

TEST(PolygonMeshes, PawnsHaveTheirPolesAndPointOutwards) {
  for (const int n : {3, 5, 8, 100}) {
    // Twelve bands of 2n quads, and n at each pole; of the 2n vertices beside a pole n have no edge to it.
    Counts interior{{3, 2 * n}, {4, 24 * n}};
    interior[n] += 2;
    expect(pawn(n), "pawn " + std::to_string(n), 2, {{4, 26 * n}}, interior);
    EXPECT_GT(volume(pawn(n)), 0);

    Sizes sizes{{3, n}, {4, 12 * n}};
    ++sizes[n];
    Counts mixed{{3, n}, {4, 12 * n}};
    ++mixed[n];
    expect(mixed_pawn(n), "mixed pawn " + std::to_string(n), 2, sizes, mixed);
    EXPECT_GT(volume(mixed_pawn(n)), 0);
  }
}

TEST(Dual, ExchangesFacesAndVertices) {
  expect(dual(icosahedron()), "dodecahedron", 2, {{5, 12}}, {{3, 20}});
  expect(dual(quad_cube()), "octahedron", 2, {{3, 8}}, {{4, 6}});
  expect(dual(polygon_prism(7)), "bipyramid", 2, {{3, 14}}, {{4, 7}, {7, 2}});
  expect(dual(torus(12, 6)), "hexagons", 0, {{6, 72}}, {{3, 144}});
  EXPECT_GT(volume(dual(icosahedron())), 0);
  // Twice the dual: the same faces but for where each begins.
  EXPECT_EQ(sizes_of(dual(dual(mixed_pawn(5)))), sizes_of(mixed_pawn(5)));
  EXPECT_THROW(dual(sheet(2, 2)), ArgumentError);
}

// The values were obtained with g++ 12 and with clang 14, optimised and not; other compilers must give the
// same.
TEST(PolygonMeshes, AreTheSameWithEveryCompiler) {
  EXPECT_EQ(hash_of_all(std::vector{quad_cube(), quad_torus(12, 6), quad_wheel(7, 1), quad_wheel(3, 2),
                                    quad_fan(1, 1), quad_fan(6, 3), polygon_prism(5), pawn(8), mixed_pawn(16),
                                    dual(icosahedron()), dual(quad_torus(5, 4))}),
            2870117839980416224u);
  EXPECT_NE(hash(quad_wheel(7, 2)), hash(quad_wheel(7, 1)));
}

}  // namespace
}  // namespace limitcheck::data
