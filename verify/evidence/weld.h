// SPDX-License-Identifier: MIT
// Which vertices of a tessellation are one point of the surface.
#pragma once

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

/// Boundary edges of the control mesh whose two ends lie where those of another one do: the two sides of
/// seams.
std::int64_t coincident_boundary_edges(const Evidence& e);

/// Control faces whose area vector vanishes: triangles whose corners lie on a line.
std::int64_t faces_without_area(const Evidence& e);

}  // namespace limitcheck::verify
