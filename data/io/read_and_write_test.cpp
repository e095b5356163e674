// SPDX-License-Identifier: MIT
// Every file of malformed/ and wellformed/ does what its name says.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "data/error.h"
#include "data/generators/polygon_meshes.h"
#include "data/io/atomic_file.h"
#include "data/io/read.h"
#include "data/io/write.h"
#include "data/shapes.h"
#include "data/splitmix64.h"
#include "data/test_support/assertions.h"

namespace limitcheck::data {
namespace {

std::string wellformed(const std::string& name) {
  return LIMITCHECK_SOURCE_DIR "/data/wellformed/" + name;
}

std::string error_of(const std::string& content, FileFormat format = FileFormat::kObj,
                     ReadOptions options = {}) {
  return refusal_of<InputError>([&] { read_mesh(content, format, "cage.obj", options); });
}

TEST(Read, ErrorsNameFileLineCodeAndElements) {
  EXPECT_EQ(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\n\nf 1 2 5\n"),
            "cage.obj:9: MESH_NONMANIFOLD_EDGE: edge 1–2 has 3 faces (1, 2, 3) (numbers from 1)");
  // Other formats count from 0.
  EXPECT_EQ(error_of("OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n",
                     FileFormat::kOff),
            "cage.obj:10: MESH_NONMANIFOLD_EDGE: edge 0–1 has 3 faces (0, 1, 2) (numbers from 0)");
}

// The face in the second line was lost, and with it nothing said so.
TEST(Read, ACommentIsNotContinuedByABackslash) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const auto faces = [&](const std::string& text) {
    return read_mesh(vertices + text, FileFormat::kObj, "text").faces.size();
  };
  EXPECT_EQ(faces("# from C:\\models\\\nf 1 2 3\nf 1 3 4\n"), 2U);
  EXPECT_EQ(faces("f 1 2 3 # the first \\\nf 1 3 4\n"), 2U);
  EXPECT_EQ(faces("f 1 2 \\\n3 # the first \\\nf 1 3 4\n"), 2U);
  EXPECT_EQ(faces("f 1 2 \\\n3\nf 1 3 4\n"), 2U) << "but what is no comment is";
}

TEST(Read, AByteOrderMarkIsReadOver) {
  const std::string mark = "\xEF\xBB\xBF", obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  EXPECT_EQ(read_mesh(mark + obj, FileFormat::kObj, "text").faces.size(), 1U);
  EXPECT_EQ(
      read_mesh(mark + "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n", FileFormat::kOff, "text").faces.size(),
      1U);
  EXPECT_NE(error_of(obj + mark), "accepted") << "at the beginning, that is";
}

TEST(Read, MoreThanOneFaultIsCounted) {
  EXPECT_EQ(error_of("v nan 0 0\nv 1 0 0\nv 0 1 0\nv 0 inf 0\nf 1 2 3\n"),
            "cage.obj:1: MESH_NOT_FINITE: vertex 1 lies at (nan, 0, 0) (numbers from 1); 2 more faults");
}

// STL has its vertices in the order in which they appear.
TEST(Read, EveryFormOfATetrahedronIsTheSameTetrahedron) {
  const auto corner = [](double z) {
    return ControlMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, z}},
                       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  };
  const ControlMesh of_stl{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                           {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {1, 0, 3}}};
  const std::vector<std::pair<ControlMesh, std::vector<std::string>>> forms{
      {tetrahedron(),
       {"obj", "crlf.obj", "cr_only.obj", "no_last_newline.obj", "negative_indices.obj", "faces_first.obj",
        "continued.obj", "everything.obj"}},
      {corner(1), {"off", "counts_beside.off", "comments_and_colours.off", "coff.off", "stcnoff.off"}},
      {corner(0.1), {"ascii.ply", "little.ply", "big.ply", "crlf.ply", "faces_first.ply"}},
      {corner(0.1F), {"float_and_more.ply"}},
      {of_stl, {"stl", "begins_with_solid.stl", "ascii.stl", "upper_case.stl", "minus_zero.stl"}}};
  for (const auto& [expected, names] : forms)
    for (const std::string& name : names)
      EXPECT_EQ(read_mesh(wellformed("tetrahedron.v4.f4." + name)), expected) << name;
}

// Expected values: hexadecimal floating point, which no decimal reader is involved in.
TEST(Read, DecimalsAreCorrectlyRounded) {
  const ControlMesh mesh = read_mesh(
      "v 0.1 1e-400 2.2250738585072011e-308\nv 9007199254740993 5e-324 -0\n"
      "v 0.500000000000000166533453693773481063544750213623046875 1.7976931348623157e308 +3\nf 1 2 3\n",
      FileFormat::kObj, "text");
  const auto& p = mesh.positions;
  EXPECT_EQ(p[0], (std::array<double, 3>{0x1.999999999999ap-4, 0.0, 0x0.fffffffffffffp-1022}));
  EXPECT_EQ(p[1], (std::array<double, 3>{0x1p53, 0x1p-1074, 0.0}));
  EXPECT_TRUE(std::signbit(p[1][2]));
  EXPECT_EQ(p[2], (std::array<double, 3>{0x1.0000000000002p-1, 0x1.fffffffffffffp1023, 3.0}));
}

