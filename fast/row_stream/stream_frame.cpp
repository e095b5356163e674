// SPDX-License-Identifier: MIT
#include "fast/row_stream/stream_frame.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fast/crack_centre.h"
#include "fast/draw_writer.h"
#include "fast/index_writer.h"

namespace limitcheck::fast::row_stream {

namespace {

using Clock = std::chrono::steady_clock;
using Point = SurfaceVertex<float>;
static_assert(sizeof(Point) == sizeof(Vertex));

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Point as_point(const Vertex& v) {
  return {{v.position[0], v.position[1], v.position[2]}, {v.normal[0], v.normal[1], v.normal[2]}};
}

const data::ControlMesh& checked(const data::ControlMesh& mesh) {
  if (mesh.triangles.empty()) throw std::invalid_argument("tessellator: a mesh without faces");
  for (const auto& p : mesh.positions) {
    for (const double x : p)
      if (!std::isfinite(x)) throw std::invalid_argument("tessellator: a coordinate is not finite");
  }
  return mesh;
}

/// One thread's memory.
struct Worker {
  Workspace workspace;
  std::vector<Vertex> pairs;  // a batch
  std::vector<Vertex> edge;
  std::vector<Point> strip;
  std::array<std::vector<Point>, 3> border;
  DrawWriter<float>::Scratch scratch;
  std::optional<FanCentreEvaluator<float>> centre;
};

}  // namespace

struct StreamTessellator::State {
  State(const data::ControlMesh& mesh, const TessellatorOptions& given, const Kernel& kernel)
      : options(given), adjacency(checked(mesh)), stream(mesh, adjacency, kernel) {
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
      deepest = std::max(deepest, pair.depth);
    }
    for (const std::int8_t d : plan.edge_depth) deepest = std::max<int>(deepest, d);
    largest_depth = deepest;
    make_batches();
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

