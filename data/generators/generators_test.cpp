// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

#include "data/error.h"
#include "data/generators/bumpy_sphere.h"
#include "data/generators/named_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/surgery.h"
#include "data/io/write.h"
#include "data/shapes.h"
#include "data/summary.h"
#include "data/test_meshes.h"
#include "data/test_support/assertions.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

std::string refusal(const std::string& specification) {
  return refusal_of<InputError>([&] { named_mesh(specification); });
}
// The code of the refusal; "made" if there is none.
std::string code_of(const std::string& specification) {
  const auto refused = thrown<InputError>([&] { named_mesh(specification); });
  return refused ? refused->code() : "made";
}

// [C71]
TEST(Sec6_BumpySphere, HasTwiceItsVerticesMinusFourFacesAndIsAClosedManifold) {
  for (const int faces : {4, 6, 8, 20, 200, 800, 2000, 4000}) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const ControlMesh mesh = bumpy_sphere(faces, seed);
      EXPECT_EQ(mesh.faces.size(), static_cast<std::size_t>(faces));
      EXPECT_EQ(mesh.faces.size(), 2 * mesh.positions.size() - 4);
      EXPECT_TRUE(validate(mesh).empty());
    }
  }
}

TEST(Sec6_BumpySphere, HasRadiiUniformInTheirRange) {
  const ControlMesh mesh = bumpy_sphere(40000, 5);
  double least = 9, most = 0, sum = 0, sum_of_squares = 0;
  std::array<double, 3> direction_sum{};
  for (const auto& p : mesh.positions) {
    const double r = std::hypot(p[0], p[1], p[2]);
    least = std::min(least, r);
    most = std::max(most, r);
    sum += r;
    sum_of_squares += r * r;
    for (int axis = 0; axis < 3; ++axis) direction_sum[axis] += p[axis] / r;
  }
  const double n = static_cast<double>(mesh.positions.size()), mean = sum / n;
  EXPECT_GE(least, 0.5 - 1e-15);
  EXPECT_LE(most, 1.5 + 1e-15);
  EXPECT_LT(least, 0.501);
  EXPECT_GT(most, 1.499);
  // Five standard deviations of the mean of n uniform numbers, and of the mean direction.
  EXPECT_NEAR(mean, 1, 5 * std::sqrt(1 / 12.0 / n));
  EXPECT_NEAR(sum_of_squares / n - mean * mean, 1 / 12.0, 0.005);
  for (const double s : direction_sum) EXPECT_NEAR(s / n, 0, 5 * std::sqrt(1 / 3.0 / n));
}

// The triangulation by its definition: every other direction lies strictly below the plane of each face.
TEST(Sec6_BumpySphere, IsTriangulatedByTheConvexHullOfItsDirections) {
  const ControlMesh mesh = bumpy_sphere(200, 1);
  std::vector<std::array<long double, 3>> d;
  for (const auto& p : mesh.positions) {
    const long double r =
        std::sqrt((long double)p[0] * p[0] + (long double)p[1] * p[1] + (long double)p[2] * p[2]);
    d.push_back({p[0] / r, p[1] / r, p[2] / r});
  }
  for (const auto& t : triangles_of(mesh)) {
    const auto &a = d[t[0]], &b = d[t[1]], &c = d[t[2]];
    for (std::size_t v = 0; v < d.size(); ++v) {
      if (v == std::size_t(t[0]) || v == std::size_t(t[1]) || v == std::size_t(t[2])) continue;
      long double e[3][3];
      for (int k = 0; k < 3; ++k) e[0][k] = b[k] - a[k], e[1][k] = c[k] - a[k], e[2][k] = d[v][k] - a[k];
      const long double volume = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                                 e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                                 e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
      ASSERT_LT(volume, 0) << "face " << t[0] << " " << t[1] << " " << t[2] << ", vertex " << v;
    }
  }
}

// The values were obtained with g++ 12 and with clang 14, optimised and not; other compilers must
// give the same.
TEST(Sec6_BumpySphere, IsTheSameWithEveryCompiler) {
  EXPECT_EQ(hash(bumpy_sphere(200, 1)), 17125629784026909584u);
  EXPECT_EQ(hash(bumpy_sphere(4000, 7)), 5085880730706893398u);
  EXPECT_NE(hash(bumpy_sphere(200, 2)), hash(bumpy_sphere(200, 1)));
}

