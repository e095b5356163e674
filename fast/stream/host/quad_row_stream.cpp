// SPDX-License-Identifier: MIT
#include "fast/stream/quad_row_stream.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "fast/stream/gather/alone.h"
#include "fast/stream/gather/quad_batch.h"
#include "fast/stream/host/rows.h"

namespace limitcheck::fast::row_stream {

namespace {

void prepare(Workspace& workspace, int depth, int lanes) {
  workspace.grow(quad_input_size(checked(depth)), quad_work_size(depth), lanes);
}

/// The quads of a list that wait for others of their class.
class Queue {
 public:
  /// run(kind, indices) for batches of up to `lanes` quads of one class; those next to something semi-sharp
  /// come one by one.
  template <class Run>
  static void go(const QuadRings& rings, std::span<const std::int32_t> faces, int lanes, const Run& run) {
    std::array<Queue, 4> queues;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const QuadClass kind = rings.kind(faces[i]);
      Queue& queue = queues[static_cast<std::size_t>(kind)];
      queue.index_[queue.count_++] = static_cast<std::uint32_t>(i);
      if (queue.count_ == static_cast<std::size_t>(kind == QuadClass::kSemiSharp ? 1 : lanes))
        queue.empty(kind, run);
    }
    for (const QuadClass kind : {QuadClass::kRegular, QuadClass::kClosed, QuadClass::kOpen}) {
      Queue& queue = queues[static_cast<std::size_t>(kind)];
      if (queue.count_ > 0) queue.empty(kind, run);
    }
  }

 private:
  template <class Run>
  void empty(QuadClass kind, const Run& run) {
    run(kind, std::span<const std::uint32_t>(index_.data(), count_));
    count_ = 0;
  }
  std::array<std::uint32_t, kMaxLanes> index_;
  std::size_t count_ = 0;
};

// The points of some sides, those of half_edges[e] to out[e].
void evaluate_sides(const QuadRings& rings, const QuadKernel& kernel,
                    std::span<const std::int32_t> half_edges, int depth, Workspace& workspace,
                    Vertex* const* out) {
  std::array<float*, kMaxLanes> lane;
  for (std::size_t k = 0; k < lane.size(); ++k)
    lane[k] = &out[std::min(k, half_edges.size() - 1)]->position.x;
  const auto batch = gather_sides<float>(rings, half_edges, depth, kernel.lanes, workspace.input.data());
  kernel.sides(batch, rings.placement(), workspace.work.data(), {lane.data(), 0, nullptr, nullptr});
}

struct Evaluation {
  const QuadRings& rings;
  const SemiSharpQuads* semi_sharp;
  const QuadKernel& kernel;
  std::span<const std::int32_t> faces;
  int depth;
  Workspace& workspace;
  Order order = Order::kFromA;
  std::optional<AloneEvaluator<SemiSharpQuads>> alone = {};

  void run(QuadClass kind, std::span<const std::uint32_t> index, const QuadTarget<float>& target) {
    if (kind == QuadClass::kSemiSharp) return run_alone(faces[index.front()], target);
    (kind == QuadClass::kRegular ? kernel.patches : kernel.quads)(gathered(kind, index), rings.placement(),
                                                                  workspace.work.data(), target);
  }
  /// Each quad to its place at(i), in whole cache lines if the kernel has them and `stores` is given.
  template <class At>
  void to_places(const At& at, std::optional<Stores> stores) {
    const auto n = static_cast<std::ptrdiff_t>(side(depth));
    std::array<float*, kMaxLanes> lane;  // those beyond the last quad repeat it, place and all
    const QuadTarget<float> target{lane.data(), 6 * n, nullptr, nullptr};
    Queue::go(rings, faces, kernel.lanes, [&](QuadClass kind, std::span<const std::uint32_t> index) {
      for (std::size_t k = 0; k < lane.size(); ++k)
        lane[k] = &at(index[std::min(k, index.size() - 1)])->position.x;
      if (!stores || !kernel.quad_lines || kind == QuadClass::kSemiSharp) return run(kind, index, target);
      (kind == QuadClass::kRegular ? kernel.patch_lines : kernel.quad_lines)(
          gathered(kind, index), rings.placement(), workspace.work.data(), lane.data(), *stores);
    });
  }

 private:
  QuadBatch<float> gathered(QuadClass kind, std::span<const std::uint32_t> index) {
    std::array<std::int32_t, kMaxLanes> face;
    for (std::size_t k = 0; k < index.size(); ++k) face[k] = faces[index[k]];
    const std::span<const std::int32_t> some(face.data(), index.size());
    const auto gather = kind == QuadClass::kRegular ? gather_patches<float> : gather_quads<float>;
    return gather(rings, some, depth, kernel.lanes, workspace.input.data(), order);
  }

  void run_alone(std::int32_t face, const QuadTarget<float>& target) {
    if (!alone) alone.emplace(*semi_sharp, rings, depth);
    alone->grid(face, order, target, [&](std::int32_t h, Vertex* out) {
      evaluate_sides(rings, kernel, {&h, 1}, depth, workspace, &out);
    });
  }
};

}  // namespace

