// SPDX-License-Identifier: MIT
#include "fast/window/tessellator.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "data/error.h"
#include "fast/frame/engine_state.h"
#include "fast/frame/quad_state.h"
#include "fast/mesh/vec3.h"
#include "fast/window/frame_worker.h"
#include "fast/window/quad_frame_worker.h"

namespace limitcheck::fast {

namespace {

// Where a coordinate is taken relative to: near the middle of the box, with few digits, so that subtracting
// it rarely costs any. Near the origin only if every control point stays exact in Real; else 0.
template <class Real>
double exact_centre(std::span<const std::array<double, 3>> points, const Box& box, std::size_t axis) {
  const double size = box.size();
  const double unit = size > 0 ? std::exp2(std::floor(std::log2(size)) - 3) : 1;
  const double coarse = std::round(box.middle(axis) / unit) * unit;
  if (static_cast<double>(static_cast<Real>(coarse)) != coarse) return 0;
  if (std::abs(coarse) > 2 * size) return coarse;
  for (const auto& p : points) {
    const double x = static_cast<double>(static_cast<Real>(p[axis]));
    if (static_cast<double>(static_cast<Real>(x - coarse)) != x - coarse || x - coarse + coarse != x)
      return 0;
  }
  return coarse;
}

// Sets the placement of a mesh and returns its control points there, of size at most 1. Control points that
// are representable in Real are taken exactly if the mesh lies near the origin. (Row streaming has a rule of
// its own, see `place` in stream/rings.h.)
template <class Real>
std::vector<Vec3<Real>> place(std::span<const std::array<double, 3>> points, Placement<Real>& placement) {
  const Box box(points);
  std::array<double, 3> centre{};
  double largest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    centre[c] = exact_centre<Real>(points, box, c);
    largest = std::max({largest, std::abs(box.low[c] - centre[c]), std::abs(box.high[c] - centre[c])});
  }
  int exponent = 0;
  if (largest > 0) std::frexp(largest, &exponent);
  placement = {{static_cast<Real>(centre[0]), static_cast<Real>(centre[1]), static_cast<Real>(centre[2])},
               static_cast<Real>(std::ldexp(1.0, exponent))};
  if (!std::isfinite(placement.unit) || !(placement.unit > 0))
    throw data::ArgumentError("tessellator: the mesh is too large or too small for its number type");
  const auto scaled = [&](const std::array<double, 3>& p, std::size_t c) {
    return static_cast<Real>(std::ldexp(p[c] - centre[c], -exponent));
  };
  std::vector<Vec3<Real>> positions;
  positions.reserve(points.size());
  for (const auto& p : points) positions.push_back({scaled(p, 0), scaled(p, 1), scaled(p, 2)});
  return positions;
}

}  // namespace

template <class Real>
struct Tessellator<Real>::State final : EngineState<Real> {
  using EngineState<Real>::adjacency, EngineState<Real>::arena, EngineState<Real>::max_depth,
      EngineState<Real>::options, EngineState<Real>::patches, EngineState<Real>::placement,
      EngineState<Real>::plan, EngineState<Real>::triangles;

  State(const data::ControlMesh& given, const TessellatorOptions& with, const PrintedRules& by)
      : EngineState<Real>(given, with, by) {
    prepare_points();
    for (std::int32_t f = 0; f < adjacency.face_count(); ++f)
      if (adjacency.neighbour(f, 0) < 0 && adjacency.neighbour(f, 1) < 0 && adjacency.neighbour(f, 2) < 0)
        isolated_faces = true;
  }

  void points_moved() override {
    EngineState<Real>::points_moved();
    prepare_points();
  }
  void prepare_points() {
    prepared.emplace(adjacency, place<Real>(triangles.points().positions, placement), triangles.kinds());
  }

  /// Makes workers that are deep enough for the frame.
  void prepare() override {
    if (workers.empty() || max_depth > worker_depth) {
      workers.clear();
      worker_depth = max_depth;
      for (int i = 0; i < arena.max_concurrency(); ++i)
        workers.push_back(
            std::make_unique<Worker<Real>>(worker_depth, adjacency.max_valence(), isolated_faces));
    }
    zero_normals_before = 0;
    for (const auto& worker : workers) zero_normals_before += worker->zero_normals();
  }

  void draw(std::size_t first, std::size_t last, DrawList<Real>& out) override {
    run(first, last, [&](std::size_t i, Worker<Real>& worker) {
      return this->draw_writer(first, i, out, worker.scratch);
    });
  }
  void index(const IndexLayout& layout, IndexedMesh<Real>& out) override {
    run(0, patches.size(), [&](std::size_t i, Worker<Real>&) { return this->index_writer(i, layout, out); });
  }
  void write_patches(std::span<const PatchPlace> places, const PatchTarget<Real>& out) override {
    fresh.clear();
    for (std::size_t i = 0; i < places.size(); ++i)
      if (places[i].fresh) fresh.push_back(i);
    run_each(
        0, fresh.size(), [&](std::size_t k) { return fresh[k]; },
        [&](std::size_t i, Worker<Real>&) {
          return PatchWriter<Real>(patches[i], plan, placement, out.from(places[i].first));
        });
  }

  SurfaceVertex<Real> limit(std::int32_t v) const override { return placed(prepared->limit(v), placement); }

  std::int64_t zero_normals() const override {
    std::int64_t count = prepared->zero_normals() - zero_normals_before;
    for (const auto& worker : workers) count += worker->zero_normals();
    return count;
  }

