// SPDX-License-Identifier: MIT
// Findings that share a cause, as one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "verify/row/result.h"
#include "verify/row/rows.h"

namespace limitcheck::verify {

/// One thing that is wrong with one subject, or with several of one library.
struct Cause {
  std::string who;  // the library, or the subject's name without options
  CauseKind kind = CauseKind::kOther;
  std::vector<std::string> subjects;      // labels, in the order of the report
  std::vector<std::size_t> rows;          // of report.results, ascending: all that is wrong because of it ...
  std::vector<std::size_t> direct;        // ... and those of them that show it themselves
  std::vector<PlaceCount> places[2];      // kSurface: where it is, of Loop's scheme and of Catmull-Clark's
  std::size_t example = 0;                // of report.results: one of `direct`, on the smallest mesh there is
  std::int64_t cases = 0, of = 0;         // pairs of subject and case where it shows, of how many looked at
  int size = 1, share = 1;                // how large and how frequent it is, each from 1 to 3 (severity())
  std::string only_with;                  // the one kind of neighbourhood that it shows at, if there is one
  std::string title;                      // what is wrong, in one line
  std::string look;                       // where to look for it; may be empty
  std::vector<std::string> consequences;  // rows that are red because of it, and are not `direct`

  /// The one subject, or whose they are.
  const std::string& label() const { return subjects.size() == 1 ? subjects.front() : who; }
  /// "high", "medium" or "low".
  std::string_view severity() const;
};

/// The causes of a report, the gravest first. Every row that is_bad belongs to exactly one.
///
/// Rows of one subject in one case (a mesh at its depths) belong together where one implies the other: points
/// off the surface turn normals, open cracks and change with the order of the faces. Rows of one kind belong
/// together over all meshes, and where the library is the same over its subjects. Points and normals off the
/// surface are parted by the places of the control mesh where they are: each row is put to the cause with
/// most rows among those of the places where it has something wrong.
std::vector<Cause> causes(const Report& report);

/// The first half of it: the causes with who, kind, rows, direct and places.
std::vector<Cause> sorted_into_causes(const Report& report);

/// What to type to see an example of a cause: what came beside what should have come.
///   level   of the audit
std::string command_for(const Report& report, const Cause& cause, const std::string& level);

}  // namespace limitcheck::verify
