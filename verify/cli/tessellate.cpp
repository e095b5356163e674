// SPDX-License-Identifier: MIT
#include "verify/cli/commands.h"

namespace limitcheck::cli {

void add_tessellate(CLI::App& /*app*/, int& /*exit_code*/) {}

}  // namespace limitcheck::cli
