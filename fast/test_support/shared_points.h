// SPDX-License-Identifier: MIT
// For the tests of this folder: a mesh written down differently, and the points that its faces share.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "data/splitmix64.h"
#include "fast/frame/patch.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::fast::row_stream {

/// Uniform in 0 .. n - 1, near enough.
inline std::size_t below(data::SplitMix64& random, std::size_t n) {
  return static_cast<std::size_t>(random.next() % n);
}

/// Moves every vertex by up to `amount`, rounded to float.
inline data::ControlMesh shaken(data::ControlMesh mesh, double amount, std::uint64_t seed) {
  data::SplitMix64 random(seed);
  for (auto& p : mesh.positions) {
    for (double& x : p) x = static_cast<float>(x + amount * (2 * random.unit() - 1));
  }
  return mesh;
}

/// The same surface with faces reordered, corners rotated and vertices renumbered; `number` is the new index
/// of each.
inline data::ControlMesh renumbered(const data::ControlMesh& mesh, std::uint64_t seed,
                                    std::vector<std::int32_t>& number) {
  data::SplitMix64 random(seed);
  number.resize(mesh.positions.size());
  for (std::size_t v = 0; v < number.size(); ++v) number[v] = static_cast<std::int32_t>(v);
  for (std::size_t v = number.size(); v > 1; --v) std::swap(number[v - 1], number[below(random, v)]);
  data::ControlMesh out{mesh.positions, {}};
  for (std::size_t v = 0; v < number.size(); ++v) out.positions[number[v]] = mesh.positions[v];
  std::vector<std::array<std::int32_t, 3>> triangles = triangles_of(mesh).to_vector();
  for (auto& t : triangles) {
    const std::size_t turn = below(random, 3);
    t = {number[t[turn]], number[t[(turn + 1) % 3]], number[t[(turn + 2) % 3]]};
  }
  for (std::size_t f = triangles.size(); f > 1; --f) std::swap(triangles[f - 1], triangles[below(random, f)]);
  out.faces = data::Faces(triangles);
  return out;
}

/// The first bits seen for each point on a control edge or vertex, and how often others came.
class SharedPoints {
 public:
  /// A vertex and where it lies; `known`, if not empty, undoes a renumbering of the mesh.
  void add(const data::ControlMesh& mesh, const LatticePoint& at, const Vertex& v,
           const std::vector<std::int32_t>& known) {
    const auto t = triangles_of(mesh)[at.face];
    const auto size = static_cast<int>(at.denominator);
    const std::array<int, 3> l{size - static_cast<int>(at.i + at.j), static_cast<int>(at.i),
                               static_cast<int>(at.j)};
    const auto name = [&](int corner) { return known.empty() ? t[corner] : known[t[corner]]; };
    for (int k = 0; k < 3; ++k) {
      if (l[(k + 2) % 3] != 0) continue;
      std::int32_t a = name(k), b = name((k + 1) % 3), along = l[(k + 1) % 3];
      if (along == 0) b = a;
      if (along == size) a = b, along = 0;
      if (a > b) std::swap(a, b), along = size - along;
      std::array<std::uint32_t, 6> bits;
      std::memcpy(bits.data(), &v, sizeof bits);
      const auto [seen, fresh] = first_.try_emplace({a, b, along}, bits);
      if (fresh) continue;
      ++compared_;
      if (seen->second != bits) ++different_;
    }
  }
  std::int64_t points() const { return static_cast<std::int64_t>(first_.size()); }
  std::int64_t compared() const { return compared_; }
  std::int64_t different() const { return different_; }

 private:
  std::map<std::array<std::int32_t, 3>, std::array<std::uint32_t, 6>> first_;
  std::int64_t compared_ = 0, different_ = 0;
};

/// Tessellates all grids and adds every point of every control edge, the grids' diagonals included.
inline void add_shared_points(const data::ControlMesh& mesh, int depth, const Kernel& kernel,
                              const std::vector<std::int32_t>& known, SharedPoints& shared) {
  const Adjacency adjacency(mesh);
  const auto grids = pair_faces(adjacency, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids;
  const RowStream stream(mesh, adjacency, kernel);
  const int size = 1 << depth;
  Workspace workspace;
  std::vector<Vertex> out(grids.size() * static_cast<std::size_t>(side(depth) * side(depth)));
  stream.whole(grids, depth, workspace, out.data());
  for (std::size_t p = 0; p < grids.size(); ++p) {
    for (int j = 0; j <= size; ++j) {
      for (int i = 0; i <= size; ++i) {
        if (i > 0 && i < size && j > 0 && j < size && i != j) continue;
        const Vertex& v = out[(p * side(depth) + j) * side(depth) + i];
        for (const bool upper : {true, false}) {
          const LatticePoint at = face_point(grids[p], size, i, j, upper);
          if (at.face < 0 || (upper ? j < i : i < j)) continue;
          shared.add(mesh, at, v, known);
        }
      }
    }
  }
}

/// Adds the points of every control edge, evaluated by themselves from either side.
inline void add_edges(const data::ControlMesh& mesh, int depth, const Kernel& kernel,
                      const std::vector<std::int32_t>& known, SharedPoints& shared) {
  const Adjacency adjacency(mesh);
  const RowStream stream(mesh, adjacency, kernel);
  std::vector<std::int32_t> half_edges(3 * mesh.faces.size());
  for (std::size_t h = 0; h < half_edges.size(); ++h) half_edges[h] = static_cast<std::int32_t>(h);
  const std::size_t length = static_cast<std::size_t>(side(depth));
  std::vector<Vertex> out(half_edges.size() * length);
  Workspace workspace;
  stream.edges(half_edges, depth, workspace, out.data());
  const int size = 1 << depth;
  for (std::int32_t h : half_edges) {
    for (int t = 0; t <= size; ++t) {
      shared.add(mesh, Half{h / 3, h % 3}.lattice(size, size - t, t), out[h * length + t], known);
    }
  }
}

}  // namespace limitcheck::fast::row_stream
