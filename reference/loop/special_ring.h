// SPDX-License-Identifier: MIT
// The two-ring of a held vertex or a dart after any number of steps: by powers of its matrix itself, which
// has no such closed form as that of two_ring_modes.h.
//
// The points and their names are those of two_ring_modes.h, taken as differences from c, so that there is no
// eigenvalue 1, and divided by growth^J, about the largest eigenvalue.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "reference/loop/dart.h"
#include "reference/loop/two_ring.h"
#include "reference/mesh/sharp_tags.h"

namespace limitcheck::reference {

/// All that held vertices, or darts, of K faces have in common. A dart has an open sector.
template <class N>
class SpecialRingKind {
 public:
  SpecialRingKind(int faces, bool closed, VertexState state, Weights weights);

  int faces() const { return faces_; }
  bool closed() const { return closed_; }
  const N& growth() const { return growth_; }
  /// r (K + 1, inside K), then p likewise, then q (K), J steps later and over growth^J.
  std::vector<Vec3<N>> advance(std::vector<Vec3<N>> points, long steps) const;
  std::size_t entries() const { return static_cast<std::size_t>(faces_) + (closed_ ? 0 : 1); }

  /// What such points add to c: in one step, and in the limit.
  Vec3<N> after(const std::vector<Vec3<N>>& points) const { return sum(points, after_); }
  Vec3<N> to_limit(const std::vector<Vec3<N>>& points) const { return sum(points, to_limit_); }

 private:
  using Matrix = std::vector<N>;  ///< row by row
  Matrix times(const Matrix& a, const Matrix& b) const;
  Vec3<N> sum(const std::vector<Vec3<N>>& points, const std::vector<N>& weights) const {
    Vec3<N> result{};
    for (std::size_t i = 0; i < weights.size(); ++i) result += points[i] * weights[i];
    return result;
  }

  int faces_;
  bool closed_;
  std::size_t size_;
  N growth_;
  std::vector<N> after_, to_limit_;  ///< weights of r_0, r_1, ..
  std::vector<Matrix> squares_;      ///< powers 1, 2, 4, .. of the matrix
};

/// One such vertex.
template <class N>
class SpecialRing {
 public:
  /// As TwoRing. Keeps a pointer to the kind.
  SpecialRing(const SpecialRingKind<N>& kind, const Vec3<N>& c, const std::vector<Vec3<N>>& r,
              const std::vector<Vec3<N>>& q, const std::vector<Vec3<N>>& p)
      : kind_(&kind) {
    for (const auto* list : {&r, &p, &q})
      for (const Vec3<N>& x : *list) {
        if constexpr (kRounds<N>) size_ = std::max({size_, magnitude(x), magnitude(c)});
        points_.push_back(x - c);
      }
    limit_ = c + kind.to_limit(points_);
  }

  const SpecialRingKind<N>& kind() const { return *kind_; }
  const Vec3<N>& limit() const { return limit_; }
  /// The largest coordinate of the points given.
  const N& size() const { return size_; }
  /// The points around face i after J steps, over growth^J, as differences from c; and from c to its place
  /// after one more step, and to the limit.
  struct FacePoints {
    typename TwoRing<N>::FacePoints points;
    Vec3<N> c_after, c_to_limit;
  };
  FacePoints face_points(int face, long steps) const;

