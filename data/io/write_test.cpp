// SPDX-License-Identifier: MIT
#include "data/io/write.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <fstream>

#include "data/error.h"
#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

namespace fs = std::filesystem;

// An empty folder of its own for each test.
fs::path folder() {
  const fs::path path =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::remove_all(path);
  fs::create_directories(path);
  return path;
}

std::string code_of(const fs::path& file) {
  try {
    write_mesh(file, tetrahedron());
  } catch (const InputError& error) {
    return error.code();
  }
  return "written";
}

// Doubles of every magnitude, subnormal ones and both zeros included.
ControlMesh mesh_of_any_doubles() {
  ControlMesh mesh = wheel(100, 8);
  SplitMix64 random(42);
  for (auto& position : mesh.positions) {
    for (double& x : position) {
      do x = std::bit_cast<double>(random.next());
      while (!std::isfinite(x));
    }
  }
  mesh.positions[0] = {-0.0, 0x1p-1074, -0x1.fffffffffffffp1023};
  return mesh;
}

void expect_same_bits(const ControlMesh& a, const ControlMesh& b) {
  ASSERT_EQ(a.positions.size(), b.positions.size());
  for (std::size_t v = 0; v < a.positions.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(a.positions[v][axis]),
                std::bit_cast<std::uint64_t>(b.positions[v][axis]))
          << "vertex " << v << ": " << a.positions[v][axis] << " and " << b.positions[v][axis];
    }
  }
  EXPECT_EQ(a.faces, b.faces);
}

TEST(Write, WhatIsReadBackIsTheSameBitForBit) {
  const ControlMesh mesh = mesh_of_any_doubles();
  for (const char* name : {"mesh.obj", "mesh.off", "mesh.ply", "MESH.PLY"}) {
    const fs::path file = folder() / name;
    write_mesh(file, mesh);
    expect_same_bits(read_mesh(file), mesh);
    const fs::path text = folder() / name;
    write_mesh(text, mesh, {.ascii_ply = true});
    expect_same_bits(read_mesh(text), mesh);
  }
}

TEST(Write, PolygonsAreReadBackAsTheyWere) {
  ControlMesh mesh = polygon_prism(300);  // more corners than a byte counts
  mesh.faces.push_back({600, 601, 602});
  for (int i = 0; i < 3; ++i) mesh.positions.push_back({0.1 * i, 7, i * i / 3.});
  for (const ControlMesh& one : {quad_cube(), polygon_prism(5), mesh})
    for (const FileFormat format : {FileFormat::kObj, FileFormat::kOff, FileFormat::kPly})
      for (const bool ascii : {false, true})
        expect_same_bits(read_mesh(mesh_content(one, format, {.ascii_ply = ascii}), format, "text"), one);
}

TEST(Write, AFileAppearsUnderItsNameOnly) {
  const fs::path place = folder();
  write_mesh(place / "a.obj", tetrahedron());
  write_mesh(place / "a.obj", octahedron());  // over the old one
  EXPECT_EQ(read_mesh(place / "a.obj").faces.size(), 8u);
  EXPECT_EQ(std::distance(fs::directory_iterator(place), {}), 1);
}

TEST(Write, AFullDiskIsAnError) {
  // What cannot be renamed into place is written to directly: a link to the device that is always full.
  const fs::path file = folder() / "full.obj";
  fs::create_symlink("/dev/full", file);
  EXPECT_EQ(code_of(file), "FILE_CANNOT_WRITE");
}

TEST(Write, WhatCannotBeWrittenIsAnErrorAndLeavesNothing) {
  EXPECT_EQ(code_of("/nowhere/at/all.obj"), "FILE_CANNOT_WRITE");
  EXPECT_EQ(code_of(folder() / "a.stl"), "FILE_UNSUPPORTED");
  EXPECT_EQ(code_of(folder() / "a.txt"), "FILE_UNKNOWN_FORMAT");
  const fs::path place = folder();
  fs::create_directories(place / "folder.obj");
  EXPECT_EQ(code_of(place / "folder.obj"), "FILE_CANNOT_WRITE");
  EXPECT_EQ(std::distance(fs::directory_iterator(place), {}), 1);
}

TEST(Write, ThePlyHeaderIsTheOneOfTheFormat) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string content = mesh_content(tetrahedron(), FileFormat::kPly);
  EXPECT_EQ(content.substr(0, header.size()), header);
  EXPECT_EQ(content.size(), header.size() + 4 * 24 + 4 * 13);
}

}  // namespace
}  // namespace limitcheck::data
