// SPDX-License-Identifier: MIT
// Definitions behind two_ring_modes.h, for the .cpp files that instantiate them.
#pragma once

#include "reference/loop/block_power.h"
#include "reference/loop/masks.h"
#include "reference/loop/two_ring_modes.h"

namespace limitcheck::reference {

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
