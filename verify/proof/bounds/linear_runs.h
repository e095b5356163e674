// SPDX-License-Identifier: MIT
// Every float kernel on any number type, down to the linear part of a limit point: position and two tangents.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "verify/proof/bounds/bounds.h"
#include "verify/proof/maps/kernel_runs.h"
#include "verify/proof/maps/quad_runs.h"
#include "verify/proof/maps/stream_runs.h"

namespace limitcheck::verify {

/// The kernels on one pair of triangles or one quad.
///   T      the number
///   Lane   Lane<0>, Lane<1>: the row streaming kernel's number over T, see LinearNumber
/// visit(LatticePoint, const LimitFrame<T>&) for every point, always in the same order.
template <class T, template <int> class Lane>
class LinearRuns {
 public:
  using Points = std::vector<fast::Vec3<T>>;

  LinearRuns(const data::ControlMesh& mesh, const Points& points)
      : mesh_(mesh),
        points_(points),
        quads_(!mesh.faces.are_triangles()),
        faces_(mesh.faces.size() == 1 ? 1 : 2) {}

  template <class Visit>
  void run(BoundedKernel kernel, int depth, Visit&& visit) {
    if (quads_) return run_quad(kernel, depth, visit);
    switch (kernel) {
      case BoundedKernel::kSlidingWindow:
        return window().pair(depth, visit);
      case BoundedKernel::kCrackEdge:
        for (std::int32_t h = 0; h < 3 * faces_; ++h) window().edge(h, depth, visit);
        return;
      case BoundedKernel::kCrackCentre:
        for (std::int32_t face = 0; face < faces_; ++face) window().centre(face, visit);
        return;
      case BoundedKernel::kRowStream:
        return stream().pair(depth, visit);
      case BoundedKernel::kRowStreamEdge:
        for (std::int32_t h = 0; h < 3 * faces_; ++h) stream().edge(h, depth, visit);
        return;
      case BoundedKernel::kRowStreamPatch:
        return;
    }
  }

 private:
  using Window = WindowRuns<T, LinearSurface<T>>;
  using Stream = StreamRuns<T, Lane>;
  using QuadWindow = QuadWindowRuns<T, LinearSurface<T>>;
  using QuadStream = QuadStreamRuns<T, Lane>;

  template <class Visit>
  void run_quad(BoundedKernel kernel, int depth, Visit&& visit) {
    switch (kernel) {
      case BoundedKernel::kSlidingWindow:
        return made(quad_window_).quad(depth, visit);
      case BoundedKernel::kCrackEdge:
        return made(quad_window_).sides(depth, visit);
      case BoundedKernel::kCrackCentre:
        return;
      case BoundedKernel::kRowStream:
        return made(quad_stream_).quad(depth, visit);
      case BoundedKernel::kRowStreamEdge:
        return made(quad_stream_).sides(depth, visit);
      case BoundedKernel::kRowStreamPatch:
        return made(quad_stream_).patch(depth, visit);
    }
  }

  template <class Runs>
  const Runs& made(std::optional<Runs>& runs) {
    if (!runs) runs.emplace(mesh_, points_);
    return *runs;
  }
  const Window& window() { return made(window_); }
  const Stream& stream() { return made(stream_); }

  const data::ControlMesh& mesh_;
  Points points_;
  bool quads_;
  std::int32_t faces_;  // of the pair, or the one that is alone
  std::optional<Window> window_;
  std::optional<Stream> stream_;
  std::optional<QuadWindow> quad_window_;
  std::optional<QuadStream> quad_stream_;
};

}  // namespace limitcheck::verify
