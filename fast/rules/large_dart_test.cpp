// SPDX-License-Identifier: MIT
#include "fast/rules/quad_limit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fast/rules/quad_limit_impl.h"

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
