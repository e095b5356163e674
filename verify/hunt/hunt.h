// SPDX-License-Identifier: MIT
// A search for anything wrong, case by case.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "verify/audit/audit.h"
#include "verify/hunt/hunt_plan.h"
#include "verify/hunt/hunt_report.h"

namespace limitcheck::verify {

struct HuntOptions {
  int threads = 1;
  int attempts = 2000;              // to shrink a finding; 0: it is not shrunk
  std::filesystem::path witnesses;  // folder for the small meshes; empty: none is written
};

/// Audits cases of a plan. What follows from another row of the case (verify/causes/causes.h) is no finding; of findings
/// with one signature in a case the first counts.
class Hunt {
 public:
  Hunt(AuditSubject subject, HuntPlan plan, HuntOptions options);

  /// What the case adds to a report; none if it was interrupted, and does not count.
  std::optional<HuntReport> look(std::uint64_t number);
  /// Makes small meshes for the findings that are to have them (HuntReport::to_shrink) and have none; ends
  /// early if it is interrupted.
  void shrink_findings(HuntReport& report);

 private:
  Report audit(const HuntCase& at);
  void shrink_finding(HuntFinding& finding);

  // With the options of the case.
  AuditSubject subject(const HuntCase& at) const;

  AuditSubject subject_;
  HuntPlan plan_;
  HuntOptions options_;
  Auditor quick_, thorough_;
};

}  // namespace limitcheck::verify
