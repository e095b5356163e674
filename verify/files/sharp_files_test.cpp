// SPDX-License-Identifier: MIT
// The audit of files against surfaces with sharp edges: files that are right, and with a fault each.
// Files that Blender writes of cages with sharp edges: examples/blender_subdivide.py. Skipped without Blender.
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "data/generators/random_mesh.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/surgery.h"
#include "data/io/read.h"
#include "data/test_support/assertions.h"
#include "verify/files/test_files.h"
#include "verify/projection/test_meshes.h"
#include "verify/recognise/recognise.h"

namespace limitcheck::verify {
namespace {

using namespace test;

FilesAudit audit_sharp(const TestMesh& m, FileTessellation t) {
  return audit(m.mesh, std::move(t), {.needs_normals = true, .scheme = m.scheme, .pieces = 1 << 13});
}

std::string said(const FilesAudit& a) {
  std::string text;
  for (const Result& r : a.results)
    if (is_bad(r)) text += r.check + ": " + r.message + "; ";
  return text;
}

TestMesh named(const std::string& name) {
  for (TestMesh& m : sharp_meshes())
    if (m.name == name) return std::move(m);
  throw std::out_of_range(name);
}

TEST(SharpFiles, ExactPointsOfTheLimitSurfaceHaveNoFinding) {
  double worst = 0;
  for (const TestMesh& m : sharp_meshes()) {
    const FilesAudit a = audit_sharp(m, sharp_file(m.mesh, m.scheme, 2));
    EXPECT_EQ(findings(a), "") << m.name << ": " << said(a);
    worst = std::max(worst, *row(a, "file-distance").worst);
    EXPECT_LE(*row(a, "file-distance").worst, 1e-14) << m.name;
    EXPECT_FALSE(says(row(a, "file-normals").message, "both sides"))
        << m.name << ": every corner has the normal of its side";
  }
  RecordProperty("worst_distance_in_diagonals", std::to_string(worst * 1e16) + "e-16");
}

// A vertex on an edge that stays sharp has two normals; a file with one of them is not to be blamed.
TEST(SharpFiles, OneNormalForBothSidesOfACreaseIsCountedAndNotJudged) {
  for (const char* name : {"cube 10", "dart 5", "corner 3", "dart 4 of triangles", "ring 10"}) {
    const TestMesh m = named(name);
    const FilesAudit a = audit_sharp(m, with_one_normal_each(sharp_file(m.mesh, m.scheme, 2)));
    EXPECT_EQ(findings(a), "") << m.name << ": " << said(a);
    EXPECT_TRUE(says(row(a, "file-normals").message, "stand for both sides")) << m.name;
  }
  const TestMesh smooth = named("cube 2");
  const FilesAudit a = audit_sharp(smooth, with_one_normal_each(sharp_file(smooth.mesh, smooth.scheme, 2)));
  EXPECT_FALSE(says(row(a, "file-normals").message, "both sides")) << "a semi-sharp edge has one normal";
}

// Files of the wrong surface; the control mesh is right.
TEST(SharpFiles, ASurfaceOfOtherTagsIsFound) {
  const auto with = [](const TestMesh& m, auto&& fault) {
    data::ControlMesh wrong = m.mesh;
    fault(wrong.sharpness);
    return findings(audit_sharp(m, sharp_file(wrong, m.scheme, 2)));
  };
  const auto smooth = [](data::Sharpness& s) { s = {}; };
  const auto one_less = [](data::Sharpness& s) {
    for (data::SharpEdge& e : s.edges) e.sharpness = std::max(0.F, e.sharpness - 1);
  };
  for (const char* name :
       {"cube 0.500000", "cube 10", "dart 4", "dart 3 of triangles", "cone", "corners kept"}) {
    const TestMesh m = named(name);
    EXPECT_TRUE(with(m, smooth).starts_with("file-distance")) << m.name << " as if smooth";
  }
  for (const char* name : {"cube 1", "cube 3.000000", "dart of triangles 2.250000"}) {
    const TestMesh m = named(name);
    EXPECT_TRUE(with(m, one_less).starts_with("file-distance")) << m.name << " one level short";
  }
  TestMesh chaikin = named("cube 1");  // edges of 1/2, 3/2 and 5/2 in turn, so that they meet
  for (std::size_t k = 0; k < chaikin.mesh.sharpness.edges.size(); ++k)
    chaikin.mesh.sharpness.edges[k].sharpness = .5F + static_cast<float>(k % 3);
  chaikin.mesh.sharpness.creasing = data::Creasing::kChaikin;
  EXPECT_EQ(with(chaikin, [](data::Sharpness&) {}), "");
  const auto uniform = with(chaikin, [](data::Sharpness& s) { s.creasing = data::Creasing::kUniform; });
  EXPECT_TRUE(uniform.starts_with("file-distance")) << "the other way of creasing";
}

// Where the surface's tangents are nearly parallel, or vanish, rounding of positions turns normals, on edges
// that stay sharp too.
TEST(SharpFiles, RoundedToFloatRandomOnesHaveNoFindingEither) {
  for (const bool mixed : {false, true}) {
    const data::ControlMesh plain =
        mixed ? data::mixed_mesh(34, {.faces = 100}) : data::random_mesh(34, {.faces = 100});
    const TestMesh m{"34", data::with_random_sharpness(plain, 34), data::natural_scheme(plain)};
    FileTessellation t = sharp_file(m.mesh, m.scheme, 3);
    for (Vector& p : t.positions)
      for (int c = 0; c < 3; ++c) p[c] = static_cast<float>(p[c]);
    const FilesAudit a = audit_sharp(m, std::move(t));
    EXPECT_EQ(findings(a), "") << (mixed ? "mixed" : "triangles") << ": " << said(a);
  }
}

// What a file looks like is said with the tags of the control mesh, and without them.
TEST(SharpFiles, AreRecognisedByTheSurfaceOfTheirTags) {
  for (const char* name : {"cube 10", "cube 2", "dart 4 of triangles"}) {
    const TestMesh m = named(name);
    data::ControlMesh smooth = m.mesh;
    smooth.sharpness = {};
    const FilesAudit ignored = audit_sharp(m, sharp_file(smooth, m.scheme, 2));
    EXPECT_TRUE(says(row(ignored, "file-distance").message, "limit points of")) << name;
    EXPECT_TRUE(says(row(ignored, "file-distance").message, "not taken as sharp")) << name;

    if (m.name == "cube 10") continue;  // flat between its edges: refined points are on the surface
    FileTessellation refined = sharp_file(m.mesh, m.scheme, 2);
    const bool loop = m.scheme == data::Scheme::kLoop;
    refined.positions =
        scheme_points(m.mesh, loop ? GuessedRule::kLoop : GuessedRule::kCatmullClark, 2, false);
    const FilesAudit unmoved = audit_sharp(m, refined);
    EXPECT_TRUE(says(row(unmoved, "file-distance").message, "what is missing is the last step")) << name;
  }
}

TEST(SharpFiles, TheNormalsOfTheTwoSidesExchangedAreFound) {
  for (const char* name : {"cube 10", "dart 5", "dart 4 of triangles", "ring 10"}) {
    const TestMesh m = named(name);
    FileTessellation t = sharp_file(m.mesh, m.scheme, 2);
    // Two corners at one vertex whose normals differ: each gets the other's.
    bool swapped = false;
    for (std::size_t a = 0; a < t.normals.size() && !swapped; ++a)
      for (std::size_t b = a + 1; b < t.normals.size() && !swapped; ++b)
        if (t.normals[a].vertex == t.normals[b].vertex &&
            norm(t.normals[a].direction - t.normals[b].direction) > .01) {
          std::swap(t.normals[a].direction, t.normals[b].direction);
          swapped = true;
        }
    ASSERT_TRUE(swapped) << m.name;
    const FilesAudit a = audit_sharp(m, t);
    EXPECT_EQ(findings(a), "file-normals") << m.name << ": " << said(a);
    EXPECT_EQ(row(a, "file-normals").bad, 2) << m.name;
  }
}

TestMesh with_holes(const std::string& name, std::vector<std::int32_t> holes) {
  TestMesh m =
      name == "torus" ? TestMesh{"torus", data::quad_torus(6, 5), data::Scheme::kCatmullClark} : named(name);
  m.mesh.holes = std::move(holes);
  return m;
}

TEST(SharpFiles, AHoleIsToBeLeftOpen) {
  for (const TestMesh& m :
       {with_holes("cube 10", {2}), with_holes("cube 2", {0, 5}), with_holes("torus", {3, 4}),
        with_holes("random prism", {1, 2}), with_holes("dart 5 of triangles", {0})}) {
    const FilesAudit open = audit_sharp(m, sharp_file(m.mesh, m.scheme, 2));
    EXPECT_EQ(findings(open), "") << m.name << ": " << said(open);
    data::ControlMesh covered = m.mesh;
    covered.holes.clear();
    const FilesAudit filled = audit_sharp(m, sharp_file(covered, m.scheme, 2));
    EXPECT_TRUE(findings(filled).starts_with("file-coverage")) << m.name << ": " << findings(filled);
    EXPECT_TRUE(says(row(filled, "file-coverage").message, "holes"));
    data::ControlMesh more = m.mesh;
    more.holes.insert(more.holes.begin(), {m.mesh.holes[0] == 0 ? 1 : 0});
    std::sort(more.holes.begin(), more.holes.end());
    more.holes.erase(std::unique(more.holes.begin(), more.holes.end()), more.holes.end());
    const std::string missing = findings(audit_sharp(m, sharp_file(more, m.scheme, 2)));
    EXPECT_TRUE(missing.find("file-coverage") != std::string::npos)
        << m.name << ": a face left out that is none";
  }
}

// Two holes that touch in a corner leave a vertex with two fans of faces.
TEST(SharpFiles, HolesThatTouchInACornerAreNoBowTie) {
  TestMesh m = with_holes("torus", {});
  const data::Faces& faces = m.mesh.faces;
  for (std::int32_t f = 1; f < static_cast<std::int32_t>(faces.size()) && m.mesh.holes.empty(); ++f) {
    int common = 0;
    for (const std::int32_t v : faces[0])
      common += static_cast<int>(std::count(faces[f].begin(), faces[f].end(), v));
    if (common == 1) m.mesh.holes = {0, f};
  }
  ASSERT_EQ(m.mesh.holes.size(), 2U);
  const FilesAudit a = audit_sharp(m, sharp_file(m.mesh, m.scheme, 2));
  EXPECT_EQ(findings(a), "") << said(a);
}

namespace fs = std::filesystem;

const fs::path kRoot = LIMITCHECK_SOURCE_DIR;

int code_of(const std::string& command) {
  const int status = std::system((command + " > /dev/null 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class Blender : public testing::Test {
 protected:
  void SetUp() override {
    if (code_of("blender --version | grep -q '^Blender 3[.]4'") != 0)
      GTEST_SKIP() << "Blender 3.4 (Debian package blender) is not there";
  }
  void TearDown() override { fs::remove(out_); }

  static fs::path cage(const std::string& name) { return kRoot / "verify/peers/findings/meshes" / name; }
  int subdivide(const std::string& name) const {
    return code_of("blender -b -P '" + (kRoot / "verify/files/examples/blender_subdivide.py").string() +
                   "' -- '" + cage(name).string() + "' '" + out_.string() + "' 3");
  }

  fs::path out_ = fs::temp_directory_path() / ("limitcheck-blender-" + std::to_string(getpid()) + ".obj");
};

TEST_F(Blender, PutsItsPointsOnTheSurfaceWithSharpEdges) {
  double worst = 0;
  for (const char* name : {"dart.obj", "three-creases.obj", "sharpness-2.25.obj", "semi-sharp-inside.obj"}) {
    ASSERT_EQ(subdivide(name), 0) << name;
    const data::ControlMesh mesh = data::read_mesh(cage(name));
    ASSERT_FALSE(mesh.sharpness.empty());
    FilesOptions options{.scheme = data::Scheme::kCatmullClark};
    const FilesAudit a = test::audit(mesh, read_tessellation(out_), options);
    for (const char* check : {"file-distance", "file-coverage", "file-orientation", "file-watertight"})
      EXPECT_EQ(test::row(a, check).status, Status::kHeld)
          << name << ": " << check << " " << test::row(a, check).message;
    worst = std::max(worst, *test::row(a, "file-distance").worst);
    data::ControlMesh smooth = mesh;
    smooth.sharpness = {};
    EXPECT_EQ(test::row(test::audit(smooth, read_tessellation(out_), options), "file-distance").status,
              Status::kFinding)
        << name << " is not the smooth surface";
  }
  RecordProperty("worst_distance_in_diagonals", std::to_string(worst * 1e7) + "e-7");
}

// It refines them by OpenSubdiv's Far, whose faults are in verify/peers/findings/opensubdiv-channels.md.
TEST_F(Blender, PutsTextureCoordinatesWhereFarHasThem) {
  const auto judged = [&](const char* name) {
    EXPECT_EQ(subdivide(name), 0) << name;
    const Result r = test::row(test::audit(data::read_mesh(cage(name)), read_tessellation(out_),
                                           {.scheme = data::Scheme::kCatmullClark}),
                               "file-channel");
    EXPECT_GT(r.of, 300) << name;
    return r;
  };
  for (const char* name : {"channel-straight-seam.obj", "channel-boundaries.obj",
                           "channel-infinite-and-semi.obj", "channel-all-triangle.obj"})
    EXPECT_EQ(judged(name).status, Status::kHeld) << name;
  for (const auto& [name, least] : {std::pair{"channel-bow-tie.obj", .03},
                                    {"channel-dependent-seam.obj", .004},
                                    {"channel-dependent-vertex.obj", .01}})
    EXPECT_GE(judged(name).worst.value_or(0), least) << name;
}

TEST_F(Blender, HasNoChaikinCreasing) {
  EXPECT_EQ(subdivide("chaikin-edge.obj"), 3);
}

}  // namespace
}  // namespace limitcheck::verify
