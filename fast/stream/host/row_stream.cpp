// SPDX-License-Identifier: MIT
#include "fast/stream/row_stream.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>
#include <utility>

#include "data/error.h"
#include "fast/stream/gather/alone.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/kernel/output_targets.h"

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

RowBuffer RowBuffer::in(AlignedFloats& memory, int depth, int lanes, Kept kept) {
  // A whole number of cache lines.
  const std::size_t pitch = (6 * static_cast<std::size_t>(side(depth)) + 15) / 16 * 16;
  const std::size_t row = static_cast<std::size_t>(lanes) * pitch;
  memory.grow(kept == Kept::kTwoRows ? 2 * row : row);
  return {memory.data(), static_cast<std::ptrdiff_t>(pitch), static_cast<std::ptrdiff_t>(row),
          static_cast<int>(kept)};
}

namespace {

int checked(int depth) {
  if (depth < 0 || depth > kMaxDepth) throw data::ArgumentError("row streaming: depth is 0 to 10");
  return depth;
}

// What is evaluated together: items of one class, and which of the caller's list they are.
template <class T>
struct Batch {
  QuadClass kind;
  std::span<const T> items;
  std::size_t first;
  const std::uint32_t* index = nullptr;

  bool alone() const { return kind == QuadClass::kSemiSharp; }
  bool regular() const { return kind == QuadClass::kRegular; }
  std::size_t number(std::size_t lane) const { return index != nullptr ? index[lane] : first + lane; }
};

// One for each lane; those beyond the last item repeat it.
using LanePlaces = std::array<float*, kMaxLanes>;
template <class At>
LanePlaces places_of(std::size_t items, const At& at) {
  LanePlaces lane;
  for (std::size_t k = 0; k < lane.size(); ++k) lane[k] = &at(std::min(k, items - 1))->position.x;
  return lane;
}

// Where item i begins.
auto one_after_the_other(Vertex* out, int depth) {
  const auto n = static_cast<std::size_t>(side(depth));
  return [out, size = n * n](std::size_t i) { return out + i * size; };
}

// What a call of a stream works with.
template <class Scheme>
struct CallOf {
  using Items = Batch<typename Scheme::Item>;

  const typename Scheme::Kernel& kernel;
  const typename Scheme::Rings& rings;
  const typename Scheme::Alone* touched;
  int depth;
  Workspace& workspace;
  Order order = Order::kFromA;

  float* input() const { return workspace.input.data(); }
  float* work() const { return workspace.work.data(); }
  void grow(int input_size, int work_size) const { workspace.grow(input_size, work_size, kernel.lanes); }

  // body(batch) for items or half-edges of one class; those that something alone touches come one by one. What fills the
  // lanes and lies side by side stays where it is.
  template <class T, class KindOf, class Body>
  void by_class(std::span<const T> list, const KindOf& kind_of, const Body& body) const {
    struct Queue {
      std::array<T, kMaxLanes> items;
      std::array<std::uint32_t, kMaxLanes> index;
      std::size_t count = 0;
    };
    std::array<Queue, 4> queues;
    const auto lanes = static_cast<std::size_t>(kernel.lanes);
    const auto empty = [&](QuadClass kind, Queue& queue) {
      body(Batch<T>{kind, {queue.items.data(), queue.count}, 0, queue.index.data()});
      queue.count = 0;
    };
    for (std::size_t i = 0, end = 0; i < list.size(); i = end) {
      const QuadClass kind = kind_of(list[i]);
      const std::size_t most = kind == QuadClass::kSemiSharp ? 1 : lanes;
      for (end = i + 1; end < list.size() && end - i < most && kind_of(list[end]) == kind;) ++end;
      if (end - i == most) {
        body(Batch<T>{kind, list.subspan(i, most), i});
        continue;
      }
      Queue& queue = queues[static_cast<std::size_t>(kind)];
      for (; i < end; ++i) {
        queue.items[queue.count] = list[i];
        queue.index[queue.count++] = static_cast<std::uint32_t>(i);
        if (queue.count == lanes) empty(kind, queue);
      }
    }
    for (const QuadClass kind : {QuadClass::kRegular, QuadClass::kClosed, QuadClass::kOpen})
      if (Queue& queue = queues[static_cast<std::size_t>(kind)]; queue.count > 0) empty(kind, queue);
  }
};

// And how the schemes differ in that.
template <class Scheme>
struct Call;

template <>
struct Call<LoopStreams> : CallOf<LoopStreams> {
  void prepare() const { grow(input_size(checked(depth)), work_size(depth)); }
  void prepare_edges() const { grow(edge_input_size(checked(depth)), edge_work_size(depth)); }

