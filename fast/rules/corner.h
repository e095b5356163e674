// SPDX-License-Identifier: MIT
// The ring of a corner: the paper's corner arrays, for any valence, closed or open. [mueller2000, 4.3; D11]
#pragma once

#include <cstdint>
#include <span>

#include "fast/mesh/adjacency.h"
#include "fast/rules/limit.h"
#include "fast/rules/masks.h"
#include "fast/rules/prepared_mesh.h"

namespace limitcheck::fast {

/// The neighbours of a corner vertex, counter-clockwise from one that the caller chooses; neighbours are
/// found by their slot in the ring, never by identity, since at valence 3 one slot plays two roles.
///   ring     of n neighbours
///   gap      no face lies between ring[gap] and ring[gap + 1] (indices modulo n);
///            -1 at an interior vertex
///   kind     of a dart the slots after the gap and before it hold the same point
///   start    control vertices: the slot that sums begin with, the same neighbour from every face;
///            -1: a point on a control edge, of valence 6 with the edge along slots 2 and 5, or on a
///            boundary with four neighbours
template <class N, class Vertex>
struct CornerRing {
  Vec3<N>* ring = nullptr;
  int n = 0;
  int gap = -1;
  int start = -1;
  VertexKind kind = VertexKind::kPlain;
  VertexWeights<N> weights;
  const Vertex* limit = nullptr;  // control vertices: the prepared limit point

