// SPDX-License-Identifier: MIT
#include "fast/stream/gather/cut_grids.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace limitcheck::fast::row_stream {

CutGrids::CutGrids(const TriangleMesh& mesh)
    : prepared_(mesh.adjacency(), positions_of<double>(mesh.points()), mesh.kinds()),
      on_cut_(static_cast<std::size_t>(mesh.adjacency().vertex_count())) {
  for (std::int32_t h = 0; h < 3 * mesh.adjacency().face_count(); ++h)
    if (mesh.is_cut(h)) on_cut_[adjacency().origin(h)] = on_cut_[adjacency().target(h)] = 1;
}

GridEdges::GridEdges(const Adjacency& adjacency, const Grid& grid, Order order)
    : from_a(order == Order::kFromA) {
  const std::int32_t ac = 3 * grid.face0 + std::max(grid.edge0, 0), cd = Adjacency::next(ac),
                     da = Adjacency::prev(ac);
  const std::int32_t ca = grid.singleton() ? -1 : adjacency.twin(ac);
  const std::int32_t ab = ca < 0 ? -1 : Adjacency::next(ca), bc = ca < 0 ? -1 : Adjacency::prev(ca);
  const std::int32_t edges[kCount] = {from_a ? ab : cd, from_a ? bc : da, from_a ? cd : ab, from_a ? da : bc,
                                      ac};
  std::copy_n(edges, kCount, of);
}

CutGridEvaluator::CutGridEvaluator(const CutGrids& mesh, const Rings& rings, int depth)
    : mesh_(mesh),
      rings_(rings),
      depth_(depth),
      window_(depth, mesh.adjacency().max_valence()),
      edge_(depth, mesh.adjacency().max_valence()),
      line_((std::size_t{1} << depth) + 1) {}

Vertex CutGridEvaluator::corner(std::int32_t v) const {
  return vertex_from(rings_.corner(v).head.data() + CornerBlock::kLimit);
}

void CutGridEvaluator::edge(std::int32_t h, Vertex* out) {
  edge_.evaluate(mesh_.prepared(), h, depth_, line_.data());
  std::transform(line_.begin(), line_.end(), out, rounded);
  out[0] = corner(mesh_.adjacency().origin(h));
  out[line_.size() - 1] = corner(mesh_.adjacency().target(h));
}

void CutGridEvaluator::grid(const Grid& grid, Order order, const Vertex* edges, const Target<float>& target) {
  using Double = SurfaceVertex<double>;
  const Adjacency& adjacency = mesh_.adjacency();
  const GridEdges along(adjacency, grid, order);
  const int size = 1 << depth_;
  if (grid.edge0 < 0) {
    face_alone(grid.face0);
    for (int j = 0; j <= size; ++j) {
      const auto points = [&](int i) -> const Double& {
        const int row = order == Order::kFromA ? j : size - j, column = order == Order::kFromA ? i : size - i;
        return whole_[static_cast<std::size_t>(row * (size + 1) + column)];
      };
      put_row(along, j, points, edges, target);
    }
    return;
  }
  // The window's rows come from its upper right corner, from right to left.
  const std::int32_t ac = 3 * grid.face0 + grid.edge0;
  window_.run(mesh_.prepared(), order == Order::kFromA ? adjacency.twin(ac) : ac, depth_,
              [&](int row, const Double* strip) {
                for (int j = row == 0 ? 0 : row + 1; j <= row + 1; ++j) {
                  const auto points = [&](int i) -> const Double& {
                    return strip[2 * (size - i) + (j - row)];
                  };
                  put_row(along, j, points, edges, target);
                }
              });
}

// Its points above the diagonal; those below it are never shown.
void CutGridEvaluator::face_alone(std::int32_t face) {
  const int size = 1 << depth_;
  whole_.assign(static_cast<std::size_t>((size + 1) * (size + 1)), {});
  TriangleLattice<double> lattice(depth_);
  lattice.run(mesh_.prepared(), face, depth_, [&](int row, const SurfaceVertex<double>* strip) {
    for (int k = 0; k < 2 * (size - row) + 1; ++k)
      whole_[static_cast<std::size_t>((size - row - k % 2) * (size + 1) + k / 2)] = strip[k];
  });
}

/// points(i): of row j.
template <class Points>
void CutGridEvaluator::put_row(const GridEdges& along, int j, Points&& points, const Vertex* edges,
                               const Target<float>& target) const {
  const Adjacency& adjacency = mesh_.adjacency();
  const int size = 1 << depth_;
  float* const to = target.base + target.row_offset(j);
  const auto put = [&](int i, const Vertex& v) { std::memcpy(to + 6 * i, &v, sizeof v); };
  const auto point = [&](int k, int t) -> const Vertex& { return edges[k * (size + 1) + t]; };
  for (int i = 0; i <= size; ++i) put(i, rounded(points(i)));
  for (int k = 0; k < GridEdges::kCount; ++k) {
    if (along.of[k] < 0 || mesh_.touches(along.of[k])) continue;
    if (k == 0 && j == 0)
      for (int i = 0; i <= size; ++i) put(i, point(k, i));
    if (k == 1) put(size, point(k, j));
    if (k == 2 && j == size)
      for (int i = 0; i <= size; ++i) put(i, point(k, size - i));
    if (k == 3) put(0, point(k, size - j));
    if (k == GridEdges::kDiagonal) put(j, point(k, along.from_a ? j : size - j));
  }
  const int row[] = {0, 0, size, size, 0}, column[] = {0, size, size, 0, 0};
  for (int k = 0; k < 4; ++k) {
    if (along.of[k] < 0) continue;
    if (row[k] == j) put(column[k], corner(adjacency.origin(along.of[k])));
    if (row[k + 1] == j) put(column[k + 1], corner(adjacency.target(along.of[k])));
  }
  if (target.row != nullptr) target.row(target.context, j);
}

}  // namespace limitcheck::fast::row_stream
