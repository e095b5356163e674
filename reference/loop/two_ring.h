// SPDX-License-Identifier: MIT
// The two-ring of one extraordinary vertex after any number of subdivision steps, in closed form.
#pragma once

#include <algorithm>
#include <vector>

#include "reference/loop/two_ring_modes.h"
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

  /// Sets the ghosts.
  void complete() {
    if (first_edge_on_boundary) {
      r[1] = ghost_point(c, r[2], r[3]);
      q[0] = ghost_point(r[2], p[0], q[1]);
    }
    if (last_edge_on_boundary) {
      r[4] = ghost_point(c, r[3], r[2]);
      q[2] = ghost_point(r[3], p[1], q[1]);
    }
  }
};

/// The part of the surface that is linear on a face: gradient with respect to the coordinates of r_i and
/// r_{i+1}, and the size of the rounding that they carry.
template <class N>
struct LinearPart {
  Vec3<N> to_first, to_second;
  N first_size{}, second_size{};
};

/// The points of a two-ring as amplitudes of the modes. Face i of the vertex is (c, r_i, r_{i+1}), with the
/// names of two_ring_modes.h.
template <class N>
class TwoRing {
 public:
  /// r and p have K + 1 entries on the boundary, everything else `count`. Keeps a pointer to the modes.
  TwoRing(const TwoRingModes<N>& modes, const Vec3<N>& c, const std::vector<Vec3<N>>& r,
          const std::vector<Vec3<N>>& q, const std::vector<Vec3<N>>& p);

  int faces() const { return modes_->count(); }
  bool on_boundary() const { return modes_->on_boundary(); }
  const N& growth() const { return modes_->growth(); }
  const Vec3<N>& limit() const { return limit_; }
  /// The largest coordinate that the points after J steps were computed from: every amplitude, however small,
  /// carries the rounding of that. 0 unless kRounds<N>.
  N size(long exponent) const { return size_ * reference::power(decay_, exponent); }

  /// Zero except on the boundary.
  LinearPart<N> linear_part(int face, long exponent) const;

  /// Near a boundary vertex of K != 3 faces one mode outgrows the others, and d1 and d2 become parallel to
  /// its amplitude A: d1 = f1 A + r1, d2 = f2 A + r2. The first of these two-rings lacks that mode and gives
  /// r1 and r2. The second has nothing else, with (1, 0, 0) for A, and gives f1 and f2.
  TwoRing without_dominant() const;
  TwoRing only_dominant() const;

  /// Around a face after J steps, without limit and linear part.
  RingPoints<N> face_points(int face, long steps) const;

