// SPDX-License-Identifier: MIT
// One thread's part of a frame: evaluates a batch and hands its points to the patches' writers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fast/frame/crack_centre.h"
#include "fast/frame/draw_writer.h"
#include "fast/stream/gather/stream_batches.h"
#include "fast/stream/host/border_points.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::fast::row_stream {

/// The centre of a face's fan, once it has been evaluated.
struct CachedCentre {
  SurfaceVertex<float> point;
  bool known = false;
};

/// What all threads read; of `centres` each writes those of its own faces.
struct StreamFrame {
  const Adjacency& adjacency;
  const RowStream& stream;
  const Kernel& narrow;  // of few lanes, for grids that have to be kept whole
  const CrackPlan& plan;
  std::span<const Grid> grids;
  std::span<const Patch> patches;
  const PreparedMesh<float>* control;  // for the centres of fans; null if there are none
  std::span<CachedCentre> centres;     // one per face, or none likewise
  FanCentre centre;
  Stores stores;  // of the patches that have a place each
};

class StreamWorker {
 public:
  using Point = SurfaceVertex<float>;

  DrawWriter<float>::Scratch& scratch() { return scratch_; }

  /// make_writer(patch index, worker) gives each patch its writer.
  template <class MakeWriter>
  void run(const StreamFrame& frame, const Batch& batch, MakeWriter&& make_writer) {
    using Writer = decltype(make_writer(std::size_t{}, *this));
    if constexpr (requires(Writer writer) { writer.grid(); }) {
      if (batch.delivery == Delivery::kPlaced) return place(frame, batch, make_writer);
    }
    border_.evaluate(frame.stream, frame.narrow, frame.patches, frame.plan, batch.patches, workspace_);
    if (batch.delivery == Delivery::kRowsFromA || batch.delivery == Delivery::kRowsFromC) {
      std::vector<Writer> writers;
      writers.reserve(batch.patches.size());
      for (const std::size_t i : batch.patches) writers.push_back(make_writer(i, *this));
      rows(frame, batch, writers);
      for (std::size_t lane = 0; lane < writers.size(); ++lane) repairs(frame, batch, lane, writers[lane]);
      return;
    }
    if (batch.delivery == Delivery::kWhole) evaluate_whole(frame, batch);
    for (std::size_t lane = 0; lane < batch.patches.size(); ++lane) {
      auto writer = make_writer(batch.patches[lane], *this);
      if (batch.delivery == Delivery::kWhole) whole(frame.patches[batch.patches[lane]], lane, writer);
      repairs(frame, batch, lane, writer);
    }
  }

  /// Bytes of its own, writers aside.
  std::size_t bytes() const {
    return workspace_.bytes() + border_.bytes() + sizeof(Point) * scratch_.inner.capacity();
  }

 private:
  void collect(const StreamFrame& frame, const Batch& batch) {
    grids_.clear();
    for (const std::size_t i : batch.patches) grids_.push_back(frame.grids[i]);
  }

  template <class MakeWriter>
  void place(const StreamFrame& frame, const Batch& batch, MakeWriter&& make_writer) {
    collect(frame, batch);
    std::array<Vertex*, kMaxLanes> places;
    for (std::size_t lane = 0; lane < batch.patches.size(); ++lane)
      places[lane] = reinterpret_cast<Vertex*>(make_writer(batch.patches[lane], *this).grid());
    frame.stream.put(grids_, batch.depth, workspace_, places.data(), Order::kFromC, frame.stores);
  }

