// SPDX-License-Identifier: MIT
// `limitcheck merge`: parts of each kind. They return an exit code.
#pragma once

#include <string>
#include <vector>

#include "verify/cli/audit_output.h"
#include "verify/shard/part.h"

namespace limitcheck::cli {

struct MergeArguments {
  std::vector<std::string> parts;
  std::string output;
  OutputArguments report;  // --junit, --baseline, and of an audit --require and --waivers
};

int merge_audit(const verify::PartReport& whole, const MergeArguments& arguments);
int merge_mutants(const verify::PartReport& whole, const MergeArguments& arguments);
int merge_prove(const verify::PartReport& whole, const MergeArguments& arguments);

}  // namespace limitcheck::cli
