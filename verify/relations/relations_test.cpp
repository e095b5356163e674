// SPDX-License-Identifier: MIT
// What the relations of sharp edges say is true of the reference: each variant has the same surface, side by
// side. And the sides of points.
// Subjects that are right when they are asked once and wrong because of what they were asked before: each is
// seen by `state` alone, or at least by it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/shapes.h"
#include "data/validate.h"
#include "reference/surface/surface.h"
#include "verify/audit/audit.h"
#include "verify/evidence/test_script.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/relations/variants.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using test::Script;
using test::Scripted;

TEST(Sides, OfACreasedCubeAreThreeAtVerticesAndTwoOnEdges) {
  const data::ControlMesh mesh = data::named_mesh("creased-cube");
  const Lattice lattice(mesh, 2);
  const Sides sides(lattice);
  EXPECT_EQ(sides.size(), lattice.size() + 8 * 2 + 12 * 3);
  std::set<Sides::Id> seen;
  for (std::int32_t f = 0; f < 6; ++f)
    for (int k = 0; k < 4; ++k)
      for (std::int64_t along = 0; along < 4; ++along) {
        const Lattice::Id point = lattice.id(f, lattice.domain(f).on_side(k, along, 4), 4);
        const Sides::Id side = sides.of(point, f);
        EXPECT_TRUE(seen.insert(side).second) << "each face has sides of its own";
        EXPECT_EQ(sides.point(side), point);
        EXPECT_EQ(sides.place(side).face, f);
        EXPECT_EQ(lattice.id(sides.place(side)), point);
        std::set<Sides::Id> all;
        sides.for_each(point, [&](Sides::Id other) { all.insert(other); });
        EXPECT_TRUE(all.contains(side));
        EXPECT_EQ(all.size(), along == 0 ? 3U : 2U);
      }
  EXPECT_EQ(seen.size(), 6U * 16U);
}

TEST(Sides, OfADartAreOneAtItsEndAndTwoAlongTheEdge) {
  const data::ControlMesh mesh = data::named_mesh("quad-dart:5");
  const data::SharpEdge& edge = mesh.sharpness.edges.at(0);
  const Lattice lattice(mesh, 1);
  const Sides sides(lattice);
  EXPECT_EQ(sides.size(), lattice.size() + 1) << "the middle of the edge has two";
  EXPECT_FALSE(sides.several(edge.a));
  EXPECT_FALSE(sides.several(edge.b));
}

TEST(Sides, AreOneWithoutEdgesThatStaySharp) {
  for (const char* name : {"creased-cube:3", "quad-cube", "random:3"}) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const Lattice lattice(mesh, 2);
    EXPECT_TRUE(Sides(lattice).none()) << name;
  }
}

// The largest distance of a variant's surface from the original's, and the largest angle.
struct Apart {
  double position = 0, angle = 0;
  int points = 0;
};
Apart compare(const Evidence& e, const Variant& v) {
  EXPECT_TRUE(data::validate(v.mesh, v.scheme).empty());
  const reference::Surface mine(e.mesh, e.lattice.scheme()), other(v.mesh, v.scheme);
  Apart apart;
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(v.mesh.faces.size()); ++f) {
    const FaceDomain domain = e.lattice.domain(f);
    domain.for_each_point(4, [&](FaceDomain::Point p) {
      const Place there{f, static_cast<std::uint32_t>(p.i), static_cast<std::uint32_t>(p.j),
                        static_cast<std::uint32_t>(domain.denominator(4)), p.part};
      const Place here = v.original(there);
      const auto at = [](const reference::Surface& surface, const Place& q) {
        return surface.evaluate(q.face, q.corner, static_cast<double>(q.i) / q.denominator,
                                static_cast<double>(q.j) / q.denominator, reference::Order::kFirst);
      };
      const auto a = at(mine, here), b = at(other, there);
      ++apart.points;
      apart.position =
          std::max(apart.position, norm(vector_of(a.position) - v.position(vector_of(b.position))));
      EXPECT_EQ(a.normal_kind, b.normal_kind) << v.name << ", face " << f;
      if (a.normal_kind == reference::NormalKind::kRegular)
        apart.angle = std::max(apart.angle, angle_degrees(vector_of(a.normal), vector_of(b.normal)));
    });
  }
  return apart;
}

