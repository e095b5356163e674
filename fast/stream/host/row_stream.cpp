// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>
#include <span>
#include <vector>

#include "data/error.h"
#include "fast/stream/gather/cut_grids.h"
#include "fast/stream/kernel/output_targets.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::fast::row_stream {

namespace {

constexpr std::size_t kLine = 64;

int checked(int depth) {
  if (depth < 0 || depth > kMaxDepth) throw data::ArgumentError("row streaming: depth is 0 to 10");
  return depth;
}

struct Rows {
  RowView view;
  void (*visit)(void*, const RowView&);
  void* context;
};

void visit_row(void* context, int j) {
  Rows& rows = *static_cast<Rows*>(context);
  rows.view.j = j;
  rows.visit(rows.context, rows.view);
}

// Rows of at most kMaxLanes whole grids, each as a run from its place on.
struct Runs {
  const Grid* first;
  Vertex* const* places;
  Stores stores;
  std::array<LineStream, kMaxLanes> lines = {};

  static void visit(void* context, const RowView& view) {
    Runs& runs = *static_cast<Runs*>(context);
    const auto length = static_cast<std::size_t>(side(view.depth));
    const auto first_grid = static_cast<std::size_t>(view.grids.data() - runs.first);
    for (std::size_t lane = 0; lane < view.grids.size(); ++lane) {
      Vertex* const to = runs.places[first_grid + lane];
      const Vertex* const row = view.vertices(lane);
      if (runs.stores == Stores::kOrdinary) {
        std::copy_n(row, length, to + static_cast<std::size_t>(view.j) * length);
        continue;
      }
      LineStream& lines = runs.lines[lane];
      if (view.j == 0) lines.start(reinterpret_cast<std::byte*>(to));
      lines.append(reinterpret_cast<const std::byte*>(row), length * sizeof(Vertex));
      if (view.j + 1 == side(view.depth)) lines.finish();
    }
  }
};

// write(grids, places) for at most kMaxLanes grids at a time, which lie one after the other.
template <class Write>
void one_after_the_other(std::span<const Grid> grids, int depth, Vertex* out, const Write& write) {
  const auto length = static_cast<std::size_t>(side(depth)), size = length * length;
  std::array<Vertex*, kMaxLanes> places;
  while (!grids.empty()) {
    const std::size_t count = std::min(grids.size(), places.size());
    for (std::size_t k = 0; k < count; ++k) places[k] = out + k * size;
    write(grids.first(count), places.data());
    grids = grids.subspan(count), out += count * size;
  }
}

}  // namespace

void AlignedFloats::Free::operator()(float* p) const {
  std::free(p);
}

void AlignedFloats::grow(std::size_t count) {
  if (count <= size_) return;
  const std::size_t bytes = (4 * count + kLine - 1) / kLine * kLine;
  auto* p = static_cast<float*>(std::aligned_alloc(kLine, bytes));
  if (!p) throw std::bad_alloc();
  std::memset(p, 0, bytes);
  data_.reset(p);
  size_ = count;
}

void Workspace::prepare(int depth, int lanes) {
  const auto n = static_cast<std::size_t>(lanes);
  input.grow(n * static_cast<std::size_t>(input_size(checked(depth))));
  work.grow(n * static_cast<std::size_t>(work_size(depth)));
}

RowBuffer RowBuffer::in(AlignedFloats& memory, int depth, int lanes, Kept kept) {
  // A whole number of cache lines.
  const std::size_t pitch = (6 * static_cast<std::size_t>(side(depth)) + 15) / 16 * 16;
  const std::size_t row = static_cast<std::size_t>(lanes) * pitch;
  memory.grow(kept == Kept::kTwoRows ? 2 * row : row);
  return {memory.data(), static_cast<std::ptrdiff_t>(pitch), static_cast<std::ptrdiff_t>(row),
          static_cast<int>(kept)};
}

RowStream::RowStream(const data::ControlMesh& mesh, const Adjacency& adjacency, const Kernel& kernel)
    : adjacency_(adjacency), kernel_(kernel), rings_(mesh, adjacency) {}

RowStream::RowStream(const TriangleMesh& mesh, const Kernel& kernel)
    : adjacency_(mesh.adjacency()),
      kernel_(kernel),
      rings_(mesh.points(), mesh.adjacency(), mesh.kinds()),
      cut_(mesh.is_cut() ? std::make_shared<const CutGrids>(mesh) : nullptr) {}

template <class T>
std::size_t RowStream::together(std::span<const T> list, std::size_t most) const {
  std::size_t count = std::min(most, list.size());
  if (!cut_) return count;
  const auto alone = [&](const T& of) { return cut_->touches(of); };
  return std::max<std::ptrdiff_t>(1, std::find_if(list.begin(), list.begin() + count, alone) - list.begin());
}

template std::size_t RowStream::together(std::span<const Grid> list, std::size_t most) const;

void RowStream::move_points(const TriangleMesh& mesh) {
  rings_.move_points(adjacency_, place<float>(mesh.points()));
  if (cut_) cut_ = std::make_shared<const CutGrids>(mesh);
}

void RowStream::rows(std::span<const Grid> grids, int depth, Workspace& workspace,
                     void (*visit)(void*, const RowView&), void* context, Order order, Kept kept) const {
  batches(kernel_, grids, depth, workspace, visit, context, order, kept);
}

