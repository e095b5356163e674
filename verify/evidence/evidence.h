// SPDX-License-Identifier: MIT
// What the checks look at: one tessellation of one control mesh by one subject, and the truth about it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "verify/evidence/audit_case.h"
#include "verify/evidence/reference_surface.h"
#include "verify/host/host.h"
#include "verify/row/result.h"
#include "verify/subject/lattice.h"

namespace limitcheck::verify {

/// A vertex as a corner of the triangles on one side of its point.
struct Use {
  std::int64_t vertex;
  Sides::Id side;  // kNone: no lattice point
};

/// All references outlive the evidence. Read-only, shared by checks that may run at the same time.
struct Evidence {
  std::string subject, mesh_name;
  const lc_capabilities& capabilities;
  const data::ControlMesh& mesh;             // rounded to the subject's precision
  std::span<const std::int32_t> face_depth;  // as requested; -1 is culled
  const Tessellation& tessellation;
  const Lattice& lattice;             // of the largest depth requested
  const ReferenceSurface& reference;  // evaluated at every point named below
  std::vector<Lattice::Id> point;     // of each vertex, by its provenance; kNone: no lattice point
  std::vector<Use> uses;              // in the order of the vertices, each with one side or more
  double diagonal = 0;                // of the bounding box of the control mesh, see unit_of_length()
  double magnitude = 0;               // largest absolute coordinate of the control mesh

  /// A result of this subject and mesh, held and with nothing in it.
  Result result(std::string_view check, std::string_view unit = {}, std::optional<double> bound = {}) const;
  /// The witness for a vertex: where it lies by its provenance.
  Witness at_vertex(std::int64_t vertex) const;
  /// The same as the side of a use names it, if the point has several.
  Witness at_use(const Use& use) const;
  /// How far a position may be from the exact one, in diagonals; of ordinary places, and at a point.
  double position_bound() const;
  double position_bound_at(Lattice::Id id) const;
  /// How far a normal on a side that has one may be from the exact one, in degrees: normal_bound, or more
  /// where the surface is ill-conditioned (bounds.h).
  double normal_bound_at(Sides::Id side) const;
  /// The witness for a lattice point, and for a point of a face.
  Witness at_point(Lattice::Id id) const { return at(lattice.place(id)); }
  Witness at(const Place& p) const;
  /// The lattice coordinates of the corners of a triangle in the face that it names; false if an index or the
  /// face is out of range, or a corner does not lie in that face. Where a part of the face
  /// has all three, they are named by it.
  bool place(std::int64_t triangle, std::array<Lattice::Coordinates, 3>& corners) const;
};

/// How deep each face may be displayed: the largest depth asked for it and, unless it is culled, its
/// neighbours.
std::vector<std::int32_t> deepest_near(const Evidence& e);

/// Position and, if there is one, normal of a vertex are neither NaN nor infinite.
inline bool is_finite(const Tessellation& t, std::int64_t vertex) {
  return is_finite(t.position(vertex)) && (!t.has_normals() || is_finite(t.normal(vertex)));
}
/// How many vertices are not.
std::int64_t not_finite(const Tessellation& tessellation);

/// Where the vertices of a subject lie that delivers points anywhere; empty for one of lattice points.
std::vector<Place> points_anywhere(const lc_capabilities& capabilities, const Tessellation& tessellation);
/// Ids of all vertices of a tessellation, in parallel.
std::vector<Lattice::Id> locate(const Tessellation& tessellation, const Lattice& lattice);
/// Fills in `places` of a row that is_bad; does nothing for others.
///   count   how many points were looked at
///   id      of each; kNone is skipped
///   state   1 wrong, 0 right, -1 not looked at
void count_places(Result& row, const Lattice& lattice, std::size_t count,
                  const std::function<Lattice::Id(std::size_t)>& id,
                  const std::function<int(std::size_t)>& state);

/// The depth of each face that a subject is asked for: of faces that are holes, or outside the sample, -1.
///   depth   of faces that have none of their own
std::vector<std::int32_t> asked_depths(const AuditMesh& mesh, int depth);

/// Asks for what `mesh.depths` asks for beforehand (evidence/audit_case.h), and throws the answers away. Throws as
/// Session::tessellate does.
///   deepest   depth that a face has in the request to come
void warm_up(Session& session, const AuditMesh& mesh, int deepest, int threads);

/// The evidence of what a session delivered. All but the first two outlive it; the truth may be prepared later.
///   judged   the session's mesh, or its part that is a sample; `asked`, `tessellation`, `truth` are of that
Evidence gather(const AuditSubject& subject, const AuditMesh& mesh, const Session& session,
                const data::ControlMesh& judged, std::span<const std::int32_t> asked,
                const Tessellation& tessellation, const ReferenceSurface& truth);

}  // namespace limitcheck::verify
