// SPDX-License-Identifier: MIT
// Definitions behind two_ring.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>

#include "reference/catmull_clark/masks.h"
#include "reference/catmull_clark/two_ring.h"

namespace limitcheck::reference::catmull_clark {
namespace detail {

enum TwoRingPoint : std::size_t { kE, kF, kP, kG, kH, kR };

template <class Complex>
Complex times(const Complex& a, const Complex& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

/// The product of two blocks: e and f hear only of each other, p, g, h of these and of each other, r of all.
template <class Block>
Block product(const Block& a, const Block& b) {
  Block result{};
  constexpr std::array<std::size_t, 6> heard{2, 2, 5, 5, 5, 6};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t k = 0; k < heard[i]; ++k)
      for (std::size_t j = 0; j < heard[k]; ++j) {
        const auto t = times(a[i][k], b[k][j]);
        result[i][j].re += t.re;
        result[i][j].im += t.im;
      }
  return result;
}

/// Blocks of one frequency w = exp(2 pi i m / n), before division by the growth.
template <class N>
typename InteriorKind<N>::Block step_block(long m, long n, bool held) {
  using T = NumberTraits<N>;
  const N x = T::cos_pi(2 * m, n), y = sin_pi<N>(2 * m, n);
  const auto set = [&](auto& entry, int constant, int w, int conjugate, int over) {
    entry.re = (N(constant) + N(w + conjugate) * x) / N(over);
    entry.im = N(w - conjugate) * y / N(over);
  };
  typename InteriorKind<N>::Block a{};
  set(a[kE][kE], 6, 1, 1, 16), set(a[kE][kF], 1, 0, 1, 16);
  set(a[kF][kE], 1, 1, 0, 4), set(a[kF][kF], 1, 0, 0, 4);
  set(a[kP][kE], 36, 1, 1, 64), set(a[kP][kF], 6, 0, 6, 64), set(a[kP][kP], 6, 0, 0, 64);
  set(a[kP][kG], 1, 0, 0, 64), set(a[kP][kH], 0, 0, 1, 64);
  set(a[kG][kE], 6, 1, 0, 16), set(a[kG][kF], 6, 0, 0, 16), set(a[kG][kP], 1, 0, 0, 16),
      set(a[kG][kG], 1, 0, 0, 16);
  set(a[kH][kE], 1, 6, 0, 16), set(a[kH][kF], 6, 0, 0, 16), set(a[kH][kP], 0, 1, 0, 16),
      set(a[kH][kH], 1, 0, 0, 16);
  set(a[kR][kE], 6, 6, 0, 64), set(a[kR][kF], 36, 0, 0, 64), set(a[kR][kP], 1, 1, 0, 64);
  set(a[kR][kG], 6, 0, 0, 64), set(a[kR][kH], 6, 0, 0, 64), set(a[kR][kR], 1, 0, 0, 64);
  if (m == 0 && !held)  // c moves by 3 / (2 n) of the mean e and 1 / (4 n) of the mean f
    for (auto& row : a) {
      row[kE].re -= N(3) / N(static_cast<int>(2 * n));
      row[kF].re -= N(1) / N(static_cast<int>(4 * n));
    }
  return a;
}

}  // namespace detail

template <class N>
InteriorKind<N>::InteriorKind(int n, VertexState state)
    : faces_(n),
      held_(state == VertexState::kHeld),
      growth_(held_ ? cone_eigenvalue<N>() : (four_lambda_minus_one<N>(n) + N(1)) * (N(1) / N(4))) {
  const N share = N(1) / growth_;
  for (long m = 0; m <= n / 2; ++m) {
    Block a = detail::step_block<N>(m, n, held_);
    for (auto& row : a)
      for (Complex& entry : row) entry.re *= share, entry.im *= share;
    step_.push_back(a);
  }
  if constexpr (std::is_same_v<N, double>) {  // where speed matters
    constexpr long kTable = 24;
    table_.push_back(power(0));
    for (long j = 1; j < kTable; ++j) {
      std::vector<Block> next;
      for (std::size_t m = 0; m < step_.size(); ++m)
        next.push_back(detail::product(step_[m], table_.back()[m]));
      table_.push_back(std::move(next));
    }
  }
}

template <class N>
std::vector<typename InteriorKind<N>::Block> InteriorKind<N>::power(long exponent) const {
  Block one{};
  for (std::size_t i = 0; i < 6; ++i) one[i][i].re = N(1);
  std::vector<Block> result(step_.size(), one);
  for (std::size_t m = 0; m < step_.size(); ++m) {
    Block square = step_[m];
    for (long e = exponent; e > 0; e >>= 1) {
      if ((e & 1) != 0) result[m] = detail::product(square, result[m]);
      if (e > 1) square = detail::product(square, square);
    }
  }
  return result;
}

template <class N>
const std::vector<typename InteriorKind<N>::Block>& InteriorKind<N>::power(long exponent,
                                                                           std::vector<Block>& buffer) const {
  if (static_cast<std::size_t>(exponent) < table_.size()) return table_[static_cast<std::size_t>(exponent)];
  buffer = power(exponent);
  return buffer;
}

namespace detail {

template <class N>
N largest(const TwoRingPoints<N>& points) {
  N size = magnitude(points.c);
  for (const auto* list : {&points.e, &points.p, &points.f, &points.g, &points.h, &points.r})
    for (const Vec3<N>& x : *list) size = std::max(size, magnitude(x));
  return size;
}

}  // namespace detail

template <class N>
TwoRing<N>::TwoRing(const InteriorKind<N>& kind, const TwoRingPoints<N>& points)
    : interior_(&kind), limit_(kind.is_held() ? points.c : interior_limit<N>(points.c, points.e, points.f)) {
  if constexpr (kRounds<N>) size_ = detail::largest(points);
  const std::size_t n = points.e.size();
  const CircleTable<N>& circle = circle_table<N>(static_cast<long>(n));
  const std::array<const std::vector<Vec3<N>>*, 6> all{&points.e, &points.f, &points.p,
                                                       &points.g, &points.h, &points.r};
  const N share = N(1) / N(static_cast<int>(n));
  amplitudes_.resize(n / 2 + 1);
  for (std::size_t m = 0; m < amplitudes_.size(); ++m)
    for (std::size_t t = 0; t < 6; ++t) {
      Amplitude& x = amplitudes_[m][t];
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t at = 2 * (m * i % n);
        const Vec3<N> d = (*all[t])[i] - points.c;
        x[0] += d * circle.cosine[at];
        x[1] -= d * circle.sine[at];
      }
      x[0] *= share, x[1] *= share;
    }
}

