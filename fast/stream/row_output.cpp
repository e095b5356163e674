// SPDX-License-Identifier: MIT
// The forms of RowStream that write to memory past the caches.
#include <algorithm>
#include <array>
#include <span>

#include "fast/stream/compact_vertex.h"
#include "fast/stream/cut_grids.h"
#include "fast/stream/memory_stream.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::fast::row_stream {

namespace {

// Rows of whole grids, in the order in which they lie in memory, as runs of `Out`.
template <class Out>
struct Runs {
  const Grid* first;
  Out* out;
  std::array<LineStream, kMaxLanes> lines;
  std::array<Out, side(kMaxDepth)> converted;

  const std::byte* convert(std::span<const Vertex> row) {
    if constexpr (sizeof(Out) == sizeof(Vertex)) {
      return reinterpret_cast<const std::byte*>(row.data());
    } else {
      compact(row, converted.data());
      return reinterpret_cast<const std::byte*>(converted.data());
    }
  }

  static void visit(void* context, const RowView& view) {
    Runs& runs = *static_cast<Runs*>(context);
    const auto length = static_cast<std::size_t>(side(view.depth));
    const auto first_grid = static_cast<std::size_t>(view.grids.data() - runs.first);
    for (std::size_t lane = 0; lane < view.grids.size(); ++lane) {
      LineStream& lines = runs.lines[lane];
      if (view.j == 0)
        lines.start(reinterpret_cast<std::byte*>(runs.out + (first_grid + lane) * length * length));
      lines.append(runs.convert({view.vertices(lane), length}), length * sizeof(Out));
      if (view.j + 1 == side(view.depth)) lines.finish();
    }
  }
};

template <class Out>
void write_runs(const RowStream& stream, std::span<const Grid> grids, int depth, Workspace& workspace,
                Out* out) {
  Runs<Out> runs;
  runs.first = grids.data();
  runs.out = out;
  stream.rows(grids, depth, workspace, &Runs<Out>::visit, &runs);
}

}  // namespace

void RowStream::streamed(std::span<const Grid> grids, int depth, Workspace& workspace, Vertex* out) const {
  if (kernel_.run_lines == nullptr) {
    write_runs(*this, grids, depth, workspace, out);
    return fence_streams();
  }
  workspace.prepare(depth, kernel_.lanes);
  const auto size = static_cast<std::size_t>(side(depth)) * static_cast<std::size_t>(side(depth));
  std::size_t count = 0;
  for (; !grids.empty(); grids = grids.subspan(count), out += count * size) {
    count = together(grids, static_cast<std::size_t>(kernel_.lanes));
    if (cut_ && cut_->touches(grids.front())) {
      write_runs(*this, grids.first(count), depth, workspace, out);
      continue;
    }
    std::array<float*, kMaxLanes> lane;
    for (std::size_t k = 0; k < lane.size(); ++k) lane[k] = out[std::min(k, count - 1) * size].position;
    gather(adjacency_, rings_, grids.first(count), depth, kernel_.lanes, workspace.input.data());
    kernel_.run_lines(workspace.input.data(), depth, rings_.placement(), workspace.work.data(), lane.data());
  }
  fence_streams();
}

void RowStream::streamed(std::span<const Grid> grids, int depth, Workspace& workspace,
                         CompactVertex* out) const {
  write_runs(*this, grids, depth, workspace, out);
  fence_streams();
}

}  // namespace limitcheck::fast::row_stream
