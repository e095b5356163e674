// SPDX-License-Identifier: MIT
// The two-ring of a vertex after any number of steps, by taking the steps: of a held vertex or a dart, whose
// map has no such closed form as that of two_ring_modes.h, and of any vertex of many faces, where the closed
// form would cost the square of their number.
//
// The points and their names are those of two_ring_modes.h, taken as differences from c, so that there is no
// eigenvalue 1, and times 2^J, so that nothing underflows and all weights are exact. A step reaches one
// neighbour farther, so that the points around a face after J steps come from J more on either side. Only c
// hears of all; how it moves is known beforehand, except at a dart.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "reference/loop/dart.h"
#include "reference/loop/two_ring.h"
#include "reference/mesh/sharp_tags.h"

namespace limitcheck::reference {

/// From so many faces on, an ordinary vertex takes steps, too.
inline constexpr int kManyFaces = 65;

/// All that such vertices of K faces have in common. A dart has an open sector.
template <class N>
class SteppedRingKind {
 public:
  SteppedRingKind(int faces, bool closed, VertexState state, Weights weights);

  int faces() const { return faces_; }
  bool closed() const { return closed_; }
  VertexState state() const { return state_; }
  /// What the points are divided by in a step, and how they grow then.
  static N growth() { return N(1) / N(2); }
  const N& grown() const { return grown_; }

  /// What c hears of a ring: inside the mean of all r_i, on the boundary r_0 + r_K, and how that changes in a
  /// step, over the growth. A dart needs the ring itself.
  Vec3<N> heard(std::span<const Vec3<N>> r) const;
  const N& change() const { return change_; }
  /// What c moves by in one step, and by what it is away from the limit.
  Vec3<N> after(const Vec3<N>& heard) const { return heard * after_; }
  Vec3<N> to_limit(const Vec3<N>& heard, std::span<const Vec3<N>> r) const {
    return state_ == VertexState::kDart ? weighted(dart_limit_, Vec3<N>{}, r) : heard * to_limit_;
  }

 private:
  int faces_;
  bool closed_;
  VertexState state_;
  N grown_, change_{0}, after_{0}, to_limit_{0};
  std::vector<N> dart_limit_;
};

/// One such vertex.
template <class N>
class SteppedRing {
 public:
  /// As TwoRing. Keeps a pointer to the kind.
  SteppedRing(const SteppedRingKind<N>& kind, const Vec3<N>& c, const std::vector<Vec3<N>>& r,
              const std::vector<Vec3<N>>& q, const std::vector<Vec3<N>>& p);

  int faces() const { return kind_->faces(); }
  bool on_boundary() const { return !kind_->closed(); }
  N growth() const { return kind_->growth(); }
  const Vec3<N>& limit() const { return limit_; }
  /// As TwoRing.
  N size(long exponent) const { return size_ * reference::power(decay_, exponent); }
  /// As TwoRing, for an ordinary vertex on the boundary.
  SteppedRing without_dominant() const;
  SteppedRing only_dominant() const;

  /// Around a face after J steps, as differences from c.
  RingPoints<N> face_points(int face, long steps) const;
  /// Not kept apart here.
  LinearPart<N> linear_part(int, long) const { return {}; }