void RowStream::batches(const Kernel& kernel, std::span<const Grid> grids, int depth, Workspace& workspace,
                        void (*visit)(void*, const RowView&), void* context, Order order, Kept kept) const {
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  workspace.prepare(depth, kernel.lanes);
  Rows rows{{{}, depth, 0, RowBuffer::in(workspace.row, depth, kernel.lanes, kept)}, visit, context};
  const RowBuffer& buffer = rows.view.rows;
  const Target<float> target{buffer.base, buffer.pitch, buffer.stride, visit ? &visit_row : nullptr,
                             &rows,       buffer.mask};
  std::optional<CutGridEvaluator> alone;
  std::vector<Vertex> along;
  for (std::size_t first = 0; first < grids.size(); first += rows.view.grids.size()) {
    rows.view.grids = grids.subspan(first, together(grids.subspan(first), lanes));
    if (cut_ && cut_->touches(grids[first])) {
      if (!alone) alone.emplace(*cut_, rings_, depth);
      const GridEdges on(adjacency_, grids[first], order);
      const auto n = static_cast<std::size_t>(side(depth));
      along.resize(GridEdges::kCount * n);
      for (std::size_t k = 0; k < GridEdges::kCount; ++k)
        if (on.of[k] >= 0 && !cut_->touches(on.of[k]))
          edges({&on.of[k], 1}, depth, workspace, along.data() + k * n, &kernel);
      alone->grid(grids[first], order, along.data(), target);
      continue;
    }
    gather(adjacency_, rings_, rows.view.grids, depth, kernel.lanes, workspace.input.data(), order);
    kernel.run(workspace.input.data(), depth, rings_.placement(), workspace.work.data(), target);
  }
}

void RowStream::whole(std::span<const Grid> grids, int depth, Workspace& workspace, Vertex* out,
                      const Kernel* other) const {
  const Kernel& kernel = other != nullptr ? *other : kernel_;
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  const auto grid_size = static_cast<std::size_t>(side(depth)) * static_cast<std::size_t>(side(depth));
  workspace.prepare(depth, kernel.lanes);

  const std::size_t full = cut_ ? 0 : grids.size() / lanes * lanes;
  for (std::size_t first = 0; first < full; first += lanes) {
    gather(adjacency_, rings_, grids.subspan(first, lanes), depth, kernel.lanes, workspace.input.data(),
           Order::kFromA);
    const Target<float> target{&out[first * grid_size].position.x, 6 * static_cast<std::ptrdiff_t>(grid_size),
                               6 * side(depth), nullptr, nullptr};
    kernel.run(workspace.input.data(), depth, rings_.placement(), workspace.work.data(), target);
  }
  // The lanes beyond the last grid write too, but not into the caller's memory.
  struct Rest {
    const Grid* grids;
    Vertex* out;
  } rest{grids.data() + full, out + full * grid_size};
  batches(
      kernel, grids.subspan(full), depth, workspace,
      [](void* context, const RowView& view) {
        const Rest& to = *static_cast<const Rest*>(context);
        const auto n = static_cast<std::size_t>(side(view.depth)), j = static_cast<std::size_t>(view.j);
        for (std::size_t lane = 0; lane < view.grids.size(); ++lane) {
          const auto grid = static_cast<std::size_t>(&view.grids[lane] - to.grids);
          std::copy_n(view.vertices(lane), n, to.out + (grid * n + j) * n);
        }
      },
      &rest, Order::kFromA, Kept::kOneRow);
}

void RowStream::edges(std::span<const std::int32_t> half_edges, int depth, Workspace& workspace, Vertex* out,
                      const Kernel* other) const {
  const Kernel& kernel = other != nullptr ? *other : kernel_;
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  const auto length = static_cast<std::size_t>(side(depth));
  workspace.input.grow(lanes * static_cast<std::size_t>(edge_input_size(checked(depth))));
  workspace.work.grow(lanes * static_cast<std::size_t>(edge_work_size(depth)));
  const RowBuffer rest = RowBuffer::in(workspace.row, depth, kernel.lanes, Kept::kOneRow);

  std::optional<CutGridEvaluator> alone;
  std::size_t first = 0;
  for (std::span<const std::int32_t> batch; first < half_edges.size(); first += batch.size()) {
    batch = half_edges.subspan(first, together(half_edges.subspan(first), lanes));
    if (cut_ && cut_->touches(batch.front())) {
      if (!alone) alone.emplace(*cut_, rings_, depth);
      alone->edge(batch.front(), out + first * length);
      continue;
    }
    gather_edges(adjacency_, rings_, batch, depth, kernel.lanes, workspace.input.data());
    // The lanes beyond the last edge write too, but not into the caller's memory.
    const bool full = batch.size() == lanes;
    Vertex* to = out + first * length;
    kernel.run_edges(workspace.input.data(), depth, rings_.placement(), workspace.work.data(),
                     full ? &to->position.x : rest.base,
                     full ? 6 * static_cast<std::ptrdiff_t>(length) : rest.pitch);
    for (std::size_t e = 0; e < batch.size() && !full; ++e)
      std::copy_n(rest.row(e, 0), length, to + e * length);
  }
}

void RowStream::put(std::span<const Grid> grids, int depth, Workspace& workspace, Vertex* const* places,
                    Order order, Stores stores) const {
  workspace.prepare(depth, kernel_.lanes);
  const auto lanes = static_cast<std::size_t>(kernel_.lanes);
  std::size_t count = 0;
  for (; !grids.empty(); grids = grids.subspan(count), places += count) {
    count = together(grids, lanes);
    const std::span<const Grid> batch = grids.first(count);
    if (kernel_.run_lines == nullptr || (cut_ && cut_->touches(batch.front()))) {
      Runs runs{batch.data(), places, stores};
      rows(batch, depth, workspace, &Runs::visit, &runs, order);
      continue;
    }
    std::array<float*, kMaxLanes> lane;  // those beyond the last grid repeat it, place and all
    for (std::size_t k = 0; k < lanes; ++k) lane[k] = &places[std::min(k, count - 1)]->position.x;
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

}  // namespace limitcheck::fast::row_stream
