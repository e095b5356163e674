// SPDX-License-Identifier: MIT
// The bounds of pieces against the surface itself, densely sampled.
// Evaluation on the domain, near vertices of very many faces too, against that on the control mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "data/generators/named_mesh.h"
#include "data/shapes.h"
#include "data/splitmix64.h"
#include "reference/catmull_clark/recursion.h"
#include "verify/evidence/vector.h"
#include "verify/projection/domain.h"
#include "verify/projection/limit_surface.h"
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
  return regular_bound(topology, reference::positions_of<double>(mesh), face, static_cast<std::size_t>(turn));
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
  const auto bound = regular_bound(refined.topology(), refined.positions(), 2 * (3 * 8 + 3));
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
    return test::largest_deviation(SurfaceLattice(mesh, 4)) /
           test::largest_deviation(SurfaceLattice(mesh, 3));
  };
  EXPECT_LT(falls(data::icosahedron()), .5);
  EXPECT_LT(falls(data::quad_torus(5, 4)), .3) << "regular: to a quarter";
  EXPECT_LT(falls(data::quad_cube()), .6);
}

// Two faces side by side in the plane: the triangles of the unit square, or two unit squares. Either may begin at any of
// its corners. Vertex 0 is the first one's alone.
data::ControlMesh two_faces(bool squares, int first, int second) {
  std::vector<std::int32_t> left{0, 1, 2}, right{1, 3, 2};
  data::ControlMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {}};
  if (squares) {
    left = {0, 1, 3, 2}, right = {1, 4, 5, 3};
    mesh.positions.insert(mesh.positions.end(), {{2, 0, 0}, {2, 1, 0}});
  }
  std::rotate(left.begin(), left.begin() + first, left.end());
  std::rotate(right.begin(), right.begin() + second, right.end());
  mesh.faces.push_back(left);
  mesh.faces.push_back(right);
  return mesh;
}

// Where a point lies in that plane: from the first corner of its face, along its first side and its last.
Vector in_the_plane(const data::ControlMesh& mesh, const FacePoint& p) {
  const auto face = mesh.faces[p.face];
  const Vector o = mesh.positions[face[0]], x = mesh.positions[face[1]], y = mesh.positions[face.back()];
  return o + p.l[1] * (x - o) + p.l[2] * (y - o);
}
FacePoint from_the_plane(const data::ControlMesh& mesh, std::int32_t f, const Vector& p) {
  const auto face = mesh.faces[f];
  const Vector o = mesh.positions[face[0]], a = mesh.positions[face[1]] - o,
               b = mesh.positions[face.back()] - o;
  const Vector q = p - o;  // a and b span the area 1
  return {f, Chart::at(q[0] * b[1] - q[1] * b[0], a[0] * q[1] - a[1] * q[0])};
}

template <class Test>
void for_two_faces(Test&& test) {
  for (const bool squares : {false, true})
    for (int first = 0; first < (squares ? 4 : 3); ++first)
      for (int second = 0; second < (squares ? 4 : 3); ++second) {
        SCOPED_TRACE(testing::Message() << (squares ? "squares " : "triangles ") << first << ' ' << second);
        test(two_faces(squares, first, second), squares);
      }
}

// In the plane a walk is straight, and ends at the boundary.
TEST(Domain, AFaceIsLeftAcrossTheCommonSideIntoOneThatBeginsAnywhere) {
  for_two_faces([](const data::ControlMesh& mesh, bool squares) {
    const Domain d(mesh);
    int side = -1;
    for (int k = 0; k < d.chart().corners(); ++k)
      if (d.vertex(0, d.chart().first(k)) == 1)
        side = k;
      else
        EXPECT_EQ(d.across(0, k), -1);
    ASSERT_EQ(d.across(0, side), 1);
    EXPECT_EQ(d.across(1, d.side_across(0, side)), 0);
    EXPECT_EQ(d.faces_at(1).size(), 2U);
    EXPECT_EQ(d.faces_at(0).size(), 1U);
    const Vector from = squares ? Vector{.5, .25, 0} : Vector{.25, .25, 0};
    const Vector to = squares ? Vector{1.75, .875, 0} : Vector{.75, .4375, 0};
    const FacePoint start = from_the_plane(mesh, 0, from), far = from_the_plane(mesh, 0, to);
    const auto walk = [&](const FacePoint& end) {
      return d.walk(start, {end.l[0] - start.l[0], end.l[1] - start.l[1], end.l[2] - start.l[2]});
    };
    EXPECT_EQ(walk(far).face, 1);
    EXPECT_LE(norm(in_the_plane(mesh, walk(far)) - to), 1e-15);
    EXPECT_LE(norm(in_the_plane(mesh, {1, d.unfolded(0, side, far.l)}) - to), 1e-15);
    const FacePoint stopped = walk(from_the_plane(mesh, 0, {from[0], -3, 0}));
    EXPECT_EQ(stopped.face, 0);
    EXPECT_EQ(in_the_plane(mesh, stopped), (Vector{from[0], 0, 0}));
  });
}

