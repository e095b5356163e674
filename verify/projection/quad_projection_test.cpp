// SPDX-License-Identifier: MIT
// The closest point of Catmull-Clark's surfaces against points whose foot is known, and against brute force.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "data/splitmix64.h"
#include "reference/surface/surface.h"
#include "verify/projection/closest_point.h"
#include "verify/projection/test_pieces.h"
#include "verify/projection/test_quad_meshes.h"

namespace limitcheck::verify {
namespace {

constexpr auto kCatmullClark = data::Scheme::kCatmullClark;

// Inside faces, next to their sides, on sides, and on corners.
FacePoint random_point(data::SplitMix64& random, std::size_t faces) {
  const auto face = static_cast<std::int32_t>(random.next() % faces);
  std::array<double, 2> at{random.unit(), random.unit()};
  const double nearest = random.next() % 2 == 0 ? 0 : 1;
  switch (random.next() % 6) {
    case 0:
      at[random.next() % 2] = nearest;
      break;
    case 1:
      at[random.next() % 2] = std::abs(nearest - 1e-9 * random.unit());
      break;
    case 2:
      at = {nearest, random.next() % 2 == 0 ? 0. : 1.};
      break;
    case 3:
      at = {std::abs(nearest - 1e-6), std::abs(nearest - 1e-6)};
      break;
    default:
      break;
  }
  return {face, Chart::at(at[0], at[1])};
}

// The names of reports mean points of the control mesh as the reference takes them, and lead back.
TEST(QuadProjection, APointHasTheSamePlaceInTheDomainAndOnTheControlMesh) {
  for (const test::QuadMesh& m : test::quad_meshes()) {
    const LimitSurface surface(m.mesh, kCatmullClark);
    const reference::Surface reference(m.mesh, kCatmullClark);
    data::SplitMix64 random(1);
    for (int n = 0; n < 200; ++n) {
      const FacePoint at = random_point(random, surface.domain().face_count());
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
        EXPECT_EQ(surface.domain().vertex(corner.face, surface.domain().chart().corner_at(corner.l)),
                  m.mesh.faces[f][k]);
      }
  }
}

TEST(QuadProjection, SidesLieOnControlEdgesOrInsideOfControlFaces) {
  for (const test::QuadMesh& m : test::quad_meshes()) {
    const LimitSurface surface(m.mesh, kCatmullClark);
    const Domain& domain = surface.domain();
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(domain.face_count()); ++f)
      for (int k = 0; k < 4; ++k) {
        const std::int32_t next = domain.across(f, k);
        const bool same = next >= 0 && surface.control_face(next) == surface.control_face(f);
        EXPECT_EQ(surface.on_control_edge(f, k), !same) << m.name << " face " << f << " side " << k;
      }
  }
}

// Whether the corner next to a point is the only face's there, on the boundary.
bool beside_a_lonely_corner(const Domain& domain, const FacePoint& at) {
  for (int k = 0; k < domain.chart().corners(); ++k)
    if (domain.chart().is_near(k, at.l)) return domain.faces_at(domain.vertex(at.face, k)).size() == 1;
  return false;
}

// But for rounding: next to the corner of a boundary face without neighbours, where d1 and d2 become
// parallel, more.
TEST(QuadProjection, APointOfTheSurfaceIsItsOwnFoot) {
  double worst = 0, worst_lonely = 0;
  for (const test::QuadMesh& m : test::quad_meshes()) {
    const ClosestPoint closest(m.mesh, kCatmullClark, 1 << 14);
    data::SplitMix64 random(1);
    for (int n = 0; n < 300; ++n) {
      const FacePoint at = random_point(random, closest.domain().face_count());
      const Foot foot = closest.closest(closest.at(at, {}).position);
      const bool lonely = beside_a_lonely_corner(closest.domain(), at);
      double& most = lonely ? worst_lonely : worst;
      most = std::max(most, foot.distance / closest.diagonal());
      EXPECT_LE(foot.distance, (lonely ? 1e-11 : 1e-15) * closest.diagonal())
          << m.name << " face " << at.face << " (" << at.l[1] << ", " << at.l[2] << ") became "
          << foot.at.face << " (" << foot.at.l[1] << ", " << foot.at.l[2] << ")";
    }
  }
  RecordProperty("worst_distance_in_diagonals", std::to_string(worst * 1e16) + "e-16");
  RecordProperty("worst_at_lonely_corners", std::to_string(worst_lonely * 1e12) + "e-12");
}

// On an embedded surface the parameter is unique: that of the point it was made from.
TEST(QuadProjection, TheParameterOfAPointOfTheSurfaceIsRecovered) {
  double worst = 0;
  for (const auto& mesh : {data::quad_cube(), data::quad_wheel(7, 1), data::polygon_prism(5)}) {
    const ClosestPoint closest(mesh, kCatmullClark, 1 << 14);
    data::SplitMix64 random(2);
    for (int n = 0; n < 500; ++n) {
      FacePoint at = random_point(random, closest.domain().face_count());
      at.l = Chart::at(.01 + .98 * at.l[1], .01 + .98 * at.l[2]);  // away from sides, which two faces have
      const Foot foot = closest.closest(closest.at(at, {}).position);
      ASSERT_EQ(foot.at.face, at.face);
      for (int k = 1; k < 3; ++k) worst = std::max(worst, std::abs(foot.at.l[k] - at.l[k]));
    }
  }
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
  EXPECT_LE(worst, 1e-12);
}

// Offset by a thousandth of the size: on a regular mesh the curvature has a bound, and that is well below it.
TEST(QuadProjection, ThePointItWasOffsetFromIsTheFoot) {
  const data::ControlMesh mesh = data::quad_torus(8, 6);
  const ClosestPoint closest(mesh, kCatmullClark, 1 << 14);
  data::SplitMix64 random(3);
  for (int n = 0; n < 400; ++n) {
    const Foot truth = closest.at(random_point(random, mesh.faces.size()), {});
    const double by = (n % 2 == 0 ? 1 : -1) * 1e-3 * closest.diagonal();
    const Foot foot = closest.closest(truth.position + by * truth.normal);
    EXPECT_LE(foot.distance, std::abs(by) * (1 + 1e-12));
    EXPECT_LE(norm(foot.position - truth.position), 1e-9 * closest.diagonal());
    EXPECT_TRUE(foot.stationary);
  }
}

// Random points near and far, against all limit points of a deep lattice.
TEST(QuadProjection, NoSampleOfTheSurfaceIsNearerAndNoneIsBelowTheProvedBound) {
  int gaps = 0;
  for (const test::QuadMesh& m : test::quad_meshes()) {
    const ClosestPoint closest(m.mesh, kCatmullClark, 1 << 11);
    const SurfaceLattice finer(closest.surface().mesh(), closest.lattice().depth() + 1);
    data::SplitMix64 random(4);
    for (int n = 0; n < 25; ++n) {
      Vector p = closest.at(random_point(random, closest.domain().face_count()), {}).position;
      const double reach = closest.diagonal() * std::ldexp(1.0, -static_cast<int>(random.next() % 10));
      for (double& x : p) x += reach * (random.unit() - .5);
      const double brute = distance_to_corners(finer, p);
      const Foot foot = closest.closest(p);
      EXPECT_LE(foot.distance, brute + 1e-12 * closest.diagonal()) << m.name << " point " << n;
      EXPECT_GE(brute, foot.at_least) << m.name << " point " << n;
      EXPECT_LE(foot.at_least, foot.distance) << m.name;
      gaps += foot.distance - foot.at_least > 2 * closest.lattice().largest_deviation();
    }
  }
  EXPECT_EQ(gaps, 0);
}

}  // namespace
}  // namespace limitcheck::verify
