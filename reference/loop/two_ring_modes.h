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
#include <utility>
#include <vector>

#include "reference/loop/masks.h"
#include "reference/number/number.h"

namespace limitcheck::reference {

/// x^J, y^J, z^J and the divided differences of t^J at them: xy = (x^J - y^J) / (x - y), and so on. They are
/// the entries of the J-th power of the bidiagonal matrix (x 1; y 1; z), computed by repeated squaring: sums
/// of positive terms only, O(log J), and x, y, z may be equal.
template <class N>
struct BlockPower {
  N x, y, z, xy, yz, xz, xyz;

  BlockPower(const N& x1, const N& y1, const N& z1, long exponent)
      : x(1), y(1), z(1), xy(0), yz(0), xz(0), xyz(0) {
    int bit = 0;
    while ((exponent >> bit) > 1) ++bit;
    if (exponent > 0) {
      for (; bit >= 0; --bit) {
        xyz = x * xyz + xy * yz + xyz * z;
        xy = xy * (x + y);
        yz = yz * (y + z);
        xz = xz * (x + z);
        x = x * x;
        y = y * y;
        z = z * z;
        if (((exponent >> bit) & 1) != 0) {
          xyz = x1 * xyz + yz;
          xy = x1 * xy + y;
          yz = y1 * yz + z;
          xz = x1 * xz + z;
          x = x * x1;
          y = y * y1;
          z = z * z1;
        }
      }
    }
  }
};

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

template <class N>
TwoRingModes<N>::TwoRingModes(int count, bool on_boundary, Weights weights)
    : count_(count),
      on_boundary_(on_boundary),
      jordan_(on_boundary && count % 6 == 0),
      linear_frequency_(on_boundary && count % 3 == 0 ? count / 3 : 0),
      circle_(circle_table<N>(on_boundary ? 2 * count : count)) {
  // Mode f has theta = 2 pi f / n inside, f <= n/2, and f pi / K on the boundary, f < K.
  for (int f = 1; on_boundary ? f < count : 2 * f <= count; ++f) {
    if (f == linear_frequency_) continue;
    frequency_.push_back(f);
    const N cosine = on_boundary ? NumberTraits<N>::cos_pi(f, count) : NumberTraits<N>::cos_pi(2 * f, count);
    cosine_.push_back(cosine);
    half_cosine_.push_back(on_boundary ? NumberTraits<N>::cos_pi(f, 2 * count)
                                       : NumberTraits<N>::cos_pi(f, count));
    eigenvalue_.push_back(N(3) / N(8) + cosine / N(4));
  }
  if (on_boundary) {
    mean_eigenvalue_ = N(1) / N(4);
    kappa_ = jordan_ ? sin_pi<N>(1, 3) / N(2 * count) : N(0);
    along_ = along_mode();
    even_ = even_mode();
    growth_ = count <= 1 ? N(1) / N(4) : eigenvalue_.front();
  } else {
    a_ = ring_weight<N>(count, weights);
    mean_eigenvalue_ = N(5) / N(8) - a_;
    growth_ = eigenvalue_.front();
  }
  for (long e = 0; e < kTable; ++e) table_.push_back(power(e));
}

/// The curve's mode of 1/2: c = 0, r_0 = 1, r_K = -1, and r_i = r_{i-1} + r_{i+1}, linear on every face.
/// Where sin(K pi / 6) = 0 this has no solution, and (1 - 2i/K) cos(i pi / 3) is a generalised eigenvector.
template <class N>
typename TwoRingModes<N>::Values TwoRingModes<N>::along_mode() const {
  const auto sin_third = [](long i) { return sin_pi<N>(i, 3); };
  Values mode;
  auto& [r, q, p] = mode;
  for (int i = 0; i <= count_; ++i)
    r.push_back(jordan_ ? NumberTraits<N>::cos_pi(i, 3) * (N(count_ - 2 * i) / N(count_))
                        : sin_pi<N>(count_ - 2 * i, 6) / sin_pi<N>(count_, 6));
  for (int i = 0; i < count_; ++i) {
    const N sum = r[i] + r[i + 1];
    q.push_back(jordan_ ? (sum * N(3) - (sin_third(i) + sin_third(i + 1)) * kappa_ * N(8)) / N(3) : sum);
  }
  for (int i = 0; i <= count_; ++i) {
    if (!jordan_ || i == 0 || i == count_)
      p.push_back(r[i] * N(2));
    else
      p.push_back((N(10) * r[i] + r[i - 1] + r[i + 1] + q[i] + q[i - 1] - N(32) * kappa_ * sin_third(i)) /
                  N(7));
  }
  return mode;
}

/// The curve's mode of 1/4: c = -1/2, r_0 = r_K = 1, and r_i = 3/2 - r_{i-1} - r_{i+1}.
template <class N>
typename TwoRingModes<N>::Values TwoRingModes<N>::even_mode() const {
  const auto cos_third = [](long i) { return NumberTraits<N>::cos_pi(i, 3); };
  Values mode;
  auto& [r, q, p] = mode;
  for (int i = 0; i <= count_; ++i)
    r.push_back((N(1) + cos_third(2 * i - count_) / cos_third(count_)) / N(2));
  for (int i = 0; i < count_; ++i) q.push_back((N(6) * (r[i] + r[i + 1]) - N(1)) / N(16));
  for (int i = 0; i <= count_; ++i)
    p.push_back(i == 0 || i == count_ ? N(11) / N(16)
                                      : (N(20) * r[i] + N(2) * (r[i - 1] + r[i + 1]) - N(1)) / N(32));
  return mode;
}

template <class N>
TwoRingPower<N> TwoRingModes<N>::power(long exponent) const {
  const N s = N(1) / growth_, s2 = s * s;
  const N eighth = s / N(8), sixteenth = s / N(16);
  TwoRingPower<N> result;
  result.modes.reserve(eigenvalue_.size());
  for (std::size_t m = 0; m < eigenvalue_.size(); ++m) {
    const BlockPower<N> block(eigenvalue_[m] * s, eighth, sixteenth, exponent);
    const N to_q = half_cosine_[m] * (N(3) / N(4));
    const N to_p = N(5) / N(8) + cosine_[m] / N(8);
    const N q_to_p = half_cosine_[m] / N(8);
    result.modes.push_back(
        {block.x, block.xy * to_q * s, block.xz * to_p * s + block.xyz * (to_q * q_to_p) * s2});
  }
  const BlockPower<N> block(mean_eigenvalue_ * s, eighth, sixteenth, exponent);
  result.mean = {block.x, N(0), N(0)};
  if (on_boundary_) {
    result.c = block.x * (N(0) - N(1) / N(2));
    result.b8 = block.xy * s;
    result.b16 = block.xz * s;
    result.b8_16 = block.xyz * s2;
    result.half = reference::power(s / N(2), exponent);
  } else {
    const N a3 = a_ / N(3), to_q = N(3) / N(4) - a3, to_p = N(3) / N(4) - a3 / N(2);
    result.c = block.x * (N(0) - a3 * N(8));
    result.mean.q = block.xy * to_q * s;
    result.mean.p = block.xz * to_p * s + block.xyz * (to_q / N(8)) * s2;
  }
  result.own_q = block.y;
  result.own_p = block.z;
  result.q_to_p = block.yz * s / N(16);
  return result;
}

}  // namespace limitcheck::reference
