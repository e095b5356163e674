// SPDX-License-Identifier: MIT
// Every kernel of either scheme on any number type behind one function: those of triangles from kernel_runs.h, and those
// of quads, every limit point that they make for face 0 with its place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/rules/prepared_quads.h"
#include "fast/stream/gather/quad_batch.h"
#include "fast/stream/gather/quad_rings_impl.h"
#include "fast/stream/kernel/kernel.h"
#include "fast/window/quad_edge.h"
#include "fast/window/quad_window.h"
#include "verify/proof/maps/kernel_runs.h"
#include "verify/proof/topologies/proof_row.h"

namespace limitcheck::verify {

/// A mesh of quads as the kernels read it, cut along its sharp edges, with numbers of the caller's.
template <class N>
struct CutQuads {
  CutQuads(const data::ControlMesh& mesh, const std::vector<fast::Vec3<N>>& given) : quads(mesh) {
    if (quads.steps != 0) throw std::logic_error("a mesh of quads is needed");
    for (std::size_t v = 0; v < quads.positions.size(); ++v)
      positions.push_back(given[quads.uncut.empty() ? v : static_cast<std::size_t>(quads.uncut[v])]);
  }

  fast::QuadMesh quads;
  std::vector<fast::Vec3<N>> positions;
};

/// Point t / size of a side of face 0, from corner `side` on.
inline fast::LatticePoint on_side(int side, int t, int size) {
  const std::array<int, 4> i{t, size, size - t, 0}, j{0, t, size, size - t};
  const auto k = static_cast<std::size_t>(side);
  return {0, static_cast<std::uint32_t>(i[k]), static_cast<std::uint32_t>(j[k]),
          static_cast<std::uint32_t>(size)};
}

/// The sliding window and the borders of fans.
template <class N, class Surface>
class QuadWindowRuns {
 public:
  using Vertex = typename Surface::Vertex;

  /// One position per vertex of the mesh.
  QuadWindowRuns(const data::ControlMesh& mesh, const std::vector<fast::Vec3<N>>& positions)
      : cut_(mesh, positions), prepared_(cut_.quads, cut_.positions) {}
  QuadWindowRuns(const QuadWindowRuns&) = delete;
  QuadWindowRuns& operator=(const QuadWindowRuns&) = delete;

  /// The window on face 0. Calls visit(LatticePoint, const Vertex&) for every vertex of every strip: the
  /// points of inner rows twice, as the window delivers them.
  template <class Visit>
  void whole(int depth, Visit&& visit) const {
    fast::QuadWindow<N, Surface> window(depth, cut_.quads.adjacency.max_valence());
    const int size = 1 << depth;
    window.run(prepared_, 0, depth, [&](int row, const Vertex* strip) {
      for (int i = 0; i <= size; ++i)
        for (const int below : {0, 1})
          visit(fast::LatticePoint{0, static_cast<std::uint32_t>(i),
                                   static_cast<std::uint32_t>(size - row - below),
                                   static_cast<std::uint32_t>(size)},
                strip[2 * i + below]);
    });
  }

  /// The sides by themselves, each from its corner on.
  template <class Visit>
  void sides(int depth, Visit&& visit) const {
    const int size = 1 << depth;
    fast::QuadEdge<N, Surface> edge(depth, cut_.quads.adjacency.max_valence());
    std::vector<Vertex> out(static_cast<std::size_t>(size) + 1);
    for (int side = 0; side < 4; ++side) {
      edge.evaluate(prepared_, side, depth, out.data());
      for (int t = 0; t <= size; ++t) visit(on_side(side, t, size), out[static_cast<std::size_t>(t)]);
    }
  }

  /// They are points of the lattice.
  template <class Visit>
  void centres(Visit&&) const {}

 private:
  CutQuads<N> cut_;
  fast::PreparedQuads<N, Surface> prepared_;
};

/// Row streaming. Runs twice, for one tangent each, see StreamRuns.
template <class T, template <int> class Lane>
class QuadStreamRuns {
 public:
  using Frame = fast::LimitFrame<T>;

  /// Throws data::ArgumentError: something is semi-sharp.
  QuadStreamRuns(const data::ControlMesh& mesh, const std::vector<fast::Vec3<T>>& positions)
      : cut_(mesh, positions), first_(cut_.quads, placed(), 0), second_(cut_.quads, placed(), 1) {}
  QuadStreamRuns(const QuadStreamRuns&) = delete;
  QuadStreamRuns& operator=(const QuadStreamRuns&) = delete;

