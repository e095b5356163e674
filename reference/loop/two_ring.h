// SPDX-License-Identifier: MIT
// The two-ring of an extraordinary vertex inside after any number of subdivision steps, in closed form.
//
// After one step everything around a vertex c but c itself is regular. Its two-ring is
//
//        p_2     q_1     p_1         r_i  the ring: on the spokes
//            r_2 --- r_1             q_i  beyond the ring edge r_i, r_{i+1}
//      q_2   /  \   /  \   q_0       p_i  on the spoke, beyond r_i
//          r_3 -- c -- r_0  -- p_0
//
// The subdivision matrix of these points, written in discrete Fourier modes (cosine and sine of i theta,
// theta = 2 pi f / n), falls apart into lower triangular blocks:
//
//   r' = lambda r,                                        lambda = 3/8 + cos(theta)/4
//   q' = 3/4 cos(theta/2) r + 1/8 q                       (q sits at the half angle)
//   p' = (5/8 + cos(theta)/8) r + 1/8 cos(theta/2) q + 1/16 p
//
// c couples with the mean of r: eigenvalues 1 and 5/8 - a, a = ring_weight(n). So all eigenvalues are known in
// closed form. The powers of a triangular block are divided differences of x^J at its eigenvalues (Opitz), for
// example (lambda^J - 8^-J) / (lambda - 1/8), or J lambda^(J-1) where two coincide: at n = 3 (1/16 twice, D8).
// `BlockPower` computes all of them without cancellation.
//
// Vertices on the boundary, held ones and darts take the steps (stepped_ring.h).
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

#include "reference/loop/masks.h"
#include "reference/number/number.h"
#include "reference/number/vec3.h"

namespace limitcheck::reference {

/// The points around face i of a vertex, (c, r_i, r_{i+1}), after J steps, divided by growth^J:
///   r[0..5] = r_{i-2} .. r_{i+3}, q[0..2] = q_{i-1} .. q_{i+1}, p[0..1] = p_i, p_{i+1}
/// Beyond a boundary edge of the face r_{i-1} and q_{i-1} (r_{i+2} and q_{i+1}) are ghosts; points farther
/// beyond it are not set.
template <class N>
struct RingPoints {
  Vec3<N> c, r[6], q[3], p[2];
  Vec3<N> c_after;     ///< c after one more step
  Vec3<N> c_to_limit;  ///< what the points are away from differences to the limit
  bool first_edge_on_boundary, last_edge_on_boundary;
};

/// The part of the surface that is linear on a face and is not in its RingPoints: gradient with respect to the
/// coordinates of r_i and r_{i+1}, and the size of the rounding that they carry.
template <class N>
struct LinearPart {
  Vec3<N> to_first, to_second;
  N first_size{}, second_size{};
};

/// x^J, y^J, z^J and the divided differences of t^J at them: xy = (x^J - y^J) / (x - y), and so on. They are
/// the entries of the J-th power of the bidiagonal matrix (x 1; y 1; z), computed by repeated squaring: sums
/// of positive terms only, O(log J), and x, y, z may be equal.
template <class N>
struct BlockPower {
  N x, y, z, xy, yz, xz, xyz;

