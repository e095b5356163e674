// SPDX-License-Identifier: MIT
// Witnesses become small, stay valid and fail as before.
#include "verify/audit/shrink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "data/generators/named_mesh.h"
#include "data/io/read.h"
#include "data/test_support/assertions.h"
#include "data/validate.h"
#include "reference/mesh/topology.h"
#include "reference/surface/certified.h"
#include "verify/audit/audit.h"
#include "verify/report/forms.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

bool has_interior_valence(const data::ControlMesh& mesh, std::size_t valence) {
  const reference::Topology topology(mesh.positions.size(), mesh.faces);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const auto k = static_cast<std::int32_t>(v);
    if (!topology.on_boundary(k) && topology.ring(k).size() == valence) return true;
  }
  return false;
}

TEST(Shrink, KeepsLittleMoreThanTheWheelWhereAnInteriorValenceIsAtFault) {
  int found = 0;
  for (int seed = 1; seed <= 12; ++seed) {
    const AuditMesh mesh{"random", data::named_mesh("random:" + std::to_string(seed) + ":300")};
    if (!has_interior_valence(mesh.mesh, 7)) continue;
    ++found;
    const Shrunk small =
        shrink(mesh, 4, 0,
               [](const AuditMesh& m, int depth) { return depth >= 2 && has_interior_valence(m.mesh, 7); },
               {.seconds = 60});
    // Seven at best. What is left may be stuck where every step would make it invalid; worst seen 10.
    EXPECT_LE(small.mesh.mesh.faces.size(), 10U) << seed << ", " << small.attempts << " attempts";
    EXPECT_EQ(small.depth, 2);
    EXPECT_TRUE(data::validate(small.mesh.mesh).empty());
  }
  EXPECT_GT(found, 3);
}

TEST(Shrink, ClosedMeshesStayClosedWhereTheFaultNeedsThat) {
  const auto closed = [](const AuditMesh& m, int) {
    const reference::Topology topology(m.mesh.positions.size(), m.mesh.faces);
    return std::none_of(topology.edges().begin(), topology.edges().end(),
                        [](const auto& e) { return e.on_boundary(); });
  };
  const Shrunk small = shrink({"torus", data::named_mesh("bumpy:100")}, 3, 5, closed, {.seconds = 60});
  EXPECT_EQ(small.mesh.mesh.faces.size(), 4U) << "a tetrahedron: nothing smaller is closed and valid";
  EXPECT_EQ(small.depth, 0);
}

TEST(Shrink, SharpEdgesAndVerticesThatTheFaultDoesNotNeedGo) {
  const auto semi_sharp_inside = [](const AuditMesh& m, int) {
    const reference::Topology topology(m.mesh.positions.size(), m.mesh.faces);
    return std::any_of(topology.edges().begin(), topology.edges().end(), [&](const reference::Edge& e) {
      return !e.on_boundary() && std::any_of(m.mesh.sharpness.edges.begin(), m.mesh.sharpness.edges.end(),
                                             [&](const data::SharpEdge& tag) {
                                               return tag.sharpness < data::kInfiniteSharpness &&
                                                      std::minmax(tag.a, tag.b) == std::minmax(e.a, e.b);
                                             });
    });
  };
  for (const char* name : {"sharp:1", "mixed-sharp:2"}) {
    const AuditMesh mesh{name, data::named_mesh(name)};
    ASSERT_TRUE(semi_sharp_inside(mesh, 0)) << name;
    const Shrunk small = shrink(mesh, 3, -1, semi_sharp_inside, {.seconds = 60});
    EXPECT_EQ(small.mesh.mesh.sharpness.edges.size(), 1U) << name;
    EXPECT_TRUE(small.mesh.mesh.sharpness.vertices.empty()) << name;
    EXPECT_EQ(small.mesh.mesh.sharpness.boundary, data::Boundary::kEdge) << name;
    EXPECT_LE(small.mesh.mesh.faces.size(), 4U) << name << ": the two at the edge";
    EXPECT_TRUE(data::validate(small.mesh.mesh, small.mesh.scheme()).empty());
  }
}

Result finding_on(const AuditMesh& mesh, std::int64_t face) {
  Result finding;
  finding.subject = "mine";
  finding.mesh = mesh.name;
  finding.check = "positions";
  finding.status = Status::kFinding;
  finding.scheme = mesh.scheme();
  finding.witness.emplace();
  finding.witness->face = face;
  return finding;
}

// What a face needs beyond its own tags comes along, and holes keep their faces.
TEST(WitnessFiles, KeepSharpEdgesAndHoles) {
  AuditMesh mesh{"creased", data::named_mesh("creased-cube:3")};
  mesh.mesh.holes = {2};
  const auto folder = std::filesystem::path(testing::TempDir()) / "sharp_witness";
  const auto place = write_witness(folder, {}, finding_on(mesh, 1), mesh, "quick");
  bool found = false;
  for (const auto& file : std::filesystem::recursive_directory_iterator(place))
    if (file.path().extension() == ".obj") {
      const data::ControlMesh written = data::read_mesh(file.path());
      found = found || written == mesh.mesh;
    }
  EXPECT_TRUE(found);
}

TEST(Shrink, TheDepthsOfTheFacesThatStayAreKept) {
  AuditMesh mesh{"sheet", data::named_mesh("sheet")};
  for (std::size_t f = 0; f < mesh.mesh.faces.size(); ++f)
    mesh.face_depth.push_back(static_cast<std::int32_t>(f == 17 ? 3 : 1));
  const auto fails = [](const AuditMesh& m, int) {
    return m.face_depth.size() == m.mesh.faces.size() &&
           std::count(m.face_depth.begin(), m.face_depth.end(), 3) == 1;
  };
  const Shrunk small = shrink(mesh, 3, 17, fails, {.seconds = 60});
  EXPECT_EQ(small.mesh.face_depth, std::vector<std::int32_t>{3});
  EXPECT_EQ(small.depth, 3);
}

