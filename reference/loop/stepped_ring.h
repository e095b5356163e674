// SPDX-License-Identifier: MIT
// The two-ring of a vertex after any number of steps, by taking the steps: on the boundary, of a held vertex or a
// dart, and inside of any vertex of many faces, where the closed form of two_ring.h would cost the square of their
// number.
//
// The points and their names are those of two_ring.h, taken as differences from c, so that there is no
// eigenvalue 1, and times 2^J, so that nothing underflows and all weights are exact. A step reaches one
// neighbour farther, so that the points around a face after J steps come from J more on either side. Only c
// hears of all; how it moves is known beforehand, except at a dart.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "reference/loop/dart.h"
#include "reference/loop/two_ring.h"
#include "reference/mesh/sharp_tags.h"

namespace limitcheck::reference {

/// From so many faces on, an ordinary vertex inside takes steps, too.
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
  /// r and p have K + 1 entries on the boundary, everything else as many as there are faces. Keeps a pointer to the
  /// kind.
  SteppedRing(const SteppedRingKind<N>& kind, const Vec3<N>& c, const std::vector<Vec3<N>>& r,
              const std::vector<Vec3<N>>& q, const std::vector<Vec3<N>>& p);

  int faces() const { return kind_->faces(); }
  bool on_boundary() const { return !kind_->closed(); }
  N growth() const { return kind_->growth(); }
  const Vec3<N>& limit() const { return limit_; }
  /// As TwoRing.
  N size(long exponent) const { return size_ * reference::power(decay_, exponent); }
  /// Of an ordinary vertex on the boundary. Near one of K != 3 faces one mode outgrows the others, and d1 and d2
  /// become parallel to its amplitude A: d1 = f1 A + r1, d2 = f2 A + r2. The first of these rings lacks that mode
  /// and gives r1 and r2. The second has nothing else, with (1, 0, 0) for A, and gives f1 and f2.
  SteppedRing without_dominant() const;
  SteppedRing only_dominant() const;

  /// Around a face after J steps, as differences from c.
  RingPoints<N> face_points(int face, long steps) const;
  /// Zero except on an ordinary boundary of one or two faces, where the curve's mode of 1/2 is linear on each face:
  /// it is kept apart, since it outgrows what is left.
  LinearPart<N> linear_part(int face) const;

 private:
  bool has_linear_mode() const {
    return on_boundary() && faces() < 3 && kind_->state() == VertexState::kOrdinary;
  }
  N along(int i) const { return N(1) - N(2 * i) / N(faces()); }  ///< that mode in r_i
  /// Takes away the mode of sin(i pi / K), which dominates from four faces on.
  void drop_dominant(std::vector<Vec3<N>>& r) const;

  const SteppedRingKind<N>* kind_;
  Vec3<N> limit_, heard_, along_;
  N size_{}, along_size_{}, decay_{1};  ///< the last in a step, over the growth
  bool lacks_dominant_ = false;
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
  else if (faces < 3 && state == VertexState::kOrdinary)  // without the linear mode
    largest = faces == 1 ? N(1) / N(4) : smooth;
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
  if (has_linear_mode()) {
    along_ = (r_.front() - r_.back()) * (N(1) / N(2));
    along_size_ = size_;
    r_.front() = r_.back() = (r_.front() + r_.back()) * (N(1) / N(2));  // equal, and so they stay
    for (int i = 0; i < faces(); ++i) q_[i] -= along_ * (along(i) + along(i + 1));
    for (int i = 0; i <= faces(); ++i) p_[i] -= along_ * (N(2) * along(i));
  }
  heard_ = kind.heard(r_);
  limit_ = c + kind.to_limit(heard_, r_);
}

template <class N>
LinearPart<N> SteppedRing<N>::linear_part(int face) const {
  if (!has_linear_mode()) return {};
  const N first = along(face), second = along(face + 1);
  return {along_ * first, along_ * second, along_size_ * magnitude(first), along_size_ * magnitude(second)};
}

template <class N>
void SteppedRing<N>::drop_dominant(std::vector<Vec3<N>>& r) const {
  const Vec3<N> amplitude =
      boundary_tangents<N>(Vec3<N>{}, std::span<const Vec3<N>>(r)).second * (N(2) / N(faces()));
  const CircleTable<N>& circle = circle_table<N>(faces());
  for (std::size_t i = 1; i + 1 < r.size(); ++i) r[i] -= amplitude * circle.sine[i];
}

template <class N>
SteppedRing<N> SteppedRing<N>::without_dominant() const {
  SteppedRing result = *this;
  if (has_linear_mode()) {
    result.along_ = Vec3<N>{};
    result.along_size_ = N(0);
    return result;
  }
  drop_dominant(result.r_);
  result.lacks_dominant_ = true;
  if constexpr (kRounds<N>)
    result.decay_ =
        std::max(N(1) / N(2), N(3) / N(8) + circle_table<N>(faces()).cosine[2] / N(4)) / kind_->growth();
  return result;
}

template <class N>
SteppedRing<N> SteppedRing<N>::only_dominant() const {
  SteppedRing result = *this;
  result.limit_ = result.heard_ = result.along_ = Vec3<N>{};
  result.size_ = result.along_size_ = N(0);
  for (auto* all : {&result.r_, &result.q_, &result.p_}) all->assign(all->size(), Vec3<N>{});
  if (has_linear_mode()) result.along_.x = N(1);
  const CircleTable<N>& circle = circle_table<N>(faces());
  for (std::size_t i = 1; i + 1 < r_.size() && !has_linear_mode(); ++i) result.r_[i].x = circle.sine[i];
  return result;
}

template <class N>
RingPoints<N> SteppedRing<N>::face_points(int face, long steps) const {
  const bool closed = kind_->closed(), dart = kind_->state() == VertexState::kDart;
  // What rounding leaves of the dominant mode would outgrow the rest. Of many faces that would cost too much.
  const bool drops = lacks_dominant_ && faces() < kManyFaces;
  const long count = static_cast<long>(q_.size()), entries = static_cast<long>(r_.size());
  const auto wrap = [](long i, long n) { return static_cast<std::size_t>((i % n + n) % n); };

  // The r_i from `low` to `high`. Those beyond what a step still reaches are left behind; but where all are
  // needed, or there are no more than these, all are kept.
  long low = face - 2 - steps, high = face + 3 + steps;
  const bool whole = dart || drops || (closed && high - low + 1 >= count);
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
    if (drops) drop_dominant(r);
    heard = dart ? kind_->heard(r) : heard * kind_->change();
  }

  for (long k = 0; k < 6; ++k)
    if (const long i = face - 2 + k; closed || (i >= 0 && i <= count)) s.r[k] = at(i);
  s.first_edge_on_boundary = !closed && face == 0;
  s.last_edge_on_boundary = !closed && face + 1 == count;
  if (s.first_edge_on_boundary) {
    s.r[1] = ghost_point(s.c, s.r[2], s.r[3]);
    s.q[0] = ghost_point(s.r[2], s.p[0], s.q[1]);
  }
  if (s.last_edge_on_boundary) {
    s.r[4] = ghost_point(s.c, s.r[3], s.r[2]);
    s.q[2] = ghost_point(s.r[3], s.p[1], s.q[1]);
  }
  s.c_after = kind_->after(heard);
  s.c_to_limit = kind_->to_limit(heard, r);
  return s;
}

}  // namespace limitcheck::reference