  BlockPower(const N& x1, const N& y1, const N& z1, long exponent)
      : x(1), y(1), z(1), xy(0), yz(0), xz(0), xyz(0) {
    for (int bit = std::bit_width(static_cast<unsigned long>(exponent)) - 1; bit >= 0; --bit) {
      xyz = x * xyz + xy * yz + xyz * z;
      xy = xy * (x + y);
      yz = yz * (y + z);
      xz = xz * (x + z);
      x = x * x;
      y = y * y;
      z = z * z;
      if (((exponent >> bit) & 1) == 0) continue;
      xyz = x1 * xyz + yz;
      xy = x1 * xy + y;
      yz = y1 * yz + z;
      xz = x1 * xz + z;
      x = x * x1;
      y = y * y1;
      z = z * z1;
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
  Mode mean;       ///< of the mode of 5/8 - a
  N c;             ///< its factor in the centre
  N own_q, own_p;  ///< 8^-J, 16^-J
  N q_to_p;        ///< factor of q_i and q_{i-1} in p_i
};

/// The modes of all two-rings of valence n.
template <class N>
class TwoRingModes {
 public:
  TwoRingModes(int n, Weights weights);

  int count() const { return count_; }
  /// Largest eigenvalue below 1: derivatives of order d grow like (2^d growth)^J towards the vertex.
  const N& growth() const { return growth_; }
  /// Eigenvalue of the centre's own mode: 5/8 - ring_weight(n).
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

  /// Index of the angle of mode m at the half position h, in units of pi / n: r_i is at 2 i, q_i at 2 i + 1.
  std::size_t angle(std::size_t mode, long h) const {
    const auto turn = static_cast<long>(circle_.cosine.size());
    const long i = frequency_[mode] * h % turn;
    return i < 0 ? i + turn : i;
  }

  int count_;
  CircleTable<N> circle_;
  std::vector<int> frequency_;
  std::vector<N> eigenvalue_, cosine_, half_cosine_;
  N a_, mean_eigenvalue_, growth_;
  std::vector<TwoRingPower<N>> table_;
};

/// The points of a two-ring as amplitudes of the modes. Face i of the vertex is (c, r_i, r_{i+1}).
template <class N>
class TwoRing {
 public:
  /// All have n entries. Keeps a pointer to the modes.
  TwoRing(const TwoRingModes<N>& modes, const Vec3<N>& c, const std::vector<Vec3<N>>& r,
          const std::vector<Vec3<N>>& q, const std::vector<Vec3<N>>& p);

  int faces() const { return modes_->count(); }
  bool on_boundary() const { return false; }
  const N& growth() const { return modes_->growth(); }
  const Vec3<N>& limit() const { return limit_; }
  /// The largest coordinate that the points after J steps were computed from: every amplitude, however small,
  /// carries the rounding of that. 0 unless kRounds<N>.
  const N& size(long /*exponent*/) const { return size_; }
  LinearPart<N> linear_part(int /*face*/) const { return {}; }

  /// Around a face after J steps, without limit.
  RingPoints<N> face_points(int face, long steps) const;

 private:
  const TwoRingModes<N>* modes_;
  Vec3<N> limit_, mean_;
  N size_{};                            ///< largest coordinate of the points
  std::vector<Vec3<N>> cosine_, sine_;  ///< amplitudes of the modes
  std::vector<Vec3<N>> q_, p_;          ///< first q_i, p_i, without limit
};

template <class N>
TwoRingModes<N>::TwoRingModes(int n, Weights weights)
    : count_(n),
      circle_(circle_table<N>(n)),
      a_(ring_weight<N>(n, weights)),
      mean_eigenvalue_(N(5) / N(8) - a_) {
  for (int f = 1; 2 * f <= n; ++f) {
    frequency_.push_back(f);
    cosine_.push_back(NumberTraits<N>::cos_pi(2 * f, n));
    half_cosine_.push_back(NumberTraits<N>::cos_pi(f, n));
    eigenvalue_.push_back(N(3) / N(8) + cosine_.back() / N(4));
  }
  growth_ = eigenvalue_.front();
  for (long e = 0; e < kTable; ++e) table_.push_back(power(e));
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
  const N a3 = a_ / N(3), to_q = N(3) / N(4) - a3, to_p = N(3) / N(4) - a3 / N(2);
  result.c = block.x * (N(0) - a3 * N(8));
  result.mean = {block.x, block.xy * to_q * s, block.xz * to_p * s + block.xyz * (to_q / N(8)) * s2};
  result.own_q = block.y;
  result.own_p = block.z;
  result.q_to_p = block.yz * s / N(16);
  return result;
}

template <class N>
TwoRing<N>::TwoRing(const TwoRingModes<N>& modes, const Vec3<N>& c, const std::vector<Vec3<N>>& r,
                    const std::vector<Vec3<N>>& q, const std::vector<Vec3<N>>& p)
    : modes_(&modes), cosine_(modes.frequency_.size()), sine_(modes.frequency_.size()), q_(q), p_(p) {
  if constexpr (kRounds<N>) {
    size_ = magnitude(c);
    for (const auto* points : {&r, &q, &p})
      for (const Vec3<N>& x : *points) size_ = std::max(size_, magnitude(x));
  }
  const int count = modes.count_;
  Vec3<N> sum{};
  for (const Vec3<N>& x : r) sum += x - c;
  const N a83 = modes.a_ * N(8) / N(3);
  mean_ = sum * (N(1) / (N(count) * (N(1) + a83)));
  limit_ = c + mean_ * a83;
  for (std::size_t m = 0; m < sine_.size(); ++m) {
    for (int i = 0; i < count; ++i) {
      const std::size_t at = modes.angle(m, 2 * i);
      cosine_[m] += (r[i] - c) * modes.circle_.cosine[at];
      sine_[m] += (r[i] - c) * modes.circle_.sine[at];
    }
    const bool alone = 2 * modes.frequency_[m] == count;
    const N factor = N(alone ? 1 : 2) / N(count);
    cosine_[m] *= factor;
    sine_[m] *= factor;
  }
  for (auto* points : {&q_, &p_})
    for (Vec3<N>& x : *points) x -= limit_;
}

template <class N>
RingPoints<N> TwoRing<N>::face_points(int face, long steps) const {
  TwoRingPower<N> buffer;
  const TwoRingPower<N>& power = modes_->power(steps, buffer);
  RingPoints<N> s{};
  s.c = mean_ * power.c;
  s.c_after = s.c * modes_->mean_eigenvalue();
  const auto& circle = modes_->circle_;
  const int count = modes_->count_;
  const auto wrap = [count](int k) { return (k % count + count) % count; };
  for (auto& r : s.r) r = mean_ * power.mean.r;
  for (int k = 0; k < 3; ++k) s.q[k] = mean_ * power.mean.q + q_[wrap(face - 1 + k)] * power.own_q;
  for (int k = 0; k < 2; ++k)
    s.p[k] = mean_ * power.mean.p + p_[wrap(face + k)] * power.own_p +
             (q_[wrap(face + k)] + q_[wrap(face + k - 1)]) * power.q_to_p;
  const std::size_t turn = circle.cosine.size();
  for (std::size_t m = 0; m < cosine_.size(); ++m) {
    const auto& mode = power.modes[m];
    const auto wave = [&](std::size_t at) {
      return cosine_[m] * circle.cosine[at] + sine_[m] * circle.sine[at];
    };
    // Half positions h = 2 (face - 2) .. 2 (face + 3): r at the even ones, q at the odd ones.
    std::size_t at = modes_->angle(m, 2L * (face - 2));
    for (int h = 0; h <= 10; ++h) {
      if (h % 2 == 0) {
        const Vec3<N> w = wave(at);
        s.r[h / 2] += w * mode.r;
        if (h == 4 || h == 6) s.p[h / 2 - 2] += w * mode.p;
      } else if (h >= 3 && h <= 7) {
        s.q[(h - 3) / 2] += wave(at) * mode.q;
      }
      at += modes_->frequency_[m];
      if (at >= turn) at -= turn;
    }
  }
  return s;
}

}  // namespace limitcheck::reference
