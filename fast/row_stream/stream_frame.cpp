// SPDX-License-Identifier: MIT
#include "fast/row_stream/stream_frame.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fast/draw_writer.h"
#include "fast/frame_worker.h"
#include "fast/index_writer.h"
#include "fast/row_stream/stream_batches.h"
#include "fast/row_stream/stream_worker.h"

namespace limitcheck::fast::row_stream {

namespace {

using Clock = std::chrono::steady_clock;
using Point = SurfaceVertex<float>;
static_assert(sizeof(Point) == sizeof(Vertex));

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

const data::ControlMesh& checked(const data::ControlMesh& mesh) {
  if (mesh.triangles.empty()) throw std::invalid_argument("tessellator: a mesh without faces");
  for (const auto& p : mesh.positions) {
    for (const double x : p)
      if (!std::isfinite(x)) throw std::invalid_argument("tessellator: a coordinate is not finite");
  }
  return mesh;
}

// The variant of four lanes of the same instructions, or the kernel itself.
const Kernel& narrow_of(const Kernel& kernel) {
  const Kernel* narrow = kernel.lanes > 4 ? find_kernel((std::string(kernel.name) + "/4").c_str()) : nullptr;
  return narrow != nullptr ? *narrow : kernel;
}

}  // namespace

struct StreamTessellator::State {
  State(const data::ControlMesh& given_mesh, const TessellatorOptions& given, const Kernel& kernel)
      : mesh(given_mesh),
        options(given),
        adjacency(checked(mesh)),
        stream(mesh, adjacency, kernel),
        narrow(narrow_of(kernel)) {
    if (options.threads < 0) throw std::invalid_argument("tessellator: a negative number of threads");
    const auto most =
        static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    arena.initialize(options.threads > 0 ? std::min(options.threads, most) : tbb::task_arena::automatic);
  }

  FrameStats prepare(std::span<const std::int32_t> depth) {
    FrameStats stats;
    if (depth.size() != static_cast<std::size_t>(adjacency.face_count())) {
      throw std::invalid_argument("frame: " + std::to_string(depth.size()) + " depths for " +
                                  std::to_string(adjacency.face_count()) + " faces");
    }
    for (const std::int32_t d : depth) {
      if (d < kCulled || d > kMaxDepth)
        throw std::invalid_argument("frame: depth " + std::to_string(d) + " is not in -1.." +
                                    std::to_string(kMaxDepth));
    }
    auto start = Clock::now();
    pairing = pair_faces(adjacency, depth, options.pairing);
    stats.seconds_pairing = seconds_since(start);

    start = Clock::now();
    plan = plan_cracks(adjacency, pairing.depth, options.cracks);
    patches.clear();
    int deepest = 0;
    for (const Pair& pair : pairing.pairs) {
      patches.push_back(Patch::of(adjacency, pair, plan));
      const DrawSize size = draw_size(patches.back(), plan);
      stats.triangles += size.triangles;
      stats.draws += size.draws;
      stats.limit_points += limit_points_of(patches.back(), plan);
      deepest = std::max(deepest, pair.depth);
    }
    for (const std::int8_t d : plan.edge_depth) deepest = std::max<int>(deepest, d);
    largest_depth = deepest;
    batches.make(patches, static_cast<std::size_t>(stream.kernel().lanes),
                 static_cast<std::size_t>(narrow.lanes));
    if (plan.fans > 0 && !control) make_control();
    stats.faces = adjacency.face_count();
    stats.pairs = pairing.pair_count;
    stats.singletons = pairing.singletons;
    stats.fans = plan.fans;
    stats.stitched = plan.stitched;
    for (const std::int32_t d : pairing.depth) stats.culled += d < 0 ? 1 : 0;
    stats.zero_normals = stream.rings().degenerate_normals();
    stats.seconds_planning = seconds_since(start);
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
                            largest_depth};
    tbb::enumerable_thread_specific<StreamWorker> workers;
    const std::size_t total = batches.list().size();
    std::atomic<std::size_t> done = 0;
    std::mutex telling;
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, total, [&](std::size_t b) {
        StreamWorker& worker = workers.local();
        if (worker.scratch().inner.empty()) worker.scratch().reserve(largest_depth);
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

  const data::ControlMesh mesh;
  const TessellatorOptions options;
  Adjacency adjacency;
  RowStream stream;
  const Kernel& narrow;
  std::optional<DepthHeuristics> heuristics;
  std::optional<PreparedMesh<float>> control;
  tbb::task_arena arena;
  fast::Placement<float> as_they_are;  // the kernel has placed the points
  PairingResult pairing;
  CrackPlan plan;
  std::vector<Patch> patches;
  StreamBatches batches;
  std::function<void(std::size_t, std::size_t)> progress;
  std::size_t worker_bytes = 0;
  int largest_depth = 0;
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
const RowStream& StreamTessellator::stream() const {
  return state_->stream;
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
  std::vector<DrawSize> offsets(1);
  for (const Patch& patch : s.patches) {
    const DrawSize size = draw_size(patch, s.plan);
    offsets.push_back({offsets.back().vertices + size.vertices, offsets.back().draws + size.draws, 0});
  }
  out.vertices.resize(static_cast<std::size_t>(offsets.back().vertices));
  out.draws.resize(static_cast<std::size_t>(offsets.back().draws));
  out.provenance.resize(s.options.provenance ? out.vertices.size() : 0);
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
  const IndexLayout layout = IndexLayout::of(s.adjacency, s.pairing.depth, s.plan);
  if (layout.vertex_count > std::numeric_limits<std::uint32_t>::max()) {
    throw std::invalid_argument("frame: " + std::to_string(layout.vertex_count) +
                                " vertices are more than 32-bit indices reach");
  }
  out.vertices.resize(static_cast<std::size_t>(layout.vertex_count));
  out.provenance.resize(s.options.provenance ? out.vertices.size() : 0);
  out.triangles.resize(static_cast<std::size_t>(layout.triangle_count));
  out.triangle_face.resize(out.triangles.size());
  out.triangle_kind.resize(out.triangles.size());
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
                                    IndexedMesh<float>& out) {
  const auto start = Clock::now();
  State& s = *state_;
  std::vector<std::int32_t> depth;
  s.arena.execute([&] {
    if (!s.heuristics) s.heuristics.emplace(s.mesh, s.adjacency, s.options.max_depth);
    depth = s.heuristics->depths(strategy, camera);
  });
  const double heuristics = seconds_since(start);
  FrameStats stats = frame(depth, out);
  stats.seconds_heuristics = heuristics;
  stats.seconds_total += heuristics;
  return stats;
}

}  // namespace limitcheck::fast::row_stream
