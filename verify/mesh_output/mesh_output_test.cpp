// SPDX-License-Identifier: MIT
// What is written is read back by readers that are not ours (Assimp), and by the project's own.
#include "verify/mesh_output/mesh_output.h"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <assimp/scene.h>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <tuple>

#include "data/error.h"
#include "data/io/atomic_file.h"
#include "data/io/read.h"
#include "data/shapes.h"
#include "data/validate.h"

namespace limitcheck::verify {
namespace {

namespace fs = std::filesystem;

struct Directory {
  Directory() {
    std::string name = (fs::temp_directory_path() / "limitcheck-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~Directory() { fs::remove_all(path); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator{}));
  }
  fs::path path;
};

/// An icosahedron as a tessellation would be: numbers that need all their digits, faces of different kinds
/// and depths.
fast::IndexedMesh<float> sample() {
  const data::ControlMesh shape = data::icosahedron();
  fast::IndexedMesh<float> mesh;
  for (const auto& p : shape.positions) {
    const double size = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    const auto f = [](double x) { return static_cast<float>(x / 3); };
    const auto n = [size](double x) { return static_cast<float>(x / size); };
    mesh.vertices.push_back({{f(p[0]), f(p[1]), f(p[2])}, {n(p[0]), n(p[1]), n(p[2])}});
  }
  for (std::size_t t = 0; t < shape.faces.size(); ++t) {
    const auto& [a, b, c] = triangles_of(shape)[t];
    mesh.triangles.push_back(
        {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
    mesh.triangle_face.push_back(static_cast<std::int32_t>(t));
    mesh.triangle_kind.push_back(t % 5 == 0 ? fast::Kind::kFan : fast::Kind::kPair);
  }
  return mesh;
}

std::vector<std::int32_t> sample_depths() {
  std::vector<std::int32_t> depth(20);
  for (std::size_t f = 0; f < depth.size(); ++f) depth[f] = static_cast<std::int32_t>(f % 4);
  return depth;
}

using Point = std::array<float, 3>;

/// A triangle by its corners' positions, the smallest first, its sense of rotation kept.
std::array<Point, 3> by_position(Point a, Point b, Point c) {
  while (b < a || c < a) std::tie(a, b, c) = std::tuple(b, c, a);
  return {a, b, c};
}

std::set<std::array<Point, 3>> triangles_of(const fast::IndexedMesh<float>& mesh) {
  std::set<std::array<Point, 3>> result;
  const auto at = [&](std::uint32_t v) {
    const auto& p = mesh.vertices[v].position;
    return Point{p.x, p.y, p.z};
  };
  for (const auto& t : mesh.triangles) result.insert(by_position(at(t[0]), at(t[1]), at(t[2])));
  return result;
}

TEST(MeshOutput, IsReadBackBitForBitAndWatertightByTheMeshReader) {
  const Directory directory;
  const auto mesh = sample();
  for (const char* extension : {"ply", "obj"}) {
    const fs::path file = directory.path / (std::string("plain.") + extension);
    write_tessellation(file, mesh);
    const data::ControlMesh back = data::read_mesh(file);  // validated: closed, manifold, oriented
    ASSERT_EQ(back.positions.size(), mesh.vertices.size());
    ASSERT_EQ(back.faces.size(), mesh.triangles.size());
    for (std::size_t v = 0; v < back.positions.size(); ++v) {
      const auto& p = mesh.vertices[v].position;
      EXPECT_EQ(static_cast<float>(back.positions[v][0]), p.x);
      EXPECT_EQ(static_cast<float>(back.positions[v][1]), p.y);
      EXPECT_EQ(static_cast<float>(back.positions[v][2]), p.z);
    }
    for (std::size_t t = 0; t < back.faces.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(static_cast<std::uint32_t>(triangles_of(back)[t][k]), mesh.triangles[t][k]);
      }
    }
  }
}

TEST(MeshOutput, IsReadByAssimpWithItsNormalsAndOneMaterialPerClass) {
  const Directory directory;
  const auto mesh = sample();
  for (const char* extension : {"ply", "obj", "glb"}) {
    for (const bool coloured : {false, true}) {
      const fs::path file = directory.path / (std::string("assimp.") + extension);
      write_tessellation(file, mesh, coloured ? colour_by_depth(mesh, sample_depths()) : Colouring{});
      Assimp::Importer importer;
      const aiScene* scene = importer.ReadFile(file.string(), 0);
      ASSERT_NE(scene, nullptr) << extension << ": " << importer.GetErrorString();
      std::size_t faces = 0;
      std::set<std::array<Point, 3>> triangles;
      std::map<std::string, std::size_t> by_material;
      for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
        const aiMesh& part = *scene->mMeshes[m];
        faces += part.mNumFaces;
        by_material[scene->mMaterials[part.mMaterialIndex]->GetName().C_Str()] += part.mNumFaces;
        ASSERT_TRUE(part.HasNormals()) << extension;
        for (unsigned f = 0; f < part.mNumFaces; ++f) {
          ASSERT_EQ(part.mFaces[f].mNumIndices, 3u);
          const auto at = [&](unsigned k) {
            const aiVector3D& p = part.mVertices[part.mFaces[f].mIndices[k]];
            return Point{p.x, p.y, p.z};
          };
          triangles.insert(by_position(at(0), at(1), at(2)));
          for (unsigned k = 0; k < 3; ++k) {
            const unsigned v = part.mFaces[f].mIndices[k];
            // Of an icosahedron round the origin: the normal is the direction of the position.
            aiVector3D p = part.mVertices[v];
            p.Normalize();
            EXPECT_LE((p - part.mNormals[v]).Length(), 1e-6) << extension << " vertex " << v;
          }
        }
      }
      EXPECT_EQ(faces, 20u) << extension;
      EXPECT_TRUE(triangles == triangles_of(mesh)) << extension;
      if (coloured && std::string(extension) != "ply") {
        EXPECT_EQ(by_material, (std::map<std::string, std::size_t>{
                                   {"depth_0", 5}, {"depth_1", 5}, {"depth_2", 5}, {"depth_3", 5}}))
            << extension;
      }
    }
  }
}

TEST(MeshOutput, OfPlyCarriesTheColoursOfTheFaces) {
  const Directory directory;
  const auto mesh = sample();
  const Colouring colouring = colour_by_kind(mesh);
  const fs::path file = directory.path / "colours.ply";
  write_tessellation(file, mesh, colouring);
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t start = text.find("end_header\n") + 11 + 24 * mesh.vertices.size();
  ASSERT_EQ(text.size(), start + 16 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& rgb = colouring.classes[t % 5 == 0 ? 2 : 0].rgb;  // fan, pair
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(static_cast<std::uint8_t>(text[start + 16 * t + 13 + i]), rgb[i]) << "triangle " << t;
    }
  }
}

TEST(MeshOutput, OfNothingIsAValidFileOfNothing) {
  const Directory directory;
  for (const char* extension : {"ply", "obj", "glb"}) {
    const fs::path file = directory.path / (std::string("nothing.") + extension);
    write_tessellation(file, {});
    EXPECT_TRUE(fs::exists(file));
  }
  EXPECT_EQ(directory.files(), 3u);
}

TEST(MeshOutput, RefusesUnknownExtensionsAndPlacesItCannotWriteTo) {
  const auto code = [](const fs::path& file) {
    try {
      write_tessellation(file, sample());
    } catch (const data::InputError& error) {
      return error.code();
    }
    return std::string("written");
  };
  const Directory directory;
  EXPECT_EQ(code(directory.path / "mesh.stl"), "FILE_UNKNOWN_FORMAT");
  EXPECT_EQ(code(directory.path / "mesh"), "FILE_UNKNOWN_FORMAT");
  EXPECT_EQ(code(directory.path / "absent" / "mesh.ply"), "FILE_CANNOT_WRITE");
  fs::create_directory(directory.path / "directory.ply");
  EXPECT_EQ(code(directory.path / "directory.ply"), "FILE_CANNOT_WRITE");
  for (const char* name : {"full.ply", "full.obj", "full.glb"}) {  // a full disk
    fs::create_symlink("/dev/full", directory.path / name);
    EXPECT_EQ(code(directory.path / name), "FILE_CANNOT_WRITE") << name;
  }
  EXPECT_EQ(directory.files(), 4u) << "nothing but what was there before";
}

TEST(AtomicFile, WithoutCommitLeavesTheOldFileAndNothingElse) {
  const Directory directory;
  const fs::path file = directory.path / "kept.txt";
  std::ofstream(file) << "old";
  { data::AtomicFile(file).stream() << "new"; }
  std::string content;
  std::ifstream(file) >> content;
  EXPECT_EQ(content, "old");
  EXPECT_EQ(directory.files(), 1u);
  {
    data::AtomicFile output(file);
    output.stream() << "new";
    output.commit();
  }
  std::ifstream(file) >> content;
  EXPECT_EQ(content, "new");
  EXPECT_EQ(directory.files(), 1u);
}

TEST(AtomicFile, ASignalInTheMiddleRemovesTheTemporaryAndEndsTheProcessByThatSignal) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const Directory directory;
    const pid_t child = fork();
    if (child == 0) {
      data::AtomicFile output(directory.path / "half.txt");
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

}  // namespace
}  // namespace limitcheck::verify