TEST(NamedMesh, EveryStockShapeIsTheSameWithEveryCompilerAndValid) {
  std::vector<ControlMesh> all;
  for (const std::string& name : stock_shapes()) expect_valid(all.emplace_back(named_mesh(name)), name);
  EXPECT_EQ(hash_of_all(all), 13078540767126251187u);
}

TEST(NamedMesh, ParametersFollowBehindColons) {
  EXPECT_EQ(hash(named_mesh("bumpy:800:3")), hash(bumpy_sphere(800, 3)));
  EXPECT_EQ(hash(named_mesh("bumpy:800")), hash(bumpy_sphere(800, 1)));
  EXPECT_EQ(hash(named_mesh("wheel:7")), hash(wheel(7, 3)));
  EXPECT_EQ(hash(named_mesh("wheel:7:1")), hash(wheel(7, 1)));
  EXPECT_EQ(hash(named_mesh("quad-cube")), hash(quad_cube()));
  EXPECT_EQ(hash(named_mesh("cube-quads")), hash(quad_cube()));
  EXPECT_EQ(hash(named_mesh("quad-torus")), hash(quad_torus(12, 6)));
  EXPECT_EQ(hash(named_mesh("quad-torus:5:4")), hash(quad_torus(5, 4)));
  EXPECT_EQ(hash(named_mesh("quad-wheel:7")), hash(quad_wheel(7, 1)));
  EXPECT_EQ(hash(named_mesh("quad-fan:3:9")), hash(quad_fan(3, 9)));
  EXPECT_EQ(hash(named_mesh("prism:5")), hash(polygon_prism(5)));
  EXPECT_EQ(hash(named_mesh("pawn")), hash(pawn(8)));
  EXPECT_EQ(hash(named_mesh("mixed-pawn:9")), hash(mixed_pawn(9)));
  EXPECT_EQ(hash(named_mesh("mixed:4")), hash(mixed_mesh(4)));
  EXPECT_EQ(hash(named_mesh("mixed:4:1000")), hash(mixed_mesh(4, {.faces = 1000})));
}

TEST(NamedMesh, TheDualIsThatOfAnyClosedMesh) {
  EXPECT_EQ(hash(named_mesh("dual:bumpy:4000")), hash(dual(bumpy_sphere(4000, 1))));
  EXPECT_EQ(hash(named_mesh("dual:cube-quads")), hash(dual(quad_cube())));
  EXPECT_EQ(hash(named_mesh("dual:dual:pawn:5")), hash(dual(dual(pawn(5)))));
  int made = 0, open = 0;
  for (int seed = 0; seed < 50; ++seed) {
    const std::string random = "random:" + std::to_string(seed);
    const bool closed = summarise(named_mesh(random)).boundary_edges == 0;
    EXPECT_EQ(code_of("dual:" + random), closed ? "made" : "NAME_BAD_PARAMETER") << random;
    if (closed) {
      EXPECT_TRUE(validate(named_mesh("dual:" + random)).empty()) << random;
    }
    ++(closed ? made : open);
  }
  EXPECT_GT(std::min(made, open), 10);
  for (const char* name : {"dual", "dual:", "dual:triangle", "dual:wheel", "dual:dual:"})
    EXPECT_EQ(code_of(name), "NAME_BAD_PARAMETER") << name;
  EXPECT_EQ(code_of("dual:nope"), "NAME_UNKNOWN");
}

TEST(NamedMesh, WhatCannotBeMadeIsAnError) {
  for (const char* name : {"", "nope", "Bumpy:800", "bumpy 800"})
    EXPECT_EQ(code_of(name), "NAME_UNKNOWN") << name;
  std::istringstream names(
      "bumpy bumpy: bumpy:801 bumpy:2 bumpy:-4 bumpy:8e2 bumpy:800:1:2 bumpy:800:x "
      "bumpy:18446744073709551615 "
      "tetrahedron:1 wheel wheel:2 wheel:5:0 wheel:1000000:100 wheel:99999999999999999999 "
      "wheel:4294967299 fan:0 fan:5:2000000000 bipyramid:2 torus:2:6 torus:6:2 torus:2000000000:2000000000 "
      "sheet:0:1 sheet:100000:100000 strip:0 strip:-1 handles:0 crowd:0 dart:2 corner:1 quad-cube:1 "
      "quad-torus:2:5 quad-torus:100000:100000 quad-wheel:2 quad-wheel:2000000000 quad-fan:0 prism prism:2 "
      "prism:2000000000 pawn:2 pawn:2000000000 mixed-pawn:-1 mixed mixed:1:0");
  for (std::string name; names >> name;) EXPECT_EQ(code_of(name), "NAME_BAD_PARAMETER") << name;
}

