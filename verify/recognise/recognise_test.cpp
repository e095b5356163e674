// SPDX-License-Identifier: MIT
// Subjects that deliver something else than they claim are told what it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "data/bounding_box.h"
#include "data/generators/named_mesh.h"
#include "verify/audit/audit.h"
#include "verify/causes/causes.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/recognise/recognise.h"
#include "verify/row/test_rows.h"
#include "verify/subject/adapter.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

std::vector<Result> audit(const lc_subject& subject, const std::string& options, const std::string& mesh,
                          int depth) {
  return Auditor(depth, 2).run({&subject, options}, {mesh, data::named_mesh(mesh)});
}

void expect_said(const Result& r, const std::string& sentence) {
  EXPECT_EQ(r.status, Status::kFinding) << r.subject << " " << r.check;
  EXPECT_NE(r.message.find(sentence), std::string::npos) << r.subject << " " << r.check << ": " << r.message;
}

// `cgal`, whose points are refined and not limit points, under another claim.
template <lc_points kPoints>
const lc_subject& claimed() {
  static const lc_subject subject = [] {
    lc_subject s = *lc_subject_cgal();
    s.name = "claimed";
    s.capabilities = [](const char* options, lc_capabilities* out, const char** message) {
      const lc_status status = lc_subject_cgal()->capabilities(options, out, message);
      out->points = kPoints;
      return status;
    };
    return s;
  }();
  return subject;
}

TEST(Recognise, RefinedPointsThatAreClaimedAsLimitPoints) {
  for (const std::string mesh : {"bumpy:200", "holes"})
    for (const int depth : {0, 1, 3})
      expect_said(
          row(audit(claimed<LC_POINTS_LIMIT>(), "", mesh, depth), "positions"),
          "the vertices of the control mesh refined by Loop's rule (" + std::to_string(depth) + " step");
  EXPECT_EQ(row(audit(claimed<LC_POINTS_REFINED>(), "", "holes", 3), "refined-positions").status,
            Status::kHeld);
  expect_said(row(audit(*lc_subject_model(), "mutation=no_limit", "bumpy:200", 2), "positions"),
              "what is missing is the last step, the limit mask");
}

// The same with one point moved, in all faces that have it.
template <lc_points kPoints>
const lc_subject& claimed_but_one() {
  static const lc_subject subject = [] {
    lc_subject s = claimed<kPoints>();
    s.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out, const char** message) {
      const lc_status status = lc_subject_cgal()->tessellate(instance, request, out, message);
      auto* positions = static_cast<double*>(out->positions);
      const std::array<double, 3> one{positions[300], positions[301], positions[302]};
      for (std::int64_t v = 0; v < out->vertex_count; ++v)
        if (std::equal(one.begin(), one.end(), positions + 3 * v)) positions[3 * v] += .01;
      return status;
    };
    return s;
  }();
  return subject;
}

// What the other points are explains nothing of it: it is a row and a cause of its own.
TEST(Recognise, APointThatIsWrongBesidesIsNotExplained) {
  const auto right = audit(claimed<LC_POINTS_LIMIT>(), "", "bumpy:200", 3);
  EXPECT_EQ(row(right, "recognised").status, Status::kHeld) << row(right, "recognised").message;
  EXPECT_EQ(row(right, "recognised").bad, 0);

  Report report;
  report.subjects = {"claimed"};
  report.results = audit(claimed_but_one<LC_POINTS_LIMIT>(), "", "bumpy:200", 3);
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
  EXPECT_EQ(std::count_if(all.begin(), all.end(),
                          [&](const Cause& c) { return &report.results[c.example] == &rest; }),
            1);
  EXPECT_EQ(std::count_if(
                all.begin(), all.end(),
                [](const Cause& c) { return c.look.find("refined by Loop's rule") != std::string::npos; }),
            1);

  // Whoever delivers what it says is judged by that alone.
  const auto refined = audit(claimed_but_one<LC_POINTS_REFINED>(), "", "bumpy:200", 3);
  EXPECT_EQ(row(refined, "refined-positions").bad, rest.bad);
  EXPECT_FALSE(row(refined, "refined-positions").recognised);
}

TEST(Recognise, LimitPointsThatAreClaimedAsRefined) {
  static const lc_subject subject = [] {
    lc_subject s = *lc_subject_opensubdiv_far();
    s.capabilities = [](const char* options, lc_capabilities* out, const char** message) {
      const lc_status status = lc_subject_opensubdiv_far()->capabilities(options, out, message);
      out->points = LC_POINTS_REFINED;
      out->normals = 0;
      return status;
    };
    return s;
  }();
  expect_said(row(audit(subject, "", "bumpy:200", 2), "refined-positions"),
              "the limit points of Loop's rule");
}

TEST(Recognise, WarrensWeights) {
  expect_said(row(audit(*lc_subject_model(), "mutation=warren_weights", "bumpy:200", 2), "positions"),
              "the limit points of Loop's rule with Warren's simplified weights (2 steps)");
}

