// SPDX-License-Identifier: MIT
// Names for the lattice points of a control mesh, the same from every face that touches a point; and for the sides of
// edges that stay sharp, which a point is seen from where its faces have different normals.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {

/// The vertices of the control mesh refined `depth` times, n = 2^depth steps to a control edge, and the
/// centres of the faces; shared points once. A point has an id:
///   0 .. V-1                   control vertices
///   then n-1 for each edge     by ascending (smaller vertex, larger vertex), counted from the smaller vertex
///   then, face after face      the lattice points inside it (FaceDomain::inner_number), then its centre if
///                              that is none of them
///   then                       the other points that it was made with, those on edges first
/// The adjacency is its own, because it must not depend on anything that it helps to judge.
class Lattice {
 public:
  using Id = std::int64_t;
  static constexpr Id kNone = -1;

  struct Edge {
    std::int32_t a, b;                   // control vertices, a < b
    std::array<std::int32_t, 2> face;    // the faces on both sides; -1 beyond the boundary
    std::array<std::int32_t, 2> corner;  // the side of each face that it is: the corner where it begins

    bool on_boundary() const { return face[1] < 0; }
  };

  /// Points of a face over scale() steps to a side: fine enough for every lattice point, the centre included.
  using Coordinates = FaceDomain::Point;

  /// `mesh` must be valid for the scheme (data/validate.h) and outlive this. 0 <= depth <= 15.
  ///   others   points that have ids, too, though they may be off the lattice; those that lie in no face, or whose
  ///            denominators have no common multiple below 2^32 with the ones before, are passed over
  Lattice(const data::ControlMesh& mesh, data::Scheme scheme, int depth, std::span<const Place> others = {});
  /// Of the scheme that the mesh is meant for.
  Lattice(const data::ControlMesh& mesh, int depth) : Lattice(mesh, data::natural_scheme(mesh), depth) {}

  const data::ControlMesh& mesh() const { return mesh_; }
  data::Scheme scheme() const { return scheme_; }
  int depth() const { return depth_; }
  std::int64_t n() const { return n_; }
  std::int64_t scale() const { return scale_; }
  Id size() const { return first_other_ + std::ssize(others_); }
  std::int32_t face_count() const { return static_cast<std::int32_t>(mesh_.faces.size()); }
  FaceDomain domain(std::int32_t face) const { return {scheme_, static_cast<int>(mesh_.faces[face].size())}; }

  const std::vector<Edge>& edges() const { return edges_; }
  /// The first of the n - 1 points on an edge, whose ids follow one another from its smaller vertex on.
  Id first_on_edge(std::size_t edge) const { return first_edge_ + (n_ - 1) * static_cast<Id>(edge); }
  /// The edge along side k of the face.
  const Edge& edge(std::int32_t face, int k) const { return edges_[corner_edge_[corner_number(face, k)]]; }
  /// The face beyond side k, or -1 at the boundary.
  std::int32_t across(std::int32_t face, int k) const {
    const Edge& e = edge(face, k);
    return e.face[0] == face && e.corner[0] == k ? e.face[1] : e.face[0];
  }
  /// The control vertex at corner k.
  std::int32_t vertex(std::int32_t face, int k) const { return mesh_.faces[face][k]; }
  /// The corner of the face at a control vertex, if it is one.
  std::optional<int> corner_of(std::int32_t face, Id vertex) const;
  /// The corners of all faces, numbered through.
  std::int32_t corner_count() const { return static_cast<std::int32_t>(mesh_.faces.corners().size()); }
  std::int32_t corner_number(std::int32_t face, int k) const {
    return static_cast<std::int32_t>(mesh_.faces.first_corner(face)) + k;
  }

  /// The id of a point given by a face and a fraction, or kNone if it is no lattice point.
  Id id(const Place& p) const;
  /// The same from a number of steps to a side.
  Id id(std::int32_t face, FaceDomain::Point p, std::int64_t steps) const;
  /// A face and fraction of the point, reduced; on shared points always that of the same face.
  Place place(Id id) const;
  /// Where the point lies in `face`, or nothing if the face does not touch it.
  std::optional<Coordinates> in_face(Id id, std::int32_t face) const;
  /// A face and a fraction of a point given by coordinates.
  Place place(std::int32_t face, Coordinates at) const;

