// SPDX-License-Identifier: MIT
// Names for the lattice points of a control mesh, the same from every face that touches a point.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {

/// All points with barycentric multiples of 1 / n, n = 2^depth, on all control faces, and the face centres;
/// shared points once. A point has an id:
///   0 .. V-1                   control vertices
///   then n-1 for each edge     by ascending (smaller vertex, larger vertex), counted from the smaller vertex
///   then (n-1)(n-2)/2 + 1      for each face: its interior lattice points row by row in l2, then its
///                              centre (1/3, 1/3)
/// The adjacency is its own, because it must not depend on anything that it helps to judge.
class Lattice {
 public:
  using Id = std::int64_t;
  static constexpr Id kNone = -1;

  struct Edge {
    std::int32_t a, b;                 // control vertices, a < b
    std::array<std::int32_t, 2> face;  // the faces on both sides; -1 beyond the boundary
    std::array<std::int8_t, 2>
        corner;  // the side of each face that it is, by the corner at which the side begins

    bool on_boundary() const { return face[1] < 0; }
  };

  /// l1 = i / scale(), l2 = j / scale(): fine enough for every lattice point, the centre included.
  using Coordinates = FaceDomain::Point;

  /// `mesh` must be valid (data/validate.h) and outlive this. 0 <= depth <= 15.
  Lattice(const data::ControlMesh& mesh, int depth);

  const data::ControlMesh& mesh() const { return mesh_; }
  int depth() const { return depth_; }
  std::int64_t n() const { return n_; }
  std::int64_t scale() const { return domain_.centre_denominator() * n_; }
  Id size() const { return first_interior_ + face_points_ * face_count(); }
  std::int32_t face_count() const { return static_cast<std::int32_t>(mesh_.faces.size()); }
  FaceDomain domain(std::int32_t /*face*/) const { return domain_; }

  const std::vector<Edge>& edges() const { return edges_; }
  /// The edge along side k of the face.
  const Edge& edge(std::int32_t face, int k) const { return edges_[face_edges_[face][k]]; }
  /// The face beyond side k, or -1 at the boundary.
  std::int32_t across(std::int32_t face, int k) const {
    const Edge& e = edge(face, k);
    return e.face[0] == face && e.corner[0] == k ? e.face[1] : e.face[0];
  }
  /// The control vertex at corner k.
  std::int32_t vertex(std::int32_t face, int k) const { return triangles_of(mesh_)[face][k]; }
  /// The corner of the face at a control vertex, if it is one.
  std::optional<int> corner_of(std::int32_t face, Id vertex) const;
  /// The corners of all faces, numbered through.
  std::int32_t corner_count() const { return domain_.corners() * face_count(); }
  std::int32_t corner_number(std::int32_t face, int k) const { return domain_.corners() * face + k; }

  /// The id of a point given by a face and a fraction, or kNone if it is no lattice point.
  Id id(const lc_provenance& p) const;
  /// A face and fraction of the point, reduced; on shared points always that of the same face.
  lc_provenance provenance(Id id) const;
  /// Where the point lies in `face`, or nothing if the face does not touch it.
  std::optional<Coordinates> in_face(Id id, std::int32_t face) const;

  bool is_vertex(Id id) const { return id < static_cast<Id>(mesh_.positions.size()); }
  /// A control vertex or a point on a control edge.
  bool is_shared(Id id) const { return id < first_interior_; }
  bool is_centre(Id id) const { return !is_shared(id) && (id - first_interior_ + 1) % face_points_ == 0; }

 private:
  const data::ControlMesh& mesh_;
  FaceDomain domain_;
  int depth_;
  std::int64_t n_;
  Id first_edge_, first_interior_ = 0, face_points_ = 0;
  std::vector<Edge> edges_;
  std::vector<std::array<std::int32_t, 3>> face_edges_;
  std::vector<std::int32_t> vertex_face_;  // one face at each vertex
  std::vector<std::int64_t> row_start_;    // of a face's inner points with l2 = j / n
};

/// "3/8", "0", "1".
std::string fraction(std::uint64_t numerator, std::uint64_t denominator);

}  // namespace limitcheck::verify