 private:
  const SpecialRingKind<N>* kind_;
  Vec3<N> limit_;
  N size_{};
  std::vector<Vec3<N>> points_;
};

template <class N>
SpecialRingKind<N>::SpecialRingKind(int faces, bool closed, VertexState state, Weights weights)
    : faces_(faces), closed_(closed) {
  const auto count = static_cast<std::size_t>(faces);
  const std::size_t r = 0, p = entries(), q = 2 * entries();
  size_ = q + count;
  if (state == VertexState::kDart) {
    after_.assign(count, ring_weight<N>(faces, weights) / N(faces));  // r_n is r_0
    to_limit_ = dart_limit_weights<N>(faces, weights);
  }
  if (closed)
    growth_ = N(5) / N(8);
  else if (state == VertexState::kDart)  // near enough: growth is only what the powers are divided by
    growth_ = NumberTraits<N>::from_double(std::max(.5, .375 + NumberTraits<double>::cos_pi(2, faces) / 4));
  else
    growth_ = N(1) / N(2) + (faces > 3 ? NumberTraits<N>::cos_pi(1, faces) / N(4) - N(1) / N(8) : N(0));

  Matrix a(size_ * size_, N(0));
  const auto add = [&](std::size_t row, std::size_t column, int weight) {
    a[row * size_ + column] += N(weight) / N(16);
  };
  for (std::size_t i = 0; i < entries(); ++i) {
    if (!closed && (i == 0 || i == count)) {  // the sharp edge's own curve
      add(r + i, r + i, 8);
      add(p + i, r + i, 12), add(p + i, p + i, 2);
      continue;
    }
    const std::size_t next = closed ? (i + 1) % count : i + 1, before = (i + count - 1) % count;
    add(r + i, r + i, 6), add(r + i, r + next, 2), add(r + i, r + before, 2);
    add(p + i, r + i, 10), add(p + i, p + i, 1);
    add(p + i, r + next, 1), add(p + i, r + before, 1), add(p + i, q + i % count, 1),
        add(p + i, q + before, 1);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = closed ? (i + 1) % count : i + 1;
    add(q + i, r + i, 6), add(q + i, r + next, 6), add(q + i, q + i, 2);
  }
  const N share = N(1) / growth_;
  for (std::size_t row = 0; row < size_; ++row) {  // c moves
    for (std::size_t i = 0; i < after_.size(); ++i) a[row * size_ + r + i] -= after_[i];
    for (std::size_t column = 0; column < size_; ++column) a[row * size_ + column] *= share;
  }
  squares_.push_back(std::move(a));
  if constexpr (std::is_same_v<N, double>)  // 2^11 steps are beyond the smallest double
    for (int bit = 1; bit <= 10; ++bit) squares_.push_back(times(squares_.back(), squares_.back()));
}

template <class N>
typename SpecialRingKind<N>::Matrix SpecialRingKind<N>::times(const Matrix& a, const Matrix& b) const {
  Matrix result(a.size(), N(0));
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t k = 0; k < size_; ++k)
      for (std::size_t j = 0; j < size_; ++j) result[i * size_ + j] += a[i * size_ + k] * b[k * size_ + j];
  return result;
}

template <class N>
std::vector<Vec3<N>> SpecialRingKind<N>::advance(std::vector<Vec3<N>> points, long steps) const {
  Matrix square = squares_.front();
  for (std::size_t bit = 0; (steps >> bit) != 0; ++bit) {
    if (bit > 0) square = bit < squares_.size() ? squares_[bit] : times(square, square);
    if (((steps >> bit) & 1) == 0) continue;
    std::vector<Vec3<N>> next(size_);
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t k = 0; k < size_; ++k) next[i] += points[k] * square[i * size_ + k];
    points = std::move(next);
  }
  return points;
}

template <class N>
typename SpecialRing<N>::FacePoints SpecialRing<N>::face_points(int face, long steps) const {
  const std::vector<Vec3<N>> points = kind_->advance(points_, steps);
  const int count = kind_->faces(), entries = static_cast<int>(kind_->entries());
  const bool closed = kind_->closed();
  FacePoints result{};
  auto& s = result.points;
  s.first_edge_on_boundary = !closed && face == 0;
  s.last_edge_on_boundary = !closed && face + 1 == count;
  const auto set = [&](Vec3<N>& point, int first, int at, int number) {
    if (closed) at = (at + number) % number;
    if (at >= 0 && at < number) point = points[static_cast<std::size_t>(first + at)];
  };
  for (int k = 0; k < 6; ++k) set(s.r[k], 0, face - 2 + k, entries);
  for (int k = 0; k < 2; ++k) set(s.p[k], entries, face + k, entries);
  for (int k = 0; k < 3; ++k) set(s.q[k], 2 * entries, face - 1 + k, count);
  if (s.first_edge_on_boundary) {
    s.r[1] = ghost_point(s.c, s.r[2], s.r[3]);
    s.q[0] = ghost_point(s.r[2], s.p[0], s.q[1]);
  }
  if (s.last_edge_on_boundary) {
    s.r[4] = ghost_point(s.c, s.r[3], s.r[2]);
    s.q[2] = ghost_point(s.r[3], s.p[1], s.q[1]);
  }
  result.c_after = kind_->after(points);
  result.c_to_limit = kind_->to_limit(points);
  return result;
}

}  // namespace limitcheck::reference
