// SPDX-License-Identifier: MIT
// One thread's part of a frame: of triangles, the patches in batches, the borders of its repaired faces, and how the
// points of a batch reach the writers of its patches; and the same of quads.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "fast/frame/crack_centre.h"
#include "fast/frame/draw_writer.h"
#include "fast/frame/patch.h"
#include "fast/frame/quad_patch.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::fast::row_stream {

/// How the points of a batch reach their writers. A draw list takes the rows of a half from its own first on,
/// which for face0 is the row at C.
enum class Delivery : std::uint8_t {
  kPlaced,     // both faces, straight to their place
  kRowsFromC,  // face0, or both faces: as the rows come
  kRowsFromA,  // face1 alone: as the rows come
  kWhole,      // stitched faces: from whole grids, one after the other
  kNothing     // fans alone: nothing for the kernel
};
inline constexpr std::size_t kDeliveries = 5;

struct LoopBatch {
  Delivery delivery;
  int depth;
  std::span<const std::size_t> items;  // patches
};

/// Patches by depth and delivery.
class SortedPatches {
 public:
  /// Of patches first .. last - 1 but those skipped: batches of at most `lanes`, or `few` of those delivered whole. In a
  /// fixed order.
  ///   rank     of a patch, below kRanks: patches of one rank, which go together best, follow each other at each depth
  ///   placed   patches of two displayed faces have a place each, where the rows lie as they come from C
  template <class Skipped, class Rank>
  void sort(std::span<const LoopPatch> patches, std::size_t first, std::size_t last, Skipped&& skipped,
            Rank&& rank, std::size_t lanes, std::size_t few, bool placed, std::vector<LoopBatch>& batches) {
    for (auto& list : lists_) list.clear();
    batches.clear();
    const auto list_of = [&](std::size_t i) -> std::vector<std::size_t>& {
      return lists_[static_cast<std::size_t>(delivery_of(patches[i], placed)) +
                    kDeliveries * static_cast<std::size_t>(patches[i].depth)];
    };
    for (auto& list : ranked_) list.clear();
    for (std::size_t i = first; i < last; ++i)
      if (!skipped(i)) ranked_[rank(i)].push_back(i);
    for (const auto& list : ranked_)
      for (const std::size_t i : list) list_of(i).push_back(i);
    // A remainder joins the row batches, which would leave lanes empty, too.
    for (std::size_t depth = 0; depth <= kMaxDepth && placed; ++depth) {
      auto& pairs = lists_[kDeliveries * depth + static_cast<std::size_t>(Delivery::kPlaced)];
      auto& rows = lists_[kDeliveries * depth + static_cast<std::size_t>(Delivery::kRowsFromC)];
      const std::size_t full = pairs.size() / lanes * lanes;
      rows.insert(rows.end(), pairs.begin() + static_cast<std::ptrdiff_t>(full), pairs.end());
      pairs.resize(full);
    }
    for (std::size_t k = 0; k < lists_.size(); ++k) {
      const auto delivery = static_cast<Delivery>(k % kDeliveries);
      const std::size_t most = delivery == Delivery::kWhole ? few : lanes;
      const std::span<const std::size_t> list(lists_[k]);
      for (std::size_t at = 0; at < list.size(); at += most)
        batches.push_back({delivery, static_cast<int>(k / kDeliveries),
                           list.subspan(at, std::min(most, list.size() - at))});
    }
  }

 private:
  static Delivery delivery_of(const LoopPatch& patch, bool placed) {
    if (placed && patch.full()) return Delivery::kPlaced;
    const Half &first = patch.half[0], &second = patch.half[1];
    if (!first.uses_window() && !second.uses_window()) return Delivery::kNothing;
    if (first.display == Display::kStitch || second.display == Display::kStitch) return Delivery::kWhole;
    return first.uses_window() ? Delivery::kRowsFromC : Delivery::kRowsFromA;
  }

  std::array<std::vector<std::size_t>, kDeliveries*(kMaxDepth + 1)> lists_;
  static constexpr std::size_t kRanks = 2 * kRegularityRanks;
  std::array<std::vector<std::size_t>, kRanks> ranked_;
};

