// SPDX-License-Identifier: MIT
#include "verify/subject/face_domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

namespace limitcheck::verify {
namespace {

constexpr std::int64_t kN = 4;
using Point = FaceDomain::Point;

// A triangle of Loop's scheme, a quad, and polygons.
std::vector<FaceDomain> domains() {
  std::vector<FaceDomain> all{FaceDomain::triangle()};
  for (const int corners : {4, 3, 5, 6, 11}) all.emplace_back(data::Scheme::kCatmullClark, corners);
  return all;
}

auto key(const Point& p) {
  return std::tuple(p.part, p.i, p.j);
}

TEST(FaceDomain, SidesRunCounterClockwiseFromCornerToCorner) {
  for (const FaceDomain domain : domains()) {
    for (int k = 0; k < domain.corners(); ++k) {
      EXPECT_EQ(domain.canonical(domain.on_side(k, kN, kN), kN), domain.corner_point(domain.next(k), kN));
      EXPECT_EQ(domain.previous(domain.next(k)), k);
      EXPECT_EQ(domain.corner_at(domain.corner_point(k, kN), kN), k);
      for (std::int64_t along = 0; along < kN; ++along) {
        const auto place = domain.side_of(domain.on_side(k, along, kN), kN);
        ASSERT_TRUE(place.has_value());
        EXPECT_EQ(place->side, k);
        EXPECT_EQ(place->along, along);
      }
    }
    EXPECT_GT(
        domain.area({domain.corner_point(0, kN), domain.corner_point(1, kN), domain.corner_point(2, kN)}, kN),
        0);
  }
  EXPECT_EQ(FaceDomain::triangle().corner_point(1, kN), (Point{kN, 0}));
  const FaceDomain quad(data::Scheme::kCatmullClark, 4), pentagon(data::Scheme::kCatmullClark, 5);
  EXPECT_EQ(quad.corner_point(2, kN), (Point{kN, kN}));
  EXPECT_EQ(quad.on_side(3, 1, kN), (Point{0, kN - 1}));
  EXPECT_EQ(pentagon.corner_point(2, kN), (Point{0, 0, 2}));
  EXPECT_EQ(pentagon.on_side(2, 3, kN), (Point{0, 1, 3}));
}

TEST(FaceDomain, PointsAreCountedOnceAndNumbered) {
  for (const FaceDomain domain : domains())
    for (const std::int64_t n : {1, 2, 4, 8}) {
      std::set<std::int64_t> numbers, inner;
      std::int64_t count = 0, inside = 0;
      domain.for_each_point(n, [&](Point p) {
        EXPECT_TRUE(domain.contains(p, n));
        EXPECT_EQ(domain.canonical(p, n), p);
        EXPECT_TRUE(numbers.insert(domain.number(p, n)).second);
        ++count;
        if (domain.side_of(p, n)) return;
        ++inside;
        const std::int64_t number = domain.inner_number(p, n);
        EXPECT_TRUE(inner.insert(number).second);
        EXPECT_EQ(domain.canonical(domain.inner_point(number, n), n), p);
      });
      EXPECT_LT(*numbers.rbegin(), domain.point_count(n));
      EXPECT_EQ(inside, domain.inner_count(n));
      EXPECT_EQ(inner.empty() ? -1 : *inner.rbegin(), inside - 1);
      EXPECT_EQ(count, inside + domain.corners() * n);
    }
  EXPECT_FALSE(FaceDomain::triangle().contains({3, 2}, kN));
  EXPECT_FALSE(FaceDomain::triangle().contains({-1, 2}, kN));
  const FaceDomain pentagon(data::Scheme::kCatmullClark, 5);
  EXPECT_FALSE(pentagon.contains({3, 0, 0}, kN));
  EXPECT_FALSE(pentagon.contains({0, 0, 5}, kN));
}

TEST(FaceDomain, InnerPointsOfLargeTrianglesAreFound) {
  const FaceDomain domain = FaceDomain::triangle();
  constexpr std::int64_t n = 1 << 15;
  for (const Point p :
       {Point{1, 1}, {n - 2, 1}, {1, 2}, {n - 3, 2}, {1, n - 2}, {7, 20000}, {n - 1 - 20000, 20000}})
    EXPECT_EQ(domain.inner_point(domain.inner_number(p, n), n), p);
}

TEST(FaceDomain, PartsOfAPolygonNameTheirCommonPointsAlike) {
  const FaceDomain domain(data::Scheme::kCatmullClark, 5);
  const std::int64_t m = kN / 2;
  for (std::int32_t k = 0; k < 5; ++k) {
    const std::int32_t next = domain.next(k);
    for (std::int64_t j = 0; j <= m; ++j) {
      const Point here{m, j, k}, there{j, m, next};
      EXPECT_EQ(domain.canonical(here, kN), domain.canonical(there, kN));
      EXPECT_EQ(domain.in_part(here, next, kN), there);
      EXPECT_EQ(domain.in_part(there, k, kN), here);
    }
    EXPECT_FALSE(domain.in_part({0, 0, k}, next, kN));
    EXPECT_FALSE(domain.in_part({m, 0, k}, domain.previous(k), kN));
  }
}

TEST(FaceDomain, LinesAreCutIntoTheStepsOfTheirNeighbours) {
  for (const FaceDomain domain : domains()) {
    // Along the outline, and back by the single steps: nothing is left.
    std::vector<
        std::tuple<std::tuple<int, std::int64_t, std::int64_t>, std::tuple<int, std::int64_t, std::int64_t>>>
        steps;
    const auto add = [&](const Point& p, const Point& q) {
      steps.emplace_back(key(domain.canonical(p, kN)), key(domain.canonical(q, kN)));
    };
    for (int k = 0; k < domain.corners(); ++k)
      domain.for_each_step(domain.corner_point(k, kN), domain.corner_point(domain.next(k), kN), kN, add);
    EXPECT_EQ(steps.size(), static_cast<std::size_t>(domain.corners() * kN));
    for (int k = 0; k < domain.corners(); ++k)
      for (std::int64_t at = 0; at < kN; ++at) {
        const std::pair step(key(domain.canonical(domain.on_side(k, at, kN), kN)),
                             key(domain.canonical(domain.on_side(k, at + 1, kN), kN)));
        EXPECT_EQ(std::count(steps.begin(), steps.end(), std::tuple(step.first, step.second)), 1);
      }
  }
}

TEST(FaceDomain, AreasOfATilingAddUp) {
  for (const FaceDomain domain : domains()) {
    double corners = 0, cells = 0;
    const auto add_to = [&](double& sum) {
      return [&](Point a, Point b, Point c) { sum += domain.area({a, b, c}, kN); };
    };
    domain.for_each_triangle(kN, kN, add_to(corners));
    domain.for_each_triangle(kN, 1, add_to(cells));
    const std::int64_t m = domain.denominator(kN), of_square = domain.corners() == 3 && m == kN ? 1 : 2;
    EXPECT_EQ(cells, of_square * m * m * domain.parts());
    EXPECT_NEAR(corners, cells, 0.01);
    if (domain.parts() == 1) continue;
    // Along a side nothing has an area, in the same part or not.
    EXPECT_EQ(
        domain.area({domain.corner_point(0, kN), domain.on_side(0, 1, kN), domain.on_side(0, 3, kN)}, kN), 0);
  }
}

TEST(FaceDomain, SymmetriesMoveSidesWithTheirCorners) {
  for (const FaceDomain domain : domains())
    for (const bool mirrored : {false, true})
      for (int first = 0; first < domain.corners(); ++first) {
        const FaceDomain::Symmetry s{first, mirrored};
        for (int k = 0; k < domain.corners(); ++k) {
          const int from = domain.corner(k, s), to = domain.corner(domain.next(k), s);
          EXPECT_EQ(to, mirrored ? domain.previous(from) : domain.next(from));
          for (const std::int64_t at : {1, 3})
            EXPECT_EQ(domain.moved(domain.on_side(k, at, kN), kN, s),
                      mirrored ? domain.on_side(to, kN - at, kN) : domain.on_side(from, at, kN));
        }
        const std::int64_t n = domain.centre_denominator();
        EXPECT_EQ(domain.canonical(domain.moved({1, 1}, n, s), n), (Point{1, 1}));
      }
}

}  // namespace
}  // namespace limitcheck::verify
