// SPDX-License-Identifier: MIT
// The audit of files against Catmull-Clark's limit surface: files of quads that are right, and with a fault
// each.
#include <gtest/gtest.h>

#include <string>

#include "data/generators/named_mesh.h"
#include "data/test_support/assertions.h"
#include "verify/files/test_files.h"
#include "verify/projection/test_meshes.h"
#include "verify/recognise/recognise.h"

namespace limitcheck::verify {
namespace {

using namespace test;

FilesAudit audit_quads(const data::ControlMesh& mesh, FileTessellation t) {
  return audit(mesh, std::move(t), {.needs_normals = true, .scheme = data::Scheme::kCatmullClark});
}

TEST(QuadFiles, ExactPointsOfTheLimitSurfaceHaveNoFinding) {
  for (const TestMesh& m : quad_meshes())
    for (const int depth : {0, 1, 2, 3}) {
      if (depth % 2 == 1 && !m.name.starts_with("quad") && m.name != "prism 5" && m.name != "dual") continue;
      const FilesAudit a = audit_quads(m.mesh, quad_file(m.mesh, depth));
      EXPECT_EQ(findings(a), "") << m.name << " at depth " << depth << ": " << row(a, "file-coverage").message
                                 << "; " << row(a, "file-watertight").message << "; "
                                 << row(a, "file-hausdorff").message << "; "
                                 << row(a, "file-normals").message;
      EXPECT_LE(*row(a, "file-distance").worst, 1e-14) << m.name << " at depth " << depth;
      EXPECT_EQ(row(a, "file-distance").scheme, data::Scheme::kCatmullClark);
      EXPECT_TRUE(depth == 0 || row(a, "file-coverage").of > 1) << m.name << ": faces are judged one by one";
    }
}

TEST(QuadFiles, RefinedPointsAreNamedAndTheirBoundaryIsNoCrack) {
  for (const TestMesh& m : quad_meshes())
    for (const int depth : {1, 2}) {
      if (m.name != (depth == 1 ? "quad cube" : "fan 2") && m.name != "wheel 5" && m.name != "dual") continue;
      const FilesAudit a = audit_quads(m.mesh, quad_file(m.mesh, depth, false));
      const Result& distance = row(a, "file-distance");
      EXPECT_EQ(distance.status, Status::kFinding) << m.name;
      EXPECT_NE(distance.message.find(fmt::format("refined by Catmull and Clark's rule ({} step", depth)),
                std::string::npos)
          << m.name << " at depth " << depth << ": " << distance.message;
      EXPECT_TRUE(says(distance.message, "Catmull and Clark's limit surface"));
      EXPECT_TRUE(says(distance.message, "the limit mask"));
      EXPECT_EQ(row(a, "file-watertight").status, Status::kHeld)
          << m.name << ": " << row(a, "file-watertight").message;
    }
}

// The other way to a tessellation of quads, cutting them first, makes another surface.
TEST(QuadFiles, LoopsPointsOfTheTriangulatedMeshAreNamed) {
  for (const auto& mesh : {data::quad_cube(), data::quad_torus(6, 4), data::polygon_prism(5)}) {
    data::ControlMesh cut{mesh.positions, {}};
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      for (std::size_t k = 1; k + 1 < mesh.faces[f].size(); ++k)
        cut.faces.push_back({mesh.faces[f][0], mesh.faces[f][k], mesh.faces[f][k + 1]});
    for (const bool limit : {true, false}) {
      const std::string said = row(audit_quads(mesh, exact(cut, 2, limit)), "file-distance").message;
      EXPECT_TRUE(says(said, limit ? "limit points of Loop's rule" : "refined by Loop's rule"));
      EXPECT_TRUE(says(said, "not Catmull-Clark subdivision"));
    }
    const FileTessellation flat =
        cloud_of(scheme_points(cut, GuessedRule::kLinear, 2, false), kWritings.at("double"));
    EXPECT_TRUE(says(row(audit_quads(mesh, flat), "file-distance").message, "nothing was subdivided"));
  }
}

// The table that an audit writes is one that it takes.
TEST(QuadFiles, ProvenanceIsHeldAgainstTheExactEvaluationThere) {
  for (const auto& mesh : {data::named_mesh("bumpy:20"), data::quad_cube(), data::polygon_prism(5)}) {
    const data::Scheme scheme = data::natural_scheme(mesh);
    const bool loop = scheme == data::Scheme::kLoop;
    const FileTessellation t = loop ? exact(mesh, 2) : quad_file(mesh, 2);
    auto rows = parse_provenance(audit(mesh, t).per_vertex, "map.csv",
                                 static_cast<std::int64_t>(t.positions.size()), mesh, scheme);
    const FilesAudit good = audit(mesh, t, {}, rows);
    EXPECT_EQ(findings(good), "");
    EXPECT_EQ(row(good, "file-positions").of, static_cast<std::int64_t>(t.positions.size()));
    EXPECT_LE(*row(good, "file-positions").worst, loop ? 1e-7 : 1e-14);
    // On the surface still, but elsewhere: only the provenance can tell.
    std::swap(rows[60].at, rows[61].at);
    std::swap(rows[60].corner, rows[61].corner);
    EXPECT_TRUE(says(findings(audit(mesh, t, {}, rows)), "file-positions"));
    std::swap(rows[60].at, rows[61].at);
    std::swap(rows[60].corner, rows[61].corner);
    rows.pop_back();
    EXPECT_EQ(findings(audit(mesh, t, {}, rows)), "file-positions") << "a vertex without a row";
  }
}

// Quads of the file count as two triangles; along which diagonal is the file's choice.
TEST(QuadFiles, TheDiagonalOfAQuadIsTheFilesChoice) {
  for (const TestMesh& m : quad_meshes()) {
    if (m.name != "quad cube" && m.name != "wheel 5" && m.name != "fan 3" && m.name != "dual") continue;
    FileTessellation t = quad_file(m.mesh, 2);
    for (std::size_t k = 0; k < t.triangles.size(); k += 2) {
      const auto [a, b, c] = t.triangles[k];
      const std::int32_t d = t.triangles[k + 1][2];
      t.triangles[k] = {b, c, d};
      t.triangles[k + 1] = {b, d, a};
    }
    const FilesAudit found = audit_quads(m.mesh, t);
    EXPECT_EQ(findings(found), "") << m.name << row(found, "file-hausdorff").message;
  }
}

TEST(QuadFiles, SaysWhatACoarseFileDoesNotShow) {
  const auto said = [](const data::ControlMesh& mesh, int depth) {
    return row(audit_quads(mesh, quad_file(mesh, depth)), "file-distance").message;
  };
  for (const auto& mesh : {data::quad_cube(), data::polygon_prism(5)}) {
    EXPECT_TRUE(says(said(mesh, 0), "along the edges and inside of faces was not looked at"));
    EXPECT_EQ(said(mesh, 1), "") << "the middle of every face";
  }
  const auto cube = data::quad_cube();
  EXPECT_TRUE(
      says(row(audit_quads(cube, quad_file(cube, 0)), "file-hausdorff").message, "only --max-deviation"));
}

// A control mesh of triangles is Loop's unless the other scheme is asked for.
TEST(QuadFiles, TheSchemeIsTheControlMeshsUnlessOneIsAskedFor) {
  const data::ControlMesh mesh = data::named_mesh("octahedron");
  EXPECT_NE(findings(audit(mesh, quad_file(mesh, 2))), "");
  EXPECT_EQ(findings(audit_quads(mesh, quad_file(mesh, 2))), "");
  const data::ControlMesh cube = data::quad_cube();
  EXPECT_EQ(findings(audit(cube, quad_file(cube, 2))), "");
}

TEST(QuadFiles, HausdorffsBracketsHoldDenseSamplesOfBothSides) {
  for (const TestMesh& m : quad_meshes()) {
    if (m.name == "dual" || m.name.starts_with("fan")) continue;
    const FileTessellation t = quad_file(m.mesh, 1);
    const ClosestPoint surface(m.mesh, data::Scheme::kCatmullClark, 1 << 12);
    FileEvidence e{m.name, m.mesh, surface, t, 1e-6};
    place_points(e, {}, false, [](std::size_t, std::size_t) {});
    expect_brackets(e, quad_file(m.mesh, 4).positions);
  }
}

}  // namespace
}  // namespace limitcheck::verify
