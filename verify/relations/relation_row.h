// SPDX-License-Identifier: MIT
// One row of the relations while the requests for it are made.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "verify/evidence/audit_case.h"
#include "verify/relations/relation_comparison.h"

namespace limitcheck::verify {

/// The status of a row in which a request ended with this error: kNotSupported for LC_NOT_SUPPORTED, kFinding
/// for LC_INVALID_INPUT (the mesh was valid) and for an answer that breaks the protocol, kCrash or kTimeout
/// for a process that ended or hung, otherwise kError.
Status status_of(const std::exception& error);

/// All requests are made, also after one has failed. The row has the worst status of them all, and its
/// message says what went wrong in each.
class RelationRow {
 public:
  RelationRow(const AuditSubject& subject, const Evidence& e, std::string_view name, const char* unit,
              double bound);

  /// Opens a session for one mesh and calls `work` with it, which may tessellate any number of times.
  /// Whatever `work` or the end of the session throws is noted together with `what`, which `work` may have
  /// changed.
  void ask(const std::string& what, const data::ControlMesh& mesh, const std::function<void(Session&)>& work);

  /// The same with another subject.
  void ask(const AuditSubject& subject, const std::string& what, const data::ControlMesh& mesh,
           const std::function<void(Session&)>& work);

  /// Notes defects of the arrays, unless the tessellation of the evidence has some too.
  void inspect(const std::string& what, const Tessellation& t);

  /// `bits_matter`: points that differ beneath the bound are worth a warning.
  void judge(const std::string& what, const Comparison& c, bool bits_matter);

  /// Adds `of` elements that were compared, `bad` of them wrong.
  void count(std::int64_t bad, std::int64_t of) {
    r_.bad += bad;
    r_.of += of;
  }
  void note(Status status, const std::string& message);
  /// Sets the witness if there is none yet.
  void witness(const Witness& w) {
    if (!r_.witness) r_.witness = w;
  }

  /// The row. If nothing was compared it is not run, never held.
  Result take();

 private:
  const AuditSubject& subject_;
  const Evidence& e_;
  Result r_;
  std::string comparison_;
};

}  // namespace limitcheck::verify
