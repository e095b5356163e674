// SPDX-License-Identifier: MIT
// Uniform refinement of a whole mesh of polygons: the textbook way, every point once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "data/faces.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/mesh/topology.h"
#include "reference/number/vec3.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference {
class Sharpness;
}

namespace limitcheck::reference::catmull_clark {

/// A mesh after `depth` steps. A quad has the lattice points (i, j), 0 <= i, j <= 2^depth, u = i / 2^depth
/// and v = j / 2^depth. From one step on each corner of another face has a sub-quad of its own with 0 <= i, j
/// <= 2^(depth-1). Vertices shared by faces appear once; the control vertices come first, in their order.
/// Built for double, Decimal50, Decimal100 and, without limits(), Rational.
template <class N>
class RefinedMesh {
 public:
  /// Depth 0: the mesh itself. Throws data::ArgumentError if it is not manifold (Topology) or the tags do not
  /// fit (Sharpness).
  RefinedMesh(data::Faces faces, std::vector<Vec3<N>> positions, const SharpTags& tags = {});

  /// One more step. Exact in exact arithmetic; in double each coordinate is a convex combination rounded a
  /// few times.
  ///   throws   data::ArgumentError if the refined mesh would have more than 2^31 - 1 corners
  void refine();

  int depth() const { return depth_; }
  const std::vector<Vec3<N>>& positions() const { return positions_; }
  const Topology& topology() const { return topology_; }
  /// The vertex at (i, j) of a quad (corner 0) or of the sub-quad at a corner of another face.
  ///   throws   data::ArgumentError: no such face, corner or lattice point; a face that is no quad at depth 0
  std::int32_t vertex(std::size_t face, std::size_t corner, int i, int j) const;

  /// Limit positions and unit normals of all vertices; at depth 0 of a mesh with other faces than quads, too.
  /// Of a vertex on a sharp edge, which has a normal for each side, that of the first face in its ring.
  struct Limits {
    std::vector<Vec3<N>> positions, normals;
    std::vector<NormalKind> kinds;
  };
  Limits limits() const;

 private:
  data::Faces given_;
  int depth_ = 0;
  Topology topology_;
  std::vector<Vec3<N>> positions_;
  std::shared_ptr<const Sharpness> sharpness_;  ///< none in a mesh without tags
  data::TriangleRule triangles_;
};

}  // namespace limitcheck::reference::catmull_clark
