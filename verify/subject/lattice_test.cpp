// SPDX-License-Identifier: MIT
#include "verify/subject/lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

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

// Corners are searched for; the answers are those of going through them.
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

// Points off the lattice, of triangles, quads and polygons: one id each, whoever names it, however it is written.
TEST(Lattice, KnowsPointsThatItWasMadeWithBesideItsOwn) {
  for (const data::ControlMesh& mesh : {data::octahedron(), data::polygon_prism(5)}) {
    const Lattice plain(mesh, 2);
    std::vector<Place> others;
    for (std::int32_t f = 0; f < plain.face_count(); ++f)
      for (int part = 0; part < plain.domain(f).parts(); ++part) {
        others.push_back({f, 1, 0, 7, part});   // on an edge
        others.push_back({f, 6, 2, 14, part});  // inside
        others.push_back({f, 2, 4, 8, part});   // of the lattice
        others.push_back({f, 0, 0, 5, part});   // a vertex
        others.push_back({f, 1, 1, 3, part});   // the middle of a triangle
      }
    const Lattice lattice(mesh, plain.scheme(), 2, others);
    std::set<Lattice::Id> on_edges, off;
    std::set<std::tuple<std::int32_t, std::int32_t, std::int64_t>>
        edges;  // and how far from the lower vertex
    for (const Place& p : others) {
      const Lattice::Id id = lattice.id(p);
      ASSERT_NE(id, Lattice::kNone);
      if (plain.id(p) != Lattice::kNone) {
        EXPECT_EQ(id, plain.id(p));
        continue;
      }
      EXPECT_FALSE(lattice.is_on_lattice(id));
      const FaceDomain domain = lattice.domain(p.face);
      const std::int64_t steps = domain.steps(p.denominator), parts = 14 / steps;
      const auto side = domain.side_of(point_of(p), steps);
      EXPECT_EQ(lattice.is_shared(id), side.has_value());
      if (side) {
        const std::int32_t a = lattice.vertex(p.face, side->side),
                           b = lattice.vertex(p.face, domain.next(side->side));
        edges.emplace(std::min(a, b), std::max(a, b), parts * (a < b ? side->along : steps - side->along));
      }
      (lattice.is_shared(id) ? on_edges : off).insert(id);
    }
    EXPECT_EQ(lattice.size(), plain.size() + std::ssize(on_edges) + std::ssize(off));
    EXPECT_EQ(on_edges.size(), edges.size());
    for (Lattice::Id id = 0; id < lattice.size(); ++id) {
      EXPECT_EQ(lattice.id(lattice.place(id)), id);
      int touched = 0;
      for (std::int32_t f = 0; f < lattice.face_count(); ++f)
        if (const auto at = lattice.in_face(id, f)) {
          ++touched;
          EXPECT_EQ(lattice.id(lattice.place(f, *at)), id);
        }
      if (!lattice.is_vertex(id)) {
        EXPECT_EQ(touched, lattice.is_shared(id) ? 2 : 1);
      }
    }
    EXPECT_EQ(lattice.id({0, 2, 0, 7}), Lattice::kNone) << "it was not among them";
  }
}

TEST(Lattice, PassesOverPointsWithoutACommonDenominator) {
  const data::ControlMesh mesh = data::octahedron();
  const std::vector<Place> others{
      {0, 1, 1, 1U << 29}, {0, 1, 1, 5}, {9, 1, 1, 7}, {0, 5, 5, 7}, {0, 1, 2, 1U << 30}};
  const Lattice lattice(mesh, data::Scheme::kLoop, 3, others);
  EXPECT_NE(lattice.id(others[0]), Lattice::kNone);
  EXPECT_EQ(lattice.id(others[1]), Lattice::kNone) << "3 * 5 * 2^29 is above 2^32";
  EXPECT_EQ(lattice.id(others[2]), Lattice::kNone) << "no such face";
  EXPECT_EQ(lattice.id(others[3]), Lattice::kNone) << "outside";
  EXPECT_NE(lattice.id(others[4]), Lattice::kNone);
  EXPECT_EQ(lattice.scale(), std::int64_t{3} << 30);
  EXPECT_EQ(lattice.size(), Lattice(mesh, 3).size() + 2);
}

TEST(Lattice, FractionsAreReduced) {
  EXPECT_EQ(fraction(0, 8), "0");
  EXPECT_EQ(fraction(8, 8), "1");
  EXPECT_EQ(fraction(6, 8), "3/4");
}

}  // namespace
}  // namespace limitcheck::verify
