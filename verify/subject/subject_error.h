// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// A subject refuses or fails, or the host does not call it (depths beyond its capabilities, another
/// interface).
///   status   LC_NOT_SUPPORTED, LC_INVALID_INPUT or LC_FAILED, never LC_OK
/// Thrown by the host (verify/host/host.h); an adapter
/// that throws it makes the interface return status and text.
class SubjectError : public std::runtime_error {
 public:
  SubjectError(lc_status status, const std::string& message) : std::runtime_error(message), status_(status) {}
  lc_status status() const { return status_; }

 private:
  lc_status status_;
};

/// The host did not call the subject: the request is beyond what the subject declares, or beyond the
/// interface itself.
class NotAsked : public SubjectError {
 public:
  explicit NotAsked(const std::string& message) : SubjectError(LC_NOT_SUPPORTED, message) {}
};

/// A subject that runs in a process of its own (verify/host/isolation/) has broken down there. what()
/// tells how, what it last wrote on standard error, and the command that repeats it.
class SubjectDied : public SubjectError {
 public:
  enum class Kind {
    kCrash,     // killed by a signal, or ended without an answer
    kTimeout,   // no answer in time
    kMemory,    // took more memory than allowed
    kProtocol,  // its answer breaks the protocol
  };
  SubjectDied(Kind kind, const std::string& message) : SubjectError(LC_FAILED, message), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// This program, or the system it runs on, lacks what it takes to judge a subject: memory, files, processes. No fault
/// of the subject. Not a std::exception, for the reason that Interrupted (interrupt.h) is none.
///   what     "cannot make a pipe: Too many open files"
///   because  where the subject broke down for it: host_shortage() (host.h)
struct HostLacks {
  std::string what, because = {};
  std::string text() const { return because.empty() ? what : what + "; " + because; }
};

}  // namespace limitcheck::verify
