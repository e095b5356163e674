// SPDX-License-Identifier: MIT
// One thread's part of a frame: evaluates a batch and hands its points to the patches' writers.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "fast/frame/crack_centre.h"
#include "fast/frame/draw_writer.h"
#include "fast/stream/row_stream.h"
#include "fast/stream/stream_batches.h"

namespace limitcheck::fast::row_stream {

inline SurfaceVertex<float> as_point(const Vertex& v) {
  return {{v.position[0], v.position[1], v.position[2]}, {v.normal[0], v.normal[1], v.normal[2]}};
}

/// What all threads read.
struct StreamFrame {
  const Adjacency& adjacency;
  const RowStream& stream;
  const Kernel& narrow;  // of few lanes, for grids that have to be kept whole
  const CrackPlan& plan;
  std::span<const Grid> grids;
  std::span<const Patch> patches;
  const PreparedMesh<float>* control;  // for the centres of fans; null if there are none
  FanCentre centre;
  int deepest;  // of grids and edges
};

class StreamWorker {
 public:
  using Point = SurfaceVertex<float>;

  DrawWriter<float>::Scratch& scratch() { return scratch_; }

  /// make_writer(patch index, worker) gives each patch its writer.
  template <class MakeWriter>
  void run(const StreamFrame& frame, const Batch& batch, MakeWriter&& make_writer) {
    using Writer = decltype(make_writer(std::size_t{}, *this));
    if (batch.delivery == Delivery::kRowsFromA || batch.delivery == Delivery::kRowsFromC) {
      std::vector<Writer> writers;
      writers.reserve(batch.patches.size());
      for (const std::size_t i : batch.patches) writers.push_back(make_writer(i, *this));
      rows(frame, batch, writers);
      for (std::size_t lane = 0; lane < writers.size(); ++lane)
        repairs(frame, frame.patches[batch.patches[lane]], writers[lane]);
      return;
    }
    if (batch.delivery == Delivery::kWhole) evaluate_whole(frame, batch);
    for (std::size_t lane = 0; lane < batch.patches.size(); ++lane) {
      const Patch& patch = frame.patches[batch.patches[lane]];
      auto writer = make_writer(batch.patches[lane], *this);
      if (batch.delivery == Delivery::kWhole) whole(patch, lane, writer);
      repairs(frame, patch, writer);
    }
  }

  /// Bytes of its own, writers aside.
  std::size_t bytes() const {
    std::size_t count = scratch_.inner.capacity() + strip_.capacity();
    for (const auto& points : border_) count += points.capacity();
    return workspace_.bytes() + sizeof(Point) * count +
           sizeof(Vertex) * (before_.capacity() + edge_.capacity());
  }

 private:
  void collect(const StreamFrame& frame, const Batch& batch) {
    grids_.clear();
    for (const std::size_t i : batch.patches) grids_.push_back(frame.grids[i]);
  }

  // Two rows make a strip: this one and the one before, which is kept. Frames count columns from D's side.
  template <class Writer>
  void rows(const StreamFrame& frame, const Batch& batch, std::vector<Writer>& writers) {
    collect(frame, batch);
    const auto n = static_cast<std::size_t>(side(batch.depth));
    before_.resize(batch.patches.size() * n);
    strip_.resize(2 * n);
    struct Context {
      StreamWorker& worker;
      const StreamFrame& frame;
      const Batch& batch;
      std::vector<Writer>& writers;
    } context{*this, frame, batch, writers};
    frame.stream.rows(
        grids_, batch.depth, workspace_,
        [](void* opaque, const RowView& view) {
          Context& c = *static_cast<Context*>(opaque);
          for (std::size_t lane = 0; lane < view.grids.size(); ++lane)
            c.worker.take_row(c.frame.patches[c.batch.patches[lane]], view, lane, c.batch.delivery,
                              c.writers[lane]);
        },
        &context, batch.delivery == Delivery::kRowsFromC ? Order::kFromC : Order::kFromA);
  }

