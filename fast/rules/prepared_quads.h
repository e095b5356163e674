// SPDX-License-Identifier: MIT
// A mesh of quads as the kernels read it: rounded, scaled, with the limit points of its vertices.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "fast/mesh/quad_mesh.h"
#include "fast/rules/limit.h"
#include "fast/rules/quad_limit.h"
#include "fast/rules/quad_star.h"
#include "fast/rules/semi_sharp.h"

namespace limitcheck::fast {

/// The unit normal of a vertex: du x dv of its limit, unless they vanish or are parallel, as vertex_normal()
/// of vertex_normal.h says; then that of substitute_star_normal(), and `degenerate` becomes true. [D12]
///   own   is subdivided then
template <class W>
Vec3<W> star_normal(const LimitFrame<W>& limit, OwnQuadStar<W>& own, bool& degenerate) {
  using std::sqrt;
  const auto length = [](const Vec3<W>& a) { return sqrt(dot(a, a)); };
  const Vec3<W> normal = cross(limit.du, limit.dv);
  const W size = length(normal), a = length(limit.du), b = length(limit.dv);
  W reach(0);
  for (int i = 0; i < own.star.size(); ++i) reach = reach + length(own.star.ring[i] - own.star.centre);
  degenerate = !(size > W(kParallel<double>) * a * b) || !(std::min(a, b) > W(kVanishing) * reach);
  return degenerate ? substitute_star_normal(own, kParallel<double>) : W(1) / size * normal;
}

/// The sums of e_i - c and f_i - c over a closed ring.
template <class W>
struct StarSums {
  Vec3<W> edges, faces;
};

/// Positions of the vertices in N and their limit points, computed once per mesh in a canonical order: the
/// ring from adjacency.outgoing(v). Every face that touches a vertex delivers these very bits, at whatever
/// depth. [D14] Read-only afterwards, so that threads may share it. Keeps a reference to the mesh, which must
/// outlive it.
template <class N, class Surface = LimitSurface<N>>
class PreparedQuads {
 public:
  using Vertex = typename Surface::Vertex;
  using Wide = typename NumberTraits<N>::Wide;

  using Sums = StarSums<Wide>;

  /// One position per vertex of the mesh.
  PreparedQuads(const QuadMesh& mesh, std::vector<Vec3<N>> positions)
      : mesh_(&mesh), positions_(std::move(positions)), semi_(mesh) {
    const QuadAdjacency& adjacency = mesh.adjacency;
    limits_.resize(positions_.size());
    sums_.resize(positions_.size());
    slot_.resize(4 * static_cast<std::size_t>(adjacency.face_count()));
    StarWeightTable<Weight> table;
    OwnQuadStar<Wide> own;
    for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
      const auto fan = adjacency.fan(v);
      if (fan.empty()) continue;
      for (std::size_t i = 0; i < fan.size(); ++i) slot_[fan[i]] = static_cast<std::int32_t>(i);
      own.gather(mesh, v, [&](std::int32_t w) { return widen<N>(position(w)); });
      for (int i = 0; i < own.star.faces; ++i) {
        sums_[v].edges = sums_[v].edges + (own.star.edge(i) - own.star.centre);
        sums_[v].faces = sums_[v].faces + (own.star.face(i) - own.star.centre);
      }
      for (const StarTags& tags : semi_.steps(v)) own.subdivide(&tags);
      limits_[v] = limit_of(own, table.of(own.star.faces, own.star.open, own.star.kind));
    }
  }
  PreparedQuads(QuadMesh&&, std::vector<Vec3<N>>) = delete;

  const QuadMesh& mesh() const { return *mesh_; }
  const Vec3<N>& position(std::int32_t v) const { return positions_[v]; }
  const Vertex& limit(std::int32_t v) const { return limits_[v]; }
  const Sums& sums(std::int32_t v) const { return sums_[v]; }
  const SemiSharp& semi_sharp() const { return semi_; }
  /// Which of its origin's edges a half-edge is.
  std::int32_t slot(std::int32_t h) const { return slot_[h]; }
  std::int64_t zero_normals() const { return zero_normals_; }

 private:
  using Weight = typename NumberTraits<Wide>::Scalar;

  Vertex limit_of(OwnQuadStar<Wide>& own, const StarWeights<Weight>& weights) {
    const LimitFrame<Wide> wide = star_limit(own.star, weights);
    if constexpr (std::is_same_v<Surface, LimitSurface<N>>) {
      bool degenerate = false;
      const Vec3<Wide> normal = star_normal(wide, own, degenerate);
      if (degenerate) ++zero_normals_;
      return {narrow<N>(wide.position), narrow<N>(normal) + Vec3<N>{N(0), N(0), N(0)}};
    } else {  // linear numbers have no sizes
      const LimitFrame<N> frame{narrow<N>(wide.position), narrow<N>(wide.du), narrow<N>(wide.dv)};
      return Surface::vertex(
          frame, [] { return Vec3<Wide>{}; }, zero_normals_);
    }
  }

  const QuadMesh* mesh_;
  std::vector<Vec3<N>> positions_;
  std::vector<Vertex> limits_;
  std::vector<Sums> sums_;
  std::vector<std::int32_t> slot_;
  SemiSharp semi_;
  std::int64_t zero_normals_ = 0;
};

}  // namespace limitcheck::fast
