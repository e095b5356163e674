// SPDX-License-Identifier: MIT
// The report of an audit as one page that opens from the disk, with everything inside it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "verify/causes/causes.h"
#include "verify/evidence/audit_case.h"
#include "verify/row/result.h"

namespace limitcheck::verify {

/// A tessellation, or the part of it round a witness, with the error of each vertex.
struct ErrorShape {
  std::vector<float> positions;          // three for each vertex
  std::vector<std::uint8_t> values;      // of each vertex: 0 within the bound, 1 .. beyond it, one for each
                                         // power of ten; 255 not finite
  std::vector<std::uint32_t> triangles;  // three vertices each
  std::array<float, 3> witness{};
  std::string note;  // what the values are of
};

/// The tessellation that a row is about, at most kMostTriangles of it, those nearest to the witness. Nothing
/// if the row names no point, or the subject fails.
inline constexpr std::size_t kMostTriangles = 3000;
std::optional<ErrorShape> error_shape(const AuditSubject& subject, const AuditMesh& mesh, const Result& row,
                                      int threads);

/// The page: overview, causes with their shapes (one for each cause, or none), histogram of errors.
std::string to_html(const Report& report, const std::vector<Cause>& causes,
                    const std::vector<std::optional<ErrorShape>>& shapes, const std::string& level);

/// html/page.html, with %DATA% where the report goes.
extern const char* const kHtmlPage;

}  // namespace limitcheck::verify
