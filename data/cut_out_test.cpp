// SPDX-License-Identifier: MIT
// What is cut out of a valid mesh is valid, whatever the faces; and nothing else is changed.
#include "data/cut_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "data/shapes.h"
#include "data/splitmix64.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

TEST(CutOut, AnyFacesOfAValidMeshAreAValidMeshWithTheSameCorners) {
  SplitMix64 random(7);
  for (const ControlMesh& whole : {tetrahedron(), octahedron(), torus(3, 3), bipyramid(3), bipyramid(5),
                                   holes(), wheel(7), two_components()})
    for (int attempt = 0; attempt < 100; ++attempt) {
      std::vector<std::int32_t> faces;
      for (std::size_t f = 0; f < whole.triangles.size(); ++f)
        if (random.next() % 3 == 0) faces.push_back(static_cast<std::int32_t>(f));
      if (faces.empty()) continue;
      std::reverse(faces.begin(), faces.end());
      const CutOut part = cut_out(whole.triangles, faces);
      ASSERT_EQ(part.triangles.size(), faces.size());
      for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_EQ(part.vertices[part.triangles[f][k]], whole.triangles[faces[f]][k]);
      const auto findings = validate({part.of(whole.positions), part.triangles});
      EXPECT_TRUE(findings.empty()) << findings.front().message;
    }
}

TEST(CutOut, AllFacesAreTheMeshItself) {
  const ControlMesh whole = torus(3, 3);
  std::vector<std::int32_t> faces;
  for (std::size_t f = 0; f < whole.triangles.size(); ++f) faces.push_back(static_cast<std::int32_t>(f));
  const CutOut part = cut_out(whole.triangles, faces);
  EXPECT_EQ(part.vertices.size(), whole.positions.size());
  EXPECT_EQ(std::set(part.vertices.begin(), part.vertices.end()).size(), whole.positions.size());
}

TEST(CutOut, FansThatNoEdgeHoldsTogetherGetAVertexEach) {
  // Vertex 0 joins three fans, of three faces, one and one: the first holds together over edges 2-0 and 0-3.
  std::vector<std::array<std::int32_t, 3>> triangles{{0, 1, 2}, {0, 3, 4}, {2, 3, 0}, {5, 0, 6}, {7, 8, 0}};
  const std::vector<std::int32_t> copies = split_fans(triangles, 9);
  EXPECT_EQ(copies, (std::vector<std::int32_t>{0, 0}));
  EXPECT_EQ(triangles, (std::vector<std::array<std::int32_t, 3>>{
                           {0, 1, 2}, {0, 3, 4}, {2, 3, 0}, {5, 9, 6}, {7, 8, 10}}));
}

}  // namespace
}  // namespace limitcheck::data