std::vector<Relation> sharp_relations() {
  std::vector<Relation> all = surface_relations();
  all.erase(all.begin(),
            std::find_if(all.begin(), all.end(), [](const Relation& r) { return r.row == "crease-order"; }));
  return all;
}

// Holds each variant that a mesh has against it; the rows that there are.
std::set<std::string_view> expect_same_surfaces(const data::ControlMesh& mesh) {
  const Scripted scripted(mesh, std::vector<std::int32_t>(mesh.faces.size(), 1), Script{});
  std::set<std::string_view> rows;
  for (const Relation& relation : sharp_relations()) {
    if (!relation.applies(mesh, scripted->lattice)) continue;
    rows.insert(relation.row);
    for (const Variant& v : relation.variants(*scripted)) {
      const Apart apart = compare(*scripted, v);
      EXPECT_LE(apart.position, 1e-14) << v.name;
      EXPECT_LE(apart.angle, 1e-9) << v.name;
      EXPECT_GT(apart.points, 0) << v.name;
    }
  }
  return rows;
}

class SharpVariants : public testing::TestWithParam<const char*> {};

TEST_P(SharpVariants, HaveTheSurfaceOfTheMesh) {
  EXPECT_FALSE(expect_same_surfaces(data::named_mesh(GetParam())).empty());
}
INSTANTIATE_TEST_SUITE_P(Meshes, SharpVariants,
                         testing::Values("creased-cube", "creased-cube:2", "crease-ring", "quad-corner:2",
                                         "quad-corner:3", "quad-corner:4", "corner:2", "corner:3",
                                         "quad-dart:3", "dart:6", "sharp:1:60", "sharp:2:60",
                                         "mixed-sharp:1:60", "mixed-sharp:4:60"));

// A crease from boundary to boundary across a sheet, both boundary rules.
TEST(SharpVariants, ACreaseThatMeetsTheBoundaryCanBeCut) {
  for (const auto boundary : {data::Boundary::kEdge, data::Boundary::kEdgeAndCorner}) {
    data::ControlMesh mesh = data::sheet(4, 3);
    const double line = mesh.positions[mesh.positions.size() / 2][1];
    const Lattice lattice(mesh, 0);
    for (const Lattice::Edge& e : lattice.edges())
      if (mesh.positions[e.a][1] == line && mesh.positions[e.b][1] == line)
        mesh.sharpness.edges.push_back({e.a, e.b, 10});
    ASSERT_EQ(mesh.sharpness.edges.size(), 4U);
    mesh.sharpness.boundary = boundary;
    ASSERT_TRUE(data::validate(mesh).empty());
    EXPECT_EQ(expect_same_surfaces(mesh).size(), 4U) << "all of them";
  }
}

// A wrong variant is seen: without the sharp vertices that the cut needs, corners would move.
TEST(SharpVariants, ACutWithoutHeldCornersIsAnotherSurface) {
  const data::ControlMesh mesh = data::named_mesh("creased-cube");
  const Scripted scripted(mesh, std::vector<std::int32_t>(mesh.faces.size(), 1), Script{});
  Variant v = sharp_relations().back().variants(*scripted).front();
  EXPECT_EQ(v.mesh.positions.size(), 24U);
  EXPECT_EQ(v.mesh.sharpness.vertices.size(), 24U);
  v.mesh.sharpness.vertices.clear();
  const reference::Surface whole(mesh, data::Scheme::kCatmullClark), cut(v.mesh, data::Scheme::kCatmullClark);
  EXPECT_GT(
      norm(vector_of(whole.evaluate(0, 0, 0, 0).position) - vector_of(cut.evaluate(0, 0, 0, 0).position)),
      .01);
}

