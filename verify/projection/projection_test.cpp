// SPDX-License-Identifier: MIT
// The closest point against points whose foot is known, and against brute force: of Loop's and Catmull-Clark's
// surfaces, and of those with sharp edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/splitmix64.h"
#include "reference/surface/surface.h"
#include "verify/projection/closest_point.h"
#include "verify/projection/test_meshes.h"

namespace limitcheck::verify {
namespace {

using test::TestMesh;

// Inside faces, next to their sides, on sides, and on and next to corners.
FacePoint random_point(data::SplitMix64& random, const Domain& domain) {
  const Chart chart = domain.chart();
  FacePoint p{static_cast<std::int32_t>(random.next() % domain.face_count()), {}};
  double u = random.unit(), v = random.unit();
  if (!chart.is_square() && u + v > 1) u = 1 - u, v = 1 - v;
  p.l = Chart::at(u, v);
  const auto k = static_cast<int>(random.next() % static_cast<std::uint64_t>(chart.corners()));
  const auto toward = [&](const Chart::Affine& to, double rest) {
    for (int i = 0; i < 3; ++i) p.l[i] = to[i] + rest * (p.l[i] - to[i]);
  };
  switch (random.next() % 6) {
    case 0:
      p.l = chart.dropped(k, p.l);
      break;
    case 1:
      toward(chart.dropped(k, p.l), 1e-9);
      break;
    case 2:
      p.l = chart.corner(k);
      break;
    case 3:
      toward(chart.corner(k), 1e-6);
      break;
    default:
      break;
  }
  p.l = chart.clamp(p.l);
  return p;
}

std::string text(const FacePoint& p) {
  return std::to_string(p.face) + " (" + std::to_string(p.l[1]) + ", " + std::to_string(p.l[2]) + ")";
}

// The distance of p from the nearest corner of a piece; that from the surface is no larger.
double distance_to_corners(const SurfaceLattice& lattice, const Vector& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < lattice.size(); ++t)
    for (const Vector& s : lattice.corners(t)) least = std::min(least, norm(p - s));
  return least;
}

// Whether the corner next to a point is the only face's there, on the boundary.
bool beside_a_lonely_corner(const Domain& domain, const FacePoint& at) {
  for (int k = 0; k < domain.chart().corners(); ++k)
    if (domain.chart().is_near(k, at.l)) return domain.faces_at(domain.vertex(at.face, k)).size() == 1;
  return false;
}

struct Kind {
  const char* name;
  std::vector<TestMesh> (*meshes)();
  int own, near;  // so many points of a surface, and near it, are looked at
};
class Surfaces : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Projection, Surfaces,
                         testing::Values(Kind{"Loop", test::loop_meshes, 300, 40},
                                         Kind{"CatmullClark", test::quad_meshes, 300, 25},
                                         Kind{"Sharp", test::sharp_meshes, 100, 15}),
                         [](const auto& kind) { return std::string(kind.param.name); });

// But for rounding. Next to the corner of a boundary face without neighbours, where d1 and d2 become parallel, and on
// sharp edges, more.
TEST_P(Surfaces, APointOfTheSurfaceIsItsOwnFoot) {
  double worst = 0, worst_lonely = 0;
  for (const TestMesh& m : GetParam().meshes()) {
    const ClosestPoint closest(m.mesh, m.scheme, 1 << 14);
    data::SplitMix64 random(1);
    for (int n = 0; n < GetParam().own; ++n) {
      const FacePoint at = random_point(random, closest.domain());
      const Foot foot = closest.closest(closest.at(at, {}).position);
      const bool lonely = beside_a_lonely_corner(closest.domain(), at) || !m.mesh.sharpness.empty();
      double& most = lonely ? worst_lonely : worst;
      most = std::max(most, foot.distance / closest.diagonal());
      EXPECT_LE(foot.distance, (lonely ? 1e-11 : 1e-15) * closest.diagonal())
          << m.name << " face " << text(at) << " became " << text(foot.at);
    }
  }
  RecordProperty("worst_distance_in_diagonals", std::to_string(worst * 1e16) + "e-16");
  RecordProperty("worst_at_lonely_corners_and_sharp", std::to_string(worst_lonely * 1e12) + "e-12");
}

