// SPDX-License-Identifier: MIT
#include "fast/window/tessellator.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "fast/frame/frame_state.h"
#include "fast/window/frame_worker.h"

namespace limitcheck::fast {

template <class Real>
struct Tessellator<Real>::State : FrameState {
  State(const data::ControlMesh& control, const TessellatorOptions& given) : FrameState(control, given) {
    prepared.emplace(adjacency, place());
    for (std::int32_t f = 0; f < adjacency.face_count(); ++f)
      if (adjacency.neighbour(f, 0) < 0 && adjacency.neighbour(f, 1) < 0 && adjacency.neighbour(f, 2) < 0)
        isolated_faces = true;
  }

  /// The control points relative to a centre, scaled by a power of two to at most 1: normals of tiny and huge
  /// meshes neither vanish nor overflow, and no digits are lost to a common offset. Near the origin the
  /// centre is taken only if every control point stays exact.
  std::vector<Vec3<Real>> place() {
    double low[3], high[3];
    std::fill_n(low, 3, std::numeric_limits<double>::infinity());
    std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
    for (const auto& p : mesh.positions) {
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
    }
    double size = 0, centre[3];
    for (int i = 0; i < 3; ++i) size = std::max(size, high[i] - low[i]);
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
      centre[i] = choose_centre(i, low[i], high[i], size);
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

  double choose_centre(int axis, double low, double high, double size) const {
    // few digits, so that subtracting it rarely costs any
    const double unit = size > 0 ? std::exp2(std::floor(std::log2(size)) - 3) : 1;
    const double coarse = std::round((low / 2 + high / 2) / unit) * unit;
    if (static_cast<double>(static_cast<Real>(coarse)) != coarse) return 0;
    if (std::abs(coarse) > 2 * size) return coarse;
    for (const auto& p : mesh.positions) {
      const double x = static_cast<double>(static_cast<Real>(p[static_cast<std::size_t>(axis)]));
      if (static_cast<double>(static_cast<Real>(x - coarse)) != x - coarse || x - coarse + coarse != x)
        return 0;
    }
    return coarse;
  }

  /// Plans the frame; workers deep enough.
  FrameStats prepare(std::span<const std::int32_t> depth) {
    FrameStats stats = plan_frame(depth, kDeepest);
    const auto start = Clock::now();
    if (workers.empty() || max_depth > worker_depth) {
      workers.clear();
      worker_depth = max_depth;
      for (int i = 0; i < arena.max_concurrency(); ++i)
        workers.push_back(
            std::make_unique<Worker<Real>>(worker_depth, adjacency.max_valence(), isolated_faces));
    }
    zero_normals_before = prepared->zero_normals();
    for (const auto& worker : workers) zero_normals_before -= worker->zero_normals();
    stats.seconds_planning += seconds_since(start);
    return stats;
  }

  /// Runs make_writer(i) and evaluate for patches first .. last - 1, in parallel.
  template <class MakeWriter>
  void run(std::size_t first, std::size_t last, MakeWriter&& make_writer) {
    const auto chunk = [&](std::size_t from, std::size_t to) {
      Worker<Real>& worker = *workers[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())];
      for (std::size_t i = from; i < to; ++i) {
        auto writer = make_writer(i, worker);
        evaluate(*prepared, patches[i], plan, options.cracks.centre, worker, writer);
      }
    };
    arena.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(first, last, 16),
                        [&](const tbb::blocked_range<std::size_t>& r) { chunk(r.begin(), r.end()); });
    });
  }

  /// Patches first .. last - 1 into a draw list, at the offsets of their sizes.
  void draw(std::size_t first, std::size_t last, DrawList<Real>& out) {
    make_room(first, last, out, offsets);
    run(first, last, [&](std::size_t i, Worker<Real>& worker) {
      const DrawSize& at = offsets[i - first];
      return DrawWriter<Real>(patches[i], plan, placement, out.vertices.data() + at.vertices,
                              options.provenance ? out.provenance.data() + at.vertices : nullptr,
                              out.draws.data() + at.draws, at.vertices, worker.scratch);
    });
  }

  void index(IndexedMesh<Real>& out) {
    const IndexLayout layout = make_room(out);
    for (std::size_t v = 0; v < layout.vertex.size(); ++v)
      if (layout.vertex[v] != IndexLayout::kUnused)
        out.vertices[static_cast<std::size_t>(layout.vertex[v])] =
            placement(prepared->limit(static_cast<std::int32_t>(v)));
    if (options.provenance) {
      for (std::int32_t f = adjacency.face_count() - 1; f >= 0; --f)
        for (int k = 0; k < 3 && pairing.depth[static_cast<std::size_t>(f)] >= 0; ++k)
          out.provenance[static_cast<std::size_t>(
              layout.vertex[static_cast<std::size_t>(adjacency.corner(f, k))])] = {f, k == 1 ? 1u : 0u,
                                                                                   k == 2 ? 1u : 0u, 1};
    }
    run(0, patches.size(), [&](std::size_t i, Worker<Real>&) {
      return IndexWriter<Real>(adjacency, patches[i], plan, layout, placement, out);
    });
  }

  void finish(FrameStats& stats, Clock::time_point start) const {
    stats.seconds_total = seconds_since(start);
    stats.zero_normals = zero_normals_before;
    for (const auto& worker : workers) stats.zero_normals += worker->zero_normals();
  }

  Placement<Real> placement;
  std::optional<PreparedMesh<Real>> prepared;
  bool isolated_faces = false;
  std::vector<std::unique_ptr<Worker<Real>>> workers;
  int worker_depth = 0;
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
  return state_->pairing;
}
template <class Real>
const CrackPlan& Tessellator<Real>::last_plan() const {
  return state_->plan;
}

template <class Real>
FrameStats Tessellator<Real>::frame(std::span<const std::int32_t> depth, DrawList<Real>& out) {
  const auto start = Clock::now();
  FrameStats stats = state_->prepare(depth);
  const auto evaluation = Clock::now();
  state_->draw(0, state_->patches.size(), out);
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
  for (std::size_t first = 0, last = 0; first < s.patches.size(); first = last) {
    for (std::int64_t size = 0; last < s.patches.size() && size < kBatch; ++last)
      size += draw_size(s.patches[last], s.plan).vertices;
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
  return state_->by_strategy(strategy, camera,
                             [&](std::span<const std::int32_t> depth) { return frame(depth, sink); });
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
