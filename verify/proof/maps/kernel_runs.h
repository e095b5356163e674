// SPDX-License-Identifier: MIT
// The shipped kernels on any number type: every limit point that they make for a pair, with its place.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "fast/frame/crack_centre.h"
#include "fast/frame/patch.h"
#include "fast/mesh/adjacency.h"
#include "fast/window/crack_edge.h"
#include "fast/window/sliding_window.h"
#include "fast/window/triangle_lattice.h"
#include "verify/proof/maps/linear_surface.h"

namespace limitcheck::verify {

using fast::LatticePoint;

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

  const fast::Adjacency& adjacency() const { return adjacency_; }
  const fast::PreparedMesh<N, Surface>& prepared() const { return prepared_; }

  /// The sliding window on the pair of half-edge 0, or the lattice of face 0 if that has no neighbour. Calls
  /// visit(LatticePoint, const Vertex&) for every vertex of every strip: the points of inner rows twice, as
  /// the window delivers them.
  template <class Visit>
  void pair(int depth, Visit&& visit) const {
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

  /// The borders of fans: the points of half-edge h by itself, from its origin to its end.
  template <class Visit>
  void edge(std::int32_t h, int depth, Visit&& visit) const {
    const int k = 1 << depth;
    fast::EdgeStrip<N, Surface> strip(depth, adjacency_.max_valence());
    std::vector<Vertex> out(static_cast<std::size_t>(k) + 1);
    strip.evaluate(prepared_, h, depth, out.data());
    const fast::Half half{h / 3, h % 3, fast::Display::kFan};
    for (int t = 0; t <= k; ++t) visit(half.lattice(k, k - t, t), out[t]);
  }

  /// The centre of a fan, the limit point at (1/3, 1/3, 1/3).
  template <class Visit>
  void centre(std::int32_t face, Visit&& visit) const {
    fast::FanCentreEvaluator<N, Surface> evaluator(adjacency_.max_valence());
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

}  // namespace limitcheck::verify