TEST(CommonSharpness, IsThatOfAllSemiSharpEdgesAndVertices) {
  data::ControlMesh mesh = data::named_mesh("crease-ring:2");
  EXPECT_EQ(common_sharpness(mesh), 2.F);
  mesh = with_sharpness(std::move(mesh), 2.25F);
  EXPECT_EQ(common_sharpness(mesh), 2.25F);
  mesh.sharpness.vertices.push_back({0, 1});
  EXPECT_TRUE(has_semi_sharp(mesh));
  EXPECT_FALSE(common_sharpness(mesh));
  EXPECT_EQ(common_sharpness(with_sharpness(mesh, 3)), 3.F);
  EXPECT_FALSE(has_semi_sharp(with_sharpness(mesh, 0)));
  EXPECT_FALSE(has_semi_sharp(with_sharpness(mesh, 10)));
}

// What fractional-sharpness says: linear between whole numbers, by both ways of creasing, with edges that
// stay sharp, corners and boundaries among them; and what is still to come from 9 on is less than twice the
// step before.
TEST(CommonSharpness, MakesASurfaceThatIsLinearBetweenWholeNumbers) {
  for (const char* name : {"crease-ring:2", "creased-cube:3", "sharp:22:60", "sharp:20:60", "sharp:36:60",
                           "mixed-sharp:8:60", "mixed-sharp:20:60", "mixed-sharp:11:60"})
    for (const auto creasing : {data::Creasing::kUniform, data::Creasing::kChaikin}) {
      data::ControlMesh mesh = data::named_mesh(name);
      ASSERT_TRUE(has_semi_sharp(mesh)) << name;
      mesh.sharpness.creasing = creasing;
      const data::Scheme scheme = data::natural_scheme(mesh);
      std::set<std::int32_t> looked;
      for (const data::SharpEdge& e : mesh.sharpness.edges) looked.insert(e.a);
      const auto points = [&](float s) {
        const reference::Surface surface(with_sharpness(mesh, s), scheme);
        std::vector<Vector> all;
        for (std::int32_t f = 0; f < static_cast<std::int32_t>(mesh.faces.size()) && all.size() < 40; ++f)
          if (looked.contains(mesh.faces[f][0]))
            for (const auto& [u, v] : {std::pair{0., 0.}, {.25, .125}, {.5, 0.}})
              all.push_back(vector_of(surface.evaluate(f, 0, u, v).position));
        return all;
      };
      const auto apart = [](const std::vector<Vector>& a, const std::vector<Vector>& b) {
        double most = 0;
        for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, norm(a[k] - b[k]));
        return most;
      };
      for (const float s : {.125F, 1.75F, 2.5F}) {
        const double share = static_cast<double>(s) - std::floor(s);
        std::vector<Vector> mix = points(std::floor(s));
        const std::vector<Vector> upper = points(std::ceil(s));
        for (std::size_t k = 0; k < mix.size(); ++k) mix[k] = (1 - share) * mix[k] + share * upper[k];
        EXPECT_LE(apart(points(s), mix), 1e-14) << name << " " << s;
        EXPECT_GT(apart(points(s), upper), 1e-4) << name << " " << s;
      }
      const auto nine = points(9), below = points(std::nextafter(10.F, 9.F));
      const double step = apart(points(8), nine);
      EXPECT_LE(apart(nine, below), 2 * step) << name << ": half of what is allowed";
      EXPECT_LE(apart(points(10), below), 2 * step) << name;
    }
}

std::string fault;            // of the subject under test
int alive = 0;                // instances
std::int64_t last_faces = 0;  // of the mesh tessellated before, by any instance
int destroyed = 0;            // instances so far

