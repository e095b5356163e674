// SPDX-License-Identifier: MIT
#include "fast/frame.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "fast/crack_centre.h"
#include "fast/crack_edge.h"
#include "fast/draw_writer.h"
#include "fast/index_writer.h"
#include "fast/sliding_window.h"
#include "fast/triangle_lattice.h"

namespace limitcheck::fast {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Everything that is reused from patch to patch: one per thread.
template <class Real>
struct Worker {
  Worker(int max_depth, int max_valence, bool isolated_faces)
      : window(max_depth, max_valence), edge(max_depth, max_valence), centre(max_valence) {
    if (isolated_faces) lattice.emplace(max_depth);
    scratch.reserve(max_depth);
    for (auto& b : border) b.resize((std::size_t{1} << max_depth) + 1);
  }

  SlidingWindow<Real> window;
  EdgeStrip<Real> edge;
  FanCentreEvaluator<Real> centre;
  std::optional<TriangleLattice<Real>> lattice;
  typename DrawWriter<Real>::Scratch scratch;
  std::array<std::vector<SurfaceVertex<Real>>, 3> border;

  std::int64_t zero_normals() const {
    return window.zero_normals() + edge.zero_normals() + centre.zero_normals() +
           (lattice ? lattice->zero_normals() : 0);
  }
};

/// Evaluates one patch and hands every piece to the writer.
template <class Real, class Writer>
void evaluate(const PreparedMesh<Real>& mesh, const Patch& patch, const CrackPlan& plan, FanCentre centre,
              Worker<Real>& worker, Writer& writer) {
  using Vertex = SurfaceVertex<Real>;
  const int k = 1 << patch.depth;
  if (patch.half[1].face < 0) {
    worker.lattice->run(mesh, patch.half[0].face, patch.depth, [&](int row, const Vertex* strip) {
      writer.half_strip(0, row, [&](int q) -> const Vertex& { return strip[q]; });
    });
    return;
  }
  if (patch.half[0].uses_window() || patch.half[1].uses_window()) {
    const bool full = patch.full();
    const std::int32_t h0 = 3 * patch.half[0].face + patch.half[0].edge;
    worker.window.run(mesh, h0, patch.depth, [&](int row, const Vertex* strip) {
      if (full) return writer.whole_strip(row, strip);
      if (patch.half[0].uses_window())
        writer.half_strip(0, row, [&](int q) -> const Vertex& { return strip[q]; });
      if (patch.half[1].uses_window())
        writer.half_strip(1, k - 1 - row, [&](int q) -> const Vertex& { return strip[2 * k + 1 - q]; });
    });
  }
  for (int side = 0; side < 2; ++side) {
    const Half& half = patch.half[side];
    if (half.show != Half::Show::kFan && half.show != Half::Show::kStitch) continue;
    Border<Real> border;
    for (int e = 0; e < 3; ++e) {
      auto& points = worker.border[static_cast<std::size_t>(e)];
      worker.edge.evaluate(mesh, 3 * half.face + e, edge_depth(plan, half.face, e), points.data());
      border[static_cast<std::size_t>(e)] = points.data();
    }
    if (half.show == Half::Show::kFan)
      writer.fan(side, worker.centre.evaluate(mesh, half.face, centre), border);
    else
      writer.ring(side, border);
  }
}

/// Limit points evaluated for a patch: rows carried over, every repaired border, centres.
std::int64_t limit_points_of(const Patch& patch, const CrackPlan& plan) {
  const std::int64_t k = std::int64_t{1} << patch.depth;
  std::int64_t points = 0;
  if (patch.half[1].face < 0)
    points = (k + 1) * (k + 1);  // the lattice evaluates both rows of every strip
  else if (patch.half[0].uses_window() || patch.half[1].uses_window())
    points = (k + 1) * (k + 1);
  for (const Half& half : patch.half) {
    if (half.show != Half::Show::kFan && half.show != Half::Show::kStitch) continue;
    for (int e = 0; e < 3; ++e) points += std::int64_t{1} << edge_depth(plan, half.face, e);
    points += half.show == Half::Show::kFan ? 1 : 0;
  }
  return points;
}

struct Frame {
  PairingResult pairing;
  CrackPlan plan;
  std::vector<Patch> patches;
  int max_depth = 0;
};

}  // namespace