/// The border points of a batch's repaired faces: edges of one depth go together, one in each lane.
class BorderPoints {
 public:
  /// Evaluates the edges of all faces in the patches of a batch that are repaired. The kernel of few lanes takes
  /// what is left when there are not enough edges for the other.
  void evaluate(const RowStream& stream, const Kernel& few_lanes, std::span<const LoopPatch> patches,
                const CrackPlan& plan, std::span<const std::size_t> batch, Workspace& workspace) {
    for (auto& edges : of_depth_) edges.clear();
    std::size_t points = 0;
    for (std::size_t lane = 0; lane < batch.size(); ++lane) {
      for (int s = 0; s < 2; ++s) {
        const Half& half = patches[batch[lane]].half[s];
        for (int e = 0; half.repaired() && e < 3; ++e) {
          const int depth = plan.edge_depth[3 * half.face + e];
          of_depth_[depth].push_back({3 * half.face + e, &border_[lane][s][e]});
          points += static_cast<std::size_t>(side(depth));
        }
      }
    }
    if (points > points_.size()) points_.resize(points);
    Vertex* to = points_.data();
    for (int depth = 0; depth <= kMaxDepth; ++depth) {
      const auto& edges = of_depth_[depth];
      if (edges.empty()) continue;
      half_edges_.clear();
      const auto length = static_cast<std::size_t>(side(depth));
      for (std::size_t i = 0; i < edges.size(); ++i) {
        half_edges_.push_back(edges[i].half_edge);
        *edges[i].points = to + i * length;
      }
      // Whole batches of the wide kernel, the rest by the one that is full sooner.
      const auto wide = static_cast<std::size_t>(stream.kernel().lanes);
      const auto few = static_cast<std::size_t>(few_lanes.lanes);
      const std::size_t rest = edges.size() % wide, with_wide = edges.size() - (rest <= few ? rest : 0);
      const std::span<const std::int32_t> all(half_edges_);
      stream.edges(all.first(with_wide), depth, workspace, to);
      stream.edges(all.subspan(with_wide), depth, workspace, to + with_wide * length, &few_lanes);
      to += edges.size() * length;
    }
  }

  /// Of half s of the patch in a lane.
  const Border<float>& of(std::size_t lane, int s) const { return border_[lane][s]; }

  std::size_t bytes() const {
    std::size_t count = sizeof(Vertex) * points_.capacity();
    for (const auto& edges : of_depth_) count += sizeof(Edge) * edges.capacity();
    return count;
  }

 private:
  struct Edge {
    std::int32_t half_edge;
    const Vertex** points;
  };

  std::array<std::vector<Edge>, kMaxDepth + 1> of_depth_;
  std::array<std::array<Border<float>, 2>, kMaxLanes> border_;
  std::vector<std::int32_t> half_edges_;
  std::vector<Vertex> points_;
};

/// take(number, row, strip) for the strip between each two rows of items. Row r of an item's own frame is row r counted
/// from the corner that the rows come from, and its columns run the other way.
template <class Stream, class Take>
void strips(const Stream& stream, std::span<const typename Stream::Item> items, int depth,
            Workspace& workspace, Order order, Take&& take) {
  stream.rows(
      items, depth, workspace,
      [](void* opaque, const RowView& view) {
        if (view.j == 0) return;
        auto& to = *static_cast<std::remove_reference_t<Take>*>(opaque);
        const int last = 1 << view.depth;
        for (std::size_t lane = 0; lane < view.size(); ++lane)
          to(view.number(lane), view.j - 1,
             RowPair<float>{view.before(lane) + last, view.vertices(lane) + last, -1});
      },
      &take, order, Kept::kTwoRows);
}

/// The centre of a face's fan, once it has been evaluated.
struct CachedCentre {
  Vertex point;
  bool known = false;
};

/// Frame   what all threads read, see LoopStreamFrames; of its `centres` each writes those of its own faces
template <class Frame>
class LoopStreamWorker {
 public:
  /// make_writer(patch index) gives each patch its writer.
  template <class MakeWriter>
  void run(Frame& frame, const LoopBatch& batch, MakeWriter&& make_writer) {
    using Writer = decltype(make_writer(std::size_t{}));
    if constexpr (requires(Writer writer) { writer.grid(0); }) {
      if (batch.delivery == Delivery::kPlaced) return place(frame, batch, make_writer);
    }
    border_.evaluate(frame.stream, frame.few_lanes, frame.patches, frame.plan, batch.items, workspace_);
    if (batch.delivery == Delivery::kRowsFromA || batch.delivery == Delivery::kRowsFromC) {
      std::vector<Writer> writers;
      writers.reserve(batch.items.size());
      for (const std::size_t i : batch.items) writers.push_back(make_writer(i));
      rows(frame, batch, writers);
      for (std::size_t lane = 0; lane < writers.size(); ++lane) repairs(frame, batch, lane, writers[lane]);
      return;
    }
    if (batch.delivery == Delivery::kWhole) evaluate_whole(frame, batch);
    for (std::size_t lane = 0; lane < batch.items.size(); ++lane) {
      auto writer = make_writer(batch.items[lane]);
      if (batch.delivery == Delivery::kWhole) whole(frame.patches[batch.items[lane]], lane, writer);
      repairs(frame, batch, lane, writer);
    }
  }

