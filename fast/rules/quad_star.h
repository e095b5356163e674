// SPDX-License-Identifier: MIT
// Catmull and Clark's subdivision masks, in an order of operations that gives shared points the same bits, and a
// vertex with the faces around it, on which one step of these rules closes. [Catmull & Clark 1978; C21, D14]
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fast/mesh/cut_mesh.h"
#include "fast/rules/limit.h"
#include "fast/rules/masks.h"
#include "fast/rules/surface_vertex.h"

namespace limitcheck::fast {

// Every rule here keeps its bits under quarter turns, up to the signs of tangents, which turn exactly: a
// shared edge may be any side of either quad. So sums go over opposite pairs first. The rules of curves are
// those of Loop's scheme: midpoint() and curve_vertex() in masks.h.

/// The middle of a face with corners a, b, c, d in this order.
template <class N>
constexpr Vec3<N> quad_face_point(const Vec3<N>& a, const Vec3<N>& b, const Vec3<N>& c, const Vec3<N>& d) {
  return NumberTraits<N>::ratio(1, 4) * ((a + c) + (b + d));
}

/// Edge rule (a + b + f + g) / 4: a and b the ends, f and g the middles of the faces on both sides.
template <class N>
constexpr Vec3<N> quad_edge_point(const Vec3<N>& a, const Vec3<N>& b, const Vec3<N>& f, const Vec3<N>& g) {
  using T = NumberTraits<N>;
  const Vec3<N> ends = a + b;
  return T::ratio(1, 2) * ends + T::ratio(1, 4) * ((f + g) - ends);
}

/// Eight points around one, counter-clockwise from e.
///
///        nw -- n -- ne
///         |    |    |
///         w -- v -- e
///         |    |    |
///        sw -- s -- se
template <class N>
struct QuadNeighbours {
  const Vec3<N>&e, &ne, &n, &nw, &w, &sw, &s, &se;

  constexpr Vec3<N> sides() const { return (e + w) + (n + s); }
  constexpr Vec3<N> diagonals() const { return (ne + sw) + (nw + se); }
};

/// Vertex rule for valence 4: half of v, a sixteenth of each neighbour along an edge and of each middle of a
/// face (which stand at the diagonals here).
template <class N>
constexpr Vec3<N> regular_quad_vertex(const Vec3<N>& v, const QuadNeighbours<N>& r) {
  using T = NumberTraits<N>;
  return v + T::ratio(1, 16) * ((r.sides() + r.diagonals()) - T::ratio(8, 1) * v);
}

/// The limit of a vertex of valence 4: (16 v + 4 sides + diagonals) / 36, and differences along both axes.
template <class N>
constexpr LimitFrame<N> regular_quad_limit(const Vec3<N>& v, const QuadNeighbours<N>& r) {
  using T = NumberTraits<N>;
  const auto four = T::ratio(4, 1);
  const Vec3<N> up = r.ne - r.sw, down = r.se - r.nw;
  return {v + T::ratio(1, 36) * ((four * r.sides() + r.diagonals()) - T::ratio(20, 1) * v),
          four * (r.e - r.w) + (up + down), four * (r.n - r.s) + (up - down)};
}

/// The limit of a boundary vertex of two faces, ring e, ne, n, nw, w: (4 v + e + w) / 6, along the boundary
/// e - w, across it (-4; -1, 4, -1; 1, 1).
template <class N>
constexpr LimitFrame<N> regular_quad_boundary_limit(const Vec3<N>& v, const Vec3<N>& e, const Vec3<N>& ne,
                                                    const Vec3<N>& n, const Vec3<N>& nw, const Vec3<N>& w) {
  using T = NumberTraits<N>;
  return {v + T::ratio(1, 6) * ((e + w) - T::ratio(2, 1) * v), e - w,
          T::ratio(4, 1) * (n - v) + ((ne - e) + (nw - w))};
}

/// a blended with b: weight 1 is a.
template <class N>
constexpr Vec3<N> blend(double weight, const Vec3<N>& a, const Vec3<N>& b) {
  return b + static_cast<typename NumberTraits<N>::Scalar>(weight) * (a - b);
}

/// What is semi-sharp at a vertex in one step; see SemiSharp.
struct StarTags {
  std::vector<double> edges;         // per edge of the ring: how much of its point is its midpoint, 0 .. 1
  double held = 0, crease = 0;       // the shares of both rules in the vertex's point; the rest is smooth
  std::int32_t crease_edge[2] = {};  // whose other ends the crease rule takes
  double sum = 0;                    // of the sharpness of all semi-sharp edges at the vertex,
  int count = 0;                     // and their number
};

/// A vertex and its ring counter-clockwise: e_0, f_0, e_1, f_1, ..: neighbours along edges and, between them,
/// the opposite corners of faces. Closed: 2 n points. Open: 2 n + 1, from boundary to boundary.
template <class N>
struct QuadStar {
  Vec3<N> centre{};
  Vec3<N>* ring = nullptr;
  int faces = 0;
  bool open = false;
  VertexKind kind = VertexKind::kPlain;

