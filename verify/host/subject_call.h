// SPDX-License-Identifier: MIT
// Calls through the plug-in interface. Private to the host and to the worker.
#pragma once

#include <fmt/core.h>

#include <exception>

#include "verify/interrupt/interrupt.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify::detail {

/// Calls a function of the subject and turns every way of failing into a SubjectError. C++ subjects may throw
/// although the interface is C: that is a failure of theirs, not the end of the run.
///   function_call   (const char** message) -> lc_status
template <class Call>
void call(const lc_subject& subject, const char* function, Call&& function_call) {
  const char* message = nullptr;
  lc_status status = LC_FAILED;
  try {
    status = function_call(&message);
  } catch (const SubjectError&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const HostOutOfMemory&) {
    throw;
  } catch (const std::exception& error) {
    throw SubjectError(LC_FAILED, fmt::format("{}: {}() threw: {}", subject.name, function, error.what()));
  } catch (...) {
    throw SubjectError(LC_FAILED, fmt::format("{}: {}() threw", subject.name, function));
  }
  if (status == LC_OK) return;
  if (status != LC_NOT_SUPPORTED && status != LC_INVALID_INPUT) status = LC_FAILED;
  throw SubjectError(
      status, fmt::format("{}: {}", subject.name, message != nullptr ? message : "no reason was given"));
}

}  // namespace limitcheck::verify::detail
