// SPDX-License-Identifier: MIT
// What an audit has not looked at, though all that it looked at may have held.
#pragma once

#include <string>
#include <vector>

#include "verify/audit/result.h"

namespace limitcheck::verify {

struct NeverJudged {
  std::string subject, check;
  std::string reason;  // the first that a row gives; may be empty

  /// "normals of cgal were never judged: it delivers none".
  std::string text() const;
};

/// For each subject those of `checks` that looked at nothing on any mesh.
std::vector<NeverJudged> never_judged(const Report& report, const std::vector<std::string>& checks);

/// The same of what a tessellator is for: points, of the limit surface or of the refined mesh, and normals.
/// Only of subjects that have a row of that name: finished files have others.
std::vector<NeverJudged> never_judged(const Report& report);

}  // namespace limitcheck::verify
