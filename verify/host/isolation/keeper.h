// SPDX-License-Identifier: MIT
// The process between this program and a child: it starts the child, and nothing that the child starts
// outlives it. It leads a session of its own, so that the child has no terminal.
//
//   in a PID namespace   where the system allows one (root, or user namespaces). The keeper is its first
//                        process: when it ends, however it ends, the kernel kills all others. They see no
//                        process outside.
//   as a subreaper       elsewhere. What a descendant leaves behind becomes a child of the keeper, which
//                        kills its children until none is left. A descendant that kills the keeper escapes
//                        this.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace limitcheck::verify {

enum class Containment { kNamespace, kSubreaper };

/// What the keeper tells, one after another, in the pipe `news`.
struct News {
  enum Kind : int {
    kGivesUp,     // the system lets it start no child; value: errno
    kNotStarted,  // there is no such program, or it cannot be run; value: errno
    kEnded  // value: the status of waitpid. All that the child has started is gone; under a subreaper, all
            // but what multiplies faster than it can be killed
  };
  Kind kind = kGivesUp;
  int value = 0;
};

/// The ends of pipes that keeper and child have, in this order.
struct KeeperPipes {
  enum Pipe : std::size_t {
    kIn,  // the child's standard input, output and error
    kOut,
    kErr,
    kLifeline,  // for reading: the keeper ends when nobody holds the other end
    kNews       // for writing
  };
  std::array<int, 5> end{-1, -1, -1, -1, -1};
};

/// The program that keepers are, from now on: limitcheck-keeper. Not while one is started.
void use_keeper(const std::string& program);

/// Starts a keeper that runs this command: a child of this process. Returns its number, or -1 with errno. In
/// a namespace it ends with the thread that is its parent, too. It keeps no descriptors but these pipes.
pid_t start_keeper(Containment containment, const std::vector<std::string>& command,
                   const KeeperPipes& pipes);

}  // namespace limitcheck::verify