  bool has_face_after(int slot) const { return slot != gap; }
  int slot(int i) const { return i < n ? i : i - n; }
  const Vec3<N>& at(int i) const { return ring[slot(i)]; }
};

/// Fills a corner from the mesh: ring[slot] is the target of half-edge h, the rest follows counter-clockwise.
///   storage   room for adjacency.valence(origin(h)) points
template <class N, class Surface>
CornerRing<N, typename Surface::Vertex> gather_corner(const PreparedMesh<N, Surface>& mesh, std::int32_t h,
                                                      bool from_last_slot, Vec3<N>* storage) {
  const Adjacency& adjacency = mesh.adjacency();
  const std::int32_t v = adjacency.origin(h);
  const std::int32_t first = adjacency.outgoing(v);
  CornerRing<N, typename Surface::Vertex> corner;
  corner.ring = storage;
  corner.n = adjacency.valence(v);
  corner.kind = mesh.kind(v);
  corner.weights = mesh.weights(v);
  corner.limit = &mesh.limit(v);
  int slot = from_last_slot ? corner.n - 1 : 0;
  if (!adjacency.on_boundary(v)) {
    const std::span<const std::int32_t> fan = adjacency.fan(v);
    int at = 0;
    while (fan[at] != h) ++at;
    corner.start = slot + corner.n - at - (slot < at ? 0 : corner.n);
    for (int i = 0; i < corner.n; ++i) {
      storage[slot] = mesh.position(adjacency.target(fan[at]));
      slot = slot + 1 == corner.n ? 0 : slot + 1;
      at = at + 1 == corner.n ? 0 : at + 1;
    }
    return corner;
  }
  std::int32_t walk = h;
  for (int i = 0; i < corner.n; ++i) {
    const int next = slot + 1 == corner.n ? 0 : slot + 1;
    storage[slot] = mesh.position(adjacency.target(walk));
    if (walk == first) corner.start = slot;
    slot = next;
    const std::int32_t after = adjacency.rotate(walk);
    if (after < 0) {
      // The last face before the boundary: its far neighbour closes the open ring, which then begins anew.
      storage[next] = mesh.position(adjacency.origin(Adjacency::prev(walk)));
      corner.gap = next;
      slot = next + 1 == corner.n ? 0 : next + 1;
      walk = first;
      ++i;
    } else {
      walk = after;
    }
  }
  return corner;
}

/// One step of a ring: every neighbour becomes the edge point towards it.
///   v   the corner before the step
template <class N, class Vertex>
void subdivide_ring(const Vec3<N>& v, const CornerRing<N, Vertex>& old, CornerRing<N, Vertex>& out) {
  Vec3<N>* const storage = out.ring;
  out = old;
  out.ring = storage;
  for (int i = 0, before = old.n - 1; i < old.n; before = i++) {
    const int after = i + 1 == old.n ? 0 : i + 1;
    storage[i] = old.has_face_after(i) && old.has_face_after(before)
                     ? edge_point(v, old.ring[i], old.ring[before], old.ring[after])
                     : midpoint(v, old.ring[i]);
  }
}

template <class N, class Vertex>
AxisRing<N> edge_axis(const CornerRing<N, Vertex>& c) {
  return {c.ring[2], c.ring[3], c.ring[4], c.ring[5], c.ring[0], c.ring[1]};
}

/// Vertex rule at a corner of any kind.
template <class N, class Vertex>
Vec3<N> subdivide_corner(const Vec3<N>& v, const CornerRing<N, Vertex>& c) {
  if (c.kind == VertexKind::kHeld) return v;
  if (c.kind == VertexKind::kDart) {
    WideVec3<N> sum = widen<N>(c.at(c.gap + 1));
    for (int i = 2; i < c.n; ++i) sum = sum + widen<N>(c.at(c.gap + i));
    return narrow<N>(c.weights.centre * widen<N>(v) + c.weights.ring * sum);
  }
  if (c.gap >= 0) return curve_vertex(v, c.at(c.gap + 1), c.ring[c.gap]);
  if (c.start < 0) return regular_vertex(v, edge_axis(c));
  WideVec3<N> sum = widen<N>(c.ring[c.start]);
  for (int i = c.start + 1; i < c.n; ++i) sum = sum + widen<N>(c.ring[i]);
  for (int i = 0; i < c.start; ++i) sum = sum + widen<N>(c.ring[i]);
  return narrow<N>(c.weights.centre * widen<N>(v) + c.weights.ring * sum);
}

/// Limit vertex of a regular point given its neighbours along an axis.
template <class N, class Surface>
inline typename Surface::Vertex regular_vertex_limit(const Vec3<N>& v, const AxisRing<N>& r,
                                                     std::int64_t& zero_normals) {
  return Surface::vertex(
      regular_limit(v, r),
      [&] {
        WideVec3<N> ring[] = {widen<N>(r.e), widen<N>(r.ne), widen<N>(r.nw),
                              widen<N>(r.w), widen<N>(r.sw), widen<N>(r.se)};
        return substitute_normal<typename NumberTraits<N>::Wide>(widen<N>(v), ring, false, kParallel<N>);
      },
      zero_normals);
}

/// Limit vertex on a boundary edge, ring e, ne, nw, w counter-clockwise.
template <class N, class Surface>
inline typename Surface::Vertex boundary_vertex_limit(const Vec3<N>& v, const Vec3<N>& e, const Vec3<N>& ne,
                                                      const Vec3<N>& nw, const Vec3<N>& w,
                                                      std::int64_t& zero_normals) {
  return Surface::vertex(
      regular_boundary_limit(v, e, ne, nw, w),
      [&] {
        WideVec3<N> ring[] = {widen<N>(e), widen<N>(ne), widen<N>(nw), widen<N>(w)};
        return substitute_normal<typename NumberTraits<N>::Wide>(widen<N>(v), ring, true, kParallel<N>);
      },
      zero_normals);
}

/// Limit vertex at a corner of any kind.
template <class N, class Surface>
typename Surface::Vertex limit_corner(const Vec3<N>& v, const CornerRing<N, typename Surface::Vertex>& c,
                                      std::int64_t& zero_normals) {
  if (c.limit != nullptr) return *c.limit;
  if (c.gap < 0) return regular_vertex_limit<N, Surface>(v, edge_axis(c), zero_normals);
  const int g = c.gap;
  return boundary_vertex_limit<N, Surface>(v, c.at(g + 1), c.at(g + 2), c.at(g + 3), c.ring[g], zero_normals);
}

}  // namespace limitcheck::fast
