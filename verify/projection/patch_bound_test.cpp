// SPDX-License-Identifier: MIT
// The bounds against the surface itself, densely sampled.
#include <gtest/gtest.h>

#include <cmath>

#include "data/generators/named_mesh.h"
#include "verify/projection/surface_lattice.h"
#include "verify/projection/test_pieces.h"

namespace limitcheck::verify {
namespace {

TEST(PatchBound, IsNowhereExceededOnTheStockShapesAndTheirSplitPieces) {
  std::vector<std::string> shapes = data::stock_shapes();
  shapes.insert(shapes.end(), {"bumpy:20", "wheel:17", "fan:1", "fan:2", "fan:9"});
  double worst = 0;
  for (const std::string& name : shapes) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const LimitSurface surface(mesh, data::Scheme::kLoop);
    const SurfaceLattice lattice(mesh, 2);
    double size = 0;
    for (const auto& p : mesh.positions) size = std::max(size, largest(p));
    for (std::size_t t = 0; t < lattice.size(); ++t) {
      Piece piece = lattice.piece(t);
      for (int level = 0; level < 3; ++level) {
        const double is = measured(piece, surface, 6);
        ASSERT_LE(is, piece.deviation + 1e-14 * size) << name << " piece " << t << " level " << level;
        if (piece.deviation > 1e-12 * size) worst = std::max(worst, is / piece.deviation);
        const auto split = lattice.split(piece, surface);
        piece = split[(t + static_cast<std::size_t>(level)) % 4];
        for (const Piece& other : split)
          if (other.irregular >= 0) piece = other;  // towards the extraordinary vertex
      }
    }
  }
  RecordProperty("largest_share_of_the_bound", std::to_string(worst));
  EXPECT_GT(worst, .5) << "the bound is not much too large either";
}

// A quadratic surface is where the bound for regular pieces is sharp: z = x^2 + x y + y^2 on the lattice e1 =
// (1, 0), e2 = (0, 1) has the same second difference along all three edges.
TEST(PatchBound, IsSharpForAQuadratic) {
  data::ControlMesh mesh;
  const int n = 8;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.positions.push_back({double(i), double(j), double(i * i + i * j + j * j) / 16});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      mesh.faces.push_back({a, a + 1, a + n + 1});
      mesh.faces.push_back({a + 1, a + n + 2, a + n + 1});
    }
  const reference::RefinedMesh<double> refined(mesh);
  const auto bound =
      regular_bound(refined.topology(), refined.positions(), triangles_of(mesh)[2 * (3 * n + 3)]);
  ASSERT_TRUE(bound.has_value());
  EXPECT_NEAR(*bound, 2. / 16 / 6, 1e-15);  // second difference 2 / 16
  // The quadratic itself against its chord plane at the centroid: 1/2 * 3 * (1/9) * 2/16.
  EXPECT_NEAR(*bound, .5 * 3 / 9 * 2 / 16, 1e-15);
}

TEST(PatchBound, FallsToAQuarterWithEveryDepthOnRegularPieces) {
  const data::ControlMesh mesh = data::named_mesh("icosahedron");
  const double coarse = SurfaceLattice(mesh, 3).largest_deviation();
  const double fine = SurfaceLattice(mesh, 4).largest_deviation();
  EXPECT_LT(fine, coarse / 2);
}

}  // namespace
}  // namespace limitcheck::verify