// `cgal` with other positions at the places that it names.
template <Vector (*kAt)(const data::ControlMesh&, const lc_provenance&)>
class Elsewhere {
 public:
  static lc_capabilities capabilities(Options&) {
    lc_capabilities c{};
    const char* message = nullptr;
    lc_subject_cgal()->capabilities(nullptr, &c, &message);
    c.points = LC_POINTS_LIMIT;
    return c;
  }
  Elsewhere(const lc_mesh& mesh, Options&) {
    for (std::int64_t v = 0; v < mesh.vertex_count; ++v)
      mesh_.positions.push_back(
          {mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]});
    for (std::int64_t t = 0; t < mesh.triangle_count; ++t)
      mesh_.faces.push_back({mesh.triangles[3 * t], mesh.triangles[3 * t + 1], mesh.triangles[3 * t + 2]});
    const char* message = nullptr;
    lc_subject_cgal()->create(&mesh, nullptr, &inside_, &message);
  }
  ~Elsewhere() { lc_subject_cgal()->destroy(inside_); }
  Elsewhere(const Elsewhere&) = delete;
  Elsewhere& operator=(const Elsewhere&) = delete;
  void tessellate(const lc_request& request, lc_tessellation& out) {
    const char* message = nullptr;
    lc_subject_cgal()->tessellate(inside_, &request, &out, &message);
    for (std::int64_t v = 0; v < out.vertex_count; ++v) {
      const Vector p = kAt(mesh_, out.provenance[v]);
      for (int c = 0; c < 3; ++c) static_cast<double*>(out.positions)[3 * v + c] = p[c];
    }
  }

 private:
  data::ControlMesh mesh_;
  void* inside_ = nullptr;
};

Vector on_the_flat_face(const data::ControlMesh& mesh, const lc_provenance& p) {
  const double l1 = static_cast<double>(p.i) / p.denominator, l2 = static_cast<double>(p.j) / p.denominator;
  const auto& t = triangles_of(mesh)[p.face];
  return (1 - l1 - l2) * mesh.positions[t[0]] + l1 * mesh.positions[t[1]] + l2 * mesh.positions[t[2]];
}

// Catmull and Clark's first step of an octahedron, by hand: (1, 0, 0) goes to (1/3 + 2/2 + 1) / 4 = 7/12, the
// middle (1/2, 1/2, 0) of an edge to (5/12, 5/12, 0).
Vector catmull_clark_of_the_octahedron(const data::ControlMesh& mesh, const lc_provenance& p) {
  const bool corner = p.i % p.denominator == 0 && p.j % p.denominator == 0;
  return (corner ? 7. / 12 : 5. / 6) * on_the_flat_face(mesh, p);
}

TEST(Recognise, TheFlatControlMeshAndAnotherScheme) {
  static const lc_subject flat = make_subject<Elsewhere<on_the_flat_face>>("flat", "");
  expect_said(row(audit(flat, "", "bumpy:200", 2), "positions"), "nothing was subdivided");
  static const lc_subject quads = make_subject<Elsewhere<catmull_clark_of_the_octahedron>>("quads", "");
  expect_said(row(audit(quads, "", "octahedron", 1), "positions"),
              "the vertices of the control mesh refined by Catmull and Clark's rule (1 step)");
}

// `naive` with mean normals of the triangles that it delivers around a point.
lc_status facet_normals(void* instance, const lc_request* request, lc_tessellation* out,
                        const char** message) {
  const lc_status status = lc_subject_naive()->tessellate(instance, request, out, message);
  const auto* positions = static_cast<const double*>(out->positions);
  auto* normals = static_cast<double*>(out->normals);
  const auto at = [&](const double* from, std::int64_t v) {
    return Vector{from[3 * v], from[3 * v + 1], from[3 * v + 2]};
  };
  // The shared points of faces differ in their last bits.
  const auto key = [&](std::int64_t v) {
    Vector p = at(positions, v);
    for (double& x : p) x = std::round(1e9 * x);
    return p;
  };
  std::map<Vector, Vector> sum;
  for (std::int64_t t = 0; t < out->triangle_count; ++t) {
    const std::uint32_t* c = out->triangles + 3 * t;
    const Vector p = at(positions, c[0]), n = cross(at(positions, c[1]) - p, at(positions, c[2]) - p);
    for (int k = 0; k < 3; ++k) sum[key(c[k])] = sum[key(c[k])] + n;
  }
  for (std::int64_t v = 0; v < out->vertex_count; ++v) {
    const Vector n = sum[key(v)];
    for (int k = 0; k < 3; ++k) normals[3 * v + k] = n[k] / norm(n);
  }
  return status;
}

TEST(Recognise, NormalsThatAreMeansOfFacetsOrPointTheOtherWay) {
  lc_subject means = *lc_subject_naive();
  means.tessellate = facet_normals;
  expect_said(row(audit(means, "", "bumpy:200", 2), "normals"),
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
    for (const Result& r : rows)
      EXPECT_EQ(r.message.find("look"), std::string::npos)
          << r.subject << " " << r.check << ": " << r.message;
}

}  // namespace
}  // namespace limitcheck::verify
