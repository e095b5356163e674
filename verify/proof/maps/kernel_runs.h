// SPDX-License-Identifier: MIT
// The shipped kernels of triangles on any number type: every limit point that they make for a pair, with its place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "fast/frame/crack_centre.h"
#include "fast/frame/patch.h"
#include "fast/mesh/adjacency.h"
#include "fast/rules/limit.h"
#include "fast/rules/surface_vertex.h"
#include "fast/stream/host/number_stream.h"
#include "fast/window/crack_edge.h"
#include "fast/window/sliding_window.h"
#include "fast/window/triangle_lattice.h"

namespace limitcheck::verify {

/// Position and two tangents, whose plane is the tangent plane: all that is linear in a limit point.
template <class N>
struct LinearSurface {
  using Vertex = fast::LimitFrame<N>;
  static constexpr bool kLinear = true;
  static Vertex vertex(const Vertex& frame, auto&& /*substitute*/, std::int64_t& /*zero_normals*/) {
    return frame;
  }
};

using fast::LatticePoint;

/// Point (i, j) of a face's lattice of so many steps.
inline LatticePoint lattice_point(int i, int j, int size, std::int32_t face = 0) {
  return {face, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
          static_cast<std::uint32_t>(size)};
}

/// Of a pair, or one without neighbours.
inline std::int32_t proved_faces(const fast::Adjacency& adjacency) {
  return adjacency.face_count() == 1 ? 1 : 2;
}

/// A mesh prepared for the sliding window and the crack fans. What a vertex is decides Surface: a limit
/// frame, a position and a normal, or whatever the number type has.
template <class N, class Surface>
class WindowRuns {
 public:
  using Vertex = typename Surface::Vertex;

  /// One position per vertex of the mesh.
  WindowRuns(const data::ControlMesh& mesh, std::vector<fast::Vec3<N>> positions)
      : adjacency_(mesh), prepared_(adjacency_, std::move(positions)) {}
  WindowRuns(const WindowRuns&) = delete;
  WindowRuns& operator=(const WindowRuns&) = delete;

  /// The sliding window on the pair of half-edge 0, or the lattice of face 0 if that has no neighbour. Calls
  /// visit(LatticePoint, const Vertex&) for every vertex of every strip: the points of inner rows twice, as
  /// the window delivers them.
  template <class Visit>
  void whole(int depth, Visit&& visit) const {
    if (adjacency_.twin(0) < 0) return alone(depth, visit);
    fast::SlidingWindow<N, Surface> window(depth, adjacency_.max_valence());
    const fast::Half upper{0, 0, fast::Display::kStrips};
    const std::int32_t twin = adjacency_.twin(0);
    const fast::Half lower{twin / 3, twin % 3, fast::Display::kStrips};
    const int k = 1 << depth;
    window.run(prepared_, 0, depth, [&](int row, const Vertex* strip) {
      for (int i = 0; i <= k; ++i) {
        for (const int j : {row, row + 1}) {
          const Vertex& vertex = strip[2 * i + j - row];
          visit(i + j <= k ? upper.lattice(k, j, i) : lower.lattice(k, k - j, k - i), vertex);
        }
      }
    });
  }

  /// The borders of fans: the points of each side by itself, from its origin to its end.
  template <class Visit>
  void sides(int depth, Visit&& visit) const {
    const int k = 1 << depth;
    fast::EdgeStrip<N, Surface> strip(depth, adjacency_.max_valence());
    std::vector<Vertex> out(static_cast<std::size_t>(k) + 1);
    for (std::int32_t h = 0; h < 3 * proved_faces(adjacency_); ++h) {
      strip.evaluate(prepared_, h, depth, out.data());
      const fast::Half half{h / 3, h % 3, fast::Display::kFan};
      for (int t = 0; t <= k; ++t) visit(half.lattice(k, k - t, t), out[t]);
    }
  }

  /// The centres of fans, the limit points at (1/3, 1/3, 1/3).
  template <class Visit>
  void centres(Visit&& visit) const {
    fast::FanCentreEvaluator<N, Surface> evaluator(adjacency_.max_valence());
    for (std::int32_t face = 0; face < proved_faces(adjacency_); ++face)
      visit(LatticePoint{face, 1, 1, 3}, evaluator.evaluate(prepared_, face, fast::FanCentre::kLimit));
  }

 private:
  template <class Visit>
  void alone(int depth, Visit&& visit) const {
    fast::TriangleLattice<N, Surface> lattice(depth);
    const fast::Half half{0, 0, fast::Display::kStrips};
    const int k = 1 << depth;
    lattice.run(prepared_, 0, depth, [&](int row, const Vertex* strip) {
      for (int q = 0; q <= 2 * (k - row); ++q) visit(half.lattice(k, row + q % 2, q / 2), strip[q]);
    });
  }

