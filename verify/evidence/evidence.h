// SPDX-License-Identifier: MIT
// What the checks look at: one tessellation of one control mesh by one subject, and the truth about it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "verify/evidence/lattice.h"
#include "verify/evidence/reference_surface.h"
#include "verify/host/host.h"
#include "verify/row/result.h"

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
  Result result(std::string check) const;
  /// The witness for a vertex: where it lies by its provenance.
  Witness at_vertex(std::int64_t vertex) const;
  /// The same as the side of a use names it, if the point has several.
  Witness at_use(const Use& use) const;
  /// How far a normal on a side that has one may be from the exact one, in degrees: normal_bound, or more
  /// where the surface is ill-conditioned (bounds.h).
  double normal_bound_at(Sides::Id side) const;
  /// The witness for a lattice point, and for a point of a face.
  Witness at_point(Lattice::Id id) const;
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
bool is_finite(const Tessellation& tessellation, std::int64_t vertex);
/// How many vertices are not.
std::int64_t not_finite(const Tessellation& tessellation);

/// Ids of all vertices of a tessellation, in parallel.
std::vector<Lattice::Id> locate(const Tessellation& tessellation, const Lattice& lattice);
/// The sides of all vertices: those of the triangles that they are corners of; of a vertex of no triangle,
/// that of the face it names.
///   point   of each vertex
std::vector<Use> find_uses(const Tessellation& tessellation, const std::vector<Lattice::Id>& point,
                           const Lattice& lattice, const Sides& sides);

}  // namespace limitcheck::verify
