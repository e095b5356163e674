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
#include <vector>

#include "data/error.h"
#include "fast/frame/engine_state.h"
#include "fast/window/frame_worker.h"

namespace limitcheck::fast {

template <class Real>
struct Tessellator<Real>::State final : EngineState<Real> {
  using EngineState<Real>::adjacency, EngineState<Real>::arena, EngineState<Real>::max_depth,
      EngineState<Real>::mesh, EngineState<Real>::options, EngineState<Real>::patches,
      EngineState<Real>::placement, EngineState<Real>::plan;

  State(const data::ControlMesh& given, const TessellatorOptions& with, const PrintedRules& by)
      : EngineState<Real>(given, with, by) {
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
      throw data::ArgumentError("tessellator: the mesh is too large or too small for its number type");
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

  SurfaceVertex<Real> limit(std::int32_t v) const override { return placement(prepared->limit(v)); }

  std::int64_t zero_normals() const override {
    std::int64_t count = prepared->zero_normals() - zero_normals_before;
    for (const auto& worker : workers) count += worker->zero_normals();
    return count;
  }

  /// Evaluates patches first .. last - 1 in parallel, each into make_writer(i, worker).
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

  std::optional<PreparedMesh<Real>> prepared;
  bool isolated_faces = false;
  std::vector<std::unique_ptr<Worker<Real>>> workers;
  int worker_depth = 0;
  std::int64_t zero_normals_before = 0;  // of the workers, in the frames before
};

template <class Real>
Tessellator<Real>::Tessellator(const data::ControlMesh& mesh, const TessellatorOptions& options)
    : Tessellator(mesh, options, PrintedRules{}) {}
template <class Real>
Tessellator<Real>::Tessellator(const data::ControlMesh& mesh, const TessellatorOptions& options,
                               const PrintedRules& rules)
    : Engine<Real>(std::make_unique<State>(mesh, options, rules)) {}

template class Tessellator<float>;
template class Tessellator<double>;

}  // namespace limitcheck::fast