 private:
  const SteppedRingKind<N>* kind_;
  Vec3<N> limit_, heard_;
  N size_{}, decay_{1};  ///< the second in a step, over the growth
  std::vector<Vec3<N>> r_, q_, p_;
};

template <class N>
SteppedRingKind<N>::SteppedRingKind(int faces, bool closed, VertexState state, Weights weights)
    : faces_(faces), closed_(closed), state_(state) {
  using T = NumberTraits<N>;
  const N smooth = N(3) / N(8);
  N largest = N(1) / N(2);  // eigenvalue; of a dart near enough
  if (state == VertexState::kDart)
    largest = T::from_double(std::max(.5, .375 + NumberTraits<double>::cos_pi(2, faces) / 4));
  else if (closed)
    largest = state == VertexState::kHeld ? N(5) / N(8) : smooth + T::cos_pi(2, faces) / N(4);
  else if (faces > 3)
    largest = smooth + T::cos_pi(1, faces) / N(4);
  grown_ = largest / growth();

  if (state == VertexState::kHeld) return;
  if (closed || state == VertexState::kDart) {
    after_ = ring_weight<N>(faces, weights);
    change_ = (N(5) / N(8) - after_) / growth();
    to_limit_ = after_ / (smooth + after_);
    if (state == VertexState::kDart) dart_limit_ = dart_limit_weights<N>(faces, weights);
  } else {
    after_ = N(1) / N(8);
    change_ = N(1) / (N(4) * growth());
    to_limit_ = N(1) / N(6);
  }
}

template <class N>
Vec3<N> SteppedRingKind<N>::heard(std::span<const Vec3<N>> r) const {
  if (state_ == VertexState::kHeld) return {};
  if (!closed_ && state_ == VertexState::kOrdinary) return r.front() + r.back();
  const std::size_t count = r.size() - (closed_ ? 0 : 1);  // a dart's r_n is its r_0
  Vec3<N> sum{};
  for (const Vec3<N>& x : r.first(count)) sum += x;
  return sum * (N(1) / N(static_cast<int>(count)));
}

template <class N>
SteppedRing<N>::SteppedRing(const SteppedRingKind<N>& kind, const Vec3<N>& c, const std::vector<Vec3<N>>& r,
                            const std::vector<Vec3<N>>& q, const std::vector<Vec3<N>>& p)
    : kind_(&kind), r_(r), q_(q), p_(p) {
  for (auto* list : {&r_, &q_, &p_})
    for (Vec3<N>& x : *list) {
      if constexpr (kRounds<N>) size_ = std::max({size_, magnitude(x), magnitude(c)});
      x -= c;
    }
  decay_ = kind.grown();
  heard_ = kind.heard(r_);
  limit_ = c + kind.to_limit(heard_, r_);
}

template <class N>
SteppedRing<N> SteppedRing<N>::without_dominant() const {
  SteppedRing result = *this;
  const int count = kind_->faces();
  const Vec3<N> amplitude =
      boundary_tangents<N>(Vec3<N>{}, std::span<const Vec3<N>>(r_)).second * (N(2) / N(count));
  const CircleTable<N>& circle = circle_table<N>(count);
  for (std::size_t i = 1; i + 1 < r_.size(); ++i) result.r_[i] -= amplitude * circle.sine[i];
  result.decay_ = (N(3) / N(8) + circle.cosine[2] / N(4)) / kind_->growth();
  return result;
}

template <class N>
SteppedRing<N> SteppedRing<N>::only_dominant() const {
  SteppedRing result = *this;
  result.limit_ = result.heard_ = Vec3<N>{};
  result.size_ = N(0);
  for (auto* all : {&result.r_, &result.q_, &result.p_}) all->assign(all->size(), Vec3<N>{});
  const CircleTable<N>& circle = circle_table<N>(kind_->faces());
  for (std::size_t i = 1; i + 1 < r_.size(); ++i) result.r_[i].x = circle.sine[i];
  return result;
}

template <class N>
RingPoints<N> SteppedRing<N>::face_points(int face, long steps) const {
  const bool closed = kind_->closed(), dart = kind_->state() == VertexState::kDart;
  const long count = static_cast<long>(q_.size()), entries = static_cast<long>(r_.size());
  const auto wrap = [](long i, long n) { return static_cast<std::size_t>((i % n + n) % n); };

  // The r_i from `low` to `high`. Those beyond what a step still reaches are left behind; but where all are
  // needed, or there are no more than these, all are kept.
  long low = face - 2 - steps, high = face + 3 + steps;
  const bool whole = dart || (closed && high - low + 1 >= count);
  if (whole) low = 0, high = entries - 1;
  if (!closed) low = std::max(low, 0L), high = std::min(high, entries - 1);
  std::vector<Vec3<N>> r, next;
  for (long i = low; i <= high; ++i) r.push_back(r_[wrap(i, entries)]);
  long first = low;  // the index of r.front()
  const auto at = [&](long i) -> const Vec3<N>& {
    return r[whole && closed ? wrap(i, count) : static_cast<std::size_t>(i - first)];
  };

  RingPoints<N> s{};
  const auto has_q = [&](long i) { return closed || (i >= 0 && i < count); };
  for (int k = 0; k < 3; ++k)
    if (has_q(face - 1 + k)) s.q[k] = q_[wrap(face - 1 + k, count)];
  for (int k = 0; k < 2; ++k) s.p[k] = p_[wrap(face + k, entries)];

  Vec3<N> heard = heard_;
  const N share = N(1) / kind_->growth(), sixteenth = share / N(16);
  const N two = N(2) * sixteenth, six = N(6) * sixteenth, eight = N(8) * sixteenth, ten = N(10) * sixteenth,
          twelve = N(12) * sixteenth;
  const auto on_end = [&](long i) { return !closed && (i == 0 || i == count); };
  for (long step = 0; step < steps; ++step) {
    const Vec3<N> move = kind_->after(heard) * share;
    for (int k = 0; k < 2; ++k) {
      const long i = face + k;
      s.p[k] = on_end(i)
                   ? at(i) * twelve + s.p[k] * two - move
                   : at(i) * ten + (at(i - 1) + at(i + 1) + s.q[k] + s.q[k + 1] + s.p[k]) * sixteenth - move;
    }
    for (int k = 0; k < 3; ++k) {
      const long i = face - 1 + k;
      if (has_q(i)) s.q[k] = (at(i) + at(i + 1)) * six + s.q[k] * two - move;
    }
    next.clear();
    const bool keeps_low = whole || (!closed && low == 0), keeps_high = whole || (!closed && high == count);
    const long from = keeps_low ? low : low + 1, to = keeps_high ? high : high - 1;
    for (long i = from; i <= to; ++i)
      next.push_back(on_end(i) ? at(i) * eight - move : at(i) * six + (at(i - 1) + at(i + 1)) * two - move);
    r.swap(next);
    first = low = from;
    high = to;
    heard = dart ? kind_->heard(r) : heard * kind_->change();
  }

  for (long k = 0; k < 6; ++k)
    if (const long i = face - 2 + k; closed || (i >= 0 && i <= count)) s.r[k] = at(i);
  s.first_edge_on_boundary = !closed && face == 0;
  s.last_edge_on_boundary = !closed && face + 1 == count;
  s.complete();
  s.c_after = kind_->after(heard);
  s.c_to_limit = kind_->to_limit(heard, r);
  return s;
}

}  // namespace limitcheck::reference