 private:
  void find_amplitudes_inside(const Vec3<N>& c, const std::vector<Vec3<N>>& r);
  void find_amplitudes_on_boundary(const Vec3<N>& c, const std::vector<Vec3<N>>& r);
  void inside_points(int face, const TwoRingPower<N>& power, RingPoints<N>& result) const;
  void boundary_points(int face, const TwoRingPower<N>& power, RingPoints<N>& result) const;
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

template <class N>
TwoRing<N>::TwoRing(const TwoRingModes<N>& modes, const Vec3<N>& c, const std::vector<Vec3<N>>& r,
                    const std::vector<Vec3<N>>& q, const std::vector<Vec3<N>>& p)
    : modes_(&modes), sine_(modes.frequency_.size()), q_(q), p_(p) {
  if constexpr (kRounds<N>) {
    size_ = magnitude(c);
    for (const auto* points : {&r, &q, &p})
      for (const Vec3<N>& x : *points) size_ = std::max(size_, magnitude(x));
    along_size_ = size_;
  }
  modes.on_boundary_ ? find_amplitudes_on_boundary(c, r) : find_amplitudes_inside(c, r);
}

template <class N>
void TwoRing<N>::find_amplitudes_inside(const Vec3<N>& c, const std::vector<Vec3<N>>& r) {
  const int count = modes_->count_;
  Vec3<N> sum{};
  for (const Vec3<N>& x : r) sum += x - c;
  const N a83 = modes_->a_ * N(8) / N(3);
  mean_ = sum * (N(1) / (N(count) * (N(1) + a83)));
  limit_ = c + mean_ * a83;
  cosine_.resize(sine_.size());
  for (std::size_t m = 0; m < sine_.size(); ++m) {
    for (int i = 0; i < count; ++i) {
      const std::size_t at = modes_->angle(m, 2 * i);
      cosine_[m] += (r[i] - c) * modes_->circle_.cosine[at];
      sine_[m] += (r[i] - c) * modes_->circle_.sine[at];
    }
    const bool alone = 2 * modes_->frequency_[m] == count;
    const N factor = N(alone ? 1 : 2) / N(count);
    cosine_[m] *= factor;
    sine_[m] *= factor;
  }
  for (auto* points : {&q_, &p_})
    for (Vec3<N>& x : *points) x -= limit_;
}

template <class N>
void TwoRing<N>::find_amplitudes_on_boundary(const Vec3<N>& c, const std::vector<Vec3<N>>& r) {
  const int count = modes_->count_;
  const auto &along = modes_->along_, &even = modes_->even_;
  limit_ = boundary_limit(c, r.front(), r.back());
  along_ = (r.front() - r.back()) * (N(1) / N(2));
  mean_ = (r.front() - limit_) - along_;
  std::vector<Vec3<N>> rest(count);
  for (int i = 1; i < count; ++i) rest[i] = (r[i] - limit_) - along_ * along.r[i] - mean_ * even.r[i];
  const N two_over_k = N(2) / N(count);
  for (std::size_t m = 0; m < sine_.size(); ++m) {
    for (int i = 1; i < count; ++i) sine_[m] += rest[i] * modes_->circle_.sine[modes_->angle(m, 2 * i)];
    sine_[m] *= two_over_k;
  }
  if (modes_->linear_frequency_ != 0) {
    for (int i = 1; i < count; ++i) linear_ += rest[i] * sin_pi<N>(i, 3);
    linear_ *= two_over_k;
  }
  for (int i = 0; i < count; ++i)
    q_[i] = (q_[i] - limit_) - along_ * along.q[i] - linear_ * (sin_pi<N>(i, 3) + sin_pi<N>(i + 1, 3));
  for (int i = 0; i <= count; ++i)
    p_[i] = (p_[i] - limit_) - along_ * along.p[i] - linear_ * (N(2) * sin_pi<N>(i, 3));
}

template <class N>
LinearPart<N> TwoRing<N>::linear_part(int face, long exponent) const {
  LinearPart<N> part;
  if (!modes_->on_boundary_) return part;
  const auto add = [&](const Vec3<N>& amplitude, const N& size, const N& first, const N& second) {
    part.to_first += amplitude * first;
    part.to_second += amplitude * second;
    if constexpr (kRounds<N>) {
      part.first_size += size * magnitude(first);
      part.second_size += size * magnitude(second);
    }
  };
  if (!modes_->jordan_) add(along_, along_size_, modes_->along_.r[face], modes_->along_.r[face + 1]);
  if (modes_->linear_frequency_ != 0) {
    Vec3<N> amplitude = linear_;
    N size = size_;
    if (modes_->jordan_) {
      const N share = N(2 * static_cast<int>(exponent)) * modes_->kappa_;
      amplitude += along_ * share;
      size += along_size_ * share;
    }
    add(amplitude, size, sin_pi<N>(face, 3), sin_pi<N>(face + 1, 3));
  }
  return part;
}

template <class N>
TwoRing<N> TwoRing<N>::without_dominant() const {
  TwoRing result = *this;
  (along_dominates() ? result.along_ : result.sine_.front()) = Vec3<N>{};
  if (along_dominates()) {
    result.along_size_ = N(0);
  } else if constexpr (kRounds<N>) {
    N largest = N(1) / N(modes_->jordan_ ? 2 : 4);
    for (std::size_t m = 1; m < modes_->eigenvalue_.size(); ++m)
      largest = std::max(largest, modes_->eigenvalue_[m]);
    result.decay_ = largest / modes_->growth_;
  }
  return result;
}

template <class N>
TwoRing<N> TwoRing<N>::only_dominant() const {
  TwoRing result = *this;
  result.limit_ = result.mean_ = result.along_ = result.linear_ = Vec3<N>{};
  result.size_ = result.along_size_ = N(0);
  for (auto* all : {&result.cosine_, &result.sine_, &result.q_, &result.p_})
    all->assign(all->size(), Vec3<N>{});
  (along_dominates() ? result.along_ : result.sine_.front()).x = N(1);
  return result;
}

template <class N>
RingPoints<N> TwoRing<N>::face_points(int face, long steps) const {
  TwoRingPower<N> buffer;
  const TwoRingPower<N>& power = modes_->power(steps, buffer);
  RingPoints<N> s{};
  s.first_edge_on_boundary = modes_->on_boundary_ && face == 0;
  s.last_edge_on_boundary = modes_->on_boundary_ && face + 1 == modes_->count_;
  s.c = mean_ * power.c;
  s.c_after = s.c * modes_->mean_eigenvalue();  // without the linear part, which vanishes at c
  modes_->on_boundary_ ? boundary_points(face, power, s) : inside_points(face, power, s);
  return s;
}

template <class N>
void TwoRing<N>::inside_points(int face, const TwoRingPower<N>& power, RingPoints<N>& s) const {
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
}

template <class N>
void TwoRing<N>::boundary_points(int face, const TwoRingPower<N>& power, RingPoints<N>& s) const {
  const int count = modes_->count_;
  for (int k = 0; k < 6; ++k)
    if (face - 2 + k >= 0 && face - 2 + k <= count) s.r[k] = boundary_r(face - 2 + k, power);
  for (int k = 0; k < 3; ++k)
    if (face - 1 + k >= 0 && face - 1 + k < count) s.q[k] = boundary_q(face - 1 + k, power);
  for (int k = 0; k < 2; ++k) s.p[k] = boundary_p(face + k, power);
  s.complete();
}

template <class N>
Vec3<N> TwoRing<N>::boundary_r(int k, const TwoRingPower<N>& power) const {
  Vec3<N> r = mean_ * (modes_->even_.r[k] * power.mean.r);
  if (modes_->jordan_) r += along_ * (modes_->along_.r[k] * power.half);
  for (std::size_t m = 0; m < sine_.size(); ++m)
    r += sine_[m] * (modes_->circle_.sine[modes_->angle(m, 2L * k)] * power.modes[m].r);
  return r;
}

template <class N>
Vec3<N> TwoRing<N>::boundary_q(int k, const TwoRingPower<N>& power) const {
  Vec3<N> q = q_[k] * power.own_q + mean_ * (modes_->even_.q[k] * power.b8);
  if (modes_->jordan_) q += along_ * (modes_->along_.q[k] * power.half);
  for (std::size_t m = 0; m < sine_.size(); ++m)
    q += sine_[m] * (modes_->circle_.sine[modes_->angle(m, 2L * k + 1)] * power.modes[m].q);
  return q;
}

template <class N>
Vec3<N> TwoRing<N>::boundary_p(int k, const TwoRingPower<N>& power) const {
  const auto& even = modes_->even_;
  Vec3<N> p{};
  if (modes_->jordan_) p += along_ * (modes_->along_.p[k] * power.half);
  if (k == 0 || k == modes_->count_)
    return p + p_[k] * power.own_q + mean_ * (even.p[k] * power.b8);  // the curve's own eigenvalue is 1/8
  p += p_[k] * power.own_p + (q_[k] + q_[k - 1]) * power.q_to_p;
  p += mean_ * (even.p[k] * power.b16 + (even.q[k] + even.q[k - 1]) * power.b8_16 / N(16));
  for (std::size_t m = 0; m < sine_.size(); ++m)
    p += sine_[m] * (modes_->circle_.sine[modes_->angle(m, 2L * k)] * power.modes[m].p);
  return p;
}

}  // namespace limitcheck::reference