QuadRowStream::QuadRowStream(const QuadMesh& mesh, const QuadKernel& kernel)
    : kernel_(kernel),
      rings_(mesh),
      semi_sharp_(mesh.semi_sharp() ? std::make_shared<const SemiSharpQuads>(mesh) : nullptr) {}

std::vector<std::int32_t> QuadRowStream::sorted(std::span<const std::int32_t> faces) const {
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys;  // by class and valences
  keys.reserve(faces.size());
  for (const std::int32_t f : faces) {
    auto key = static_cast<std::uint64_t>(rings_.kind(f));
    for (int k = 0; k < 4; ++k)
      key = key << 12 | static_cast<std::uint64_t>(std::min(rings_.corner(4 * f + k).entries, 4095));
    keys.emplace_back(key, f);
  }
  std::stable_sort(keys.begin(), keys.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::int32_t> order;
  order.reserve(faces.size());
  for (const auto& key : keys) order.push_back(key.second);
  return order;
}

void QuadRowStream::rows(std::span<const std::int32_t> faces, int depth, Workspace& workspace,
                         void (*visit)(void*, const QuadRowView&), void* context, Order order,
                         Kept kept) const {
  prepare(workspace, depth, kernel_.lanes);
  RowVisitor<QuadRowView> rows{
      {{depth, 0, RowBuffer::in(workspace.row, depth, kernel_.lanes, kept)}, {}}, visit, context};
  const RowBuffer& buffer = rows.view.rows;
  std::array<float*, kMaxLanes> lane;
  for (int k = 0; k < kMaxLanes; ++k) lane[k] = buffer.base + std::min(k, kernel_.lanes - 1) * buffer.pitch;
  const QuadTarget<float> target{lane.data(), buffer.stride, rows.call(), &rows, buffer.mask};
  Evaluation evaluation{rings_, semi_sharp_.get(), kernel_, faces, depth, workspace, order};
  Queue::go(rings_, faces, kernel_.lanes, [&](QuadClass kind, std::span<const std::uint32_t> index) {
    rows.view.index = index;
    evaluation.run(kind, index, target);
  });
}

void QuadRowStream::whole(std::span<const std::int32_t> faces, int depth, Workspace& workspace, Vertex* out,
                          const QuadKernel* other) const {
  const QuadKernel& kernel = other != nullptr ? *other : kernel_;
  prepare(workspace, depth, kernel.lanes);
  Evaluation evaluation{rings_, semi_sharp_.get(), kernel, faces, depth, workspace};
  evaluation.to_places(one_after_the_other(out, depth), std::nullopt);
}

void QuadRowStream::put(std::span<const std::int32_t> faces, int depth, Workspace& workspace,
                        Vertex* const* places, Order order, Stores stores) const {
  put_at([&](std::size_t i) { return places[i]; }, faces, depth, workspace, order, stores);
}

void QuadRowStream::streamed(std::span<const std::int32_t> faces, int depth, Workspace& workspace,
                             Vertex* out) const {
  prepare(workspace, depth, kernel_.lanes);
  put_at(one_after_the_other(out, depth), faces, depth, workspace, Order::kFromA, Stores::kPastCaches);
  fence(Stores::kPastCaches);
}

template <class At>
void QuadRowStream::put_at(const At& at, std::span<const std::int32_t> faces, int depth, Workspace& workspace,
                           Order order, Stores stores) const {
  if (stores == Stores::kPastCaches && !kernel_.quad_lines) {
    Runs<QuadRowView, At> runs{at, stores};
    return rows(faces, depth, workspace, &runs.visit, &runs, order);
  }
  prepare(workspace, depth, kernel_.lanes);
  Evaluation evaluation{rings_, semi_sharp_.get(), kernel_, faces, depth, workspace, order};
  evaluation.to_places(at, stores);
}

void QuadRowStream::edges(std::span<const std::int32_t> half_edges, int depth, Workspace& workspace,
                          Vertex* out, const QuadKernel* other) const {
  const QuadKernel& kernel = other != nullptr ? *other : kernel_;
  prepare(workspace, depth, kernel.lanes);
  const auto lanes = static_cast<std::size_t>(kernel.lanes), n = static_cast<std::size_t>(side(depth));
  std::optional<AloneEvaluator<SemiSharpQuads>> alone;
  std::array<std::int32_t, kMaxLanes> some;
  std::array<Vertex*, kMaxLanes> to;
  std::size_t count = 0;
  for (std::size_t e = 0; e < half_edges.size(); ++e) {
    const std::int32_t h = half_edges[e];
    if (rings_.touches_semi_sharp(h)) {
      if (!alone) alone.emplace(*semi_sharp_, rings_, depth);
      alone->edge(h, out + n * e);
    } else {
      some[count] = h, to[count] = out + n * e, ++count;
    }
    if (count == lanes || (count > 0 && e + 1 == half_edges.size())) {
      evaluate_sides(rings_, kernel, {some.data(), count}, depth, workspace, to.data());
      count = 0;
    }
  }
}

}  // namespace limitcheck::fast::row_stream
