// SPDX-License-Identifier: MIT
#include "data/generators/polygon_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "data/error.h"
#include "data/generators/test_census.h"
#include "data/generators/test_hash.h"
#include "data/shapes.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

using Sizes = std::map<std::size_t, int>;
using Counts = std::map<int, int>;

// Valid, exact in float, and with its counts; `what` names the shape.
void expect(const ControlMesh& mesh, const std::string& what, int euler, const Sizes& sizes,
            const Counts& interior, const Counts& boundary = {}) {
  const auto faults = validate(mesh, Scheme::kCatmullClark);
  EXPECT_TRUE(faults.empty()) << what << ": " << faults[0].message;
  for (const auto& p : mesh.positions)
    for (const double x : p) EXPECT_EQ(x, static_cast<double>(static_cast<float>(x))) << what;
  const Census c = census(mesh);
  EXPECT_EQ(c.euler, euler) << what;
  EXPECT_EQ(c.sizes, sizes) << what;
  EXPECT_EQ(c.interior_valences, interior) << what;
  EXPECT_EQ(c.boundary_faces, boundary) << what;
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
  EXPECT_EQ(census(dual(dual(mixed_pawn(5)))).sizes, census(mixed_pawn(5)).sizes);
  EXPECT_THROW(dual(sheet(2, 2)), ArgumentError);
}

// The values were obtained with g++ 12 and with clang 14, optimised and not; other compilers must give the
// same.
TEST(PolygonMeshes, AreTheSameWithEveryCompiler) {
  std::uint64_t all = 0;
  for (const ControlMesh& mesh :
       {quad_cube(), quad_torus(12, 6), quad_wheel(7, 1), quad_wheel(3, 2), quad_fan(1, 1), quad_fan(6, 3),
        polygon_prism(5), pawn(8), mixed_pawn(16), dual(icosahedron()), dual(quad_torus(5, 4))})
    all = all * 31 + hash(mesh);
  EXPECT_EQ(all, 2870117839980416224u);
  EXPECT_NE(hash(quad_wheel(7, 2)), hash(quad_wheel(7, 1)));
}

TEST(PolygonMeshes, RefuseWhatTheyCannotMake) {
  EXPECT_THROW(quad_torus(2, 5), InputError);
  EXPECT_THROW(quad_torus(100'000, 100'000), InputError);
  EXPECT_THROW(quad_wheel(2, 1), InputError);
  EXPECT_THROW(quad_wheel(2'147'483'647, 1), InputError);
  EXPECT_THROW(quad_fan(0, 1), InputError);
  EXPECT_THROW(polygon_prism(2), InputError);
  EXPECT_THROW(polygon_prism(2'147'483'647), InputError);
  EXPECT_THROW(pawn(2), InputError);
  EXPECT_THROW(pawn(2'147'483'647), InputError);
  EXPECT_THROW(mixed_pawn(-1), InputError);
}

}  // namespace
}  // namespace limitcheck::data
