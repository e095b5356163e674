// SPDX-License-Identifier: MIT
// Files that Blender writes of cages with sharp edges: examples/blender_subdivide.py. Skipped without Blender.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "data/io/read.h"
#include "verify/files/test_files.h"

namespace limitcheck::verify {
namespace {

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
    FilesOptions options;
    options.scheme = data::Scheme::kCatmullClark;
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

TEST_F(Blender, HasNoChaikinCreasing) {
  EXPECT_EQ(subdivide("chaikin-edge.obj"), 3);
}

}  // namespace
}  // namespace limitcheck::verify
