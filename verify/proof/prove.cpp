// SPDX-License-Identifier: MIT
#include "verify/proof/proof_set.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "verify/proof/bounds/bounds.h"
#include "verify/proof/numbers/operation_count.h"
#include "verify/proof/topologies/proof_row.h"

namespace limitcheck::verify {
namespace {

std::optional<BoundProof> bound_of(const std::string& kernel, const ProofTask& task) {
  const auto* k =
      std::ranges::find_if(kProvedKernels, [&](ProvedKernel one) { return kernel == name_of(one); });
  if (k == kProvedKernels.end()) throw std::logic_error("no bounds for " + kernel);
  const BoundOptions& o = *task.bounds;
  if (*k != ProvedKernel::kCrackCentre)
    return prove_bound(*k, task.neighbourhood, o.first_depth, o.last_depth, o.meshes);
  if (o.first_depth > 0) return std::nullopt;  // knows no depth
  return prove_bound(*k, task.neighbourhood, 0, 0, o.meshes);
}

std::optional<CostProof> cost_of(const std::string& kernel, const ProofTask& task) {
  const bool window = kernel == name_of(ProvedKernel::kSlidingWindow);
  if (!window && kernel != name_of(ProvedKernel::kRowStream)) return std::nullopt;
  const data::ControlMesh& mesh = task.neighbourhood.mesh;
  if (mesh.faces.size() == 1 || !mesh.faces.are_triangles()) return std::nullopt;  // counted per pair
  const KernelCost cost = count_operations(window ? CountedKernel::kSlidingWindow : CountedKernel::kRowStream,
                                           mesh, task.options.last_depth);
  return CostProof{cost.flops_per_point(), cost.vectors_per_point()};
}

/// Nothing if it was stopped on the way.
std::vector<ProofRow> rows_of(const ProofTask& task, const std::function<bool()>& stop) {
  std::vector<ProofRow> rows = prove_map(task.neighbourhood, task.options);
  for (ProofRow& row : rows) {
    if (stop && stop()) return {};
    const ThreadClock clock;
    if (task.bounds) row.bound = bound_of(row.kernel, task);
    row.cost = cost_of(row.kernel, task);
    row.seconds += clock.seconds();
  }
  return rows;
}

}  // namespace

std::vector<std::vector<ProofRow>> prove(const std::vector<ProofTask>& tasks,
                                         const std::function<void(const ProofProgress&)>& progress,
                                         const std::function<bool()>& stop) {
  std::vector<std::vector<ProofRow>> result(tasks.size());
  double all = 0;
  for (const ProofTask& task : tasks) all += task.estimate;
  std::mutex mutex;
  ProofProgress done;
  std::atomic<std::size_t> next = 0;
  // In the order of the set, so that what is there after a stop is whole groups and the beginning of one.
  tbb::parallel_for(
      0, tbb::this_task_arena::max_concurrency(),
      [&](int) {
        for (std::size_t t = next++; t < tasks.size() && !(stop && stop()); t = next++) {
          result[t] = rows_of(tasks[t], stop);
          const std::scoped_lock lock(mutex);
          ++done.tasks;
          done.share += tasks[t].estimate / all;
          done.latest = &tasks[t];
          done.rows = &result[t];
          if (progress) progress(done);
        }
      },
      tbb::simple_partitioner());
  return result;
}

}  // namespace limitcheck::verify
