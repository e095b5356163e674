// SPDX-License-Identifier: MIT
#include "fast/window/tessellator.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "data/error.h"
#include "fast/frame/crack_centre.h"
#include "fast/frame/scheme_frames.h"
#include "fast/mesh/vec3.h"
#include "fast/window/crack_edge.h"
#include "fast/window/quad_rows.h"
#include "fast/window/quad_window.h"
#include "fast/window/sliding_window.h"
#include "fast/window/triangle_lattice.h"

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

/// What a thread reuses from patch to patch of triangles.
template <class Real>
struct LoopWorker {
  using Mesh = PreparedMesh<Real>;

  LoopWorker(const LoopScheme& scheme, int max_depth)
      : window(max_depth, scheme.adjacency.max_valence()),
        edge(max_depth, scheme.adjacency.max_valence()),
        centre(scheme.adjacency.max_valence()) {
    for (auto& b : border) b.resize((std::size_t{1} << max_depth) + 1);
  }
  /// The mesh as the windows read it.
  static void prepare(const LoopScheme& scheme, Placement<Real>& placement, std::optional<Mesh>& out) {
    out.emplace(scheme.adjacency, place<Real>(scheme.cut_mesh.points().positions, placement),
                scheme.cut_mesh.kinds());
  }

  SlidingWindow<Real> window;
  EdgeStrip<Real> edge;
  FanCentreEvaluator<Real> centre;
  std::optional<TriangleLattice<Real>> lattice;  // once a face without neighbours has come
  std::array<std::vector<SurfaceVertex<Real>>, 3> border;
  std::vector<SurfaceVertex<Real>> grid;  // of a patch with stitched faces

  std::int64_t zero_normals() const {
    return window.zero_normals() + edge.zero_normals() + centre.zero_normals() +
           (lattice ? lattice->zero_normals() : 0);
  }
};

/// Keeps the strip below a row of a part.
template <class Patch, class Vertex>
void keep_strip(const Patch& patch, int part, int row, int count, const Vertex* strip,
                std::vector<Vertex>& grid) {
  for (int q = 0; q < count; ++q) grid[patch.in_grid({part, row + q % 2, q / 2})] = strip[q];
}

/// Evaluates one patch and hands every piece to the writer.
template <class Real, class Writer>
void evaluate(const PreparedMesh<Real>& mesh, const LoopPatch& patch, const LoopFaces& /*faces*/,
              const CrackPlan& plan, FanCentre centre, LoopWorker<Real>& worker, Writer& writer) {
  using Vertex = SurfaceVertex<Real>;
  const int k = patch.k();
  const Half &first = patch.half[0], &second = patch.half[1];
  const bool full = patch.full(), alone = second.face < 0;
  const bool stitched = first.display == Display::kStitch || second.display == Display::kStitch;
  if (stitched) worker.grid.resize(static_cast<std::size_t>((k + 1) * (k + 1)));
  const auto take = [&](int row, const Vertex* strip) {
    const auto at = [&](int q) -> const Vertex& { return strip[q]; };
    if (stitched)
      return keep_strip(patch, 0, row, patch.block(alone ? 0 : LoopPatch::kWhole).strip_points(row), strip,
                        worker.grid);
    if (full) return writer.strip(LoopPatch::kWhole, row, at);
    if (first.display == Display::kStrips) writer.strip(0, row, at);
    if (second.display == Display::kStrips)
      writer.strip(1, k - 1 - row, [&](int q) -> const Vertex& { return strip[2 * k + 1 - q]; });
  };
  if (alone && first.uses_window()) {
    if (!worker.lattice) worker.lattice.emplace(worker.window.max_depth());
    worker.lattice->run(mesh, first.face, patch.depth, take);
  } else if (first.uses_window() || second.uses_window()) {
    worker.window.run(mesh, 3 * first.face + first.edge, patch.depth, take);
  }
  // Row by row as well.
  for (int i = 0; i < 2 * k && stitched; ++i) {
    const int s = i % 2, row = s == 0 ? i / 2 : k - 1 - i / 2;
    if (patch.half[s].display == Display::kStrips)
      writer.strip(s, row, [&](int q) -> const Vertex& {
        return worker.grid[patch.in_grid({s, row + q % 2, q / 2})];
      });
    if (patch.half[s].display == Display::kStitch && row >= 1 && row <= k - 3)
      writer.inner_strip(s, row - 1, worker.grid.data());
  }
  for (int side = 0; side < 2; ++side) {
    const Half& half = patch.half[side];
    if (!half.repaired()) continue;
    Border<Real> border;
    for (int e = 0; e < 3; ++e) {
      auto& points = worker.border[e];
      worker.edge.evaluate(mesh, 3 * half.face + e, plan.edge_depth[3 * half.face + e], points.data());
      border[e] = points.data();
    }
    if (half.display == Display::kFan)
      writer.fan(side, worker.centre.evaluate(mesh, half.face, centre), border);
    else
      writer.ring(side, worker.grid.data(), border);
  }
}

