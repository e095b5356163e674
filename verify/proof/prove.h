// SPDX-License-Identifier: MIT
// Runs a set of proofs.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "verify/proof/proof_set.h"

namespace limitcheck::verify {

struct ProofProgress {
  std::size_t tasks = 0;  ///< done
  double share = 0;       ///< of the estimated work, 0 .. 1
  const ProofTask* latest = nullptr;
  const std::vector<ProofRow>* rows = nullptr;  ///< of the latest; none if it was stopped
};

/// Runs the tasks on all cores, begun in their order. The rows of task t are result[t], whatever the number
/// of threads.
///   progress   called from one thread at a time after every task
///   stop       asked by any thread between the steps of its task: once true, tasks not done have no rows
std::vector<std::vector<ProofRow>> prove(const std::vector<ProofTask>& tasks,
                                         const std::function<void(const ProofProgress&)>& progress = {},
                                         const std::function<bool()>& stop = {});

}  // namespace limitcheck::verify
