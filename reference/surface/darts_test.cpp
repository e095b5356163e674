// SPDX-License-Identifier: MIT
// The masks of a dart, whatever its numbers: a step leaves the limit where it is and shrinks a tangent by its
// eigenvalue. And the numbers that are known.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "data/splitmix64.h"
#include "reference/catmull_clark/vertex_limit.h"
#include "reference/loop/vertex_limit.h"
#include "reference/number/number_exact.h"

namespace limitcheck::reference {
namespace {

using R = Rational;

template <class N>
Vec3<N> random_point(data::SplitMix64& random) {
  const auto number = [&] { return N(static_cast<int>(random.next() % 2001) - 1000) / N(64); };
  Vec3<N> p;
  p.x = number(), p.y = number(), p.z = number();
  return p;
}

// By how much a tangent is shorter.
template <class N>
double shrinks(const Vec3<N>& after, const Vec3<N>& before, const std::string& what) {
  EXPECT_LE(magnitude(cross(after, before)), N("1e-90")) << what;
  EXPECT_GT(dot(after, before), N(0)) << what;
  return N(dot(after, before) / dot(before, before)).template convert_to<double>();
}

// c has what is missing to 1.
TEST(Loop_Darts, HaveTheKnownLimits) {
  const auto check = [](int n, const std::vector<R>& r) {
    EXPECT_EQ(dart_limit_weights<R>(n, Weights::kLoop), r) << n;
  };
  check(3, {R(9, 37), R(6, 37), R(6, 37)});
  check(4, {R(1085, 6385), R(744, 6385), R(868, 6385), R(744, 6385)});
  check(6, {R(42, 426), R(29, 426), R(35, 426), R(36, 426), R(35, 426), R(29, 426)});
}

TEST(Loop_Darts, StayWhereTheyAreInAStepThatShrinksTheirTangents) {
  using N = Decimal100;
  for (const Weights weights : {Weights::kLoop, Weights::kWarren})
    for (int n = 3; n <= 30; ++n) {
      data::SplitMix64 random(static_cast<std::uint64_t>(n));
      const Vec3<N> v = random_point<N>(random);
      std::vector<Vec3<N>> ring;
      for (int i = 0; i < n; ++i) ring.push_back(random_point<N>(random));
      ring.push_back(ring.front());
      Vec3<N> moved = v;
      std::vector<Vec3<N>> next = ring;
      subdivide_ring(moved, next, true, weights, VertexState::kDart);
      const auto before = vertex_limit<N>(v, ring, true, weights, VertexState::kDart),
                 after = vertex_limit<N>(moved, next, true, weights, VertexState::kDart);
      EXPECT_LE(magnitude(after.position - before.position), N("1e-95")) << n;
      const double along = shrinks(after.tangents.first, before.tangents.first, "along " + std::to_string(n));
      const double across =
          shrinks(after.tangents.second, before.tangents.second, "across " + std::to_string(n));
      EXPECT_NEAR(across, .375 + NumberTraits<double>::cos_pi(2, n) / 4, 1e-14) << n;
      if (weights != Weights::kLoop) continue;
      const double known = n == 4 ? .4518223336 : n == 6 ? .5 : n == 7 ? .514472829837 : along;
      EXPECT_NEAR(along, known, 1e-10) << n;
    }
}

}  // namespace

namespace catmull_clark {
namespace {

template <class N>
RingedCorner<Vec3<N>> random_dart(int n) {
  data::SplitMix64 random(static_cast<std::uint64_t>(n));
  RingedCorner<Vec3<N>> c;
  c.on_boundary = true;
  c.state = VertexState::kDart;
  c.point = random_point<N>(random);
  for (int i = 0; i < n; ++i) c.edges.push_back(random_point<N>(random));
  const Vec3<N> first = c.edges.front();
  c.edges.push_back(first);
  for (int i = 0; i < n; ++i) c.faces.push_back(random_point<N>(random));
  return c;
}

TEST(CatmullClark_Darts, StayExactlyWhereTheyAreInAStep) {
  for (int n = 3; n <= 20; ++n) {
    const auto c = random_dart<R>(n);
    EXPECT_EQ(limit_position(c), limit_position(subdivide<R>(c))) << n;
  }
}

// c has what is missing to 1.
TEST(CatmullClark_Darts, HaveTheKnownLimits) {
  const auto check = [](int n, const std::vector<R>& e, const std::vector<R>& f) {
    EXPECT_EQ(dart_limit_weights<R>(n).e, e) << n;
    EXPECT_EQ(dart_limit_weights<R>(n).f, f) << n;
  };
  check(3, {R(1, 5), R(3, 20), R(3, 20)}, {R(11, 400), R(1, 25), R(11, 400)});
  check(4, {R(35, 268), R(20, 201), R(15, 134), R(20, 201)},
        {R(29, 1608), R(44, 1608), R(44, 1608), R(29, 1608)});
  check(5, {R(55, 593), R(42, 593), R(48, 593), R(48, 593), R(42, 593)},
        {R(38, 2965), R(58, 2965), R(121, 5930), R(58, 2965), R(38, 2965)});
}

TEST(CatmullClark_Darts, HaveTangentsThatAStepShrinks) {
  using N = Decimal100;
  for (int n = 3; n <= 30; ++n) {
    const auto c = random_dart<N>(n);
    const auto before = limit_tangents(c), after = limit_tangents(subdivide<N>(c));
    const double along = shrinks(after.first, before.first, "along " + std::to_string(n));
    const double across = shrinks(after.second, before.second, "across " + std::to_string(n));
    EXPECT_NEAR(across, (four_lambda_minus_one<double>(n) + 1) / 4, 1e-14) << n;
    const double known = n == 3   ? .462060590538
                         : n == 4 ? .5
                         : n == 5 ? .526424362162
                         : n == 8 ? .581909960445
                                  : along;
    EXPECT_NEAR(along, known, 1e-12) << n;
  }
}

}  // namespace
}  // namespace catmull_clark
}  // namespace limitcheck::reference
