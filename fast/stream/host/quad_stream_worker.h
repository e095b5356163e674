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
#include "fast/stream/quad_row_stream.h"

namespace limitcheck::fast::row_stream {

/// One quad of a face: the face itself, or a part of one that was cut.
struct QuadPart {
  std::size_t patch;
  int part;
};

/// Quads of one depth that go together, as strips; or one face that needs something else.
struct QuadFrameBatch {
  int depth;  // of the quads; -1: a face by itself
  std::span<const QuadPart> parts;
};

/// What all threads read.
struct QuadStreamFrame {
  const QuadRowStream& stream;
  const QuadKernel& few_lanes;  // for single faces
  const QuadFaces& faces;
  const CrackPlan& plan;
  std::span<const QuadPatch> patches;
  FanCentre centre;
  bool placed;    // quads that go together have a place each
  Stores stores;  // there
};

class QuadStreamWorker {
 public:
  /// make_writer(patch index) gives each patch a writer.
  template <class MakeWriter>
  void run(const QuadStreamFrame& frame, const QuadFrameBatch& batch, MakeWriter&& make_writer) {
    if (batch.depth < 0) {
      const std::size_t i = batch.parts.front().patch;
      auto writer = make_writer(i);
      return alone(frame, frame.patches[i], writer);
    }
    using Writer = decltype(make_writer(std::size_t{}));
    std::vector<Writer> writers;
    writers.reserve(batch.parts.size());
    quads_.clear();
    for (const QuadPart& part : batch.parts) {
      const QuadPatch& patch = frame.patches[part.patch];
      writers.push_back(make_writer(part.patch));
      writers.back().skip(std::int64_t{part.part} * frame.faces.part_size(patch.depth));
      quads_.push_back(frame.faces.quad(patch.face, part.part));
    }
    if constexpr (requires(Writer writer) { writer.grid(0); }) {
      if (frame.placed) {
        std::array<Vertex*, kMaxLanes> places;
        for (std::size_t i = 0; i < writers.size(); ++i) places[i] = writers[i].grid(batch.parts[i].part);
        return frame.stream.put(quads_, batch.depth, workspace_, places.data(), Order::kFromC, frame.stores);
      }
    }
    struct Context {
      const QuadFrameBatch& batch;
      std::vector<Writer>& writers;
    } context{batch, writers};
    frame.stream.rows(
        quads_, batch.depth, workspace_,
        [](void* opaque, const QuadRowView& view) {
          if (view.j == 0) return;
          // Two rows make a strip. They come from the top, from right to left.
          Context& c = *static_cast<Context*>(opaque);
          const int last = 1 << view.depth;
          for (std::size_t lane = 0; lane < view.index.size(); ++lane) {
            const std::uint32_t i = view.index[lane];
            c.writers[i].strip(c.batch.parts[i].part, view.j - 1,
                               RowPair<float>{view.before(lane) + last, view.vertices(lane) + last, -1});
          }
        },
        &context, Order::kFromC, Kept::kTwoRows);
  }

  /// Bytes of its own, writers aside.
  std::size_t bytes() const {
    std::size_t count = points_.points.capacity();
    for (const auto& points : border_) count += points.capacity();
    return workspace_.bytes() + sizeof(Vertex) * count;
  }

 private:
  template <class Writer>
  void alone(const QuadStreamFrame& frame, const QuadPatch& patch, Writer& writer) {
    const QuadFaces& faces = frame.faces;
    const std::int32_t f = patch.face;
    const std::int32_t first = faces.first_side(f);
    if (corners_only(patch, faces))
      return writer.corners([&](int k) { return frame.stream.limit(faces.vertex(first + k)); });
    const auto limit = [&](std::int32_t v) { return frame.stream.limit(v); };
    const auto edge = [&](std::int32_t h, int depth, Vertex* out) {
      frame.stream.edges({&h, 1}, depth, workspace_, out, &frame.few_lanes);
    };
    border_.resize(static_cast<std::size_t>(faces.sides(f)));
    for (int s = 0; s < faces.sides(f); ++s)
      evaluate_side<float>(faces, first + s, frame.plan.edge_depth[first + s], limit, edge, border_[s]);
    if (patch.display == Display::kFan) {
      const auto position = [&](std::int32_t v) { return frame.stream.control(v); };
      const auto middle_of_quad = [&] {
        std::array<Vertex, 9> points;  // of depth 1
        frame.stream.whole({&f, 1}, 1, workspace_, points.data(), &frame.few_lanes);
        return points[4];
      };
      return writer.fan(face_centre<float>(faces, f, frame.centre, position, limit, middle_of_quad), border_);
    }
    quads_.clear();
    for (int part = 0; part < faces.parts(f); ++part) quads_.push_back(faces.quad(f, part));
    points_.resize(faces.parts(f), faces.part_size(patch.depth));
    frame.stream.whole(quads_, patch.depth - (faces.cut() ? 1 : 0), workspace_, points_.points.data(),
                       &frame.few_lanes);
    writer.stitch(points_, border_);
  }

  Workspace workspace_;
  std::vector<std::int32_t> quads_;
  QuadBorder<float> border_;
  FacePoints<float> points_;
};

}  // namespace limitcheck::fast::row_stream
