// SPDX-License-Identifier: MIT
#include "fast/frame/engine.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "data/error.h"
#include "fast/frame/engine_state.h"

namespace limitcheck::fast {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

const data::ControlMesh& checked(const data::ControlMesh& mesh) {
  if (mesh.faces.empty()) throw data::ArgumentError("tessellator: a mesh without faces");
  for (const auto& p : mesh.positions)
    for (const double x : p)
      if (!std::isfinite(x)) throw data::ArgumentError("tessellator: a coordinate is not finite");
  return mesh;
}

// Sizes a draw list for patches first .. last - 1.
template <class Real>
void make_room(EngineState<Real>& s, std::size_t first, std::size_t last, DrawList<Real>& out) {
  s.offsets.assign(1, {});
  for (std::size_t i = first; i < last; ++i) {
    const DrawSize size = draw_size(s.patches[i], s.plan);
    const DrawSize& at = s.offsets.back();
    s.offsets.push_back({at.vertices + size.vertices, at.draws + size.draws, 0});
  }
  out.vertices.resize(static_cast<std::size_t>(s.offsets.back().vertices));
  out.draws.resize(static_cast<std::size_t>(s.offsets.back().draws));
  out.provenance.resize(s.options.provenance ? out.vertices.size() : 0);
}

// Sizes an indexed mesh for the frame.
template <class Real>
IndexLayout make_room(const EngineState<Real>& s, IndexedMesh<Real>& out) {
  IndexLayout layout = IndexLayout::of(s.adjacency, s.pairing.depth, s.plan);
  if (layout.vertex_count > std::numeric_limits<std::uint32_t>::max())
    throw data::ArgumentError("frame: " + std::to_string(layout.vertex_count) +
                              " vertices are more than 32-bit indices reach");
  out.vertices.resize(static_cast<std::size_t>(layout.vertex_count));
  out.provenance.resize(s.options.provenance ? out.vertices.size() : 0);
  out.triangles.resize(static_cast<std::size_t>(layout.triangle_count));
  out.triangle_face.resize(out.triangles.size());
  out.triangle_kind.resize(out.triangles.size());
  return layout;
}

template <class Real>
void write_control_vertices(const EngineState<Real>& s, const IndexLayout& layout, IndexedMesh<Real>& out) {
  for (std::size_t v = 0; v < layout.vertex.size(); ++v)
    if (layout.vertex[v] != IndexLayout::kUnused)
      out.vertices[layout.vertex[v]] = s.limit(static_cast<std::int32_t>(v));
  if (!s.options.provenance) return;
  for (std::int32_t f = s.adjacency.face_count() - 1; f >= 0; --f) {
    if (s.pairing.depth[f] < 0) continue;
    for (int k = 0; k < 3; ++k) {
      const std::int64_t at = layout.vertex[s.adjacency.corner(f, k)];
      out.provenance[at] = {f, k == 1 ? 1u : 0u, k == 2 ? 1u : 0u, 1};
    }
  }
}

// Hands over the draws of s.part; returns how many vertices they have, in a frame that has had `before`.
template <class Real>
std::int64_t deliver(const EngineState<Real>& s, std::int64_t before, DrawSink<Real>& sink) {
  const std::span vertices(s.part.vertices);
  const std::span provenance(s.part.provenance);
  for (const Draw& draw : s.part.draws) {
    const auto at = static_cast<std::size_t>(draw.first), count = static_cast<std::size_t>(draw.count);
    Draw alone = draw;
    alone.first += before;
    sink.draw(alone, vertices.subspan(at, count),
              provenance.empty() ? provenance : provenance.subspan(at, count));
  }
  return static_cast<std::int64_t>(vertices.size());
}

// One frame: evaluate() delivers the points and returns their number.
template <class Real, class Evaluate>
FrameStats run_frame(EngineState<Real>& s, std::span<const std::int32_t> depth, Evaluate&& evaluate) {
  const auto start = Clock::now();
  FrameStats stats = s.plan_frame(depth);
  const auto preparation = Clock::now();
  s.prepare();
  stats.seconds_planning += seconds_since(preparation);
  const auto evaluation = Clock::now();
  stats.vertices = evaluate();
  stats.seconds_evaluation = seconds_since(evaluation);
  stats.seconds_total = seconds_since(start);
  stats.zero_normals = s.zero_normals();
  return stats;
}

}  // namespace