  int size() const { return 2 * faces + (open ? 1 : 0); }
  int edges() const { return faces + (open ? 1 : 0); }
  int wrapped(int i) const { return open ? i : i < 0 ? i + faces : i >= faces ? i - faces : i; }
  /// Closed: -faces <= i < 2 faces.
  const Vec3<N>& edge(int i) const { return ring[2 * wrapped(i)]; }
  const Vec3<N>& face(int i) const { return ring[2 * wrapped(i) + 1]; }
  bool has_face(int i) const { return !open || (i >= 0 && i < faces); }
};

/// The smooth rule, summed in the wide number: of a dart e_0 counts once, like all others.
///   middles   where face(i) is the middle of face i
template <class N>
Vec3<N> smooth_star_vertex(const QuadStar<N>& star, const QuadStar<N>& middles) {
  using Wide = NumberTraits<typename NumberTraits<N>::Wide>;
  const auto v = widen<N>(star.centre);
  WideVec3<N> sum{};
  for (int i = 0; i < star.faces; ++i)
    sum = sum + ((widen<N>(star.edge(i)) - v) + (widen<N>(middles.face(i)) - v));
  return narrow<N>(v + Wide::ratio(1, star.faces * star.faces) * sum);
}

/// One step of the ring into another of the same size; `out` keeps its own memory. The centre is left alone.
template <class N>
void subdivide_ring(const QuadStar<N>& star, const StarTags* tags, QuadStar<N>& out) {
  const int n = star.faces;
  for (int i = 0; i < n; ++i)
    out.ring[2 * i + 1] = quad_face_point(star.centre, star.edge(i), star.face(i), star.edge(i + 1));
  for (int i = 0; i < star.edges(); ++i) {
    const double weight = !star.has_face(i) || !star.has_face(i - 1) ? 1
                          : tags == nullptr                          ? 0
                                            : tags->edges[static_cast<std::size_t>(i)];
    const Vec3<N>& end = star.edge(i);
    if (weight >= 1) {
      out.ring[2 * i] = midpoint(star.centre, end);
      continue;
    }
    const Vec3<N>&right = out.ring[2 * star.wrapped(i - 1) + 1], &left = out.ring[2 * i + 1];
    out.ring[2 * i] = quad_edge_point(star.centre, end, right, left);
    if (weight > 0) out.ring[2 * i] = blend(weight, midpoint(star.centre, end), out.ring[2 * i]);
  }
}

/// The vertex rule, whatever the kind. A closed ring of four keeps its bits under quarter turns.
///   next   the ring after the step
template <class N>
Vec3<N> subdivide_centre(const QuadStar<N>& star, const StarTags* tags, const QuadStar<N>& next) {
  if (star.kind == VertexKind::kHeld) return star.centre;
  const auto curve = [&](int a, int b) { return curve_vertex(star.centre, star.edge(a), star.edge(b)); };
  const auto smooth = [&] {
    if (star.open || star.faces != 4) return smooth_star_vertex(star, next);
    return regular_quad_vertex(
        star.centre, QuadNeighbours<N>{star.edge(0), next.face(0), star.edge(1), next.face(1), star.edge(2),
                                       next.face(2), star.edge(3), next.face(3)});
  };
  if (tags == nullptr) return star.open && star.kind == VertexKind::kPlain ? curve(0, star.faces) : smooth();
  if (tags->held >= 1) return star.centre;
  const bool only_crease = tags->held + tags->crease >= 1;
  Vec3<N> point = only_crease ? Vec3<N>{} : smooth();
  if (tags->crease > 0) {
    const Vec3<N> crease = curve(tags->crease_edge[0], tags->crease_edge[1]);
    point = only_crease ? crease : blend(tags->crease / (1 - tags->held), crease, point);
  }
  return tags->held > 0 ? blend(tags->held, star.centre, point) : point;
}

/// The points around a vertex, from adjacency.outgoing(v) on.
template <class Position, class N>
void gather_ring(const QuadAdjacency& adjacency, std::int32_t v, Position&& position, Vec3<N>* out) {
  const auto fan = adjacency.fan(v);
  for (const std::int32_t h : fan) {
    *out++ = position(adjacency.target(h));
    *out++ = position(adjacency.target(QuadAdjacency::next(h)));
  }
  if (adjacency.on_boundary(v)) *out = position(adjacency.origin(QuadAdjacency::prev(fan.back())));
}

/// A star with memory of its own, in a field W: what is done once per control vertex.
template <class W>
class OwnQuadStar {
 public:
  QuadStar<W> star;

