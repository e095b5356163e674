// SPDX-License-Identifier: MIT
#include "verify/audit/sample.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "data/splitmix64.h"

namespace limitcheck::verify {
namespace {

using data::ControlMesh;

// The faces around each vertex, in one array.
struct FacesAround {
  explicit FacesAround(const ControlMesh& mesh) : begin(mesh.positions.size() + 1) {
    for (const auto& t : mesh.triangles)
      for (const std::int32_t v : t) ++begin[v + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    face.resize(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
      for (const std::int32_t v : mesh.triangles[f]) face[next[v]++] = static_cast<std::int32_t>(f);
  }
  std::span<const std::int32_t> of(std::int32_t v) const {
    return {face.data() + begin[v], begin[v + 1] - begin[v]};
  }

  std::vector<std::size_t> begin;
  std::vector<std::int32_t> face;
};

// Sets that grow together: corners of faces that are one vertex.
class Union {
 public:
  explicit Union(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t find(std::int32_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void join(std::int32_t a, std::int32_t b) { parent_[find(b)] = find(a); }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace

MeshSample::MeshSample(const ControlMesh& whole, std::size_t faces, std::uint64_t seed)
    : text_(fmt::format("{}:{}", faces, seed)),
      part_of_(whole.triangles.size(), -1),
      in_patch_(whole.triangles.size(), false) {
  const FacesAround around(whole);
  data::SplitMix64 random(seed);
  faces = std::min(faces, whole.triangles.size());
  for (std::size_t chosen = 0; chosen < faces;) {
    const auto v = static_cast<std::int32_t>(random.next() % whole.positions.size());
    for (const std::int32_t f : around.of(v)) {
      chosen += !in_patch_[f];
      in_patch_[f] = true;
    }
  }

  std::vector<bool> in_part(whole.triangles.size(), false);
  for (std::size_t f = 0; f < in_patch_.size(); ++f)
    if (in_patch_[f])
      for (const std::int32_t v : whole.triangles[f])
        for (const std::int32_t g : around.of(v)) in_part[g] = true;
  for (std::size_t f = 0; f < in_part.size(); ++f)
    if (in_part[f]) {
      part_of_[f] = static_cast<std::int32_t>(faces_.size());
      faces_.push_back(static_cast<std::int32_t>(f));
    }
  cut_out(whole);
}

void MeshSample::cut_out(const ControlMesh& whole) {
  // Corners are one vertex of the part if they lie at the same end of an edge of two of its faces.
  const auto corner = [](std::size_t face, int k) { return static_cast<std::int32_t>(3 * face) + k % 3; };
  const auto key = [](std::int32_t from, std::int32_t to) {
    return static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint32_t>(to);
  };
  std::unordered_map<std::uint64_t, std::int32_t> half_edge;  // to the corner it starts from
  half_edge.reserve(3 * faces_.size());
  Union corners(3 * faces_.size());
  for (std::size_t p = 0; p < faces_.size(); ++p) {
    const auto& t = whole.triangles[faces_[p]];
    for (int k = 0; k < 3; ++k) {
      half_edge[key(t[k], t[(k + 1) % 3])] = corner(p, k);
      const auto other = half_edge.find(key(t[(k + 1) % 3], t[k]));
      if (other == half_edge.end()) continue;
      const std::int32_t there = other->second;
      corners.join(corner(p, k + 1), there);
      corners.join(corner(p, k), there - there % 3 + (there + 1) % 3);
    }
  }

  std::vector<std::int32_t> vertex_at(3 * faces_.size(), -1);
  part_.triangles.resize(faces_.size());
  for (std::size_t p = 0; p < faces_.size(); ++p)
    for (int k = 0; k < 3; ++k) {
      std::int32_t& v = vertex_at[corners.find(corner(p, k))];
      if (v < 0) {
        v = static_cast<std::int32_t>(vertices_.size());
        vertices_.push_back(whole.triangles[faces_[p]][k]);
      }
      part_.triangles[p][k] = v;
    }
  part_.positions = part_with(whole).positions;
}

std::vector<std::int32_t> MeshSample::cull(std::vector<std::int32_t> depth) const {
  for (std::size_t f = 0; f < depth.size(); ++f)
    if (!in_patch_[f]) depth[f] = -1;
  return depth;
}

std::vector<std::int32_t> MeshSample::depths_of_part(std::span<const std::int32_t> depth_of_whole) const {
  std::vector<std::int32_t> depth(faces_.size());
  for (std::size_t p = 0; p < faces_.size(); ++p) depth[p] = depth_of_whole[faces_[p]];
  return depth;
}

ControlMesh MeshSample::part_with(const ControlMesh& positions) const {
  ControlMesh mesh;
  mesh.triangles = part_.triangles;
  mesh.positions.reserve(vertices_.size());
  for (const std::int32_t v : vertices_) mesh.positions.push_back(positions.positions[v]);
  return mesh;
}

}  // namespace limitcheck::verify
