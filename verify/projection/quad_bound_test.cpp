// SPDX-License-Identifier: MIT
// The bounds of Catmull-Clark's pieces against the surface itself, densely sampled.
#include "verify/projection/quad_bound.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/catmull_clark/refined_mesh.h"
#include "verify/projection/surface_lattice.h"
#include "verify/projection/test_pieces.h"
#include "verify/projection/test_quad_meshes.h"

namespace limitcheck::verify {
namespace {

TEST(QuadBound, IsNowhereExceededOnMeshesOfPolygonsAndTheirSplitPieces) {
  double worst = 0;
  std::size_t irregular = 0;
  for (const test::QuadMesh& m : test::quad_meshes()) {
    const LimitSurface surface(m.mesh, data::Scheme::kCatmullClark);
    const SurfaceLattice lattice(surface.mesh(), 2);
    double size = 0;
    for (const auto& p : m.mesh.positions) size = std::max(size, largest(p));
    const std::size_t step = lattice.size() > 4000 ? 5 : 1;
    for (std::size_t t = 0; t < lattice.size(); t += step) {
      Piece piece = lattice.piece(t);
      irregular += piece.irregular >= 0;
      for (int level = 0; level < 4; ++level) {
        const double is = measured(piece, surface, 6);
        ASSERT_LE(is, piece.deviation + 1e-14 * size) << m.name << " piece " << t << " level " << level;
        if (piece.deviation > 1e-12 * size) worst = std::max(worst, is / piece.deviation);
        const auto split = lattice.split(piece, surface);
        piece = split[(t + static_cast<std::size_t>(level)) % 4];
        for (const Piece& other : split)
          if (other.irregular >= 0) piece = other;  // towards the extraordinary vertex
      }
    }
  }
  RecordProperty("largest_share_of_the_bound", std::to_string(worst));
  EXPECT_GT(irregular, 500U);
  EXPECT_GT(worst, .5) << "the bound is not much too large either";
}

// A quadratic surface is where the bound for regular quads is sharp: z = (x^2 + x y + y^2) / 16 has second
// differences of 2/16, mixed ones of 1/16, and along the diagonal 3 t^2 / 16, which is 3/4/16 off its chord.
TEST(QuadBound, IsSharpForAQuadratic) {
  std::vector<reference::Vec3<double>> positions;
  data::Faces faces;
  const int n = 6;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      positions.push_back({double(i), double(j), double(i * i + i * j + j * j) / 16});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      faces.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  const reference::Topology topology(positions.size(), faces);
  for (int turn = 0; turn < 4; ++turn) {
    Quad quad{};
    for (int k = 0; k < 4; ++k) quad[k] = std::as_const(faces)[2 * n + 3][(k + turn) % 4];
    const auto bound = regular_bound(topology, positions, quad);
    ASSERT_TRUE(bound.has_value());
    EXPECT_NEAR(*bound, .75 / 16, 1e-15);
  }
}

// Up to the boundary, where a ghost beyond it is the mirror image. The corners of the sheet are not regular.
TEST(QuadBound, IsZeroOfAFlatSheetOfParallelograms) {
  std::vector<reference::Vec3<double>> positions;
  data::Faces faces;
  const int n = 4;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) positions.push_back({double(i), double(i + j), double(i - 2 * j)});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      faces.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  const reference::Topology topology(positions.size(), faces);
  int regular = 0;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int turn = 0; turn < 4; ++turn) {
      Quad quad{};
      for (int k = 0; k < 4; ++k) quad[k] = std::as_const(faces)[f][(k + turn) % 4];
      const auto bound = regular_bound(topology, positions, quad);
      if (!bound) continue;
      ++regular;
      EXPECT_EQ(*bound, 0) << "quad " << f << " from corner " << turn;
    }
  EXPECT_EQ(regular, 4 * (n * n - 4));
}

TEST(QuadBound, FallsWithEveryDepth) {
  const data::ControlMesh mesh = data::quad_torus(5, 4);
  const double coarse = SurfaceLattice(mesh, 3).largest_deviation();
  EXPECT_LT(SurfaceLattice(mesh, 4).largest_deviation(), .3 * coarse) << "regular: to a quarter";
  const data::ControlMesh cube = data::quad_cube();
  EXPECT_LT(SurfaceLattice(cube, 4).largest_deviation(), .6 * SurfaceLattice(cube, 3).largest_deviation());
}

}  // namespace
}  // namespace limitcheck::verify
