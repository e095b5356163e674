// SPDX-License-Identifier: MIT
// The bounds of pieces against the surface itself, densely sampled.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reference/catmull_clark/refined_mesh.h"
#include "verify/projection/surface_lattice.h"
#include "verify/projection/test_meshes.h"

namespace limitcheck::verify {
namespace {

// The largest distance of points of a piece from those of the surface with the same parameters.
double measured(const Piece& piece, const LimitSurface& surface, int n) {
  double worst = 0;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const double a = static_cast<double>(i) / n, b = static_cast<double>(j) / n;
      const std::array<double, 3> weight{1 - a - b, a, b};
      worst = std::max(worst, norm(surface.position(piece.parameter(weight)) - piece.flat(weight)));
    }
  return worst;
}

// What was looked at.
struct Seen {
  double share = 0;  // of its bound, the largest distance measured; rough pieces not counted
  double most = 0;   // distance, in sizes of the mesh
  std::size_t irregular = 0, rough = 0;
};

// Pieces of the lattice of a depth, about so many, and pieces that they are split into, towards extraordinary
// vertices if there are any.
Seen expect_within_bounds(const test::TestMesh& m, int depth, std::size_t about) {
  Seen seen;
  const LimitSurface surface(m.mesh, m.scheme);
  const SurfaceLattice lattice(surface.mesh(), depth, surface.tags());
  double size = 0;
  for (const auto& p : m.mesh.positions) size = std::max(size, largest(p));
  const std::size_t step = std::max<std::size_t>(1, lattice.size() / about);
  for (std::size_t t = 0; t < lattice.size(); t += step) {
    Piece piece = lattice.piece(t);
    seen.rough += piece.rough;
    seen.irregular += piece.irregular >= 0;
    for (int k = 0; k < 3; ++k)
      EXPECT_LE(norm(surface.position({piece.face, piece.at[k]}) - piece.corner[k]), 1e-14 * size)
          << m.name << " piece " << t;
    for (int level = 0; level < 4; ++level) {
      const double is = measured(piece, surface, 6);
      EXPECT_LE(is, piece.deviation + 1e-14 * size)
          << m.name << " depth " << depth << " piece " << t << " level " << level;
      seen.most = std::max(seen.most, is / size);
      if (piece.deviation > 1e-12 * size && !piece.rough)
        seen.share = std::max(seen.share, is / piece.deviation);
      const auto split = lattice.split(piece, surface);
      piece = split[(t + static_cast<std::size_t>(level)) % 4];
      for (const Piece& other : split)
        if (other.irregular >= 0) piece = other;
    }
  }
  return seen;
}

TEST(Bounds, AreNowhereExceededWithoutSharpEdgesAndAreNotMuchTooLarge) {
  for (const auto& meshes : {test::loop_meshes(), test::quad_meshes()}) {
    Seen all;
    for (const test::TestMesh& m : meshes) {
      const Seen seen = expect_within_bounds(m, 2, m.scheme == data::Scheme::kLoop ? 1 << 20 : 4000);
      all.share = std::max(all.share, seen.share);
      all.irregular += seen.irregular;
    }
    RecordProperty(meshes[0].name + "_largest_share_of_the_bound", std::to_string(all.share));
    EXPECT_GT(all.share, .5);
    EXPECT_GT(all.irregular, 500U);
  }
}

TEST(Bounds, AreNowhereExceededWithSharpEdgesAndAreNotMuchTooLarge) {
  std::size_t rough = 0, irregular = 0;
  for (const test::TestMesh& m : test::sharp_meshes())
    for (const int depth : {2, 4}) {
      const Seen seen = expect_within_bounds(m, depth, 700);
      rough += seen.rough, irregular += seen.irregular;
      EXPECT_GT(depth == 4 && seen.most > 1e-12 ? seen.share : 1, .1) << m.name;
    }
  EXPECT_GT(irregular, 500U);
  EXPECT_GT(rough, 200U) << "at depth 2 there are sharpnesses left";
}

// A lattice of n x n squares, its points as `point` says, as quads or as triangles cut along a - c.
template <class Place>
data::ControlMesh lattice_of(int n, bool quads, Place place) {
  data::ControlMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.positions.push_back(place(i, j));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
      if (quads) {
        mesh.faces.push_back({a, b, c, d});
      } else {
        mesh.faces.push_back({a, b, d});
        mesh.faces.push_back({b, c, d});
      }
    }
  return mesh;
}

std::optional<double> bound_of_quad(const data::ControlMesh& mesh, std::size_t face, int turn) {
  const reference::Topology topology(mesh.positions.size(), mesh.faces);
  Quad quad{};
  for (int k = 0; k < 4; ++k) quad[k] = mesh.faces[face][(k + turn) % 4];
  return regular_bound(topology, reference::positions_of<double>(mesh), quad);
}

// A quadratic surface is where the bounds for regular pieces are sharp. z = (x^2 + x y + y^2) / 16 on the lattice e1
// = (1, 0), e2 = (0, 1) has the second difference 2/16 along all three edges of a triangle; itself it is off its
// chord plane by 1/2 * 3 * (1/9) * 2/16 at the centroid. Mixed differences are 1/16, and along the diagonal of a
// quad it is 3 t^2 / 16, which is 3/4/16 off its chord.
TEST(Bounds, AreSharpForAQuadratic) {
  const auto place = [](int i, int j) {
    return std::array<double, 3>{double(i), double(j), double(i * i + i * j + j * j) / 16};
  };
  const data::ControlMesh triangles = lattice_of(8, false, place), quads = lattice_of(6, true, place);
  const reference::RefinedMesh<double> refined(triangles);
  const auto bound =
      regular_bound(refined.topology(), refined.positions(), triangles_of(triangles)[2 * (3 * 8 + 3)]);
  ASSERT_TRUE(bound.has_value());
  EXPECT_NEAR(*bound, 2. / 16 / 6, 1e-15);
  EXPECT_NEAR(*bound, .5 * 3 / 9 * 2 / 16, 1e-15);
  for (int turn = 0; turn < 4; ++turn)
    EXPECT_NEAR(bound_of_quad(quads, 2 * 6 + 3, turn).value(), .75 / 16, 1e-15);
}

// Up to the boundary, where a ghost beyond it is the mirror image. The corners of the sheet are not regular.
TEST(Bounds, AreZeroOfAFlatSheetOfParallelograms) {
  const int n = 4;
  const data::ControlMesh sheet = lattice_of(n, true, [](int i, int j) {
    return std::array<double, 3>{double(i), double(i + j), double(i - 2 * j)};
  });
  int regular = 0;
  for (std::size_t f = 0; f < sheet.faces.size(); ++f)
    for (int turn = 0; turn < 4; ++turn)
      if (const auto bound = bound_of_quad(sheet, f, turn)) {
        ++regular;
        EXPECT_EQ(*bound, 0) << "quad " << f << " from corner " << turn;
      }
  EXPECT_EQ(regular, 4 * (n * n - 4));
}

TEST(Bounds, FallWithEveryDepth) {
  const auto falls = [](const data::ControlMesh& mesh) {
    return SurfaceLattice(mesh, 4).largest_deviation() / SurfaceLattice(mesh, 3).largest_deviation();
  };
  EXPECT_LT(falls(data::icosahedron()), .5);
  EXPECT_LT(falls(data::quad_torus(5, 4)), .3) << "regular: to a quarter";
  EXPECT_LT(falls(data::quad_cube()), .6);
}

}  // namespace
}  // namespace limitcheck::verify
