// SPDX-License-Identifier: MIT
// All that subdivide: the paper's recursive subdivider, uniform refinement of a whole mesh, and surface points without
// eigenvalues, which share nothing with stam.h but masks and basis.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "data/faces.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/mesh/topology.h"
#include "reference/number/vec3.h"
#include "reference/point/parameter.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference {
class Sharpness;
}

namespace limitcheck::reference::catmull_clark {

template <class N>
struct QuadMesh;

/// Counter-clockwise like its control face.
template <class N>
using LeafQuad = std::array<LeafCorner<N>, 4>;

/// The recursive subdivider of section 4 with Catmull-Clark's rules: every quad by itself, four sub-quads down
/// to the depth, limit point and normal at the leaves. Most points are computed several times; that is its
/// point. Near semi-sharp tags a quad is refined together with its neighbours, until they are gone. [C18, C21]
/// Built for double, Decimal50, Decimal100.
template <class N>
class NaiveSubdivider {
 public:
  /// Throws data::ArgumentError if the mesh is not manifold (Topology) or the tags do not fit (Sharpness).
  NaiveSubdivider(data::Faces faces, std::vector<Vec3<N>> positions, const SharpTags& tags = {});

  std::size_t face_count() const;

  /// Subdivides a quad (corner 0), or the sub-quad at a corner of another face, and hands its leaves to
  /// `emit`, depth first. A quad has 4^depth of them, 2^depth + 1 lattice points a side; a sub-quad is itself
  /// the result of a step and is subdivided once less. Any number of threads may do so at once.
  ///   throws   data::ArgumentError: no such face or corner, depth < 0 or > 30, a face that is no quad at
  ///            depth 0
  void tessellate(std::size_t face, std::size_t corner, int depth,
                  const std::function<void(const LeafQuad<N>&)>& emit) const;

 private:
  std::shared_ptr<const QuadMesh<N>> mesh_;
};

/// A mesh of polygons after `depth` steps, the textbook way: every point once. A quad has the lattice points
/// (i, j), 0 <= i, j <= 2^depth, u = i / 2^depth and v = j / 2^depth. From one step on each corner of another face
/// has a sub-quad of its own with 0 <= i, j <= 2^(depth-1). Vertices shared by faces appear once; the control
/// vertices come first, in their order.
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
  VertexLimits<N> limits() const;

 private:
  data::Faces given_;
  int depth_ = 0;
  Topology topology_;
  std::vector<Vec3<N>> positions_;
  std::shared_ptr<const Sharpness> sharpness_;  ///< none in a mesh without tags
  data::TriangleRule triangles_;
};

/// Subdivides the quad that holds the point and its neighbourhood, always into the sub-quad with the point,
/// until that is regular (a bicubic patch) or the point is its corner (limit masks). The number of steps
/// grows with -log2 of the distance to the extraordinary vertex, and so does the rounding error of its
/// derivatives. Built for double, Decimal50, Decimal100, and Rational: there exact at every valence, but
/// without normals and without tangents at extraordinary corners.       [the paper's ref. 1]
///   threads   any number may evaluate at once
template <class N>
class SubdivisionEvaluator {
 public:
  /// Throws data::ArgumentError if the mesh is not manifold (Topology) or the tags do not fit (Sharpness).
  SubdivisionEvaluator(data::Faces faces, std::vector<Vec3<N>> positions, const SharpTags& tags = {});

  int face_count() const;
  /// At (u, v) of a quad, whose corners are (0, 0), (1, 0), (1, 1), (0, 1), with `corner` 0; at (u, v) of the
  /// sub-quad at `corner` of any other face, which is split into one quad for each corner: (0, 0) at the
  /// corner, (1, 0) in the middle of the edge to the next. d1 and d2 are the derivatives by u and v.
  /// Parameters are followed exactly.
  ///   throws   data::ArgumentError: no such face or corner, u or v outside 0 .. 1
  SurfacePoint<N> evaluate(int face, int corner, const Parameter& u, const Parameter& v,
                           Derivatives order = Derivatives::kSecond) const;

 private:
  std::shared_ptr<const QuadMesh<N>> mesh_;
};

}  // namespace limitcheck::reference::catmull_clark
