// SPDX-License-Identifier: MIT
// Every kernel of either scheme behind one function.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "verify/proof/maps/kernel_runs.h"
#include "verify/proof/maps/quad_runs.h"
#include "verify/proof/topologies/proof_row.h"

namespace limitcheck::verify {

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
