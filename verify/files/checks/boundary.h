// SPDX-License-Identifier: MIT
// Which open edges of a tessellation are the boundary of its control mesh, and which are cracks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "verify/files/checks/file_evidence.h"

namespace limitcheck::verify {

/// The open edges of a tessellation held against the boundary of its control mesh.
struct FileBoundary {
  std::vector<SurfaceReport::Edge> cracks;  // open edges that are no boundary, in the order of the report
  std::int64_t loops = 0;                   // closed walks along the boundary edges of the control mesh
  std::int64_t touching = 0;                // points in which faces touch between holes, in no edge
  bool seams = false;  // some of its boundary edges coincide, and so may the tessellation's
  std::string remark;  // a sentence, if the boundary is not that of the limit surface
};

/// A tessellation that is wrong in position still has a boundary: refined control points, for one, do not lie
/// on the limit's boundary curve. So its open edges are held against every curve that a subdivision program
/// makes of the control mesh's boundary, and the curve that explains most of them is taken:
///   the limit's boundary, by the closest points of the surface, of points that lie on it
///   the boundary polygon after 0, 1, 2 ... steps of the cubic B-spline's rule
///   the same where the corners of faces without neighbours stay in place (OpenSubdiv's EDGE_AND_CORNER), and
///   its limit points
/// An open edge is explained if both ends lie within the tolerance of what the curve makes of one boundary
/// edge of the control mesh. Where no curve explains half of the open edges, most of whose ends are off the
/// surface, only the number of loops is compared: if it is the control mesh's, there are no cracks.
///   report   of the triangles between merged points; O(n log n) in the number of its open edges
FileBoundary compare_boundary(const FileEvidence& e, const SurfaceReport& report);

}  // namespace limitcheck::verify
