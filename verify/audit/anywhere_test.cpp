// SPDX-License-Identifier: MIT
// Subjects whose points lie on no lattice, and corners of faces turned: every vertex is judged, a sound subject holds,
// and each planted fault is seen by the row meant for it.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/shapes.h"
#include "verify/audit/at_point.h"
#include "verify/audit/audit.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

std::vector<Result> run(const char* subject, const std::string& options, const AuditMesh& mesh) {
  return Auditor(mesh.depth, 1, {}, Level::kStandard).run({find_subject(subject), options}, mesh);
}
AuditMesh named(const std::string& name, int depth) {
  AuditMesh mesh{name, data::named_mesh(name)};
  mesh.depth = depth;
  return mesh;
}
std::string red(const std::vector<Result>& results) {
  std::string text;
  for (const Result& r : results)
    if (is_bad(r)) text += fmt::format("{} {}/{}: {}\n", r.check, r.bad, r.of, r.message);
  return text;
}

TEST(PointsAnywhere, OfASoundSubjectHoldInEveryRowAtEveryVertex) {
  for (const char* name :
       {"octahedron", "wheel:5", "sheet:2:2", "quad-torus", "quad-fan:3", "prism:5", "mixed:1"})
    for (const int depth : {0, 2}) {
      const auto results = run("anywhere", "", named(name, depth));
      EXPECT_EQ(red(results), "") << name << " at depth " << depth;
      const Result& positions = row(results, "positions");
      EXPECT_EQ(positions.of, row(results, "finite").of / 2) << name << ": positions, and as many normals";
      EXPECT_GT(row(results, "shared-positions").of, 0) << name;
      EXPECT_GT(row(results, "corner-rotation").of, 0) << name;
      EXPECT_EQ(row(results, "coverage").status, Status::kHeld);
      EXPECT_EQ(row(results, "watertight").status, Status::kHeld);
    }
}

TEST(PointsAnywhere, OfAFaceThatIsCulledAreMissedByNobody) {
  AuditMesh mesh = named("icosahedron", 2);
  mesh.face_depth.assign(20, 2);
  mesh.face_depth[3] = -1;
  const auto results = run("anywhere", "", mesh);
  EXPECT_EQ(red(results), "");
  EXPECT_EQ(row(results, "watertight").status, Status::kHeld);
}

TEST(PointsAnywhere, WithFaultsAreFindingsOfTheRowsMeantForThem) {
  struct Fault {
    const char *name, *row;
  };
  for (const Fault& f : {Fault{"wrong_edge_mask", "positions"},
                         {"one_flipped_normal", "normals"},
                         {"one_ulp_crack", "shared-positions"},
                         {"one_ulp_normal", "shared-normals"},
                         {"missing_triangle", "coverage"},
                         {"duplicated_triangle", "coverage"},
                         {"wrong_triangle_face", "coverage"},
                         {"t_vertex", "t-vertices"},
                         {"one_flipped_triangle", "orientation"},
                         {"shifted_provenance", "positions"}}) {
    const auto results = run("faulty", faulty_options(f.name, "anywhere"), named("stellated", 1));
    EXPECT_EQ(row(results, f.row).status, Status::kFinding) << f.name << "\n" << red(results);
    EXPECT_TRUE(row(results, f.row).witness) << f.name;
  }
}

TEST(PointsAnywhere, AreLookedAtByEval) {
  const AuditSubject subject{find_subject("anywhere"), ""};
  const AtPoint inside = look_at(subject, named("octahedron", 1), {0, 1, 1, 9}, 1);
  EXPECT_TRUE(inside.held());
  EXPECT_EQ(inside.vertices.size(), 1U);
  EXPECT_EQ(look_at(subject, named("octahedron", 1), {0, 1, 0, 3}, 1).vertices.size(), 2U);
  EXPECT_ANY_THROW(look_at(subject, named("octahedron", 1), {0, 1, 1, 5}, 1)) << "it delivers no such point";
}

// The stock torus is written so evenly that a sum in the frame of the face has the same bits from both sides of an edge.
TEST(CornersTurned, ShowSumsInTheFrameOfTheFaceAndNothingElseDoes) {
  const std::string own_frame = faulty_options("own_frame", "quad-model");
  for (const char* name :
       {"quad-torus", "quad-torus:24:10"}) {  // the second has too many faces for the relations
    const auto results = run("faulty", own_frame, named(name, 2));
    const Result& turned = row(results, "corner-rotation");
    EXPECT_EQ(turned.status, Status::kFinding);
    EXPECT_GT(turned.bad, turned.of / 20);
    ASSERT_TRUE(turned.witness);
    EXPECT_NE(turned.witness->expected, turned.witness->got);
    for (const Result& r : results)
      EXPECT_EQ(is_bad(r), r.check == "corner-rotation") << name << ": " << r.check;
    EXPECT_EQ(row(results, "shared-positions").status, Status::kHeld) << name;
  }
}

TEST(CornersTurned, LeaveOurOwnEnginesAlike) {
  for (const char* subject : {"naive", "sliding-window", "row-stream"})
    for (const char* name : {"quad-torus", "bumpy:300", "ragged-disc", "mixed:1:60", "stars:3"}) {
      AuditMesh mesh = named(name, 2);
      mesh.relations = false;
      const auto results = run(subject, "", mesh);
      EXPECT_FALSE(is_bad(row(results, "corner-rotation"))) << subject << " on " << name << "\n"
                                                            << red(results);
      EXPECT_GT(row(results, "corner-rotation").of, 0);
    }
}

}  // namespace
}  // namespace limitcheck::verify
