// SPDX-License-Identifier: MIT
// Evaluates one patch of a frame: window, lattice, borders and centres, as its faces are displayed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "fast/frame/crack_centre.h"
#include "fast/frame/draw_writer.h"
#include "fast/frame/patch.h"
#include "fast/window/crack_edge.h"
#include "fast/window/sliding_window.h"
#include "fast/window/triangle_lattice.h"

namespace limitcheck::fast {

/// What a thread reuses from patch to patch.
template <class Real>
struct Worker {
  Worker(int max_depth, int max_valence, bool isolated_faces)
      : window(max_depth, max_valence), edge(max_depth, max_valence), centre(max_valence) {
    if (isolated_faces) lattice.emplace(max_depth);
    scratch.reserve(max_depth);
    for (auto& b : border) b.resize((std::size_t{1} << max_depth) + 1);
  }

  SlidingWindow<Real> window;
  EdgeStrip<Real> edge;
  FanCentreEvaluator<Real> centre;
  std::optional<TriangleLattice<Real>> lattice;
  typename DrawWriter<Real>::Scratch scratch;
  std::array<std::vector<SurfaceVertex<Real>>, 3> border;

  std::int64_t zero_normals() const {
    return window.zero_normals() + edge.zero_normals() + centre.zero_normals() +
           (lattice ? lattice->zero_normals() : 0);
  }
};

/// Evaluates one patch and hands every piece to the writer.
template <class Real, class Writer>
void evaluate(const PreparedMesh<Real>& mesh, const Patch& patch, const CrackPlan& plan, FanCentre centre,
              Worker<Real>& worker, Writer& writer) {
  using Vertex = SurfaceVertex<Real>;
  const int k = 1 << patch.depth;
  if (patch.half[1].face < 0) {
    if (patch.half[0].uses_window()) {
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
    Border<Real> border;
    for (int e = 0; e < 3; ++e) {
      auto& points = worker.border[e];
      worker.edge.evaluate(mesh, 3 * half.face + e, edge_depth(plan, half.face, e), points.data());
      border[e] = points.data();
    }
    if (half.display == Display::kFan)
      writer.fan(side, worker.centre.evaluate(mesh, half.face, centre), border);
    else
      writer.ring(side, border);
  }
}

}  // namespace limitcheck::fast