  OwnQuadStar() = default;
  OwnQuadStar(const OwnQuadStar&) = delete;
  OwnQuadStar& operator=(const OwnQuadStar&) = delete;

  /// The star of a vertex that has a face: its ring from adjacency.outgoing(v).
  ///   position(v)   in W
  template <class Position>
  void gather(const QuadMesh& mesh, std::int32_t v, Position&& position) {
    const QuadAdjacency& adjacency = mesh.adjacency;
    resize(static_cast<int>(adjacency.fan(v).size()), adjacency.on_boundary(v), mesh.kind(v));
    star.centre = position(v);
    gather_ring(adjacency, v, position, star.ring);
  }
  /// Another star as it is now.
  void copy(const OwnQuadStar& other) {
    resize(other.star.faces, other.star.open, other.star.kind);
    star.centre = other.star.centre;
    std::copy_n(other.star.ring, star.size(), star.ring);
  }
  void resize(int faces, bool open, VertexKind kind) {
    star = {{}, nullptr, faces, open, kind};
    points_.resize(static_cast<std::size_t>(star.size()));
    other_.resize(points_.size());
    star.ring = points_.data();
  }

  void subdivide(const StarTags* tags = nullptr) {
    QuadStar<W> next = star;
    next.ring = other_.data();
    subdivide_ring(star, tags, next);
    next.centre = subdivide_centre(star, tags, next);
    points_.swap(other_);
    star = next;
  }

 private:
  std::vector<Vec3<W>> points_, other_;
};

/// The unit normal of the faces of a star, weighted by area; zero if it is lost in rounding, as in
/// area_normal() of limit.h. Rings of four are added in opposite pairs.
template <class W>
Vec3<W> star_area_normal(const QuadStar<W>& star, double tolerance) {
  const Vec3<W>& v = star.centre;
  const auto face = [&](int i) { return cross(star.face(i) - v, star.edge(i + 1) - star.edge(i)); };
  Vec3<W> sum{};
  if (!star.open && star.faces == 4) {
    sum = (face(0) + face(2)) + (face(1) + face(3));
  } else {
    for (int i = 0; i < star.faces; ++i) sum = sum + face(i);
  }
  W reach(0);
  for (int i = 0; i < star.size(); ++i) reach = std::max(reach, dot(star.ring[i] - v, star.ring[i] - v));
  return unit_or_lost(sum, reach, tolerance);
}

/// That of a star, see normal_after_steps(), which subdivides it.
template <class W>
Vec3<W> substitute_star_normal(OwnQuadStar<W>& own, double tolerance) {
  return normal_after_steps<W>([&] { return star_area_normal(own.star, tolerance); },
                               [&] { own.subdivide(); });
}

}  // namespace limitcheck::fast
