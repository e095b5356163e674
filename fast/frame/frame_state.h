// SPDX-License-Identifier: MIT
// What both engines do alike: take a mesh, plan a frame, make room for its output.
#pragma once

#include <tbb/task_arena.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "fast/frame/draw_writer.h"
#include "fast/frame/frame_options.h"
#include "fast/frame/index_writer.h"

namespace limitcheck::fast {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A mesh, and the plan of the frame it is at.
struct FrameState {
  /// throws   std::invalid_argument: no faces, a coordinate that is not finite, a mesh that Adjacency
  /// refuses,
  ///          a negative number of threads
  FrameState(const data::ControlMesh& given, const TessellatorOptions& with);

  /// Pairing, crack plan and patches. What it returns lacks the number of vertices, zero normals, and the
  /// times of what is still to do.
  ///   throws   std::invalid_argument: not one depth per face, a depth outside -1 .. deepest
  FrameStats plan_frame(std::span<const std::int32_t> depth, int deepest);

  /// frame(depths), with the depths that a strategy gives.
  template <class Frame>
  FrameStats by_strategy(const DepthOptions& strategy, const Camera& camera, Frame&& frame) {
    const auto start = Clock::now();
    std::vector<std::int32_t> depth;
    arena.execute([&] {
      if (!heuristics) heuristics.emplace(mesh, adjacency, options.max_depth);
      depth = heuristics->depths(strategy, camera);
    });
    const double seconds = seconds_since(start);
    FrameStats stats = frame(depth);
    stats.seconds_heuristics = seconds;
    stats.seconds_total += seconds;
    return stats;
  }

  /// Sizes a draw list for patches first .. last - 1; offsets: where each begins, and the end.
  template <class Real>
  void make_room(std::size_t first, std::size_t last, DrawList<Real>& out,
                 std::vector<DrawSize>& offsets) const {
    offsets.assign(1, {});
    for (std::size_t i = first; i < last; ++i) {
      const DrawSize size = draw_size(patches[i], plan);
      offsets.push_back({offsets.back().vertices + size.vertices, offsets.back().draws + size.draws, 0});
    }
    out.vertices.resize(static_cast<std::size_t>(offsets.back().vertices));
    out.draws.resize(static_cast<std::size_t>(offsets.back().draws));
    out.provenance.resize(options.provenance ? out.vertices.size() : 0);
  }

  /// Sizes an indexed mesh for the frame.
  ///   throws   std::invalid_argument: more vertices than 32-bit indices reach
  template <class Real>
  IndexLayout make_room(IndexedMesh<Real>& out) const {
    IndexLayout layout = IndexLayout::of(adjacency, pairing.depth, plan);
    if (layout.vertex_count > std::numeric_limits<std::uint32_t>::max())
      throw std::invalid_argument("frame: " + std::to_string(layout.vertex_count) +
                                  " vertices are more than 32-bit indices reach");
    out.vertices.resize(static_cast<std::size_t>(layout.vertex_count));
    out.provenance.resize(options.provenance ? out.vertices.size() : 0);
    out.triangles.resize(static_cast<std::size_t>(layout.triangle_count));
    out.triangle_face.resize(out.triangles.size());
    out.triangle_kind.resize(out.triangles.size());
    return layout;
  }

  data::ControlMesh mesh;
  TessellatorOptions options;
  Adjacency adjacency;
  std::optional<DepthHeuristics> heuristics;
  tbb::task_arena arena;
  PairingResult pairing;
  CrackPlan plan;
  std::vector<Patch> patches;
  int max_depth = 0;  // of pairs and edges
};

}  // namespace limitcheck::fast