  fast::Adjacency adjacency_;
  fast::PreparedMesh<N, Surface> prepared_;
};

/// What row streaming delivers when it runs twice, for one tangent each: six numbers a point.
template <class T>
class TwoRuns {
 public:
  /// run(number of the tangent, output) delivers so many points.
  template <class Run>
  TwoRuns(std::size_t points, Run&& run) : first_(6 * points), second_(6 * points) {
    run(std::integral_constant<int, 0>(), first_.data());
    run(std::integral_constant<int, 1>(), second_.data());
  }
  fast::LimitFrame<T> operator[](std::ptrdiff_t point) const {
    const T *a = first_.data() + 6 * point, *b = second_.data() + 6 * point;
    return {{a[0], a[1], a[2]}, {a[3], a[4], a[5]}, {b[3], b[4], b[5]}};
  }

 private:
  std::vector<T> first_, second_;
};

/// How the edges of the first faces are evaluated: in both ways, if these differ somewhere.
template <class N>
std::vector<fast::row_stream::Edges> ways_of(const fast::row_stream::BasicLoopRings<N>& rings,
                                             std::int32_t faces, int depth) {
  using fast::row_stream::Edges;
  for (std::int32_t h = 0; h < 3 * faces && depth >= fast::row_stream::kLocalFrom; ++h)
    if (rings.is_regular(h)) return {Edges::kAllStreamed, Edges::kRegularByPolynomials};
  return {Edges::kAllStreamed};
}

/// The prepass, the gathering and the kernel of row streaming over T. Lane<0> and Lane<1> are LinearNumber<T, 0> and
/// <T, 1> or follow them.
template <class T, template <int> class Lane>
class StreamRuns {
 public:
  /// One position per vertex of the mesh.
  StreamRuns(const data::ControlMesh& mesh, const std::vector<fast::Vec3<T>>& positions)
      : adjacency_(mesh),
        streams_(Streamed<0>(adjacency_, arrays(positions)), Streamed<1>(adjacency_, arrays(positions))) {}
  StreamRuns(const StreamRuns&) = delete;
  StreamRuns& operator=(const StreamRuns&) = delete;

  /// The pair of half-edge 0, or face 0 if that has no neighbour, streamed. Calls visit(LatticePoint, const
  /// LimitFrame<T>&), row by row; once more with its regular edges as polynomials, if it has some.
  template <class Visit>
  void whole(int depth, Visit&& visit) const {
    for (const fast::row_stream::Edges edges : ways(depth))
      visit_pair(
          depth,
          [&](const auto& stream, const fast::Grid& pair, T* out) {
            stream.whole({&pair, 1}, depth, out, edges);
          },
          visit);
  }
  /// The same pair as two polynomials: one with regular corners.
  bool has_patch() const {
    const std::int32_t faces = proved_faces(adjacency_);
    for (std::int32_t h = 0; h < 3 * faces; ++h)
      if (adjacency_.valence(adjacency_.origin(h)) != 6 || adjacency_.on_boundary(adjacency_.origin(h)))
        return false;
    return faces == 2;
  }
  template <class Visit>
  void patch(int depth, Visit&& visit) const {
    visit_pair(
        depth, [&](const auto& stream, const fast::Grid& pair, T* out) { stream.patch(pair, depth, out); },
        visit);
  }

  /// The strip of each side, from its origin to its end; once more with regular ones as polynomials.
  template <class Visit>
  void sides(int depth, Visit&& visit) const {
    const int size = 1 << depth;
    for (const fast::row_stream::Edges edges : ways(depth)) {
      for (std::int32_t h = 0; h < 3 * proved_faces(adjacency_); ++h) {
        const TwoRuns<T> points(size + 1, [&](auto tangent, T* out) {
          std::get<tangent>(streams_).edges({&h, 1}, depth, out, edges);
        });
        const fast::Half half{h / 3, h % 3, fast::Display::kFan};
        for (int t = 0; t <= size; ++t) visit(half.lattice(size, size - t, t), points[t]);
      }
    }
  }

 private:
  fast::Grid pair(int depth = 0) const {
    const std::int32_t twin = adjacency_.twin(0);
    return twin < 0 ? fast::Grid{.face0 = 0, .depth = depth} : fast::Grid{0, twin / 3, 0, twin % 3, depth};
  }
  std::vector<fast::row_stream::Edges> ways(int depth) const {
    return ways_of(std::get<0>(streams_).rings(), proved_faces(adjacency_), depth);
  }
  template <class Run, class Visit>
  void visit_pair(int depth, const Run& run, Visit&& visit) const {
    const fast::Grid both = pair(depth);
    const int size = 1 << depth, side = size + 1;
    const TwoRuns<T> points(side * side,
                            [&](auto tangent, T* out) { run(std::get<tangent>(streams_), both, out); });
    for (int row = 0; row <= size; ++row)
      for (int column = 0; column <= (both.singleton() ? row : size); ++column)
        visit(fast::face_point(both, size, column, row, row >= column), points[row * side + column]);
  }
  static std::vector<std::array<T, 3>> arrays(const std::vector<fast::Vec3<T>>& positions) {
    std::vector<std::array<T, 3>> result;
    for (const auto& p : positions) result.push_back({p.x, p.y, p.z});
    return result;
  }
  template <int tangent>
  using Streamed = fast::row_stream::NumberStream<Lane<tangent>>;

  fast::Adjacency adjacency_;
  std::tuple<Streamed<0>, Streamed<1>> streams_;
};

}  // namespace limitcheck::verify
