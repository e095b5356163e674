// SPDX-License-Identifier: MIT
#include "verify/shared_bits/rewritten.h"

namespace limitcheck::verify {

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

}  // namespace limitcheck::verify