  // Patches by depth, as many together as the kernel has lanes; those of fans alone have nothing for the
  // kernel.
  void make_batches() {
    std::array<std::vector<std::size_t>, kMaxDepth + 1> by_depth;
    batches.clear();
    for (std::size_t i = 0; i < patches.size(); ++i) {
      if (patches[i].half[0].uses_window() || patches[i].half[1].uses_window())
        by_depth[static_cast<std::size_t>(patches[i].depth)].push_back(i);
      else
        batches.push_back({i});
    }
    const auto lanes = static_cast<std::size_t>(stream.kernel().lanes);
    for (const auto& list : by_depth) {
      for (std::size_t first = 0; first < list.size(); first += lanes) {
        const auto from = list.begin() + static_cast<std::ptrdiff_t>(first);
        const auto count = static_cast<std::ptrdiff_t>(std::min(lanes, list.size() - first));
        batches.emplace_back(from, from + count);
      }
    }
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
    tbb::enumerable_thread_specific<Worker> workers;
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, batches.size(), [&](std::size_t b) {
        Worker& worker = workers.local();
        if (worker.scratch.inner.empty()) worker.scratch.reserve(largest_depth);
        batch(batches[b], worker, make_writer);
      });
    });
  }

  template <class MakeWriter>
  void batch(const std::vector<std::size_t>& members, Worker& worker, MakeWriter&& make_writer) {
    const Patch& first = patches[members.front()];
    const auto n = static_cast<std::size_t>(side(first.depth));
    const bool window = first.half[0].uses_window() || first.half[1].uses_window();
    if (window) {
      std::vector<Pair> pairs;
      for (const std::size_t i : members) pairs.push_back(pairing.pairs[i]);
      worker.pairs.resize(members.size() * n * n);
      stream.whole(pairs, first.depth, worker.workspace, worker.pairs.data());
    }
    for (std::size_t m = 0; m < members.size(); ++m) {
      const Patch& patch = patches[members[m]];
      auto writer = make_writer(members[m], worker);
      if (window) strips(patch, worker.pairs.data() + m * n * n, worker, writer);
      repairs(patch, worker, writer);
    }
  }

  // Row r of the sliding window's frame is our row k - r.
  template <class Writer>
  void strips(const Patch& patch, const Vertex* points, Worker& worker, Writer& writer) {
    const int k = 1 << patch.depth;
    const auto at = [&](int row, int column) { return as_point(points[(k - row) * (k + 1) + column]); };
    worker.strip.resize(2 * static_cast<std::size_t>(k + 1));
    for (int row = 0; row < k; ++row) {
      for (int c = 0; c <= k; ++c) {
        worker.strip[2 * static_cast<std::size_t>(c)] = at(row, c);
        worker.strip[2 * static_cast<std::size_t>(c) + 1] = at(row + 1, c);
      }
      const Point* strip = worker.strip.data();
      if (patch.full()) {
        writer.whole_strip(row, strip);
      } else if (patch.half[0].uses_window()) {
        writer.half_strip(0, row, [&](int q) -> const Point& { return strip[q]; });
      }
    }
    if (patch.full() || !patch.half[1].uses_window()) return;
    for (int row = 0; row < k; ++row) {  // in the other half's frame
      for (int c = 0; c <= k; ++c) {
        worker.strip[2 * static_cast<std::size_t>(c)] = at(k - row, k - c);
        worker.strip[2 * static_cast<std::size_t>(c) + 1] = at(k - row - 1, k - c);
      }
      const Point* strip = worker.strip.data();
      writer.half_strip(1, row, [&](int q) -> const Point& { return strip[q]; });
    }
  }

  template <class Writer>
  void repairs(const Patch& patch, Worker& worker, Writer& writer) {
    for (int s = 0; s < 2; ++s) {
      const Half& half = patch.half[s];
      if (half.show != Half::Show::kFan && half.show != Half::Show::kStitch) continue;
      Border<float> border;
      for (int e = 0; e < 3; ++e) {
        const std::int32_t h = 3 * half.face + e;
        const int depth = edge_depth(plan, half.face, e);
        worker.edge.resize(static_cast<std::size_t>(side(depth)));
        stream.edges({&h, 1}, depth, worker.workspace, worker.edge.data());
        auto& points = worker.border[static_cast<std::size_t>(e)];
        points.clear();
        for (const Vertex& v : worker.edge) points.push_back(as_point(v));
        border[static_cast<std::size_t>(e)] = points.data();
      }
      if (half.show == Half::Show::kFan) {
        if (!worker.centre) worker.centre.emplace(adjacency.max_valence());
        const auto placement = stream.rings().placement();
        const fast::Placement<float> place{placement.unit,
                                           {placement.centre[0], placement.centre[1], placement.centre[2]}};
        writer.fan(s, place(worker.centre->evaluate(*control, half.face, options.cracks.centre)), border);
      } else {
        writer.ring(s, border);
      }
    }
  }

  const TessellatorOptions options;
  Adjacency adjacency;
  RowStream stream;
  std::optional<PreparedMesh<float>> control;
  tbb::task_arena arena;
  fast::Placement<float> as_they_are;  // the kernel has placed the points
  PairingResult pairing;
  CrackPlan plan;
  std::vector<Patch> patches;
  std::vector<std::vector<std::size_t>> batches;
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
  s.run([&](std::size_t i, Worker& worker) {
    const DrawSize& at = offsets[i];
    return DrawWriter<float>(s.patches[i], s.plan, s.as_they_are, out.vertices.data() + at.vertices,
                             s.options.provenance ? out.provenance.data() + at.vertices : nullptr,
                             out.draws.data() + at.draws, at.vertices, worker.scratch);
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
  s.run([&](std::size_t i, Worker&) {
    return IndexWriter<float>(s.adjacency, s.patches[i], s.plan, layout, s.as_they_are, out);
  });
  stats.vertices = static_cast<std::int64_t>(out.vertices.size());
  stats.seconds_evaluation = seconds_since(evaluation);
  stats.seconds_total = seconds_since(start);
  return stats;
}

}  // namespace limitcheck::fast::row_stream
