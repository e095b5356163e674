// SPDX-License-Identifier: MIT
// The table of the rows of an audit: what each means, and what a finding in it is put to.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace limitcheck::verify {

/// What a finding shows.
enum class CauseKind : std::uint8_t {
  kBreakdown,  // the subject crashed, hung or failed
  kRefuses,    // it refused a valid mesh
  kUnwritten,  // arrays are too short, overrun or not filled in
  kNotFinite,  // NaN, infinity, or a normal without length
  kSurface,    // points or normals are not those of the surface
  kTiling,     // faces are not tiled once, or face the wrong way
  kSeams,      // what faces that meet deliver at common points is not the same
  kOrder,      // the answer depends on what it must not depend on: order, position, size, an earlier request
  kAccepts,    // a broken mesh is taken
  kOther       // any other row, the check's name says which
};

/// "not-finite": stable.
std::string_view word(CauseKind kind);

/// A row of the audit: what it means, what it allows, and where that comes from.
struct RowKind {
  std::string_view check;
  std::string_view group;  // the column of the overview; empty: of files, or of the oracle
  CauseKind cause;         // what a finding shows, unless there is something special (verify/causes)
  std::string_view meaning, bound, source;
};

/// All of them, in the order of the table.
const std::vector<RowKind>& row_kinds();
/// nullptr: there is none of that name.
const RowKind* row_kind(std::string_view check);

/// What the words and signs of the tables mean, some lines.
std::string_view words_of_tables();

/// The row that now says what this one did: waivers, journals and command lines may name rows of earlier
/// versions. Any other name stays as it is.
std::string_view current_name(std::string_view check);

}  // namespace limitcheck::verify
