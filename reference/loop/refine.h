// SPDX-License-Identifier: MIT
// Uniform refinement of a whole mesh: the textbook way, every point once.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "reference/loop/masks.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/mesh/topology.h"
#include "reference/number/vec3.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference {

class Sharpness;

/// One step: the new vertex points, in the order of the vertices, then the edge points, in the order
/// of the edges.
///   states   of the vertices of a mesh that is cut along its sharp edges
template <class N>
std::vector<Vec3<N>> refine_once(const Topology& topology, const std::vector<Vec3<N>>& positions,
                                 Weights weights = Weights::kLoop, std::span<const VertexState> states = {},
                                 const Valences& valences = {});

/// The control points as they are, in the number type: exact in every one but narrower ones.
template <class N>
std::vector<Vec3<N>> positions_of(const data::ControlMesh& mesh);

/// A mesh after `depth` steps. Lattice point (i, j) of a face, i, j >= 0, i + j <= 2^depth, has l1 = i /
/// 2^depth and l2 = j / 2^depth. Vertices shared by faces appear once; the control vertices come first, in
/// their order.
template <class N>
class RefinedMesh {
 public:
  /// Depth 0: the mesh itself. Throws data::ArgumentError if it is not manifold (Topology).
  explicit RefinedMesh(const data::ControlMesh& mesh, Weights weights = Weights::kLoop);
  RefinedMesh(std::vector<Vec3<N>> positions, std::vector<Triangle> triangles,
              Weights weights = Weights::kLoop, const SharpTags& tags = {});

  /// One more step. Exact in exact arithmetic; in double each coordinate is a convex combination rounded a
  /// few times.
  ///   throws data::ArgumentError if the refined mesh would have more than 2^31 - 1 vertices
  void refine();

  int depth() const { return depth_; }
  const std::vector<Vec3<N>>& positions() const { return positions_; }
  /// 4^depth per control face, one face after the other: first the triangles (i, j) (i+1, j) (i, j+1), j
  /// outer, i inner, then (i+1, j) (i+1, j+1) (i, j+1) likewise.
  data::Triangles triangles() const { return data::Triangles(topology_.faces()); }
  std::int32_t vertex(std::size_t face, int i, int j) const {
    const bool at_side = i + j == (1 << depth_);
    const bool at_top = at_side && j > 0;  // a corner of the last one of its row
    const auto triangle = topology_.faces()[upright(face, i - (at_side && !at_top), j - at_top)];
    return triangle[at_top ? 2 : at_side];
  }
  const Topology& topology() const { return topology_; }

  /// Limit positions and unit normals of all vertices; of a vertex on a sharp edge, which has a normal for
  /// each side, that of the first face in its ring.
  /// [C14, D1, D2, D12]
  VertexLimits<N> limits() const;

 private:
  /// The triangle (i, j) (i+1, j) (i, j+1).
  std::size_t upright(std::size_t face, int i, int j) const {
    const std::size_t row = j, before = (row << depth_) - row * (row - 1) / 2;
    return (face << (2 * depth_)) + before + i;
  }

  int depth_ = 0;
  Weights weights_;
  std::vector<Vec3<N>> positions_;
  Topology topology_;
  std::shared_ptr<const Sharpness> sharpness_;  ///< none in a mesh without tags
};

/// The refined mesh after `depth` steps.
template <class N>
RefinedMesh<N> refine(const data::ControlMesh& mesh, int depth, Weights weights = Weights::kLoop) {
  RefinedMesh<N> refined(mesh, weights);
  for (int step = 0; step < depth; ++step) refined.refine();
  return refined;
}

}  // namespace limitcheck::reference