  /// Bytes of its own, writers aside.
  std::size_t bytes() const { return workspace_.bytes() + border_.bytes(); }

 private:
  void collect(const Frame& frame, const LoopBatch& batch) {
    grids_.clear();
    for (const std::size_t i : batch.items) grids_.push_back(frame.pairing.grids[i]);
  }

  template <class MakeWriter>
  void place(const Frame& frame, const LoopBatch& batch, MakeWriter&& make_writer) {
    collect(frame, batch);
    std::array<Vertex*, kMaxLanes> places;
    for (std::size_t lane = 0; lane < batch.items.size(); ++lane)
      places[lane] = make_writer(batch.items[lane]).grid(LoopPatch::kWhole);
    frame.stream.put(grids_, batch.depth, workspace_, places.data(), Order::kFromC, frame.stores);
  }

  template <class Writer>
  void rows(const Frame& frame, const LoopBatch& batch, std::vector<Writer>& writers) {
    collect(frame, batch);
    const bool from_c = batch.delivery == Delivery::kRowsFromC;
    strips(frame.stream, grids_, batch.depth, workspace_, from_c ? Order::kFromC : Order::kFromA,
           [&](std::size_t i, int row, const RowPair<float>& strip) {
             const LoopPatch& patch = frame.patches[batch.items[i]];
             writers[i].strip(patch.full() ? LoopPatch::kWhole : from_c ? 0 : 1, row, strip);
           });
  }

  void evaluate_whole(const Frame& frame, const LoopBatch& batch) {
    collect(frame, batch);
    const auto n = static_cast<std::size_t>(side(batch.depth));
    // The grids lie behind what the kernel needs of the same memory, so that frames need no more than rows.
    const auto kernels_own = static_cast<std::size_t>(frame.few_lanes.lanes * work_size(batch.depth));
    workspace_.work.grow(kernels_own + 6 * batch.items.size() * n * n);
    whole_ = reinterpret_cast<Vertex*>(workspace_.work.data() + kernels_own);
    frame.stream.whole(grids_, batch.depth, workspace_, whole_, &frame.few_lanes);
  }

  const Vertex* grid_of(const LoopPatch& patch, std::size_t lane) const {
    return whole_ + lane * static_cast<std::size_t>(patch.block(LoopPatch::kWhole).size());
  }
  // The strips of each half in its own frame: row r of face0's is our row k - r, of face1's our row r.
  template <class Writer>
  void whole(const LoopPatch& patch, std::size_t lane, Writer& writer) {
    const int k = patch.k();
    const Vertex* points = grid_of(patch, lane);
    for (int h = 0; h < 2; ++h) {
      if (patch.half[h].display == Display::kStitch) inner_strips(patch, h, points, writer);
      if (patch.half[h].display != Display::kStrips) continue;
      for (int row = 0; row < k; ++row) {
        const Vertex *first = points + (k - row) * (k + 1), *last = points + row * (k + 1) + k;
        writer.strip(
            h, row,
            h == 0 ? RowPair<float>{first, first - (k + 1), 1} : RowPair<float>{last, last + (k + 1), -1});
      }
    }
  }

  template <class Writer>
  void repairs(Frame& frame, const LoopBatch& batch, std::size_t lane, Writer& writer) {
    const LoopPatch& patch = frame.patches[batch.items[lane]];
    for (int s = 0; s < 2; ++s) {
      const Half& half = patch.half[s];
      if (half.display == Display::kStitch) writer.ring(s, grid_of(patch, lane), border_.of(lane, s));
      if (half.display == Display::kFan) writer.fan(s, centre(frame, half.face), border_.of(lane, s));
    }
  }