  bool has_polynomials() const { return kernel.run_patches != nullptr; }
  QuadClass kind_of(const Grid& grid) const {
    if (touched != nullptr && touched->touches(grid)) return QuadClass::kSemiSharp;
    const bool regular = has_polynomials() && regular_edges(rings, grid, depth) == kAllEdges;
    return regular ? QuadClass::kRegular : QuadClass::kOpen;
  }
  QuadClass kind_of_edge(std::int32_t h) const {
    return touched != nullptr && touched->touches(h) ? QuadClass::kSemiSharp : QuadClass::kOpen;
  }
  // Whether the kernel can write straight to these places: its lanes lie at equal distances, and all of them write.
  bool takes(const LanePlaces& lane, std::size_t count) const {
    if (count != static_cast<std::size_t>(kernel.lanes)) return false;
    for (std::size_t k = 2; k < count; ++k)
      if (lane[k] - lane[k - 1] != lane[1] - lane[0]) return false;
    return true;
  }

  BatchPlacement<float> gathered(const Items& batch) const {
    if (batch.regular()) return gather_regular(rings, batch.items, kernel.lanes, input(), order);
    return gather(rings, batch.items, depth, kernel.lanes, input(), order, edges_by());
  }
  void run(const Items& batch, const QuadTarget<float>& to) const {
    const Target<float> target{to.lane[0], to.lane[1] - to.lane[0], to.row_stride, to.row, to.context,
                               to.row_mask};
    (batch.regular() ? kernel.run_patches : kernel.run)(input(), depth, gathered(batch), work(), target);
  }
  void run_lines(const Items& batch, float* const* lane, Stores stores) const {
    (batch.regular() ? kernel.patch_lines : kernel.run_lines)(input(), depth, gathered(batch), work(), lane,
                                                              stores);
  }
  // Edge e to at(e).
  template <class At>
  void run_edges(std::span<const std::int32_t> half_edges, const At& at) const {
    const auto placement = gather_edges(rings, half_edges, depth, kernel.lanes, input(), edges_by());
    const LanePlaces lane = places_of(half_edges.size(), at);
    const bool straight = takes(lane, half_edges.size());
    const RowBuffer rest = RowBuffer::in(workspace.row, depth, kernel.lanes, Kept::kOneRow);
    kernel.run_edges(input(), depth, placement, work(), straight ? lane[0] : rest.base,
                     straight ? lane[1] - lane[0] : rest.pitch);
    for (std::size_t e = 0; e < half_edges.size() && !straight; ++e)
      std::copy_n(rest.row(e, 0), side(depth), at(e));
  }

 private:
  Edges edges_by() const { return has_polynomials() ? Edges::kRegularByPolynomials : Edges::kAllStreamed; }
};

template <>
struct Call<QuadStreams> : CallOf<QuadStreams> {
  void prepare() const { grow(quad_input_size(checked(depth)), quad_work_size(depth)); }
  void prepare_edges() const { prepare(); }

  QuadClass kind_of(std::int32_t face) const { return rings.kind(face); }
  QuadClass kind_of_edge(std::int32_t h) const {
    return rings.touches_semi_sharp(h) ? QuadClass::kSemiSharp : QuadClass::kOpen;
  }
  static bool takes(const LanePlaces& /*lane*/, std::size_t /*count*/) { return true; }

  QuadBatch<float> gathered(const Items& batch) const {
    const auto gather = batch.regular() ? gather_patches<float> : gather_quads<float>;
    return gather(rings, batch.items, depth, kernel.lanes, input(), order);
  }
  void run(const Items& batch, const QuadTarget<float>& to) const {
    (batch.regular() ? kernel.patches : kernel.quads)(gathered(batch), rings.placement(), work(), to);
  }
  void run_lines(const Items& batch, float* const* lane, Stores stores) const {
    (batch.regular() ? kernel.patch_lines : kernel.quad_lines)(gathered(batch), rings.placement(), work(),
                                                               lane, stores);
  }
  template <class At>
  void run_edges(std::span<const std::int32_t> half_edges, const At& at) const {
    const LanePlaces lane = places_of(half_edges.size(), at);
    const auto batch = gather_sides<float>(rings, half_edges, depth, kernel.lanes, input());
    kernel.sides(batch, rings.placement(), work(), {lane.data(), 0, nullptr, nullptr});
  }
};

// The rows of batches in a buffer, and what a kernel calls after each.
class Rows {
 public:
  template <class C>
  Rows(const C& call, Kept kept, void (*visit)(void*, const RowView&), void* context)
      : view_{call.depth, 0, RowBuffer::in(call.workspace.row, call.depth, call.kernel.lanes, kept)},
        visit_(visit),
        context_(context) {
    const auto last = static_cast<std::ptrdiff_t>(call.kernel.lanes - 1);
    for (std::ptrdiff_t k = 0; k < kMaxLanes; ++k)
      lane_[k] = view_.rows.base + std::min(k, last) * view_.rows.pitch;
  }