/// What a thread reuses from face to face of Catmull-Clark's scheme.
template <class Real>
struct QuadWorker {
  using Mesh = PreparedQuads<Real>;

  QuadWorker(const QuadScheme& scheme, int max_depth)
      : window(std::max(max_depth, 1), scheme.cut_mesh.adjacency.max_valence()),
        edge(max_depth, scheme.cut_mesh.adjacency.max_valence()) {}
  static void prepare(const QuadScheme& scheme, Placement<Real>& placement, std::optional<Mesh>& out) {
    out.emplace(scheme.cut_mesh, place<Real>(scheme.cut_mesh.positions, placement));
  }

  QuadWindow<Real> window;
  QuadEdge<Real> edge;
  QuadBorder<Real> border;
  std::vector<SurfaceVertex<Real>> grid;  // of a stitched face

  std::int64_t zero_normals() const { return window.zero_normals() + edge.zero_normals(); }
};

/// The points of a face, see show_repaired().
template <class Real>
struct QuadPoints {
  using Vertex = SurfaceVertex<Real>;

  const PreparedQuads<Real>& mesh;
  const QuadFaces& faces;
  QuadWorker<Real>& worker;

  const Vec3<Real>& position(std::int32_t v) const { return mesh.position(v); }
  const Vertex& limit(std::int32_t v) const { return mesh.limit(v); }
  void edge(std::int32_t h, int depth, Vertex* out) const { worker.edge.evaluate(mesh, h, depth, out); }
  Vertex middle(std::int32_t quad) const {
    Vertex middle;
    worker.window.run(mesh, quad, 1, [&](int row, const Vertex* strip) {
      if (row == 0) middle = strip[3];
    });
    return middle;
  }
  /// take(part, row, strip) for each strip.
  template <class Take>
  void for_each_strip(const QuadPatch& patch, Take&& take) const {
    for (int part = 0; part < patch.face.parts; ++part)
      worker.window.run(mesh, faces.quad(patch.face.face, part), patch.depth - (faces.cut() ? 1 : 0),
                        [&](int row, const Vertex* strip) { take(part, row, strip); });
  }
  const Vertex* grid(const QuadPatch& patch) const {
    worker.grid.resize(static_cast<std::size_t>(patch.face.parts * patch.face.block().size()));
    for_each_strip(patch, [&](int part, int row, const Vertex* strip) {
      keep_strip(patch, part, row, patch.face.block().strip_points(row), strip, worker.grid);
    });
    return worker.grid.data();
  }
};

/// Evaluates one face and hands every piece to the writer.
template <class Real, class Writer>
void evaluate(const PreparedQuads<Real>& mesh, const QuadPatch& patch, const QuadFaces& faces,
              const CrackPlan& plan, FanCentre centre, QuadWorker<Real>& worker, Writer& writer) {
  using Vertex = SurfaceVertex<Real>;
  const QuadPoints<Real> points{mesh, faces, worker};
  if (patch.face.display != Display::kStrips || patch.corners_only())
    return show_repaired<Real>(patch, faces, plan, centre, points, worker.border, writer);
  points.for_each_strip(patch, [&](int part, int row, const Vertex* strip) {
    writer.strip(part, row, [&](int q) -> const Vertex& { return strip[q]; });
  });
}

