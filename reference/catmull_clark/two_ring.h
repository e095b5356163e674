// SPDX-License-Identifier: MIT
// The points around an extraordinary vertex after any number of steps.
//
// After one step all that is near a vertex c is regular but c itself. Its two-ring has six points a sector,
// seen in the frame with c = (0, 0), e_i = (1, 0), e_{i+1} = (0, 1):
//
//      p_{i+1} --- h_i --- r_i        e   the neighbours of c        p   beyond them, (2, 0)
//         |         |       |         f   opposite c, (1, 1)         r   beyond those, (2, 2)
//      e_{i+1} --- f_i --- g_i        g   (2, 1)                     h   (1, 2)
//         |         |       |
//         c ------ e_i --- p_i
//
// One step is a linear map of these points. Two things make its powers cheap and accurate:
//   - All points are taken as differences from c. What is left of the map has no eigenvalue 1, so that a
//     point's distance from c keeps its relative accuracy however close they come.
//   - Around an interior vertex, Fourier's transform in i takes the map apart into one 6 x 6 block for each
//     frequency [Stam 1998]; its J-th power comes by repeated squaring. No eigenvector is needed, and no case
//     distinction where eigenvalues coincide.
// On the boundary, at darts, and where there are so many faces that the transform would be slow, the steps
// are taken, each with as many neighbours only as the sector that is asked for still hears of. Only c hears of
// all; how it moves is known beforehand, except at a dart. They are scaled by 2^J, so that weights are exact.
// Everything is divided by growth^J, so that nothing underflows: growth is the largest eigenvalue.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "reference/catmull_clark/masks.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/number/vec3.h"

namespace limitcheck::reference::catmull_clark {

/// The points around one sector that the next step's patches need, as differences from c, and c itself as
/// difference from the limit. Outside an open sector they are zero, and `before`, `after` say so.
template <class N>
struct TwoRingSector {
  /// What lies on the other side of edge c - e_i (before) or c - e_{i+1} (after).
  enum class Side { kBoundary, kFaceThenBoundary, kFaces };

  std::array<Vec3<N>, 6> e;  ///< e_{i-2} .. e_{i+3}
  std::array<Vec3<N>, 5> f;  ///< f_{i-2} .. f_{i+2}
  std::array<Vec3<N>, 2> p;  ///< p_i, p_{i+1}
  Vec3<N> g, h, r;
  Vec3<N> h_before, g_after;  ///< h_{i-1}, g_{i+1}
  Vec3<N> c_after;            ///< c after one more step
  Vec3<N> c_to_limit;         ///< limit - c
  Side before = Side::kFaces, after = Side::kFaces;
};

/// The two-ring of a vertex as it is given, in its own coordinates.
template <class N>
struct TwoRingPoints {
  Vec3<N> c;
  std::vector<Vec3<N>> e, p;        ///< n, on the boundary K + 1
  std::vector<Vec3<N>> f, g, h, r;  ///< n or K
};

/// All that a vertex of n faces has in common with others; n other than 4, if it is not held: the tip of a
/// cone.
template <class N>
class InteriorKind {
 public:
  InteriorKind(int n, VertexState state);
  int faces() const { return faces_; }
  bool is_held() const { return held_; }
  const N& growth() const { return growth_; }

  struct Complex {
    N re{}, im{};
  };
  using Block = std::array<std::array<Complex, 6>, 6>;  ///< of e, f, p, g, h, r
  /// The J-th power of each frequency's block, over growth^J: frequencies 0 .. n / 2.
  std::vector<Block> power(long exponent) const;
  const std::vector<Block>& power(long exponent, std::vector<Block>& buffer) const;

 private:
  int faces_;
  bool held_;
  N growth_;
  std::vector<Block> step_;
  std::vector<std::vector<Block>> table_;  ///< of small exponents
};

/// From so many faces on, an interior vertex takes steps, too.
inline constexpr int kManyFaces = 65;

/// The same of a vertex that takes the steps: on the boundary an ordinary one of K faces, K other than 2, or
/// a held one, K other than 1; a dart, which has an open sector; inside one of many faces.
template <class N>
class SteppedRingKind {
 public:
  SteppedRingKind(int faces, bool closed, VertexState state);
  int faces() const { return faces_; }
  bool closed() const { return closed_; }
  VertexState state() const { return state_; }
  /// What the points are divided by in a step, exactly, and how they grow then.
  static N growth() { return N(1) / N(2); }
  const N& grown() const { return grown_; }

  /// What c hears of a ring: on the boundary e_0 + e_K, otherwise the means of all e_i and of all f_i.
  struct Heard {
    Vec3<N> e, f;
  };
  Heard heard(std::span<const Vec3<N>> e, std::span<const Vec3<N>> f) const;
  /// The same after a step, over the growth. A dart needs the ring itself.
  Heard next(const Heard& heard) const;
  /// What such a ring adds to c: in one step, and in the limit.
  Vec3<N> after(const Heard& heard) const;
  Vec3<N> to_limit(const Heard& heard, std::span<const Vec3<N>> e, std::span<const Vec3<N>> f) const;

 private:
  bool hears_ends() const { return !closed_ && state_ == VertexState::kOrdinary; }
  int faces_;
  bool closed_;
  VertexState state_;
  N grown_;
};

/// The two-ring of one vertex.
template <class N>
class TwoRing {
 public:
  TwoRing(const InteriorKind<N>& kind, const TwoRingPoints<N>& points);
  TwoRing(const SteppedRingKind<N>& kind, const TwoRingPoints<N>& points);

  N growth() const { return interior_ != nullptr ? interior_->growth() : stepped_->growth(); }
  const Vec3<N>& limit() const { return limit_; }
  /// What the rounding of the points after J steps is relative to, over growth^J: the largest coordinate of
  /// those given, grown as they are.
  N size(long steps) const;
  /// Sector i after J steps, over growth^J.
  void sector(int i, long steps, TwoRingSector<N>& s) const;

 private:
  using Amplitude = std::array<Vec3<N>, 2>;  ///< real and imaginary part
  void interior_sector(int i, long steps, TwoRingSector<N>& s) const;
  void stepped_sector(int i, long steps, TwoRingSector<N>& s) const;

  const InteriorKind<N>* interior_ = nullptr;
  const SteppedRingKind<N>* stepped_ = nullptr;
  Vec3<N> limit_;
  N size_{};
  std::vector<std::array<Amplitude, 6>> amplitudes_;  ///< interior: of each frequency
  TwoRingPoints<N> points_;                           ///< stepped: differences from c
  typename SteppedRingKind<N>::Heard heard_;
};

// Definitions.

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
