// SPDX-License-Identifier: MIT
#include "verify/shared_bits/test_support/shared_bits.h"

#include <fmt/core.h>
#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>
#include <vector>

#include "fast/frame/patch.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::verify {

namespace {

// What no evaluation yields: a NaN with this payload.
constexpr std::uint32_t kNothing = 0xffffffffu;

}  // namespace

SharedBits::SharedBits(const data::ControlMesh& mesh, int deepest)
    : mesh_(mesh), levels_(static_cast<std::size_t>(deepest) + 1) {}

SharedBits::Level& SharedBits::level(int depth) {
  auto& level = levels_.at(depth);
  if (!level) {
    level = std::make_unique<Level>(mesh_, depth);
    const auto edges = static_cast<std::int64_t>(level->lattice.edges().size());
    const auto shared = static_cast<std::int64_t>(mesh_.positions.size()) + edges * (level->lattice.n() - 1);
    Bits nothing;
    nothing.fill(kNothing);
    level->first.assign(shared, nothing);
  }
  return *level;
}

void SharedBits::add(const Place& at, const float* vertex) {
  const auto place = FaceDomain::triangle().side_of(point_of(at), at.denominator);
  if (!place) return;
  // A control vertex has the same bits at every depth: all of them go into the first table.
  Level& here = level(place->along == 0 ? 0 : std::countr_zero(at.denominator));
  const Lattice::Id id = here.lattice.id(at);

  Bits bits;
  std::memcpy(bits.data(), vertex, sizeof bits);
  Bits& first = here.first[id];
  if (first[0] == kNothing) {
    first = bits;
    ++points_;
    return;
  }
  ++compared_;
  if (first == bits) return;
  ++different_;
  for (std::size_t k = 0; k < 6; ++k) different_bits_ += std::popcount(first[k] ^ bits[k]);
  if (witness_.empty()) {
    witness_ =
        fmt::format("face {} at ({}, {}) / {}, x y z and normal:", at.face, at.i, at.j, at.denominator);
    for (std::size_t k = 0; k < 6; ++k)
      witness_ += fmt::format(" {}/{}", std::bit_cast<float>(first[k]), std::bit_cast<float>(bits[k]));
  }
}

std::uint64_t SharedBits::hash() const {
  std::uint64_t value = 0xcbf29ce484222325u;
  for (const auto& level : levels_) {
    if (!level) continue;
    for (const Bits& bits : level->first) {
      for (const std::uint32_t word : bits) value = (value ^ word) * 0x100000001b3u;
    }
  }
  return value;
}

data::ControlMesh rounded(data::ControlMesh mesh) {
  for (auto& p : mesh.positions)
    for (double& x : p) x = static_cast<double>(static_cast<float>(x));
  return mesh;
}

Rewriting rewrite(const data::ControlMesh& mesh, std::uint64_t seed) {
  Rewriting out(mesh, data::Scheme::kLoop);
  if (seed == 0) return out;
  data::SplitMix64 random(seed);
  out.number_vertices(shuffled(mesh.positions.size(), random));
  out.order_faces(shuffled(mesh.faces.size(), random));
  for (std::size_t f = 0; f < out.face.size(); ++f) out.turn_face(f, static_cast<int>(random.next() % 3));
  return out;
}

std::vector<fast::Grid> random_pairs(const fast::Adjacency& adjacency, int depth, std::uint64_t seed,
                                     std::uint64_t singles) {
  data::SplitMix64 random(seed);
  const auto faces = static_cast<std::size_t>(adjacency.face_count());
  std::vector<bool> taken(faces, false);
  std::vector<fast::Grid> pairs;
  for (const std::int32_t f : shuffled(faces, random)) {
    if (taken[f]) continue;
    taken[f] = true;
    fast::Grid pair{f, -1, -1, -1, depth};
    const bool single = random.next() % singles == 0;
    const std::size_t turn = random.next() % 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const int edge = static_cast<int>((k + turn) % 3);
      const std::int32_t twin = adjacency.twin(3 * f + edge);
      if (twin < 0) continue;
      const bool dummy = single || taken[twin / 3];
      if (dummy && pair.edge0 >= 0) continue;
      pair = {f, dummy ? -1 : twin / 3, edge, twin % 3, depth};
      if (!dummy) break;
    }
    if (pair.face1 >= 0) taken[pair.face1] = true;
    pairs.push_back(pair);
  }
  return pairs;
}

namespace rs = fast::row_stream;

namespace {

struct Sink {
  const Rewriting& mesh;
  SharedBits& bits;

  void add(const fast::LatticePoint& at, const rs::Vertex& v) {
    bits.add(mesh.original({at.face, at.i, at.j, at.denominator}), &v.position.x);
  }

  // Row j of a pair: its ends and its point on the diagonal, or all of the outer rows.
  void row(const fast::Grid& pair, int depth, int j, const rs::Vertex* vertices) {
    const int size = 1 << depth;
    const bool outer = j == 0 || j == size;
    for (int i = 0; i <= size; i = outer || i + 1 > size ? i + 1 : i < j ? j : std::max(i + 1, size)) {
      const fast::LatticePoint at = fast::face_point(pair, size, i, j, j >= i);
      if (at.face >= 0) add(at, vertices[i]);
    }
  }
};

}  // namespace

void add_pairs(const Rewriting& mesh, int depth, const rs::Kernel& kernel, Form form, std::uint64_t seed,
               SharedBits& bits) {
  const fast::Adjacency adjacency(mesh.mesh);
  const rs::RowStream stream(mesh.mesh, adjacency, kernel);
  const auto pairs = random_pairs(adjacency, depth, seed);
  rs::Workspace workspace;
  Sink sink{mesh, bits};
  if (form == Form::kRows) {
    std::pair<Sink*, const std::vector<fast::Grid>*> sink_and_pairs{&sink, &pairs};
    stream.rows(
        pairs, depth, workspace,
        [](void* context, const rs::RowView& view) {
          const auto& [to, of] = *static_cast<std::pair<Sink*, const std::vector<fast::Grid>*>*>(context);
          for (std::size_t lane = 0; lane < view.size(); ++lane)
            to->row((*of)[view.number(lane)], view.depth, view.j, view.vertices(lane));
        },
        &sink_and_pairs);
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

void add_edges(const Rewriting& mesh, int depth, const rs::Kernel& kernel, std::uint64_t seed,
               SharedBits& bits) {
  const fast::Adjacency adjacency(mesh.mesh);
  const rs::RowStream stream(mesh.mesh, adjacency, kernel);
  data::SplitMix64 random(seed);
  const auto half_edges = shuffled(3 * mesh.mesh.faces.size(), random);
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
        const FaceDomain::Point at = FaceDomain::triangle().on_side(some[e] % 3, t, size);
        sink.add({some[e] / 3, static_cast<std::uint32_t>(at.i), static_cast<std::uint32_t>(at.j),
                  static_cast<std::uint32_t>(size)},
                 out[e * side + t]);
      }
    }
  }
}

}  // namespace limitcheck::verify
