// SPDX-License-Identifier: MIT
// The control mesh as the kernels read it: rounded, scaled, with the limit points of its vertices.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "fast/mesh/adjacency.h"
#include "fast/rules/limit.h"
#include "fast/rules/masks.h"
#include "fast/rules/sharp_limit.h"
#include "fast/rules/vertex_limit.h"
#include "fast/rules/vertex_normal.h"

namespace limitcheck::fast {

/// The control points, rounded to N.
template <class N>
std::vector<Vec3<N>> positions_of(const data::ControlMesh& mesh) {
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
  PreparedMesh(const Adjacency& adjacency, std::vector<Vec3<N>> positions, VertexKinds kinds = {})
      : adjacency_(&adjacency), positions_(std::move(positions)), kinds_(kinds) {
    prepare<true>();
  }
  /// The same, but limit() is not to be asked.
  struct WithoutLimits {};
  PreparedMesh(const Adjacency& adjacency, std::vector<Vec3<N>> positions, VertexKinds kinds, WithoutLimits)
      : adjacency_(&adjacency), positions_(std::move(positions)), kinds_(kinds) {
    prepare<false>();
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
  template <bool with_limits>
  void prepare() {
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
      if constexpr (with_limits)
        limits_[v] = limit_of(widen<N>(position(v)), ring, open, kind(v), table.of(n, open));
    }
  }

  template <class Weights>
  Vertex limit_of(const Vec3<Wide>& v, std::span<const Vec3<Wide>> ring, bool open, VertexKind kind,
                  const Weights& weights) {
    const VertexLimit<Wide> wide = limit_of_kind(v, ring, open, kind, weights, darts_);
    if constexpr (std::is_same_v<Surface, LimitSurface<N>>) {
      bool degenerate = false;
      const Vec3<Wide> normal =
          vertex_normal<Wide>(wide, v, ring, open, degenerate, std::numeric_limits<double>::infinity(), kind);
      if (degenerate) ++zero_normals_;
      return {narrow<N>(wide.position), narrow<N>(normal) + Vec3<N>{N(0), N(0), N(0)}};
    } else {  // linear numbers have no sizes, and no rounding either
      const LimitFrame<N> frame{narrow<N>(wide.position), narrow<N>(wide.du), narrow<N>(wide.dv)};
      return Surface::vertex(
          frame, [] { return Vec3<Wide>{}; }, zero_normals_);
    }
  }

  const Adjacency* adjacency_;
  std::vector<Vec3<N>> positions_;
  VertexKinds kinds_;
  DartWeightTable<typename NumberTraits<Wide>::Scalar> darts_;
  std::vector<VertexWeights<N>> weights_;
  std::vector<Vertex> limits_;
  std::int64_t zero_normals_ = 0;
};

}  // namespace limitcheck::fast
