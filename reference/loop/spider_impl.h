// SPDX-License-Identifier: MIT
// Definitions behind spider.h, for the .cpp files that instantiate them.
#pragma once

#include <algorithm>

#include "reference/loop/spider.h"

namespace limitcheck::reference {

template <class N>
SpiderKind<N>::SpiderKind(int count, bool on_boundary, Weights weights)
    : count_(count),
      on_boundary_(on_boundary),
      jordan_(on_boundary && count % 6 == 0),
      linear_frequency_(on_boundary && count % 3 == 0 ? count / 3 : 0) {
  const int turn = on_boundary ? 2 * count : count;
  circle_ = circle_table<N>(turn);

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
    const auto points = static_cast<std::size_t>(count) + 1;
    const auto cos_third = [](long i) { return NumberTraits<N>::cos_pi(i, 3); };
    const auto sin_third = [](long i) { return sin_pi<N>(i, 3); };
    along_r_.resize(points), along_p_.resize(points), even_r_.resize(points), even_p_.resize(points);
    along_q_.resize(points - 1), even_q_.resize(points - 1);
    kappa_ = N(0);
    // Mode of 1/2, c = 0, r_0 = 1, r_K = -1: r_i = r_{i-1} + r_{i+1}, linear on every face. Where sin(K pi /
    // 6) = 0 this has no solution, and (1 - 2i/K) cos(i pi / 3) is a generalised eigenvector. Mode of 1/4, c
    // = -1/2, r_0 = r_K = 1: r_i = 3/2 - r_{i-1} - r_{i+1}.
    for (int i = 0; i <= count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (jordan_)
        along_r_[at] = cos_third(i) * (N(count - 2 * i) / N(count));
      else
        along_r_[at] = sin_pi<N>(count - 2 * i, 6) / sin_pi<N>(count, 6);
      even_r_[at] = (N(1) + cos_third(2 * i - count) / cos_third(count)) / N(2);
    }
    if (jordan_) kappa_ = sin_third(1) / N(2 * count);
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const N sum = along_r_[at] + along_r_[at + 1];
      along_q_[at] = jordan_ ? (sum * N(3) - (sin_third(i) + sin_third(i + 1)) * kappa_ * N(8)) / N(3) : sum;
      even_q_[at] = (N(6) * (even_r_[at] + even_r_[at + 1]) - N(1)) / N(16);
    }
    for (int i = 0; i <= count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (i == 0 || i == count) {
        along_p_[at] = along_r_[at] * N(2);
        even_p_[at] = N(11) / N(16);
        continue;
      }
      if (jordan_)
        along_p_[at] = (N(10) * along_r_[at] + along_r_[at - 1] + along_r_[at + 1] + along_q_[at] +
                        along_q_[at - 1] - N(32) * kappa_ * sin_third(i)) /
                       N(7);
      else
        along_p_[at] = along_r_[at] * N(2);
      even_p_[at] = (N(20) * even_r_[at] + N(2) * (even_r_[at - 1] + even_r_[at + 1]) - N(1)) / N(32);
    }
    growth_ = count <= 1 ? N(1) / N(4) : eigenvalue_.front();
  } else {
    a_ = ring_weight<N>(count, weights);
    mean_eigenvalue_ = N(5) / N(8) - a_;
    growth_ = eigenvalue_.front();
  }
  for (long e = 0; e < kTable; ++e) table_.push_back(power(e));
}

