// SPDX-License-Identifier: MIT
// The two-ring of one extraordinary vertex after any number of subdivision steps.
#pragma once

#include <vector>

#include "reference/loop/block_power.h"
#include "reference/loop/two_ring_modes.h"
#include "reference/number/vec3.h"

namespace limitcheck::reference {

/// The points of a two-ring as amplitudes of the modes. Face i of the vertex is (c, r_i, r_{i+1}), with the
/// names of two_ring_modes.h.
template <class N>
class TwoRing {
 public:
  /// r and p have K + 1 entries on the boundary, everything else `count`. Keeps a pointer to the modes.
  TwoRing(const TwoRingModes<N>& modes, const Vec3<N>& c, const std::vector<Vec3<N>>& r,
          const std::vector<Vec3<N>>& q, const std::vector<Vec3<N>>& p);

  const TwoRingModes<N>& modes() const { return *modes_; }
  const Vec3<N>& limit() const { return limit_; }
  /// The largest coordinate that the points after J steps were computed from: every amplitude, however small,
  /// carries the rounding of that. 0 unless kRounds<N>.
  N size(long exponent) const { return size_ * reference::power(decay_, exponent); }

  /// The part of the surface that is linear on a face: gradient with respect to the coordinates of r_i and
  /// r_{i+1}, and the size of the rounding that they carry, like size(). Zero except on the boundary.
  struct LinearPart {
    Vec3<N> to_first, to_second;
    N first_size{}, second_size{};
  };
  LinearPart linear_part(int face, long exponent) const;

  /// Near a boundary vertex of K != 3 faces one mode outgrows the others, and d1 and d2 become parallel to
  /// its amplitude A: d1 = f1 A + r1, d2 = f2 A + r2. The first of these two-rings lacks that mode and gives
  /// r1 and r2. The second has nothing else, with (1, 0, 0) for A, and gives f1 and f2.
  TwoRing without_dominant() const;
  TwoRing only_dominant() const;

  /// The points around face i after J steps, without limit and linear part, divided by growth^J:
  ///   r[0..5] = r_{i-2} .. r_{i+3}, q[0..2] = q_{i-1} .. q_{i+1}, p[0..1] = p_i, p_{i+1}
  /// Beyond a boundary edge of the face r_{i-1} and q_{i-1} (r_{i+2} and q_{i+1}) are ghosts; points farther
  /// beyond it are not set.
  struct FacePoints {
    Vec3<N> c, r[6], q[3], p[2];
    bool first_edge_on_boundary, last_edge_on_boundary;
  };
  void face_points(int face, const TwoRingPower<N>& power, FacePoints& result) const;

 private:
  void find_amplitudes_inside(const Vec3<N>& c, const std::vector<Vec3<N>>& r);
  void find_amplitudes_on_boundary(const Vec3<N>& c, const std::vector<Vec3<N>>& r);
  void inside_points(int face, const TwoRingPower<N>& power, FacePoints& result) const;
  void boundary_points(int face, const TwoRingPower<N>& power, FacePoints& result) const;
  // r_k, q_k, p_k on the boundary
  Vec3<N> boundary_r(int k, const TwoRingPower<N>& power) const;
  Vec3<N> boundary_q(int k, const TwoRingPower<N>& power) const;
  Vec3<N> boundary_p(int k, const TwoRingPower<N>& power) const;
  bool along_dominates() const { return modes_->count_ <= 2; }

  const TwoRingModes<N>* modes_;
  Vec3<N> limit_, mean_, along_, linear_;
  N size_{}, along_size_{};  ///< largest coordinate of the points; 0 for along_ where it is left out
  N decay_{1};               ///< largest eigenvalue of the modes that are not left out, over growth
  std::vector<Vec3<N>> cosine_, sine_;  ///< amplitudes of the modes; no cosines on the boundary
  std::vector<Vec3<N>> q_, p_;          ///< first q_i, p_i, without limit and linear part
};

}  // namespace limitcheck::reference
