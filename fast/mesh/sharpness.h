// SPDX-License-Identifier: MIT
// Sharp edges and vertices: the tags of polygons and Catmull and Clark's step for them, and infinitely sharp edges
// made boundaries, which leaves the surface of either scheme the same, exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "fast/mesh/adjacency.h"

namespace limitcheck::fast {

/// A vertex with its ring of n faces as BasicAdjacency has it: e_0 .. e_{n-1} the neighbours along edges, and
/// e_n at an open one.
enum class VertexKind : std::uint8_t {
  kPlain,  // inside: the smooth rule; on a boundary or cut: the curve rule, from its first and last neighbour
  kHeld,   // it stays where it is
  kDart    // a cut ends here: on the boundary, n faces, first and last neighbour the same point. The vertex
           // follows the smooth rule of valence n, e_0 counted once; e_0 itself is the end of a curve. Limit
           // and tangents are not those of a smooth vertex.
};

/// The kind of each vertex, or nothing: all are plain. It refers to the list.
class VertexKinds {
 public:
  VertexKinds() = default;
  VertexKinds(std::span<const VertexKind> kinds) : kinds_(kinds) {}  // NOLINT: converts
  VertexKind operator[](std::int32_t v) const {
    return kinds_.empty() ? VertexKind::kPlain : kinds_[static_cast<std::size_t>(v)];
  }

 private:
  std::span<const VertexKind> kinds_;
};

/// The sharpness of what no step makes smooth.
inline constexpr double kAlwaysSharp = std::numeric_limits<double>::infinity();
inline bool is_semi_sharp(double s) {
  return s > 0 && s < kAlwaysSharp;
}

/// The rule of a vertex of this sharpness at which so many edges are sharp.
enum class VertexRule { kSmooth, kCrease, kHeld };
inline VertexRule rule_of(double vertex, int sharp_edges) {
  if (vertex > 0 || sharp_edges > 2) return VertexRule::kHeld;
  return sharp_edges == 2 ? VertexRule::kCrease : VertexRule::kSmooth;
}

/// What one step makes of the sharpness of an edge, seen from one of its ends, or of a vertex. [DeRose 1998]
///   sum, count   of the sharpness of all edges at that end which are sharp, but not for ever: for Chaikin's
///                way alone
double softened(double sharpness, double sum, int count, data::Creasing creasing);

/// Polygons whose tags lie where they are used.
///   side     per corner, faces one after the other: the sharpness of the side from it to the next corner; 0
///            smooth, kAlwaysSharp on the boundary and from data::kInfiniteSharpness on. Both faces of a side
///            say the same.
///   vertex   likewise; kAlwaysSharp also where the mesh's boundary option holds a vertex of one face
struct SharpPolygons {
  std::vector<std::array<double, 3>> positions;
  data::Faces faces;
  std::vector<double> side, vertex;
  data::Creasing creasing = data::Creasing::kUniform;
  data::TriangleRule triangles = data::TriangleRule::kCatmark;

  /// Throws data::ArgumentError: a mesh that data::validate refuses for the scheme; what it says.
  static SharpPolygons of(const data::ControlMesh& mesh, data::Scheme scheme = data::Scheme::kCatmullClark);

  /// One step, in double: quad c lies at corner c of all corners, as (V, E, F, E'): the vertex, the middle of
  /// the side from it, the middle of the face, the middle of the side to it. Vertices: the old ones, then
  /// those of edges, then those of faces.
  SharpPolygons step() const;
};

/// What became of a mesh.
struct SharpCut {
  std::vector<std::int32_t> twin;   // per half-edge: its twin before the cut, -1 elsewhere; or empty: no cut
  std::vector<std::int32_t> uncut;  // per vertex: the one that it is a copy of, or itself
  std::vector<VertexKind> kinds;    // per vertex
};

/// Cuts along all edges that are always sharp: each side has a copy of their points. A vertex that is always
/// sharp, or has three sharp edges and more, is held in each of its sectors; one with a single sharp edge is
/// a dart.
///   sharp   of the same faces, in the same order
template <int K>
SharpCut cut_sharp(BasicAdjacency<K>& adjacency, const SharpPolygons& sharp);

/// Of triangles.
extern template SharpCut cut_sharp(BasicAdjacency<3>&, const SharpPolygons&);
/// Of quads.
extern template SharpCut cut_sharp(BasicAdjacency<4>&, const SharpPolygons&);

}  // namespace limitcheck::fast
