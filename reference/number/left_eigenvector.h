// SPDX-License-Identifier: MIT
// Left eigenvectors of small matrices that have no closed form, over any number type.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "data/error.h"
#include "reference/number/number.h"

namespace limitcheck::reference {

/// Row by row; square.
template <class N>
using SquareMatrix = std::vector<std::vector<N>>;

/// The row p with p a = p that sums to 1, of a matrix whose rows sum to 1, with no entry below 0 and
/// something in column 0 of every row. By the elimination of Grassmann, Taksar and Heyman [1985], which
/// subtracts nothing: exact in rationals, and accurate in each entry where numbers are rounded.
template <class N>
std::vector<N> stationary_row(SquareMatrix<N> a) {
  for (std::size_t k = a.size() - 1; k > 0; --k) {
    N leaves(0);
    for (std::size_t j = 0; j < k; ++j) leaves += a[k][j];
    for (std::size_t i = 0; i < k; ++i) {
      a[i][k] = a[i][k] / leaves;
      for (std::size_t j = 0; j < k; ++j) a[i][j] += a[i][k] * a[k][j];
    }
  }
  std::vector<N> row(a.size(), N(0));
  row[0] = N(1);
  N sum(1);
  for (std::size_t k = 1; k < row.size(); ++k) {
    for (std::size_t i = 0; i < k; ++i) row[k] += row[i] * a[i][k];
    sum += row[k];
  }
  for (N& p : row) p = p / sum;
  return row;
}

namespace detail {

/// The number without what it says about its own error.
template <class N>
N middle(const N& a) {
  if constexpr (requires { NumberTraits<N>::middle(a); })
    return NumberTraits<N>::middle(a);
  else
    return a;
}

/// The inverse of a matrix, by elimination with the largest pivots.
template <class N>
SquareMatrix<N> inverse(SquareMatrix<N> a) {
  const std::size_t n = a.size();
  for (std::size_t i = 0; i < n; ++i) {
    a[i].resize(2 * n, N(0));
    a[i][n + i] = N(1);
  }
  const auto size = [](const N& x) { return std::abs(NumberTraits<N>::approximate(x)); };
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (size(a[i][k]) > size(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    const N share = N(1) / a[k][k];
    for (N& x : a[k]) x = middle<N>(x * share);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const N factor = a[i][k];
      for (std::size_t j = k; j < 2 * n; ++j) a[i][j] = middle<N>(a[i][j] - factor * a[k][j]);
    }
  }
  for (auto& row : a) row.erase(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(n));
  return a;
}

}  // namespace detail

/// A row and its eigenvalue.
template <class N>
struct LeftEigenvector {
  std::vector<N> row;
  N eigenvalue;
};

namespace detail {

template <class N>
LeftEigenvector<N> find_left_eigenvector(const SquareMatrix<N>& m) {
  using T = NumberTraits<N>;
  const std::size_t n = m.size();
  std::vector<double> guess(n, 1), next(n);
  for (int step = 0; step < 3000; ++step) {
    double largest = 0;
    for (std::size_t j = 0; j < n; ++j) {
      next[j] = 0;
      for (std::size_t i = 0; i < n; ++i) next[j] += guess[i] * T::approximate(m[i][j]);
      largest = std::max(largest, std::abs(next[j]));
    }
    for (std::size_t j = 0; j < n; ++j) guess[j] = next[j] / largest;
  }
  double image = 0;
  for (std::size_t i = 0; i < n; ++i) image += guess[i] * T::approximate(m[i][0]);
  LeftEigenvector<N> result{std::vector<N>(n), T::from_double(image / guess[0])};
  for (std::size_t i = 0; i < n; ++i) result.row[i] = T::from_double(guess[i] / guess[0]);
  std::vector<N>& x = result.row;
  N& mu = result.eigenvalue;

  // F = x m - mu x by the unknowns mu, x[1], x[2], ..
  const auto value = [&] {
    std::vector<N> f(n, N(0));
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < n; ++i) f[j] += x[i] * m[i][j];
      f[j] -= mu * x[j];
    }
    return f;
  };
  const auto derivative = [&] {
    SquareMatrix<N> d(n, std::vector<N>(n, N(0)));
    for (std::size_t j = 0; j < n; ++j) {
      d[j][0] = N(0) - x[j];
      for (std::size_t i = 1; i < n; ++i) d[j][i] = i == j ? m[i][j] - mu : m[i][j];
    }
    return d;
  };
  int steps = 2;
  for (long digits = 10; digits < T::precision(); digits *= 2) ++steps;
  SquareMatrix<N> y;
  for (int step = 0; step < steps; ++step) {
    y = detail::inverse(derivative());
    const std::vector<N> f = value();
    for (std::size_t i = 0; i < n; ++i) {
      N change(0);
      for (std::size_t j = 0; j < n; ++j) change += y[i][j] * f[j];
      N& unknown = i == 0 ? mu : x[i];
      unknown = detail::middle<N>(unknown - change);
    }
  }
  if constexpr (requires { T::middle(mu); }) {
    // For unknowns within r of these, -y F + (1 - y F') u - y (terms of second order) is within a + b r + c
    // r^2.
    const std::vector<N> f = value();
    const SquareMatrix<N> d = derivative();
    N a(0), b(0), c(0);
    const auto most = [](N& bound, const N& one) {
      if (!(one < bound)) bound = one;
    };
    for (std::size_t i = 0; i < n; ++i) {
      N moved(0), row(0), size(0);
      for (std::size_t j = 0; j < n; ++j) {
        moved += y[i][j] * f[j];
        size += T::bound(y[i][j]);
        N entry(i == j ? -1 : 0);
        for (std::size_t k = 0; k < n; ++k) entry += y[i][k] * d[k][j];
        row += T::bound(entry);
      }
      most(a, T::bound(moved)), most(b, T::bound(row)), most(c, T::bound(size));
    }
    N radius = T::bound(a + a) + T::scale(N(1), -4 * T::precision());
    if (!(a + b * radius + c * radius * radius < radius)) radius = N(1);  // more precision will tell
    radius = T::bound(radius);
    mu = T::widened(mu, radius);
    for (std::size_t i = 1; i < n; ++i) x[i] = T::widened(x[i], radius);
  }
  return result;
}

}  // namespace detail

