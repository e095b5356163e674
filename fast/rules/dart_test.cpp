// SPDX-License-Identifier: MIT
// Limits of darts and of vertices that are held.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fast/rules/limit.h"
#include "fast/rules/quad_limit.h"
#include "fast/rules/quad_limit_impl.h"
#include "fast/rules/vertex_limit.h"

namespace limitcheck::fast {
namespace {

// The left null vectors of the step, in rational numbers: of the vertex, then e_0, e_1, ..
struct Known {
  int faces;
  double whole;
  std::vector<double> parts;
};

TEST(DartWeights, AreTheRationalOnes) {
  const std::vector<Known> all{
      {3, 37, {9, 6, 6}}, {4, 6385, {1085, 744, 868, 744}}, {6, 426, {42, 29, 35, 36, 35, 29}}};
  for (const Known& known : all) {
    const auto weights = dart_weights<double>(known.faces);
    for (std::size_t i = 0; i < known.parts.size(); ++i)
      EXPECT_NEAR(weights.position[i], known.parts[i] / known.whole, 1e-14) << known.faces << ": " << i;
  }
}

// A step leaves the limit where it is, and scales each tangent by its eigenvalue. The symmetric ones to the
// digits that are known.
TEST(DartLimit, SurvivesASubdivisionStep) {
  for (const auto& [faces, eigenvalue] : {std::pair{3, .39827}, {4, .45182}, {5, .48094}, {6, .5}}) {
    Vec3<double> v{.1, .2, -.3};
    std::vector<Vec3<double>> ring;
    for (int i = 0; i < faces; ++i) ring.push_back({std::cos(i), std::sin(2 * i), .25 * i});
    ring.push_back(ring.front());
    const auto weights = dart_weights<double>(faces);
    const auto before = dart_limit<double>(v, ring, weights);
    subdivide_in_place<double>(v, ring, true, VertexKind::kDart);
    EXPECT_EQ(ring.front(), ring.back());
    const auto after = dart_limit<double>(v, ring, weights);
    const auto size = [](const Vec3<double>& a) { return std::sqrt(dot(a, a)); };
    EXPECT_LE(size(after.position - before.position), 1e-14);
    EXPECT_NEAR(size(after.du) / size(before.du), eigenvalue, 6e-6) << faces;
    EXPECT_LE(size(cross(after.du, before.du)), 1e-13);
    const double antisymmetric = .375 + .25 * std::cos(2 * std::numbers::pi / faces);
    EXPECT_LE(size(after.dv - antisymmetric * before.dv), 1e-14);
  }
}

TEST(HeldLimit, IsTheVertexAndTheEndsOfItsRing) {
  const Vec3<double> v{1, 2, 3};
  const std::vector<Vec3<double>> ring{{2, 2, 3}, {2, 3, 4}, {1, 4, 3}};
  const auto limit = held_limit<double>(v, ring, true, RingWeights<double>::open(3));
  EXPECT_EQ(limit.position, v);
  EXPECT_EQ(limit.du, (Vec3<double>{1, 0, 0}));
  EXPECT_EQ(limit.dv, (Vec3<double>{0, 2, 0}));
}

}  // namespace
}  // namespace limitcheck::fast

namespace limitcheck::fast::detail {

namespace {

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0, difference = a.size() == b.size() ? 0 : 1e300;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    largest = std::max(largest, std::abs(a[i]));
    difference = std::max(difference, std::abs(a[i] - b[i]));
  }
  return difference / largest;
}

TEST(LargeDart, HasTheWeightsThatPowersOfTheMatrixHave) {
  for (const int n : {3, 4, 5, 20, kLargeDart, kLargeDart + 1, 130}) {
    const DartMatrix<double> matrix(n);
    const StarWeights<double> weights = large_dart_weights(n);
    const double bound = kLargeDartError * n + 1e-13;  // the rounding of powers, too
    EXPECT_LE(largest_difference(weights.position, matrix.of_ring(matrix.limit())), bound) << n;
    EXPECT_LE(largest_difference(weights.du, matrix.of_ring(matrix.tangent())), bound) << n;
  }
}

// One step of subdivision maps the tangent weights to a multiple of themselves, also where no matrix fits.
TEST(LargeDart, HasAnEigenvectorAtAnyValence) {
  for (const int n : {1000, 100'000}) {
    const StarWeights<double> w = large_dart_weights(n);
    const auto edge = [&](int i) { return w.du[2 * static_cast<std::size_t>((i + n) % n)]; };
    const auto face = [&](int i) { return w.du[2 * static_cast<std::size_t>((i + n) % n) + 1]; };
    double sum = 0, most = 0;
    for (const double x : w.du) sum += x, most = std::max(most, std::abs(x));
    // What the points of the next step give to e_i and to f_i; the centre has less the sum of all.
    const auto of_edge = [&](int i) {
      const auto beside = [&](int j) { return j % n == 0 ? 0 : edge(j) / 16; };
      const double own = i % n == 0 ? edge(i) / 2 : 3 * edge(i) / 8;
      return own + beside(i - 1 + n) + beside(i + 1) + (face(i - 1) + face(i)) / 4 - 3 * sum / (2. * n * n);
    };
    const auto of_face = [&](int i) {
      const auto beside = [&](int j) { return j % n == 0 ? 0 : edge(j) / 16; };
      return face(i) / 4 + beside(i) + beside(i + 1) - sum / (4. * n * n);
    };
    const double eigenvalue = of_edge(n / 2) / edge(n / 2);
    EXPECT_GT(eigenvalue, .25);
    EXPECT_LT(eigenvalue, .7);
    double off = 0;
    for (int i = 0; i < n; ++i)
      off = std::max(
          {off, std::abs(of_edge(i) - eigenvalue * edge(i)), std::abs(of_face(i) - eigenvalue * face(i))});
    EXPECT_LE(off, kLargeDartError * n * most) << n;
  }
}

}  // namespace
}  // namespace limitcheck::fast::detail