  /// Evaluates patches first .. last - 1 in parallel, each into make_writer(i, worker); or those that
  /// number(first) .. number(last - 1) name.
  template <class MakeWriter>
  void run(std::size_t first, std::size_t last, MakeWriter&& make_writer) {
    run_each(
        first, last, [](std::size_t i) { return i; }, make_writer);
  }
  template <class Number, class MakeWriter>
  void run_each(std::size_t first, std::size_t last, Number&& number, MakeWriter&& make_writer) {
    const auto chunk = [&](std::size_t from, std::size_t to) {
      Worker<Real>& worker = *workers[tbb::this_task_arena::current_thread_index()];
      for (std::size_t k = from; k < to; ++k) {
        const std::size_t i = number(k);
        auto writer = make_writer(i, worker);
        evaluate(*prepared, patches[i], plan, options.cracks.centre, worker, writer);
      }
    };
    arena.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(first, last, 16),
                        [&](const tbb::blocked_range<std::size_t>& r) { chunk(r.begin(), r.end()); });
    });
  }

  std::optional<PreparedMesh<Real>> prepared;
  bool isolated_faces = false;
  std::vector<std::unique_ptr<Worker<Real>>> workers;
  int worker_depth = 0;
  std::int64_t zero_normals_before = 0;  // of the workers, in the frames before
  std::vector<std::size_t> fresh;        // patches that are to be evaluated
};

// The same with a grid for each quad.
template <class Real>
struct Tessellator<Real>::QuadState final : QuadEngineState<Real> {
  using QuadEngineState<Real>::arena, QuadEngineState<Real>::faces, QuadEngineState<Real>::max_depth,
      QuadEngineState<Real>::options, QuadEngineState<Real>::patches, QuadEngineState<Real>::placement,
      QuadEngineState<Real>::plan, QuadEngineState<Real>::quads;

  QuadState(const data::ControlMesh& given, const TessellatorOptions& with)
      : QuadEngineState<Real>(given, with),
        prepared(std::in_place, quads, place<Real>(quads.positions, placement)) {}

  void points_moved() override {
    QuadEngineState<Real>::points_moved();
    prepared.emplace(quads, place<Real>(quads.positions, placement));
  }

  void prepare() override {
    if (workers.empty() || max_depth > worker_depth) {
      workers.clear();
      worker_depth = max_depth;
      for (int i = 0; i < arena.max_concurrency(); ++i)
        workers.push_back(std::make_unique<QuadWorker<Real>>(worker_depth, quads.adjacency.max_valence()));
    }
    zero_normals_before = 0;
    for (const auto& worker : workers) zero_normals_before += worker->zero_normals();
  }

  void draw(std::size_t first, std::size_t last, DrawList<Real>& out) override {
    run(first, last, [&](std::size_t i) { return this->draw_writer(first, i, out); });
  }
  void index(const QuadIndexLayout& layout, IndexedMesh<Real>& out) override {
    run(0, patches.size(), [&](std::size_t i) { return this->index_writer(i, layout, out); });
  }
  void write_patches(std::span<const PatchPlace> places, const PatchTarget<Real>& out) override {
    fresh.clear();
    for (std::size_t i = 0; i < places.size(); ++i)
      if (places[i].fresh) fresh.push_back(i);
    run_each(
        0, fresh.size(), [&](std::size_t k) { return fresh[k]; },
        [&](std::size_t i) {
          return QuadPatchWriter<Real>(patches[i], faces, plan, placement, out.from(places[i].first));
        });
  }
  SurfaceVertex<Real> limit(std::int32_t v) const override { return placed(prepared->limit(v), placement); }
  std::int64_t zero_normals() const override {
    std::int64_t count = prepared->zero_normals() - zero_normals_before;
    for (const auto& worker : workers) count += worker->zero_normals();
    return count;
  }

  /// Evaluates patches first .. last - 1 in parallel, each into make_writer(i).
  template <class MakeWriter>
  void run(std::size_t first, std::size_t last, MakeWriter&& make_writer) {
    run_each(
        first, last, [](std::size_t i) { return i; }, make_writer);
  }
  template <class Number, class MakeWriter>
  void run_each(std::size_t first, std::size_t last, Number&& number, MakeWriter&& make_writer) {
    arena.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(first, last, 16), [&](const tbb::blocked_range<std::size_t>& r) {
            QuadWorker<Real>& worker = *workers[tbb::this_task_arena::current_thread_index()];
            for (std::size_t k = r.begin(); k < r.end(); ++k) {
              const std::size_t i = number(k);
              auto writer = make_writer(i);
              evaluate(*prepared, patches[i], faces, plan, options.cracks.centre, worker, writer);
            }
          });
    });
  }

  std::optional<PreparedQuads<Real>> prepared;
  std::vector<std::unique_ptr<QuadWorker<Real>>> workers;
  int worker_depth = 0;
  std::int64_t zero_normals_before = 0;  // of the workers, in the frames before
  std::vector<std::size_t> fresh;        // patches that are to be evaluated
};

template <class Real>
std::unique_ptr<FrameEngine<Real>> Tessellator<Real>::make_state(const data::ControlMesh& mesh,
                                                                 const TessellatorOptions& options,
                                                                 const PrintedRules& rules) {
  if (options.scheme == data::Scheme::kCatmullClark) return std::make_unique<QuadState>(mesh, options);
  return std::make_unique<State>(mesh, options, rules);
}

template <class Real>
Tessellator<Real>::Tessellator(const data::ControlMesh& mesh, const TessellatorOptions& options)
    : Tessellator(mesh, options, PrintedRules{}) {}
template <class Real>
Tessellator<Real>::Tessellator(const data::ControlMesh& mesh, const TessellatorOptions& options,
                               const PrintedRules& rules)
    : Engine<Real>(make_state(mesh, options, rules)) {}

template class Tessellator<float>;
template class Tessellator<double>;

}  // namespace limitcheck::fast
