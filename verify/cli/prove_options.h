// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "verify/cli/units.h"
#include "verify/proof/proof_set.h"

namespace limitcheck::cli {

struct ProveRequest {
  std::string scheme = "loop", valences, kernel = "all", set = "standard";
  int depth = verify::ProofRequest().depth;
  bool each = false;
  ShardArguments shard;
  std::vector<std::string> parts;  // of limitcheck merge
};
void add_prove(CLI::App& app, const std::function<void(const ProveRequest&)>& prove);

}  // namespace limitcheck::cli