// Only the difference of the depths matters, and no coordinate does.
TEST(Shrink, DepthsAreLoweredAndCoordinatesRounded) {
  AuditMesh mesh{"torus", data::named_mesh("torus")};
  mesh.face_depth.assign(mesh.mesh.faces.size(), 4);
  mesh.face_depth[30] = 5, mesh.face_depth[31] = 2;
  const auto fails = [](const AuditMesh& m, int) {
    const reference::Topology topology(m.mesh.positions.size(), m.mesh.faces);
    return std::any_of(topology.edges().begin(), topology.edges().end(), [&](const reference::Edge& e) {
      return !e.on_boundary() && std::abs(m.face_depth[e.left_face] - m.face_depth[e.right_face]) == 3;
    });
  };
  ASSERT_TRUE(fails(mesh, 5));
  const Shrunk small = shrink(mesh, 5, 30, fails, {});
  std::vector<std::int32_t> depths = small.mesh.face_depth;
  std::sort(depths.begin(), depths.end());
  EXPECT_EQ(depths, (std::vector<std::int32_t>{0, 3}));
  EXPECT_EQ(small.depth, 3);
  double largest = 0;
  for (const auto& p : small.mesh.mesh.positions)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  for (const auto& p : small.mesh.mesh.positions)
    for (const double x : p)
      EXPECT_EQ(std::remainder(x, std::exp2(std::ilogb(largest) - 1)), 0) << x << " of " << largest;
}

TEST(Shrink, StopsAfterSoManyAttempts) {
  const AuditMesh mesh{"sheet", data::named_mesh("sheet")};
  const Shrunk small = shrink(mesh, 0, -1, [](const AuditMesh&, int) { return true; }, {.attempts = 2});
  EXPECT_EQ(small.attempts, 2);
  EXPECT_GT(small.mesh.mesh.faces.size(), 10U);
}

// A weight wrong by 1e-6 at valence 5 only, somewhere in three hundred faces: what is left is a fan about one
// such vertex, and the files written for it repeat the finding.
TEST(Shrink, AWrongWeightAtOneValenceComesDownToOneVertex) {
  const AuditSubject subject{find_subject("model"), "mutation=weight_1e-6_at_valence_5"};
  const AuditMesh mesh{"random:5:300", data::named_mesh("random:5:300")};
  const auto positions = [](const std::vector<Result>& results) {
    return *std::find_if(results.begin(), results.end(),
                         [](const Result& r) { return r.check == "positions"; });
  };
  const Result finding = positions(Auditor(2, 1).run(subject, mesh));
  ASSERT_TRUE(is_bad(finding)) << "random:5:300 has a vertex of valence 5";
  const Shrunk small = shrink(subject, mesh, 1, finding, {.seconds = 60}).small;
  EXPECT_LE(small.mesh.mesh.faces.size(), 5U) << small.attempts << " attempts";
  RecordProperty("faces", static_cast<int>(small.mesh.mesh.faces.size()));
  const Result again = positions(Auditor(small.depth, 1).run(subject, small.mesh));
  EXPECT_TRUE(is_bad(again));

  const TestFolder folder;
  Report report{.depth = small.depth};
  const auto place = write_witness(folder.path(), report, again, small.mesh, "quick");
  EXPECT_EQ(data::read_mesh(place / "control.obj").positions, small.mesh.mesh.positions);
  const auto json = nlohmann::json::parse(std::ifstream(place / "witness.json"));
  EXPECT_EQ(json["check"], "positions");
  for (int axis = 0; axis < 3; ++axis) {
    const auto digits = json["limit_position"][axis].get<std::string>();
    EXPECT_GE(digits.size(), 38U);
    EXPECT_NEAR(std::stod(digits), json["expected"][axis].get<double>(), 1e-14);
  }
  EXPECT_TRUE(says(json["audit"].get<std::string>(),
                   "control.obj --depth " + std::to_string(small.depth) + " --level quick"));
}

// What a finding on a pentagon is written as: the mesh with its polygons, and the exact point in the quad at
// the corner.
TEST(WitnessFiles, KeepPolygonsAndNameTheCorner) {
  AuditMesh mesh{"prism:5", data::named_mesh("prism:5")};
  Result finding = finding_on(mesh, 0);
  finding.depth = 2;
  finding.witness->corner = 2;
  finding.witness->l1 = "1/2";
  finding.witness->l2 = "1";
  finding.witness->expected = finding.witness->got = {0, 0, 0};

  const TestFolder folder;
  const auto place = write_witness(folder.path(), {}, finding, mesh, "standard");
  EXPECT_EQ(data::read_mesh(place / "control.obj"), mesh.mesh);
  const auto json = nlohmann::json::parse(std::ifstream(place / "witness.json"));
  EXPECT_EQ(json["scheme"], "catmull-clark");
  EXPECT_EQ(json["corner"], 2);
  const std::string eval = json["eval"];
  EXPECT_TRUE(says(eval, "control.obj 0:2 1/2 1 --scheme catmull-clark"));
  const auto exact =
      reference::CertifiedEvaluator(mesh.mesh, data::Scheme::kCatmullClark)
          .evaluate(0, 2, reference::Parameter::parse("1/2"), reference::Parameter::parse("1"), 40);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_EQ(json["limit_position"][axis], exact.position[axis].value);
}

}  // namespace
}  // namespace limitcheck::verify