template <class Real>
struct Tessellator<Real>::State {
  State(const data::ControlMesh& control, const TessellatorOptions& given)
      : mesh(control), options(given), adjacency(mesh) {
    if (options.threads < 0) throw std::invalid_argument("tessellator: a negative number of threads");
    if (mesh.triangles.empty()) throw std::invalid_argument("tessellator: a mesh without faces");
    prepared.emplace(adjacency, place());
    // More threads than oneTBB has would only earn a warning on standard error.
    const auto most =
        static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    arena.initialize(options.threads > 0 ? std::min(options.threads, most) : tbb::task_arena::automatic);
    for (std::int32_t f = 0; f < adjacency.face_count(); ++f)
      if (adjacency.neighbour(f, 0) < 0 && adjacency.neighbour(f, 1) < 0 && adjacency.neighbour(f, 2) < 0)
        isolated_faces = true;
  }

  /// The control points relative to a centre, scaled by a power of two to at most 1: normals of tiny and huge
  /// meshes neither vanish nor overflow, and far from the origin no digits are lost. Near the origin the
  /// centre is 0, so that the control points stay exact.
  std::vector<Vec3<Real>> place() {
    double low[3], high[3];
    std::fill_n(low, 3, std::numeric_limits<double>::infinity());
    std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
    for (const auto& p : mesh.positions) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (!std::isfinite(p[i])) throw std::invalid_argument("tessellator: a coordinate is not finite");
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
    }
    double size = 0, centre[3];
    for (int i = 0; i < 3; ++i) size = std::max(size, high[i] - low[i]);
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
      const double middle = static_cast<double>(static_cast<Real>(low[i] / 2 + high[i] / 2));
      centre[i] = std::abs(middle) > 2 * size ? middle : 0;
      largest = std::max({largest, std::abs(low[i] - centre[i]), std::abs(high[i] - centre[i])});
    }
    int exponent = 0;
    if (largest > 0) std::frexp(largest, &exponent);
    placement.scale = static_cast<Real>(std::ldexp(1.0, exponent));
    placement.offset = {static_cast<Real>(centre[0]), static_cast<Real>(centre[1]),
                        static_cast<Real>(centre[2])};
    if (!std::isfinite(placement.scale) || !(placement.scale > 0))
      throw std::invalid_argument("tessellator: the mesh is too large or too small for its number type");
    std::vector<Vec3<Real>> positions;
    positions.reserve(mesh.positions.size());
    const auto scaled = [&](double x, int i) {
      return static_cast<Real>(std::ldexp(x - centre[i], -exponent));
    };
    for (const auto& p : mesh.positions)
      positions.push_back({scaled(p[0], 0), scaled(p[1], 1), scaled(p[2], 2)});
    return positions;
  }

  /// Pairing, crack plan, patches; workers deep enough.
  FrameStats prepare(std::span<const std::int32_t> depth) {
    FrameStats stats;
    if (depth.size() != mesh.triangles.size())
      throw std::invalid_argument("frame: " + std::to_string(depth.size()) + " depths for " +
                                  std::to_string(mesh.triangles.size()) + " faces");
    for (const std::int32_t d : depth)
      if (d < kCulled || d > kDeepest)
        throw std::invalid_argument("frame: depth " + std::to_string(d) + " is not in -1.." +
                                    std::to_string(kDeepest));
    auto start = Clock::now();
    frame.pairing = pair_faces(adjacency, depth, options.pairing);
    stats.seconds_pairing = seconds_since(start);
    start = Clock::now();
    frame.plan = plan_cracks(adjacency, frame.pairing.depth, options.cracks);
    frame.patches.clear();
    frame.max_depth = 0;
    for (const Pair& pair : frame.pairing.pairs) {
      frame.patches.push_back(Patch::of(adjacency, pair, frame.plan));
      frame.max_depth = std::max(frame.max_depth, pair.depth);
    }
    for (const std::int8_t d : frame.plan.edge_depth) frame.max_depth = std::max<int>(frame.max_depth, d);
    if (workers.empty() || frame.max_depth > worker_depth) {
      workers.clear();
      worker_depth = frame.max_depth;
      for (int i = 0; i < arena.max_concurrency(); ++i)
        workers.push_back(
            std::make_unique<Worker<Real>>(worker_depth, adjacency.max_valence(), isolated_faces));
    }
    stats.faces = adjacency.face_count();
    stats.pairs = frame.pairing.pair_count;
    stats.singletons = frame.pairing.singletons;
    stats.fans = frame.plan.fans;
    stats.stitched = frame.plan.stitched;
    for (std::size_t f = 0; f < depth.size(); ++f) {
      stats.culled += frame.pairing.depth[f] < 0 ? 1 : 0;
      stats.revived += depth[f] < 0 && frame.pairing.depth[f] >= 0 ? 1 : 0;
    }
    for (const Patch& patch : frame.patches) {
      stats.limit_points += limit_points_of(patch, frame.plan);
      const DrawSize size = draw_size(patch, frame.plan);
      stats.triangles += size.triangles;
      stats.draws += size.draws;
      stats.strips += size.draws;
      for (const Half& half : patch.half)
        if (!patch.full() && (half.show == Half::Show::kFan || half.show == Half::Show::kStitch))
          --stats.strips;
    }
    zero_normals_before = prepared->zero_normals();
    for (const auto& worker : workers) zero_normals_before -= worker->zero_normals();
    stats.seconds_planning = seconds_since(start);
    return stats;
  }

  /// Runs make_writer(i) and evaluate for patches first .. last - 1, in parallel.
  template <class MakeWriter>
  void run(std::size_t first, std::size_t last, MakeWriter&& make_writer) {
    const auto chunk = [&](std::size_t from, std::size_t to) {
      Worker<Real>& worker = *workers[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())];
      for (std::size_t i = from; i < to; ++i) {
        auto writer = make_writer(i, worker);
        evaluate(*prepared, frame.patches[i], frame.plan, options.cracks.centre, worker, writer);
      }
    };
    arena.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(first, last, 16),
                        [&](const tbb::blocked_range<std::size_t>& r) { chunk(r.begin(), r.end()); });
    });
  }

  /// Patches first .. last - 1 into a draw list, at the offsets of their sizes.
  void draw(std::size_t first, std::size_t last, DrawList<Real>& out) {
    offsets.assign(1, {});
    for (std::size_t i = first; i < last; ++i) {
      const DrawSize size = draw_size(frame.patches[i], frame.plan);
      offsets.push_back({offsets.back().vertices + size.vertices, offsets.back().draws + size.draws, 0});
    }
    out.vertices.resize(static_cast<std::size_t>(offsets.back().vertices));
    out.draws.resize(static_cast<std::size_t>(offsets.back().draws));
    out.provenance.resize(options.provenance ? out.vertices.size() : 0);
    run(first, last, [&](std::size_t i, Worker<Real>& worker) {
      const DrawSize& at = offsets[i - first];
      return DrawWriter<Real>(frame.patches[i], frame.plan, placement, out.vertices.data() + at.vertices,
                              options.provenance ? out.provenance.data() + at.vertices : nullptr,
                              out.draws.data() + at.draws, at.vertices, worker.scratch);
    });
  }

  void index(IndexedMesh<Real>& out) {
    const IndexLayout layout = IndexLayout::of(adjacency, frame.pairing.depth, frame.plan);
    if (layout.vertex_count > std::numeric_limits<std::uint32_t>::max())
      throw std::invalid_argument("frame: " + std::to_string(layout.vertex_count) +
                                  " vertices are more than 32-bit indices reach");
    out.vertices.resize(static_cast<std::size_t>(layout.vertex_count));
    out.provenance.resize(options.provenance ? out.vertices.size() : 0);
    out.triangles.resize(static_cast<std::size_t>(layout.triangle_count));
    out.triangle_face.resize(out.triangles.size());
    out.triangle_kind.resize(out.triangles.size());
    for (std::size_t v = 0; v < layout.vertex.size(); ++v)
      if (layout.vertex[v] != IndexLayout::kUnused)
        out.vertices[static_cast<std::size_t>(layout.vertex[v])] =
            placement(prepared->limit(static_cast<std::int32_t>(v)));
    if (options.provenance) {
      for (std::int32_t f = adjacency.face_count() - 1; f >= 0; --f)
        for (int k = 0; k < 3 && frame.pairing.depth[static_cast<std::size_t>(f)] >= 0; ++k)
          out.provenance[static_cast<std::size_t>(
              layout.vertex[static_cast<std::size_t>(adjacency.corner(f, k))])] = {f, k == 1 ? 1u : 0u,
                                                                                   k == 2 ? 1u : 0u, 1};
    }
    run(0, frame.patches.size(), [&](std::size_t i, Worker<Real>&) {
      return IndexWriter<Real>(adjacency, frame.patches[i], frame.plan, layout, placement, out);
    });
  }

  void finish(FrameStats& stats, Clock::time_point start) const {
    stats.seconds_total = seconds_since(start);
    stats.zero_normals = zero_normals_before;
    for (const auto& worker : workers) stats.zero_normals += worker->zero_normals();
  }

  data::ControlMesh mesh;
  TessellatorOptions options;
  Adjacency adjacency;
  Placement<Real> placement;
  std::optional<PreparedMesh<Real>> prepared;
  std::optional<DepthHeuristics> heuristics;
  bool isolated_faces = false;
  tbb::task_arena arena;
  std::vector<std::unique_ptr<Worker<Real>>> workers;
  int worker_depth = 0;
  Frame frame;
  std::vector<DrawSize> offsets;
  DrawList<Real> batch;
  std::int64_t zero_normals_before = 0;
};

