// SPDX-License-Identifier: MIT
// A subject is held to what it declares, its family of weights too, and a report says what was not judged.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <tuple>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/test_support/assertions.h"
#include "verify/audit/audit.h"
#include "verify/host/host.h"
#include "verify/report/forms.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

const lc_subject& good() {
  return *lc_subject_naive();
}

lc_capabilities declared;  // by the subject under test
std::string refuses;       // what it does not take all the same

lc_subject particular() {
  declared = capabilities(good());
  refuses.clear();
  lc_subject s = good();
  s.name = "particular";
  s.capabilities = [](const char*, lc_capabilities* out, const char**) {
    *out = declared;
    return LC_OK;
  };
  s.create = [](const lc_mesh* mesh, const char* options, void** instance, const char** message) {
    *message = "not today";
    if (refuses == "open" && mesh->triangle_count < 2 * (mesh->vertex_count - 2)) return LC_NOT_SUPPORTED;
    if (refuses == "all") return LC_NOT_SUPPORTED;
    return good().create(mesh, options, instance, message);
  };
  s.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out, const char** message) {
    *message = "not today";
    if (refuses == "depth 2" && request->face_depth[0] == 2) return LC_NOT_SUPPORTED;
    if (refuses == "culled" && request->face_depth[0] == -1) return LC_NOT_SUPPORTED;
    return good().tessellate(instance, request, out, message);
  };
  return s;
}

Result tessellates(const lc_subject& subject, AuditMesh mesh) {
  return row(Auditor(2, 1).run({&subject, ""}, mesh), "tessellates");
}
AuditMesh mesh(const std::string& name, std::vector<std::int32_t> depths = {}) {
  return {name, data::named_mesh(name), std::move(depths)};
}

TEST(Declared, ARefusalOfWhatIsDeclaredIsAFinding) {
  const lc_subject subject = particular();
  refuses = "open";
  EXPECT_EQ(tessellates(subject, mesh("fan:3:1")).status, Status::kFinding);
  EXPECT_EQ(tessellates(subject, mesh("octahedron")).status, Status::kHeld);
  refuses = "depth 2";
  EXPECT_EQ(tessellates(subject, mesh("octahedron")).status, Status::kFinding);
  refuses = "culled";
  EXPECT_EQ(tessellates(subject, mesh("tetrahedron", {-1, 1, 1, 2})).status, Status::kFinding);
  EXPECT_EQ(tessellates(subject, mesh("tetrahedron", {-1, -1, -1, -1})).status, Status::kFinding);
  EXPECT_TRUE(says(tessellates(subject, mesh("tetrahedron", {-1, 1, 1, 2})).message, "not today"));
}

TEST(Declared, ARefusalOfWhatIsNotDeclaredIsNone) {
  const lc_subject subject = particular();
  declared.boundary = LC_BOUNDARY_NONE;
  refuses = "open";
  EXPECT_EQ(tessellates(subject, mesh("fan:3:1")).status, Status::kNotSupported);
  declared.max_depth = 1;
  EXPECT_EQ(tessellates(subject, mesh("octahedron")).status, Status::kNotSupported);
  declared.max_depth = 4;
  declared.per_face_depth = 0;
  EXPECT_EQ(tessellates(subject, mesh("tetrahedron", {0, 1, 1, 2})).status, Status::kNotSupported);
  refuses = "all";  // capabilities do not declare sizes
  EXPECT_EQ(tessellates(subject, mesh("tiny-box")).status, Status::kNotSupported);
  EXPECT_EQ(tessellates(subject, mesh("cube")).status, Status::kFinding);
}

TEST(Declared, CapabilitiesThatMeanNothingAreAFinding) {
  const lc_subject subject = particular();
  const std::vector<std::tuple<const char*, void*, std::int32_t>> wrong{
      {"weights is 9", &declared.weights, 9},
      {"precision is 7", &declared.precision, 7},
      {"boundary is -1", &declared.boundary, -1},
      {"points is 2", &declared.points, 2},
      {"normals is 5", &declared.normals, 5},
      {"per_face_depth is 2", &declared.per_face_depth, 2},
      {"exact_lattice is 3", &declared.exact_lattice, 3},
      {"max_depth is -1", &declared.max_depth, -1}};
  for (const auto& [what, field, number] : wrong) {
    std::memcpy(field, &number, sizeof number);
    const Result r = tessellates(subject, mesh("tetrahedron"));
    EXPECT_EQ(r.status, Status::kFinding) << what << ": " << r.message;
    EXPECT_TRUE(says(r.message, what));
    declared = capabilities(good());
  }
}

