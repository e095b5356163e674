// SPDX-License-Identifier: MIT
// Our engine on a GPU holds what its vectors hold: audited on closed meshes, with boundaries, at random ones, at equal and
// unequal depths, with sharp edges, and with the corners of some faces turned.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "data/generators/named_mesh.h"
#include "verify/audit/audit.h"
#include "verify/host/host.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

class RowStreamGl : public testing::Test {
 protected:
  void SetUp() override {
    if (lc_subject_row_stream_gl() == nullptr) GTEST_SKIP() << "no libraries of OpenGL";
    try {
      (void)capabilities(*lc_subject_row_stream_gl(), "");
    } catch (const SubjectError& error) {
      GTEST_SKIP() << error.what();
    }
  }

  static std::vector<Result> audit(const std::string& name, int depth, const std::string& options = "",
                                   const std::string& depths = "uniform", Level level = Level::kQuick) {
    AuditMesh audited{name, data::named_mesh(name)};
    audited.depths = depths;
    audited.face_depth = face_depths(parse_depths(depths), audited.mesh, depth);
    EXPECT_EQ(std::set(audited.face_depth.begin(), audited.face_depth.end()).size() > 1, depths != "uniform");
    return Auditor(depth, 1, {}, level).run({lc_subject_row_stream_gl(), options}, audited);
  }
  static void expect_held(const std::vector<Result>& results, const std::string& of) {
    for (const Result& r : results) EXPECT_FALSE(is_bad(r)) << of << " " << r.check << ": " << r.message;
    EXPECT_EQ(row(results, "shared-positions").bad, 0) << of;
    EXPECT_EQ(row(results, "shared-normals").bad, 0) << of;
  }
};

TEST_F(RowStreamGl, HoldsOnClosedMeshesBoundariesAndRandomOnes) {
  for (const char* name : {"octahedron", "stellated", "torus", "wheel:7", "fan:1", "holes", "random:1",
                           "bumpy:60", "quad-cube", "quad-fan:3", "mixed:1:60"})
    expect_held(audit(name, 4), name);
}

TEST_F(RowStreamGl, SharesBitsWhicheverCornerAFaceBeginsAt) {
  for (const char* name : {"torus", "quad-torus:4:3"}) {
    const auto results = audit(name, 2, "", "uniform", Level::kStandard);
    expect_held(results, name);
    EXPECT_GT(row(results, "shared-positions").of, 20) << name;
    EXPECT_GT(row(results, "corner-rotation").of, 20) << name;
  }
}

// Edges at a depth of their own, culled faces, patches, and what the processor does for it: grids next to a cut.
TEST_F(RowStreamGl, HoldsAtUnequalDepthsAsPatchesAndBesideSharpEdges) {
  for (const char* name : {"bumpy:60", "mixed:1:60"}) {
    expect_held(audit(name, 4, "", "random:1"), name);
    expect_held(audit(name, 3, "output=patches,frames=2", "random:2"), name);
  }
  for (const char* name : {"crease-ring:2:3", "creased-cube"}) expect_held(audit(name, 3), name);
}

}  // namespace
}  // namespace limitcheck::verify
