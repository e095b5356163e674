// SPDX-License-Identifier: MIT
// What the masks of darts are made of. All neighbours of a dart but the one along the sharp edge follow one
// rule, as if that one had no weight; so that the weights of a limit or a tangent solve a recurrence with two
// zeros, in place of an eigenvector's equations: linear in the valence.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include "data/error.h"
#include "reference/number/number.h"
#include "reference/number/vec3.h"

namespace limitcheck::reference {

/// h_0 .. h_{n-1} with d h_j - h_{j-1} - h_{j+1} = b between h_0 = h_n = 0, d > 2. Sums of positive terms.
template <class N>
std::vector<N> between_zeros(int n, int d, int b) {
  std::vector<N> share{N(0)}, h{N(0)};
  for (int j = 1; j < n; ++j) {
    share.push_back(N(1) / (N(d) - share.back()));
    h.push_back((N(b) + h.back()) * share.back());
  }
  for (auto j = static_cast<std::size_t>(n) - 1; j-- > 1;) h[j] += share[j] * h[j + 1];
  return h;
}

/// Whether a number type has angles: not rationals, nor residues.
template <class N>
inline constexpr bool kHasAngles = requires(N a) {
  NumberTraits<N>::cos(a), NumberTraits<N>::approximate(a), NumberTraits<N>::from_double(1.0);
};

/// u_j = 1 - cos(t (n/2 - j)) / cos(t n/2), which is zero at j = 0 and n, too.
template <class N>
struct Arch {
  int n;
  N t;
  N end = NumberTraits<N>::cos(t * N(n) / N(2));

  /// Times cos(t n/2), so that it is finite at any t; and the sum of all.
  N scaled(int j) const { return end - NumberTraits<N>::cos(t * N(n - 2 * j) / N(2)); }
  N scaled_sum() const {
    using T = NumberTraits<N>;
    return end * N(n - 1) - T::sin(t * N(n - 1) / N(2)) / T::sin(t / N(2));
  }
  /// u_0 .. u_{n-1}
  std::vector<N> values() const {
    std::vector<N> u(static_cast<std::size_t>(n), N(0));
    const auto at = [&](int j) -> N& { return u[static_cast<std::size_t>(j)]; };
    for (int j = 1; j < n; ++j) at(j) = 2 * j <= n ? scaled(j) / end : at(n - j);
    return u;
  }
};

namespace detail {

/// The smallest root of g, somewhat below or above 2 pi / n: between two doubles of which g says different
/// signs.
template <class G>
double first_root(int n, const G& g) {
  const double unit = 2 * std::numbers::pi / n;
  double low = .6 * unit, high = low;
  for (int k = 1; k <= 200; ++k, low = high) {
    high = (.6 + .005 * k) * unit;
    if ((g(low) < 0) != (g(high) < 0)) break;
  }
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    ((g(low) < 0) == (g(middle) < 0) ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace detail

/// The angle of a dart's tangent: where g changes its sign first, by bisection in double, then by secants. In
/// balls, between two points at which the signs of g are certain.
///   g        takes doubles and N
///   throws   data::ArgumentError in a number type without angles
template <class N, class G>
N dart_angle(int n, const G& g) {
  if constexpr (!kHasAngles<N>) {
    throw data::ArgumentError("no eigenvectors in this number type");
  } else {
    using T = NumberTraits<N>;
    const double start = detail::first_root(n, g);
    if constexpr (std::is_same_v<N, double>) return start;
    const auto middle = [](const N& a) {
      if constexpr (requires { T::middle(a); })
        return T::middle(a);
      else
        return a;
    };
    N before = T::from_double(start * (1 + 1e-8)), at = T::from_double(start);
    N g_before = middle(g(before)), g_at = middle(g(at));
    N slope = (g_at - g_before) / (at - before), moved = magnitude(N(at - before));
    for (int step = 0; step < 60; ++step) {
      const N change = middle(g_at / slope);
      const N moves = magnitude(change);
      if (!(moves < moved) || !(moves > N(0))) break;  // the digits are spent
      before = std::exchange(at, middle(at - change));
      g_before = std::exchange(g_at, middle(g(at)));
      moved = moves;
      const N rise = g_at - g_before;
      if (!(magnitude(rise) > N(0))) break;
      slope = middle(rise / (at - before));
    }
    if constexpr (requires { T::middle(at); }) {
      N radius = T::bound(g(at) / slope) + T::scale(N(1), -2 * T::precision());
      for (int k = 0; k < 60; ++k) {
        radius = T::bound(radius + radius);
        const N low = g(at - radius), high = g(at + radius);
        if ((low < N(0) && high > N(0)) || (low > N(0) && high < N(0))) return T::widened(at, radius);
      }
      return T::widened(at, N(1));  // more precision will tell
    }
    return at;
  }
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
