// SPDX-License-Identifier: MIT
// The audit of Catmull-Clark's surfaces, and of meshes with sharp edges and vertices: what is right has no
// finding, on every kind of face and boundary; who is asked for which, and who is blamed.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

#include "data/generators/named_mesh.h"
#include "verify/audit/audit.h"
#include "verify/audit/default_plan.h"
#include "verify/host/host.h"
#include "verify/mutants/faulty_subjects.h"
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

TEST(CatmullClarkAudit, AStitchedTessellatorHasNoFindingAtUnequalDepths) {
  for (const test::TestMesh& m : test::quad_meshes())
    for (const std::uint64_t seed : {1, 2, 3})
      for (const int least : {-1, 0}) {
        AuditMesh mesh = audited(m);
        mesh.face_depth = random_depths(m.mesh.faces.size(), least, 4, seed);
        mesh.depth = 4;
        Auditor auditor(4, 1, {}, seed == 1 ? Level::kThorough : Level::kQuick);
        expect_held(auditor.run({lc_subject_quad_model(), ""}, mesh), m.name + " at unequal depths");
      }
}

AuditMesh named(const std::string& name, int depth = 2, const std::string& depths = "uniform") {
  AuditMesh m{name, data::named_mesh(name)};
  m.depth = depth;
  m.depths = depths;
  m.face_depth = face_depths(parse_depths(depths), m.mesh, depth);
  return m;
}

TEST(SharpAudit, ARightSubjectHasNoFindingAtAnyDepth) {
  for (const char* name :
       {"creased-cube", "creased-cube:5", "crease-ring", "crease-ring:9", "quad-dart:3", "quad-dart:4",
        "quad-dart:7", "quad-corner:2", "quad-corner:3", "quad-corner:5", "mixed-sharp:1:40",
        "mixed-sharp:8:40", "mixed-sharp:10:40", "mixed-sharp:11:40", "smooth-triangles:2:40"})
    for (const int depth : {0, 1, 3})
      for (const char* depths : {"uniform", "random:1"}) {
        Auditor auditor(depth, 1, {}, Level::kQuick);
        const AuditMesh mesh = named(name, depth, depths);
        const bool loop = mesh.scheme() == data::Scheme::kLoop;
        const lc_subject* model = loop ? lc_subject_model() : lc_subject_quad_model();
        for (const Result& r : auditor.run({model, ""}, mesh))
          EXPECT_FALSE(is_bad(r)) << name << " depth " << depth << " " << depths << " / " << r.check << ": "
                                  << r.message;
      }
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

TEST(SharpAudit, WhoDeclaresSemiSharpEdgesAndKeepsThemForEverIsFoundAndOnlyThere) {
  const auto positions = [](const char* mesh) {
    return row(Auditor(2, 1, {}, Level::kQuick)
                   .run({lc_subject_faulty(), faulty_options("semi_as_infinite", "quad-model")}, named(mesh)),
               "positions")
        .status;
  };
  EXPECT_EQ(positions("creased-cube"), Status::kHeld);
  EXPECT_EQ(positions("creased-cube:9"), Status::kFinding);
  EXPECT_EQ(positions("crease-ring:1"), Status::kFinding);
}

// A subject that looks whether the edges exist is handed tags that fit in all relations.
TEST(SharpAudit, TagsFollowTheVerticesIntoEveryVariantOfTheMesh) {
  lc_subject strict = *lc_subject_quad_model();
  strict.create = [](const lc_mesh* mesh, const char* options, void** instance, const char** message) {
    std::set<std::pair<std::int32_t, std::int32_t>> edges;
    const std::int32_t* corner = mesh->corners;
    for (std::int64_t f = 0; f < mesh->face_count; corner += mesh->face_sizes[f++])
      for (std::int32_t k = 0; k < mesh->face_sizes[f]; ++k) {
        const std::int32_t a = corner[k], b = corner[(k + 1) % mesh->face_sizes[f]];
        edges.insert({a, b}), edges.insert({b, a});
      }
    *message = "a sharp edge that is no edge";
    for (std::int64_t k = 0; k < mesh->sharp_edge_count; ++k)
      if (!edges.contains({mesh->sharp_edges[k].a, mesh->sharp_edges[k].b})) return LC_INVALID_INPUT;
    return lc_subject_quad_model()->create(mesh, options, instance, message);
  };
  for (const Result& r : Auditor(1, 1, {}, Level::kThorough).run({&strict, ""}, named("mixed-sharp:8:40", 1)))
    EXPECT_FALSE(is_bad(r)) << r.check << ": " << r.message;
}

}  // namespace

}  // namespace limitcheck::verify
