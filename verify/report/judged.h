// SPDX-License-Identifier: MIT
// Checks that looked at nothing, so that an audit without findings confirms nothing about them.
#pragma once

#include <string>
#include <vector>

#include "verify/row/result.h"

namespace limitcheck::verify {

struct NeverJudged {
  std::string subject, check;
  std::string reason;  // the first that a row gives; may be empty

  /// "normals of cgal were never judged: it delivers none".
  std::string text() const;
};

/// For each subject those of `checks` that looked at nothing on any mesh.
std::vector<NeverJudged> never_judged(const Report& report, const std::vector<std::string>& checks);

/// The same for positions (of the limit surface or of the refined mesh) and normals, of subjects that have
/// rows of these names, and for broken meshes, of subjects that are not asked because they do not validate;
/// rows of tessellation files have other names.
std::vector<NeverJudged> never_judged(const Report& report);

}  // namespace limitcheck::verify