TEST(Declared, AllCulledIsToDeliverNothingAndIsNoFault) {
  const auto culled = [](const lc_subject& subject) {
    return Auditor(2, 1).run({&subject, ""}, mesh("octahedron", std::vector<std::int32_t>(8, -1)));
  };
  for (const char* name : {"naive", "sliding-window", "row-stream", "model"}) {
    const auto results = culled(*find_subject(name));
    for (const Result& r : results) EXPECT_FALSE(is_bad(r)) << name << " " << r.check << ": " << r.message;
    EXPECT_EQ(row(results, "tessellates").status, Status::kHeld) << name;
    EXPECT_EQ(row(results, "coverage").status, Status::kHeld) << name;
  }
  // One that displays all the same.
  lc_subject shows = good();
  shows.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out,
                        const char** message) {
    const std::vector<std::int32_t> depths(8, 1);
    lc_request all = *request;
    all.face_depth = depths.data();
    return good().tessellate(instance, &all, out, message);
  };
  EXPECT_EQ(row(culled(shows), "coverage").status, Status::kFinding);
}

Report report_of(const char* subject) {
  Report report;
  report.subjects = {subject};
  report.meshes = {{"octahedron", 6, 8}};
  report.results = Auditor(1, 1).run({find_subject(subject), ""}, mesh("octahedron"));
  return report;
}

TEST(Unjudged, IsSaidOfNormalsThatASubjectDoesNotDeliver) {
  const Report cgal = report_of("cgal");
  const auto missing = unjudged(cgal);
  ASSERT_EQ(missing.size(), 1U) << "its refined points are judged";
  EXPECT_EQ(missing[0].check, "normals");
  EXPECT_TRUE(says(to_table(cgal, {}), "normals of cgal were never judged"));
  EXPECT_TRUE(unjudged(report_of("naive")).empty());
}

TEST(Unjudged, ARequiredCheckIsMetByThatCheckOnly) {
  const Report cgal = report_of("cgal");
  EXPECT_EQ(unjudged(cgal, {"positions"}).size(), 1U);
  EXPECT_EQ(unjudged(cgal, {"refined-positions", "coverage"}).size(), 0U);
  EXPECT_EQ(unjudged(cgal, {"state"}).size(), 1U) << "no row at all";
}

const char* const kMeshes[] = {"octahedron", "icosahedron", "wheel:5:2", "ragged-disc"};

std::vector<Result> audit(const char* subject, const std::string& options, const char* mesh, Level level) {
  return Auditor(2, 1, {}, level).run({find_subject(subject), options}, {mesh, data::named_mesh(mesh)});
}

TEST(Weights, SoundSubjectsOfWarrensHold) {
  for (const char* mesh : kMeshes) {
    for (const char* subject : {"naive", "model"}) {
      const auto results = audit(subject, "weights=warren", mesh, Level::kQuick);
      for (const char* check : {"positions", "normals", "normal-length", "continuity", "coverage"}) {
        EXPECT_EQ(row(results, check).status, Status::kHeld) << subject << ' ' << mesh << ' ' << check;
        EXPECT_GT(row(results, check).of, 0) << check;
      }
    }
    const auto refined = audit("model", "weights=warren,points=refined", mesh, Level::kQuick);
    EXPECT_EQ(row(refined, "refined-positions").status, Status::kHeld) << mesh;
    EXPECT_EQ(row(refined, "positions").status, Status::kNotSupported) << mesh;
    for (const auto& results : {audit("model", "weights=warren", mesh, Level::kThorough), refined})
      for (const Result& r : results) EXPECT_FALSE(is_bad(r)) << mesh << ' ' << r.check << ": " << r.message;
  }
}

TEST(Weights, TheReferenceIsKeptForEachFamily) {
  Auditor auditor(1, 1);
  const AuditMesh mesh{"octahedron", data::named_mesh("octahedron")};
  for (int round = 0; round < 2; ++round)
    for (const char* options : {"weights=loop", "weights=warren"})
      EXPECT_EQ(row(auditor.run({find_subject("model"), options}, mesh), "positions").status, Status::kHeld)
          << options;
}

}  // namespace

}  // namespace limitcheck::verify
