// SPDX-License-Identifier: MIT
// limitcheck-shader: serves a shader to an audit, each time in a process of its own: `limitcheck audit --shader FILE` starts it.
// `limitcheck shader FILE` prints one for Vulkan.
#include <cstdio>
#include <exception>
#include <string_view>

#include "verify/host/isolation/worker.h"
#include "verify/shader/prelude.h"
#include "verify/shader/shader_subject.h"

int main(int argc, char** argv) {
  using namespace limitcheck::verify;
  const std::string_view command = argc > 1 ? argv[1] : "--help";
  if (command == "worker") return serve(argc, argv, "shader", shader_subject);
  if (argc != 2 || command.starts_with('-')) {
    std::fputs(
        "limitcheck shader FILE.glsl: the file with all that it is given, as GLSL for Vulkan\n"
        "  limitcheck shader my.glsl > my.comp; glslangValidator -V my.comp -o my.spv\n"
        "  cp my.glsl my.spv.pragmas; limitcheck audit --shader my.spv quad-torus\n",
        command == "--help" ? stdout : stderr);
    return command == "--help" ? 0 : 2;
  }
  try {
    std::fputs(vulkan_text(read_shader(argv[1])).c_str(), stdout);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "limitcheck: %s\n", error.what());
    return 2;
  }
}
