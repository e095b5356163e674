// SPDX-License-Identifier: MIT
// A face without neighbours: it has no partner, not even a dummy, and is subdivided by itself. [claims C81,
// E]
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "fast/rules/prepared_mesh.h"

namespace limitcheck::fast {

/// Subdivides a single triangle whose three edges are boundary. Row r has 2^depth - r + 1 points; (0, 0) is
/// corner 2, (2^depth, 0) corner 0, (0, 2^depth) corner 1. Allocated once for m = max_depth: twice
/// (2^m + 1)(2^m + 2) / 2 points.
template <class N, class Surface = LimitSurface<N>>
class TriangleLattice {
 public:
  using Vertex = typename Surface::Vertex;

  explicit TriangleLattice(int max_depth) {
    const std::size_t k = std::size_t{1} << max_depth;
    for (auto& points : points_) points.resize((k + 1) * (k + 2) / 2);
    strip_.resize(2 * (k + 1));
  }

  /// sink(row, strip): strip[2 i] in row `row`, strip[2 i + 1] in the next, 2 (2^depth - row) + 1 vertices.
  template <class Sink>
  void run(const PreparedMesh<N, Surface>& mesh, std::int32_t face, int depth, Sink&& sink) {
    const Adjacency& adjacency = mesh.adjacency();
    const std::int32_t v[3] = {adjacency.corner(face, 0), adjacency.corner(face, 1),
                               adjacency.corner(face, 2)};
    points_[0][0] = mesh.position(v[2]);
    points_[0][1] = mesh.position(v[1]);
    points_[0][2] = mesh.position(v[0]);
    std::vector<Vec3<N>>*from = &points_[0], *to = &points_[1];
    const std::array held{mesh.kind(v[0]) == VertexKind::kHeld, mesh.kind(v[1]) == VertexKind::kHeld,
                          mesh.kind(v[2]) == VertexKind::kHeld};
    for (int s = 0; s < depth; ++s) {
      refine(1 << s, held, *from, *to);
      std::swap(from, to);
    }
    const int k = 1 << depth;
    const auto limit = [&](int r, int c) -> Vertex {
      if (const int corner = corner_of(k, r, c); corner >= 0) return mesh.limit(v[corner]);
      const Vec3<N>& here = (*from)[index(k, r, c)];
      const Neighbours n = neighbours(*from, k, r, c);
      if (on_boundary(k, r, c))
        return boundary_vertex_limit<N, Surface>(here, *n[0], *n[1], *n[2], *n[3], zero_normals_);
      return regular_vertex_limit<N, Surface>(here, ring(n), zero_normals_);
    };
    for (int row = 0; row < k; ++row) {
      for (int c = 0; c + row <= k; ++c) {
        strip_[2 * static_cast<std::size_t>(c)] = limit(row, c);
        if (c + row < k) strip_[2 * static_cast<std::size_t>(c) + 1] = limit(row + 1, c);
      }
      sink(row, static_cast<const Vertex*>(strip_.data()));
    }
  }

  std::int64_t zero_normals() const { return zero_normals_; }

 private:
  static std::size_t index(int k, int r, int c) {
    return static_cast<std::size_t>(r * (k + 1) - r * (r - 1) / 2 + c);
  }
  /// The corner of the face that lies there, or -1.
  static int corner_of(int k, int r, int c) { return r == k ? 0 : c == k ? 1 : r == 0 && c == 0 ? 2 : -1; }
  static bool on_boundary(int k, int r, int c) { return r == 0 || c == 0 || r + c == k; }

  /// Counter-clockwise: all six from the next in the row on; on the boundary those there are, from one end along it to
  /// the other; at a corner both.
  using Neighbours = std::array<const Vec3<N>*, 6>;
  static Neighbours neighbours(const std::vector<Vec3<N>>& p, int k, int r, int c) {
    const auto at = [&](int i, int j) { return &p[index(k, i, j)]; };
    if (r == 0 && c == 0) return {at(1, 0), at(0, 1)};
    if (r == k) return {at(k - 1, 1), at(k - 1, 0)};
    if (c == k) return {at(0, k - 1), at(1, k - 1)};
    if (r == 0) return {at(r, c - 1), at(r + 1, c - 1), at(r + 1, c), at(r, c + 1)};
    if (c == 0) return {at(r + 1, c), at(r, c + 1), at(r - 1, c + 1), at(r - 1, c)};
    if (r + c == k) return {at(r - 1, c + 1), at(r - 1, c), at(r, c - 1), at(r + 1, c - 1)};
    return {at(r, c + 1), at(r - 1, c + 1), at(r - 1, c), at(r, c - 1), at(r + 1, c - 1), at(r + 1, c)};
  }
  static AxisRing<N> ring(const Neighbours& n) { return {*n[0], *n[1], *n[2], *n[3], *n[4], *n[5]}; }

  /// `held`: corners that stay where they are.
  static void refine(int k, const std::array<bool, 3>& held, const std::vector<Vec3<N>>& p,
                     std::vector<Vec3<N>>& out) {
    const auto at = [&](int r, int c) -> const Vec3<N>& { return p[index(k, r, c)]; };
    const auto put = [&](int r, int c) -> Vec3<N>& { return out[index(2 * k, r, c)]; };
    for (int r = 0; r <= k; ++r) {
      for (int c = 0; c + r <= k; ++c) {
        const Vec3<N>& v = at(r, c);
        const Neighbours n = neighbours(p, k, r, c);
        const int corner = corner_of(k, r, c);
        if (corner >= 0)
          put(2 * r, 2 * c) = held[static_cast<std::size_t>(corner)] ? v : curve_vertex(v, *n[0], *n[1]);
        else if (on_boundary(k, r, c))
          put(2 * r, 2 * c) = curve_vertex(v, *n[0], *n[3]);
        else
          put(2 * r, 2 * c) = regular_vertex(v, ring(n));
        if (r + c == k) continue;
        const Vec3<N>&right = at(r, c + 1), &down = at(r + 1, c);
        put(2 * r, 2 * c + 1) = r == 0 ? midpoint(v, right) : edge_point(v, right, at(r - 1, c + 1), down);
        put(2 * r + 1, 2 * c) = c == 0 ? midpoint(v, down) : edge_point(v, down, at(r + 1, c - 1), right);
        put(2 * r + 1, 2 * c + 1) =
            r + c + 1 == k ? midpoint(right, down) : edge_point(right, down, v, at(r + 1, c + 1));
      }
    }
  }

  std::vector<Vec3<N>> points_[2];
  std::vector<Vertex> strip_;
  std::int64_t zero_normals_ = 0;
};

}  // namespace limitcheck::fast
