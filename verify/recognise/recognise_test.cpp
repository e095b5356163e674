// SPDX-License-Identifier: MIT
// The other rules against OpenSubdiv and the reference; and subjects that deliver something else than they claim are
// told what it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <span>
#include <utility>

#include "data/bounding_box.h"
#include "data/generators/named_mesh.h"
#include "data/test_support/assertions.h"
#include "reference/loop/refine.h"
#include "verify/audit/audit.h"
#include "verify/causes/causes.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/peers/test_opensubdiv.h"
#include "verify/recognise/recognise.h"
#include "verify/row/test_rows.h"
#include "verify/subject/adapter.h"
#include "verify/subject/lattice.h"
#include "verify/subject/registry.h"

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
      expect_same_points(scheme_points(mesh, GuessedRule::kCatmullClark, 2, limit), theirs.points, name);
    }
}

TEST(Schemes, LoopIsTheReference) {
  for (const std::string name : {"bumpy:20", "holes"}) {
    const auto mesh = data::named_mesh(name);
    const auto refined = reference::refine<double>(mesh, 2);
    std::vector<Vector> points, limits;
    for (const auto& p : refined.positions()) points.push_back(vector_of(p));
    for (const auto& p : refined.limits().positions) limits.push_back(vector_of(p));
    expect_same_points(scheme_points(mesh, GuessedRule::kLoop, 2, false), points, name);
    expect_same_points(scheme_points(mesh, GuessedRule::kLoop, 2, true), limits, name);
  }
}

// Places against the reference's lattice, and Catmull and Clark's on the edges alone.
TEST(Schemes, PointsKnowTheirPlaces) {
  const auto mesh = data::named_mesh("holes");
  constexpr int kSteps = 3;
  const auto refined = reference::refine<double>(mesh, kSteps);
  const auto points = placed_scheme_points(mesh, GuessedRule::kLoop, kSteps, false);
  ASSERT_EQ(points.place.size(), refined.positions().size());
  for (std::size_t k = 0; k < points.place.size(); ++k) {
    const Place& p = points.place[k];
    ASSERT_EQ(p.denominator, 1U << kSteps);
    const auto& q = refined.positions()[refined.vertex(p.face, static_cast<int>(p.i), static_cast<int>(p.j))];
    ASSERT_LE(norm(points.position[k] - Vector{q.x, q.y, q.z}), 1e-14) << k;
  }
  // A flat face keeps points in place but for their distance from its edges: its middle stays the middle.
  data::ControlMesh flat{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}};
  const auto quads = placed_scheme_points(flat, GuessedRule::kCatmullClark, 1, false);
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
    const auto loop = placed_scheme_points(mesh, GuessedRule::kLoop, kSteps, limit);
    const auto quads = placed_scheme_points(mesh, GuessedRule::kCatmullClark, kSteps, limit);
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
  EXPECT_NEAR(norm(scheme_points(mesh, GuessedRule::kWarren, 1, false)[0]), .625 * size, 1e-15);
  EXPECT_NEAR(norm(scheme_points(mesh, GuessedRule::kWarren, 0, true)[0]), .5 * size, 1e-15);
  for (const std::string name : {"tetrahedron", "torus"}) {
    const auto same = data::named_mesh(name);
    expect_same_points(scheme_points(same, GuessedRule::kWarren, 1, true),
                       scheme_points(same, GuessedRule::kLoop, 1, true), name);
  }
}

std::vector<Result> audit(const lc_subject& subject, const std::string& options, const std::string& mesh,
                          int depth) {
  return Auditor(depth, 2).run({&subject, options}, {mesh, data::named_mesh(mesh)});
}

// Another subject, but for what it declares and what it delivers for a mesh.
struct Other {
  const lc_subject* of = lc_subject_naive();
  std::function<void(lc_capabilities&)> declare = [](lc_capabilities&) {};
  std::function<void(const data::ControlMesh&, Delivered&)> deliver = [](const data::ControlMesh&,
                                                                         Delivered&) {};
};
Other other;

