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
#include <vector>

#include "data/error.h"
#include "fast/frame/crack_centre.h"
#include "fast/frame/scheme_frames.h"
#include "fast/mesh/vec3.h"
#include "fast/window/crack_edge.h"
#include "fast/window/quad_edge.h"
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
  LoopWorker(const LoopScheme& scheme, int max_depth)
      : window(max_depth, scheme.adjacency.max_valence()),
        edge(max_depth, scheme.adjacency.max_valence()),
        centre(scheme.adjacency.max_valence()) {
    scratch.reserve(max_depth);
    for (auto& b : border) b.resize((std::size_t{1} << max_depth) + 1);
  }

  SlidingWindow<Real> window;
  EdgeStrip<Real> edge;
  FanCentreEvaluator<Real> centre;
  std::optional<TriangleLattice<Real>> lattice;  // once a face without neighbours has come
  typename LoopDrawWriter<Real>::Scratch scratch;
  std::array<std::vector<SurfaceVertex<Real>>, 3> border;

  std::int64_t zero_normals() const {
    return window.zero_normals() + edge.zero_normals() + centre.zero_normals() +
           (lattice ? lattice->zero_normals() : 0);
  }
};

/// Evaluates one patch and hands every piece to the writer.
template <class Real, class Writer>
void evaluate(const PreparedMesh<Real>& mesh, const LoopPatch& patch, const LoopFaces& faces,
              const CrackPlan& plan, FanCentre centre, LoopWorker<Real>& worker, Writer& writer) {
  using Vertex = SurfaceVertex<Real>;
  const int k = 1 << patch.depth;
  if (patch.half[1].face < 0) {
    if (patch.half[0].uses_window()) {
      if (!worker.lattice) worker.lattice.emplace(worker.window.max_depth());
      worker.lattice->run(mesh, patch.half[0].face, patch.depth, [&](int row, const Vertex* strip) {
        writer.half_strip(0, row, [&](int q) -> const Vertex& { return strip[q]; });
      });
    }
  } else if (patch.half[0].uses_window() || patch.half[1].uses_window()) {
    const bool full = patch.full();
    const std::int32_t h0 = 3 * patch.half[0].face + patch.half[0].edge;
    worker.window.run(mesh, h0, patch.depth, [&](int row, const Vertex* strip) {
      if (full) return writer.whole_strip(row, [&](int q) -> const Vertex& { return strip[q]; });
      if (patch.half[0].uses_window())
        writer.half_strip(0, row, [&](int q) -> const Vertex& { return strip[q]; });
      if (patch.half[1].uses_window())
        writer.half_strip(1, k - 1 - row, [&](int q) -> const Vertex& { return strip[2 * k + 1 - q]; });
    });
  }
  for (int side = 0; side < 2; ++side) {
    const Half& half = patch.half[side];
    if (!half.repaired()) continue;
    const FaceInRepair<LoopFaces> face{faces, plan, half.face};
    Border<Real> border;
    for (int e = 0; e < 3; ++e) {
      auto& points = worker.border[e];
      worker.edge.evaluate(mesh, 3 * half.face + e, face.depth(e), points.data());
      border[e] = points.data();
    }
    if (half.display == Display::kFan)
      writer.fan(side, worker.centre.evaluate(mesh, half.face, centre), border);
    else
      writer.ring(side, border);
  }
}

/// What a thread reuses from face to face of Catmull-Clark's scheme.
template <class Real>
struct QuadWorker {
  QuadWorker(const QuadScheme& scheme, int max_depth)
      : window(std::max(max_depth, 1), scheme.quads.adjacency.max_valence()),
        edge(max_depth, scheme.quads.adjacency.max_valence()) {}

  QuadWindow<Real> window;
  QuadEdge<Real> edge;
  QuadBorder<Real> border;
  FacePoints<Real> points;
  typename QuadDrawWriter<Real>::Scratch scratch;

  std::int64_t zero_normals() const { return window.zero_normals() + edge.zero_normals(); }
};

