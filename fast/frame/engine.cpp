// SPDX-License-Identifier: MIT
#include "fast/frame/engine.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "data/error.h"
#include "fast/frame/patch_store.h"
#include "fast/frame/scheme_frames.h"

namespace limitcheck::fast {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

PairingResult QuadScheme::pair(std::span<const std::int32_t> depth, std::span<const Grid> /*keep*/) const {
  PairingResult out;
  out.depth.assign(depth.begin(), depth.end());
  for (std::int32_t f = 0; f < faces.size(); ++f)
    if (depth[f] >= 0) out.grids.push_back({f, -1, -1, -1, depth[f]});
  out.pair_count = static_cast<std::int64_t>(out.grids.size());
  out.culled = faces.size() - out.pair_count;
  return out;
}

template <class Real, class Scheme>
FrameStats SchemeFrames<Real, Scheme>::plan_frame(std::span<const std::int32_t> depth,
                                                  std::span<const Grid> keep) {
  FrameStats stats;
  check_depths(depth, faces.size(), kDeepest);
  auto start = Clock::now();
  pairing = this->pair(depth, keep);
  stats.seconds_pairing = seconds_since(start);

  start = Clock::now();
  plan = plan_cracks(faces, pairing.depth, options.cracks, this->rules);
  patches.clear();
  max_depth = 0;
  for (const Grid& grid : pairing.grids) {
    const Patch& patch = patches.emplace_back(patch_of(faces, grid, plan));
    max_depth = std::max(max_depth, grid.depth);
    const PatchCounts counts = count(patch, faces, plan);
    stats.limit_points += counts.limit_points;
    stats.triangles += counts.size.triangles;
    stats.draws += counts.size.draws;
    stats.strips += counts.strips;
  }
  for (const std::int8_t d : plan.edge_depth) max_depth = std::max<int>(max_depth, d);
  stats.faces = faces.size();
  stats.culled = pairing.culled;
  stats.pairs = pairing.pair_count;
  stats.singletons = pairing.singletons;
  stats.fans = plan.fans;
  stats.stitched = plan.stitched;
  stats.seconds_planning = seconds_since(start);
  return stats;
}

template <class Real, class Scheme>
void SchemeFrames<Real, Scheme>::write_index(IndexedMesh<Real>& out) {
  const IndexLayout layout = IndexLayout::of(faces, pairing.depth, plan);
  if (layout.vertex_count > std::numeric_limits<std::uint32_t>::max())
    throw data::ArgumentError("frame: " + std::to_string(layout.vertex_count) +
                              " vertices are more than 32-bit indices reach");
  out.vertices.resize(static_cast<std::size_t>(layout.vertex_count));
  out.provenance.resize(options.provenance ? out.vertices.size() : 0);
  out.triangles.resize(static_cast<std::size_t>(layout.triangle_count));
  out.triangle_face.resize(out.triangles.size());
  out.triangle_kind.resize(out.triangles.size());
  write_control_vertices(layout, out);
  index(layout, out);
}

template <class Real, class Scheme>
void SchemeFrames<Real, Scheme>::write_control_vertices(const IndexLayout& layout,
                                                        IndexedMesh<Real>& out) const {
  for (std::size_t v = 0; v < layout.vertex.size(); ++v)
    if (layout.vertex[v] != IndexLayout::kUnused)
      out.vertices[layout.vertex[v]] = limit(static_cast<std::int32_t>(v));
  if (!options.provenance) return;
  for (std::int32_t f = faces.size() - 1; f >= 0; --f) {
    if (pairing.depth[f] < 0) continue;
    for (int k = 0; k < faces.sides(f); ++k)
      out.provenance[layout.vertex[faces.vertex(faces.first_side(f) + k)]] = faces.corner(f, k);
  }
}

template struct SchemeFrames<float, LoopScheme>;
template struct SchemeFrames<double, LoopScheme>;
template struct SchemeFrames<float, QuadScheme>;
template struct SchemeFrames<double, QuadScheme>;

namespace {

const data::ControlMesh& checked(const data::ControlMesh& mesh) {
  if (mesh.faces.empty()) throw data::ArgumentError("tessellator: a mesh without faces");
  for (const auto& p : mesh.positions)
    for (const double x : p)
      if (!std::isfinite(x)) throw data::ArgumentError("tessellator: a coordinate is not finite");
  return mesh;
}

// Sizes a draw list for patches first .. last - 1.
template <class Real>
void make_room(FrameEngine<Real>& s, std::size_t first, std::size_t last, DrawList<Real>& out) {
  s.offsets.assign(1, {});
  for (std::size_t i = first; i < last; ++i) {
    const DrawSize size = s.patch_size(i);
    const DrawSize& at = s.offsets.back();
    s.offsets.push_back({at.vertices + size.vertices, at.draws + size.draws, 0});
  }
  out.vertices.resize(static_cast<std::size_t>(s.offsets.back().vertices));
  out.draws.resize(static_cast<std::size_t>(s.offsets.back().draws));
  out.provenance.resize(s.options.provenance ? out.vertices.size() : 0);
}

// Hands over the draws of s.part; returns how many vertices they have, in a frame that has had `before`.
template <class Real>
std::int64_t deliver(const FrameEngine<Real>& s, std::int64_t before, DrawSink<Real>& sink) {
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
FrameStats run_frame(FrameEngine<Real>& s, std::span<const std::int32_t> depth, Evaluate&& evaluate,
                     std::span<const Grid> keep = {}) {
  const auto start = Clock::now();
  FrameStats stats = s.plan_or_keep(depth, keep);
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

std::uint64_t FrameState::next_version() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

FrameStats FrameState::plan_or_keep(std::span<const std::int32_t> depth, std::span<const Grid> keep) {
  const auto start = Clock::now();
  if (planned_ && std::ranges::equal(planned_->depth, depth) && std::ranges::equal(planned_->keep, keep)) {
    FrameStats stats = planned_->stats;
    stats.seconds_pairing = 0;
    stats.seconds_planning = seconds_since(start);
    return stats;
  }
  planned_.reset();  // until all is well
  const FrameStats stats = plan_frame(depth, keep);
  planned_ = {{depth.begin(), depth.end()}, {keep.begin(), keep.end()}, stats};
  return stats;
}

FrameState::FrameState(const data::ControlMesh& given, const TessellatorOptions& with)
    : mesh(checked(given)), options(with) {
  if (options.threads < 0) throw data::ArgumentError("tessellator: a negative number of threads");
  // More threads than oneTBB has would only earn a warning on standard error.
  const auto most =
      static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  arena.initialize(options.threads > 0 ? std::min(options.threads, most) : tbb::task_arena::automatic);
}

template <class Real>
Engine<Real>::Engine(std::unique_ptr<FrameEngine<Real>> state) : state_(std::move(state)) {}

template <class Real>
int Engine<Real>::face_count() const {
  return state_->face_count();
}
template <class Real>
const Adjacency& Engine<Real>::adjacency() const {
  if (const auto* state = dynamic_cast<const SchemeFrames<Real, LoopScheme>*>(state_.get()))
    return state->adjacency;
  throw data::ArgumentError("tessellator: a mesh of quads has no adjacency of triangles");
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
void Engine<Real>::move_points(std::span<const std::array<double, 3>> positions) {
  auto& points = state_->mesh.positions;
  if (positions.size() != points.size())
    throw data::ArgumentError("tessellator: " + std::to_string(positions.size()) + " points for " +
                              std::to_string(points.size()) + " vertices");
  std::vector<std::array<double, 3>> before(positions.begin(), positions.end());
  points.swap(before);
  try {
    checked(state_->mesh);
    state_->points_moved();
  } catch (...) {
    points.swap(before);
    state_->points_moved();
    throw;
  }
  state_->renew_version();
}

template <class Real>
std::vector<std::int32_t> Engine<Real>::depths(const DepthOptions& strategy, const Camera& camera,
                                               double& seconds) {
  const auto start = Clock::now();
  std::vector<std::int32_t> depth;
  state_->arena.execute([&] { depth = state_->depths(strategy, camera); });
  for (const std::int32_t f : state_->mesh.holes) depth[f] = -1;
  seconds = seconds_since(start);
  return depth;
}

template <class Real>
FrameStats Engine<Real>::frame(std::span<const std::int32_t> depth, DrawList<Real>& out) {
  return run_frame(*state_, depth, [&] {
    make_room(*state_, 0, state_->patch_count(), out);
    state_->draw(0, state_->patch_count(), out);
    return static_cast<std::int64_t>(out.vertices.size());
  });
}

template <class Real>
FrameStats Engine<Real>::frame(std::span<const std::int32_t> depth, IndexedMesh<Real>& out) {
  return run_frame(*state_, depth, [&] {
    state_->write_index(out);
    return static_cast<std::int64_t>(out.vertices.size());
  });
}

template <class Real>
FrameStats Engine<Real>::frame(std::span<const std::int32_t> depth, DrawSink<Real>& sink) {
  constexpr std::int64_t kBatch = std::int64_t{1} << 18;  // vertices kept at a time
  return run_frame(*state_, depth, [&] {
    FrameEngine<Real>& s = *state_;
    std::int64_t vertices = 0;
    for (std::size_t first = 0, last = 0; first < s.patch_count(); first = last) {
      for (std::int64_t size = 0; last < s.patch_count() && size < kBatch; ++last)
        size += s.patch_size(last).vertices;
      make_room(s, first, last, s.part);
      s.draw(first, last, s.part);
      vertices += deliver(s, vertices, sink);
    }
    return vertices;
  });
}

template <class Real>
FrameStats Engine<Real>::frame(std::span<const std::int32_t> depth, PatchMesh<Real>& out) {
  PatchFrame<Real> patches(*state_, out);
  const std::vector<Grid> keep = patches.pairs_to_keep(depth);
  return run_frame(
      *state_, depth, [&] { return patches.write(depth); }, keep);
}

template class Engine<float>;
template class Engine<double>;

}  // namespace limitcheck::fast
