// SPDX-License-Identifier: MIT
// The forms of RowStream that give each grid a place of its own, and those that write past the caches.
#include <algorithm>
#include <array>
#include <cstring>
#include <span>

#include "fast/stream/gather/cut_grids.h"
#include "fast/stream/kernel/compact_vertex.h"
#include "fast/stream/kernel/memory_stream.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::fast::row_stream {

namespace {

// Rows of at most kMaxLanes whole grids, each as a run of `Out` from its place on.
template <class Out>
struct Runs {
  const Grid* first;
  Out* const* places;
  Stores stores;
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
      Out* const to = runs.places[first_grid + lane];
      const std::byte* const row = runs.convert({view.vertices(lane), length});
      if (runs.stores == Stores::kOrdinary) {
        std::memcpy(to + static_cast<std::size_t>(view.j) * length, row, length * sizeof(Out));
        continue;
      }
      LineStream& lines = runs.lines[lane];
      if (view.j == 0) lines.start(reinterpret_cast<std::byte*>(to));
      lines.append(row, length * sizeof(Out));
      if (view.j + 1 == side(view.depth)) lines.finish();
    }
  }
};

template <class Out>
void write_runs(const RowStream& stream, std::span<const Grid> grids, int depth, Workspace& workspace,
                Out* const* places, Order order, Stores stores) {
  Runs<Out> runs;
  runs.first = grids.data();
  runs.places = places;
  runs.stores = stores;
  stream.rows(grids, depth, workspace, &Runs<Out>::visit, &runs, order);
}

// write(grids, places) for at most kMaxLanes grids at a time, which lie one after the other.
template <class Out, class Write>
void one_after_the_other(std::span<const Grid> grids, int depth, Out* out, const Write& write) {
  const auto length = static_cast<std::size_t>(side(depth)), size = length * length;
  std::array<Out*, kMaxLanes> places;
  while (!grids.empty()) {
    const std::size_t count = std::min(grids.size(), places.size());
    for (std::size_t k = 0; k < count; ++k) places[k] = out + k * size;
    write(grids.first(count), places.data());
    grids = grids.subspan(count), out += count * size;
  }
}

}  // namespace

void RowStream::put(std::span<const Grid> grids, int depth, Workspace& workspace, Vertex* const* places,
                    Order order, Stores stores) const {
  workspace.prepare(depth, kernel_.lanes);
  const auto lanes = static_cast<std::size_t>(kernel_.lanes);
  std::size_t count = 0;
  for (; !grids.empty(); grids = grids.subspan(count), places += count) {
    count = together(grids, lanes);
    const std::span<const Grid> batch = grids.first(count);
    if (kernel_.run_lines == nullptr || (cut_ && cut_->touches(batch.front()))) {
      write_runs(*this, batch, depth, workspace, places, order, stores);
      continue;
    }
    std::array<float*, kMaxLanes> lane;  // those beyond the last grid repeat it, place and all
    for (std::size_t k = 0; k < lanes; ++k) lane[k] = places[std::min(k, count - 1)]->position;
    gather(adjacency_, rings_, batch, depth, kernel_.lanes, workspace.input.data(), order);
    kernel_.run_lines(workspace.input.data(), depth, rings_.placement(), workspace.work.data(), lane.data(),
                      stores);
  }
}

void RowStream::streamed(std::span<const Grid> grids, int depth, Workspace& workspace, Vertex* out) const {
  workspace.prepare(depth, kernel_.lanes);
  one_after_the_other(grids, depth, out, [&](std::span<const Grid> some, Vertex* const* places) {
    put(some, depth, workspace, places, Order::kFromA, Stores::kPastCaches);
  });
  fence(Stores::kPastCaches);
}

void RowStream::streamed(std::span<const Grid> grids, int depth, Workspace& workspace,
                         CompactVertex* out) const {
  workspace.prepare(depth, kernel_.lanes);
  one_after_the_other(grids, depth, out, [&](std::span<const Grid> some, CompactVertex* const* places) {
    write_runs(*this, some, depth, workspace, places, Order::kFromA, Stores::kPastCaches);
  });
  fence(Stores::kPastCaches);
}

}  // namespace limitcheck::fast::row_stream