template <class Real>
Tessellator<Real>::Tessellator(const data::ControlMesh& mesh, const TessellatorOptions& options)
    : state_(std::make_unique<State>(mesh, options)) {}
template <class Real>
Tessellator<Real>::~Tessellator() = default;
template <class Real>
Tessellator<Real>::Tessellator(Tessellator&&) noexcept = default;
template <class Real>
Tessellator<Real>& Tessellator<Real>::operator=(Tessellator&&) noexcept = default;

template <class Real>
const Adjacency& Tessellator<Real>::adjacency() const {
  return state_->adjacency;
}
template <class Real>
const PairingResult& Tessellator<Real>::last_pairing() const {
  return state_->frame.pairing;
}
template <class Real>
const CrackPlan& Tessellator<Real>::last_plan() const {
  return state_->frame.plan;
}

template <class Real>
FrameStats Tessellator<Real>::frame(std::span<const std::int32_t> depth, DrawList<Real>& out) {
  const auto start = Clock::now();
  FrameStats stats = state_->prepare(depth);
  const auto evaluation = Clock::now();
  state_->draw(0, state_->frame.patches.size(), out);
  stats.vertices = static_cast<std::int64_t>(out.vertices.size());
  stats.seconds_evaluation = seconds_since(evaluation);
  state_->finish(stats, start);
  return stats;
}