template <class N>
N TwoRing<N>::size(long steps) const {
  if (interior_ != nullptr) return size_;
  N size = size_, factor = stepped_->grown();
  for (; steps > 0; steps >>= 1, factor *= factor)
    if ((steps & 1) != 0) size *= factor;
  return size;
}

template <class N>
void TwoRing<N>::sector(int i, long steps, TwoRingSector<N>& s) const {
  interior_ != nullptr ? interior_sector(i, steps, s) : stepped_sector(i, steps, s);
}

template <class N>
void TwoRing<N>::interior_sector(int i, long steps, TwoRingSector<N>& s) const {
  using detail::kE, detail::kF, detail::kG, detail::kH, detail::kP, detail::kR;
  s = {};
  const auto n = static_cast<std::size_t>(interior_->faces());
  const CircleTable<N>& circle = circle_table<N>(static_cast<long>(n));
  std::vector<typename InteriorKind<N>::Block> buffer;
  const auto& power = interior_->power(steps, buffer);
  for (std::size_t m = 0; m < amplitudes_.size(); ++m) {
    std::array<Amplitude, 6> x{};
    for (std::size_t row = 0; row < 6; ++row)
      for (std::size_t k = 0; k < 6; ++k) {
        const auto& a = power[m][row][k];
        const Amplitude& y = amplitudes_[m][k];
        x[row][0] += y[0] * a.re - y[1] * a.im;
        x[row][1] += y[0] * a.im + y[1] * a.re;
      }
    const N count = N(m == 0 || 2 * m == n ? 1 : 2);
    const auto add = [&](Vec3<N>& point, std::size_t type, int at) {
      const std::size_t k =
          2 * (m * static_cast<std::size_t>((i + at) % static_cast<int>(n) + static_cast<int>(n)) % n);
      point += (x[type][0] * circle.cosine[k] - x[type][1] * circle.sine[k]) * count;
    };
    for (int at = -2; at <= 3; ++at) add(s.e[static_cast<std::size_t>(at + 2)], kE, at);
    for (int at = -2; at <= 2; ++at) add(s.f[static_cast<std::size_t>(at + 2)], kF, at);
    add(s.p[0], kP, 0), add(s.p[1], kP, 1);
    add(s.g, kG, 0), add(s.h, kH, 0), add(s.r, kR, 0);
    add(s.h_before, kH, -1), add(s.g_after, kG, 1);
    if (m == 0 && !interior_->is_held()) {
      const N entries = N(static_cast<int>(n));
      s.c_after = x[kE][0] * (N(3) / (N(2) * entries)) + x[kF][0] * (N(1) / (N(4) * entries));
      s.c_to_limit = (x[kE][0] * N(4) + x[kF][0]) * (N(1) / (entries + N(5)));
    }
  }
}

}  // namespace limitcheck::reference::catmull_clark
