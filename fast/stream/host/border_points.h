// SPDX-License-Identifier: MIT
// The border points of a batch's repaired faces: edges of one depth go together, one in each lane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fast/frame/draw_writer.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::fast::row_stream {

class BorderPoints {
 public:
  /// Evaluates the edges of all faces in the patches of a batch that are repaired. The narrow kernel takes
  /// what is left when there are not enough edges for the other.
  void evaluate(const RowStream& stream, const Kernel& narrow, std::span<const Patch> patches,
                const CrackPlan& plan, std::span<const std::size_t> batch, Workspace& workspace) {
    for (auto& edges : of_depth_) edges.clear();
    std::size_t points = 0;
    for (std::size_t lane = 0; lane < batch.size(); ++lane) {
      for (int s = 0; s < 2; ++s) {
        const Half& half = patches[batch[lane]].half[s];
        for (int e = 0; half.repaired() && e < 3; ++e) {
          const int depth = edge_depth(plan, half.face, e);
          of_depth_[depth].push_back({3 * half.face + e, &border_[lane][s][e]});
          points += static_cast<std::size_t>(side(depth));
        }
      }
    }
    if (points > points_.size()) points_.resize(points);
    Vertex* to = points_.data();
    for (int depth = 0; depth <= kMaxDepth; ++depth) {
      const auto& edges = of_depth_[depth];
      if (edges.empty()) continue;
      half_edges_.clear();
      const auto length = static_cast<std::size_t>(side(depth));
      for (std::size_t i = 0; i < edges.size(); ++i) {
        half_edges_.push_back(edges[i].half_edge);
        *edges[i].points = reinterpret_cast<const SurfaceVertex<float>*>(to + i * length);
      }
      // Whole batches of the wide kernel, the rest by the one that is full sooner.
      const auto wide = static_cast<std::size_t>(stream.kernel().lanes);
      const auto few = static_cast<std::size_t>(narrow.lanes);
      const std::size_t rest = edges.size() % wide, with_wide = edges.size() - (rest <= few ? rest : 0);
      const std::span<const std::int32_t> all(half_edges_);
      stream.edges(all.first(with_wide), depth, workspace, to);
      stream.edges(all.subspan(with_wide), depth, workspace, to + with_wide * length, &narrow);
      to += edges.size() * length;
    }
  }

  /// Of half s of the patch in a lane.
  const Border<float>& of(std::size_t lane, int s) const { return border_[lane][s]; }

  std::size_t bytes() const {
    std::size_t count = sizeof(Vertex) * points_.capacity();
    for (const auto& edges : of_depth_) count += sizeof(Edge) * edges.capacity();
    return count;
  }

 private:
  struct Edge {
    std::int32_t half_edge;
    const SurfaceVertex<float>** points;
  };

  std::array<std::vector<Edge>, kMaxDepth + 1> of_depth_;
  std::array<std::array<Border<float>, 2>, kMaxLanes> border_;
  std::vector<std::int32_t> half_edges_;
  std::vector<Vertex> points_;
};

}  // namespace limitcheck::fast::row_stream
