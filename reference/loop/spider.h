// SPDX-License-Identifier: MIT
// Powers of the subdivision matrix around an extraordinary vertex, from its eigenvalues.
//
// After one step everything around a vertex c but c itself is regular. Its two-ring, the spider, is
//
//        p_2     q_1     p_1         r_i  the ring: on the spokes
//            r_2 --- r_1             q_i  beyond the ring edge r_i, r_{i+1}
//      q_2   /  \   /  \   q_0       p_i  on the spoke, beyond r_i
//          r_3 -- c -- r_0  -- p_0
//
// and the subdivision matrix of these points, written in discrete Fourier modes (cos, sin of i theta, theta =
// 2 pi f / n; the sines with theta = k pi / K at a boundary vertex of K faces), falls apart into lower
// triangular blocks:
//
//   r' = lambda r,                                        lambda = 3/8 + cos(theta)/4
//   q' = 3/4 cos(theta/2) r + 1/8 q                       (q sits at the half angle)
//   p' = (5/8 + cos(theta)/8) r + 1/8 cos(theta/2) q + 1/16 p
//
// c couples with the mean of r: eigenvalues 1 and 5/8 - a, a = ring_weight(n). At a boundary vertex (c, r_0,
// r_K) has 1, 1/2, 1/4. All eigenvalues are thus known in closed form. The powers of a triangular block are
// divided differences of x^J at its eigenvalues (Opitz), e.g. (lambda^J - 8^-J) / (lambda - 1/8), or J
// lambda^(J-1) where two coincide: the Jordan blocks, at n = 3 (1/16 twice, D8) and in the curve mode at K =
// 6, 12, .. (1/2 twice). `BlockPower` computes all of them without cancellation.
#pragma once

#include <cstddef>
#include <vector>

#include "reference/loop/masks.h"
#include "reference/number/vec3.h"

namespace limitcheck::reference {

/// x^J, y^J, z^J and the divided differences of t^J at them: xy = (x^J - y^J) / (x - y), and so on. By
/// repeated squaring of the bidiagonal matrix (x 1; y 1; z): sums of positive terms only, O(log J), equal
/// arguments welcome.
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

/// a^e, e >= 0
template <class N>
N power(N a, long e) {
  N result(1);
  for (; e > 0; e >>= 1) {
    if ((e & 1) != 0) result = result * a;
    if (e > 1) a = a * a;
  }
  return result;
}

/// What the J-th power of the matrix does to each mode; everything divided by growth^J.
template <class N>
struct SpiderPower {
  struct Mode {
    N r, q, p;  ///< factors of the mode's amplitude in r_i, q_i, p_i
  };
  std::vector<Mode> modes;
  Mode mean;         ///< interior: the mode of 5/8 - a
  N c;               ///< its factor in the centre (boundary: of the mode of 1/4)
  N b8, b16, b8_16;  ///< boundary: divided differences at (1/4, 1/8), (1/4, 1/16), (1/4, 1/8, 1/16)
  N own_q, own_p;    ///< 8^-J, 16^-J
  N q_to_p;          ///< what q_i, q_{i-1} hand to p_i
  N half;            ///< 2^-J, for the Jordan block of K = 6, 12, ..
};

/// Everything about a vertex of one kind but the points:
/// `count` = valence n, or number of faces K on the boundary.
template <class N>
class SpiderKind {
 public:
  SpiderKind(int count, bool on_boundary, Weights weights);

  int count() const { return count_; }
  bool on_boundary() const { return on_boundary_; }
  /// Largest eigenvalue below 1 whose eigenfunction is not linear on every face: derivatives of order d grow
  /// like (2^d growth)^J towards the vertex.
  const N& growth() const { return growth_; }
  /// Eigenvalue of the centre's own mode: 5/8 - ring_weight(n), or 1/4 on the boundary.
  const N& mean_eigenvalue() const { return mean_eigenvalue_; }
  SpiderPower<N> power(long exponent) const;
  /// The same, from a table when the exponent is small; `buffer` is used otherwise.
  const SpiderPower<N>& power(long exponent, SpiderPower<N>& buffer) const {
    if (exponent < kTable) return table_[exponent];
    buffer = power(exponent);
    return buffer;
  }

 private:
  static constexpr long kTable = 40;
  template <class M>
  friend class Spider;

