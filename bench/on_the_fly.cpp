// SPDX-License-Identifier: MIT
// A large mesh tessellated on the fly: every point is computed, checksummed and overwritten. Shows that the
// memory beyond mesh and prepass is a workspace per thread, whatever the mesh.
//   on_the_fly [FACES = 1000000 [DEPTH = 5 [THREADS = all]]]
#include <fmt/core.h>
#include <sys/resource.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "fast/stream/row_stream.h"

namespace {

using namespace limitcheck;
namespace rs = fast::row_stream;

// "VmHWM" or "VmRSS" of this process, in KB.
long memory(const char* name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(name)) return std::atol(line.c_str() + std::strlen(name) + 1);
  }
  return 0;
}

struct Thread {
  rs::Workspace workspace;
  std::uint64_t checksum = 0;
};

// A sum of bits, which does not depend on threads or lanes.
void add_row(void* context, const rs::RowView& view) {
  std::uint64_t& sum = *static_cast<std::uint64_t*>(context);
  for (std::size_t lane = 0; lane < view.size(); ++lane) {
    const float* row = &view.vertices(lane)->position.x;
    for (int k = 0; k < 6 * rs::side(view.depth); ++k) {
      std::uint32_t bits;
      std::memcpy(&bits, row + k, sizeof bits);
      sum += bits;
    }
  }
}

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

int main(int argc, char** argv) {
  const int faces = argc > 1 ? std::atoi(argv[1]) : 1'000'000, depth = argc > 2 ? std::atoi(argv[2]) : 5;
  const int threads = argc > 3 ? std::atoi(argv[3]) : tbb::task_arena::automatic;
  if (faces < 4 || depth < 0 || depth > rs::kMaxDepth || threads == 0) return 2;
  const data::ControlMesh mesh = data::bumpy_sphere(faces, 1);

  const double start = seconds();
  const fast::Adjacency adjacency(mesh);
  const auto pairs = fast::pair_faces(adjacency, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids;
  const rs::RowStream stream(mesh, adjacency);
  const double prepared = seconds();

  tbb::task_arena arena(threads);
  tbb::enumerable_thread_specific<Thread> workers;
  arena.execute(
      [&] { tbb::parallel_for(0, 64, [&](int) { workers.local(); }); });  // the library's own memory
  std::ofstream("/proc/self/clear_refs") << 5;                            // forget the peak so far
  const long before = memory("VmRSS:");
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, pairs.size(), 256),
        [&](const tbb::blocked_range<std::size_t>& r) {
          Thread& mine = workers.local();
          stream.rows(std::span(pairs).subspan(r.begin(), r.size()), depth, mine.workspace, &add_row,
                      &mine.checksum);
        },
        tbb::simple_partitioner());
  });
  const double done = seconds();
  const long peak = memory("VmHWM:");

  std::uint64_t checksum = 0;
  std::size_t largest = 0;
  for (const Thread& worker : workers) {
    checksum += worker.checksum;
    largest = std::max(largest, worker.workspace.bytes());
  }
  const double points = static_cast<double>(pairs.size()) * rs::side(depth) * rs::side(depth);
  fmt::print(
      "{} faces, depth {}, {}: {:.0f} million points in {:.2f} s after {:.2f} s of set-up, "
      "{:.0f} million a second, checksum {:016x}\n",
      faces, depth, stream.kernel().name, points / 1e6, done - prepared, prepared - start,
      points / 1e6 / (done - prepared), checksum);
  fmt::print("resident before {} KB, peak {} KB: {} KB more; {} threads, workspace {} bytes each\n", before,
             peak, peak - before, workers.size(), largest);
}