class OtherSubject {
 public:
  static constexpr std::int32_t kSchemes = LC_DOES_LOOP;
  static lc_capabilities capabilities(Options&, lc_scheme) {
    lc_capabilities c = verify::capabilities(*other.of, "", data::Scheme::kLoop);
    c.no_provenance = 0;  // the host's
    other.declare(c);
    return c;
  }
  OtherSubject(const lc_mesh& mesh, Options&)
      : mesh_(control_mesh(mesh)), inside_(*other.of, mesh_, "", Session::Input::kAsItIs) {}
  void tessellate(const lc_request& request, lc_tessellation& out) {
    Delivered copy(inside_.tessellate(std::span(request.face_depth, mesh_.faces.size()), request.threads));
    other.deliver(mesh_, copy);
    const bool normals = !copy.normals.empty();
    copy.single ? copy.hand_over<float>(request, out, normals, false)
                : copy.hand_over<double>(request, out, normals, false);
  }

 private:
  data::ControlMesh mesh_;
  Session inside_;
};

std::vector<Result> audit_other(Other what, const std::string& mesh, int depth) {
  static const lc_subject subject = make_subject<OtherSubject>("claimed", "");
  other = std::move(what);
  return audit(subject, "", mesh, depth);
}

// `cgal`, whose points are refined and not limit points, or another subject, under another claim.
Other claimed(lc_points points, const lc_subject* of = lc_subject_cgal()) {
  return {.of = of,
          .declare =
              [points](lc_capabilities& c) {
                c.points = points;
                if (points == LC_POINTS_REFINED) c.normals = 0;
              },
          .deliver =
              [points](const data::ControlMesh&, Delivered& out) {
                if (points == LC_POINTS_REFINED) out.normals.clear();
              }};
}
// The same with one point moved, in all faces that have it.
Other claimed_but_one(lc_points points) {
  Other one = claimed(points);
  one.deliver = [](const data::ControlMesh&, Delivered& out) {
    const auto at = out.positions[100];
    for (auto& p : out.positions)
      if (p == at) p[0] += .01;
  };
  return one;
}

void expect_said(const Result& r, const std::string& sentence) {
  EXPECT_EQ(r.status, Status::kFinding) << r.subject << " " << r.check;
  EXPECT_TRUE(says(r.message, sentence)) << r.subject << " " << r.check;
}

TEST(Recognise, RefinedPointsThatAreClaimedAsLimitPoints) {
  for (const std::string mesh : {"bumpy:200", "holes"})
    for (const int depth : {0, 1, 3})
      expect_said(
          row(audit_other(claimed(LC_POINTS_LIMIT), mesh, depth), "positions"),
          "the vertices of the control mesh refined by Loop's rule (" + std::to_string(depth) + " step");
  EXPECT_EQ(row(audit_other(claimed(LC_POINTS_REFINED), "holes", 3), "refined-positions").status,
            Status::kHeld);
  expect_said(row(audit(*lc_subject_model(), "mutation=no_limit", "bumpy:200", 2), "positions"),
              "what is missing is the last step, the limit mask");
}

// What the other points are explains nothing of it: it is a row and a cause of its own.
TEST(Recognise, APointThatIsWrongBesidesIsNotExplained) {
  const auto right = audit_other(claimed(LC_POINTS_LIMIT), "bumpy:200", 3);
  EXPECT_EQ(row(right, "recognised").status, Status::kHeld) << row(right, "recognised").message;
  EXPECT_EQ(row(right, "recognised").bad, 0);

  Report report{.subjects = {"claimed"},
                .results = audit_other(claimed_but_one(LC_POINTS_LIMIT), "bumpy:200", 3)};
  const Result &positions = row(report.results, "positions"), &rest = row(report.results, "recognised");
  ASSERT_TRUE(positions.recognised);
  EXPECT_EQ(positions.recognised->scheme, "loop");
  EXPECT_EQ(positions.recognised->steps, 3);
  EXPECT_FALSE(positions.recognised->limit);
  EXPECT_EQ(rest.status, Status::kFinding);
  EXPECT_GE(rest.bad, 1);
  EXPECT_LE(rest.bad, 6) << "once for each face at most";
  EXPECT_EQ(rest.of, positions.of);
  EXPECT_NEAR(*rest.worst / *rest.bound,
              .01 / (*rest.bound * data::box_diagonal(data::named_mesh("bumpy:200"))), 1);
  ASSERT_TRUE(rest.witness);
  EXPECT_NEAR(rest.witness->got[0] - rest.witness->expected[0], .01, 1e-9);
  const std::vector<Cause> all = causes(report);
  const auto are = [&](auto which) { return std::count_if(all.begin(), all.end(), which); };
  EXPECT_EQ(are([&](const Cause& c) { return &report.results[c.example] == &rest; }), 1);
  EXPECT_EQ(are([](const Cause& c) { return says(c.look, "refined by Loop's rule"); }), 1);

  // Whoever delivers what it says is judged by that alone.
  const auto refined = audit_other(claimed_but_one(LC_POINTS_REFINED), "bumpy:200", 3);
  EXPECT_EQ(row(refined, "refined-positions").bad, rest.bad);
  EXPECT_FALSE(row(refined, "refined-positions").recognised);
}

