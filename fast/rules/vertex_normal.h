// SPDX-License-Identifier: MIT
// The normal of a vertex from its two tangents, and what takes its place where they vanish or are parallel:
// one rule for both engines and for the depth heuristics. [mueller2000, C29, D12]
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "fast/mesh/vertex_kind.h"
#include "fast/rules/masks.h"
#include "fast/rules/surface_vertex.h"

namespace limitcheck::fast {

/// Two directions count as parallel if the sine of their angle is at most this; a sum of facet normals counts
/// as zero if it is at most this times the square of the ring's radius. N is the number in which the ring's
/// points were computed: double also for control points, which are given.
template <class N>
inline constexpr double kParallel = sizeof(N) == 4 ? 1e-6 : 1e-12;
/// A tangent counts as zero if it is at most this times sum |r_i - v|: what is left of it may be rounding.
inline constexpr double kVanishing = 1e-14;

/// The smooth vertex rule, summed over the ring from its first point on.
template <class W>
Vec3<W> smooth_vertex(const Vec3<W>& v, std::span<const Vec3<W>> ring) {
  const auto weights = vertex_weights<W>(static_cast<int>(ring.size()));
  Vec3<W> sum{};
  for (const Vec3<W>& p : ring) sum = sum + p;
  return weights.centre * v + weights.ring * sum;
}

/// One subdivision step of a vertex and its ring in place. A half turn of a ring of six keeps the bits. [C29]
template <class W>
void subdivide_in_place(Vec3<W>& v, std::span<Vec3<W>> ring, bool open,
                        VertexKind kind = VertexKind::kPlain) {
  const std::size_t n = ring.size();
  const Vec3<W> old = v, first = ring[0];
  Vec3<W> before = ring[n - 1];
  if (kind == VertexKind::kDart) {
    v = smooth_vertex<W>(old, ring.first(n - 1));
  } else if (kind == VertexKind::kHeld) {
    v = old;
  } else if (open) {
    v = curve_vertex(old, first, before);
  } else if (n == 6) {
    v = regular_vertex(old, AxisRing<W>{ring[0], ring[1], ring[2], ring[3], ring[4], ring[5]});
  } else {
    v = smooth_vertex<W>(old, ring);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3<W> here = ring[i];
    ring[i] = open && (i == 0 || i + 1 == n)
                  ? midpoint(old, here)
                  : edge_point(old, here, before, i + 1 == n ? first : ring[i + 1]);
    before = here;
  }
}

/// The unit normal of a fan, its faces weighted by area; zero if it is lost in rounding: at most `tolerance`
/// times the square of the fan's radius. Rings of six are added in opposite pairs.
template <class W>
Vec3<W> area_normal(const Vec3<W>& v, std::span<const Vec3<W>> ring, bool open, double tolerance) {
  using std::sqrt;
  const std::size_t n = ring.size();
  const auto face = [&](std::size_t i) { return cross(ring[i] - v, ring[(i + 1) % n] - v); };
  Vec3<W> sum{};
  if (!open && n == 6) {
    sum = (face(0) + face(3)) + ((face(1) + face(4)) + (face(2) + face(5)));
  } else {
    for (std::size_t i = 0; i + (open ? 1 : 0) < n; ++i) sum = sum + face(i);
  }
  W reach(0);
  for (const Vec3<W>& p : ring) reach = std::max(reach, dot(p - v, p - v));
  const W size = sqrt(dot(sum, sum));
  return size > W(tolerance) * reach && size >= std::numeric_limits<W>::min() ? W(1) / size * sum : Vec3<W>{};
}

/// The unit normal where the tangents vanish or are parallel: that of the faces, weighted by area, after one
/// to three steps in place, else before them, else (0, 0, 1). [D12]
///   ring   is overwritten
template <class W>
Vec3<W> substitute_normal(Vec3<W> v, std::span<Vec3<W>> ring, bool open, double tolerance,
                          VertexKind kind = VertexKind::kPlain) {
  const Vec3<W> control = area_normal<W>(v, ring, open, tolerance);
  for (int step = 0; step < 3; ++step) {
    subdivide_in_place<W>(v, ring, open, kind);
    const Vec3<W> normal = area_normal<W>(v, ring, open, tolerance);
    if (normal != Vec3<W>{}) return normal;
  }
  return control != Vec3<W>{} ? control : Vec3<W>{W(0), W(0), W(1)};
}

/// The same for a control vertex, whose ring is kept.
template <class W>
Vec3<W> substitute_normal(const Vec3<W>& v, std::span<const Vec3<W>> ring, bool open, VertexKind kind) {
  std::vector<Vec3<W>> copy(ring.begin(), ring.end());
  return substitute_normal<W>(v, copy, open, kParallel<double>, kind);
}

/// The unit normal of a control vertex: du x dv, unless one of them vanishes (kVanishing) or they are
/// parallel (kParallel<double>); then that of substitute_normal(), and `degenerate` becomes true. [D12]
///   ring      the points that the tangents sum, v the vertex
///   farthest  no point of the ring is farther from v, if that is known: it saves looking
template <class W>
inline Vec3<W> vertex_normal(const LimitFrame<W>& limit, const Vec3<W>& v, std::span<const Vec3<W>> ring,
                             bool open, bool& degenerate,
                             double farthest = std::numeric_limits<double>::infinity(),
                             VertexKind kind = VertexKind::kPlain) {
  using std::sqrt;
  const auto length = [](const Vec3<W>& a) { return sqrt(dot(a, a)); };
  const Vec3<W> normal = cross(limit.du, limit.dv);
  const W size = length(normal), a = length(limit.du), b = length(limit.dv);
  degenerate = !(size > W(kParallel<double>) * a * b);
  if (std::min(a, b) <= W(kVanishing * static_cast<double>(ring.size()) * farthest)) {
    W reach(0);
    for (const Vec3<W>& r : ring) reach = reach + length(r - v);
    degenerate = degenerate || !(std::min(a, b) > W(kVanishing) * reach);
  }
  return degenerate ? substitute_normal(v, ring, open, kind) : W(1) / size * normal;
}

}  // namespace limitcheck::fast
