// SPDX-License-Identifier: MIT
// Quads and sides that something semi-sharp touches: by the rules of the sliding window, in double.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fast/mesh/cut_mesh.h"
#include "fast/rules/prepared_quads.h"
#include "fast/stream/gather/quad_rings.h"
#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/targets.h"
#include "fast/window/quad_edge.h"
#include "fast/window/quad_window.h"

namespace limitcheck::fast::row_stream {

/// The mesh for these rules. Keeps a reference to it. Read-only afterwards.
struct SemiSharpQuads {
  explicit SemiSharpQuads(const QuadMesh& mesh);
  PreparedQuads<double> prepared;
};

/// Evaluates them at one depth. A side with an end that is touched comes from its own three rows, with the
/// same bits from both of its quads; the kernels make all other sides, and the rings the corners: so these
/// quads meet the others bit by bit.
class SemiSharpEvaluator {
 public:
  SemiSharpEvaluator(const SemiSharpQuads& quads, const QuadRings& rings, int depth);

  /// A side of its own: 2^depth + 1 points from the origin of half-edge h on.
  void side(std::int32_t h, Vertex* out);

  /// The quad at half-edge h, which leads from its first corner to its second, into target.lane[0], row by
  /// row.
  ///   sides   2^depth + 1 points of each of its sides, as they run around the quad; those of sides with an
  ///           end that is touched are not looked at
  void quad(std::int32_t h, const Vertex* sides, const QuadTarget<float>& target);

 private:
  Vertex corner(std::int32_t h) const;
  void put_row(std::int32_t h, int j, const SurfaceVertex<double>* points, const Vertex* sides,
               const QuadTarget<float>& target) const;

  const PreparedQuads<double>& quads_;
  const QuadRings& rings_;
  int depth_;
  QuadWindow<double> window_;
  QuadEdge<double> edge_;
  std::vector<SurfaceVertex<double>> line_;
};

}  // namespace limitcheck::fast::row_stream
