// SPDX-License-Identifier: MIT
// For the tests of this folder: a mesh written down differently, the points that its faces share, and how far points
// are from the exact surface.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "data/bounding_box.h"
#include "data/control_mesh.h"
#include "data/splitmix64.h"
#include "fast/frame/patch.h"
#include "fast/stream/row_stream.h"
#include "fast/test_support/test_meshes.h"

namespace limitcheck::fast::row_stream {

/// Uniform in 0 .. n - 1, near enough.
inline std::size_t below(data::SplitMix64& random, std::size_t n) {
  return static_cast<std::size_t>(random.next() % n);
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
  std::vector<std::vector<std::int32_t>> faces(mesh.faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto corners = mesh.faces[f];
    const std::size_t turn = below(random, corners.size());
    for (std::size_t k = 0; k < corners.size(); ++k)
      faces[f].push_back(number[corners[(k + turn) % corners.size()]]);
  }
  for (std::size_t f = faces.size(); f > 1; --f) std::swap(faces[f - 1], faces[below(random, f)]);
  for (const auto& corners : faces) out.faces.push_back(corners);
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
    for (int k = 0; k < 3; ++k)
      if (l[(k + 2) % 3] == 0) add(name(k), name((k + 1) % 3), l[(k + 1) % 3], size, v);
  }
  /// The same of a quad, at (i, j) of size + 1 columns and rows.
  void add(const data::ControlMesh& mesh, std::size_t face, int i, int j, int size, const Vertex& v,
           const std::vector<std::int32_t>& known) {
    const auto q = mesh.faces[face];
    const auto name = [&](int corner) { return known.empty() ? q[corner % 4] : known[q[corner % 4]]; };
    const int along[4] = {i, j, size - i, size - j};
    const bool on[4] = {j == 0, i == size, j == size, i == 0};
    for (int k = 0; k < 4; ++k)
      if (on[k]) add(name(k), name(k + 1), along[k], size, v);
  }
  std::int64_t points() const { return static_cast<std::int64_t>(first_.size()); }
  std::int64_t compared() const { return compared_; }
  std::int64_t different() const { return different_; }

 private:
  /// The point `along` of `size` steps on the edge from a to b.
  void add(std::int32_t a, std::int32_t b, int along, int size, const Vertex& v) {
    if (along == 0) b = a;
    if (along == size) a = b, along = 0;
    if (a > b) std::swap(a, b), along = size - along;
    std::array<std::uint32_t, 6> bits;
    std::memcpy(bits.data(), &v, sizeof bits);
    const auto [seen, fresh] = first_.try_emplace({a, b, along}, bits);
    if (fresh) return;
    ++compared_;
    if (seen->second != bits) ++different_;
  }

  std::map<std::array<std::int32_t, 3>, std::array<std::uint32_t, 6>> first_;
  std::int64_t compared_ = 0, different_ = 0;
};

/// With faces so low that some edges have origins of their own at depths 1 to 3, and others not: one corner of each
/// seventh face almost meets the next.
inline data::ControlMesh pinched(data::ControlMesh mesh) {
  for (std::size_t f = 0; f < mesh.faces.size(); f += 7) {
    const auto p = mesh.positions[mesh.faces[f][0]];
    auto& q = mesh.positions[mesh.faces[f][1]];
    for (std::size_t c = 0; c < 3; ++c) q[c] = p[c] + (q[c] - p[c]) * 2e-3;
  }
  return mesh;
}

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

struct Worst {
  double position = 0, normal = 0;  // in diagonals, and per coordinate of the unit vector
  std::string where = "nowhere";

  /// A vertex against its exact limit; NaN counts.
  template <class Limit>
  void see(const Vertex& v, const Limit& e, double scale, std::size_t item, int i, int j) {
    const auto raise = [&](double& most, double error) {
      if (error <= most) return;
      most = error;
      where = "number " + std::to_string(item) + " (" + std::to_string(i) + ", " + std::to_string(j) + ")";
    };
    for (int c = 0; c < 3; ++c) {
      raise(position, std::abs(v.position[c] - static_cast<double>(e.position[c])) / scale);
      raise(normal, std::abs(v.normal[c] - static_cast<double>(e.normal[c])));
    }
  }
};

/// Rounding: about one ulp of the largest coordinate in position. The tangents of depth d are differences of
/// points that lie 2^-d edges apart, so the same ulp weighs more in the normal.
///   worst_of(mesh, depth)   the worst of all points
///   least_length(mesh)      of an edge, or of what is lower
template <class WorstOf, class LeastLength>
void expect_all_limits(const std::vector<NamedMesh>& meshes, int most_depth_of_large, WorstOf&& worst_of,
                       LeastLength&& least_length) {
  Worst all;
  for (const auto& [name, mesh] : meshes) {
    const data::ControlMesh single = shaken(mesh, 0, 0);
    for (int depth = 0; depth <= (mesh.faces.size() > 60 ? most_depth_of_large : 5); ++depth) {
      const Worst worst = worst_of(single, depth);
      EXPECT_LE(worst.position, 1.2e-7) << name << " depth " << depth << " " << worst.where;
      const double bound = 2.4e-7 * (1 << depth) * data::box_diagonal(mesh) / least_length(mesh);
      EXPECT_LE(worst.normal, bound) << name << " depth " << depth << " " << worst.where;
      all.position = std::max(all.position, worst.position);
      all.normal = std::max(all.normal, worst.normal);
    }
  }
  ::testing::Test::RecordProperty("worst_position", std::to_string(all.position * 1e9) + "e-9");
  ::testing::Test::RecordProperty("worst_normal", std::to_string(all.normal * 1e9) + "e-9");
}

/// Claim D14, on every variant the machine has: the same point has the same bits from every face and from the edge
/// alone, however the mesh is written down, and from every variant.
///   renumber(mesh, seed, number)                       writes it down differently
///   add(mesh, depth, kernel, known, shared)            all points that are shared
template <class Kernels, class Renumber, class Add>
void expect_all_bits(const std::vector<NamedMesh>& meshes, int most, int most_of_large, std::uint64_t seeds,
                     const Kernels& kernels, Renumber&& renumber, Add&& add) {
  std::int64_t compared = 0;
  for (const auto& [name, mesh] : meshes) {
    const data::ControlMesh single = shaken(mesh, 0, 0);
    for (int depth = 0; depth <= (mesh.faces.size() > 60 ? most_of_large : most); ++depth) {
      SharedPoints shared;
      for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        std::vector<std::int32_t> number, known(mesh.positions.size());
        const data::ControlMesh other = renumber(single, seed, number);
        for (std::size_t v = 0; v < known.size(); ++v) known[number[v]] = static_cast<std::int32_t>(v);
        for (const auto& kernel : kernels)
          if (kernel.fused || depth <= 3) add(other, depth, kernel, known, shared);
      }
      EXPECT_EQ(shared.different(), 0) << name << " depth " << depth << " of " << shared.compared();
      compared += shared.compared();
    }
  }
  ::testing::Test::RecordProperty("compared", std::to_string(compared));
}

}  // namespace limitcheck::fast::row_stream
