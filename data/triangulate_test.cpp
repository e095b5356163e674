// SPDX-License-Identifier: MIT
#include "data/triangulate.h"

#include <gtest/gtest.h>

#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

TEST(Triangulate, EveryTriangleNamesTheFaceThatItWasCutFrom) {
  const ControlMesh prism = polygon_prism(5);  // two pentagons, five quads
  const Triangulated cut = triangulate(prism, Triangulation::kFan);
  EXPECT_EQ(cut.cut, 7);
  EXPECT_EQ(cut.face, (std::vector<std::int64_t>{0, 0, 0, 1, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6}));
  EXPECT_TRUE(validate({prism.positions, cut.faces}, Scheme::kLoop).empty());
  for (std::size_t t = 0; t < 3; ++t)
    EXPECT_EQ(cut.faces[t][0], prism.faces[0][0]) << "a fan starts at the first corner";
}

TEST(Triangulate, TakesQuadsThatNameVerticesWhichDoNotExist) {
  const ControlMesh mesh{quad_cube().positions, {{0, 1, 99, 3}, {0, -1, 2, 3}}};
  EXPECT_EQ(triangulate(mesh, Triangulation::kShortestDiagonal).faces,
            (Faces{{0, 1, 99}, {0, 99, 3}, {0, -1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, TrianglesAndWhatIsToBeKeptStayWhatTheyAre) {
  for (const Triangulation rule : {Triangulation::kFan, Triangulation::kShortestDiagonal}) {
    const Triangulated same = triangulate(octahedron(), rule);
    EXPECT_EQ(same.faces, octahedron().faces);
    EXPECT_EQ(same.cut, 0);
  }
  EXPECT_EQ(triangulate(quad_cube(), Triangulation::kKeep).faces, quad_cube().faces);
}

}  // namespace
}  // namespace limitcheck::data
