// SPDX-License-Identifier: MIT
// Bounds and closest points of surfaces with sharp edges and vertices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/splitmix64.h"
#include "verify/projection/closest_point.h"
#include "verify/projection/test_pieces.h"
#include "verify/projection/test_sharp_meshes.h"

namespace limitcheck::verify {
namespace {

FacePoint random_point(data::SplitMix64& random, const Domain& domain) {
  const auto face = static_cast<std::int32_t>(random.next() % domain.face_count());
  const Chart chart = domain.chart();
  double u = random.unit(), v = random.unit();
  if (!chart.is_square() && u + v > 1) u = 1 - u, v = 1 - v;
  FacePoint at{face, Chart::at(u, v)};
  const auto k = static_cast<int>(random.next() % static_cast<std::uint64_t>(chart.corners()));
  switch (random.next() % 5) {
    case 0:
      at.l = chart.clamp(chart.dropped(k, at.l));
      break;
    case 1:
      at.l = chart.corner(k);
      break;
    default:
      break;
  }
  return at;
}

TEST(SharpBound, IsNowhereExceededAndIsNotMuchTooLarge) {
  std::size_t rough = 0, irregular = 0;
  for (const test::SharpMesh& m : test::sharp_meshes()) {
    const LimitSurface surface(m.mesh, m.scheme);
    for (const int depth : {2, 4}) {
      const SurfaceLattice lattice(surface.mesh(), depth, surface.tags());
      double size = 0, worst = 0, most = 0;
      for (const auto& p : m.mesh.positions) size = std::max(size, largest(p));
      const std::size_t step = std::max<std::size_t>(1, lattice.size() / 700);
      for (std::size_t t = 0; t < lattice.size(); t += step) {
        Piece piece = lattice.piece(t);
        rough += piece.rough;
        irregular += piece.irregular >= 0;
        for (int k = 0; k < 3; ++k)
          ASSERT_LE(norm(surface.position({piece.face, piece.at[k]}) - piece.corner[k]), 1e-14 * size)
              << m.name << " piece " << t;
        for (int level = 0; level < 4; ++level) {
          const double is = measured(piece, surface, 5);
          ASSERT_LE(is, piece.deviation + 1e-14 * size)
              << m.name << " depth " << depth << " piece " << t << " level " << level;
          most = std::max(most, is);
          if (piece.deviation > 1e-12 * size && !piece.rough) worst = std::max(worst, is / piece.deviation);
          const auto split = lattice.split(piece, surface);
          piece = split[(t + static_cast<std::size_t>(level)) % 4];
          for (const Piece& other : split)
            if (other.irregular >= 0) piece = other;
        }
      }
      EXPECT_GT(depth == 4 && most > 1e-12 * size ? worst : 1, .1) << m.name;
    }
  }
  EXPECT_GT(irregular, 500U);
  EXPECT_GT(rough, 200U) << "at depth 2 there are sharpnesses left";
}

TEST(SharpProjection, APointOfTheSurfaceIsItsOwnFoot) {
  double worst = 0;
  for (const test::SharpMesh& m : test::sharp_meshes()) {
    const ClosestPoint closest(m.mesh, m.scheme, 1 << 13);
    data::SplitMix64 random(1);
    for (int n = 0; n < 100; ++n) {
      const FacePoint at = random_point(random, closest.domain());
      const Foot foot = closest.closest(closest.at(at, {}).position);
      worst = std::max(worst, foot.distance / closest.diagonal());
      EXPECT_LE(foot.distance, 1e-11 * closest.diagonal())
          << m.name << " face " << at.face << " (" << at.l[1] << ", " << at.l[2] << ")";
    }
  }
  RecordProperty("worst_distance_in_diagonals", std::to_string(worst * 1e15) + "e-15");
}

// Random points near and far, also beyond creases, against all limit points of a deep lattice.
TEST(SharpProjection, NoSampleOfTheSurfaceIsNearerAndNoneIsBelowTheProvedBound) {
  for (const test::SharpMesh& m : test::sharp_meshes()) {
    const ClosestPoint closest(m.mesh, m.scheme, 1 << 11);
    const SurfaceLattice finer(closest.surface().mesh(), closest.lattice().depth() + 1,
                               closest.surface().tags());
    data::SplitMix64 random(4);
    for (int n = 0; n < 15; ++n) {
      Vector p = closest.at(random_point(random, closest.domain()), {}).position;
      const double reach = closest.diagonal() * std::ldexp(1.0, -static_cast<int>(random.next() % 10));
      for (double& x : p) x += reach * (random.unit() - .5);
      const double brute = distance_to_corners(finer, p);
      const Foot foot = closest.closest(p);
      EXPECT_LE(foot.distance, brute + 1e-12 * closest.diagonal()) << m.name << " point " << n;
      EXPECT_GE(brute, foot.at_least) << m.name << " point " << n;
    }
  }
}

TEST(SharpProjection, EdgesThatStaySharpAreCutInTheDomainAndOthersAreNot) {
  for (const bool lasting : {true, false}) {
    const data::ControlMesh mesh = data::creased_cube(lasting ? 10 : 9);
    const LimitSurface surface(mesh, data::Scheme::kCatmullClark);
    const Domain& domain = surface.domain();
    for (std::int32_t f = 0; f < 6; ++f)
      for (int k = 0; k < 4; ++k) {
        EXPECT_EQ(domain.is_cut(f, k), lasting);
        EXPECT_EQ(domain.on_cut({f, domain.chart().corner(k)}), lasting);
      }
    EXPECT_FALSE(domain.on_cut({0, domain.chart().centre()}));
    EXPECT_EQ(domain.walk({0, Chart::at(.5, .5)}, {-1, 1, 0}).face == 0, lasting);
  }
  // Of a mesh with other faces than quads, the halves of the edges.
  data::ControlMesh prism = data::polygon_prism(5);
  prism.sharpness.edges.push_back({prism.faces[0][0], prism.faces[0][1], 10});
  const LimitSurface surface(prism, data::Scheme::kCatmullClark);
  int cut = 0;
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(surface.domain().face_count()); ++f)
    for (int k = 0; k < 4; ++k) {
      cut += surface.domain().is_cut(f, k);
      EXPECT_TRUE(!surface.domain().is_cut(f, k) || surface.on_control_edge(f, k));
    }
  EXPECT_EQ(cut, 4);
}

}  // namespace
}  // namespace limitcheck::verify
