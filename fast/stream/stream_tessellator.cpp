// SPDX-License-Identifier: MIT
#include "fast/stream/stream_tessellator.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "fast/frame/frame_state.h"
#include "fast/stream/stream_batches.h"
#include "fast/stream/stream_worker.h"

namespace limitcheck::fast::row_stream {

namespace {

using Point = SurfaceVertex<float>;
static_assert(sizeof(Point) == sizeof(Vertex));

// The variant of four lanes of the same instructions, or the kernel itself.
const Kernel& narrow_of(const Kernel& kernel) {
  const Kernel* narrow = kernel.lanes > 4 ? find_kernel((std::string(kernel.name) + "/4").c_str()) : nullptr;
  return narrow != nullptr ? *narrow : kernel;
}

}  // namespace

struct StreamTessellator::State : FrameState {
  State(const data::ControlMesh& given_mesh, const TessellatorOptions& given, const Kernel& kernel)
      : FrameState(given_mesh, given), stream(mesh, adjacency, kernel), narrow(narrow_of(kernel)) {}

  FrameStats prepare(std::span<const std::int32_t> depth) {
    FrameStats stats = plan_frame(depth, kMaxDepth);
    const auto start = Clock::now();
    batches.make(patches, static_cast<std::size_t>(stream.kernel().lanes),
                 static_cast<std::size_t>(narrow.lanes));
    if (plan.fans > 0 && !control) make_control();
    stats.zero_normals = stream.rings().degenerate_normals();
    stats.seconds_planning += seconds_since(start);
    return stats;
  }

  // The centres of fans are no lattice points; they come from the sliding window's own rules.
  void make_control() {
    std::vector<Vec3<float>> positions;
    for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
      const auto& p = stream.rings().points()[static_cast<std::size_t>(v)];
      positions.push_back({p[0], p[1], p[2]});
    }
    control.emplace(adjacency, positions);
  }

  // make_writer(i, worker) for each patch, in parallel; a writer must not care about the order of patches.
  template <class MakeWriter>
  void run(MakeWriter&& make_writer) {
    const StreamFrame frame{adjacency,
                            stream,
                            narrow,
                            plan,
                            pairing.pairs,
                            patches,
                            control ? &*control : nullptr,
                            options.cracks.centre,
                            max_depth};
    tbb::enumerable_thread_specific<StreamWorker> workers;
    const std::size_t total = batches.list().size();
    std::atomic<std::size_t> done = 0;
    std::mutex telling;
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, total, [&](std::size_t b) {
        StreamWorker& worker = workers.local();
        if (worker.scratch().inner.empty()) worker.scratch().reserve(max_depth);
        worker.run(frame, batches.list()[b], make_writer);
        const std::size_t finished = ++done;
        if (progress && telling.try_lock()) {
          progress(finished, total);
          telling.unlock();
        }
      });
    });
    worker_bytes = 0;
    for (const StreamWorker& worker : workers) worker_bytes = std::max(worker_bytes, worker.bytes());
  }

  RowStream stream;
  const Kernel& narrow;
  std::optional<PreparedMesh<float>> control;
  fast::Placement<float> as_they_are;  // the kernel has placed the points
  StreamBatches batches;
  std::function<void(std::size_t, std::size_t)> progress;
  std::size_t worker_bytes = 0;
};

StreamTessellator::StreamTessellator(const data::ControlMesh& mesh, const TessellatorOptions& options,
                                     const Kernel& kernel)
    : state_(std::make_unique<State>(mesh, options, kernel)) {}
StreamTessellator::~StreamTessellator() = default;
StreamTessellator::StreamTessellator(StreamTessellator&&) noexcept = default;
StreamTessellator& StreamTessellator::operator=(StreamTessellator&&) noexcept = default;

const Adjacency& StreamTessellator::adjacency() const {
  return state_->adjacency;
}
const PairingResult& StreamTessellator::last_pairing() const {
  return state_->pairing;
}
std::size_t StreamTessellator::worker_bytes() const {
  return state_->worker_bytes;
}
void StreamTessellator::on_progress(std::function<void(std::size_t, std::size_t)> tell) {
  state_->progress = std::move(tell);
}

FrameStats StreamTessellator::frame(std::span<const std::int32_t> depth, DrawList<float>& out) {
  const auto start = Clock::now();
  State& s = *state_;
  FrameStats stats = s.prepare(depth);
  const auto evaluation = Clock::now();
  std::vector<DrawSize> offsets;
  s.make_room(0, s.patches.size(), out, offsets);
  s.run([&](std::size_t i, StreamWorker& worker) {
    const DrawSize& at = offsets[i];
    return DrawWriter<float>(s.patches[i], s.plan, s.as_they_are, out.vertices.data() + at.vertices,
                             s.options.provenance ? out.provenance.data() + at.vertices : nullptr,
                             out.draws.data() + at.draws, at.vertices, worker.scratch());
  });
  stats.vertices = static_cast<std::int64_t>(out.vertices.size());
  stats.seconds_evaluation = seconds_since(evaluation);
  stats.seconds_total = seconds_since(start);
  return stats;
}

FrameStats StreamTessellator::frame(std::span<const std::int32_t> depth, IndexedMesh<float>& out) {
  const auto start = Clock::now();
  State& s = *state_;
  FrameStats stats = s.prepare(depth);
  const auto evaluation = Clock::now();
  const IndexLayout layout = s.make_room(out);
  for (std::int32_t f = s.adjacency.face_count() - 1; f >= 0; --f) {
    for (int k = 0; k < 3 && s.pairing.depth[static_cast<std::size_t>(f)] >= 0; ++k) {
      const std::int32_t v = s.adjacency.corner(f, k);
      const auto at = static_cast<std::size_t>(layout.vertex[static_cast<std::size_t>(v)]);
      Vertex limit;
      std::memcpy(&limit, s.stream.rings().corner(v).head.data() + CornerBlock::kLimit, sizeof limit);
      out.vertices[at] = as_point(limit);
      if (s.options.provenance) out.provenance[at] = {f, k == 1 ? 1u : 0u, k == 2 ? 1u : 0u, 1};
    }
  }
  s.run([&](std::size_t i, StreamWorker&) {
    return IndexWriter<float>(s.adjacency, s.patches[i], s.plan, layout, s.as_they_are, out);
  });
  stats.vertices = static_cast<std::int64_t>(out.vertices.size());
  stats.seconds_evaluation = seconds_since(evaluation);
  stats.seconds_total = seconds_since(start);
  return stats;
}

FrameStats StreamTessellator::frame(const DepthOptions& strategy, const Camera& camera,
                                    DrawList<float>& out) {
  return state_->by_strategy(strategy, camera,
                             [&](std::span<const std::int32_t> depth) { return frame(depth, out); });
}

FrameStats StreamTessellator::frame(const DepthOptions& strategy, const Camera& camera,
                                    IndexedMesh<float>& out) {
  return state_->by_strategy(strategy, camera,
                             [&](std::span<const std::int32_t> depth) { return frame(depth, out); });
}

}  // namespace limitcheck::fast::row_stream