  bool has_patch() const { return first_.kind(0) == fast::row_stream::QuadClass::kRegular; }

  /// Face 0 row by row, streamed. At depths at which only some meshes have origins near their sides, without
  /// and with these, one after the other.
  template <class Visit>
  void whole(int depth, Visit&& visit) const {
    for (const auto& placement : placements(depth)) {
      run_whole(depth, visit, [&](auto& input, auto& work, auto lane, const auto& rings, const auto& target) {
        const auto batch = fast::row_stream::gather_quads<T>(rings, kFace, depth, 1, input.data());
        fast::row_stream::generic::QuadStream<decltype(lane)>(batch, placement, work.data(), {target}).run();
      });
    }
  }
  /// The same as a polynomial: a regular quad alone.
  template <class Visit>
  void patch(int depth, Visit&& visit) const {
    run_whole(depth, visit, [&](auto& input, auto& work, auto lane, const auto& rings, const auto& target) {
      const auto batch = fast::row_stream::gather_patches<T>(rings, kFace, depth, 1, input.data());
      fast::row_stream::generic::QuadPatch<decltype(lane)>(batch, rings.placement(), work.data(), {target})
          .run();
    });
  }
  /// The sides by themselves, each from its corner on; with and without origins, too.
  template <class Visit>
  void sides(int depth, Visit&& visit) const {
    const int size = 1 << depth;
    for (const auto& placement : placements(depth)) {
      for (std::int32_t side = 0; side < 4; ++side) {
        const auto run = [&](auto& input, auto& work, auto lane, const auto& rings, const auto& target) {
          const auto batch = fast::row_stream::gather_sides<T>(rings, {&side, 1}, depth, 1, input.data());
          fast::row_stream::generic::QuadStream<decltype(lane)>(batch, placement, work.data(), {target})
              .run_side();
        };
        const auto first = evaluate<Lane<0>>(first_, depth, 1, run),
                   second = evaluate<Lane<1>>(second_, depth, 1, run);
        for (int t = 0; t <= size; ++t) visit(on_side(side, t, size), frame(first, second, t));
      }
    }
  }

 private:
  using Rings = fast::row_stream::BasicQuadRings<T>;
  using Placement = fast::row_stream::KernelPlacement<T>;
  static constexpr std::array<std::int32_t, 1> kFace{0};

  std::vector<Placement> placements(int depth) const {
    std::vector<Placement> result{first_.placement()};
    if (depth > 0 && !result[0].has_local_origin(depth)) {
      result.push_back(result[0]);
      result[1].local_from = 1;
    }
    return result;
  }

  fast::row_stream::PlacedPoints<T> placed() const {
    fast::row_stream::PlacedPoints<T> result{{}, fast::row_stream::KernelPlacement<T>{}};
    for (const auto& p : cut_.positions) result.points.push_back({p.x, p.y, p.z, T(0)});
    return result;
  }

  template <class Number, class Run>
  static std::vector<T> evaluate(const Rings& rings, int depth, int rows, Run&& run) {
    const std::ptrdiff_t stride = 6 * ((std::ptrdiff_t{1} << depth) + 1);
    std::vector<T> out(static_cast<std::size_t>(rows * stride)),
        input(static_cast<std::size_t>(fast::row_stream::quad_input_size(depth))),
        work(static_cast<std::size_t>(fast::row_stream::quad_work_size(depth)));
    T* lane = out.data();
    run(input, work, Number{}, rings, fast::row_stream::QuadTarget<T>{&lane, stride, nullptr, nullptr});
    return out;
  }
  static Frame frame(const std::vector<T>& first, const std::vector<T>& second, int point) {
    const T *a = first.data() + 6 * point, *b = second.data() + 6 * point;
    return {{a[0], a[1], a[2]}, {a[3], a[4], a[5]}, {b[3], b[4], b[5]}};
  }
  template <class Visit, class Run>
  void run_whole(int depth, Visit&& visit, Run&& run) const {
    const int size = 1 << depth;
    const auto first = evaluate<Lane<0>>(first_, depth, size + 1, run),
               second = evaluate<Lane<1>>(second_, depth, size + 1, run);
    for (int j = 0; j <= size; ++j)
      for (int i = 0; i <= size; ++i)
        visit(fast::LatticePoint{0, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
                                 static_cast<std::uint32_t>(size)},
              frame(first, second, j * (size + 1) + i));
  }

