// SPDX-License-Identifier: MIT
// The weights of limits and tangents that have no closed form, from the matrix of a subdivision step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace limitcheck::fast::detail {

template <class S>
using Row = std::vector<S>;
template <class S>
using Matrix = std::vector<Row<S>>;

template <class S>
Matrix<S> product(const Matrix<S>& a, const Matrix<S>& b) {
  Matrix<S> c(a.size(), Row<S>(a.size()));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < a.size(); ++k)
      if (a[i][k] != 0)
        for (std::size_t j = 0; j < a.size(); ++j) c[i][j] += a[i][k] * b[k][j];
  return c;
}

/// Of eigenvalue 1; it sums to 1.
template <class S>
Row<S> limit_eigenvector(const Matrix<S>& step) {
  Row<S> x(step.size(), S(1) / S(static_cast<int>(step.size())));
  for (int i = 0; i < 300; ++i) {
    Row<S> next(x.size());
    for (std::size_t k = 0; k < x.size(); ++k)
      for (std::size_t j = 0; j < x.size(); ++j) next[j] += x[k] * step[k][j];
    x = next;
  }
  S sum(0);
  for (const S& w : x) sum += w;
  for (S& w : x) w /= sum;
  return x;
}

/// Of the largest other eigenvalue, of any length and sign: by squaring what is left without the first.
template <class S>
Row<S> tangent_eigenvector(const Matrix<S>& step) {
  const Row<S> first = limit_eigenvector(step);
  Matrix<S> power = step;
  for (Row<S>& row : power)
    for (std::size_t j = 0; j < row.size(); ++j) row[j] -= first[j];
  for (int i = 0; i < 20; ++i) {
    power = product<S>(power, power);
    S largest(0);
    for (const Row<S>& row : power)
      for (const S& x : row) largest = std::max(largest, x < S(0) ? S(-x) : x);
    for (Row<S>& row : power)
      for (S& x : row) x /= largest;
  }
  const auto size = [](const Row<S>& row) {
    S sum(0);
    for (const S& x : row) sum += x * x;
    return sum;
  };
  return *std::max_element(power.begin(), power.end(),
                           [&](const Row<S>& a, const Row<S>& b) { return size(a) < size(b); });
}

}  // namespace limitcheck::fast::detail
