// SPDX-License-Identifier: MIT
// limitcheck-shader: serves a GLSL file to an audit, each time in a process of its own: `limitcheck audit --shader FILE` starts it.
#include <cstdio>
#include <span>
#include <string_view>

#include "verify/host/isolation/worker.h"
#include "verify/shader/shader_subject.h"

int main(int argc, char** argv) {
  const std::span<char*> words(argv, static_cast<std::size_t>(argc));
  const bool in_turns = words.size() == 5 && std::string_view(words[4]) == "--in-turns";
  if (!(words.size() == 4 || in_turns) || std::string_view(words[1]) != "worker" ||
      std::string_view(words[2]) != "shader") {
    std::fputs("limitcheck-shader: `limitcheck audit --shader FILE` starts this program\n", stderr);
    return 2;
  }
  return limitcheck::verify::serve(
      [&]() -> const lc_subject& { return limitcheck::verify::shader_subject(words[3]); }, in_turns);
}
