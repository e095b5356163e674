// SPDX-License-Identifier: MIT
#include "verify/evidence/lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"

namespace limitcheck::verify {
namespace {

// Every lattice point of every face, by that face.
template <class Visit>
void for_each_point(const Lattice& lattice, Visit visit) {
  const auto n = static_cast<std::uint32_t>(lattice.n());
  for (std::size_t f = 0; f < lattice.mesh().faces.size(); ++f)
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i + j <= n; ++i) visit(lc_provenance{static_cast<std::int32_t>(f), i, j, n});
}

TEST(Lattice, CountsEveryPointOfAClosedMeshOnce) {
  for (int depth = 0; depth <= 4; ++depth) {
    const data::ControlMesh mesh = data::icosahedron();
    const Lattice lattice(mesh, depth);
    std::set<Lattice::Id> seen;
    for_each_point(lattice, [&](const lc_provenance& p) { seen.insert(lattice.id(place_of(p))); });
    EXPECT_EQ(seen.size(), 10U * lattice.n() * lattice.n() + 2)
        << "Euler: V = F n^2 / 2 + 2 at depth " << depth;
    EXPECT_EQ(lattice.size(), static_cast<Lattice::Id>(seen.size()) + 20) << "and the 20 centres";
    EXPECT_EQ(seen.count(Lattice::kNone), 0U);
  }
}

TEST(Lattice, GivesBackTheCoordinatesOfEveryFaceThatTouchesAPoint) {
  for (const data::ControlMesh& mesh : {data::tetrahedron(), data::fan(5, 2), data::torus(3, 4)}) {
    const Lattice lattice(mesh, 3);
    for_each_point(lattice, [&](const lc_provenance& p) {
      const auto c = lattice.in_face(lattice.id(place_of(p)), p.face);
      ASSERT_TRUE(c.has_value());
      EXPECT_EQ(c->i, 3 * p.i);
      EXPECT_EQ(c->j, 3 * p.j);
    });
  }
}

TEST(Lattice, ProvenanceRoundTrips) {
  const data::ControlMesh mesh = data::bipyramid(7);
  const Lattice lattice(mesh, 3);
  for (Lattice::Id id = 0; id < lattice.size(); ++id) EXPECT_EQ(lattice.id(lattice.place(id)), id);
}

// Of faces with many corners these are searched for; the answers are those of going through them.
TEST(Lattice, KnowsTheCornersAndSidesOfPolygonsOfAnySize) {
  for (const int n : {5, 16, 17, 100}) {
    const data::ControlMesh mesh = data::polygon_prism(n);
    const Lattice lattice(mesh, 2);
    for (std::int32_t f = 0; f < lattice.face_count(); ++f) {
      const auto corners = mesh.faces[f];
      for (std::int32_t v = 0; v < 2 * n; ++v) {
        const auto found = std::find(corners.begin(), corners.end(), v);
        const auto at = lattice.corner_of(f, v);
        ASSERT_EQ(at.has_value(), found != corners.end()) << n << " " << f << " " << v;
        if (at) {
          EXPECT_EQ(*at, found - corners.begin()) << n << " " << f << " " << v;
        }
      }
    }
    for (Lattice::Id id = 0; id < lattice.size(); ++id) {
      EXPECT_EQ(lattice.id(lattice.place(id)), id);
      int touched = 0;
      for (std::int32_t f = 0; f < lattice.face_count(); ++f)
        if (const auto at = lattice.in_face(id, f)) {
          ++touched;
          EXPECT_EQ(lattice.id(lattice.place(f, *at)), id) << n << " " << f;
        }
      EXPECT_EQ(touched, lattice.is_vertex(id) ? 3 : lattice.is_shared(id) ? 2 : 1) << n << " " << id;
    }
  }
}

TEST(Lattice, KnowsTheCentreAndNoOtherThirds) {
  const data::ControlMesh mesh = data::tetrahedron();
  const Lattice lattice(mesh, 2);
  const Lattice::Id centre = lattice.id({2, 1, 1, 3});
  EXPECT_NE(centre, Lattice::kNone);
  EXPECT_EQ(lattice.id({2, 4, 4, 12}), centre);
  EXPECT_FALSE(lattice.is_shared(centre));
  EXPECT_FALSE(lattice.in_face(centre, 1).has_value());
  EXPECT_EQ(lattice.id({2, 1, 0, 3}), Lattice::kNone);
  EXPECT_EQ(lattice.id({2, 1, 1, 8}), Lattice::kNone) << "finer than the lattice";
  EXPECT_EQ(lattice.id({2, 3, 2, 4}), Lattice::kNone) << "outside";
  EXPECT_EQ(lattice.id({4, 0, 0, 4}), Lattice::kNone) << "no such face";
  EXPECT_EQ(lattice.id({0, 0, 0, 0}), Lattice::kNone);
}

TEST(Lattice, FractionsAreReduced) {
  EXPECT_EQ(fraction(0, 8), "0");
  EXPECT_EQ(fraction(8, 8), "1");
  EXPECT_EQ(fraction(6, 8), "3/4");
}

}  // namespace
}  // namespace limitcheck::verify
