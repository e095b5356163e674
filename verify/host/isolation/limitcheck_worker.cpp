// SPDX-License-Identifier: MIT
// limitcheck-worker: serves a shared library to an audit, as `limitcheck worker library FILE` does. An audit starts
// thousands of processes, and `limitcheck` takes ten times as long to start: it is linked with all its peers.
#include <cstdio>
#include <span>
#include <string_view>

#include "verify/host/isolation/worker.h"

int main(int argc, char** argv) {
  const std::span<char*> words(argv, static_cast<std::size_t>(argc));
  const bool in_turns = words.size() == 5 && std::string_view(words[4]) == "--in-turns";
  if (!(words.size() == 4 || in_turns) || std::string_view(words[1]) != "worker" ||
      std::string_view(words[2]) != "library") {
    std::fputs("limitcheck-worker: `limitcheck audit ./LIBRARY.so` starts this program\n", stderr);
    return 2;
  }
  return limitcheck::verify::serve(
      [&]() -> const lc_subject& { return limitcheck::verify::load_subject(words[3]); }, in_turns);
}