TEST(Read, PolygonsStayWhatTheyAreUnlessTheyAreToBeCut) {
  EXPECT_EQ(read_mesh(wellformed("pentagon.v5.f1.obj")).faces, (Faces{{0, 1, 2, 3, 4}}));
  EXPECT_EQ(read_mesh(wellformed("pentagon.v5.f1.obj"), {Triangulation::kFan}).faces,
            (Faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(Read, PolygonsAreRefusedForLoopsSchemeUnlessTheyAreCut) {
  const std::string quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  EXPECT_EQ(
      error_of(quad, FileFormat::kObj, {Triangulation::kKeep, Scheme::kLoop}),
      "cage.obj:5: MESH_POLYGON: face 1 has 4 corners; Loop's scheme takes triangles only (numbers from 1)");
  EXPECT_EQ(error_of(quad, FileFormat::kObj, {Triangulation::kFan, Scheme::kLoop}), "accepted");
  EXPECT_EQ(error_of(quad, FileFormat::kObj, {Triangulation::kKeep, Scheme::kCatmullClark}), "accepted");
}

// [C09] The same quad, its diagonals 0-2 and 1-3 of lengths sqrt(a^2 + 1) and 2.
TEST(Read, QuadsAreCutAlongTheShorterDiagonalOnRequest) {
  const auto cut = [](const std::string& x) {
    return read_mesh("v -1 0 0\nv 0 -1 0\nv " + x + " 0 0\nv 0 1 0\nf 1 2 3 4\n", FileFormat::kObj, "text",
                     {Triangulation::kShortestDiagonal})
        .faces;
  };
  EXPECT_EQ(cut("2"), (Faces{{1, 2, 3}, {1, 3, 0}}));    // 3 against 2
  EXPECT_EQ(cut("0.5"), (Faces{{0, 1, 2}, {0, 2, 3}}));  // 1.5 against 2
  EXPECT_EQ(cut("1"), (Faces{{0, 1, 2}, {0, 2, 3}}));    // equal
}

// Two quads that share two opposite corners, 1 and 3, with two triangles between them. Cut from their first
// corners both meet in the edge 1-3.
TEST(Read, WhatIsValidAsPolygonsIsValidatedAgainWhenItIsCut) {
  const std::string text =
      "v 0 0 0\nv 1 -1 0\nv 2 0 0\nv 1 1 0\nv 1 1 1\nv 1 -1 1\n"
      "f 1 2 3 4\nf 1 5 3 6\nf 1 4 5\nf 4 3 5\n";
  EXPECT_EQ(error_of(text), "accepted");
  EXPECT_EQ(error_of(text, FileFormat::kObj, {Triangulation::kFan}),
            "cage.obj:8: MESH_NONMANIFOLD_EDGE: edge 1–3 has 4 faces (1, 1, 2, 2) (numbers from 1)");
}

TEST(Read, AFileThatIsNotOneCannotBeOpened) {
  const auto code = [](const std::string& file) {
    return thrown<InputError>([&] { read_mesh(file); }).value().code();
  };
  EXPECT_EQ(code("/nowhere/cage.obj"), "FILE_CANNOT_OPEN");
  EXPECT_EQ(code(LIMITCHECK_SOURCE_DIR "/data/known_answers.json"), "FILE_UNKNOWN_FORMAT");
  EXPECT_EQ(code("cage"), "FILE_UNKNOWN_FORMAT");
  const std::string folder = testing::TempDir() + "folder.obj";
  std::filesystem::create_directories(folder);
  EXPECT_EQ(code(folder), "FILE_CANNOT_OPEN");
}

namespace fs = std::filesystem;

std::string code_of(const fs::path& file) {
  const auto refused = thrown<InputError>([&] { write_mesh(file, tetrahedron()); });
  return refused ? refused->code() : "written";
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
  const TestFolder folder;
  for (const char* name : {"mesh.obj", "mesh.off", "mesh.ply", "MESH.PLY"}) {
    const fs::path file = folder / name;
    write_mesh(file, mesh);
    expect_same_bits(read_mesh(file), mesh);
    const fs::path text = folder / name;
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
  const TestFolder folder;
  write_mesh(folder / "a.obj", tetrahedron());
  write_mesh(folder / "a.obj", octahedron());  // over the old one
  EXPECT_EQ(read_mesh(folder / "a.obj").faces.size(), 8u);
  EXPECT_EQ(folder.files(), 1U);
}

TEST(Write, AFullDiskIsAnError) {
  // What cannot be renamed into place is written to directly: a link to the device that is always full.
  const TestFolder folder;
  fs::create_symlink("/dev/full", folder / "full.obj");
  EXPECT_EQ(code_of(folder / "full.obj"), "FILE_CANNOT_WRITE");
}

TEST(Write, WhatCannotBeWrittenIsAnErrorAndLeavesNothing) {
  EXPECT_EQ(code_of("/nowhere/at/all.obj"), "FILE_CANNOT_WRITE");
  const TestFolder folder;
  EXPECT_EQ(code_of(folder / "a.stl"), "FILE_UNSUPPORTED");
  EXPECT_EQ(code_of(folder / "a.txt"), "FILE_UNKNOWN_FORMAT");
  fs::create_directories(folder / "folder.obj");
  EXPECT_EQ(code_of(folder / "folder.obj"), "FILE_CANNOT_WRITE");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(Write, ThePlyHeaderIsTheOneOfTheFormat) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string content = mesh_content(tetrahedron(), FileFormat::kPly);
  EXPECT_EQ(content.substr(0, header.size()), header);
  EXPECT_EQ(content.size(), header.size() + 4 * 24 + 4 * 13);
}

TEST(AtomicFile, WithoutCommitLeavesTheOldFileAndNothingElse) {
  const TestFolder directory;
  const fs::path file = directory / "kept.txt";
  std::ofstream(file) << "old";
  { AtomicFile(file).stream() << "new"; }
  EXPECT_EQ(contents_of(file), "old");
  EXPECT_EQ(directory.files(), 1u);
  {
    AtomicFile output(file);
    output.stream() << "new";
    output.commit();
  }
  EXPECT_EQ(contents_of(file), "new");
  EXPECT_EQ(directory.files(), 1u);
}

TEST(AtomicFile, ASignalInTheMiddleRemovesTheTemporaryAndEndsTheProcessByThatSignal) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TestFolder directory;
    const pid_t child = fork();
    if (child == 0) {
      AtomicFile output(directory / "half.txt");
      output.stream() << "half" << std::flush;
      raise(signal);
      _exit(77);  // not reached
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << signal;
    EXPECT_EQ(WTERMSIG(status), signal);
    EXPECT_EQ(directory.files(), 0u) << signal;
  }
}

std::vector<fs::path> files_of(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(LIMITCHECK_SOURCE_DIR "/data/" + folder))
    files.push_back(entry);
  std::sort(files.begin(), files.end());
  return files;
}

std::string test_name(const testing::TestParamInfo<fs::path>& info) {
  std::string name = info.param.filename().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

// CODE.lineN[.what].extension
class MalformedFile : public testing::TestWithParam<fs::path> {};

TEST_P(MalformedFile, IsRefusedWithTheCodeAndTheLineOfItsName) {
  const fs::path file = GetParam();
  const std::string name = file.filename().string();
  const std::size_t dot = name.find('.');
  ASSERT_EQ(name.substr(dot, 5), ".line");
  const auto error = thrown<InputError>([&] { read_mesh(file); });
  ASSERT_TRUE(error) << "accepted";
  const std::string what = error->what();
  EXPECT_EQ(error->code(), name.substr(0, dot)) << what;
  EXPECT_EQ(error->line(), std::stoll(name.substr(dot + 5))) << what;
  EXPECT_EQ(error->file(), file.string());
  const std::string line = error->line() > 0 ? ":" + std::to_string(error->line()) : "";
  EXPECT_TRUE(what.starts_with(file.string() + line + ": " + error->code() + ": ")) << what;
  EXPECT_FALSE(says(what, "\n"));
}

INSTANTIATE_TEST_SUITE_P(Files, MalformedFile, testing::ValuesIn(files_of("malformed")), test_name);

// shape.vV.fF[.what].extension
class WellformedFile : public testing::TestWithParam<fs::path> {};

TEST_P(WellformedFile, IsReadWithTheCountsOfItsName) {
  const std::string name = GetParam().filename().string();
  const std::size_t v = name.find(".v"), f = name.find(".f", v);
  ASSERT_NE(f, std::string::npos);
  const ControlMesh mesh = read_mesh(GetParam());
  EXPECT_EQ(mesh.positions.size(), std::stoul(name.substr(v + 2)));
  EXPECT_EQ(mesh.faces.size(), std::stoul(name.substr(f + 2)));
}

INSTANTIATE_TEST_SUITE_P(Files, WellformedFile, testing::ValuesIn(files_of("wellformed")), test_name);

}  // namespace
}  // namespace limitcheck::data
