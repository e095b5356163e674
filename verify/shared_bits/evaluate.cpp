// SPDX-License-Identifier: MIT
#include "verify/shared_bits/evaluate.h"

#include <algorithm>
#include <vector>

#include "fast/stream/lattice.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::verify {

namespace rs = fast::row_stream;

namespace {

struct Sink {
  const Rewritten& mesh;
  SharedBits& bits;

  void add(int depth, std::int32_t face, const std::array<int, 3>& at, const rs::Vertex& v) {
    bits.add(depth, mesh.face[static_cast<std::size_t>(face)], mesh.original(face, at), v.position);
  }

  // Row j of a pair: its ends and its point on the diagonal, or all of the outer rows.
  void row(const fast::Grid& pair, int depth, int j, const rs::Vertex* vertices) {
    const int size = 1 << depth;
    const bool outer = j == 0 || j == size;
    for (int i = 0; i <= size; i = outer || i + 1 > size ? i + 1 : i < j ? j : std::max(i + 1, size)) {
      const rs::FacePoint at = rs::face_point(pair, size, i, j, j >= i);
      if (at.face >= 0) add(depth, at.face, {size - at.i - at.j, at.i, at.j}, vertices[i]);
    }
  }
};

}  // namespace

void add_pairs(const Rewritten& mesh, int depth, const rs::Kernel& kernel, Form form, std::uint64_t seed,
               SharedBits& bits) {
  const fast::Adjacency adjacency(mesh.mesh);
  const rs::RowStream stream(mesh.mesh, adjacency, kernel);
  const auto pairs = random_pairs(adjacency, depth, seed);
  rs::Workspace workspace;
  Sink sink{mesh, bits};
  if (form == Form::kRows) {
    stream.rows(
        pairs, depth, workspace,
        [](void* context, const rs::RowView& view) {
          for (std::size_t lane = 0; lane < view.grids.size(); ++lane)
            static_cast<Sink*>(context)->row(view.grids[lane], view.depth, view.j, view.vertices(lane));
        },
        &sink);
    return;
  }
  const auto side = static_cast<std::size_t>(rs::side(depth));
  const std::size_t together = 3 * static_cast<std::size_t>(kernel.lanes) + 1;  // not always full batches
  std::vector<rs::Vertex> out(together * side * side);
  for (std::size_t first = 0; first < pairs.size(); first += together) {
    const auto some = std::span(pairs).subspan(first, std::min(together, pairs.size() - first));
    stream.whole(some, depth, workspace, out.data());
    for (std::size_t p = 0; p < some.size(); ++p) {
      for (std::size_t j = 0; j < side; ++j)
        sink.row(some[p], depth, static_cast<int>(j), out.data() + (p * side + j) * side);
    }
  }
}

void add_edges(const Rewritten& mesh, int depth, const rs::Kernel& kernel, std::uint64_t seed,
               SharedBits& bits) {
  const fast::Adjacency adjacency(mesh.mesh);
  const rs::RowStream stream(mesh.mesh, adjacency, kernel);
  data::SplitMix64 random(seed);
  std::vector<std::int32_t> half_edges(3 * mesh.mesh.triangles.size());
  for (std::size_t h = 0; h < half_edges.size(); ++h) half_edges[h] = static_cast<std::int32_t>(h);
  for (std::size_t h = half_edges.size(); h > 1; --h)
    std::swap(half_edges[h - 1], half_edges[random.next() % h]);

  const auto side = static_cast<std::size_t>(rs::side(depth));
  const int size = 1 << depth;
  constexpr std::size_t kTogether = 1000;
  std::vector<rs::Vertex> out(kTogether * side);
  rs::Workspace workspace;
  Sink sink{mesh, bits};
  for (std::size_t first = 0; first < half_edges.size(); first += kTogether) {
    const auto some = std::span(half_edges).subspan(first, std::min(kTogether, half_edges.size() - first));
    stream.edges(some, depth, workspace, out.data());
    for (std::size_t e = 0; e < some.size(); ++e) {
      for (int t = 0; t <= size; ++t) {
        std::array<int, 3> at{};
        at[static_cast<std::size_t>(some[e] % 3)] = size - t;
        at[static_cast<std::size_t>((some[e] + 1) % 3)] = t;
        sink.add(depth, some[e] / 3, at, out[e * side + static_cast<std::size_t>(t)]);
      }
    }
  }
}

}  // namespace limitcheck::verify