  // Row r of either half's own frame is row r counted from the corner that the rows come from, and its
  // columns run the other way.
  template <class Writer>
  void take_row(const Patch& patch, const RowView& view, std::size_t lane, Delivery delivery,
                Writer& writer) {
    const auto n = static_cast<std::size_t>(side(view.depth));
    const Vertex* now = view.vertices(lane);
    Vertex* before = before_.data() + lane * n;
    if (view.j > 0) {
      for (std::size_t c = 0; c < n; ++c) {
        strip_[2 * c] = as_point(before[n - 1 - c]);
        strip_[2 * c + 1] = as_point(now[n - 1 - c]);
      }
      const Point* strip = strip_.data();
      if (patch.full())
        writer.whole_strip(view.j - 1, strip);
      else
        writer.half_strip(delivery == Delivery::kRowsFromC ? 0 : 1, view.j - 1,
                          [&](int q) -> const Point& { return strip[q]; });
    }
    std::copy_n(now, n, before);
  }

  void evaluate_whole(const StreamFrame& frame, const Batch& batch) {
    collect(frame, batch);
    const auto n = static_cast<std::size_t>(side(batch.depth));
    // The grids lie behind what narrow kernels need of the same memory, so that frames need no more than
    // rows.
    const auto kernels_own = static_cast<std::size_t>(
        frame.narrow.lanes * std::max(work_size(batch.depth), edge_work_size(frame.deepest)));
    workspace_.work.grow(kernels_own + 6 * batch.patches.size() * n * n);
    whole_ = reinterpret_cast<Vertex*>(workspace_.work.data() + kernels_own);
    frame.stream.whole(grids_, batch.depth, workspace_, whole_, &frame.narrow);
  }

  // The strips of each half in its own frame: row r of face0's is our row k - r, of face1's our row r.
  template <class Writer>
  void whole(const Patch& patch, std::size_t lane, Writer& writer) {
    const int k = 1 << patch.depth;
    const Vertex* points = whole_ + lane * static_cast<std::size_t>((k + 1) * (k + 1));
    strip_.resize(2 * static_cast<std::size_t>(k + 1));
    for (int h = 0; h < 2; ++h) {
      if (!patch.half[h].uses_window()) continue;
      const auto at = [&](int row, int column) {
        return as_point(h == 0 ? points[(k - row) * (k + 1) + column] : points[row * (k + 1) + k - column]);
      };
      for (int row = 0; row < k; ++row) {
        for (int c = 0; c <= k; ++c) {
          strip_[2 * static_cast<std::size_t>(c)] = at(row, c);
          strip_[2 * static_cast<std::size_t>(c) + 1] = at(row + 1, c);
        }
        writer.half_strip(h, row, [&](int q) -> const Point& { return strip_[q]; });
      }
    }
  }

  template <class Writer>
  void repairs(const StreamFrame& frame, const Patch& patch, Writer& writer) {
    for (int s = 0; s < 2; ++s) {
      const Half& half = patch.half[s];
      if (!half.repaired()) continue;
      const Border<float> border = evaluate_border(frame, half.face);
      if (half.display == Display::kStitch) {
        writer.ring(s, border);
        continue;
      }
      if (!centre_) centre_.emplace(frame.adjacency.max_valence());
      const Placement<float>& placement = frame.stream.rings().placement();
      writer.fan(s, placed(centre_->evaluate(*frame.control, half.face, frame.centre), placement), border);
    }
  }

  Border<float> evaluate_border(const StreamFrame& frame, std::int32_t face) {
    Border<float> border;
    for (int e = 0; e < 3; ++e) {
      const std::int32_t h = 3 * face + e;
      const int depth = edge_depth(frame.plan, face, e);
      edge_.resize(static_cast<std::size_t>(side(depth)));
      frame.stream.edges({&h, 1}, depth, workspace_, edge_.data(), &frame.narrow);
      auto& points = border_[e];
      points.clear();
      for (const Vertex& v : edge_) points.push_back(as_point(v));
      border[e] = points.data();
    }
    return border;
  }

  Workspace workspace_;
  std::vector<Grid> grids_;
  std::vector<Vertex> before_, edge_;
  Vertex* whole_ = nullptr;  // in workspace_.work
  std::vector<Point> strip_;
  std::array<std::vector<Point>, 3> border_;
  DrawWriter<float>::Scratch scratch_;
  std::optional<FanCentreEvaluator<float>> centre_;
};

}  // namespace limitcheck::fast::row_stream
