// SPDX-License-Identifier: MIT
// Frames of Catmull-Clark's scheme by row streaming, and one thread's part of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fast/frame/quad_patch.h"
#include "fast/frame/quad_state.h"
#include "fast/rules/masks.h"
#include "fast/stream/host/stream_hooks.h"
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
  const QuadKernel& narrow;  // of few lanes, for single faces
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
    const auto first = static_cast<std::int32_t>(faces.first[f]);
    if (corners_only(patch, faces))
      return writer.corners([&](int k) { return frame.stream.limit(faces.vertex(first + k)); });
    border_.resize(static_cast<std::size_t>(faces.sides(f)));
    for (int s = 0; s < faces.sides(f); ++s)
      evaluate_border(frame, first + s, frame.plan.edge_depth[first + s], border_[s]);
    if (patch.display == Display::kFan) {
      return writer.fan(centre(frame, f), border_);
    }
    quads_.clear();
    for (int part = 0; part < faces.parts(f); ++part) quads_.push_back(faces.quad(f, part));
    points_.resize(faces.parts(f), faces.part_size(patch.depth));
    frame.stream.whole(quads_, patch.depth - (faces.cut() ? 1 : 0), workspace_, points_.points.data(),
                       &frame.narrow);
    writer.stitch(points_, border_);
  }

  // The centre of a face: the limit point in its middle, or the mean of its corners, with the normal of the
  // limit.
  Vertex centre(const QuadStreamFrame& frame, std::int32_t f) {
    const QuadFaces& faces = frame.faces;
    const auto first = static_cast<std::int32_t>(faces.first[f]);
    Vertex middle;
    if (faces.cut()) {
      middle = frame.stream.limit(faces.mesh->adjacency.corner(first, 2));
    } else {
      std::array<Vertex, 9> points;  // of depth 1
      frame.stream.whole({&f, 1}, 1, workspace_, points.data(), &frame.narrow);
      middle = points[4];
    }
    if (frame.centre == FanCentre::kLimit) return middle;
    Vec3<double> sum{};
    for (int k = 0; k < faces.sides(f); ++k) {
      const std::int32_t v = faces.vertex(first + k);
      sum = sum + widen<float>(frame.centre == FanCentre::kFlatControl ? frame.stream.control(v)
                                                                       : frame.stream.limit(v).position);
    }
    middle.position = narrow<float>(1. / faces.sides(f) * sum);
    return middle;
  }

  // Side c of a face at a depth of its own.
  void evaluate_border(const QuadStreamFrame& frame, std::int32_t c, int depth, std::vector<Vertex>& out) {
    const QuadFaces& faces = frame.faces;
    out.resize((std::size_t{1} << depth) + 1);
    const auto evaluate = [&](std::int32_t h, int d, std::size_t at) {
      frame.stream.edges({&h, 1}, d, workspace_, out.data() + at, &frame.narrow);
    };
    if (!faces.cut()) {
      evaluate(c, depth, 0);
    } else if (depth == 0) {
      out[0] = frame.stream.limit(faces.vertex(c)), out[1] = frame.stream.limit(faces.vertex(faces.next(c)));
    } else {
      evaluate(faces.first_half(c), depth - 1, 0);
      evaluate(faces.second_half(c), depth - 1, std::size_t{1} << (depth - 1));
    }
  }

  Workspace workspace_;
  std::vector<std::int32_t> quads_;
  QuadBorder<float> border_;
  FacePoints<float> points_;
};

struct QuadStreamState final : QuadEngineState<float>, StreamHooks {
  /// throws   data::ArgumentError: what QuadEngineState and QuadRowStream refuse
  QuadStreamState(const data::ControlMesh& given, const TessellatorOptions& with, const QuadKernel& kernel);

  void points_moved() override;
  void prepare() override { worker_bytes = 0; }
  void draw(std::size_t first, std::size_t last, DrawList<float>& out) override;
  void index(const QuadIndexLayout& layout, IndexedMesh<float>& out) override;
  void write_patches(std::span<const PatchPlace> places, const PatchTarget<float>& out) override;
  SurfaceVertex<float> limit(std::int32_t v) const override { return stream_->limit(v); }
  std::int64_t zero_normals() const override { return stream_->rings().degenerate_normals(); }

 private:
  template <class Skip>
  void make_batches(std::size_t first, std::size_t last, Skip&& skip);
  template <class MakeWriter, class Skip>
  void run(std::size_t first, std::size_t last, MakeWriter&& make_writer, Skip&& skip, bool placed = false);

  std::optional<QuadRowStream> stream_;
  const QuadKernel& narrow_;
  std::vector<std::int32_t> rank_;  // of each quad, in the order that is best for the lanes

  std::vector<QuadStreamWorker> workers_;
  std::vector<QuadPart> parts_;
  std::vector<QuadFrameBatch> batches_;
};

}  // namespace limitcheck::fast::row_stream
