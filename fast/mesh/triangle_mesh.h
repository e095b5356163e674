// SPDX-License-Identifier: MIT
// A control mesh of Loop's scheme as the kernels read it: triangles, with infinitely sharp edges cut.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "fast/mesh/adjacency.h"
#include "fast/mesh/vertex_kind.h"

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

}  // namespace limitcheck::fast