  /// cos and sin of pi i / (2 count) on the boundary, pi i / count inside: whole turns are 4 count, 2 count.
  std::size_t turn(long i) const {
    const auto m = static_cast<long>(circle_.cosine.size());
    i %= m;
    return static_cast<std::size_t>(i < 0 ? i + m : i);
  }
  /// Angle index of mode m at half sector position h (even: on a spoke).
  std::size_t angle(std::size_t mode, long h) const { return turn(static_cast<long>(frequency_[mode]) * h); }

  int count_;
  bool on_boundary_;
  bool jordan_;           ///< boundary, K = 6, 12, ..
  int linear_frequency_;  ///< boundary, K = 6, 9, 12, ..: the sine mode of eigenvalue 1/2, linear on every
                          ///< face; or 0
  CircleTable<N> circle_;
  std::vector<int> frequency_;
  std::vector<N> eigenvalue_, cosine_, half_cosine_;
  N a_, mean_eigenvalue_, growth_;
  std::vector<N> along_r_, along_q_,
      along_p_;  ///< boundary: the curve mode of 1/2 (its generalised vector if jordan_)
  std::vector<N> even_r_, even_q_, even_p_;  ///< boundary: the curve mode of 1/4; q, p: what it feeds them
  N kappa_;                                  ///< jordan_: S along = along / 2 + kappa (linear sine mode)
  std::vector<SpiderPower<N>> table_;
};

/// The points around one vertex, as amplitudes of the modes.
template <class N>
class Spider {
 public:
  /// c, r_i, q_i, p_i as drawn above; r and p have K + 1 entries on the boundary, everything else `count`.
  Spider(const SpiderKind<N>& kind, const Vec3<N>& c, const std::vector<Vec3<N>>& r,
         const std::vector<Vec3<N>>& q, const std::vector<Vec3<N>>& p);

  const SpiderKind<N>& kind() const { return *kind_; }
  const Vec3<N>& limit() const { return limit_; }
  /// What the rounding of a sector's points is a part of: every amplitude, however small, carries that of the
  /// largest coordinate it was computed from. 0 unless kRounds<N>.
  N size(long exponent) const { return size_ * reference::power(decay_, exponent); }

  /// The part of the surface that is linear on sector i's triangle (c, r_i, r_{i+1}): gradient with respect
  /// to the coordinates of r_i and r_{i+1}, and the size of the rounding that they carry, like size(). Zero
  /// except on the boundary.
  struct LinearPart {
    Vec3<N> to_first, to_second;
    N first_size{}, second_size{};
  };
  LinearPart linear_part(int sector, long exponent) const;

  /// Near a boundary vertex of K != 3 faces one mode outgrows the others, and d1 and d2 become parallel to
  /// its amplitude A: d1 = f1 A + r1, d2 = f2 A + r2. These are the spider without it, for r1 and r2, and
  /// with (1, 0, 0) in its place and nothing else, for f1 and f2.
  Spider without_dominant() const;
  Spider only_dominant() const;

  /// Points of sector i after J steps, without limit and linear part, divided by growth^J:
  ///   r[0..5] = r_{i-2} .. r_{i+3}, q[0..2] = q_{i-1} .. q_{i+1}, p[0..1] = p_i, p_{i+1}
  /// r_{i-1}, q_{i-1} (r_{i+2}, q_{i+1}) beyond a boundary are ghosts; further ones are not set.
  struct Sector {
    Vec3<N> c, r[6], q[3], p[2];
    bool first_edge_on_boundary, last_edge_on_boundary;
  };
  void sector(int i, const SpiderPower<N>& power, Sector& result) const;

 private:
  bool along_dominates() const { return kind_->count_ <= 2; }

  const SpiderKind<N>* kind_;
  Vec3<N> limit_, mean_, along_, linear_;
  N size_{}, along_size_{};  ///< largest coordinate of the points; 0 for along_ where it is left out
  N decay_{1};               ///< largest eigenvalue of the modes that are not left out, over growth
  std::vector<Vec3<N>> cosine_, sine_;  ///< amplitudes of the modes; no cosines on the boundary
  std::vector<Vec3<N>> q_, p_;          ///< first q_i, p_i, without limit and linear part
};

}  // namespace limitcheck::reference
