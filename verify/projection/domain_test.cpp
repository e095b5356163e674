// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "data/shapes.h"
#include "verify/evidence/vector.h"
#include "verify/projection/domain.h"

namespace limitcheck::verify {
namespace {

// Two triangles (0 1 2), (1 3 2): the edge 1-2 inside, the rest boundary.
const data::ControlMesh kTwo{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};

TEST(Domain, KnowsTheFaceAcrossAnEdgeAndTheBoundary) {
  const Domain d(kTwo);
  EXPECT_EQ(d.across(0, 0), 1);
  EXPECT_EQ(d.across(1, 1), 0);
  EXPECT_EQ(d.across(0, 1), -1);
  EXPECT_EQ(d.faces_at(1).size(), 2U);
  EXPECT_EQ(d.faces_at(3).size(), 1U);
}

// In the plane with 0 = (0, 0), 1 = (1, 0), 2 = (0, 1), 3 = (1, 1): (x, y) = l1 (1, 0) + l2 (0, 1) + l3 (1,
// 1).
TEST(Domain, AStraightWalkIsStraightInTheUnfoldedPlane) {
  const Domain d(kTwo);
  const FacePoint end = d.walk({0, {.5, .25, .25}}, {-.7, .5, .2});  // to (.75, .45)
  ASSERT_EQ(end.face, 1);                                            // 1 = (1,0), 3 = (1,1), 2 = (0,1)
  EXPECT_NEAR(end.l[0] + end.l[1], .75, 1e-15);
  EXPECT_NEAR(end.l[1] + end.l[2], .45, 1e-15);
}

TEST(Domain, AWalkEndsAtTheBoundary) {
  const Domain d(kTwo);
  const FacePoint end = d.walk({0, {.5, .25, .25}}, {.5, 0, -.5});  // straight down from (.25, .25)
  EXPECT_EQ(end.face, 0);
  EXPECT_EQ(end.l[2], 0);
  EXPECT_NEAR(end.l[1], .25, 1e-15);
}

TEST(Domain, ExpressesAPointOfACommonEdgeInTheOtherFaceOnly) {
  const Domain d(kTwo);
  FacePoint there;
  ASSERT_TRUE(d.express({0, {0, .25, .75}}, 1, there));
  EXPECT_EQ(there.l, (std::array<double, 3>{.25, 0, .75}));
  EXPECT_FALSE(d.express({0, {.1, .2, .7}}, 1, there));
}

// Two unit squares side by side in the plane, (0, 0) to (2, 1). Either may begin at any of its corners.
constexpr std::array<std::array<std::int32_t, 4>, 2> kSquares{{{0, 1, 4, 3}, {1, 2, 5, 4}}};
data::ControlMesh two_squares(int first, int second) {
  data::ControlMesh mesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}}, {}};
  const std::array turn{first, second};
  for (std::size_t f = 0; f < 2; ++f) {
    std::array<std::int32_t, 4> face{};
    for (int k = 0; k < 4; ++k) face[k] = kSquares[f][(k + turn[f]) % 4];
    mesh.faces.push_back(face);
  }
  return mesh;
}

// Where a point lies in that plane.
Vector in_the_plane(const data::ControlMesh& mesh, const FacePoint& p) {
  const auto face = mesh.faces[p.face];
  const Vector o = mesh.positions[face[0]], x = mesh.positions[face[1]], y = mesh.positions[face[3]];
  return o + p.l[1] * (x - o) + p.l[2] * (y - o);
}
FacePoint from_the_plane(const data::ControlMesh& mesh, std::int32_t f, const Vector& p) {
  const auto face = mesh.faces[f];
  const Vector o = mesh.positions[face[0]];
  return {f, Chart::at(dot(p - o, Vector(mesh.positions[face[1]]) - o),
                       dot(p - o, Vector(mesh.positions[face[3]]) - o))};
}

TEST(Domain, ASquareIsLeftAcrossAnySideIntoASquareThatBeginsAnywhere) {
  for (int first = 0; first < 4; ++first)
    for (int second = 0; second < 4; ++second) {
      const data::ControlMesh mesh = two_squares(first, second);
      const Domain d(mesh);
      const int side = (1 - first + 4) % 4;  // x = 1
      ASSERT_EQ(d.across(0, side), 1);
      EXPECT_EQ(d.across(1, d.side_across(0, side)), 0);
      const FacePoint start = from_the_plane(mesh, 0, {.5, .25, 0});
      const FacePoint far = from_the_plane(mesh, 0, {1.75, .875, 0});
      const FacePoint end =
          d.walk(start, {far.l[0] - start.l[0], far.l[1] - start.l[1], far.l[2] - start.l[2]});
      EXPECT_EQ(end.face, 1) << first << second;
      EXPECT_LE(norm(in_the_plane(mesh, end) - Vector{1.75, .875, 0}), 1e-15) << first << second;
      EXPECT_LE(norm(in_the_plane(mesh, {1, d.unfolded(0, side, far.l)}) - Vector{1.75, .875, 0}), 1e-15);
      const FacePoint away = from_the_plane(mesh, 0, {.5, -3, 0});
      const FacePoint stopped =
          d.walk(start, {away.l[0] - start.l[0], away.l[1] - start.l[1], away.l[2] - start.l[2]});
      EXPECT_EQ(in_the_plane(mesh, stopped), (Vector{.5, 0, 0})) << first << second;
    }
}

TEST(Domain, APointOfACommonSideOrCornerOfSquaresHasANameInBoth) {
  for (int first = 0; first < 4; ++first)
    for (int second = 0; second < 4; ++second) {
      const data::ControlMesh mesh = two_squares(first, second);
      const Domain d(mesh);
      FacePoint there;
      for (const Vector& p : {Vector{1, .25, 0}, Vector{1, 0, 0}, Vector{1, 1, 0}}) {
        ASSERT_TRUE(d.express(from_the_plane(mesh, 0, p), 1, there));
        EXPECT_EQ(in_the_plane(mesh, there), p) << first << second;
      }
      for (const Vector& p : {Vector{.75, .25, 0}, Vector{0, 1, 0}, Vector{.5, 1, 0}})
        EXPECT_FALSE(d.express(from_the_plane(mesh, 0, p), 1, there)) << first << second;
    }
}

}  // namespace
}  // namespace limitcheck::verify
