// SPDX-License-Identifier: MIT
// The subdivision matrix around an extraordinary vertex: its eigenvalues, and its powers in closed form.
//
// After one step everything around a vertex c but c itself is regular. Its two-ring is
//
//        p_2     q_1     p_1         r_i  the ring: on the spokes
//            r_2 --- r_1             q_i  beyond the ring edge r_i, r_{i+1}
//      q_2   /  \   /  \   q_0       p_i  on the spoke, beyond r_i
//          r_3 -- c -- r_0  -- p_0
//
// The subdivision matrix of these points, written in discrete Fourier modes (cosine and sine of i theta,
// theta = 2 pi f / n; at a boundary vertex of K faces the sines, theta = f pi / K), falls apart into lower
// triangular blocks:
//
//   r' = lambda r,                                        lambda = 3/8 + cos(theta)/4
//   q' = 3/4 cos(theta/2) r + 1/8 q                       (q sits at the half angle)
//   p' = (5/8 + cos(theta)/8) r + 1/8 cos(theta/2) q + 1/16 p
//
// c couples with the mean of r: eigenvalues 1 and 5/8 - a, a = ring_weight(n). At a boundary vertex the three
// points c, r_0, r_K of the curve have 1, 1/2, 1/4. So all eigenvalues are known in closed form. The powers
// of a triangular block are divided differences of x^J at its eigenvalues (Opitz), for example
// (lambda^J - 8^-J) / (lambda - 1/8), or J lambda^(J-1) where two coincide. That happens in the Jordan
// blocks: at n = 3 (1/16 twice, D8) and in the curve's mode of 1/2 at K = 6, 12, .. (1/2 twice). `BlockPower`
// computes all of them without cancellation.
#pragma once

#include <cstddef>
#include <vector>

#include "reference/loop/weights.h"
#include "reference/number/circle_table.h"

namespace limitcheck::reference {

/// What the J-th power of the matrix does to each mode, divided by growth^J.
template <class N>
struct TwoRingPower {
  struct Mode {
    N r, q, p;  ///< factors of the mode's amplitude in r_i, q_i, p_i
  };
  std::vector<Mode> modes;
  Mode mean;         ///< interior: of the mode of 5/8 - a
  N c;               ///< its factor in the centre; boundary: that of the mode of 1/4
  N b8, b16, b8_16;  ///< boundary: divided differences at (1/4, 1/8), (1/4, 1/16), (1/4, 1/8, 1/16)
  N own_q, own_p;    ///< 8^-J, 16^-J
  N q_to_p;          ///< factor of q_i and q_{i-1} in p_i
  N half;            ///< 2^-J, for the Jordan block of K = 6, 12, ..
};

/// The modes of all two-rings of one kind. `count` is the valence n, or the number of faces K on the
/// boundary.
template <class N>
class TwoRingModes {
 public:
  TwoRingModes(int count, bool on_boundary, Weights weights);

  int count() const { return count_; }
  bool on_boundary() const { return on_boundary_; }
  /// Largest eigenvalue below 1 whose eigenfunction is not linear on every face: derivatives of order d grow
  /// like (2^d growth)^J towards the vertex.
  const N& growth() const { return growth_; }
  /// Eigenvalue of the centre's own mode: 5/8 - ring_weight(n), or 1/4 on the boundary.
  const N& mean_eigenvalue() const { return mean_eigenvalue_; }
  TwoRingPower<N> power(long exponent) const;
  /// The same, from a table when the exponent is small; `buffer` is used otherwise.
  const TwoRingPower<N>& power(long exponent, TwoRingPower<N>& buffer) const {
    if (exponent < kTable) return table_[exponent];
    buffer = power(exponent);
    return buffer;
  }

 private:
  static constexpr long kTable = 40;
  template <class M>
  friend class TwoRing;

  /// A mode as values at the points.
  struct Values {
    std::vector<N> r, q, p;
  };
  Values along_mode() const;
  Values even_mode() const;

  /// Index of the angle pi i / (2 count) on the boundary, pi i / count inside; a whole turn is 4 count or
  /// 2 count.
  std::size_t turn(long i) const {
    const auto m = static_cast<long>(circle_.cosine.size());
    i %= m;
    return i < 0 ? i + m : i;
  }
  /// Index of the angle of mode m at the half position h: r_i is at 2 i, q_i at 2 i + 1.
  std::size_t angle(std::size_t mode, long h) const { return turn(frequency_[mode] * h); }

  int count_;
  bool on_boundary_;
  bool jordan_;           ///< boundary, K = 6, 12, ..
  int linear_frequency_;  ///< boundary, K = 3, 6, ..: of the sine mode that is linear on every face; else 0
  CircleTable<N> circle_;
  std::vector<int> frequency_;
  std::vector<N> eigenvalue_, cosine_, half_cosine_;
  N a_, mean_eigenvalue_, growth_;
  N kappa_;       ///< jordan_: the matrix makes along / 2 + kappa (linear sine mode) of along
  Values along_;  ///< boundary: the curve's mode of 1/2, or its generalised vector if jordan_
  Values even_;   ///< boundary: the curve's mode of 1/4 in r; in q and p what it feeds them
  std::vector<TwoRingPower<N>> table_;
};

}  // namespace limitcheck::reference
