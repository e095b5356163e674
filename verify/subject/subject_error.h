// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// A subject says no, or the host does not even ask (depths beyond its capabilities, another interface).
///   status   LC_NOT_SUPPORTED, LC_INVALID_INPUT or LC_FAILED, never LC_OK
/// Thrown by the host (verify/subject/host.h); an adapter that throws it makes the door return status and
/// text.
class SubjectError : public std::runtime_error {
 public:
  SubjectError(lc_status status, const std::string& message) : std::runtime_error(message), status_(status) {}
  lc_status status() const { return status_; }

 private:
  lc_status status_;
};

}  // namespace limitcheck::verify
