// SPDX-License-Identifier: MIT
// A triangle mesh as the kernels read it: rounded, scaled, with the limit points of its vertices; and the ring of a
// corner, the paper's corner arrays, for any valence, closed or open. [mueller2000, 4.3; D11]
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "fast/mesh/adjacency.h"
#include "fast/rules/limit.h"
#include "fast/rules/masks.h"
#include "fast/rules/vertex_limit.h"

namespace limitcheck::fast {

/// The control points of a mesh, rounded to N.
template <class N, class Mesh>
std::vector<Vec3<N>> positions_of(const Mesh& mesh) {
  std::vector<Vec3<N>> positions;
  for (const auto& p : mesh.positions)
    positions.push_back({static_cast<N>(p[0]), static_cast<N>(p[1]), static_cast<N>(p[2])});
  return positions;
}

/// Positions of the control vertices in N, their weights and their limit points, computed once per mesh in a
/// canonical order: the ring from adjacency.outgoing(v). Every face that touches a vertex delivers these very
/// bits, at whatever depth. [D14] Read-only afterwards, so that threads may share it. Keeps a reference to
/// the adjacency, which must outlive it.
template <class N, class Surface = LimitSurface<N>>
class PreparedMesh {
 public:
  using Vertex = typename Surface::Vertex;
  using Wide = typename NumberTraits<N>::Wide;

  /// One position per vertex of the adjacency. Keeps a reference to the kinds, too.
  ///   with_limits   otherwise limit() is not to be asked
  PreparedMesh(const Adjacency& adjacency, std::vector<Vec3<N>> positions, VertexKinds kinds = {},
               bool with_limits = true)
      : adjacency_(&adjacency), positions_(std::move(positions)), kinds_(kinds) {
    prepare(with_limits);
  }

  PreparedMesh(Adjacency&&, std::vector<Vec3<N>>, VertexKinds = {}) = delete;

  /// Other positions for a mesh without limits.
  void move_points(std::vector<Vec3<N>> positions) { positions_ = std::move(positions); }

  const Adjacency& adjacency() const { return *adjacency_; }
  VertexKind kind(std::int32_t v) const { return kinds_[v]; }
  const Vec3<N>& position(std::int32_t v) const { return positions_[v]; }
  const VertexWeights<N>& weights(std::int32_t v) const { return weights_[v]; }
  const Vertex& limit(std::int32_t v) const { return limits_[v]; }
  std::int64_t zero_normals() const { return zero_normals_; }

 private:
  void prepare(bool with_limits) {
    const Adjacency& mesh = adjacency();
    std::vector<VertexWeights<N>> by_valence(static_cast<std::size_t>(mesh.max_valence()) + 1);
    std::vector<bool> known(by_valence.size());
    RingWeightTable<typename NumberTraits<Wide>::Scalar> table(mesh.max_valence());
    weights_.resize(positions_.size());
    limits_.resize(positions_.size());
    std::vector<Vec3<Wide>> ring;
    for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.outgoing(v) < 0) continue;
      const bool open = mesh.on_boundary(v);
      ring.clear();
      mesh.for_each_neighbour(v, [&](std::int32_t w) { ring.push_back(widen<N>(position(w))); });
      const std::size_t n = ring.size();
      const bool dart = kind(v) == VertexKind::kDart;
      if (!open || dart) {
        const std::size_t neighbours = dart ? n - 1 : n;
        if (!known[neighbours])
          by_valence[neighbours] = vertex_weights<N>(static_cast<int>(neighbours)), known[neighbours] = true;
        weights_[v] = by_valence[neighbours];
      }
      table.make(n, open);
      if (with_limits) limits_[v] = limit_of(widen<N>(position(v)), ring, open, kind(v), table.of(n, open));
    }
  }

  template <class Weights>
  Vertex limit_of(const Vec3<Wide>& v, std::span<const Vec3<Wide>> ring, bool open, VertexKind kind,
                  const Weights& weights) {
    const VertexLimit<Wide> wide = limit_of_kind(v, ring, open, kind, weights, darts_);
    return control_vertex<N, Surface>(wide, zero_normals_, [&](bool& degenerate) {
      return vertex_normal<Wide>(wide, v, ring, open, degenerate, std::numeric_limits<double>::infinity(),
                                 kind);
    });
  }

  const Adjacency* adjacency_;
  std::vector<Vec3<N>> positions_;
  VertexKinds kinds_;
  DartWeightTable<typename NumberTraits<Wide>::Scalar> darts_;
  std::vector<VertexWeights<N>> weights_;
  std::vector<Vertex> limits_;
  std::int64_t zero_normals_ = 0;
};

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
  const std::span<const std::int32_t> fan = adjacency.fan(v);
  const int faces = static_cast<int>(fan.size());
  CornerRing<N, typename Surface::Vertex> corner;
  corner.ring = storage;
  corner.n = adjacency.valence(v);
  corner.kind = mesh.kind(v);
  corner.weights = mesh.weights(v);
  corner.limit = &mesh.limit(v);
  int slot = from_last_slot ? corner.n - 1 : 0, at = 0;
  while (fan[at] != h) ++at;
  corner.start = slot + corner.n - at - (slot < at ? 0 : corner.n);
  // The far neighbour of the last face before the boundary closes an open ring.
  const bool open = corner.n > faces;
  if (open) corner.gap = corner.start > 0 ? corner.start - 1 : corner.n - 1;
  const std::int32_t last = open ? adjacency.origin(Adjacency::prev(fan[faces - 1])) : -1;
  for (int i = 0; i < corner.n; ++i) {
    storage[slot] = mesh.position(at < faces ? adjacency.target(fan[at]) : last);
    slot = slot + 1 == corner.n ? 0 : slot + 1;
    at = at + 1 == corner.n ? 0 : at + 1;
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