  const Vertex& centre(Frame& frame, std::int32_t face) {
    CachedCentre& cached = frame.centres[face];
    if (!cached.known) {
      if (!centre_) centre_.emplace(frame.adjacency.max_valence());
      const Vertex at = centre_->evaluate(*frame.control, face, frame.options.cracks.centre);
      cached = {placed(at, frame.stream.rings().placement()), true};
    }
    return cached.point;
  }

  Workspace workspace_;
  BorderPoints border_;
  std::vector<Grid> grids_;
  Vertex* whole_ = nullptr;  // in workspace_.work
  std::optional<FanCentreEvaluator<float>> centre_;
};

/// One quad of a face: the face itself, or a part of one that was cut.
struct QuadPart {
  std::size_t patch;
  int part;
};

/// Quads of one depth that go together, as strips; or one face that needs something else.
struct QuadFrameBatch {
  int depth;  // of the quads; -1: a face by itself
  std::span<const QuadPart> items;
};

/// Frame   what all threads read, see QuadStreamFrames
template <class Frame>
class QuadStreamWorker {
 public:
  /// make_writer(patch index) gives each patch a writer.
  template <class MakeWriter>
  void run(const Frame& frame, const QuadFrameBatch& batch, MakeWriter&& make_writer) {
    if (batch.depth < 0) {
      const std::size_t i = batch.items.front().patch;
      auto writer = make_writer(i);
      return show_repaired<float>(frame.patches[i], frame.faces, frame.plan, frame.options.cracks.centre,
                                  Points{frame, *this}, border_, writer);
    }
    using Writer = decltype(make_writer(std::size_t{}));
    std::vector<Writer> writers;
    writers.reserve(batch.items.size());
    quads_.clear();
    for (const QuadPart& part : batch.items) {
      const QuadPatch& patch = frame.patches[part.patch];
      writers.push_back(make_writer(part.patch));
      if constexpr (requires(Writer writer) { writer.go_to(0); }) writers.back().go_to(part.part);
      quads_.push_back(frame.faces.quad(patch.face.face, part.part));
    }
    if constexpr (requires(Writer writer) { writer.grid(0); }) {
      if (frame.placed) {
        std::array<Vertex*, kMaxLanes> places;
        for (std::size_t i = 0; i < writers.size(); ++i) places[i] = writers[i].grid(batch.items[i].part);
        return frame.stream.put(quads_, batch.depth, workspace_, places.data(), Order::kFromC, frame.stores);
      }
    }
    strips(frame.stream, quads_, batch.depth, workspace_, Order::kFromC,
           [&](std::size_t i, int row, const RowPair<float>& strip) {
             writers[i].strip(batch.items[i].part, row, strip);
           });
  }

  /// Bytes of its own, writers aside.
  std::size_t bytes() const {
    std::size_t count = grid_.capacity();
    for (const auto& points : border_) count += points.capacity();
    return workspace_.bytes() + sizeof(Vertex) * count;
  }

 private:
  /// The points of a face that is by itself, see show_repaired().
  struct Points {
    const Frame& frame;
    QuadStreamWorker& worker;

    Vec3<float> position(std::int32_t v) const { return frame.stream.control(v); }
    Vertex limit(std::int32_t v) const { return frame.stream.limit(v); }
    void edge(std::int32_t h, int depth, Vertex* out) const {
      frame.stream.edges({&h, 1}, depth, worker.workspace_, out, &frame.few_lanes);
    }
    Vertex middle(std::int32_t quad) const {
      std::array<Vertex, 9> points;  // of depth 1
      frame.stream.whole({&quad, 1}, 1, worker.workspace_, points.data(), &frame.few_lanes);
      return points[4];
    }
    const Vertex* grid(const QuadPatch& patch) const {
      const QuadFaces& faces = frame.faces;
      worker.quads_.clear();
      for (int part = 0; part < patch.face.parts; ++part)
        worker.quads_.push_back(faces.quad(patch.face.face, part));
      worker.grid_.resize(static_cast<std::size_t>(patch.face.parts * patch.face.block().size()));
      frame.stream.whole(worker.quads_, patch.depth - (faces.cut() ? 1 : 0), worker.workspace_,
                         worker.grid_.data(), &frame.few_lanes);
      return worker.grid_.data();
    }
  };

  Workspace workspace_;
  std::vector<std::int32_t> quads_;
  QuadBorder<float> border_;
  std::vector<Vertex> grid_;  // of a stitched face
};

}  // namespace limitcheck::fast::row_stream
