// SPDX-License-Identifier: MIT
// A table of where the vertices of a tessellation file are meant to lie.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "verify/projection/domain.h"

namespace limitcheck::verify {

/// One row of the table.
struct ProvenanceRow {
  std::int64_t vertex = 0;  // in file order, from 0
  FacePoint at;             // a control face, and the coordinates of a triangle or of a square
  int corner = -1;          // of a face that is cut into quads, the one whose quad they are of
};

/// Comma-separated values: `vertex,face,l1,l2` or `vertex,face,i,j,denominator`, one row per vertex (any
/// order, not necessarily all of them); numbers as reference::Parameter::parse reads them ("3/32",
/// "0.09375"). A first row of words is a heading and names the order of the columns; empty lines and lines
/// that begin with # are read over. Throws data::InputError with the line: FILE_SYNTAX, or FILE_PROVENANCE
/// for a vertex or face that is not there, a parameter outside the triangle, or a vertex named twice.
/// Catmull-Clark's parameters u and v may be headed so, or l1 and l2; on a face that is no quad they are of the quad
/// at a corner, which a column `corner` names.
std::vector<ProvenanceRow> parse_provenance(std::string_view content, const std::string& name,
                                            std::int64_t vertices, const data::ControlMesh& control,
                                            data::Scheme scheme);
std::vector<ProvenanceRow> read_provenance(const std::filesystem::path& file, std::int64_t vertices,
                                           const data::ControlMesh& control, data::Scheme scheme);

}  // namespace limitcheck::verify
