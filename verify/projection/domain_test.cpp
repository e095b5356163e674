// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "data/shapes.h"
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

}  // namespace
}  // namespace limitcheck::verify