TEST(NamedMesh, ANumberThatIsTooLargeIsNamedAndNotCutDown) {
  EXPECT_EQ(refusal("bumpy:20:18446744073709551615"), "accepted");
  EXPECT_EQ(
      refusal("bumpy:20:18446744073709551616"),
      "NAME_BAD_PARAMETER: 18446744073709551616 is more than 18446744073709551615 (bumpy:FACES[:SEED])");
  EXPECT_EQ(refusal("wheel:4294967299"),
            "NAME_BAD_PARAMETER: 4294967299 is more than 2147483647 (wheel:N[:RINGS])");
  EXPECT_EQ(refusal("corner:1048577"), "NAME_BAD_PARAMETER: a corner has 2 to 1048576 sharp edges");
  EXPECT_EQ(code_of("turned:18446744073709551616:cube"), "NAME_BAD_PARAMETER");
  EXPECT_EQ(code_of("star:18446744073709551616:.3"), "NAME_BAD_PARAMETER");
}

// However long the name, reading it takes no stack.
TEST(NamedMesh, AMeshOfAMeshOfAMeshHasALimitThatIsStated) {
  const auto nested = [](int times, const std::string& word) {
    std::string name;
    for (int k = 0; k < times; ++k) name += word;
    return refusal(name + "icosahedron");
  };
  for (const std::string word : {"dual:", "stretched:1:", "handled:0:", "turned:1:", "tagged:1:"}) {
    EXPECT_EQ(nested(32, word), "accepted") << word;
    for (const int times : {33, 10'000, 100'000})
      EXPECT_EQ(nested(times, word),
                "NAME_BAD_PARAMETER: a mesh is made of another one, and that of another, 32 times at most")
          << word;
  }
}

TEST(NamedMesh, EveryListedNameExists) {
  for (const NamedMesh& listed : named_meshes()) {
    const std::string name = listed.name.substr(0, listed.name.find_first_of(":["));
    EXPECT_NE(code_of(name), "NAME_UNKNOWN") << name;
  }
}

TEST(OpenMesh, TakesAFileOrAName) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "open_mesh.obj";
  write_mesh(file, icosahedron());
  EXPECT_EQ(hash(open_mesh(file.string()).mesh), hash(icosahedron()));
  EXPECT_EQ(hash(open_mesh("icosahedron").mesh), hash(icosahedron()));
  for (const char* star : {"star:1:J.J.3", "quad-star:1:w=J.J./5-3", "stretched:2:star:1:o..", "star:1:.3"})
    EXPECT_EQ(hash(open_mesh(star).mesh), hash(named_mesh(star))) << star;
  EXPECT_EQ(thrown<InputError>([] { open_mesh("missing.obj"); }).value().code(), "FILE_CANNOT_OPEN");
}

TEST(OpenMesh, CutsPolygonsOfFilesAndNamesAlikeIfItIsAskedTo) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "open_prism.obj";
  write_mesh(file, polygon_prism(5));
  for (const std::string& name : {file.string(), std::string("prism:5")}) {
    EXPECT_EQ(open_mesh(name).mesh, polygon_prism(5)) << name;
    EXPECT_EQ(open_mesh(name).cut, 0) << name;
    const OpenedMesh cut = open_mesh(name, {Triangulation::kFan, Scheme::kLoop});
    EXPECT_EQ(cut.cut, 7) << name;
    EXPECT_EQ(cut.mesh.faces.size(), 16U) << name;
    const auto refused = thrown<InputError>([&] { open_mesh(name, {Triangulation::kKeep, Scheme::kLoop}); });
    EXPECT_EQ(refused.value().code(), "MESH_POLYGON") << name;
  }
}

// Surgery of faces leaves channels behind: what is left has no corner beyond its faces.
TEST(Channels, AreNotThoseOfOtherFaces) {
  for (const char* name : {"handled:2:uv-torus", "turned:1:uv-torus"}) {
    EXPECT_TRUE(named_mesh(name).channels.empty()) << name;
  }
}

}  // namespace
}  // namespace limitcheck::data
