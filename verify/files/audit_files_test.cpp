// SPDX-License-Identifier: MIT
// The audit of files on tessellations that are right, and on ones with a planted fault each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "data/generators/bumpy_sphere.h"
#include "data/generators/channel_meshes.h"
#include "data/generators/named_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "data/test_support/assertions.h"
#include "verify/files/audit_files.h"
#include "verify/files/checks/diagnosis.h"
#include "verify/files/test_files.h"
#include "verify/recognise/recognise.h"
#include "verify/row/rows.h"

namespace limitcheck::verify {
namespace {

using namespace test;

TEST(AuditFiles, AShuffledTessellationWithoutProvenanceHoldsWithinTheRoundingOfFloat) {
  for (const std::string name :
       {"bumpy:200", "icosahedron", "tetrahedron", "wheel:12", "holes", "sheet", "torus"}) {
    const auto mesh = data::named_mesh(name);
    const FilesAudit a = audit(mesh, shuffled(exact(mesh, 3), 7));
    EXPECT_EQ(findings(a), "") << name << ": " << row(a, "file-coverage").message
                               << row(a, "file-watertight").message;
    EXPECT_LE(*row(a, "file-distance").worst, 1e-7) << name;
    EXPECT_EQ(row(a, "file-coverage").of, static_cast<std::int64_t>(mesh.faces.size())) << name;
  }
}

TEST(AuditFiles, DuplicateVerticesDegenerateTrianglesAndMissingNormalsAreNoFaults) {
  const auto mesh = data::named_mesh("bumpy:20");
  FileTessellation t = exact(mesh, 2), soup;
  soup.name = t.name;
  for (const auto& f : t.triangles) {
    const auto first = static_cast<std::int32_t>(soup.positions.size());
    for (const std::int32_t v : f) soup.positions.push_back(t.positions[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
    soup.triangles.push_back({first, first, first + 2});
  }
  soup.used.assign(soup.positions.size(), true);
  soup.polygons = static_cast<std::int64_t>(soup.triangles.size());
  const FilesAudit a = audit(mesh, soup);
  EXPECT_EQ(findings(a), "");
  EXPECT_EQ(row(a, "file-normals").status, Status::kNotSupported);
  EXPECT_EQ(findings(audit(mesh, soup, {.needs_normals = true})), "file-normals");
}

bool is_matched(const FilesAudit& a) {
  return std::any_of(a.notes.begin(), a.notes.end(), [](const std::string& note) {
    return note.starts_with("the faces are connected as those");
  });
}

// Where the faces are those of the refined mesh, each vertex has a point of its own: one that slides along the surface is
// off by as much as it slid. Where most have been moved, or the faces are others, the nearest point is meant.
TEST(AuditFiles, AVertexThatSlidesAlongTheSurfaceIsOffWhereTheFacesAreThoseOfTheMesh) {
  for (const char* name : {"bumpy:200", "icosahedron"}) {  // one of them has symmetries
    const auto mesh = data::named_mesh(name);
    const ClosestPoint surface(mesh);
    FileTessellation t = shuffled(exact(mesh, 2), 3);
    ASSERT_TRUE(is_matched(audit(mesh, t)));
    const auto slide = [&](std::size_t v, double by) {
      const Foot foot = surface.closest(t.positions[v]);
      const Vector along = cross(foot.normal, foot.normal[0] < .9 ? Vector{1, 0, 0} : Vector{0, 1, 0});
      const Vector moved = t.positions[v] + by * surface.diagonal() / norm(along) * along;
      const Vector before = t.positions[v];
      t.positions[v] = surface.closest(moved).position;
      return norm(t.positions[v] - before) / surface.diagonal();
    };
    const double off = slide(t.positions.size() / 2, 1e-4);
    const FilesAudit one = audit(mesh, t);
    EXPECT_TRUE(is_matched(one));
    EXPECT_EQ(row(one, "file-distance").bad, 1);
    EXPECT_NEAR(*row(one, "file-distance").worst, off, 1e-7);  // floats
    for (std::size_t v = 0; v < t.positions.size(); ++v) slide(v, 1e-4);
    const FilesAudit all = audit(mesh, t);
    EXPECT_FALSE(is_matched(all));
    EXPECT_EQ(row(all, "file-distance").status, Status::kHeld);

    FileTessellation cut = exact(mesh, 2);
    cut.triangles.pop_back();
    EXPECT_FALSE(is_matched(audit(mesh, cut)));
    FileTessellation swapped = exact(mesh, 2);
    std::swap(swapped.triangles[5][0], swapped.triangles[5][1]);
    EXPECT_FALSE(is_matched(audit(mesh, swapped)));
  }
}

// Found by fuzzing: a row said "5 of 3 edges".
TEST(AuditFiles, NoRowHasMoreFaultsThanItLookedAt) {
  const auto mesh = data::named_mesh("strip:2");
  FileTessellation t = exact(mesh, 0);
  for (const auto& fault : std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 1, 2}, {1, 0, 2}}) {
    t.triangles.push_back(fault);
    t.polygon.push_back(t.polygon.back() + 1);
    ++t.polygons;
  }
  t.positions[0][0] = NAN;
  t.left_out = 7;
  for (const Result& r : audit(mesh, t).results) EXPECT_LE(r.bad, r.of) << r.check << ": " << r.message;
}

// Faulty files for each check, in which its row is red; every check that is explained has one, and no other.
TEST(AuditFiles, NoCheckIsWithoutAFileThatItRefusesAndAnExplanation) {
  std::set<std::string> killers;
  for (const auto& mesh :
       {data::named_mesh("bumpy:200"), data::quad_wheel(5, 1), data::dual(data::bumpy_sphere(40, 1))}) {
    const FileTessellation good = mesh.faces.are_triangles() ? exact(mesh, 2) : quad_file(mesh, 3);
    ASSERT_EQ(findings(audit(mesh, good, {.pieces = 1 << 13})), "");
    const ClosestPoint surface(mesh);
    const auto moved = [&](double diagonals) {
      return [&surface, diagonals](FileTessellation& t) {
        Vector& p = t.positions.back();
        p = p + diagonals * surface.diagonal() * surface.closest(p).normal;
      };
    };
    struct Planted {
      const char* check;
      const char* findings;  // all that there are; or those that come first, and ".."
      std::function<void(FileTessellation&)> fault;
    };
    const std::vector<Planted> faults{
        {"file-finite", "file-finite file-distance file-coverage file-watertight..",
         [](FileTessellation& t) { t.positions[t.positions.size() / 2][1] = NAN; }},
        {"file-finite", "file-finite..", [](FileTessellation& t) { t.normals[7].direction[2] = NAN; }},
        {"file-distance", "file-distance", moved(1e-5)},
        {"file-distance", "file-distance..", moved(1e-4)},
        {"", "", moved(1e-7)},  // within the tolerance
        {"file-unused", "",
         [](FileTessellation& t) { t.positions.push_back(t.positions[3]), t.used.push_back(false); }},
        {"file-normals", "file-normals", turn_a_normal},
        {"file-normals", "file-normals",
         [](FileTessellation& t) { t.normals[30].direction = -1 * t.normals[30].direction; }},
        {"file-normal-length", "file-normal-length",
         [](FileTessellation& t) {
           for (auto& n : t.normals) n.direction = .5 * n.direction;
         }},
        {"file-degenerate", "file-degenerate",
         [](FileTessellation& t) {  // in an edge, between a vertex and its copy
           const auto edge = t.triangles[20];
           t.positions.push_back(t.positions[edge[0]]);
           t.used.push_back(true);
           add_triangle(t, {edge[0], static_cast<std::int32_t>(t.positions.size()) - 1, edge[1]});
         }},
        {"file-degenerate", "",  // a joint of triangle strips: a warning
         [](FileTessellation& t) {
           add_triangle(t, {t.triangles[7][0], t.triangles[7][0], t.triangles[7][1]});
         }},
        {"file-orientation", "file-orientation file-watertight", turn_a_triangle},
        {"file-coverage", "file-coverage file-watertight", repeat_a_triangle},
        {"file-watertight", "file-coverage file-watertight..", leave_out_a_triangle},
        {"file-watertight", "file-watertight", [](FileTessellation& t) { crack<double>(t, 40, 0); }},
        {"file-watertight", "..",  // to another place
         [](FileTessellation& t) { t.triangles[40][0] = t.triangles.back()[0]; }},
        {"file-hausdorff", "..",
         [](FileTessellation& t) {  // a corner at the other end of the mesh
           std::int32_t& corner = t.triangles[13][0];
           const Vector here = t.positions[corner];
           for (std::size_t v = 0; v < t.positions.size(); ++v)
             if (norm(t.positions[v] - here) > norm(t.positions[corner] - here))
               corner = static_cast<std::int32_t>(v);
         }},
    };
    for (const Planted& planted : faults) {
      FileTessellation t = good;
      planted.fault(t);
      const FilesAudit a = audit(mesh, t, {.pieces = 1 << 13});
      if (*planted.check != 0) {
        const Result& its = row(a, planted.check);
        EXPECT_TRUE(is_bad(its) || its.status == Status::kQualityWarning)
            << planted.check << " did not; red: " << findings(a);
        killers.insert(planted.check);
      }
      const std::string wanted = planted.findings;
      if (wanted.ends_with(".."))
        EXPECT_TRUE(findings(a).starts_with(wanted.substr(0, wanted.size() - 2))) << findings(a);
      else
        EXPECT_EQ(findings(a), wanted) << planted.check << ": no other row reports it";
    }
  }
  const auto mesh = data::named_mesh("bumpy:200");
  const FileTessellation good = exact(mesh, 2);
  // Every vertex on the surface, one of them not where its row says.
  const FilesAudit a =
      audit(mesh, good, {}, {{0, {0, {1. / 3, 1. / 3, 1. / 3}}}, {1, {0, {1. / 3, 1. / 3, 1. / 3}}}});
  if (row(a, "file-positions").status == Status::kFinding) killers.insert("file-positions");

  FileTessellation refined = exact(mesh, 2, false);
  refined.positions[7][0] += .01;
  if (row(audit(mesh, refined), "file-recognised").status == Status::kFinding)
    killers.insert("file-recognised");

  FileTessellation flat = good;  // one pair of texture coordinates for all
  flat.texture = {{0, 0}};
  flat.corner_texture.assign(flat.triangles.size(), {0, 0, 0});
  if (row(audit(data::with_random_channel(mesh, 1), flat), "file-channel").status == Status::kFinding)
    killers.insert("file-channel");

  std::set<std::string> explained;
  for (const RowKind& e : row_kinds())
    if (e.check.starts_with("file-")) explained.emplace(e.check);
  EXPECT_EQ(killers, explained);
  for (const Result& r : audit(mesh, good).results) EXPECT_TRUE(explained.contains(r.check)) << r.check;
}

TEST(AuditFiles, WhatIsNotFiniteIsFoundInVerticesThatNoTriangleUses) {
  const auto mesh = data::named_mesh("icosahedron");
  FileTessellation t = exact(mesh, 1);
  t.positions.push_back({0, NAN, 0});
  t.used.push_back(false);
  EXPECT_EQ(findings(audit(mesh, t)), "file-finite");
  t.positions.back() = {0, 0, 0};
  t.normals.push_back({static_cast<std::int32_t>(t.positions.size()) - 1, {NAN, 0, 0}});
  EXPECT_EQ(findings(audit(mesh, t)), "file-finite");
  t.normals.back().direction = {0, 0, .5};
  EXPECT_EQ(findings(audit(mesh, t)), "") << "what is drawn is right";
}

// Three vertices on a line: the triangle is there, and is seen by nobody but this check where it fills a
// slit.
TEST(AuditFiles, ATriangleOfThreeVerticesOnALineHasNoArea) {
  data::ControlMesh mesh = data::named_mesh("sheet");
  for (auto& p : mesh.positions) p[2] = 0;
  FileTessellation t = exact(mesh, 2);
  const auto [a, b, c] = t.triangles[200];
  t.positions.push_back(.5 * (t.positions[a] + t.positions[b]));
  t.used.push_back(true);
  const auto middle = static_cast<std::int32_t>(t.positions.size()) - 1;
  t.triangles[200] = {middle, b, c};
  add_triangle(t, {a, middle, c});
  add_triangle(t, {a, b, middle});
  EXPECT_EQ(findings(audit(mesh, t)), "file-degenerate");
}

// A control mesh whose limit surface is a line where its control points are on one: nobody can do better.
TEST(AuditFiles, TrianglesThatTheControlMeshLeavesNoAreaAreNoFault) {
  data::ControlMesh mesh = data::named_mesh("octahedron");
  for (auto& p : mesh.positions) p = {p[0] + 2 * p[1] - p[2], 0, 0};
  const FilesAudit a = audit(mesh, exact(mesh, 2));
  EXPECT_EQ(row(a, "file-degenerate").status, Status::kHeld) << row(a, "file-degenerate").message;
}

// Depth 0 has the limits of the control vertices alone, depth 1 those of their edges' middles, too.
TEST(AuditFiles, SaysWhatACoarseFileDoesNotShow) {
  const auto mesh = data::named_mesh("icosahedron");
  const auto said = [&](int depth) { return row(audit(mesh, exact(mesh, depth)), "file-distance").message; };
  EXPECT_TRUE(says(said(0), "along the edges and inside of faces was not looked at"));
  EXPECT_TRUE(says(said(1), "inside of faces was not looked at"));
  EXPECT_EQ(said(2), "");
  EXPECT_TRUE(says(row(audit(mesh, exact(mesh, 0)), "file-hausdorff").message, "only --max-deviation"));

  // The figure for the weights: all vertices are alike, so that the limits of weights off by x are at
  // v + (1 + x) (limit - v). Half of the figure is held, twice is a finding.
  const std::string text = said(0);
  const double figure = std::stod(text.substr(text.find("less than ") + 10));
  const auto limits = exact(mesh, 0).positions;
  for (const double x : {figure / 2, figure * 2}) {
    FileTessellation t = exact(mesh, 0);
    for (std::size_t v = 0; v < limits.size(); ++v) {
      const Vector from = mesh.positions[v];
      t.positions[v] = from + (1 + x) * (limits[v] - from);
    }
    EXPECT_EQ(is_bad(row(audit(mesh, t), "file-distance")), x > figure) << x;
  }
}

TEST(AuditFiles, SaysWhatItLooksLike) {
  const auto mesh = data::named_mesh("bumpy:200");
  const auto said = [&](const std::vector<Vector>& points) {
    FileTessellation t{.name = "cloud", .positions = points};
    t.used.assign(points.size(), true);
    return row(audit(mesh, t), "file-distance").message;
  };
  const std::string refined = row(audit(mesh, exact(mesh, 2, false)), "file-distance").message;
  EXPECT_TRUE(says(refined, "refined by Loop's rule (2 steps)"));
  EXPECT_TRUE(says(refined, "the limit mask"));
  const std::string warren = said(scheme_points(mesh, GuessedRule::kWarren, 2, true));
  EXPECT_TRUE(says(warren, "limit points of Loop's rule with Warren's simplified weights (2 steps)"));
  const std::string flat = said(scheme_points(mesh, GuessedRule::kLinear, 2, false));
  EXPECT_TRUE(says(flat, "nothing was subdivided"));
  const std::string other = said(scheme_points(mesh, GuessedRule::kCatmullClark, 2, true));
  EXPECT_TRUE(says(other, "not Loop subdivision at all"));
}

// Refined control points are not points of the limit surface; some that are wrong besides are not excused.
TEST(AuditFiles, VerticesThatAreWrongBesidesAreNotExplainedByWhatTheOthersAre) {
  struct Case {
    const char* mesh;
    GuessedRule scheme;
    int steps;
  };
  for (const Case& c :
       {Case{"bumpy:200", GuessedRule::kLoop, 3}, Case{"wheel:50", GuessedRule::kLoop, 3},
        Case{"holes", GuessedRule::kLoop, 3}, Case{"quad-wheel:7", GuessedRule::kCatmullClark, 3},
        Case{"quad-cube", GuessedRule::kCatmullClark, 2}, Case{"prism:5", GuessedRule::kCatmullClark, 2}})
    for (const auto& [writing, written] : kWritings) {
      const bool all = c.mesh == std::string("quad-cube") || c.mesh == std::string("holes");
      if (!all && writing != "float") continue;
      if (writing == "four decimals" && c.mesh == std::string("holes")) continue;  // flat but for its rims
      const auto mesh = data::named_mesh(c.mesh);
      FilesOptions quick{.measures_hausdorff = false};
      const std::string name = std::string(c.mesh) + " in " + writing;
      FileTessellation t = cloud_of(scheme_points(mesh, c.scheme, c.steps, false), written);
      const FilesAudit right = audit(mesh, t, quick);
      const Result& held = row(right, "file-recognised");
      EXPECT_EQ(held.status, Status::kHeld) << name << ": " << held.message << " within " << *held.bound;
      EXPECT_EQ(held.of, static_cast<std::int64_t>(t.positions.size())) << name;
      EXPECT_LE(*held.bound, writing == "four decimals" ? 1e-4 : 1e-5) << name;
      ASSERT_TRUE(held.recognised) << name;
      EXPECT_EQ(held.recognised->scheme, recognised(c.scheme, 0, false, true).scheme);
      EXPECT_EQ(held.recognised->steps, c.steps);
      EXPECT_FALSE(held.recognised->limit);
      EXPECT_TRUE(row(right, "file-distance").recognised) << name;

      const std::size_t at = t.positions.size() / 2;
      t.positions[at][0] = written(t.positions[at][0] + .01);
      const FilesAudit wrong = audit(mesh, t, quick);
      const Result& r = row(wrong, "file-recognised");
      EXPECT_EQ(r.status, Status::kFinding) << name;
      EXPECT_EQ(r.bad, 1) << name << ": " << r.message;
      ASSERT_TRUE(r.witness && r.recognised) << name;
      EXPECT_EQ(r.witness->vertex, static_cast<std::int64_t>(at)) << name;
      EXPECT_GE(r.witness->face, 0) << name;
      EXPECT_EQ(row(wrong, "file-distance").recognised->what, r.recognised->what) << name;
    }
}

TEST(AuditFiles, ReadsOffTheCoordinatesHowTheyWereWritten) {
  const auto of = [](const std::string& writing) {
    std::vector<Vector> points;
    for (int k = 1; k < 100; ++k) points.push_back({std::sqrt(k), 1. / k, 1e-3 / k});
    return written(cloud_of(points, kWritings.at(writing)).positions);
  };
  for (const char* in_float : {"float", "decimals", "digits", "float's nine digits"})
    EXPECT_EQ(of(in_float).precision, LC_FLOAT32) << in_float;
  EXPECT_EQ(of("double").precision, LC_FLOAT64);
  EXPECT_DOUBLE_EQ(of("decimals").last, 5e-7);
  EXPECT_DOUBLE_EQ(of("digits").last, 5e-6);  // 9.94987
  std::vector<Vector> round{{1, .5, .25}, {2, 0, -.75}};
  EXPECT_DOUBLE_EQ(written(round).last, 5e-6) << "nobody can tell";
  EXPECT_DOUBLE_EQ(written(round, 0, true).last, .05);
  EXPECT_LE(of("double").last, 1e-14);
  EXPECT_LE(of("float").last, 1e-14);
}

TEST(AuditFiles, AScaleAnOffsetAndATurnAreFittedAway) {
  const auto mesh = data::named_mesh("bumpy:20");
  FileTessellation t = exact(mesh, 2);
  for (Vector& p : t.positions)
    p = {2.5 * p[0] + 1, 2.5 * p[2] - 3, -2.5 * p[1] + .25};  // y up instead of z up
  for (auto& n : t.normals) n.direction = {n.direction[0], n.direction[2], -n.direction[1]};
  EXPECT_TRUE(says(findings(audit(mesh, t)), "file-distance"));
  const FilesAudit a = audit(mesh, t, {.fit = Fit::kSimilarity});
  EXPECT_EQ(findings(a), "") << *row(a, "file-distance").worst;
  EXPECT_LE(*row(a, "file-distance").worst, 1e-7);
}

}  // namespace
}  // namespace limitcheck::verify
