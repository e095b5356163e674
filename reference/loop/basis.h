// SPDX-License-Identifier: MIT
// Appendix A: the twelve basis functions of a regular patch, with derivatives.
//
//          1 --- 2            The patch is triangle (4, 7, 8): gamma = 1 at 4, alpha = 1 at 7, beta = 1 at 8;
//         / \   / \           gamma = 1 - alpha - beta.
//        3 --- 4 --- 5
//       / \   / \   / \       .
//      6 --- 7 --- 8 --- 9
//       \   / \   / \   /
//       10 -- 11 --- 12
// First misprint of the appendix: b1 = gamma^4 + 2 gamma^3 alpha, not alpha^3. [C69, C70]
#pragma once

#include <array>
#include <cstddef>

#include "reference/point/surface_point.h"

namespace limitcheck::reference {

/// Values and derivatives at one (alpha, beta), in the order above. Derivatives are with respect to alpha and
/// beta, gamma substituted (as in section 5); each derivative row sums to 0, the values to 1. [C65, C68]
template <class N>
struct Basis {
  std::array<N, 12> value, da, db, daa, dab, dbb;
};

/// The twelve functions as Appendix A prints them (b1 corrected), over any ring: numbers, or
/// jets for derivatives.
template <class T>
std::array<T, 12> appendix_a(const T& alpha, const T& beta, const T& gamma) {
  const T a2 = alpha * alpha, a3 = a2 * alpha, a4 = a2 * a2;
  const T b2 = beta * beta, b3 = b2 * beta, b4 = b2 * b2;
  const T g2 = gamma * gamma, g3 = g2 * gamma, g4 = g2 * g2;
  const T g3a = g3 * alpha, g3b = g3 * beta, g2ab = g2 * alpha * beta, g2a2 = g2 * a2, g2b2 = g2 * b2;
  const T ga2b = gamma * a2 * beta, gab2 = gamma * alpha * b2, ga3 = gamma * a3, gb3 = gamma * b3;
  const T a3b = a3 * beta, ab3 = alpha * b3, a2b2 = a2 * b2;
  return {g4 + 2 * g3a,
          g4 + 2 * g3b,
          g4 + 2 * g3b + 6 * g3a + 6 * g2ab + 12 * g2a2 + 6 * ga2b + 6 * ga3 + 2 * a3b + a4,
          6 * g4 + 24 * g3b + 24 * g2b2 + 8 * gb3 + b4 + 24 * g3a + 60 * g2ab + 36 * gab2 + 6 * ab3 +
              24 * g2a2 + 36 * ga2b + 12 * a2b2 + 8 * ga3 + 6 * a3b + a4,
          g4 + 6 * g3b + 12 * g2b2 + 6 * gb3 + b4 + 2 * g3a + 6 * g2ab + 6 * gab2 + 2 * ab3,
          2 * ga3 + a4,
          g4 + 6 * g3b + 12 * g2b2 + 6 * gb3 + b4 + 8 * g3a + 36 * g2ab + 36 * gab2 + 8 * ab3 + 24 * g2a2 +
              60 * ga2b + 24 * a2b2 + 24 * ga3 + 24 * a3b + 6 * a4,
          g4 + 8 * g3b + 24 * g2b2 + 24 * gb3 + 6 * b4 + 6 * g3a + 36 * g2ab + 60 * gab2 + 24 * ab3 +
              12 * g2a2 + 36 * ga2b + 24 * a2b2 + 6 * ga3 + 8 * a3b + a4,
          2 * gb3 + b4,
          2 * a3b + a4,
          2 * gb3 + b4 + 6 * gab2 + 6 * ab3 + 6 * ga2b + 12 * a2b2 + 2 * ga3 + 6 * a3b + a4,
          b4 + 2 * ab3};
}

namespace detail {

/// Coefficients of the twelve functions and their derivatives over the monomials of degree 4, 3, 2 in (alpha,
/// beta, gamma); 12 times the functions. They are small integers, exact in all number types.
template <class N>
struct BasisTable {
  std::array<std::array<N, 12>, 15> value{};
  std::array<std::array<N, 12>, 10> da{}, db{};
  std::array<std::array<N, 12>, 6> daa{}, dab{}, dbb{};

  BasisTable() = default;
  template <class M>
  explicit BasisTable(const BasisTable<M>& t) {
    const auto copy = [](auto& to, const auto& from) {
      for (std::size_t m = 0; m < from.size(); ++m)
        for (std::size_t i = 0; i < 12; ++i) to[m][i] = N(from[m][i]);
    };
    copy(value, t.value), copy(da, t.da), copy(db, t.db), copy(daa, t.daa), copy(dab, t.dab),
        copy(dbb, t.dbb);
  }
};
/// Found by running `appendix_a` on polynomials.
const BasisTable<int>& basis_table();

/// All monomials alpha^i beta^j gamma^k of degree D, in the order of the table: i outer, j
/// inner, both rising.
template <int D, class N>
auto monomials(const std::array<N, 5>& a, const std::array<N, 5>& b, const std::array<N, 5>& g) {
  std::array<N, (D + 1) * (D + 2) / 2> result;
  std::size_t t = 0;
  for (int i = 0; i <= D; ++i)
    for (int j = 0; i + j <= D; ++j) result[t++] = a[i] * b[j] * g[D - i - j];
  return result;
}

/// sum_t monomial[t] table[t][i] / 12
template <class N, std::size_t T>
void combine(std::array<N, 12>& result, const std::array<N, T>& monomial,
             const std::array<std::array<N, 12>, T>& table) {
  for (std::size_t i = 0; i < 12; ++i) result[i] = monomial[0] * table[0][i];
  for (std::size_t t = 1; t < T; ++t)
    for (std::size_t i = 0; i < 12; ++i) result[i] += monomial[t] * table[t][i];
  const N twelfth = N(1) / N(12);
  for (N& r : result) r *= twelfth;
}

}  // namespace detail

/// Values, and derivatives up to `order`, at (alpha, beta); the rest is left as it was.
template <class N>
void evaluate_basis(Basis<N>& result, const N& alpha, const N& beta, Derivatives order) {
  static const detail::BasisTable<N> table(detail::basis_table());
  std::array<N, 5> a, b, g;
  a[0] = b[0] = g[0] = N(1);
  const N gamma = N(1) - alpha - beta;
  for (std::size_t i = 1; i < 5; ++i) {
    a[i] = a[i - 1] * alpha;
    b[i] = b[i - 1] * beta;
    g[i] = g[i - 1] * gamma;
  }
  detail::combine(result.value, detail::monomials<4>(a, b, g), table.value);
  if (order == Derivatives::kPosition) return;
  const auto cubic = detail::monomials<3>(a, b, g);
  detail::combine(result.da, cubic, table.da);
  detail::combine(result.db, cubic, table.db);
  if (order == Derivatives::kFirst) return;
  const auto quadratic = detail::monomials<2>(a, b, g);
  detail::combine(result.daa, quadratic, table.daa);
  detail::combine(result.dab, quadratic, table.dab);
  detail::combine(result.dbb, quadratic, table.dbb);
}

}  // namespace limitcheck::reference
