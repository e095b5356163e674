// SPDX-License-Identifier: MIT
// The other end of the protocol: the process that a shared library, or a built-in subject, is run in.
#pragma once

#include <string>
#include <string_view>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// Loads a shared library and asks its entry symbol for the subject; the library
/// stays loaded. Throws SubjectError(LC_INVALID_INPUT): no such file, not a
/// library, a library it needs is missing, no entry symbol, another interface, an
/// incomplete table. Runs the library's initialisers: for a process that may crash.
const lc_subject& load_subject(const std::string& file);

/// main() of what RemoteSubject starts: `PROGRAM worker KIND WHAT [--in-turns]`. Serves one host on standard input and output
/// until the input ends; returns the exit status. Asked to end in good order it calls destroy(), sends the exit status that
/// it will have, and exits. From the start, what the subject prints goes to standard error. Crashes with the subject: that is
/// its purpose.
///   kind        that this program serves
///   open        WHAT as a subject, at the first request
///   --in-turns  puts in_turns.h in front of the subject
int serve(int argc, char** argv, std::string_view kind, const lc_subject& (*open)(const std::string& what));

}  // namespace limitcheck::verify
