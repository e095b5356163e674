// SPDX-License-Identifier: MIT
#include "fast/stream/gather/semi_sharp_quads.h"

#include <algorithm>
#include <cstring>

#include "fast/stream/gather/cut_grids.h"

namespace limitcheck::fast::row_stream {

namespace {

std::vector<Vec3<double>> points_of(const QuadMesh& mesh) {
  std::vector<Vec3<double>> points;
  points.reserve(mesh.positions.size());
  for (const auto& p : mesh.positions) points.push_back({p[0], p[1], p[2]});
  return points;
}

}  // namespace

SemiSharpQuads::SemiSharpQuads(const QuadMesh& mesh) : prepared(mesh, points_of(mesh)) {}

SemiSharpEvaluator::SemiSharpEvaluator(const SemiSharpQuads& quads, const QuadRings& rings, int depth)
    : quads_(quads.prepared),
      rings_(rings),
      depth_(depth),
      window_(depth, quads_.mesh().adjacency.max_valence()),
      edge_(depth, quads_.mesh().adjacency.max_valence()),
      line_((std::size_t{1} << depth) + 1) {}

Vertex SemiSharpEvaluator::corner(std::int32_t h) const {
  return vertex_from(rings_.head(rings_.corner(h).vertex) + QuadCornerBlock::kLimit);
}

void SemiSharpEvaluator::side(std::int32_t h, Vertex* out) {
  edge_.evaluate(quads_, h, depth_, line_.data());
  std::transform(line_.begin(), line_.end(), out, rounded);
  out[0] = corner(h);
  out[line_.size() - 1] = corner(QuadAdjacency::next(h));
}

// The window's rows come from its top, where its third and fourth corners are.
void SemiSharpEvaluator::quad(std::int32_t h, const Vertex* sides, const QuadTarget<float>& target) {
  const std::int32_t opposite = QuadAdjacency::next(QuadAdjacency::next(h));
  window_.run_from(quads_, opposite, depth_, [&](int row, const SurfaceVertex<double>* strip) {
    if (row == 0) put_row(h, 0, strip, sides, target);
    put_row(h, row + 1, strip + 1, sides, target);
  });
}

/// points: every other one, from right to left.
void SemiSharpEvaluator::put_row(std::int32_t h, int j, const SurfaceVertex<double>* points,
                                 const Vertex* sides, const QuadTarget<float>& target) const {
  const int size = 1 << depth_;
  float* const to = target.lane[0] + target.row_offset(j);
  const auto put = [&](int i, const Vertex& v) { std::memcpy(to + 6 * i, &v, sizeof v); };
  for (int i = 0; i <= size; ++i) put(i, rounded(points[2 * (size - i)]));
  std::int32_t at = h;
  for (int k = 0; k < 4; ++k, at = QuadAdjacency::next(at)) {
    const auto point = [&](int t) -> const Vertex& { return sides[k * (size + 1) + t]; };
    if (rings_.touches_semi_sharp(at)) continue;
    if (k == kAB && j == 0)
      for (int i = 0; i <= size; ++i) put(i, point(i));
    if (k == kBC) put(size, point(j));
    if (k == kCD && j == size)
      for (int i = 0; i <= size; ++i) put(i, point(size - i));
    if (k == kDA) put(0, point(size - j));
  }
  if (j == 0 || j == size) {
    const std::int32_t right = j == 0 ? QuadAdjacency::next(h) : QuadAdjacency::prev(QuadAdjacency::prev(h));
    put(0, corner(j == 0 ? h : QuadAdjacency::next(right)));
    put(size, corner(right));
  }
  if (target.row != nullptr) target.row(target.context, j);
}

}  // namespace limitcheck::fast::row_stream
