// SPDX-License-Identifier: MIT
// Definitions behind two_ring.h: of the vertices that take the steps.
#pragma once

#include <algorithm>

#include "reference/catmull_clark/dart.h"
#include "reference/catmull_clark/masks.h"
#include "reference/catmull_clark/two_ring.h"

namespace limitcheck::reference::catmull_clark {

template <class N>
SteppedRingKind<N>::SteppedRingKind(int faces, bool closed, VertexState state)
    : faces_(faces), closed_(closed), state_(state) {
  N largest = N(1) / N(2);  // eigenvalue; of a dart near enough
  if (state == VertexState::kDart)
    largest = NumberTraits<N>::from_double(std::max(.5, (four_lambda_minus_one<double>(faces) + 1) * .25));
  else if (closed && state == VertexState::kHeld)
    largest = cone_eigenvalue<N>();
  else if (closed || faces > 1)
    largest = (four_lambda_minus_one<N>(closed ? faces : 2 * faces) + N(1)) * (N(1) / N(4));
  grown_ = largest / growth();
}

template <class N>
typename SteppedRingKind<N>::Heard SteppedRingKind<N>::heard(std::span<const Vec3<N>> e,
                                                             std::span<const Vec3<N>> f) const {
  if (state_ == VertexState::kHeld) return {};
  if (hears_ends()) return {e.front() + e.back(), {}};
  Heard sum;
  const std::size_t count = e.size() - (closed_ ? 0 : 1);
  for (const Vec3<N>& x : e.first(count)) sum.e += x;  // a dart's e_n is its e_0
  for (const Vec3<N>& x : f.first(count)) sum.f += x;
  const N share = N(1) / N(static_cast<int>(count));
  return {sum.e * share, sum.f * share};
}

template <class N>
typename SteppedRingKind<N>::Heard SteppedRingKind<N>::next(const Heard& heard) const {
  const N share = N(1) / growth();
  if (hears_ends()) return {heard.e * (share / N(4)), {}};
  const Vec3<N> move = after(heard);
  return {(heard.e * (N(1) / N(2)) + heard.f * (N(1) / N(8)) - move) * share,
          (heard.e * (N(1) / N(2)) + heard.f * (N(1) / N(4)) - move) * share};
}

template <class N>
Vec3<N> SteppedRingKind<N>::after(const Heard& heard) const {
  if (hears_ends()) return heard.e * (N(1) / N(8));
  return (heard.e * N(6) + heard.f) * (N(1) / N(4 * faces_));
}

template <class N>
Vec3<N> SteppedRingKind<N>::to_limit(const Heard& heard, std::span<const Vec3<N>> e,
                                     std::span<const Vec3<N>> f) const {
  if (hears_ends()) return heard.e * (N(1) / N(6));
  if (state_ == VertexState::kDart) return weighted(dart_limit_weights<N>(faces_), Vec3<N>{}, e, f);
  return (heard.e * N(4) + heard.f) * (N(1) / N(faces_ + 5));
}

template <class N>
TwoRing<N>::TwoRing(const SteppedRingKind<N>& kind, const TwoRingPoints<N>& points)
    : stepped_(&kind), points_(points) {
  if constexpr (kRounds<N>) size_ = detail::largest(points);
  for (auto* list : {&points_.e, &points_.p, &points_.f, &points_.g, &points_.h, &points_.r})
    for (Vec3<N>& x : *list) x -= points.c;
  heard_ = kind.heard(points_.e, points_.f);
  limit_ = points.c + kind.to_limit(heard_, points_.e, points_.f);
}

namespace detail {

/// The e and f from one index to another of a ring that takes steps, and as many around them as they still
/// come from: one less on either side with each step. All of them are kept on the boundary, at a dart, and
/// where there are no more.
template <class N>
class SteppedWindow {
 public:
  SteppedWindow(const SteppedRingKind<N>& kind, const TwoRingPoints<N>& points, long low, long high,
                long steps)
      : closed_(kind.closed()),
        count_(static_cast<long>(points.f.size())),
        low_(low - steps),
        high_(high + steps) {
    const bool dart = kind.state() == VertexState::kDart;
    whole_ = dart || (closed_ && high_ - low_ + 1 >= count_);
    const long entries = static_cast<long>(points.e.size());
    if (whole_) low_ = 0, high_ = entries - 1;
    if (!closed_) low_ = std::max(low_, 0L), high_ = std::min(high_, count_);
    start_ = low_;
    for (long i = low_; i <= high_; ++i) {
      e_.push_back(points.e[static_cast<std::size_t>(wrapped(i, entries))]);
      f_.push_back(has_face(i) ? points.f[static_cast<std::size_t>(wrapped(i, count_))] : Vec3<N>{});
    }
  }

  const Vec3<N>& e(long i) const { return e_[slot(i)]; }
  const Vec3<N>& f(long i) const { return f_[slot(i)]; }
  std::span<const Vec3<N>> all_e() const { return e_; }
  std::span<const Vec3<N>> all_f() const { return f_; }
  bool on_end(long i) const { return !closed_ && (i == 0 || i == count_); }
  bool has_face(long i) const { return closed_ || (i >= 0 && i < count_); }
  bool has_edge(long i) const { return closed_ || (i >= 0 && i <= count_); }

