// SPDX-License-Identifier: MIT
// Calls through the plug-in interface. Private to the host and to the worker.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <exception>
#include <string>

#include "verify/host/host.h"
#include "verify/host/host_memory.h"
#include "verify/interrupt/interrupt.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify::detail {

/// Calls a function of the subject and turns every way of failing into a SubjectError. C++ subjects may throw
/// although the interface is C: that is a failure of theirs, not the end of the run. A crash or failure where the
/// system allows less than a subject may take is nobody's fault: HostLacks.
///   function_call   (const char** message) -> lc_status
template <class Call>
void call(const lc_subject& subject, const char* function, Call&& function_call) try {
  const char* message = nullptr;
  lc_status status = LC_FAILED;
  try {
    status = function_call(&message);
  } catch (const SubjectError&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const HostLacks&) {
    throw;
  } catch (const std::exception& error) {
    throw SubjectError(LC_FAILED, fmt::format("{}: {}() threw: {}", subject.name, function, error.what()));
  } catch (...) {
    throw SubjectError(LC_FAILED, fmt::format("{}: {}() threw", subject.name, function));
  }
  if (status == LC_OK) return;
  std::string why = message != nullptr ? message : "no reason was given";
  if (status != LC_NOT_SUPPORTED && status != LC_INVALID_INPUT && status != LC_FAILED) {
    why = fmt::format("its status {} is none: {}", static_cast<int>(status), why);
    status = LC_FAILED;
  }
  throw SubjectError(status, fmt::format("{}: {}", subject.name, why));
} catch (const SubjectError& error) {
  const auto* died = dynamic_cast<const SubjectDied*>(&error);
  const bool broke =
      died != nullptr ? died->kind() == SubjectDied::Kind::kCrash : error.status() == LC_FAILED;
  if (const std::string shortage = broke ? host_shortage() : ""; !shortage.empty())
    throw HostLacks{error.what(), shortage};
  throw;
}

/// Options as a function of the subject takes them.
inline const char* text(const std::string& options) {
  return options.empty() ? nullptr : options.c_str();
}

/// A structure that a subject fills in, and what one built for a later interface than ours may not touch.
template <class Known>
struct Guarded {
  static constexpr unsigned char kPattern = 0xA5;
  Known known{};
  std::array<unsigned char, 256> behind;
  Guarded() {
    known.size = sizeof known;
    behind.fill(kPattern);
  }
  /// Throws SubjectDied otherwise.
  void expect_nothing_behind(const lc_subject& subject) const {
    if (std::ranges::any_of(behind, [](unsigned char b) { return b != kPattern; }))
      throw SubjectDied(SubjectDied::Kind::kProtocol,
                        fmt::format("{}: it writes behind the {} bytes of a structure that `size` gives it",
                                    subject.name, sizeof known));
  }
};

/// What a subject delivered, and whether release() threw. The arrays are the host's, so the subject lets go at once;
/// a copy, because it may clear its own.
struct Delivered {
  lc_tessellation arrays;
  bool release_threw = false;
};
inline Delivered tessellate(const lc_subject& subject, void* instance,
                            std::span<const std::int32_t> face_depth, int threads, Memory& memory) {
  const lc_request request{face_depth.data(), threads, &memory, &Memory::allocate, sizeof(lc_request)};
  Guarded<lc_tessellation> answer;
  lc_tessellation& out = answer.known;
  call(subject, "tessellate",
       [&](const char** message) { return subject.tessellate(instance, &request, &out, message); });
  answer.expect_nothing_behind(subject);
  const lc_tessellation delivered = out;
  try {
    subject.release(instance, &out);
  } catch (...) {
    return {delivered, true};
  }
  return {delivered, false};
}

}  // namespace limitcheck::verify::detail
