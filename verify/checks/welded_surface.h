// SPDX-License-Identifier: MIT
// The triangles of a tessellation as one surface: which vertices are one point, which boundary it must have.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "verify/evidence/evidence.h"

namespace limitcheck::verify {

/// Vertices are one point if they name the same lattice point and have equal positions, so that one ulp
/// between them is a crack. Equal positions alone are not enough: two boundaries of a control mesh may lie in
/// one place (the seam of a texture), a vertex of one part may lie on another part, a control triangle may
/// have no area; what is apart in the control mesh stays apart.
///   point_of   for each vertex the number of its point; -1: neither its position nor its provenance can be
///              used
///   vertex_of  for each point its first vertex
/// A vertex that is not finite goes with the others of its lattice point: only the check `finite` reports it.
/// One that names no lattice point goes with those in its place.
struct Welded {
  std::vector<std::int32_t> point_of, vertex_of;
};
Welded weld(const Evidence& e);

/// The control edges with one visible face. Faces that meet in a control vertex only, because those between
/// them are culled, are no fault: such a vertex counts once for each fan of visible faces.
class Outline {
 public:
  /// The evidence's lattice outlives this.
  explicit Outline(const Evidence& e);

  /// One visible face along one control edge, in the direction in which the face runs along it. The depth of
  /// the side is at least that of the face and at most that of the deepest visible neighbour; of a subject that
  /// delivers points anywhere it is 0, and the steps are those between the points delivered there.
  struct Side {
    std::int32_t face;
    int corner;  // the side begins here
    int least, most;
  };
  const std::vector<Side>& sides() const { return sides_; }

  /// All steps a side may take: sorted by from, to.
  struct Step {
    Lattice::Id from, to;
    std::int32_t side;
    int depth;
  };
  const std::vector<Step>& steps() const { return steps_; }

  /// Closed walks along the sides.
  std::int64_t loops() const { return loops_; }

  /// Which fan round its corner k a visible face belongs to: 0, or 1, 2 .. if culled faces part them.
  int fan(std::int32_t face, int k) const { return fan_[lattice_.corner_number(face, k)]; }

 private:
  void count_loops();

  const Lattice& lattice_;
  std::vector<Side> sides_;
  std::vector<Step> steps_;
  std::int64_t loops_ = 0;
  std::vector<std::int32_t> fan_;  // of each corner of a face
};

/// Triangles of points, and the triangle of the tessellation that each is, or is part of.
struct OriginOfTriangles {
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> origin;
  std::int64_t points = 0;
};

/// At depth 0 a face of four corners and more is cut along diagonals, and another edge of the mesh, or
/// another face's diagonal, may join the same two vertices: as a set of indices three triangles and more then
/// meet in one edge, though no surface does. Such a diagonal, which two triangles of its face have in
/// opposite directions, gets a point of its own in its middle; all else stays as it is.
///   triangles   three points for each triangle of the tessellation, 0 .. points - 1, or -1
OriginOfTriangles tell_diagonals_apart(const Evidence& e, std::vector<std::array<std::int32_t, 3>> triangles,
                                       std::int64_t points);

}  // namespace limitcheck::verify