  CutQuads<T> cut_;
  Rings first_, second_;
};

/// What is particular to the proofs of a scheme: how its kernels are run; which it has; by how much a float or double
/// engine must scale limit points, which are too large by kTimes * 2^(kTwos depth), and what it scales a unit to.
struct TriangleRuns {
  template <class T, class Surface>
  using Window = WindowRuns<T, Surface>;
  template <class T, template <int> class Lane>
  using Stream = StreamRuns<T, Lane>;
  static constexpr bool kHasCentres = true;
  static bool has_stream(const data::ControlMesh&) { return true; }
  static constexpr int kTimes = 12, kTwos = 3;
  template <class T>
  static T scaled(T unit, int depth) {
    return fast::row_stream::scaled(fast::row_stream::KernelPlacement<T>{{{}, unit}}, depth).unit;
  }
};
struct QuadRuns {
  template <class T, class Surface>
  using Window = QuadWindowRuns<T, Surface>;
  template <class T, template <int> class Lane>
  using Stream = QuadStreamRuns<T, Lane>;
  static constexpr bool kHasCentres = false;
  static bool has_stream(const data::ControlMesh& mesh) { return !fast::QuadMesh(mesh).semi_sharp(); }
  static constexpr int kTimes = 36, kTwos = 2;
  template <class T>
  static T scaled(T unit, int depth) {
    return fast::row_stream::quad_unit(unit, depth);
  }
};

/// visit(LatticePoint, Vertex) for every point that a kernel of the sliding window makes.
template <class Window, class Visit>
void run_window(const Window& window, ProvedKernel kernel, int depth, Visit&& visit) {
  if (kernel == ProvedKernel::kSlidingWindow) window.whole(depth, visit);
  if (kernel == ProvedKernel::kCrackEdge) window.sides(depth, visit);
  if (kernel == ProvedKernel::kCrackCentre) window.centres(visit);
}

/// The kernels of a scheme on one pair of triangles or one quad, down to the linear part of a limit point: position
/// and two tangents. Each is prepared when it is first asked for.
///   T      the number
///   Lane   Lane<0>, Lane<1>: the row streaming kernel's number over T, see LinearNumber
template <class Scheme, class T, template <int> class Lane>
class SchemeRuns {
 public:
  using Points = std::vector<fast::Vec3<T>>;
  SchemeRuns(const data::ControlMesh& mesh, Points points) : mesh_(mesh), points_(std::move(points)) {}

  bool has(ProvedKernel kernel) {
    if (!is_stream(kernel)) return kernel != ProvedKernel::kCrackCentre || Scheme::kHasCentres;
    return Scheme::has_stream(mesh_) &&
           (kernel != ProvedKernel::kRowStreamPatch || made(stream_).has_patch());
  }
  /// visit(LatticePoint, const LimitFrame<T>&) for every point, always in the same order.
  template <class Visit>
  void run(ProvedKernel kernel, int depth, Visit&& visit) {
    if (!is_stream(kernel)) return run_window(made(window_), kernel, depth, visit);
    const auto& stream = made(stream_);
    if (kernel == ProvedKernel::kRowStream) stream.whole(depth, visit);
    if (kernel == ProvedKernel::kRowStreamEdge) stream.sides(depth, visit);
    if (kernel == ProvedKernel::kRowStreamPatch) stream.patch(depth, visit);
  }

 private:
  template <class Runs>
  const Runs& made(std::optional<Runs>& runs) {
    if (!runs) runs.emplace(mesh_, points_);
    return *runs;
  }

  const data::ControlMesh& mesh_;
  Points points_;
  std::optional<typename Scheme::template Window<T, LinearSurface<T>>> window_;
  std::optional<typename Scheme::template Stream<T, Lane>> stream_;
};

/// The same of whichever scheme the mesh is made for.
template <class T, template <int> class Lane>
class LinearRuns {
 public:
  LinearRuns(const data::ControlMesh& mesh, const std::vector<fast::Vec3<T>>& points) {
    if (mesh.faces.are_triangles())
      triangles_.emplace(mesh, points);
    else
      quads_.emplace(mesh, points);
  }
  template <class Visit>
  void run(ProvedKernel kernel, int depth, Visit&& visit) {
    triangles_ ? triangles_->run(kernel, depth, visit) : quads_->run(kernel, depth, visit);
  }

 private:
  std::optional<SchemeRuns<TriangleRuns, T, Lane>> triangles_;
  std::optional<SchemeRuns<QuadRuns, T, Lane>> quads_;
};

}  // namespace limitcheck::verify
