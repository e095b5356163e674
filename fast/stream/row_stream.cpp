// SPDX-License-Identifier: MIT
#include "fast/stream/row_stream.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

#include "data/error.h"

namespace limitcheck::fast::row_stream {

namespace {

constexpr std::size_t kLine = 64;

int checked(int depth) {
  if (depth < 0 || depth > kMaxDepth) throw data::ArgumentError("row streaming: depth is 0 to 10");
  return depth;
}

void prepare(Workspace& workspace, int depth, int lanes) {
  const auto n = static_cast<std::size_t>(lanes);
  workspace.input.grow(n * static_cast<std::size_t>(input_size(checked(depth))));
  workspace.work.grow(n * static_cast<std::size_t>(work_size(depth)));
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

RowBuffer RowBuffer::in(AlignedFloats& memory, int depth, int lanes, Kept kept) {
  // A whole number of cache lines.
  const std::size_t pitch = (6 * static_cast<std::size_t>(side(depth)) + 15) / 16 * 16;
  const std::size_t row = static_cast<std::size_t>(lanes) * pitch;
  memory.grow(kept == Kept::kTwoRows ? 2 * row : row);
  return {memory.data(), static_cast<std::ptrdiff_t>(pitch), static_cast<std::ptrdiff_t>(row),
          static_cast<int>(kept)};
}

RowStream::RowStream(const data::ControlMesh& mesh, const Adjacency& adjacency, const Kernel& kernel,
                     VertexKinds kinds)
    : adjacency_(adjacency), kernel_(kernel), rings_(mesh, adjacency, kinds) {}

void RowStream::move_points(const data::ControlMesh& mesh) {
  rings_.move_points(adjacency_, place<float>(mesh));
}

void RowStream::rows(std::span<const Grid> grids, int depth, Workspace& workspace,
                     void (*visit)(void*, const RowView&), void* context, Order order, Kept kept) const {
  batches(kernel_, grids, depth, workspace, visit, context, order, kept);
}

void RowStream::batches(const Kernel& kernel, std::span<const Grid> grids, int depth, Workspace& workspace,
                        void (*visit)(void*, const RowView&), void* context, Order order, Kept kept) const {
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  prepare(workspace, depth, kernel.lanes);
  Rows rows{{{}, depth, 0, RowBuffer::in(workspace.row, depth, kernel.lanes, kept)}, visit, context};
  const RowBuffer& buffer = rows.view.rows;
  const Target<float> target{buffer.base, buffer.pitch, buffer.stride, visit ? &visit_row : nullptr,
                             &rows,       buffer.mask};
  for (std::size_t first = 0; first < grids.size(); first += lanes) {
    rows.view.grids = grids.subspan(first, std::min(lanes, grids.size() - first));
    gather(adjacency_, rings_, rows.view.grids, depth, kernel.lanes, workspace.input.data(), order);
    kernel.run(workspace.input.data(), depth, rings_.placement(), workspace.work.data(), target);
  }
}

void RowStream::whole(std::span<const Grid> grids, int depth, Workspace& workspace, Vertex* out,
                      const Kernel* other) const {
  const Kernel& kernel = other != nullptr ? *other : kernel_;
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  const auto grid_size = static_cast<std::size_t>(side(depth)) * static_cast<std::size_t>(side(depth));
  prepare(workspace, depth, kernel.lanes);

  const std::size_t full = grids.size() / lanes * lanes;
  for (std::size_t first = 0; first < full; first += lanes) {
    gather(adjacency_, rings_, grids.subspan(first, lanes), depth, kernel.lanes, workspace.input.data(),
           Order::kFromA);
    const Target<float> target{out[first * grid_size].position, 6 * static_cast<std::ptrdiff_t>(grid_size),
                               6 * side(depth), nullptr, nullptr};
    kernel.run(workspace.input.data(), depth, rings_.placement(), workspace.work.data(), target);
  }
  // The lanes beyond the last grid write too, but not into the caller's memory.
  Vertex* rest = out + full * grid_size;
  batches(
      kernel, grids.subspan(full), depth, workspace,
      [](void* context, const RowView& view) {
        const auto n = static_cast<std::size_t>(side(view.depth));
        for (std::size_t lane = 0; lane < view.grids.size(); ++lane)
          std::memcpy(static_cast<Vertex*>(context) + (lane * n + static_cast<std::size_t>(view.j)) * n,
                      view.vertices(lane), n * sizeof(Vertex));
      },
      rest, Order::kFromA, Kept::kOneRow);
}

void RowStream::edges(std::span<const std::int32_t> half_edges, int depth, Workspace& workspace, Vertex* out,
                      const Kernel* other) const {
  const Kernel& kernel = other != nullptr ? *other : kernel_;
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  const auto length = static_cast<std::size_t>(side(depth));
  workspace.input.grow(lanes * static_cast<std::size_t>(edge_input_size(checked(depth))));
  workspace.work.grow(lanes * static_cast<std::size_t>(edge_work_size(depth)));
  const RowBuffer rest = RowBuffer::in(workspace.row, depth, kernel.lanes, Kept::kOneRow);

  for (std::size_t first = 0; first < half_edges.size(); first += lanes) {
    const auto batch = half_edges.subspan(first, std::min(lanes, half_edges.size() - first));
    gather_edges(adjacency_, rings_, batch, depth, kernel.lanes, workspace.input.data());
    // The lanes beyond the last edge write too, but not into the caller's memory.
    const bool full = batch.size() == lanes;
    Vertex* to = out + first * length;
    kernel.run_edges(workspace.input.data(), depth, rings_.placement(), workspace.work.data(),
                     full ? to->position : rest.base,
                     full ? 6 * static_cast<std::ptrdiff_t>(length) : rest.pitch);
    for (std::size_t e = 0; e < batch.size() && !full; ++e)
      std::memcpy(to + e * length, rest.row(e, 0), length * sizeof(Vertex));
  }
}

}  // namespace limitcheck::fast::row_stream
