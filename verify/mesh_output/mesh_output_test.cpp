// SPDX-License-Identifier: MIT
// What is written is read back by readers that are not ours (Assimp), and by the project's own.
#include "verify/mesh_output/mesh_output.h"

#include <gtest/gtest.h>

#include <assimp/scene.h>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "data/error.h"
#include "data/io/read.h"
#include "data/shapes.h"
#include "data/test_support/assertions.h"
#include "data/validate.h"

namespace limitcheck::verify {
namespace {

namespace fs = std::filesystem;

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
  const TestFolder directory;
  const auto mesh = sample();
  for (const char* extension : {"ply", "obj"}) {
    const fs::path file = directory / (std::string("plain.") + extension);
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
  const TestFolder directory;
  const auto mesh = sample();
  for (const char* extension : {"ply", "obj", "glb"}) {
    for (const bool coloured : {false, true}) {
      const fs::path file = directory / (std::string("assimp.") + extension);
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
  const TestFolder directory;
  const auto mesh = sample();
  const Colouring colouring = colour_by_kind(mesh);
  const fs::path file = directory / "colours.ply";
  write_tessellation(file, mesh, colouring);
  const std::string text = contents_of(file);
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
  const TestFolder directory;
  for (const char* extension : {"ply", "obj", "glb"}) {
    const fs::path file = directory / (std::string("nothing.") + extension);
    write_tessellation(file, {});
    EXPECT_TRUE(fs::exists(file));
  }
  EXPECT_EQ(directory.files(), 3u);
}

TEST(MeshOutput, RefusesUnknownExtensionsAndPlacesItCannotWriteTo) {
  const auto code = [](const fs::path& file) {
    return thrown<data::InputError>([&] { write_tessellation(file, sample()); }).value().code();
  };
  const TestFolder directory;
  EXPECT_EQ(code(directory / "mesh.stl"), "FILE_UNKNOWN_FORMAT");
  EXPECT_EQ(code(directory / "mesh"), "FILE_UNKNOWN_FORMAT");
  EXPECT_EQ(code(directory / "absent" / "mesh.ply"), "FILE_CANNOT_WRITE");
  fs::create_directory(directory / "directory.ply");
  EXPECT_EQ(code(directory / "directory.ply"), "FILE_CANNOT_WRITE");
  for (const char* name : {"full.ply", "full.obj", "full.glb"}) {  // a full disk
    fs::create_symlink("/dev/full", directory / name);
    EXPECT_EQ(code(directory / name), "FILE_CANNOT_WRITE") << name;
  }
  EXPECT_EQ(directory.files(), 4u) << "nothing but what was there before";
}

}  // namespace
}  // namespace limitcheck::verify
