// SPDX-License-Identifier: MIT
// Subjects are judged by the family of weights that they declare.
#include <gtest/gtest.h>

#include <algorithm>

#include "data/generators/named_mesh.h"
#include "verify/audit/audit.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

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
    for (const Result& r : audit("model", "weights=warren", mesh, Level::kThorough))
      EXPECT_FALSE(is_bad(r)) << mesh << ' ' << r.check << ": " << r.message;
  }
}

TEST(Weights, RefinedPointsOfWarrensHold) {
  for (const char* mesh : kMeshes) {
    const auto results = audit("model", "weights=warren,points=refined", mesh, Level::kQuick);
    for (const Result& r : results) EXPECT_FALSE(is_bad(r)) << mesh << ' ' << r.check << ": " << r.message;
    EXPECT_EQ(row(results, "refined-positions").status, Status::kHeld) << mesh;
    EXPECT_EQ(row(results, "positions").status, Status::kNotSupported) << mesh;
  }
}

TEST(Weights, OfTheOtherFamilyAreFound) {
  for (const char* options :
       {"mutation=warren_weights", "mutation=warren_declared", "mutation=warren_limit_of_loop"})
    EXPECT_EQ(row(audit("model", options, "octahedron", Level::kQuick), "positions").status, Status::kFinding)
        << options;
  for (const char* options :
       {"points=refined,mutation=warren_weights", "points=refined,mutation=warren_declared"})
    EXPECT_EQ(row(audit("model", options, "octahedron", Level::kQuick), "refined-positions").status,
              Status::kFinding)
        << options;
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