// Random points near and far, also beyond creases, against all limit points of a deep lattice.
TEST_P(Surfaces, HaveNoSampleThatIsNearerAndNoneBelowTheProvedBound) {
  int gaps = 0;
  for (const TestMesh& m : GetParam().meshes()) {
    const ClosestPoint closest(m.mesh, m.scheme, 1 << 11);
    const SurfaceLattice finer(closest.surface().mesh(), closest.lattice().depth() + 1,
                               closest.surface().tags());
    const double deviation = test::largest_deviation(closest.lattice());
    data::SplitMix64 random(4);
    for (int n = 0; n < GetParam().near; ++n) {
      Vector p = closest.at(random_point(random, closest.domain()), {}).position;
      const double reach = closest.diagonal() * std::ldexp(1.0, -static_cast<int>(random.next() % 10));
      for (double& x : p) x += reach * (random.unit() - .5);
      const double brute = distance_to_corners(finer, p);
      const Foot foot = closest.closest(p);
      EXPECT_LE(foot.distance, brute + 1e-12 * closest.diagonal()) << m.name << " point " << n;
      EXPECT_GE(brute, foot.at_least) << m.name << " point " << n;
      EXPECT_LE(foot.at_least, foot.distance) << m.name;
      EXPECT_NEAR(foot.distance, norm(foot.position - p), 1e-15 * closest.diagonal());
      gaps += m.mesh.sharpness.empty() && foot.distance - foot.at_least > 2 * deviation;
    }
  }
  EXPECT_EQ(gaps, 0);
}

// On an embedded surface the parameter is unique: that of the point it was made from.
TEST(Projection, TheParameterOfAPointOfTheSurfaceIsRecovered) {
  double worst = 0;
  for (const TestMesh& m :
       test::meshes_named({"bumpy:200", "icosahedron", "wheel:7", "quad-cube", "quad-wheel:7", "prism:5"})) {
    const ClosestPoint closest(m.mesh, m.scheme, 1 << 14);
    data::SplitMix64 random(2);
    for (int n = 0; n < 500; ++n) {
      FacePoint at = random_point(random, closest.domain());
      // Away from sides, which two faces have.
      const Chart::Affine centre = closest.domain().chart().centre();
      for (int k = 0; k < 3; ++k) at.l[k] += .03 * (centre[k] - at.l[k]);
      const Foot foot = closest.closest(closest.at(at, {}).position);
      ASSERT_EQ(foot.at.face, at.face) << m.name;
      for (int k = 0; k < 3; ++k) worst = std::max(worst, std::abs(foot.at.l[k] - at.l[k]));
    }
  }
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
  EXPECT_LE(worst, 1e-12);
}

// Offset by less than half of the radii of curvature, and by less than half of the distance to any other part
// of the surface (a thousandth of the size, on these). At vertices of valence 4 and 5, and on a regular mesh, the
// curvature has a bound.
TEST(Projection, ThePointItWasOffsetFromIsTheFoot) {
  double worst = 0;
  for (const TestMesh& m : test::meshes_named({"icosahedron", "octahedron", "quad-torus:8:6"})) {
    const ClosestPoint closest(m.mesh, m.scheme, 1 << 14);
    data::SplitMix64 random(3);
    for (int n = 0; n < 600; ++n) {
      const Foot truth = closest.at(random_point(random, closest.domain()), {});
      const double by = (n % 2 == 0 ? 1 : -1) * 1e-3 * closest.diagonal();
      const Foot foot = closest.closest(truth.position + by * truth.normal);
      worst = std::max(worst, norm(foot.position - truth.position) / closest.diagonal());
      EXPECT_LE(foot.distance, std::abs(by) * (1 + 1e-12)) << m.name;
      EXPECT_TRUE(foot.stationary) << m.name;
    }
  }
  EXPECT_LE(worst, 1e-9);
  RecordProperty("worst_in_diagonals", std::to_string(worst * 1e12) + "e-12");
}

// The names of reports mean points of the control mesh as the reference takes them, and lead back.
TEST(Projection, APointHasTheSamePlaceInTheDomainAndOnTheControlMesh) {
  for (const TestMesh& m : test::quad_meshes()) {
    const LimitSurface surface(m.mesh, m.scheme);
    const reference::Surface reference(m.mesh, m.scheme);
    const Domain& domain = surface.domain();
    data::SplitMix64 random(1);
    for (int n = 0; n < 200; ++n) {
      const FacePoint at = random_point(random, domain);
      const auto named = surface.control_point(at);
      const Vector there = vector_of(
          reference.evaluate(named.face, std::max(named.corner, 0), named.first, named.second).position);
      EXPECT_LE(norm(surface.position(at) - there), 1e-14) << m.name;
      EXPECT_LE(norm(surface.position(surface.at(named)) - there), 1e-14) << m.name;
      EXPECT_EQ(surface.control_face(at.face), named.face);
    }
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(m.mesh.faces.size()); ++f)
      for (int k = 0; k < static_cast<int>(m.mesh.faces[f].size()); ++k) {
        const FacePoint corner = surface.control_corner(f, k);
        EXPECT_EQ(domain.vertex(corner.face, domain.chart().corner_at(corner.l)), m.mesh.faces[f][k]);
      }
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(domain.face_count()); ++f)
      for (int k = 0; k < 4; ++k) {
        const std::int32_t next = domain.across(f, k);
        const bool same = next >= 0 && surface.control_face(next) == surface.control_face(f);
        EXPECT_EQ(surface.on_control_edge(f, k), !same) << m.name << " face " << f << " side " << k;
      }
  }
}

TEST(Projection, EdgesThatStaySharpAreCutInTheDomainAndOthersAreNot) {
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
