// SPDX-License-Identifier: MIT
// What is sharp, and the control mesh as the kernels read it: triangles (Loop) or quads (Catmull-Clark), with
// infinitely sharp edges cut.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
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

/// Infinitely sharp edges are boundaries, with a copy of their points for either side: the surface is the
/// same, exactly. Keeps a reference to the mesh, which must outlive it.
class TriangleMesh {
 public:
  /// Throws data::ArgumentError: what Adjacency refuses and, of meshes that have tags, what data::validate
  /// refuses, and semi-sharp edges and vertices.
  explicit TriangleMesh(const data::ControlMesh& mesh);
  TriangleMesh(data::ControlMesh&&) = delete;
  TriangleMesh(const TriangleMesh&) = delete;
  TriangleMesh& operator=(const TriangleMesh&) = delete;

  /// The control mesh with a position for each vertex of the adjacency; its faces are those before the cut.
  const data::ControlMesh& points() const { return with_copies_ ? *with_copies_ : *mesh_; }
  /// Takes over the positions of the mesh, which have changed.
  void points_moved();

  const Adjacency& adjacency() const { return adjacency_; }
  VertexKinds kinds() const { return std::span(kinds_); }
  /// Whether there are sharp edges inside the surface, along which it is cut.
  bool is_cut() const { return with_copies_.has_value(); }
  bool is_cut(std::int32_t h) const { return !cut_twin_.empty() && cut_twin_[h] >= 0; }
  /// The vertex that this one is a copy of, or itself.
  std::int32_t uncut(std::int32_t v) const { return with_copies_ ? uncut_[v] : v; }
  /// The face on the other side of a cut or an ordinary edge; -1 at the boundary of the control mesh.
  std::int32_t across(std::int32_t h) const {
    const std::int32_t twin =
        adjacency_.twin(h) >= 0 || cut_twin_.empty() ? adjacency_.twin(h) : cut_twin_[h];
    return twin < 0 ? -1 : Adjacency::face(twin);
  }

 private:
  const data::ControlMesh* mesh_;
  Adjacency adjacency_;
  std::optional<data::ControlMesh> with_copies_;
  std::vector<std::int32_t> cut_twin_, uncut_;
  std::vector<VertexKind> kinds_;
};

/// The mesh of quads that is the control mesh (steps = 0) or, if that has a face that is no quad, the control
/// mesh after one step (steps = 1), of which quad q lies at corner q of all corners of the control faces: its
/// own corner 0 at the control vertex, 1 in the middle of the side from it, 2 in the middle of the face, 3 in
/// the middle of the side to it. A grid of depth d on a control face is one of depth d - 1 on its quads.
///
/// Infinitely sharp edges are boundaries, with a copy of their points for either side: the surface is the
/// same, exactly. Semi-sharp edges and vertices are as they were, and stay to be dealt with.
struct QuadMesh {
  /// Throws data::ArgumentError: what QuadAdjacency refuses and, of meshes that have tags or other faces than
  /// quads, what data::validate refuses.
  explicit QuadMesh(const data::ControlMesh& mesh);

  /// The quad on the other side of a cut or an ordinary edge; -1 at the boundary of the control mesh.
  std::int32_t across(std::int32_t h) const {
    const std::int32_t twin = adjacency.twin(h) >= 0 || cut_twin.empty() ? adjacency.twin(h) : cut_twin[h];
    return twin < 0 ? -1 : twin / 4;
  }
  VertexKind kind(std::int32_t v) const { return kinds.empty() ? VertexKind::kPlain : kinds[v]; }
  bool semi_sharp() const { return !side_sharpness.empty(); }

  int steps = 0;
  std::vector<std::array<double, 3>> positions;  // of all vertices of the adjacency
  QuadAdjacency adjacency;
  std::vector<std::int32_t> cut_twin;  // per half-edge: its twin before the cut, -1 elsewhere; or empty
  std::vector<std::int32_t> uncut;     // per vertex: the one that it is a copy of, or itself; or empty
  std::vector<VertexKind> kinds;       // per vertex, or empty: all plain
  /// What is semi-sharp: per half-edge and per vertex, 0 elsewhere; both empty if nothing is.
  std::vector<double> side_sharpness, vertex_sharpness;
  data::Creasing creasing = data::Creasing::kUniform;

 private:
  QuadMesh(const data::ControlMesh& mesh, const std::optional<SharpPolygons>& sharp);
};

}  // namespace limitcheck::fast
