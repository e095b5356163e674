// SPDX-License-Identifier: MIT
// Limits of regular points inside a patch, and the normal of a vertex from its two tangents, with what takes its place
// where they vanish or are parallel: one rule for both engines and the depth heuristics. vertex_limit.h has the limits
// of control vertices. [mueller2000, eq. 3-5; C14-C17, C29, D1, D2, D12, D14]
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "fast/mesh/cut_mesh.h"
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

/// A sum of facet normals brought to length 1; zero if it is lost in rounding: at most `tolerance` times the square of
/// the facets' reach.
template <class W>
Vec3<W> unit_or_lost(const Vec3<W>& sum, const W& squared_reach, double tolerance) {
  using std::sqrt;
  const W size = sqrt(dot(sum, sum));
  return size > W(tolerance) * squared_reach && size >= std::numeric_limits<W>::min() ? W(1) / size * sum
                                                                                      : Vec3<W>{};
}

/// The unit normal of a fan, its faces weighted by area; zero if it is lost, the reach being the fan's radius. Rings of
/// six are added in opposite pairs.
template <class W>
Vec3<W> area_normal(const Vec3<W>& v, std::span<const Vec3<W>> ring, bool open, double tolerance) {
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
  return unit_or_lost(sum, reach, tolerance);
}

/// The unit normal where the tangents vanish or are parallel: that of the faces, weighted by area, after one
/// to three steps, else before them, else (0, 0, 1). [D12]
///   of_faces()   their normal as they are, zero if it is lost
template <class W, class OfFaces, class Step>
Vec3<W> normal_after_steps(const OfFaces& of_faces, const Step& step) {
  const Vec3<W> control = of_faces();
  for (int k = 0; k < 3; ++k) {
    step();
    const Vec3<W> normal = of_faces();
    if (normal != Vec3<W>{}) return normal;
  }
  return control != Vec3<W>{} ? control : Vec3<W>{W(0), W(0), W(1)};
}

/// The same of a fan.
///   ring   is overwritten
template <class W>
Vec3<W> substitute_normal(Vec3<W> v, std::span<Vec3<W>> ring, bool open, double tolerance,
                          VertexKind kind = VertexKind::kPlain) {
  return normal_after_steps<W>([&] { return area_normal<W>(v, ring, open, tolerance); },
                               [&] { subdivide_in_place<W>(v, ring, open, kind); });
}

/// The unit normal of a control vertex: du x dv, unless one of them vanishes (kVanishing) or they are
/// parallel (kParallel<double>); then substitute(), and `degenerate` becomes true. [D12]
///   ring      the points that the tangents sum, v the vertex
///   farthest  no point of the ring is farther from v, if that is known: it saves looking
template <class W, class Substitute>
inline Vec3<W> normal_or_substitute(const LimitFrame<W>& limit, const Vec3<W>& v,
                                    std::span<const Vec3<W>> ring, bool& degenerate, double farthest,
                                    const Substitute& substitute) {
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
  return degenerate ? substitute() : W(1) / size * normal;
}

/// The same of Loop's scheme, with substitute_normal(); the ring is kept.
template <class W>
inline Vec3<W> vertex_normal(const LimitFrame<W>& limit, const Vec3<W>& v, std::span<const Vec3<W>> ring,
                             bool open, bool& degenerate,
                             double farthest = std::numeric_limits<double>::infinity(),
                             VertexKind kind = VertexKind::kPlain) {
  return normal_or_substitute(limit, v, ring, degenerate, farthest, [&] {
    std::vector<Vec3<W>> copy(ring.begin(), ring.end());
    return substitute_normal<W>(v, copy, open, kParallel<double>, kind);
  });
}

/// At a vertex of valence 6, (6 v + ring) / 12, du = 2 C and dv = 2 S / sqrt(3) of the ring started at e.
/// Both tangents are sums of differences of near points. A half turn of the ring negates both exactly.
///
///        1 --- 1             -1 --- 1              1 --- 1
///       / \   / \            / \   / \            / \   / \            .
///      1 --- 6 --- 1       -2 --- 0 --- 2        0 --- 0 --- 0
///       \ /   \ /            \ /   \ /            \ /   \ /
///        1 --- 1             -1 --- 1             -1 --- -1
template <class N>
constexpr LimitFrame<N> regular_limit(const Vec3<N>& v, const AxisRing<N>& r) {
  using T = NumberTraits<N>;
  return {v + T::ratio(1, 12) * (axis_sum(r) - T::ratio(6, 1) * v),
          T::ratio(2, 1) * (r.e - r.w) + ((r.ne - r.nw) + (r.se - r.sw)), (r.ne - r.se) + (r.nw - r.sw)};
}

/// At a boundary vertex of three faces, ring e, ne, nw, w counter-clockwise: (4 v + e + w) / 6, along the
/// boundary e - w, across it (-2; -1, 2, 2, -1). [D1, D2]
template <class N>
constexpr LimitFrame<N> regular_boundary_limit(const Vec3<N>& v, const Vec3<N>& e, const Vec3<N>& ne,
                                               const Vec3<N>& nw, const Vec3<N>& w) {
  using T = NumberTraits<N>;
  return {v + T::ratio(1, 6) * ((e + w) - T::ratio(2, 1) * v), e - w,
          T::ratio(2, 1) * ((ne - v) + (nw - v)) - ((e - v) + (w - v))};
}

/// The vertex of a limit frame. If the tangents vanish or are parallel (kParallel<N>), the normal is what
/// `substitute` returns, a unit vector in the wide number, and `zero_normals` counts it. Never NaN for finite
/// input. [D12]
template <class N>
class LimitSurface {
 public:
  using Vertex = SurfaceVertex<N>;

  template <class Substitute>
  static Vertex vertex(const LimitFrame<N>& frame, Substitute&& substitute, std::int64_t& zero_normals) {
    Vec3<N> normal = cross(frame.du, frame.dv);
    const N square = dot(normal, normal);
    // + 0 turns a negative zero into zero: its sign would depend on the direction of the axis.
    const Vec3<N> zero{N(0), N(0), N(0)};
    if (!(square > kSquare * dot(frame.du, frame.du) * dot(frame.dv, frame.dv)) || square < kSmallest)
        [[unlikely]] {
      ++zero_normals;
      return {frame.position, narrow<N>(substitute()) + zero};
    }
    using std::sqrt;
    return {frame.position, N(1) / sqrt(square) * normal + zero};
  }

 private:
  static constexpr N kSquare = N(kParallel<N> * kParallel<N>);
  static constexpr N kSmallest = std::numeric_limits<N>::min();
};

/// The vertex of the limit of a control vertex, which was summed in the wide number. normal(degenerate) is its unit
/// normal; linear numbers have no sizes, and no need of it.
template <class N, class Surface, class Normal>
typename Surface::Vertex control_vertex(const LimitFrame<typename NumberTraits<N>::Wide>& wide,
                                        std::int64_t& zero_normals, Normal&& normal) {
  if constexpr (std::is_same_v<Surface, LimitSurface<N>>) {
    bool degenerate = false;
    const WideVec3<N> unit = normal(degenerate);
    if (degenerate) ++zero_normals;
    return {narrow<N>(wide.position), narrow<N>(unit) + Vec3<N>{N(0), N(0), N(0)}};
  } else {
    const LimitFrame<N> frame{narrow<N>(wide.position), narrow<N>(wide.du), narrow<N>(wide.dv)};
    return Surface::vertex(
        frame, [] { return WideVec3<N>{}; }, zero_normals);
  }
}

}  // namespace limitcheck::fast
