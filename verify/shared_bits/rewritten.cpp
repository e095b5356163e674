// SPDX-License-Identifier: MIT
#include "verify/shared_bits/rewritten.h"

#include <utility>

namespace limitcheck::verify {

data::ControlMesh rounded(data::ControlMesh mesh) {
  for (auto& p : mesh.positions)
    for (double& x : p) x = static_cast<double>(static_cast<float>(x));
  return mesh;
}

namespace {

std::vector<std::int32_t> shuffled(std::size_t count, data::SplitMix64& random) {
  std::vector<std::int32_t> order(count);
  for (std::size_t k = 0; k < count; ++k) order[k] = static_cast<std::int32_t>(k);
  for (std::size_t k = count; k > 1; --k) std::swap(order[k - 1], order[random.next() % k]);
  return order;
}

}  // namespace

Rewritten rewrite(const data::ControlMesh& mesh, std::uint64_t seed) {
  data::SplitMix64 random(seed);
  Rewritten out;
  std::vector<std::int32_t> number(mesh.positions.size());
  for (std::size_t v = 0; v < number.size(); ++v) number[v] = static_cast<std::int32_t>(v);
  out.face.resize(mesh.triangles.size());
  for (std::size_t f = 0; f < out.face.size(); ++f) out.face[f] = static_cast<std::int32_t>(f);
  if (seed != 0) {
    number = shuffled(number.size(), random);
    out.face = shuffled(out.face.size(), random);
  }
  out.mesh.positions.resize(mesh.positions.size());
  for (std::size_t v = 0; v < number.size(); ++v)
    out.mesh.positions[static_cast<std::size_t>(number[v])] = mesh.positions[v];
  for (const std::int32_t f : out.face) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(f)];
    const std::size_t turn = seed == 0 ? 0 : random.next() % 3;
    out.turn.push_back(static_cast<std::uint8_t>(turn));
    std::array<std::int32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = number[static_cast<std::size_t>(t[(k + turn) % 3])];
    out.mesh.triangles.push_back(corners);
  }
  return out;
}

std::vector<fast::Grid> random_pairs(const fast::Adjacency& adjacency, int depth, std::uint64_t seed,
                                     std::uint64_t singles) {
  data::SplitMix64 random(seed);
  const auto faces = static_cast<std::size_t>(adjacency.face_count());
  std::vector<bool> taken(faces, false);
  std::vector<fast::Grid> pairs;
  for (const std::int32_t f : shuffled(faces, random)) {
    if (taken[static_cast<std::size_t>(f)]) continue;
    taken[static_cast<std::size_t>(f)] = true;
    fast::Grid pair{f, -1, -1, -1, depth};
    const bool single = random.next() % singles == 0;
    const std::size_t turn = random.next() % 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const int edge = static_cast<int>((k + turn) % 3);
      const std::int32_t twin = adjacency.twin(3 * f + edge);
      if (twin < 0) continue;
      const bool dummy = single || taken[static_cast<std::size_t>(twin / 3)];
      if (dummy && pair.edge0 >= 0) continue;
      pair = {f, dummy ? -1 : twin / 3, edge, twin % 3, depth};
      if (!dummy) break;
    }
    if (pair.face1 >= 0) taken[static_cast<std::size_t>(pair.face1)] = true;
    pairs.push_back(pair);
  }
  return pairs;
}

std::vector<std::int32_t> random_depths(std::size_t faces, int least, int most, std::uint64_t seed) {
  data::SplitMix64 random(seed);
  std::vector<std::int32_t> depth(faces);
  for (std::int32_t& d : depth)
    d = least + static_cast<std::int32_t>(random.next() % static_cast<std::uint64_t>(most - least + 1));
  return depth;
}

}  // namespace limitcheck::verify
