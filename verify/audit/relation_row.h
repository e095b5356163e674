// SPDX-License-Identifier: MIT
// One row of the relations while it is being found: what a subject made of one request after another.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "verify/audit/audit.h"
#include "verify/audit/relation_comparison.h"

namespace limitcheck::verify {

/// What a failure of the subject's makes of its row. LC_NOT_SUPPORTED: no fault. LC_INVALID_INPUT: the
/// subject refuses what is valid, or (SubjectDied) declares what means nothing. A process that broke down:
/// crash or timeout, or a finding if it merely answered nonsense.
Status status_of(const std::exception& error);

/// Every request is looked at, whatever became of the one before: the row has the worst status of all, and
/// says of each what went wrong.
class RelationRow {
 public:
  RelationRow(const AuditSubject& subject, const Evidence& e, std::string_view name, const char* unit,
              double bound);

  /// A session of its own for one mesh. `work` tessellates as often as it likes; whatever it or the end of
  /// the session throws is noted, with `what` as it is by then.
  void ask(const std::string& what, const data::ControlMesh& mesh, const std::function<void(Session&)>& work);

  /// The same of another subject in its place.
  void ask(const AuditSubject& subject, const std::string& what, const data::ControlMesh& mesh,
           const std::function<void(Session&)>& work);

  /// Notes what is wrong with the arrays themselves, unless the evidence has been told the like already.
  void inspect(const std::string& what, const Tessellation& t);

  /// `bits_matter`: points that differ beneath the bound are worth a warning.
  void judge(const std::string& what, const Comparison& c, bool bits_matter);

  /// So many elements were looked at, and so many of them are wrong.
  void count(std::int64_t bad, std::int64_t of) {
    r_.bad += bad;
    r_.of += of;
  }
  void note(Status status, const std::string& message);
  /// Where to look, unless something said so before.
  void witness(const Witness& w) {
    if (!r_.witness) r_.witness = w;
  }

  /// The row. Nothing looked at and nothing wrong: not run, never held.
  Result take();

 private:
  const AuditSubject& subject_;
  const Evidence& e_;
  Result r_;
  std::string comparison_;
};

}  // namespace limitcheck::verify