/// Evaluates one face and hands every piece to the writer.
template <class Real, class Writer>
void evaluate(const PreparedQuads<Real>& mesh, const QuadPatch& patch, const QuadFaces& faces,
              const CrackPlan& plan, FanCentre centre, QuadWorker<Real>& worker, Writer& writer) {
  using Vertex = SurfaceVertex<Real>;
  const std::int32_t f = patch.face, first = faces.first_side(f);
  const int m = faces.part_size(patch.depth), part_depth = patch.depth - (faces.cut() ? 1 : 0);
  const auto limit = [&](std::int32_t v) -> const Vertex& { return mesh.limit(v); };
  if (corners_only(patch, faces)) {
    writer.corners([&](int k) -> const Vertex& { return mesh.limit(faces.vertex(first + k)); });
    return;
  }
  if (patch.display == Display::kStrips) {
    for (int part = 0; part < faces.parts(f); ++part)
      worker.window.run(mesh, faces.quad(f, part), part_depth, [&](int row, const Vertex* strip) {
        writer.strip(part, row, [&](int q) -> const Vertex& { return strip[q]; });
      });
    return;
  }
  const auto edge = [&](std::int32_t h, int depth, Vertex* out) {
    worker.edge.evaluate(mesh, h, depth, out);
  };
  worker.border.resize(static_cast<std::size_t>(faces.sides(f)));
  for (int side = 0; side < faces.sides(f); ++side)
    evaluate_side<Real>(faces, first + side, plan.edge_depth[first + side], limit, edge, worker.border[side]);
  if (patch.display == Display::kFan) {
    const auto middle_of_quad = [&] {
      Vertex middle;
      worker.window.run(mesh, f, 1, [&](int row, const Vertex* strip) {
        if (row == 0) middle = strip[3];
      });
      return middle;
    };
    writer.fan(face_centre<Real>(
                   faces, f, centre, [&](std::int32_t v) { return mesh.position(v); }, limit, middle_of_quad),
               worker.border);
    return;
  }
  worker.points.resize(faces.parts(f), m);
  for (int part = 0; part < faces.parts(f); ++part) {
    worker.window.run(mesh, faces.quad(f, part), part_depth, [&](int row, const Vertex* strip) {
      for (int i = 0; i <= m; ++i) {
        worker.points.at({part, i, m - row}) = strip[2 * i];
        worker.points.at({part, i, m - row - 1}) = strip[2 * i + 1];
      }
    });
  }
  writer.stitch(worker.points, worker.border);
}

/// The mesh as the windows of a scheme read it, and what evaluates its patches.
template <class Real, class Scheme>
struct WindowOf;
template <class Real>
struct WindowOf<Real, LoopScheme> {
  using Mesh = PreparedMesh<Real>;
  using Worker = LoopWorker<Real>;
  static void prepare(const LoopScheme& scheme, Placement<Real>& placement, std::optional<Mesh>& out) {
    out.emplace(scheme.adjacency, place<Real>(scheme.triangles.points().positions, placement),
                scheme.triangles.kinds());
  }
};
template <class Real>
struct WindowOf<Real, QuadScheme> {
  using Mesh = PreparedQuads<Real>;
  using Worker = QuadWorker<Real>;
  static void prepare(const QuadScheme& scheme, Placement<Real>& placement, std::optional<Mesh>& out) {
    out.emplace(scheme.quads, place<Real>(scheme.quads.positions, placement));
  }
};

template <class Real, class Scheme>
struct WindowFrames final : SchemeFrames<Real, Scheme> {
  using Base = SchemeFrames<Real, Scheme>;
  using Window = WindowOf<Real, Scheme>;
  using Worker = typename Window::Worker;
  using Base::arena, Base::faces, Base::max_depth, Base::options, Base::patches, Base::placement, Base::plan;

  WindowFrames(const data::ControlMesh& given, const TessellatorOptions& with, const PrintedRules& by)
      : Base(given, with, by) {
    Window::prepare(*this, placement, prepared);
  }

  void points_moved() override {
    Base::points_moved();
    Window::prepare(*this, placement, prepared);
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
    run(
        last - first, [&](std::size_t k) { return first + k; },
        [&](std::size_t i, Worker& worker) { return this->draw_writer(first, i, out, worker.scratch); });
  }
  void index(const IndexLayout& layout, IndexedMesh<Real>& out) override {
    run(
        patches.size(), [](std::size_t i) { return i; },
        [&](std::size_t i, Worker&) { return this->index_writer(i, layout, out); });
  }
  void write_patches(std::span<const BlockOffset> places, const PatchTarget<Real>& out) override {
    fresh.clear();
    for (std::size_t i = 0; i < places.size(); ++i)
      if (places[i].fresh) fresh.push_back(i);
    run(
        fresh.size(), [&](std::size_t k) { return fresh[k]; },
        [&](std::size_t i, Worker&) { return this->patch_writer(patches[i], places[i].first, out); });
  }

  SurfaceVertex<Real> limit(std::int32_t v) const override { return placed(prepared->limit(v), placement); }

  std::int64_t zero_normals() const override {
    std::int64_t count = prepared->zero_normals() - zero_normals_before;
    for (const auto& worker : workers) count += worker->zero_normals();
    return count;
  }

  /// Evaluates patches number(0) .. number(count - 1) in parallel, each into make_writer(i, worker).
  template <class Number, class MakeWriter>
  void run(std::size_t count, Number&& number, MakeWriter&& make_writer) {
    const auto chunk = [&](const tbb::blocked_range<std::size_t>& range) {
      Worker& worker = *workers[tbb::this_task_arena::current_thread_index()];
      for (std::size_t k = range.begin(); k < range.end(); ++k) {
        const std::size_t i = number(k);
        auto writer = make_writer(i, worker);
        evaluate(*prepared, patches[i], faces, plan, options.cracks.centre, worker, writer);
      }
    };
    arena.execute([&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16), chunk); });
  }

  std::optional<typename Window::Mesh> prepared;
  std::vector<std::unique_ptr<Worker>> workers;
  int worker_depth = 0;
  std::int64_t zero_normals_before = 0;  // of the workers, in the frames before
  std::vector<std::size_t> fresh;        // patches that are to be evaluated
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