TEST(Recognise, LimitPointsThatAreClaimedAsRefined) {
  expect_said(row(audit_other(claimed(LC_POINTS_REFINED, lc_subject_opensubdiv_far()), "bumpy:200", 2),
                  "refined-positions"),
              "the limit points of Loop's rule");
}

TEST(Recognise, WarrensWeights) {
  expect_said(row(audit(*lc_subject_model(), "mutation=warren_weights", "bumpy:200", 2), "positions"),
              "the limit points of Loop's rule with Warren's simplified weights (2 steps)");
}

// Catmull and Clark's first step of an octahedron, by hand: (1, 0, 0) goes to (1/3 + 2/2 + 1) / 4 = 7/12, the
// middle (1/2, 1/2, 0) of an edge to (5/12, 5/12, 0).
TEST(Recognise, TheFlatControlMeshAndAnotherScheme) {
  const auto flat = [](double corners, double edges) {
    return Other{.deliver = [=](const data::ControlMesh& mesh, Delivered& out) {
      for (std::size_t v = 0; v < out.positions.size(); ++v) {
        const lc_provenance& p = out.provenance[v];
        const double l1 = static_cast<double>(p.i) / p.denominator,
                     l2 = static_cast<double>(p.j) / p.denominator;
        const auto& t = triangles_of(mesh)[p.face];
        const bool corner = p.i % p.denominator == 0 && p.j % p.denominator == 0;
        out.positions[v] =
            (corner ? corners : edges) *
            ((1 - l1 - l2) * mesh.positions[t[0]] + l1 * mesh.positions[t[1]] + l2 * mesh.positions[t[2]]);
      }
    }};
  };
  expect_said(row(audit_other(flat(1, 1), "bumpy:200", 2), "positions"), "nothing was subdivided");
  expect_said(row(audit_other(flat(7. / 12, 5. / 6), "octahedron", 1), "positions"),
              "the vertices of the control mesh refined by Catmull and Clark's rule (1 step)");
}

TEST(Recognise, NormalsThatAreMeansOfFacetsOrPointTheOtherWay) {
  const auto means = [](const data::ControlMesh&, Delivered& out) {
    // The shared points of faces differ in their last bits.
    const auto key = [&](std::size_t v) {
      Vector p = out.positions[v];
      for (double& x : p) x = std::round(1e9 * x);
      return p;
    };
    std::map<Vector, Vector> sum;
    for (const auto& [a, b, c] : out.triangles) {
      const Vector p = out.positions[a], n = cross(out.positions[b] - p, out.positions[c] - p);
      for (const std::uint32_t v : {a, b, c}) sum[key(v)] = sum[key(v)] + n;
    }
    for (std::size_t v = 0; v < out.normals.size(); ++v) out.normals[v] = 1 / norm(sum[key(v)]) * sum[key(v)];
  };
  expect_said(row(audit_other({.deliver = means}, "bumpy:200", 2), "normals"),
              "averages of the facets around, weighted by area");
  expect_said(row(audit(*lc_subject_model(), "mutation=tangents_exchanged", "bumpy:200", 2), "normals"),
              "most of them point the other way");
  const auto options = faulty_options("flipped_normals", "naive");
  expect_said(row(audit(*lc_subject_faulty(), options, "bumpy:20", 2), "normals"),
              "most of them point the other way");
}

// What is wrong in one place only, or held, gets no story.
TEST(Recognise, NothingWhereNothingIsToBeRecognised) {
  const auto options = faulty_options("nan_position", "naive");
  for (const auto& rows :
       {audit(*lc_subject_faulty(), options, "bumpy:20", 2), audit(*lc_subject_naive(), "", "bumpy:20", 2),
        audit(*lc_subject_model(), "mutation=boundary_vertex_5_8", "holes", 2)})
    for (const Result& r : rows) EXPECT_FALSE(says(r.message, "look")) << r.subject << " " << r.check;
}

}  // namespace

}  // namespace limitcheck::verify
