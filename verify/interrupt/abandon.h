// SPDX-License-Identifier: MIT
// Work that may be left where it is when a signal comes.
#pragma once

#include <chrono>
#include <functional>

namespace limitcheck::verify {

/// How long work that a signal interrupts may go on, to end in good order.
inline constexpr std::chrono::milliseconds kToEnd{300};

/// Runs `work` on a thread of its own and waits for it; exceptions pass on. If a signal is noted (interrupt.h)
/// and the work has not ended so long after, it is left: the answer is false, and the work goes on. All that it
/// uses must then live as long as the process, which `leave` ends.
[[nodiscard]] bool run_or_abandon(std::function<void()> work, std::chrono::milliseconds to_end = kToEnd);

/// Ends the process with this exit code, without destructors. Standard output is written out first; if that
/// fails, the exit code is `unwritten`.
[[noreturn]] void leave(int exit_code, int unwritten);

}  // namespace limitcheck::verify