template <class N>
SpiderPower<N> SpiderKind<N>::power(long exponent) const {
  const N s = N(1) / growth_, s2 = s * s;
  const N eighth = s / N(8), sixteenth = s / N(16);
  SpiderPower<N> result;
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

template <class N>
Spider<N>::Spider(const SpiderKind<N>& kind, const Vec3<N>& c, const std::vector<Vec3<N>>& r,
                  const std::vector<Vec3<N>>& q, const std::vector<Vec3<N>>& p)
    : kind_(&kind), q_(q), p_(p) {
  const auto count = static_cast<std::size_t>(kind.count_);
  const std::size_t modes = kind.frequency_.size();
  sine_.resize(modes);
  if constexpr (kRounds<N>) {
    size_ = magnitude(c);
    for (const auto* points : {&r, &q, &p})
      for (const Vec3<N>& x : *points) size_ = std::max(size_, magnitude(x));
    along_size_ = size_;
  }
  if (kind.on_boundary_) {
    limit_ = boundary_limit(c, r.front(), r.back());
    along_ = (r.front() - r.back()) * (N(1) / N(2));
    mean_ = (r.front() - limit_) - along_;
    std::vector<Vec3<N>> rest(count);
    for (std::size_t i = 1; i < count; ++i)
      rest[i] = (r[i] - limit_) - along_ * kind.along_r_[i] - mean_ * kind.even_r_[i];
    const N two_over_k = N(2) / N(kind.count_);
    for (std::size_t m = 0; m < modes; ++m) {
      for (std::size_t i = 1; i < count; ++i)
        sine_[m] += rest[i] * kind.circle_.sine[kind.angle(m, 2 * static_cast<long>(i))];
      sine_[m] *= two_over_k;
    }
    if (kind.linear_frequency_ != 0) {
      for (std::size_t i = 1; i < count; ++i) linear_ += rest[i] * sin_pi<N>(static_cast<long>(i), 3);
      linear_ *= two_over_k;
    }
    for (std::size_t i = 0; i < count; ++i)
      q_[i] = (q_[i] - limit_) - along_ * kind.along_q_[i] -
              linear_ * (sin_pi<N>(static_cast<long>(i), 3) + sin_pi<N>(static_cast<long>(i) + 1, 3));
    for (std::size_t i = 0; i <= count; ++i)
      p_[i] = (p_[i] - limit_) - along_ * kind.along_p_[i] -
              linear_ * (N(2) * sin_pi<N>(static_cast<long>(i), 3));
  } else {
    Vec3<N> sum{};
    for (const Vec3<N>& x : r) sum += x - c;
    const N a83 = kind.a_ * N(8) / N(3);
    mean_ = sum * (N(1) / (N(kind.count_) * (N(1) + a83)));
    limit_ = c + mean_ * a83;
    cosine_.resize(modes);
    for (std::size_t m = 0; m < modes; ++m) {
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = kind.angle(m, 2 * static_cast<long>(i));
        cosine_[m] += (r[i] - c) * kind.circle_.cosine[at];
        sine_[m] += (r[i] - c) * kind.circle_.sine[at];
      }
      const bool alone = 2 * kind.frequency_[m] == kind.count_;
      const N factor = N(alone ? 1 : 2) / N(kind.count_);
      cosine_[m] *= factor;
      sine_[m] *= factor;
    }
    for (std::size_t i = 0; i < count; ++i) {
      q_[i] -= limit_;
      p_[i] -= limit_;
    }
  }
}

template <class N>
typename Spider<N>::LinearPart Spider<N>::linear_part(int sector, long exponent) const {
  LinearPart part;
  if (!kind_->on_boundary_) return part;
  const auto add = [&](const Vec3<N>& amplitude, const N& size, const N& first, const N& second) {
    part.to_first += amplitude * first;
    part.to_second += amplitude * second;
    if constexpr (kRounds<N>) {
      part.first_size += size * magnitude(first);
      part.second_size += size * magnitude(second);
    }
  };
  const auto at = static_cast<std::size_t>(sector);
  if (!kind_->jordan_) add(along_, along_size_, kind_->along_r_[at], kind_->along_r_[at + 1]);
  if (kind_->linear_frequency_ != 0) {
    Vec3<N> amplitude = linear_;
    N size = size_;
    if (kind_->jordan_) {
      const N share = N(2 * static_cast<int>(exponent)) * kind_->kappa_;
      amplitude += along_ * share;
      size += along_size_ * share;
    }
    add(amplitude, size, sin_pi<N>(sector, 3), sin_pi<N>(sector + 1, 3));
  }
  return part;
}

template <class N>
Spider<N> Spider<N>::without_dominant() const {
  Spider result = *this;
  (along_dominates() ? result.along_ : result.sine_.front()) = Vec3<N>{};
  if (along_dominates()) {
    result.along_size_ = N(0);
  } else if constexpr (kRounds<N>) {
    N largest = N(1) / N(kind_->jordan_ ? 2 : 4);
    for (std::size_t m = 1; m < kind_->eigenvalue_.size(); ++m)
      largest = std::max(largest, kind_->eigenvalue_[m]);
    result.decay_ = largest / kind_->growth_;
  }
  return result;
}

template <class N>
Spider<N> Spider<N>::only_dominant() const {
  Spider result = *this;
  result.limit_ = result.mean_ = result.along_ = result.linear_ = Vec3<N>{};
  result.size_ = result.along_size_ = N(0);
  for (auto* all : {&result.cosine_, &result.sine_, &result.q_, &result.p_})
    all->assign(all->size(), Vec3<N>{});
  (along_dominates() ? result.along_ : result.sine_.front()).x = N(1);
  return result;
}

