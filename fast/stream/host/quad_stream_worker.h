// SPDX-License-Identifier: MIT
// One thread's part of a frame of quads: evaluates a batch and hands its points to the faces' writers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fast/frame/quad_patch.h"
#include "fast/rules/masks.h"
#include "fast/stream/host/stream_worker.h"

namespace limitcheck::fast::row_stream {

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
