// SPDX-License-Identifier: MIT
// A control mesh as the kernels read it: triangles (Loop) or quads (Catmull-Clark), with infinitely sharp edges cut.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "fast/mesh/adjacency.h"
#include "fast/mesh/sharpness.h"

namespace limitcheck::fast {

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
