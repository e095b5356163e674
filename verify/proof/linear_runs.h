// SPDX-License-Identifier: MIT
// Every float kernel on any number type, down to the linear part of a limit point: position and two tangents.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "fast/row_stream/lattice.h"
#include "fast/row_stream/number_stream.h"
#include "verify/proof/bounds.h"
#include "verify/proof/kernel_runs.h"

namespace limitcheck::verify {

template <class T>
struct FrameSurface {
  using Vertex = fast::LimitFrame<T>;
  static constexpr bool kLinear = true;
  static Vertex vertex(const Vertex& frame, auto&& /*substitute*/, std::int64_t& /*zero_normals*/) {
    return frame;
  }
};

/// The kernels on one pair.
///   T      the number
///   Lane   Lane<0>, Lane<1>: the row streaming kernel's number over T, see LinearNumber
/// visit(LatticePoint, const LimitFrame<T>&) for every point, always in the same order.
template <class T, template <int> class Lane>
class LinearRuns {
 public:
  using Points = std::vector<fast::Vec3<T>>;

  LinearRuns(const data::ControlMesh& mesh, const Points& points)
      : mesh_(mesh), points_(points), adjacency_(mesh) {}

  template <class Visit>
  void run(BoundedKernel kernel, int depth, Visit&& visit) {
    switch (kernel) {
      case BoundedKernel::kSlidingWindow:
        return window().pair(depth, visit);
      case BoundedKernel::kCrackEdge:
        for (std::int32_t h = 0; h < 6; ++h) window().edge(h, depth, visit);
        return;
      case BoundedKernel::kCrackCentre:
        for (std::int32_t face = 0; face < 2; ++face) window().centre(face, visit);
        return;
      case BoundedKernel::kRowStream:
        return stream(depth, visit);
      case BoundedKernel::kRowStreamEdge:
        return stream_edges(depth, visit);
    }
  }

 private:
  using Window = WindowRuns<T, FrameSurface<T>>;
  const Window& window() {
    if (!window_) window_.emplace(mesh_, points_);
    return *window_;
  }

  template <int tangent>
  fast::row_stream::NumberStream<Lane<tangent>> make_stream() const {
    std::vector<std::array<T, 3>> points;
    for (const auto& p : points_) points.push_back({p.x, p.y, p.z});
    return {adjacency_, points};
  }

  template <class Visit>
  void stream(int depth, Visit&& visit) const {
    const std::int32_t twin = adjacency_.twin(0);
    const fast::Pair pair{0, twin / 3, 0, twin % 3, depth};
    const int size = 1 << depth, side = size + 1;
    std::vector<T> first(static_cast<std::size_t>(6 * side * side)), second(first.size());
    make_stream<0>().whole({&pair, 1}, depth, first.data());
    make_stream<1>().whole({&pair, 1}, depth, second.data());
    for (int row = 0; row <= size; ++row) {
      for (int column = 0; column <= size; ++column) {
        const auto at = fast::row_stream::face_point(pair, size, column, row, row >= column);
        deliver({at.face, static_cast<std::uint32_t>(at.i), static_cast<std::uint32_t>(at.j),
                 static_cast<std::uint32_t>(size)},
                first, second, row * side + column, visit);
      }
    }
  }

  template <class Visit>
  void stream_edges(int depth, Visit&& visit) const {
    const std::array<std::int32_t, 6> half_edges{0, 1, 2, 3, 4, 5};
    const int size = 1 << depth, side = size + 1;
    std::vector<T> first(static_cast<std::size_t>(6 * 6 * side)), second(first.size());
    make_stream<0>().edges(half_edges, depth, first.data());
    make_stream<1>().edges(half_edges, depth, second.data());
    for (const std::int32_t h : half_edges) {
      const fast::Half half{h / 3, h % 3, fast::Half::Show::kFan};
      for (int t = 0; t <= size; ++t)
        deliver(half.lattice(size, size - t, t), first, second, h * side + t, visit);
    }
  }

  template <class Visit>
  static void deliver(const fast::LatticePoint& at, const std::vector<T>& first, const std::vector<T>& second,
                      int index, Visit&& visit) {
    const T* a = &first[6 * static_cast<std::size_t>(index)];
    const T* b = &second[6 * static_cast<std::size_t>(index)];
    visit(at, fast::LimitFrame<T>{{a[0], a[1], a[2]}, {a[3], a[4], a[5]}, {b[3], b[4], b[5]}});
  }

  const data::ControlMesh& mesh_;
  Points points_;
  fast::Adjacency adjacency_;
  std::optional<Window> window_;
};

}  // namespace limitcheck::verify
