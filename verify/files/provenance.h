// SPDX-License-Identifier: MIT
// A table of where the vertices of a tessellation file are meant to lie.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "verify/projection/domain.h"

namespace limitcheck::verify {

/// One row of the table.
struct ProvenanceRow {
  std::int64_t vertex = 0;  // in file order, from 0
  FacePoint at;
};

/// Comma-separated values: `vertex,face,l1,l2` or `vertex,face,i,j,denominator`, one row per vertex (any
/// order, not necessarily all of them); numbers as reference::Parameter::parse reads them ("3/32",
/// "0.09375"). A first row of words is a heading and names the order of the columns; empty lines and lines
/// that begin with # are read over. Throws data::InputError with the line: FILE_SYNTAX, or FILE_PROVENANCE
/// for a vertex or face that is not there, a parameter outside the triangle, or a vertex named twice.
std::vector<ProvenanceRow> parse_provenance(std::string_view content, const std::string& name,
                                            std::int64_t vertices, std::int64_t faces);
std::vector<ProvenanceRow> read_provenance(const std::filesystem::path& file, std::int64_t vertices,
                                           std::int64_t faces);

}  // namespace limitcheck::verify
