// SPDX-License-Identifier: MIT
// Auditing a finished tessellation: a control mesh, a file of triangles, and no program.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "verify/files/checks/file_evidence.h"
#include "verify/row/result.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {

struct FilesOptions {
  double tolerance = 1e-6;               // of positions, in diagonals of the control mesh's bounding box
  std::optional<double> hausdorff;       // likewise, of the two-sided distance; without: what one polygon per
                                         // face has, and the tolerance
  bool measures_hausdorff = true;        // otherwise the row is not run
  bool needs_normals = false;            // a file without normals is a finding
  std::optional<data::Scheme> scheme{};  // of the control mesh; without: the one that it is meant for
  Fit fit = Fit::kNone;
  std::size_t pieces = ClosestPoint::kPieces;  // of the search structure (closest_point.h)
};

/// What an audit of files found.
struct FilesAudit {
  std::vector<Result> results;
  std::vector<std::string> notes;  // sentences for people: what the file is, what it looks like
  bool gave_up = false;            // an interrupt (interrupt.h) left rows out: they are not run
  VertexErrors errors;             // nothing if it gave up
  std::string per_vertex;  // CSV: vertex, distance in diagonals, normal angle in degrees, face, l1, l2; of
                           // Catmull-Clark's scheme face, corner, u, v
};

/// Rows: file-finite, file-unused, file-distance (or file-positions, with a provenance), file-normals,
/// file-normal-length, file-orientation, file-coverage, file-degenerate, file-watertight, file-hausdorff; and
/// file-recognised, where the vertices are something else (checks/diagnosis.h).
/// `control` is valid for the scheme (data/validate.h); the tessellation is fitted first if asked. Quads and
/// larger polygons of the file are the triangles that tessellation_file.h cuts them into.
FilesAudit audit_files(
    const std::string& control_name, const data::ControlMesh& control, FileTessellation tessellation,
    const std::vector<ProvenanceRow>& provenance, const FilesOptions& options,
    const std::function<void(const std::string& what, std::size_t done, std::size_t total)>& step);

}  // namespace limitcheck::verify