template <class Real>
FrameStats Tessellator<Real>::frame(std::span<const std::int32_t> depth, IndexedMesh<Real>& out) {
  const auto start = Clock::now();
  FrameStats stats = state_->prepare(depth);
  const auto evaluation = Clock::now();
  state_->index(out);
  stats.vertices = static_cast<std::int64_t>(out.vertices.size());
  stats.seconds_evaluation = seconds_since(evaluation);
  state_->finish(stats, start);
  return stats;
}

template <class Real>
FrameStats Tessellator<Real>::frame(std::span<const std::int32_t> depth, DrawSink<Real>& sink) {
  constexpr std::int64_t kBatch = std::int64_t{1} << 18;  // vertices kept at a time
  const auto start = Clock::now();
  State& s = *state_;
  FrameStats stats = s.prepare(depth);
  const auto evaluation = Clock::now();
  for (std::size_t first = 0, last = 0; first < s.frame.patches.size(); first = last) {
    for (std::int64_t size = 0; last < s.frame.patches.size() && size < kBatch; ++last)
      size += draw_size(s.frame.patches[last], s.frame.plan).vertices;
    s.draw(first, last, s.batch);
    for (const Draw& draw : s.batch.draws) {
      const auto at = static_cast<std::size_t>(draw.first), count = static_cast<std::size_t>(draw.count);
      Draw alone = draw;
      alone.first = stats.vertices;
      sink.draw(alone, std::span(s.batch.vertices).subspan(at, count),
                s.batch.provenance.empty()
                    ? std::span<const LatticePoint>()
                    : std::span<const LatticePoint>(s.batch.provenance).subspan(at, count));
      stats.vertices += draw.count;
    }
  }
  stats.seconds_evaluation = seconds_since(evaluation);
  s.finish(stats, start);
  return stats;
}

template <class Real>
template <class Sink>
FrameStats Tessellator<Real>::frame_by_strategy(const DepthOptions& strategy, const Camera& camera,
                                                Sink& sink) {
  const auto start = Clock::now();
  State& s = *state_;
  std::vector<std::int32_t> depth;
  s.arena.execute([&] {
    if (!s.heuristics) s.heuristics.emplace(s.mesh, s.adjacency, s.options.max_depth);
    depth = s.heuristics->depths(strategy, camera);
  });
  const double heuristics = seconds_since(start);
  FrameStats stats = frame(depth, sink);
  stats.seconds_heuristics = heuristics;
  stats.seconds_total += heuristics;
  return stats;
}

template <class Real>
FrameStats Tessellator<Real>::frame(const DepthOptions& strategy, const Camera& camera, DrawList<Real>& out) {
  return frame_by_strategy(strategy, camera, out);
}
template <class Real>
FrameStats Tessellator<Real>::frame(const DepthOptions& strategy, const Camera& camera,
                                    IndexedMesh<Real>& out) {
  return frame_by_strategy(strategy, camera, out);
}
template <class Real>
FrameStats Tessellator<Real>::frame(const DepthOptions& strategy, const Camera& camera,
                                    DrawSink<Real>& sink) {
  return frame_by_strategy(strategy, camera, sink);
}

template class Tessellator<float>;
template class Tessellator<double>;
}  // namespace limitcheck::fast
