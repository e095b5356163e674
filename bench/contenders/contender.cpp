// SPDX-License-Identifier: MIT
#include "bench/contenders/contender.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "data/scheme.h"

namespace limitcheck::bench {

double distinct_points(const data::ControlMesh& mesh, int depth) {
  const double edges = std::ldexp(1., depth);
  const auto faces = static_cast<double>(mesh.faces.size());
  if (data::natural_scheme(mesh) == data::Scheme::kCatmullClark)
    return faces * (edges * edges - 1) + static_cast<double>(mesh.positions.size());
  return faces * edges * edges / 2 + static_cast<double>(mesh.positions.size()) - faces / 2;
}

void in_parallel(std::size_t count, int threads,
                 const std::function<void(std::size_t first, std::size_t last)>& run) {
  if (threads == 1) return run(0, count);
  const std::size_t grain = std::max<std::size_t>(1, count / static_cast<std::size_t>(16 * threads));
  tbb::task_arena(threads).execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const auto& range) { run(range.begin(), range.end()); });
  });
}

}  // namespace limitcheck::bench
