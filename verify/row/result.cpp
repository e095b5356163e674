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

}  // namespace limitcheck::verify
