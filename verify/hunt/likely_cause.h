// SPDX-License-Identifier: MIT
// What lies about the place of a finding, as far as it tells faults apart.
#pragma once

#include <string>

#include "verify/evidence/audit_case.h"
#include "verify/row/result.h"

namespace limitcheck::verify {

/// The likely cause near the place of a finding: of the corners of its face that are not regular, and of its
/// middle if it is cut into quads, the nearest; or of several equally near the least regular.
struct LikelyCause {
  /// "regular", "inner vertex", "boundary vertex", "crease", "dart", "corner", "face"; or empty: the finding
  /// names no face, or is of a relation.
  std::string kind;
  std::string valence;  // class of its faces (of a face, corners): "1" to "7", "8 to 40", "more than 40"
  int rank = 0;         // how far it is from the regular one, 0 to 3
  bool beside = false;  // there is another extraordinary corner
  int difference = 0;   // between the depths of the face and of those at its corners, at most 4

  /// "inner vertex of 7 faces, beside another extraordinary one; depths differ by 3"
  std::string words() const;
  /// A fault there would show in `other`, too, which has all that this has and more.
  bool covers(const LikelyCause& other) const;
  /// Less than that of any other that it covers.
  int level() const { return (kind == "regular" ? 0 : 1 + rank) + (beside ? 1 : 0) + difference; }

  friend bool operator==(const LikelyCause&, const LikelyCause&) = default;
};

LikelyCause likely_cause(const Result& finding, const AuditMesh& mesh);

/// By which findings are one: scheme, check, status, and the neighbourhood. Stable.
std::string signature(const Result& finding, const LikelyCause& where);

}  // namespace limitcheck::verify