template <class N>
void Spider<N>::sector(int i, const SpiderPower<N>& power, Sector& s) const {
  const SpiderKind<N>& kind = *kind_;
  const int count = kind.count_;
  const auto& circle = kind.circle_;
  s.first_edge_on_boundary = kind.on_boundary_ && i == 0;
  s.last_edge_on_boundary = kind.on_boundary_ && i + 1 == count;
  s.c = mean_ * power.c;

  if (!kind.on_boundary_) {
    const auto wrap = [count](int k) { return static_cast<std::size_t>((k % count + count) % count); };
    for (auto& r : s.r) r = mean_ * power.mean.r;
    for (int k = 0; k < 3; ++k) s.q[k] = mean_ * power.mean.q + q_[wrap(i - 1 + k)] * power.own_q;
    for (int k = 0; k < 2; ++k)
      s.p[k] = mean_ * power.mean.p + p_[wrap(i + k)] * power.own_p +
               (q_[wrap(i + k)] + q_[wrap(i + k - 1)]) * power.q_to_p;
    const std::size_t turn = circle.cosine.size();
    for (std::size_t m = 0; m < cosine_.size(); ++m) {
      const auto& mode = power.modes[m];
      const auto step = static_cast<std::size_t>(kind.frequency_[m]);
      const auto wave = [&](std::size_t at) {
        return cosine_[m] * circle.cosine[at] + sine_[m] * circle.sine[at];
      };
      // Half positions h = 2 (i - 2) .. 2 (i + 3): r at the even ones, q at the odd ones.
      std::size_t at = kind.angle(m, 2L * (i - 2));
      for (int h = 0; h <= 10; ++h) {
        if (h % 2 == 0) {
          const Vec3<N> w = wave(at);
          s.r[h / 2] += w * mode.r;
          if (h == 4 || h == 6) s.p[h / 2 - 2] += w * mode.p;
        } else if (h >= 3 && h <= 7) {
          s.q[(h - 3) / 2] += wave(at) * mode.q;
        }
        at += step;
        if (at >= turn) at -= turn;
      }
    }
    return;
  }

  const auto ring = [&](int k) {
    const auto at = static_cast<std::size_t>(k);
    Vec3<N> r = mean_ * (kind.even_r_[at] * power.mean.r);
    if (kind.jordan_) r += along_ * (kind.along_r_[at] * power.half);
    for (std::size_t m = 0; m < sine_.size(); ++m)
      r += sine_[m] * (circle.sine[kind.angle(m, 2L * k)] * power.modes[m].r);
    return r;
  };
  const auto flap = [&](int k) {
    const auto at = static_cast<std::size_t>(k);
    Vec3<N> q = q_[at] * power.own_q + mean_ * (kind.even_q_[at] * power.b8);
    if (kind.jordan_) q += along_ * (kind.along_q_[at] * power.half);
    for (std::size_t m = 0; m < sine_.size(); ++m)
      q += sine_[m] * (circle.sine[kind.angle(m, 2L * k + 1)] * power.modes[m].q);
    return q;
  };
  const auto outer = [&](int k) {
    const auto at = static_cast<std::size_t>(k);
    Vec3<N> p{};
    if (kind.jordan_) p += along_ * (kind.along_p_[at] * power.half);
    if (k == 0 || k == count)
      return p + p_[at] * power.own_q + mean_ * (kind.even_p_[at] * power.b8);  // 1/8 out here
    p += p_[at] * power.own_p + (q_[at] + q_[at - 1]) * power.q_to_p;
    p += mean_ *
         (kind.even_p_[at] * power.b16 + (kind.even_q_[at] + kind.even_q_[at - 1]) * power.b8_16 / N(16));
    for (std::size_t m = 0; m < sine_.size(); ++m)
      p += sine_[m] * (circle.sine[kind.angle(m, 2L * k)] * power.modes[m].p);
    return p;
  };
  for (int k = 0; k < 6; ++k)
    if (i - 2 + k >= 0 && i - 2 + k <= count) s.r[k] = ring(i - 2 + k);
  for (int k = 0; k < 3; ++k)
    if (i - 1 + k >= 0 && i - 1 + k < count) s.q[k] = flap(i - 1 + k);
  for (int k = 0; k < 2; ++k) s.p[k] = outer(i + k);
  if (s.first_edge_on_boundary) {
    s.r[1] = ghost_point(s.c, s.r[2], s.r[3]);
    s.q[0] = ghost_point(s.r[2], s.p[0], s.q[1]);
  }
  if (s.last_edge_on_boundary) {
    s.r[4] = ghost_point(s.c, s.r[3], s.r[2]);
    s.q[2] = ghost_point(s.r[3], s.p[1], s.q[1]);
  }
}

}  // namespace limitcheck::reference