  /// For a batch.
  template <class Items>
  QuadTarget<float> target(const Items& batch) {
    view_.grids = batch.items.size(), view_.first = batch.first, view_.index = batch.index;
    return {lane_.data(), view_.rows.stride, visit_ != nullptr ? &row : nullptr, this, view_.rows.mask};
  }

 private:
  static void row(void* self, int j) {
    auto& rows = *static_cast<Rows*>(self);
    rows.view_.j = j;
    rows.visit_(rows.context_, rows.view_);
  }

  RowView view_;
  void (*visit_)(void*, const RowView&);
  void* context_;
  LanePlaces lane_;
};

// Rows of whole items to their places: that of number i of the list from at(i) on.
template <class At>
class Runs {
 public:
  Runs(const At& at, Stores stores) : at_(at), stores_(stores) {}

  static void visit(void* context, const RowView& view) {
    Runs& runs = *static_cast<Runs*>(context);
    const auto n = static_cast<std::size_t>(side(view.depth)), j = static_cast<std::size_t>(view.j);
    for (std::size_t lane = 0; lane < view.size(); ++lane) {
      if (runs.stores_ == Stores::kOrdinary) {
        std::copy_n(view.vertices(lane), n, runs.at_(view.number(lane)) + j * n);
        continue;
      }
      LineStream& lines = runs.lines_[lane];
      if (j == 0) lines.start(reinterpret_cast<std::byte*>(runs.at_(view.number(lane))));
      lines.append(reinterpret_cast<const std::byte*>(view.vertices(lane)), n * sizeof(Vertex));
      if (j + 1 == n) lines.finish();
    }
  }

 private:
  const At& at_;
  Stores stores_;
  std::array<LineStream, kMaxLanes> lines_ = {};
};

template <class Scheme>
struct Evaluation : Call<Scheme> {
  using Items = typename Call<Scheme>::Items;
  using Call<Scheme>::depth, Call<Scheme>::kernel, Call<Scheme>::order, Call<Scheme>::rings;

  template <class Body>
  void for_each_batch(std::span<const typename Scheme::Item> items, const Body& body) const {
    this->by_class(
        items, [&](const auto& item) { return this->kind_of(item); }, body);
  }
  template <class Body>
  void for_each_edges(std::span<const std::int32_t> half_edges, const Body& body) const {
    this->by_class(
        half_edges, [&](std::int32_t h) { return this->kind_of_edge(h); }, body);
  }

  AloneEvaluator<typename Scheme::Alone>& alone() {
    if (!alone_) alone_.emplace(*this->touched, rings, depth);
    return *alone_;
  }
  void evaluate(const Items& batch, const QuadTarget<float>& to) {
    if (!batch.alone()) return this->run(batch, to);
    alone().grid(batch.items.front(), order, to, [&](std::int32_t h, Vertex* out) {
      this->run_edges({&h, 1}, [&](std::size_t) { return out; });
    });
  }
  // Each item to its place at(i), in whole cache lines if the kernel has them and `stores` is given.
  template <class At>
  void to_places(std::span<const typename Scheme::Item> items, const At& at, std::optional<Stores> stores) {
    this->prepare();
    Runs<At> runs(at, stores.value_or(Stores::kOrdinary));
    this->for_each_batch(items, [&](const Items& batch) {
      const LanePlaces lane =
          places_of(batch.items.size(), [&](std::size_t k) { return at(batch.number(k)); });
      if (stores && Scheme::has_lines(kernel) && !batch.alone())
        return this->run_lines(batch, lane.data(), *stores);
      // The lanes beyond the last grid would write too, into the caller's memory.
      if (stores != Stores::kPastCaches && this->takes(lane, batch.items.size()))
        return evaluate(batch, {lane.data(), 6 * side(depth), nullptr, nullptr});
      evaluate(batch, Rows(*this, Kept::kOneRow, &runs.visit, &runs).target(batch));
    });
  }

  std::optional<AloneEvaluator<typename Scheme::Alone>> alone_ = {};
};

}  // namespace

template <class Scheme>
BasicRowStream<Scheme>::BasicRowStream(const Kernel& kernel, Rings rings, std::shared_ptr<const Alone> alone)
    : kernel_(kernel), rings_(std::move(rings)), alone_(std::move(alone)) {}

