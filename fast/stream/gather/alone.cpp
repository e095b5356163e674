// SPDX-License-Identifier: MIT
#include "fast/stream/gather/alone.h"

#include <algorithm>
#include <cstddef>

#include "fast/window/triangle_lattice.h"

namespace limitcheck::fast::row_stream {

namespace {

// A vertex of the sliding window as row streaming delivers it. Zeros have no sign.
Vertex rounded(const SurfaceVertex<double>& v) {
  const auto number = [](double x) { return static_cast<float>(x) + 0.F; };
  return {{number(v.position.x), number(v.position.y), number(v.position.z)},
          {number(v.normal.x), number(v.normal.y), number(v.normal.z)}};
}

std::vector<Vec3<double>> points_of(const QuadMesh& mesh) {
  std::vector<Vec3<double>> points;
  points.reserve(mesh.positions.size());
  for (const auto& p : mesh.positions) points.push_back(to_point(p));
  return points;
}

}  // namespace

GridEdges::GridEdges(const Adjacency& adjacency, const Grid& grid, Order order)
    : from_a(order == Order::kFromA) {
  const std::int32_t ac = 3 * grid.face0 + std::max(grid.edge0, 0), cd = Adjacency::next(ac),
                     da = Adjacency::prev(ac);
  const std::int32_t ca = grid.singleton() ? -1 : adjacency.twin(ac);
  const std::int32_t ab = ca < 0 ? -1 : Adjacency::next(ca), bc = ca < 0 ? -1 : Adjacency::prev(ca);
  of = {from_a ? ab : cd, from_a ? bc : da, from_a ? cd : ab, from_a ? da : bc, ac};
}

GridEdges::GridEdges(std::int32_t quad, Order order) : from_a(order == Order::kFromA), of{} {
  of.back() = -1;
  for (std::int32_t k = 0; k < 4; ++k)
    of[static_cast<std::size_t>(k)] = 4 * quad + (k + static_cast<int>(order)) % 4;
}

CutGrids::CutGrids(const TriangleMesh& mesh)
    : prepared_(mesh.adjacency(), positions_of<double>(mesh.points()), mesh.kinds()),
      on_cut_(static_cast<std::size_t>(mesh.adjacency().vertex_count())) {
  for (std::int32_t h = 0; h < 3 * mesh.adjacency().face_count(); ++h)
    if (mesh.is_cut(h)) on_cut_[adjacency().origin(h)] = on_cut_[adjacency().target(h)] = 1;
}

template <class Put>
void CutGrids::rows(Window& window, const Grid& grid, int depth, Order order, Put&& put) const {
  using Double = SurfaceVertex<double>;
  const bool from_a = order == Order::kFromA;
  const int size = 1 << depth;
  if (grid.edge0 < 0) {  // a face alone: its points above the diagonal; those below it are never shown
    std::vector<Double> whole(static_cast<std::size_t>((size + 1) * (size + 1)));
    const auto at = [&](int row, int column) -> Double& {
      return whole[static_cast<std::size_t>(row * (size + 1) + column)];
    };
    TriangleLattice<double>(depth).run(prepared_, grid.face0, depth, [&](int row, const Double* strip) {
      for (int k = 0; k < 2 * (size - row) + 1; ++k) at(size - row - k % 2, k / 2) = strip[k];
    });
    for (int j = 0; j <= size; ++j)
      put(j, [&](int i) -> const Double& { return from_a ? at(j, i) : at(size - j, size - i); });
    return;
  }
  // The window's rows come from its upper right corner, from right to left.
  const std::int32_t ac = 3 * grid.face0 + grid.edge0;
  window.run(prepared_, from_a ? adjacency().twin(ac) : ac, depth, [&](int row, const Double* strip) {
    for (int j = row == 0 ? 0 : row + 1; j <= row + 1; ++j)
      put(j, [&](int i) -> const Double& { return strip[2 * (size - i) + (j - row)]; });
  });
}

SemiSharpQuads::SemiSharpQuads(const QuadMesh& mesh) : prepared_(mesh, points_of(mesh)) {}

// The window's rows come from its top, where its third and fourth corners are.
template <class Put>
void SemiSharpQuads::rows(Window& window, std::int32_t quad, int depth, Order order, Put&& put) const {
  using Double = SurfaceVertex<double>;
  const int size = 1 << depth;
  window.run_from(prepared_, 4 * quad + (static_cast<int>(order) + 2) % 4, depth,
                  [&](int row, const Double* strip) {
                    for (int j = row == 0 ? 0 : row + 1; j <= row + 1; ++j)
                      put(j, [&](int i) -> const Double& { return strip[2 * (size - i) + (j - row)]; });
                  });
}

template <class Mesh>
AloneEvaluator<Mesh>::AloneEvaluator(const Mesh& mesh, const typename Mesh::Rings& rings, int depth)
    : mesh_(mesh),
      rings_(rings),
      depth_(depth),
      window_(depth, mesh.adjacency().max_valence()),
      edge_(depth, mesh.adjacency().max_valence()),
      line_((std::size_t{1} << depth) + 1),
      edges_(GridEdges::kCount * line_.size()) {}

template <class Mesh>
void AloneEvaluator<Mesh>::edge(std::int32_t h, Vertex* out) {
  edge_.evaluate(mesh_.prepared(), h, depth_, line_.data());
  std::transform(line_.begin(), line_.end(), out, rounded);
  out[0] = Mesh::limit(rings_, mesh_.adjacency().origin(h));
  out[line_.size() - 1] = Mesh::limit(rings_, mesh_.adjacency().target(h));
}

template <class Mesh>
void AloneEvaluator<Mesh>::evaluate(const typename Mesh::Item& item, Order order, const GridEdges& on,
                                    const Target<float>& target) {
  const auto& adjacency = mesh_.adjacency();
  const int size = 1 << depth_;
  mesh_.rows(window_, item, depth_, order, [&](int j, auto&& points) {
    float* const to = target.base + target.row_offset(j);
    const auto put = [&](int i, const Vertex& v) {
      std::copy_n(&v.position.x, 3, to + 6 * i), std::copy_n(&v.normal.x, 3, to + 6 * i + 3);
    };
    for (int i = 0; i <= size; ++i) put(i, rounded(points(i)));
    for (std::size_t k = 0; k < GridEdges::kCount; ++k) {
      if (!shared(on, k)) continue;
      const Vertex* const edge = edges_.data() + k * line_.size();
      if (k == 0 && j == 0)
        for (int i = 0; i <= size; ++i) put(i, edge[i]);
      if (k == 1) put(size, edge[j]);
      if (k == 2 && j == size)
        for (int i = 0; i <= size; ++i) put(i, edge[size - i]);
      if (k == 3) put(0, edge[size - j]);
      if (k == GridEdges::kDiagonal) put(j, edge[on.from_a ? j : size - j]);
    }
    const int row[] = {0, 0, size, size, 0}, column[] = {0, size, size, 0, 0};
    for (std::size_t k = 0; k < 4; ++k) {
      if (on.of[k] < 0) continue;
      if (row[k] == j) put(column[k], Mesh::limit(rings_, adjacency.origin(on.of[k])));
      if (row[k + 1] == j) put(column[k + 1], Mesh::limit(rings_, adjacency.target(on.of[k])));
    }
    if (target.row != nullptr) target.row(target.context, j);
  });
}

template class AloneEvaluator<CutGrids>;
template class AloneEvaluator<SemiSharpQuads>;

}  // namespace limitcheck::fast::row_stream
