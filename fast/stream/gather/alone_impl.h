// SPDX-License-Identifier: MIT
// AloneEvaluator for any mesh; alone.cpp and alone_quads.cpp instantiate it, apart, for the compiler inlines less where
// both stand together.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "fast/stream/gather/alone.h"

namespace limitcheck::fast::row_stream {

// A vertex of the sliding window as row streaming delivers it. Zeros have no sign.
inline Vertex rounded(const SurfaceVertex<double>& v) {
  const auto number = [](double x) { return static_cast<float>(x) + 0.F; };
  return {{number(v.position.x), number(v.position.y), number(v.position.z)},
          {number(v.normal.x), number(v.normal.y), number(v.normal.z)}};
}

template <class Mesh>
AloneEvaluator<Mesh>::AloneEvaluator(const Mesh& mesh, const Rings& rings, int depth)
    : mesh_(mesh),
      rings_(rings),
      depth_(depth),
      window_(depth, mesh.adjacency().max_valence()),
      edge_(depth, mesh.adjacency().max_valence()),
      line_((std::size_t{1} << depth) + 1),
      edge_points_(line_.size()) {}

template <class Mesh>
void AloneEvaluator<Mesh>::edge(std::int32_t h, Vertex* out) {
  edge_.evaluate(mesh_.prepared(), h, depth_, line_.data());
  std::transform(line_.begin(), line_.end(), out, rounded);
  out[0] = limit(mesh_.adjacency().origin(h));
  out[line_.size() - 1] = limit(mesh_.adjacency().target(h));
}

template <class Mesh>
void AloneEvaluator<Mesh>::grid(const typename Mesh::Item& item, Order order, const QuadTarget<float>& target,
                                const std::function<void(std::int32_t h, Vertex* out)>& by_kernel) {
  const int last = 1 << depth_;
  const std::size_t n = line_.size();
  grid_.assign(n * n, Vertex{});
  const auto at = [&](int j, int i) -> Vertex& {
    return grid_[static_cast<std::size_t>(j) * n + static_cast<std::size_t>(i)];
  };
  mesh_.run(window_, item, depth_, order,
            [&](int j, int i, const SurfaceVertex<double>& point) { at(j, i) = rounded(point); });
  const GridEdges on = mesh_.edges(item, order);
  for (std::size_t k = GridEdges::kCount; k-- > 0;) {  // the diagonal first: of its ends others are to decide
    const std::int32_t h = on.of[k];
    if (h < 0) continue;
    const auto point = [&](int t) -> Vertex& {
      const int back = last - t, across = on.from_a ? t : back;
      const int row[] = {0, t, last, back, across}, column[] = {t, last, back, 0, across};
      return at(row[k], column[k]);
    };
    if (!mesh_.touches(rings_, h)) {
      by_kernel(h, edge_points_.data());
      for (int t = 0; t <= last; ++t) point(t) = edge_points_[static_cast<std::size_t>(t)];
    }
    if (k == GridEdges::kDiagonal) continue;
    point(0) = limit(mesh_.adjacency().origin(h));
    point(last) = limit(mesh_.adjacency().target(h));
  }
  for (int j = 0; j <= last; ++j) {
    std::memcpy(target.lane[0] + target.row_offset(j), &at(j, 0), n * sizeof(Vertex));
    if (target.row != nullptr) target.row(target.context, j);
  }
}

}  // namespace limitcheck::fast::row_stream
