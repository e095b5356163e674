// SPDX-License-Identifier: MIT
#include "verify/row/result.h"

namespace limitcheck::verify {

std::string_view word(Status status) {
  switch (status) {
    case Status::kHeld:
      return "held";
    case Status::kFinding:
      return "finding";
    case Status::kQualityWarning:
      return "quality-warning";
    case Status::kWaived:
      return "waived";
    case Status::kUnexpectedPass:
      return "unexpected-pass";
    case Status::kNotSupported:
      return "not-supported";
    case Status::kNotRun:
      return "not-run";
    case Status::kCrash:
      return "crash";
    case Status::kTimeout:
      return "timeout";
    case Status::kError:
      return "error";
  }
  return "error";
}

Status verdict_of(const Result& row) {
  const bool beyond = row.worst && row.bound && !(*row.worst <= *row.bound);
  switch (row.status) {
    case Status::kHeld:
    case Status::kFinding:
      return beyond || row.bad != 0 ? Status::kFinding : Status::kHeld;
    case Status::kQualityWarning:  // of a file's rows `bad` counts what the warning is about
    case Status::kUnexpectedPass:
      return beyond ? Status::kFinding : row.status;
    case Status::kNotRun:
      if (beyond || row.bad != 0) return Status::kFinding;
      return row.of != 0 ? Status::kHeld : Status::kNotRun;
    default:
      return row.status;
  }
}

}  // namespace limitcheck::verify
