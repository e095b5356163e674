// SPDX-License-Identifier: MIT
// Control meshes of which different parts lie in one place: seams, poles, parts that touch or cover each
// other, edges without length. A right subject has no finding there, and a crack beside a seam is still
// found.
// At spikes, at corners of sectors of two faces and more, and at creases and boundaries of four faces and
// more the surface has no tangent plane, or takes it on like 1/k only: subjects that are right everywhere
// else are not blamed for any normal there, and the row says how many there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "data/cut_out.h"
#include "data/generators/named_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/shapes.h"
#include "data/test_support/assertions.h"
#include "verify/audit/audit.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using data::ControlMesh;

// A tube round a (2, 3) torus knot, cut open along and across: the vertices of the cuts are there twice, as a
// modeller exports what has texture coordinates.
ControlMesh cut_knot(int along, int round) {
  const auto curve = [](double u) {
    const double c = 2 + std::cos(1.5 * u);
    return std::array{c * std::cos(u), c * std::sin(u), std::sin(1.5 * u)};
  };
  ControlMesh mesh;
  for (int i = 0; i <= along; ++i)
    for (int j = 0; j <= round; ++j) {
      const double u = 4 * std::numbers::pi * (i % along) / along,
                   v = 2 * std::numbers::pi * (j % round) / round;
      const auto p = curve(u);
      mesh.positions.push_back({p[0] + .25 * std::cos(v) * std::cos(u),
                                p[1] + .25 * std::cos(v) * std::sin(u), p[2] + .25 * std::sin(v)});
    }
  const auto at = [&](int i, int j) { return i * (round + 1) + j; };
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < round; ++j) {
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

// A sphere by longitude and latitude, cut open along one meridian, its pole a whole row of vertices in one
// place: the triangles there that have two corners in the pole have no area.
//   residue  what sin(pi) leaves: the second pole is a circle of radius 1e-16
ControlMesh uv_sphere(int around, int down, bool residue) {
  ControlMesh mesh;
  for (int y = 0; y <= down; ++y)
    for (int x = 0; x <= around; ++x) {
      const double u = 2 * std::numbers::pi * (x % around) / around, v = std::numbers::pi * y / down;
      const double r = y == 0 || (y == down && !residue) ? 0 : std::sin(v);
      mesh.positions.push_back({-std::cos(u) * r, std::cos(v), std::sin(u) * r});
    }
  const auto at = [&](int y, int x) { return y * (around + 1) + x; };
  for (int y = 0; y < down; ++y)
    for (int x = 0; x < around; ++x) {
      mesh.faces.push_back({at(y, x + 1), at(y, x), at(y + 1, x + 1)});
      mesh.faces.push_back({at(y, x), at(y + 1, x), at(y + 1, x + 1)});
    }
  return mesh;
}

// The same without the triangles that have no area, as three.js makes it: round each pole the triangles meet
// in nothing but the place of their tips, and the boundary runs from each tip back to the circle. The two
// tips next to a vertex of that circle are the ends of its boundary curve, 1e-16 apart.
ControlMesh uv_sphere_with_open_poles(int around, int down) {
  ControlMesh closed = uv_sphere(around, down, true), mesh;
  const auto at_pole = [&](std::int32_t v) { return v <= around || v >= down * (around + 1); };
  std::vector<std::int32_t> number(closed.positions.size(), -1);
  for (auto t : triangles_of(closed)) {
    if (std::count_if(t.begin(), t.end(), at_pole) > 1) continue;
    for (auto& v : t) {
      if (number[v] < 0) {
        number[v] = static_cast<std::int32_t>(mesh.positions.size());
        mesh.positions.push_back(closed.positions[v]);
      }
      v = number[v];
    }
    mesh.faces.push_back(t);
  }
  return mesh;
}

ControlMesh joined(const ControlMesh& a, const ControlMesh& b) {
  ControlMesh mesh = a;
  const auto first = static_cast<std::int32_t>(a.positions.size());
  mesh.positions.insert(mesh.positions.end(), b.positions.begin(), b.positions.end());
  for (const auto& t : triangles_of(b)) mesh.faces.push_back({t[0] + first, t[1] + first, t[2] + first});
  return mesh;
}

ControlMesh flat(ControlMesh mesh) {
  for (auto& p : mesh.positions) p[2] = 0;
  return mesh;
}

std::vector<AuditMesh> meshes() {
  const ControlMesh disc = data::wheel(5, 2);
  return {{"cut-knot", cut_knot(12, 5)},
          {"uv-sphere", uv_sphere(6, 5, false)},
          {"uv-sphere-residue", uv_sphere(6, 5, true)},
          {"uv-sphere-open-poles", uv_sphere_with_open_poles(6, 5)},
          {"flattened", flat(data::bipyramid(7))},  // a disc covered twice: one surface
          {"disc-twice", joined(disc, disc)}};      // two surfaces
}

bool differs_in_bits(const Result& r) {
  return r.check == "shared-positions" || r.check == "shared-normals" || r.check == "watertight";
}

TEST(Seams, NoRightSubjectHasAFindingWhereTheControlMeshMeetsItself) {
  struct Asked {
    const char *subject, *options;
  };
  for (const AuditMesh& mesh : meshes())
    for (const Asked& asked : {Asked{"model", ""}, Asked{"naive", ""}, Asked{"sliding-window", ""},
                               Asked{"sliding-window", "precision=double"}, Asked{"row-stream", ""}})
      for (const Result& r : Auditor(2, 1).run({find_subject(asked.subject), asked.options}, mesh)) {
        // The recursive subdivider does not promise equal bits.
        if (std::string(asked.subject) == "naive" && differs_in_bits(r)) continue;
        EXPECT_FALSE(is_bad(r)) << r.subject << " / " << r.mesh << " / " << r.check << ": " << r.message;
      }
}

// OpenSubdiv has tangents of its own at some boundary vertices, and writes NaN where they vanish.
TEST(Seams, OpenSubdivsPositionsFitTogetherThereToo) {
  for (const AuditMesh& mesh : meshes()) {
    const auto results = Auditor(2, 1).run({find_subject("opensubdiv-far"), "precision=double"}, mesh);
    for (const char* check : {"positions", "orientation", "coverage", "shared-positions", "continuity",
                              "watertight", "t-vertices"})
      EXPECT_FALSE(is_bad(row(results, check)))
          << mesh.name << " / " << check << ": " << row(results, check).message;
  }
}

TEST(Seams, AreNamed) {
  const auto said = [](const AuditMesh& mesh) {
    return row(Auditor(1, 1).run({find_subject("model"), ""}, mesh), "watertight").message;
  };
  // 12 steps along the knot and 5 round it, each on both sides of its cut.
  EXPECT_EQ(said({"cut-knot", cut_knot(12, 5)}), "the control mesh has 34 coincident boundary edges");
  // 5 steps down the meridian on both sides, 6 steps without length at each pole in one place; 6 triangles at
  // each pole.
  EXPECT_EQ(said({"uv-sphere", uv_sphere(6, 5, false)}),
            "the control mesh has 22 coincident boundary edges; the control mesh has 12 faces without area");
  EXPECT_EQ(said({"tetrahedron", data::tetrahedron()}), "");
}

TEST(Seams, DoNotHideACrackInAnEdgeInside) {
  for (const char* base : {"model", "opensubdiv-far"})
    for (const AuditMesh& mesh :
         {AuditMesh{"cut-knot", cut_knot(12, 5)}, {"uv-sphere", uv_sphere(6, 5, false)}}) {
      const auto whole = Auditor(2, 1).run({lc_subject_faulty(), faulty_options("none", base)}, mesh);
      EXPECT_EQ(row(whole, "watertight").status, Status::kHeld) << row(whole, "watertight").message;
      // Of an edge at a cut there is only one side, of which no half can be off.
      const auto cracked =
          Auditor(2, 1).run({lc_subject_faulty(), faulty_options("one_ulp_crack", base)}, mesh);
      EXPECT_EQ(row(cracked, "watertight").status, Status::kFinding) << base << " / " << mesh.name;
      EXPECT_TRUE(says(row(cracked, "watertight").message, "4 open edges that are no boundary"))
          << "two edges, from both sides";
    }
}

struct Shape {
  std::string name;
  data::ControlMesh mesh;
  std::int64_t sectors, faces;  // without a tangent plane: how many, and how many faces they have in all
  bool creased = false;         // edges inside stay sharp
};

// One ring of faces, between whose sectors edges stay sharp up to the boundary.
Shape creases(int sectors, int faces) {
  data::ControlMesh mesh = data::corner(sectors * faces / 2, false);
  std::vector<data::SharpEdge> every_second = std::move(mesh.sharpness.edges);
  mesh.sharpness.edges.clear();
  for (std::size_t k = 0; k < every_second.size(); k += static_cast<std::size_t>(faces) / 2)
    mesh.sharpness.edges.push_back(every_second[k]);
  std::vector<std::int32_t> around;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (std::find(mesh.faces[f].begin(), mesh.faces[f].end(), 0) != mesh.faces[f].end())
      around.push_back(static_cast<std::int32_t>(f));
  data::CutOut cut = data::cut_out(mesh.faces, around);
  data::ControlMesh ring{cut.of(mesh.positions), {}, cut.of(mesh.sharpness)};
  ring.faces = std::move(cut.faces);
  ring.sharpness.boundary = data::Boundary::kEdgeAndCorner;
  return {std::to_string(sectors) + " sectors of " + std::to_string(faces), ring, sectors, sectors * faces,
          true};
}

// Boundaries of four quads and more, or six triangles, and held corners of two and three; creases of quads alone.
std::vector<Shape> shapes(bool triangles) {
  std::vector<Shape> all;
  const auto add = [&](const std::string& what, data::ControlMesh mesh, int faces, bool held) {
    mesh.sharpness.boundary = data::Boundary::kEdgeAndCorner;
    if (held) mesh.sharpness.vertices.push_back({0, data::kInfiniteSharpness});
    all.push_back({what + std::to_string(faces), std::move(mesh), 1, faces});
  };
  for (int k = triangles ? 3 : 2; k <= (triangles ? 8 : 7); ++k) {
    const data::ControlMesh fan = triangles ? data::fan(k) : data::quad_fan(k, 3);
    if (k >= (triangles ? 6 : 4)) add("boundary of ", fan, k, false);
    if (triangles || k <= 6) add("held corner of ", fan, k, true);
  }
  for (const int n : triangles ? std::vector{3, 6, 8} : std::vector{3, 4, 5, 6, 8, 12})
    add("spike of ", triangles ? data::wheel(n) : data::quad_wheel(n, 3), n, true);
  if (!triangles)
    for (const auto& [sectors, faces] : {std::pair{2, 4}, {3, 2}, {4, 2}, {3, 4}})
      all.push_back(creases(sectors, faces));
  return all;
}

struct Sound {
  const char *name, *options;
  bool creases;    // right on edges that stay sharp
  bool face_wise;  // each face has vertices of its own
};

void expect_no_blame(const Sound& s, const Shape& shape, int depth) {
  const std::string what = std::string(s.name) + " on " + shape.name + " at depth " + std::to_string(depth);
  Auditor auditor(depth, 1, {}, Level::kQuick);
  const auto results = auditor.run({find_subject(s.name), s.options}, {shape.name, shape.mesh});
  for (const char* check :
       {"finite", "positions", "normal-length", "normals-against-positions", "orientation"})
    EXPECT_EQ(row(results, check).status, Status::kHeld) << what << ", " << check;
  const Result& normals = row(results, "normals");
  EXPECT_EQ(normals.status, Status::kHeld) << what << ": " << normals.worst.value_or(-1) << " at "
                                           << (normals.witness ? normals.witness->where() : "");
  const std::string count = std::to_string(s.face_wise ? shape.faces : shape.sectors);
  EXPECT_EQ(normals.message.find(count + " more where the surface has no normal"), 0U)
      << what << ": " << normals.message;
}

TEST(NoTangentPlane, BlamesNoSoundSubject) {
  const std::vector<Sound> subjects{
      {"quad-model", "", true, true},
      {"opensubdiv-far", "precision=double", false, false},
      {"opensubdiv-bfr", "precision=double,approx-level=5", true, true},
      {"opensubdiv-far-patches", "precision=double,level=5,inf-sharp=on", true, true},
      {"embree", "", false, true}};
  int judged = 0;
  for (const Shape& shape : shapes(false))
    for (const Sound& subject : subjects) {
      if (shape.creased && !subject.creases) continue;
      for (const int depth : {0, 3}) expect_no_blame(subject, shape, depth), ++judged;
    }
  EXPECT_GT(judged, 100);
}

TEST(NoTangentPlane, BlamesNoSoundSubjectOfLoopsScheme) {
  const Sound far{"opensubdiv-far", "precision=double", false, false};
  for (const Shape& shape : shapes(true))
    for (const int depth : {0, 3}) expect_no_blame(far, shape, depth);
}

}  // namespace
}  // namespace limitcheck::verify
