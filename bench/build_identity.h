// SPDX-License-Identifier: MIT
// Identifies a build: figures of different builds are not to be compared. Needs the definitions of
// bench/CMakeLists.txt.
#pragma once

#include <gnu/libc-version.h>

#include <string>

namespace limitcheck::bench {

/// "GNU-12.2.0/glibc-2.36/-O3 -DNDEBUG": compiler, C library, flags.
inline std::string build_identity() {
  return std::string(LIMITCHECK_COMPILER_ID) + "/glibc-" + gnu_get_libc_version() + "/" + LIMITCHECK_FLAGS;
}

}  // namespace limitcheck::bench
