// SPDX-License-Identifier: MIT
#include "fast/stream/row_stream.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>

#include "fast/stream/gather/alone.h"
#include "fast/stream/host/rows.h"

namespace limitcheck::fast::row_stream {

void AlignedFloats::Free::operator()(float* p) const {
  std::free(p);
}

void AlignedFloats::grow(std::size_t count) {
  if (count <= size_) return;
  constexpr std::size_t kCacheLine = 64;
  const std::size_t bytes = (4 * count + kCacheLine - 1) / kCacheLine * kCacheLine;
  auto* p = static_cast<float*>(std::aligned_alloc(kCacheLine, bytes));
  if (!p) throw std::bad_alloc();
  std::memset(p, 0, bytes);
  data_.reset(p);
  size_ = count;
}

void Workspace::grow(int input_size, int work_size, int lanes) {
  input.grow(static_cast<std::size_t>(lanes * input_size));
  work.grow(static_cast<std::size_t>(lanes * work_size));
}

void Workspace::prepare(int depth, int lanes) {
  grow(input_size(checked(depth)), work_size(depth), lanes);
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
  RowVisitor<RowView> rows{
      {{depth, 0, RowBuffer::in(workspace.row, depth, kernel.lanes, kept)}, {}, 0}, visit, context};
  RowView& view = rows.view;
  const Target<float> target{view.rows.base, view.rows.pitch, view.rows.stride,
                             rows.call(),    &rows,           view.rows.mask};
  std::optional<AloneEvaluator<CutGrids>> alone;
  for (view.first = 0; view.first < grids.size(); view.first += view.size()) {
    view.grids = grids.subspan(view.first, together(grids.subspan(view.first), lanes));
    if (cut_ && cut_->touches(view.grids.front())) {
      if (!alone) alone.emplace(*cut_, rings_, depth);
      alone->grid(view.grids.front(), order, target, [&](std::int32_t h, Vertex* out) {
        edges({&h, 1}, depth, workspace, out, &kernel);
      });
      continue;
    }
    gather(adjacency_, rings_, view.grids, depth, kernel.lanes, workspace.input.data(), order);
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
  const auto at = one_after_the_other(out + full * grid_size, depth);
  Runs<RowView, decltype(at)> rest{at, Stores::kOrdinary};
  batches(kernel, grids.subspan(full), depth, workspace, &rest.visit, &rest, Order::kFromA, Kept::kOneRow);
}

void RowStream::edges(std::span<const std::int32_t> half_edges, int depth, Workspace& workspace, Vertex* out,
                      const Kernel* other) const {
  const Kernel& kernel = other != nullptr ? *other : kernel_;
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  const auto length = static_cast<std::size_t>(side(depth));
  workspace.grow(edge_input_size(checked(depth)), edge_work_size(depth), kernel.lanes);
  const RowBuffer rest = RowBuffer::in(workspace.row, depth, kernel.lanes, Kept::kOneRow);

  std::optional<AloneEvaluator<CutGrids>> alone;
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

template <class At>
void RowStream::put_at(const At& at, std::span<const Grid> grids, int depth, Workspace& workspace,
                       Order order, Stores stores) const {
  workspace.prepare(depth, kernel_.lanes);
  const auto lanes = static_cast<std::size_t>(kernel_.lanes);
  std::size_t first = 0;
  for (std::span<const Grid> batch; first < grids.size(); first += batch.size()) {
    batch = grids.subspan(first, together(grids.subspan(first), lanes));
    if (kernel_.run_lines == nullptr || (cut_ && cut_->touches(batch.front()))) {
      const auto place = [&](std::size_t i) { return at(first + i); };
      Runs<RowView, decltype(place)> runs{place, stores};
      rows(batch, depth, workspace, &runs.visit, &runs, order);
      continue;
    }
    std::array<float*, kMaxLanes> lane;  // those beyond the last grid repeat it, place and all
    for (std::size_t k = 0; k < lanes; ++k) lane[k] = &at(first + std::min(k, batch.size() - 1))->position.x;
    gather(adjacency_, rings_, batch, depth, kernel_.lanes, workspace.input.data(), order);
    kernel_.run_lines(workspace.input.data(), depth, rings_.placement(), workspace.work.data(), lane.data(),
                      stores);
  }
}

void RowStream::put(std::span<const Grid> grids, int depth, Workspace& workspace, Vertex* const* places,
                    Order order, Stores stores) const {
  put_at([&](std::size_t i) { return places[i]; }, grids, depth, workspace, order, stores);
}

void RowStream::streamed(std::span<const Grid> grids, int depth, Workspace& workspace, Vertex* out) const {
  put_at(one_after_the_other(out, depth), grids, depth, workspace, Order::kFromA, Stores::kPastCaches);
  fence(Stores::kPastCaches);
}

}  // namespace limitcheck::fast::row_stream
