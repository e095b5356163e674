// SPDX-License-Identifier: MIT
#include "verify/subject/face_domain.h"

#include <gtest/gtest.h>

namespace limitcheck::verify {
namespace {

constexpr std::int64_t kN = 4;

TEST(FaceDomain, SidesRunCounterClockwiseFromCornerToCorner) {
  const FaceDomain domain = FaceDomain::triangle();
  EXPECT_EQ(domain.corner_point(0, kN), (FaceDomain::Point{0, 0}));
  EXPECT_EQ(domain.corner_point(1, kN), (FaceDomain::Point{kN, 0}));
  EXPECT_EQ(domain.corner_point(2, kN), (FaceDomain::Point{0, kN}));
  for (int k = 0; k < domain.corners(); ++k) {
    EXPECT_EQ(domain.on_side(k, kN, kN), domain.corner_point(domain.next(k), kN));
    EXPECT_EQ(domain.previous(domain.next(k)), k);
    EXPECT_EQ(domain.corner_at(domain.corner_point(k, kN), kN), k);
    for (std::int64_t along = 0; along < kN; ++along) {
      const auto place = domain.side_of(domain.on_side(k, along, kN), kN);
      ASSERT_TRUE(place.has_value());
      EXPECT_EQ(place->side, k);
      EXPECT_EQ(place->along, along);
    }
  }
  EXPECT_GT(area({domain.corner_point(0, kN), domain.corner_point(1, kN), domain.corner_point(2, kN)}), 0);
}

TEST(FaceDomain, PointsAreNumberedWithoutGaps) {
  const FaceDomain domain = FaceDomain::triangle();
  std::int64_t next = 0, inside = 0;
  domain.for_each_point(kN, [&](FaceDomain::Point p) {
    EXPECT_TRUE(domain.contains(p, kN));
    EXPECT_EQ(domain.number(p, kN), next++);
    inside += !domain.side_of(p, kN);
  });
  EXPECT_EQ(next, domain.point_count(kN));
  std::int64_t rows = 0;
  for (std::int64_t j = 1; j < kN; ++j) rows += domain.inner_points_in_row(j, kN);
  EXPECT_EQ(rows, inside);
  EXPECT_FALSE(domain.contains({3, 2}, kN));
  EXPECT_FALSE(domain.contains({-1, 2}, kN));
}

TEST(FaceDomain, SymmetriesMoveSidesWithTheirCorners) {
  const FaceDomain domain = FaceDomain::triangle();
  for (const bool mirrored : {false, true})
    for (int first = 0; first < domain.corners(); ++first) {
      const FaceDomain::Symmetry s{first, mirrored};
      for (int k = 0; k < domain.corners(); ++k) {
        const int from = domain.corner(k, s), to = domain.corner(domain.next(k), s);
        EXPECT_EQ(to, mirrored ? domain.previous(from) : domain.next(from));
        EXPECT_EQ(domain.moved(domain.on_side(k, 1, kN), kN, s),
                  mirrored ? domain.on_side(to, kN - 1, kN) : domain.on_side(from, 1, kN));
      }
      EXPECT_EQ(domain.moved({1, 1}, domain.centre_denominator(), s), (FaceDomain::Point{1, 1}));
    }
}

}  // namespace
}  // namespace limitcheck::verify