  ///   share   one over the growth
  ///   move    of c, over the growth
  void step(const N& share, const Vec3<N>& move) {
    const N sixteenth = share / N(16), quarter = share / N(4), half = share / N(2), six = N(6) * sixteenth;
    const long from = whole_ || (!closed_ && low_ == 0) ? low_ : low_ + 1;
    const long to = whole_ || (!closed_ && high_ == count_) ? high_ : high_ - 1;
    next_e_.clear(), next_f_.clear();
    for (long i = from; i <= to; ++i) {
      next_e_.push_back(on_end(i) ? e(i) * half - move
                                  : e(i) * six + (e(i - 1) + e(i + 1) + f(i) + f(i - 1)) * sixteenth - move);
      next_f_.push_back(has_face(i) && (i < high_ || whole_) ? (e(i) + e(i + 1) + f(i)) * quarter - move
                                                             : Vec3<N>{});
    }
    e_.swap(next_e_), f_.swap(next_f_);
    low_ = start_ = from;
    high_ = to;
  }

 private:
  static long wrapped(long i, long n) { return (i % n + n) % n; }
  std::size_t slot(long i) const {
    return static_cast<std::size_t>(whole_ && closed_ ? wrapped(i, count_) : i - start_);
  }

  bool closed_, whole_ = false;
  long count_, low_, high_, start_ = 0;
  std::vector<Vec3<N>> e_, f_, next_e_, next_f_;
};

}  // namespace detail

template <class N>
void TwoRing<N>::stepped_sector(int i, long steps, TwoRingSector<N>& s) const {
  using Side = typename TwoRingSector<N>::Side;
  s = {};
  const int count = static_cast<int>(points_.f.size());
  const bool closed = stepped_->closed(), dart = stepped_->state() == VertexState::kDart;
  detail::SteppedWindow<N> near(*stepped_, points_, i - 2, i + 3, steps);
  const auto face = [&](int at) { return static_cast<std::size_t>((at % count + count) % count); };
  const bool before = near.has_face(i - 1), after = near.has_face(i + 1);
  s.p = {points_.p[static_cast<std::size_t>(i)],
         points_.p[static_cast<std::size_t>((i + 1) % static_cast<int>(points_.p.size()))]};
  s.g = points_.g[face(i)], s.h = points_.h[face(i)], s.r = points_.r[face(i)];
  if (before) s.h_before = points_.h[face(i - 1)];
  if (after) s.g_after = points_.g[face(i + 1)];

  auto heard = heard_;
  const N share = N(1) / growth(), sixteenth = share / N(16), sixty_fourth = share / N(64);
  const N six = N(6) * sixteenth, eighth = share / N(8);
  for (long step = 0; step < steps; ++step) {
    const Vec3<N> move = stepped_->after(heard) * share;
    const auto e = [&](int at) -> const Vec3<N>& { return near.e(at); };
    const auto f = [&](int at) -> const Vec3<N>& { return near.f(at); };
    const auto p = [&](int at, const Vec3<N>& own, const Vec3<N>& g, const Vec3<N>& h) {
      if (near.on_end(at)) return e(at) * (N(6) * eighth) + own * eighth - move;
      return (e(at) * N(36) + e(at - 1) + e(at + 1) + (f(at) + f(at - 1) + own) * N(6) + g + h) *
                 sixty_fourth -
             move;
    };
    // g has p_i beside it and leans to e_i, h has p_{i+1} and leans to e_{i+1}.
    const auto beside = [&](const Vec3<N>& leant, const Vec3<N>& other, const Vec3<N>& f_at,
                            const Vec3<N>& p_at, const Vec3<N>& own) {
      return (leant + f_at) * six + (other + p_at + own) * sixteenth - move;
    };
    const Vec3<N> r =
        (f(i) * N(36) + (e(i) + e(i + 1) + s.g + s.h) * N(6) + s.p[0] + s.p[1] + s.r) * sixty_fourth - move;
    const Vec3<N> g = beside(e(i), e(i + 1), f(i), s.p[0], s.g),
                  h = beside(e(i + 1), e(i), f(i), s.p[1], s.h);
    Vec3<N> h_before{}, g_after{};
    if (before) h_before = beside(e(i), e(i - 1), f(i - 1), s.p[0], s.h_before);
    if (after) g_after = beside(e(i + 1), e(i + 2), f(i + 1), s.p[1], s.g_after);
    s.p = {p(i, s.p[0], s.g, s.h_before), p(i + 1, s.p[1], s.g_after, s.h)};
    s.g = g, s.h = h, s.r = r, s.h_before = h_before, s.g_after = g_after;
    near.step(share, move);
    heard = dart ? stepped_->heard(near.all_e(), near.all_f()) : stepped_->next(heard);
  }

  for (int at = -2; at <= 3; ++at)
    if (near.has_edge(i + at)) s.e[static_cast<std::size_t>(at + 2)] = near.e(i + at);
  for (int at = -2; at <= 2; ++at)
    if (near.has_face(i + at)) s.f[static_cast<std::size_t>(at + 2)] = near.f(i + at);
  const auto side = [closed](int faces) {
    return closed       ? Side::kFaces
           : faces == 0 ? Side::kBoundary
           : faces == 1 ? Side::kFaceThenBoundary
                        : Side::kFaces;
  };
  s.before = side(i);
  s.after = side(count - 1 - i);
  s.c_after = stepped_->after(heard);
  s.c_to_limit = stepped_->to_limit(heard, near.all_e(), near.all_f());
}

}  // namespace limitcheck::reference::catmull_clark
