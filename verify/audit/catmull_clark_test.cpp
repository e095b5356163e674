// SPDX-License-Identifier: MIT
// The audit of Catmull-Clark's surfaces: what is right has no finding, on every kind of face and boundary.
#include <gtest/gtest.h>

#include <algorithm>

#include "data/generators/bumpy_sphere.h"
#include "data/generators/named_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "verify/audit/audit.h"
#include "verify/evidence/face_depths.h"
#include "verify/mutants/quad_models/quad_model_rules.h"
#include "verify/relations/relations.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

struct Named {
  std::string name;
  data::ControlMesh mesh;
};

std::vector<Named> meshes() {
  std::vector<Named> all{{"quad cube", data::quad_cube()}, {"quad torus", data::quad_torus(4, 3)}};
  for (const int n : {3, 5, 6, 8, 12}) all.push_back({"wheel " + std::to_string(n), data::quad_wheel(n, 1)});
  for (int k = 1; k <= 6; ++k) all.push_back({"fan " + std::to_string(k), data::quad_fan(k, 1)});
  for (const int n : {3, 5, 7}) all.push_back({"prism " + std::to_string(n), data::polygon_prism(n)});
  all.push_back({"triangles", data::octahedron()});
  all.push_back({"dual", data::dual(data::bumpy_sphere(40, 1))});
  return all;
}

AuditMesh audited(const Named& m) {
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
  for (const Named& m : meshes())
    for (const int depth : {0, 1, 2, 3}) {
      const AuditMesh mesh = audited(m);
      Auditor auditor(depth, 1, {}, depth == 2 ? Level::kThorough : Level::kQuick);
      expect_held(auditor.run({lc_subject_naive(), ""}, mesh), m.name + " at depth " + std::to_string(depth));
    }
}

// At depth 0 a diagonal of a face may join the vertices of another edge.
TEST(CatmullClarkAudit, ADiagonalBesideAnotherEdgeOfTheSameEndsIsNoFault) {
  std::vector<Named> meshes;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5})
    meshes.push_back({"mixed", data::named_mesh("mixed:" + std::to_string(seed) + ":40")});
  for (const Named& m : meshes)
    for (const auto* subject : {lc_subject_naive(), lc_subject_quad_model(), lc_subject_cgal()})
      for (const Result& r : Auditor(0, 1).run({subject, ""}, audited(m)))
        EXPECT_TRUE(r.check != "watertight" || r.status == Status::kHeld)
            << subject->name << ": " << r.message;
}

TEST(CatmullClarkAudit, AStitchedTessellatorHasNoFindingAtUnequalDepths) {
  for (const Named& m : meshes())
    for (const std::uint64_t seed : {1, 2, 3})
      for (const int least : {-1, 0}) {
        AuditMesh mesh = audited(m);
        mesh.face_depth = random_depths(m.mesh.faces.size(), least, 4, seed);
        mesh.depth = 4;
        Auditor auditor(4, 1, {}, seed == 1 ? Level::kThorough : Level::kQuick);
        expect_held(auditor.run({lc_subject_quad_model(), ""}, mesh), m.name + " at unequal depths");
      }
}

TEST(CatmullClarkAudit, EachMutantIsFoundByTheCheckMeantForIt) {
  std::vector<AuditMesh> cases;
  for (const Named& m : meshes()) {
    cases.push_back(audited(m));
    cases.back().depth = 2;
    AuditMesh unequal = audited(m);
    unequal.face_depth = random_depths(m.mesh.faces.size(), -1, 3, 1);
    unequal.depth = 3;
    cases.push_back(unequal);
  }
  const auto& relations = relation_rows();
  for (const Mutation& mutation : quad_mutations().subspan(1)) {
    if (mutation.sharp) continue;  // `limitcheck mutants` has meshes with sharp edges
    bool found = false;
    const bool relation = std::find(relations.begin(), relations.end(), mutation.check) != relations.end();
    Auditor auditor(2, 2, {}, relation ? Level::kThorough : Level::kQuick);
    for (std::size_t k = 0; k < cases.size() && !found; ++k)
      for (const Result& r :
           auditor.run({lc_subject_quad_model(), "mutation=" + std::string(mutation.name)}, cases[k]))
        found = found || (r.check == mutation.check && is_bad(r));
    EXPECT_TRUE(found) << mutation.name << " was not found by " << mutation.check;
  }
}

}  // namespace
}  // namespace limitcheck::verify
