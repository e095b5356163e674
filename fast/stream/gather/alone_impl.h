// SPDX-License-Identifier: MIT
// AloneEvaluator for any mesh; alone.cpp and alone_quads.cpp instantiate it, apart, for the compiler inlines less where
// both stand together.
#pragma once

#include <algorithm>
#include <array>
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
AloneEvaluator<Mesh>::AloneEvaluator(const Mesh& mesh, const typename Mesh::Rings& rings, int depth)
    : mesh_(mesh),
      rings_(rings),
      depth_(depth),
      window_(depth, mesh.adjacency().max_valence()),
      edge_(depth, mesh.adjacency().max_valence()),
      line_((std::size_t{1} << depth) + 1) {}

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
  std::array<bool, GridEdges::kCount> by_kernel;
  for (std::size_t k = 0; k < GridEdges::kCount; ++k) by_kernel[k] = shared(on, k);
  mesh_.rows(window_, item, depth_, order, [&](int j, auto&& points) {
    float* const to = target.base + target.row_offset(j);
    const auto put = [&](int i, const Vertex& v) { std::memcpy(to + 6 * i, &v, sizeof v); };
    for (int i = 0; i <= size; ++i) put(i, rounded(points(i)));
    for (std::size_t k = 0; k < GridEdges::kCount; ++k) {
      if (!by_kernel[k]) continue;
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
    for (std::size_t k = 0; k < 4 && (j == 0 || j == size); ++k) {
      if (on.of[k] < 0) continue;
      if (row[k] == j) put(column[k], Mesh::limit(rings_, adjacency.origin(on.of[k])));
      if (row[k + 1] == j) put(column[k + 1], Mesh::limit(rings_, adjacency.target(on.of[k])));
    }
    if (target.row != nullptr) target.row(target.context, j);
  });
}

}  // namespace limitcheck::fast::row_stream