/// The row x with x m = mu x, x[0] = 1, and mu the eigenvalue of the largest modulus, which is real and
/// simple. Power iteration in double finds it, Newton's method on (x, mu) gives all digits; in balls
/// Krawczyk's test encloses both.
///   throws   data::ArgumentError in a number type that is not near to double numbers, such as residues
template <class N>
LeftEigenvector<N> dominant_left_eigenvector(const SquareMatrix<N>& m) {
  using T = NumberTraits<N>;
  if constexpr (!requires(N a) { T::approximate(a), T::from_double(1.0), T::precision(); }) {
    throw data::ArgumentError("no eigenvectors in this number type");
  } else {
    return detail::find_left_eigenvector(m);
  }
}

/// The same of a matrix whose rows sum to 1, without the eigenvalue 1, among the rows that are equal at
/// points that mirror each other: the weights of all points but the first, which has what is missing to 0.
///   pairs   of points, each but the first in one; a point that is its own mirror image twice
template <class N>
std::vector<N> mirrored_left_eigenvector(const SquareMatrix<N>& a,
                                         const std::vector<std::array<std::size_t, 2>>& pairs) {
  SquareMatrix<N> folded(pairs.size(), std::vector<N>(pairs.size(), N(0)));
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (std::size_t j = 0; j < pairs.size(); ++j)
      for (std::size_t side = 0; side < (pairs[i][0] == pairs[i][1] ? 1 : 2); ++side)
        folded[i][j] += a[pairs[i][side]][pairs[j][0]] - a[0][pairs[j][0]];
  const std::vector<N> row = dominant_left_eigenvector(folded).row;
  std::vector<N> weights(a.size() - 1);
  for (std::size_t i = 0; i < pairs.size(); ++i) weights[pairs[i][0] - 1] = weights[pairs[i][1] - 1] = row[i];
  return weights;
}

/// make(n), kept by thread, number type and `Which`; made again when the number type's precision has changed.
template <class N, class T, int Which, class Make>
const T& kept_by_valence(int n, Make&& make) {
  thread_local std::vector<std::unique_ptr<T>> kept;
  thread_local long precision = 0;
  if constexpr (requires { NumberTraits<N>::precision(); }) {
    if (precision != NumberTraits<N>::precision()) kept.clear();
    precision = NumberTraits<N>::precision();
  }
  const auto index = static_cast<std::size_t>(n);
  if (kept.size() <= index) kept.resize(index + 1);
  if (!kept[index]) kept[index] = std::make_unique<T>(make(n));
  return *kept[index];
}

}  // namespace limitcheck::reference
