// SPDX-License-Identifier: MIT
#include "reference/loop/basis.h"

namespace limitcheck::reference::detail {
namespace {

/// A polynomial in alpha, beta, gamma of degree at most 4, with integer coefficients.
struct Polynomial {
  int c[5][5][5] = {};

  friend Polynomial operator+(Polynomial p, const Polynomial& q) {
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j)
        for (int k = 0; k < 5; ++k) p.c[i][j][k] += q.c[i][j][k];
    return p;
  }
  friend Polynomial operator*(int s, Polynomial p) {
    for (auto& plane : p.c)
      for (auto& row : plane)
        for (int& x : row) x *= s;
    return p;
  }
  friend Polynomial operator*(const Polynomial& p, const Polynomial& q) {
    Polynomial r;
    for (int i = 0; i < 5; ++i)
      for (int j = 0; i + j < 5; ++j)
        for (int k = 0; i + j + k < 5; ++k)
          if (p.c[i][j][k] != 0)
            for (int l = 0; i + l < 5; ++l)
              for (int m = 0; j + m < 5; ++m)
                for (int n = 0; k + n < 5; ++n) r.c[i + l][j + m][k + n] += p.c[i][j][k] * q.c[l][m][n];
    return r;
  }
};

/// Derivative with respect to alpha (or beta) where gamma = 1 - alpha - beta.
Polynomial derivative(const Polynomial& p, bool by_alpha) {
  Polynomial r;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      for (int k = 0; k < 5; ++k) {
        if (by_alpha && i > 0) r.c[i - 1][j][k] += i * p.c[i][j][k];
        if (!by_alpha && j > 0) r.c[i][j - 1][k] += j * p.c[i][j][k];
        if (k > 0) r.c[i][j][k - 1] -= k * p.c[i][j][k];
      }
  return r;
}

template <std::size_t T>
void store(std::array<std::array<int, 12>, T>& table, std::size_t function, int degree, const Polynomial& p) {
  std::size_t t = 0;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j) table[t++][function] = p.c[i][j][degree - i - j];
}

}  // namespace

const BasisTable<int>& basis_table() {
  static const BasisTable<int> table = [] {
    Polynomial alpha, beta, gamma;
    alpha.c[1][0][0] = beta.c[0][1][0] = gamma.c[0][0][1] = 1;
    const auto functions = appendix_a(alpha, beta, gamma);
    BasisTable<int> result;
    for (std::size_t f = 0; f < 12; ++f) {
      const Polynomial& p = functions[f];
      const Polynomial pa = derivative(p, true), pb = derivative(p, false);
      store(result.value, f, 4, p);
      store(result.da, f, 3, pa);
      store(result.db, f, 3, pb);
      store(result.daa, f, 2, derivative(pa, true));
      store(result.dab, f, 2, derivative(pa, false));
      store(result.dbb, f, 2, derivative(pb, false));
    }
    return result;
  }();
  return table;
}

}  // namespace limitcheck::reference::detail