template <class Real, class Scheme>
using WorkerOf = std::conditional_t<std::is_same_v<Scheme, LoopScheme>, LoopWorker<Real>, QuadWorker<Real>>;

template <class Real, class Scheme>
struct WindowFrames final : SchemeFrames<Real, Scheme> {
  using Base = SchemeFrames<Real, Scheme>;
  using Worker = WorkerOf<Real, Scheme>;
  using Base::arena, Base::faces, Base::max_depth, Base::options, Base::patches, Base::placement, Base::plan;

  WindowFrames(const data::ControlMesh& given, const TessellatorOptions& with, const PrintedRules& by)
      : Base(given, with, by) {
    Worker::prepare(*this, placement, prepared);
  }

  void points_moved() override {
    Base::points_moved();
    Worker::prepare(*this, placement, prepared);
  }

  /// Makes workers that are deep enough for the frame.
  void prepare() override {
    if (workers.empty() || max_depth > worker_depth) {
      workers.clear();
      worker_depth = max_depth;
      for (int i = 0; i < arena.max_concurrency(); ++i)
        workers.push_back(std::make_unique<Worker>(*this, worker_depth));
    }
    zero_normals_before = 0;
    for (const auto& worker : workers) zero_normals_before += worker->zero_normals();
  }

  void draw(std::size_t first, std::size_t last, DrawList<Real>& out) override {
    run(first, last, {}, [&](std::size_t i) { return this->draw_writer(first, i, out); });
  }
  void index(const IndexLayout& layout, IndexedMesh<Real>& out) override {
    run(0, patches.size(), {}, [&](std::size_t i) { return this->index_writer(i, layout, out); });
  }
  void write_patches(std::span<const BlockOffset> places, const PatchTarget<Real>& out) override {
    run(0, patches.size(), places,
        [&](std::size_t i) { return this->patch_writer(patches[i], places[i].first, out); });
  }

  SurfaceVertex<Real> limit(std::int32_t v) const override { return placed(prepared->limit(v), placement); }

  std::int64_t zero_normals() const override {
    std::int64_t count = prepared->zero_normals() - zero_normals_before;
    for (const auto& worker : workers) count += worker->zero_normals();
    return count;
  }

  /// Evaluates patches first .. last - 1, but those whose places are not fresh, in parallel, each into make_writer(i).
  template <class MakeWriter>
  void run(std::size_t first, std::size_t last, std::span<const BlockOffset> places,
           MakeWriter&& make_writer) {
    const auto chunk = [&](const tbb::blocked_range<std::size_t>& range) {
      Worker& worker = *workers[tbb::this_task_arena::current_thread_index()];
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        if (!places.empty() && !places[i].fresh) continue;
        auto writer = make_writer(i);
        evaluate(*prepared, patches[i], faces, plan, options.cracks.centre, worker, writer);
      }
    };
    arena.execute([&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(first, last, 16), chunk); });
  }

  std::optional<typename Worker::Mesh> prepared;
  std::vector<std::unique_ptr<Worker>> workers;
  int worker_depth = 0;
  std::int64_t zero_normals_before = 0;  // of the workers, in the frames before
};

}  // namespace

template <class Real>
std::unique_ptr<FrameEngine<Real>> Tessellator<Real>::make_state(const data::ControlMesh& mesh,
                                                                 const TessellatorOptions& options,
                                                                 const PrintedRules& rules) {
  if (options.scheme == data::Scheme::kCatmullClark)
    return std::make_unique<WindowFrames<Real, QuadScheme>>(mesh, options, rules);
  return std::make_unique<WindowFrames<Real, LoopScheme>>(mesh, options, rules);
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
