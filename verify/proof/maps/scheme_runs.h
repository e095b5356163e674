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
#include "fast/stream/gather/batch.h"
#include "fast/stream/gather/rings_impl.h"
#include "fast/stream/kernel/kernel.h"
#include "fast/window/quad_rows.h"
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
  return lattice_point(i[k], j[k], size);
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
          visit(lattice_point(i, size - row - below, size), strip[2 * i + below]);
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

 private:
  CutQuads<N> cut_;
  fast::PreparedQuads<N, Surface> prepared_;
};

/// Row streaming, see StreamRuns.
template <class T, template <int> class Lane>
class QuadStreamRuns {
 public:
  /// Throws data::ArgumentError: something is semi-sharp.
  QuadStreamRuns(const data::ControlMesh& mesh, const std::vector<fast::Vec3<T>>& positions)
      : cut_(mesh, positions), rings_{Rings(cut_.quads, placed(), 0), Rings(cut_.quads, placed(), 1)} {}
  QuadStreamRuns(const QuadStreamRuns&) = delete;
  QuadStreamRuns& operator=(const QuadStreamRuns&) = delete;

  bool has_patch() const { return rings_[0].kind(0) == fast::row_stream::QuadClass::kRegular; }

  /// Face 0 row by row, streamed. At depths at which only some meshes have origins near their sides, without
  /// and with these, one after the other.
  template <class Visit>
  void whole(int depth, Visit&& visit) const {
    for (const bool local : fast::row_stream::origins_at(depth))
      run_whole(depth, visit, [&](auto lane, const Rings& rings, T* input, T* work, const auto& target) {
        const auto batch = fast::row_stream::gather_quads<T>(rings, kFace, depth, 1, input);
        fast::row_stream::generic::QuadStream<decltype(lane)>(fast::row_stream::with_origins(batch, local, 1),
                                                              rings.placement(), work, {target})
            .run();
      });
  }
  /// The same as a polynomial: a regular quad alone.
  template <class Visit>
  void patch(int depth, Visit&& visit) const {
    run_whole(depth, visit, [&](auto lane, const Rings& rings, T* input, T* work, const auto& target) {
      const auto batch = fast::row_stream::gather_patches<T>(rings, kFace, depth, 1, input);
      fast::row_stream::generic::QuadPatch<decltype(lane)>(batch, rings.placement(), work, {target}).run();
    });
  }
  /// The sides by themselves, each from its corner on; with and without origins, too.
  template <class Visit>
  void sides(int depth, Visit&& visit) const {
    const int size = 1 << depth;
    for (const bool local : fast::row_stream::origins_at(depth)) {
      for (std::int32_t side = 0; side < 4; ++side) {
        const auto run = [&](auto lane, const Rings& rings, T* input, T* work, const auto& target) {
          const auto batch = fast::row_stream::gather_sides<T>(rings, {&side, 1}, depth, 1, input);
          fast::row_stream::generic::QuadStream<decltype(lane)>(
              fast::row_stream::with_origins(batch, local, 1), rings.placement(), work, {target})
              .run_side();
        };
        const TwoRuns<T> points = evaluate(depth, 1, run);
        for (int t = 0; t <= size; ++t) visit(on_side(side, t, size), points[t]);
      }
    }
  }

 private:
  using Rings = fast::row_stream::BasicQuadRings<T>;
  static constexpr std::array<std::int32_t, 1> kFace{0};

  fast::row_stream::PlacedPoints<T> placed() const {
    fast::row_stream::PlacedPoints<T> result{{}, fast::Placement<T>{}};
    for (const auto& p : cut_.positions) result.points.push_back({p.x, p.y, p.z, T(0)});
    return result;
  }

  template <class Run>
  TwoRuns<T> evaluate(int depth, int rows, Run&& run) const {
    const int side = (1 << depth) + 1;
    return {static_cast<std::size_t>(rows * side), [&](auto tangent, T* lane) {
              std::vector<T> input(static_cast<std::size_t>(fast::row_stream::quad_input_size(depth))),
                  work(static_cast<std::size_t>(fast::row_stream::quad_work_size(depth)));
              run(Lane<tangent>{}, rings_[tangent], input.data(), work.data(),
                  fast::row_stream::QuadTarget<T>{&lane, 6 * side, nullptr, nullptr});
            }};
  }
  template <class Visit, class Run>
  void run_whole(int depth, Visit&& visit, Run&& run) const {
    const int size = 1 << depth;
    const TwoRuns<T> points = evaluate(depth, size + 1, run);
    for (int j = 0; j <= size; ++j)
      for (int i = 0; i <= size; ++i) visit(lattice_point(i, j, size), points[j * (size + 1) + i]);
  }

  CutQuads<T> cut_;
  std::array<Rings, 2> rings_;
};

/// What is particular to the proofs of a scheme: how its kernels are run; which it has; by how much a float or double
/// engine must scale limit points, which are too large by kTimes * 2^(kTwos depth), and what it scales a unit to.
struct TriangleRuns {
  template <class T, class Surface>
  using Window = WindowRuns<T, Surface>;
  template <class T, template <int> class Lane>
  using Stream = StreamRuns<T, Lane>;
  static constexpr bool kQuads = false;
  static bool has_stream(const data::ControlMesh&) { return true; }
  static constexpr int kTimes = 12, kTwos = 3;
  template <class T>
  static T scaled(T unit, int depth) {
    return fast::row_stream::limit_unit(unit, depth);
  }
};
struct QuadRuns {
  template <class T, class Surface>
  using Window = QuadWindowRuns<T, Surface>;
  template <class T, template <int> class Lane>
  using Stream = QuadStreamRuns<T, Lane>;
  static constexpr bool kQuads = true;
  static bool has_stream(const data::ControlMesh& mesh) { return !fast::QuadMesh(mesh).semi_sharp(); }
  static constexpr int kTimes = 36, kTwos = 2;
  template <class T>
  static T scaled(T unit, int depth) {
    return fast::row_stream::quad_unit(unit, depth);
  }
};

/// what(TriangleRuns()) or what(QuadRuns()).
template <class What>
auto by_scheme(const data::ControlMesh& mesh, What&& what) {
  return mesh.faces.are_triangles() ? what(TriangleRuns()) : what(QuadRuns());
}

/// visit(LatticePoint, Vertex) for every point that a kernel of the sliding window makes; quads have no centres.
template <class Window, class Visit>
void run_window(const Window& window, ProvedKernel kernel, int depth, Visit&& visit) {
  if (kernel == ProvedKernel::kSlidingWindow) window.whole(depth, visit);
  if (kernel == ProvedKernel::kCrackEdge) window.sides(depth, visit);
  if constexpr (requires { window.centres(visit); })
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
    if (kernel == ProvedKernel::kCrackCentre) return !Scheme::kQuads;
    if (is_stream(kernel) && !Scheme::has_stream(mesh_)) return false;
    return kernel != ProvedKernel::kRowStreamPatch || made(stream_).has_patch();
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
template <class T, template <int> class Lane, class Visit>
void run_linear(const data::ControlMesh& mesh, const std::vector<fast::Vec3<T>>& points, ProvedKernel kernel,
                int depth, Visit&& visit) {
  by_scheme(mesh, [&]<class Scheme>(Scheme) {
    SchemeRuns<Scheme, T, Lane>(mesh, points).run(kernel, depth, visit);
  });
}

}  // namespace limitcheck::verify