  bool is_vertex(Id id) const { return id < first_edge_; }
  /// The edge on which a shared point that is no vertex lies.
  std::size_t edge_of(Id id) const {
    return is_on_lattice(id) ? static_cast<std::size_t>((id - first_edge_) / (n_ - 1))
                             : static_cast<std::size_t>(others_[id - first_other_].of);
  }
  /// A control vertex or a point on a control edge.
  bool is_shared(Id id) const {
    return is_on_lattice(id) ? id < first_inner_.front() : !others_[id - first_other_].inside;
  }
  /// Whether it is a lattice point, or the centre of a face. The others on edges have the ids from first_other() on,
  /// those of an edge one after the other.
  bool is_on_lattice(Id id) const { return id < first_other_; }
  Id first_other() const { return first_other_; }
  /// The centre of a face of which no refined vertex lies there.
  bool is_bare_centre(Id id) const;

 private:
  // A point off the lattice, inside a face or on an edge, i steps of scale() from its smaller vertex; in the order of
  // their ids.
  struct Other {
    bool inside;
    std::int32_t of, part;  // the face or the edge, and the part of the face
    std::int64_t i, j;
    auto operator<=>(const Other&) const = default;
  };
  std::int32_t face_of_inner(Id id) const;
  void list_corners_of_vertices();
  void add_others(std::span<const Place> others);
  // The name of a point among the others; the point at the scale, unless that is too coarse for it.
  Other named(std::int32_t face, Coordinates at) const;
  std::optional<Coordinates> at_scale(std::int32_t face, FaceDomain::Point p, std::int64_t steps) const;
  Id id_of_other(std::int32_t face, FaceDomain::Point p, std::int64_t steps) const;

  const data::ControlMesh& mesh_;
  data::Scheme scheme_;
  int depth_;
  std::int64_t n_, scale_;
  Id first_edge_, first_other_ = 0;
  std::vector<Id> first_inner_;  // of each face, and of one more
  std::vector<Edge> edges_;
  std::vector<std::int32_t> corner_edge_;  // the edge along the side that begins at each corner
  std::vector<std::int32_t> vertex_face_;  // one face at each vertex
  std::vector<Other> others_;
  // The numbers of the corners at each vertex, ascending, from first_at_vertex_ on.
  std::vector<std::int32_t> first_at_vertex_, vertex_corners_;
};

/// For each corner of a face (Lattice::corner_number) the fan at its vertex that it is in: 0, 1, 2 .. by their lowest
/// faces. Corners of two faces are in one fan where these meet in an edge that `joins` is true of; those of faces that
/// `counts` is not true of are in no fan that is numbered, and are 0.
std::vector<std::int32_t> fans_of_corners(const Lattice& lattice,
                                          const std::function<bool(const Lattice::Edge&)>& joins,
                                          const std::function<bool(std::int32_t)>& counts);

/// "3/8", "0", "1".
std::string fraction(std::uint64_t numerator, std::uint64_t denominator);

/// On an edge that stays sharp (data/sharpness.h) the surface has one position and a normal for each side; at
/// a vertex, one for each of the sectors into which two and more such edges and the boundary part its faces.
/// A side has an id: that of the point where there is one side, and for the side of the face by which the
/// lattice names the point; the others get the ids from the lattice's size on.
class Sides {
 public:
  using Id = Lattice::Id;

  /// `lattice` outlives this.                                            O(faces) if an edge stays sharp
  explicit Sides(const Lattice& lattice);

  Id size() const { return lattice_.size() + static_cast<Id>(others_.size()); }
  /// Whether all points have one side.
  bool none() const { return others_.empty(); }

  bool several(Lattice::Id point) const { return first_other(point) >= 0; }
  /// The side of a face that touches the point.
  Id of(Lattice::Id point, std::int32_t face) const;
  /// Where a side lies, as one of its faces names it.
  Place place(Id side) const;
  Lattice::Id point(Id side) const {
    return side < lattice_.size() ? side : others_[side - lattice_.size()].point;
  }
  /// All sides of a point.
  template <class Visit>
  void for_each(Lattice::Id point, Visit visit) const {
    visit(point);
    const Id first = first_other(point);
    for (Id side = first; first >= 0 && side < size() && this->point(side) == point; ++side) visit(side);
  }

 private:
  struct Other {
    Lattice::Id point;
    std::int32_t face;
  };

  // The first of the other sides of a point, or -1.
  Id first_other(Lattice::Id point) const;

  const Lattice& lattice_;
  std::vector<Other> others_;  // of points on edges, then of vertices, each ascending
  std::ptrdiff_t first_of_vertices_ = 0;
  std::vector<std::int32_t> sector_;  // of each corner of a face, at its vertex: 0, 1 ..
};

}  // namespace limitcheck::verify