// The recursive subdivider, with a memory that it should not have: one word says which.
class Forgetful {
 public:
  static lc_capabilities capabilities(Options&, lc_scheme scheme) {
    return verify::capabilities(*lc_subject_naive(), {}, scheme_of(scheme));
  }
  Forgetful(const lc_mesh& mesh, Options&) : mesh_(control_mesh(mesh)), inner_(*lc_subject_naive(), mesh_) {
    ++alive;
  }
  ~Forgetful() { --alive, ++destroyed; }
  Forgetful(const Forgetful&) = delete;
  Forgetful& operator=(const Forgetful&) = delete;

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const std::span depth(request.face_depth, mesh_.faces.size());
    Delivered copy(inner_.tessellate(depth, request.threads));
    const std::int32_t deepest =
        std::accumulate(depth.begin(), depth.end(), 0, [](int a, int b) { return std::max(a, b); });
    if (goes_wrong(deepest, request.threads) && !copy.positions.empty()) copy.positions[0][0] *= 1 + 0x1p-40;
    copy.hand_over<double>(request, out, /*with_normals=*/true, /*with_corners=*/!copy.corner.empty());
  }

 private:
  bool goes_wrong(std::int32_t depth, int threads) {
    const auto faces = static_cast<std::int64_t>(mesh_.faces.size());
    const bool wrong = (fault == "after_a_smaller_depth" && last_ >= 0 && last_ < depth) ||
                       (fault == "after_a_greater_depth" && deepest_ > depth) ||
                       (fault == "beside_another" && alive > 1) ||
                       (fault == "after_another_mesh" && last_faces != 0 && last_faces != faces) ||
                       (fault == "after_another_was_destroyed" && destroyed > others_destroyed_) ||
                       (fault == "first_depth_again" && first_ >= 0 && first_ != depth) ||
                       (fault == "eighth_call" && calls_ == 7) || (fault == "eight_threads" && threads == 8);
    ++calls_;
    deepest_ = std::max(deepest_, depth);
    last_ = depth;
    if (first_ < 0) first_ = depth;
    last_faces = faces;
    return wrong;
  }

  data::ControlMesh mesh_;
  Session inner_;
  int calls_ = 0;
  std::int32_t deepest_ = -1, last_ = -1, first_ = -1;  // depths of the requests so far
  int others_destroyed_ = destroyed;                    // before this was made
};

Result state_of(const std::string& what) {
  fault = what;
  alive = destroyed = 0;
  last_faces = 0;
  static const lc_subject subject = make_subject<Forgetful>("forgetful", "right when it is asked once");
  const auto results = Auditor(2, 1, {}, Level::kStandard)
                           .run({&subject, ""}, {"tetrahedron", data::named_mesh("tetrahedron")});
  EXPECT_EQ(alive, 0) << "every instance is destroyed";
  EXPECT_FALSE(is_bad(row(results, "determinism"))) << what;
  return row(results, "state");
}

TEST(State, OfASubjectWithoutMemoryHolds) {
  const Result r = state_of("none");
  EXPECT_EQ(r.status, Status::kHeld) << r.message;
  EXPECT_GT(r.of, 0);
  for (const char* name : {"naive", "sliding-window", "row-stream", "opensubdiv-far"}) {
    const auto results = Auditor(2, 1, {}, Level::kStandard)
                             .run({find_subject(name), ""}, {"octahedron", data::named_mesh("octahedron")});
    EXPECT_EQ(row(results, "state").status, Status::kHeld) << name << ": " << row(results, "state").message;
  }
  // Nothing in between is of a kind that they do not declare.
  for (const char* name : {"sliding-window", "row-stream"})
    for (const char* mesh : {"corner:3", "creased-cube", "creased-cube:3"}) {
      const auto results =
          Auditor(1, 1, {}, Level::kStandard).run({find_subject(name), ""}, {mesh, data::named_mesh(mesh)});
      EXPECT_FALSE(is_bad(row(results, "state"))) << name << ": " << row(results, "state").message;
    }
}

class Remembers : public testing::TestWithParam<const char*> {};

TEST_P(Remembers, IsAFindingOfStateAndNotOfDeterminism) {
  const Result r = state_of(GetParam());
  EXPECT_EQ(r.status, Status::kFinding) << r.message;
  EXPECT_GT(r.bad, 0);
  EXPECT_FALSE(r.message.empty());
}

INSTANTIATE_TEST_SUITE_P(EachWay, Remembers,
                         testing::Values("after_a_smaller_depth", "after_a_greater_depth", "beside_another",
                                         "after_another_mesh", "after_another_was_destroyed",
                                         "first_depth_again", "eighth_call", "eight_threads"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace limitcheck::verify