FrameState::FrameState(const data::ControlMesh& given, const TessellatorOptions& with, const PrintedRules& by)
    : mesh(checked(given)), options(with), rules(by), adjacency(mesh) {
  if (options.threads < 0) throw data::ArgumentError("tessellator: a negative number of threads");
  // More threads than oneTBB has would only earn a warning on standard error.
  const auto most =
      static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  arena.initialize(options.threads > 0 ? std::min(options.threads, most) : tbb::task_arena::automatic);
}

FrameStats FrameState::plan_frame(std::span<const std::int32_t> depth) {
  FrameStats stats;
  check_depths(depth, adjacency.face_count(), kDeepest);
  auto start = Clock::now();
  pairing = pair_faces(adjacency, depth, rules);
  stats.seconds_pairing = seconds_since(start);

  start = Clock::now();
  plan = plan_cracks(adjacency, pairing.depth, options.cracks, rules);
  patches.clear();
  max_depth = 0;
  for (const Grid& grid : pairing.grids) {
    const Patch& patch = patches.emplace_back(Patch::of(adjacency, grid, plan));
    max_depth = std::max(max_depth, grid.depth);
    stats.limit_points += limit_points_of(patch, plan);
    const DrawSize size = draw_size(patch, plan);
    stats.triangles += size.triangles;
    stats.draws += size.draws;
    stats.strips += size.draws;
    for (const Half& half : patch.half)
      if (!patch.full() && half.repaired()) --stats.strips;
  }
  for (const std::int8_t d : plan.edge_depth) max_depth = std::max<int>(max_depth, d);
  stats.faces = adjacency.face_count();
  stats.culled = pairing.culled;
  stats.pairs = pairing.pair_count;
  stats.singletons = pairing.singletons;
  stats.fans = plan.fans;
  stats.stitched = plan.stitched;
  stats.seconds_planning = seconds_since(start);
  return stats;
}

template <class Real>
Engine<Real>::Engine(std::unique_ptr<EngineState<Real>> state) : state_(std::move(state)) {}
template <class Real>
Engine<Real>::~Engine() = default;
template <class Real>
Engine<Real>::Engine(Engine&&) noexcept = default;
template <class Real>
Engine<Real>& Engine<Real>::operator=(Engine&&) noexcept = default;

template <class Real>
const Adjacency& Engine<Real>::adjacency() const {
  return state_->adjacency;
}
template <class Real>
const PairingResult& Engine<Real>::last_pairing() const {
  return state_->pairing;
}
template <class Real>
const CrackPlan& Engine<Real>::last_plan() const {
  return state_->plan;
}

template <class Real>
std::vector<std::int32_t> Engine<Real>::depths(const DepthOptions& strategy, const Camera& camera,
                                               double& seconds) {
  const auto start = Clock::now();
  std::vector<std::int32_t> depth;
  state_->arena.execute([&] {
    if (!state_->heuristics)
      state_->heuristics.emplace(state_->mesh, state_->adjacency, state_->options.max_depth);
    depth = state_->heuristics->depths(strategy, camera);
    for (const std::int32_t f : state_->mesh.holes) depth[f] = -1;
  });
  seconds = seconds_since(start);
  return depth;
}

template <class Real>
FrameStats Engine<Real>::frame(std::span<const std::int32_t> depth, DrawList<Real>& out) {
  return run_frame(*state_, depth, [&] {
    make_room(*state_, 0, state_->patches.size(), out);
    state_->draw(0, state_->patches.size(), out);
    return static_cast<std::int64_t>(out.vertices.size());
  });
}

template <class Real>
FrameStats Engine<Real>::frame(std::span<const std::int32_t> depth, IndexedMesh<Real>& out) {
  return run_frame(*state_, depth, [&] {
    const IndexLayout layout = make_room(*state_, out);
    write_control_vertices(*state_, layout, out);
    state_->index(layout, out);
    return layout.vertex_count;
  });
}

template <class Real>
FrameStats Engine<Real>::frame(std::span<const std::int32_t> depth, DrawSink<Real>& sink) {
  constexpr std::int64_t kBatch = std::int64_t{1} << 18;  // vertices kept at a time
  return run_frame(*state_, depth, [&] {
    EngineState<Real>& s = *state_;
    std::int64_t vertices = 0;
    for (std::size_t first = 0, last = 0; first < s.patches.size(); first = last) {
      for (std::int64_t size = 0; last < s.patches.size() && size < kBatch; ++last)
        size += draw_size(s.patches[last], s.plan).vertices;
      make_room(s, first, last, s.part);
      s.draw(first, last, s.part);
      vertices += deliver(s, vertices, sink);
    }
    return vertices;
  });
}

template class Engine<float>;
template class Engine<double>;

}  // namespace limitcheck::fast
