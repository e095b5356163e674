// SPDX-License-Identifier: MIT
// What makes a mask right, whatever its numbers: a step of subdivision leaves a limit where it is and shrinks
// a tangent by its eigenvalue. And the numbers that are known.
#include <gtest/gtest.h>

#include <cstdio>

#include "data/splitmix64.h"
#include "reference/catmull_clark/patch.h"
#include "reference/catmull_clark/vertex_limit.h"
#include "reference/number/number_exact.h"

namespace limitcheck::reference::catmull_clark {
namespace {

template <class N>
RingedCorner<Vec3<N>> random_corner(int faces, bool on_boundary) {
  data::SplitMix64 random(static_cast<std::uint64_t>(faces) + (on_boundary ? 1000 : 0));
  const auto point = [&] {
    const auto number = [&] { return N(static_cast<int>(random.next() % 2001) - 1000) / N(64); };
    Vec3<N> p;
    p.x = number(), p.y = number(), p.z = number();
    return p;
  };
  RingedCorner<Vec3<N>> c;
  c.on_boundary = on_boundary;
  c.point = point();
  for (int i = 0; i < faces + (on_boundary ? 1 : 0); ++i) c.edges.push_back(point());
  for (int i = 0; i < faces; ++i) c.faces.push_back(point());
  return c;
}

TEST(CatmullClark_LimitMasks, StayExactlyWhereTheyAreInAStep) {
  for (int n = 3; n <= 60; ++n) {
    const auto c = random_corner<Rational>(n, false);
    EXPECT_EQ(limit_position(c), limit_position(subdivide<Rational>(c))) << n;
  }
  for (int k = 1; k <= 60; ++k) {
    const auto c = random_corner<Rational>(k, true);
    EXPECT_EQ(limit_position(c), limit_position(subdivide<Rational>(c))) << k;
  }
}

TEST(CatmullClark_TangentMasks, ShrinkByTheirEigenvalueInAStep) {
  using N = Decimal100;
  const auto expect_shrunk = [](const Vec3<N>& after, const Vec3<N>& before, const N& lambda,
                                const std::string& what) {
    EXPECT_LE(magnitude(after - before * lambda), N("1e-94"))
        << what;  // some hundred roundings of numbers below 1000
    EXPECT_GT(magnitude(before), N("1e-3")) << what;
  };
  for (int n = 3; n <= 60; ++n) {
    const auto c = random_corner<N>(n, false);
    const auto before = limit_tangents(c), after = limit_tangents(subdivide<N>(c));
    const N lambda = (four_lambda_minus_one<N>(n) + N(1)) / N(4);
    expect_shrunk(after.first, before.first, lambda, "C at valence " + std::to_string(n));
    expect_shrunk(after.second, before.second, lambda, "S at valence " + std::to_string(n));
  }
  for (int k = 1; k <= 60; ++k) {
    const auto c = random_corner<N>(k, true);
    const auto before = limit_tangents(c), after = limit_tangents(subdivide<N>(c));
    const N lambda = (four_lambda_minus_one<N>(2 * k) + N(1)) / N(4);
    expect_shrunk(after.first, before.first, N(1) / N(2), "along " + std::to_string(k) + " faces");
    expect_shrunk(after.second, before.second, lambda, "across " + std::to_string(k) + " faces");
  }
}

// The table of the specification, to the digits it has.
TEST(CatmullClark_Eigenvalues, AreTheKnownOnes) {
  const auto lambda = [](long q) { return (four_lambda_minus_one<double>(q) + 1) / 4; };
  EXPECT_NEAR(lambda(3), .410097050800551892, 1e-15);
  EXPECT_NEAR(lambda(4), .5, 1e-15);
  EXPECT_NEAR(lambda(5), .549988354518297177, 1e-15);
  EXPECT_NEAR(lambda(12), .634796412353932187, 1e-15);
  EXPECT_NEAR(lambda(20), .647331902641664092, 1e-15);
}

// The masks at valence 4 are those of the bicubic B-spline.
TEST(CatmullClark_RegularVertex, IsTheBicubicSpline) {
  const auto c = random_corner<Rational>(4, false);
  Patch<Rational> p{};  // the vertex at (0, 0) of the patch; what lies beyond the ring has no weight there
  p[5] = c.point;
  p[6] = c.edges[0], p[9] = c.edges[1], p[4] = c.edges[2], p[1] = c.edges[3];
  p[10] = c.faces[0], p[8] = c.faces[1], p[0] = c.faces[2], p[2] = c.faces[3];
  const auto s = evaluate_patch<Rational>(p, Rational(0), Rational(0), Derivatives::kSecond);
  EXPECT_EQ(s.position, limit_position(c));
  // d/du is (4 (e_0 - e_2) + f_0 - f_1 - f_2 + f_3) / 12.
  EXPECT_EQ(s.u,
            ((c.edges[0] - c.edges[2]) * Rational(4) + c.faces[0] - c.faces[1] - c.faces[2] + c.faces[3]) *
                Rational(1, 12));
  EXPECT_EQ(s.uv, (c.faces[0] - c.faces[1] + c.faces[2] - c.faces[3]) * Rational(1, 4));
}

}  // namespace
}  // namespace limitcheck::reference::catmull_clark