template <class Scheme>
void BasicRowStream<Scheme>::rows(std::span<const Item> items, int depth, Workspace& workspace,
                                  void (*visit)(void*, const RowView&), void* context, Order order,
                                  Kept kept) const {
  Evaluation<Scheme> evaluation{{{kernel_, rings_, alone_.get(), depth, workspace, order}}};
  evaluation.prepare();
  Rows rows(evaluation, kept, visit, context);
  evaluation.for_each_batch(items,
                            [&](const auto& batch) { evaluation.evaluate(batch, rows.target(batch)); });
}

template <class Scheme>
void BasicRowStream<Scheme>::whole(std::span<const Item> items, int depth, Workspace& workspace, Vertex* out,
                                   const Kernel* other) const {
  const Kernel& kernel = other != nullptr ? *other : kernel_;
  Evaluation<Scheme>{{{kernel, rings_, alone_.get(), depth, workspace}}}.to_places(
      items, one_after_the_other(out, depth), std::nullopt);
}

template <class Scheme>
void BasicRowStream<Scheme>::put(std::span<const Item> items, int depth, Workspace& workspace,
                                 Vertex* const* places, Order order, Stores stores) const {
  Evaluation<Scheme>{{{kernel_, rings_, alone_.get(), depth, workspace, order}}}.to_places(
      items, [&](std::size_t i) { return places[i]; }, stores);
}

template <class Scheme>
void BasicRowStream<Scheme>::streamed(std::span<const Item> items, int depth, Workspace& workspace,
                                      Vertex* out) const {
  Evaluation<Scheme>{{{kernel_, rings_, alone_.get(), depth, workspace}}}.to_places(
      items, one_after_the_other(out, depth), Stores::kPastCaches);
  fence(Stores::kPastCaches);
}

template <class Scheme>
void BasicRowStream<Scheme>::edges(std::span<const std::int32_t> half_edges, int depth, Workspace& workspace,
                                   Vertex* out, const Kernel* other) const {
  const Kernel& kernel = other != nullptr ? *other : kernel_;
  Evaluation<Scheme> evaluation{{{kernel, rings_, alone_.get(), depth, workspace}}};
  evaluation.prepare_edges();
  const auto n = static_cast<std::size_t>(side(depth));
  evaluation.for_each_edges(half_edges, [&](const Batch<std::int32_t>& batch) {
    const auto at = [&](std::size_t k) { return out + n * batch.number(k); };
    if (batch.alone()) return evaluation.alone().edge(batch.items.front(), at(0));
    evaluation.run_edges(batch.items, at);
  });
}

template class BasicRowStream<LoopStreams>;
template class BasicRowStream<QuadStreams>;

RowStream::RowStream(const data::ControlMesh& mesh, const Adjacency& adjacency, const Kernel& kernel)
    : BasicRowStream(kernel, LoopRings(mesh, adjacency), nullptr) {}

RowStream::RowStream(const TriangleMesh& mesh, const Kernel& kernel)
    : BasicRowStream(kernel, LoopRings(mesh.points(), mesh.adjacency(), mesh.kinds()),
                     mesh.is_cut() ? std::make_shared<const CutGrids>(mesh) : nullptr) {}

void RowStream::move_points(const TriangleMesh& mesh) {
  rings_.move_points(place<float>(mesh.points()));
  if (alone_) alone_ = std::make_shared<const CutGrids>(mesh);
}

QuadRowStream::QuadRowStream(const QuadMesh& mesh, const QuadKernel& kernel)
    : BasicRowStream(kernel, QuadRings(mesh),
                     mesh.semi_sharp() ? std::make_shared<const SemiSharpQuads>(mesh) : nullptr) {}

void QuadRowStream::move_points(const QuadMesh& mesh) {
  rings_ = QuadRings(mesh);
  if (alone_) alone_ = std::make_shared<const SemiSharpQuads>(mesh);
}

std::vector<Grid> RowStream::sorted(std::span<const Grid> grids) const {
  std::vector<Grid> all(grids.begin(), grids.end());
  const auto key = [&](const Grid& grid) {
    return std::pair(local_from(grid), regularity_rank(regular_edges(rings_, grid, grid.depth)));
  };
  std::stable_sort(all.begin(), all.end(), [&](const Grid& a, const Grid& b) { return key(a) < key(b); });
  return all;
}

std::vector<std::int32_t> QuadRowStream::sorted(std::span<const std::int32_t> faces) const {
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys;  // by class, origins and valences
  keys.reserve(faces.size());
  for (const std::int32_t f : faces) {
    auto key = static_cast<std::uint64_t>(rings_.kind(f)) << 4 |
               static_cast<std::uint64_t>(rings_.local().first<4>(f));
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

}  // namespace limitcheck::fast::row_stream