  // Two rows make a strip. Frames count columns from D's side, the kernel from the other.
  template <class Writer>
  void rows(const StreamFrame& frame, const Batch& batch, std::vector<Writer>& writers) {
    collect(frame, batch);
    struct Context {
      const StreamFrame& frame;
      const Batch& batch;
      std::vector<Writer>& writers;
      const Grid* grids;
    } context{frame, batch, writers, grids_.data()};
    frame.stream.rows(
        grids_, batch.depth, workspace_,
        [](void* opaque, const RowView& view) {
          if (view.j == 0) return;
          Context& c = *static_cast<Context*>(opaque);
          const auto first = static_cast<std::size_t>(view.grids.data() - c.grids);
          for (std::size_t lane = 0; lane < view.grids.size(); ++lane)
            take_rows(c.frame.patches[c.batch.patches[first + lane]], view, lane, c.batch.delivery,
                      c.writers[first + lane]);
        },
        &context, batch.delivery == Delivery::kRowsFromC ? Order::kFromC : Order::kFromA, Kept::kTwoRows);
  }

  // Row r of either half's own frame is row r counted from the corner that the rows come from, and its
  // columns run the other way.
  template <class Writer>
  static void take_rows(const Patch& patch, const RowView& view, std::size_t lane, Delivery delivery,
                        Writer& writer) {
    const int last = 1 << view.depth;
    const RowPair<float> strip{points_of(view.before(lane)) + last, points_of(view.vertices(lane)) + last,
                               -1};
    if (patch.full())
      writer.whole_strip(view.j - 1, strip);
    else
      writer.half_strip(delivery == Delivery::kRowsFromC ? 0 : 1, view.j - 1, strip);
  }

  static const Point* points_of(const Vertex* v) { return reinterpret_cast<const Point*>(v); }

  void evaluate_whole(const StreamFrame& frame, const Batch& batch) {
    collect(frame, batch);
    const auto n = static_cast<std::size_t>(side(batch.depth));
    // The grids lie behind what the kernel needs of the same memory, so that frames need no more than rows.
    const auto kernels_own = static_cast<std::size_t>(frame.narrow.lanes * work_size(batch.depth));
    workspace_.work.grow(kernels_own + 6 * batch.patches.size() * n * n);
    whole_ = reinterpret_cast<Vertex*>(workspace_.work.data() + kernels_own);
    frame.stream.whole(grids_, batch.depth, workspace_, whole_, &frame.narrow);
  }

  // The strips of each half in its own frame: row r of face0's is our row k - r, of face1's our row r.
  template <class Writer>
  void whole(const Patch& patch, std::size_t lane, Writer& writer) {
    const int k = 1 << patch.depth;
    const Point* points = points_of(whole_ + lane * static_cast<std::size_t>((k + 1) * (k + 1)));
    for (int h = 0; h < 2; ++h) {
      if (!patch.half[h].uses_window()) continue;
      for (int row = 0; row < k; ++row) {
        const Point *first = points + (k - row) * (k + 1), *last = points + row * (k + 1) + k;
        writer.half_strip(
            h, row,
            h == 0 ? RowPair<float>{first, first - (k + 1), 1} : RowPair<float>{last, last + (k + 1), -1});
      }
    }
  }

  template <class Writer>
  void repairs(const StreamFrame& frame, const Batch& batch, std::size_t lane, Writer& writer) {
    const Patch& patch = frame.patches[batch.patches[lane]];
    for (int s = 0; s < 2; ++s) {
      const Half& half = patch.half[s];
      if (half.display == Display::kStitch) writer.ring(s, border_.of(lane, s));
      if (half.display == Display::kFan) writer.fan(s, centre(frame, half.face), border_.of(lane, s));
    }
  }

  const Point& centre(const StreamFrame& frame, std::int32_t face) {
    CachedCentre& cached = frame.centres[face];
    if (!cached.known) {
      if (!centre_) centre_.emplace(frame.adjacency.max_valence());
      cached = {
          placed(centre_->evaluate(*frame.control, face, frame.centre), frame.stream.rings().placement()),
          true};
    }
    return cached.point;
  }

  Workspace workspace_;
  BorderPoints border_;
  std::vector<Grid> grids_;
  Vertex* whole_ = nullptr;  // in workspace_.work
  DrawWriter<float>::Scratch scratch_;
  std::optional<FanCentreEvaluator<float>> centre_;
};

}  // namespace limitcheck::fast::row_stream
