// SPDX-License-Identifier: MIT
// What a process has started, and how much memory that takes.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace limitcheck::verify {

/// The descendants of a process, in any order, without itself. Exact if it is a subreaper or the first
/// process of a namespace: then those whose parents have ended descend from it still. From the lists of
/// children of all threads of a process if the kernel keeps such lists (CONFIG_PROC_CHILDREN), otherwise from
/// the parents of all processes there are. `proc`: for tests.
std::vector<pid_t> descendants(pid_t process, const std::filesystem::path& proc = "/proc");

/// Its children alone.
std::vector<pid_t> children_of(pid_t process, const std::filesystem::path& proc = "/proc");

/// Bytes that these processes hold: what they have resident together, and all of the shared memory without a name (memfd,
/// unlinked files of a tmpfs) that they have open or mapped, whether or not they look at it. Pages that they share count
/// once if the sum of all exceeds `enough`: only then are they looked for, which takes long. Of these, `shared`: such
/// shared memory; and `most` of the processes' largest resident size so far, of one of them.
struct Held {
  std::uint64_t bytes = 0, shared = 0, most = 0;
};
Held held_bytes(const std::vector<pid_t>& processes, std::uint64_t enough,
                const std::filesystem::path& proc = "/proc");

}  // namespace limitcheck::verify
