// SPDX-License-Identifier: MIT
// The audit of Catmull-Clark's surfaces, and of meshes with sharp edges and vertices: what is right has no
// finding, on every kind of face and boundary; who is asked for which, and who is blamed.
#include <gtest/gtest.h>

#include <string>

#include "data/generators/named_mesh.h"
#include "verify/audit/audit.h"
#include "verify/audit/default_plan.h"
#include "verify/projection/test_meshes.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

AuditMesh audited(const test::TestMesh& m) {
  AuditMesh mesh{m.name, m.mesh};
  mesh.asked_scheme = data::Scheme::kCatmullClark;
  return mesh;
}

void expect_held(const std::vector<Result>& results, const std::string& what) {
  EXPECT_FALSE(results.empty());
  for (const Result& r : results)
    EXPECT_TRUE(r.status == Status::kHeld || r.status == Status::kQualityWarning ||
                r.status == Status::kNotRun)
        << what << ", " << r.check << ": " << word(r.status) << ", " << r.bad << " of " << r.of << ", worst "
        << r.worst.value_or(-1) << ", bound " << r.bound.value_or(-1) << ": " << r.message << " at "
        << (r.witness ? r.witness->where() + " " + r.witness->l1 + " " + r.witness->l2 : "");
}

TEST(CatmullClarkAudit, TheNaiveSubdividerHasNoFinding) {
  for (const test::TestMesh& m : test::quad_meshes())
    for (const int depth : {0, 1, 2, 3}) {
      const AuditMesh mesh = audited(m);
      Auditor auditor(depth, 1, {}, depth == 2 ? Level::kThorough : Level::kQuick);
      expect_held(auditor.run({lc_subject_naive(), ""}, mesh), m.name + " at depth " + std::to_string(depth));
    }
}

// At depth 0 a diagonal of a face may join the vertices of another edge.
TEST(CatmullClarkAudit, ADiagonalBesideAnotherEdgeOfTheSameEndsIsNoFault) {
  for (const test::TestMesh& m :
       test::meshes_named({"mixed:1:40", "mixed:2:40", "mixed:3:40", "mixed:4:40", "mixed:5:40"}))
    for (const auto* subject : {lc_subject_naive(), lc_subject_quad_model(), lc_subject_cgal()})
      for (const Result& r : Auditor(0, 1).run({subject, ""}, audited(m)))
        EXPECT_TRUE(r.check != "watertight" || r.status == Status::kHeld)
            << subject->name << ": " << r.message;
}

AuditMesh named(const std::string& name, int depth = 2) {
  AuditMesh m{name, data::named_mesh(name)};
  m.depth = depth;
  return m;
}

// What a subject that is right in all declares, and how often it was handed a mesh.
std::int32_t declared;
int asked;

lc_subject modest() {
  asked = 0;
  lc_subject s = *lc_subject_quad_model();
  s.name = "modest";
  s.capabilities = [](const char* options, lc_capabilities* out, const char** message) {
    const lc_status status = lc_subject_quad_model()->capabilities(options, out, message);
    out->sharp = declared;
    return status;
  };
  s.create = [](const lc_mesh* mesh, const char* options, void** instance, const char** message) {
    ++asked;
    return lc_subject_quad_model()->create(mesh, options, instance, message);
  };
  return s;
}

TEST(SharpAudit, ASubjectIsAskedForWhatItDeclaresAndForNothingElse) {
  const std::int32_t all =
      LC_SHARP_CREASES | LC_SHARP_SEMI | LC_SHARP_CHAIKIN | LC_SHARP_CORNERS | LC_SHARP_SMOOTH_TRIANGLES;
  struct Case {
    std::string mesh;
    std::int32_t needs;
  };
  for (const auto& [mesh, needs] : {Case{"quad-cube", 0},
                                    {"creased-cube", LC_SHARP_CREASES},
                                    {"creased-cube:3", LC_SHARP_SEMI},
                                    {"mixed-sharp:8:60", all & ~LC_SHARP_SMOOTH_TRIANGLES},
                                    {"smooth-triangles:8:60", all}})
    for (const std::int32_t says : {0, int{LC_SHARP_CREASES}, int{LC_SHARP_SEMI}, all & ~LC_SHARP_CHAIKIN,
                                    all & ~LC_SHARP_CORNERS, all & ~LC_SHARP_SMOOTH_TRIANGLES, all}) {
      declared = says;
      const lc_subject subject = modest();
      const Result r = row(Auditor(1, 1, {}, Level::kQuick).run({&subject, ""}, named(mesh)), "tessellates");
      const bool can = (needs & ~says) == 0;
      EXPECT_EQ(r.status, can ? Status::kHeld : Status::kNotSupported) << mesh << " " << says << r.message;
      EXPECT_EQ(asked > 0, can) << mesh << " " << says;
      for (const AuditMesh& m : default_plan(Level::kQuick, {{&subject, ""}})) {
        EXPECT_EQ(sharp_kinds(m.mesh, m.scheme()) & ~says, 0) << m.name;
      }
    }
}

TEST(SharpAudit, ASubjectThatDoesNoDartsIsAskedForOtherCreases) {
  const auto status = [](const char* mesh, std::int32_t says) {
    declared = says;
    const lc_subject subject = modest();
    return row(Auditor(1, 1, {}, Level::kQuick).run({&subject, ""}, named(mesh)), "tessellates").status;
  };
  const std::int32_t creases = LC_SHARP_CREASES | LC_SHARP_CORNERS, no_darts = creases | LC_SHARP_NO_DARTS;
  for (const char* dart : {"quad-dart:3", "quad-dart:7", "quad-corner:3", "open-crease"}) {
    EXPECT_EQ(status(dart, creases), Status::kHeld) << dart;
    EXPECT_EQ(status(dart, no_darts), Status::kNotSupported) << dart;
    EXPECT_EQ(asked, 0);
  }
  for (const char* other : {"quad-cube", "creased-cube", "crease-ring", "quad-fan:3"})
    EXPECT_EQ(status(other, no_darts), Status::kHeld) << other;
}

}  // namespace

}  // namespace limitcheck::verify
