// SPDX-License-Identifier: MIT
// What tells builds apart whose figures may not be compared. Needs the definitions that bench/CMakeLists.txt
// gives.
#pragma once

#include <gnu/libc-version.h>

#include <string>

namespace limitcheck::bench {

/// "GNU-12.2.0/glibc-2.36/-O3 -DNDEBUG": compiler, C library, flags.
inline std::string build_identity() {
  return std::string(LIMITCHECK_COMPILER_ID) + "/glibc-" + gnu_get_libc_version() + "/" + LIMITCHECK_FLAGS;
}

}  // namespace limitcheck::bench
