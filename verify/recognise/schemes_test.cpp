// SPDX-License-Identifier: MIT
// The other schemes against OpenSubdiv and the reference.
#include <gtest/gtest.h>

#include <map>

#include "data/generators/named_mesh.h"
#include "reference/loop/refine.h"
#include "verify/evidence/lattice.h"
#include "verify/peers/test_opensubdiv.h"
#include "verify/recognise/schemes.h"

namespace limitcheck::verify {
namespace {

// As a set: each has one of the others within 1e-14.
void expect_same_points(const std::vector<Vector>& a, const std::vector<Vector>& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (const Vector& p : a) {
    double least = 1e300;
    for (const Vector& q : b) least = std::min(least, norm(p - q));
    ASSERT_LE(least, 1e-14) << what;
  }
}

TEST(Schemes, CatmullClarkIsOpenSubdivs) {
  for (const std::string name : {"bumpy:20", "tetrahedron", "holes", "wheel:7"})
    for (const bool limit : {false, true}) {
      const auto mesh = data::named_mesh(name);
      const auto theirs = test::refined_by_opensubdiv(
          mesh, OpenSubdiv::Sdc::SCHEME_CATMARK, OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_ONLY, 2, limit);
      expect_same_points(scheme_points(mesh, Scheme::kCatmullClark, 2, limit), theirs.points, name);
    }
}

TEST(Schemes, LoopIsTheReference) {
  for (const std::string name : {"bumpy:20", "holes"}) {
    const auto mesh = data::named_mesh(name);
    const auto refined = reference::refine<double>(mesh, 2);
    std::vector<Vector> points, limits;
    for (const auto& p : refined.positions()) points.push_back(vector_of(p));
    for (const auto& p : refined.limits().positions) limits.push_back(vector_of(p));
    expect_same_points(scheme_points(mesh, Scheme::kLoop, 2, false), points, name);
    expect_same_points(scheme_points(mesh, Scheme::kLoop, 2, true), limits, name);
  }
}

// Places against the reference's lattice, and Catmull and Clark's on the edges alone.
TEST(Schemes, PointsKnowTheirPlaces) {
  const auto mesh = data::named_mesh("holes");
  constexpr int kSteps = 3;
  const auto refined = reference::refine<double>(mesh, kSteps);
  const auto points = placed_scheme_points(mesh, Scheme::kLoop, kSteps, false);
  ASSERT_EQ(points.place.size(), refined.positions().size());
  for (std::size_t k = 0; k < points.place.size(); ++k) {
    const Place& p = points.place[k];
    ASSERT_EQ(p.denominator, 1U << kSteps);
    const auto& q = refined.positions()[refined.vertex(p.face, static_cast<int>(p.i), static_cast<int>(p.j))];
    ASSERT_LE(norm(points.position[k] - Vector{q.x, q.y, q.z}), 1e-14) << k;
  }
  // A flat face keeps points in place but for their distance from its edges: its middle stays the middle.
  data::ControlMesh flat;
  flat.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  flat.faces = {{0, 1, 2}};
  const auto quads = placed_scheme_points(flat, Scheme::kCatmullClark, 1, false);
  std::size_t placed = 0;
  for (std::size_t k = 0; k < quads.place.size(); ++k) {
    const Place& p = quads.place[k];
    if (p.denominator == 0) continue;
    ++placed;
    const bool corner = p.i == p.denominator || p.j == p.denominator || p.i + p.j == 0;
    if (corner) continue;
    EXPECT_LE(norm(quads.position[k] - Vector{p.i / 2., p.j / 2., 0}), 1e-15) << "the middle of an edge";
  }
  EXPECT_EQ(placed, 6U) << "three corners and three middles of edges; the face's point is on no lattice";
}

// Both schemes have the cubic B-spline as their boundary curve, so their points on the boundary are the same.
TEST(Schemes, CatmullClarksAndLoopsPointsOnTheBoundaryAreTheSame) {
  const auto mesh = data::named_mesh("holes");
  constexpr int kSteps = 3;
  const Lattice lattice(mesh, kSteps);
  for (const bool limit : {false, true}) {
    const auto loop = placed_scheme_points(mesh, Scheme::kLoop, kSteps, limit);
    const auto quads = placed_scheme_points(mesh, Scheme::kCatmullClark, kSteps, limit);
    std::map<Lattice::Id, Vector> at;
    for (std::size_t k = 0; k < quads.place.size(); ++k)
      if (quads.place[k].denominator != 0) at[lattice.id(quads.place[k])] = quads.position[k];
    std::size_t compared = 0;
    for (std::size_t k = 0; k < loop.place.size(); ++k) {
      const Place& p = loop.place[k];
      const FaceDomain domain = lattice.domain(p.face);
      const auto place = domain.side_of(point_of(p), p.denominator);
      if (!place || lattice.across(p.face, place->side) >= 0) continue;
      ++compared;
      EXPECT_LE(norm(loop.position[k] - at.at(lattice.id(p))), 1e-14) << k;
    }
    EXPECT_GT(compared, 100U);
  }
}

// Warren's weight of each neighbour is 3/(8 n), and 3/16 at valence 3: an octahedron's vertex (1, 0, 0) goes
// to 5/8, its limit is 3 / (3 + 3) = 1/2; a tetrahedron's and a regular mesh's are Loop's.
TEST(Schemes, WarrensWeightsAreWarrens) {
  const auto mesh = data::named_mesh("octahedron");
  const auto size = norm(mesh.positions[0]);
  EXPECT_NEAR(norm(scheme_points(mesh, Scheme::kWarren, 1, false)[0]), .625 * size, 1e-15);
  EXPECT_NEAR(norm(scheme_points(mesh, Scheme::kWarren, 0, true)[0]), .5 * size, 1e-15);
  for (const std::string name : {"tetrahedron", "torus"}) {
    const auto same = data::named_mesh(name);
    expect_same_points(scheme_points(same, Scheme::kWarren, 1, true),
                       scheme_points(same, Scheme::kLoop, 1, true), name);
  }
}

}  // namespace
}  // namespace limitcheck::verify