TEST(Domain, APointOfACommonSideOrCornerHasANameInBothFaces) {
  for_two_faces([](const data::ControlMesh& mesh, bool squares) {
    const Domain d(mesh);
    FacePoint there;
    const Vector inside = squares ? Vector{1, .25, 0} : Vector{.25, .75, 0};
    for (const Vector& p : {inside, Vector{1, 0, 0}, squares ? Vector{1, 1, 0} : Vector{0, 1, 0}}) {
      ASSERT_TRUE(d.express(from_the_plane(mesh, 0, p), 1, there));
      EXPECT_EQ(in_the_plane(mesh, there), p);
    }
    for (const Vector& p : {.75 * inside, Vector{0, 0, 0}, Vector{.5, 0, 0}})
      EXPECT_FALSE(d.express(from_the_plane(mesh, 0, p), 1, there));
  });
}

TEST(LimitSurface, HasThePointsAndDerivativesOfTheControlMesh) {
  double worst = 0, worst_first = 0, worst_second = 0;
  int near = 0;
  for (const char* name :
       {"bipyramid:50", "wheel:60", "fan:50", "quad-wheel:50", "quad-fan:45", "prism:60"}) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const data::Scheme scheme = data::natural_scheme(mesh);
    const LimitSurface surface(mesh, scheme);
    const reference::Surface whole(mesh, scheme);
    data::SplitMix64 random(1);
    for (int n = 0; n < 3000; ++n) {
      const auto face = static_cast<std::int32_t>(random.next() % surface.domain().face_count());
      const Chart chart = surface.domain().chart();
      double u = random.unit(), v = random.unit();
      if (!chart.is_square() && u + v > 1) u = 1 - u, v = 1 - v;
      Chart::Affine at = Chart::at(u, v);
      const auto k = static_cast<int>(random.next() % static_cast<std::uint64_t>(chart.corners()));
      const double shrink = std::ldexp(1.0, -static_cast<int>(random.next() % 18));
      for (int i = 0; i < 3; ++i) at[i] = chart.corner(k)[i] + shrink * (at[i] - chart.corner(k)[i]);
      at = chart.clamp(at);
      const auto named = surface.control_point({face, at});
      const double half = named.corner < 0 && !surface.has_control_faces() ? .5 : 1;
      const auto is = surface.evaluate({face, at}, reference::Order::kSecond);
      const auto want = whole.evaluate(named.face, std::max(named.corner, 0), named.first, named.second);
      const auto apart = [](const auto& a, const auto& b) {
        return norm(vector_of(a) - vector_of(b)) / std::max(1e-3, norm(vector_of(b)));
      };
      near += shrink < .1;
      worst = std::max(worst, norm(vector_of(is.position) - vector_of(want.position)));
      worst_first = std::max({worst_first, apart(is.d1, want.d1 * half), apart(is.d2, want.d2 * half)});
      if (shrink > .01)  // they grow like 4^steps, and their rounding too
        worst_second =
            std::max({worst_second, apart(is.d11, want.d11 * (half * half)),
                      apart(is.d12, want.d12 * (half * half)), apart(is.d22, want.d22 * (half * half))});
    }
  }
  EXPECT_GT(near, 1000);
  RecordProperty("worst_position", std::to_string(worst * 1e16) + "e-16");
  RecordProperty("worst_first_derivative", std::to_string(worst_first * 1e12) + "e-12");
  RecordProperty("worst_second_derivative", std::to_string(worst_second * 1e12) + "e-12");
  EXPECT_LE(worst, 1e-13);
  EXPECT_LE(worst_first, 1e-8);
  EXPECT_LE(worst_second, 1e-6);
}

}  // namespace
}  // namespace limitcheck::verify
