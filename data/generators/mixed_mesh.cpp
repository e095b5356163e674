// SPDX-License-Identifier: MIT
#include "data/generators/mixed_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

using Polygon = std::vector<std::int32_t>;

// The edge between two faces: a -> b is a side of `left`, b -> a one of `right`.
struct InnerEdge {
  std::int32_t a, b;
  std::size_t left, right;
};

std::vector<InnerEdge> inner_edges(const Triangles& triangles) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> face_of;  // of each directed edge
  std::vector<InnerEdge> edges;
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = triangles[f][k], b = triangles[f][(k + 1) % 3];
      face_of[{a, b}] = f;
      if (const auto other = face_of.find({b, a}); other != face_of.end())
        edges.push_back({b, a, other->second, f});
    }
  return edges;
}

template <class T>
void shuffle(std::vector<T>& list, SplitMix64& random) {  // std::shuffle differs between libraries
  for (std::size_t k = list.size(); k > 1; --k) std::swap(list[k - 1], list[random.next() % k]);
}

class Dissolver {
 public:
  Dissolver(const Triangles& triangles, std::size_t vertices) : into_(triangles.size()), faces_at_(vertices) {
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      const auto t = triangles[f];
      polygons_.emplace_back(t.begin(), t.end());
      into_[f] = f;
      for (const std::int32_t v : t) ++faces_at_[v];
    }
    least_faces_.assign(vertices, 1);
  }

  // A vertex that is not on the boundary.
  void is_inner(std::int32_t v) { least_faces_[v] = 3; }

  void dissolve(const InnerEdge& e, std::size_t most_corners) {
    const std::size_t left = face(e.left), right = face(e.right);
    Polygon &p = polygons_[left], &q = polygons_[right];
    if (left == right || p.size() + q.size() - 2 > most_corners) return;
    if (faces_at_[e.a] <= least_faces_[e.a] || faces_at_[e.b] <= least_faces_[e.b]) return;
    const auto common = std::count_if(
        p.begin(), p.end(), [&](std::int32_t v) { return std::find(q.begin(), q.end(), v) != q.end(); });
    if (common != 2) return;
    std::rotate(p.begin(), std::find(p.begin(), p.end(), e.b), p.end());  // b ... a
    std::rotate(q.begin(), std::find(q.begin(), q.end(), e.a), q.end());  // a ... b
    p.insert(p.end(), q.begin() + 1, q.end() - 1);
    q.clear();
    into_[right] = left;
    --faces_at_[e.a];
    --faces_at_[e.b];
  }

  Faces result() const {
    Faces faces;
    for (const Polygon& p : polygons_)
      if (!p.empty()) faces.push_back(p);
    return faces;
  }

 private:
  std::size_t face(std::size_t f) {
    while (into_[f] != f) f = into_[f] = into_[into_[f]];
    return f;
  }

  std::vector<Polygon> polygons_;            // empty where one went into another
  std::vector<std::size_t> into_;            // where each face went
  std::vector<int> faces_at_, least_faces_;  // of each vertex
};

}  // namespace

ControlMesh mixed_mesh(std::uint64_t seed, const RandomMeshOptions& options, std::size_t most_corners) {
  ControlMesh mesh = random_mesh(seed, options);
  const Triangles triangles = triangles_of(mesh);
  std::vector<InnerEdge> edges = inner_edges(triangles);
  Dissolver dissolver(triangles, mesh.positions.size());
  // A vertex has as many inner edges as faces, on the boundary one fewer.
  std::vector<int> balance(mesh.positions.size(), 0);
  for (const std::int32_t v : mesh.faces.corners()) --balance[v];
  for (const InnerEdge& e : edges) ++balance[e.a], ++balance[e.b];
  for (std::size_t v = 0; v < balance.size(); ++v)
    if (balance[v] == 0) dissolver.is_inner(static_cast<std::int32_t>(v));

  SplitMix64 random(seed ^ 0x6d69786564);  // another sequence than random_mesh's
  shuffle(edges, random);
  edges.resize(edges.size() / 2);
  for (const InnerEdge& e : edges) dissolver.dissolve(e, most_corners);
  mesh.faces = dissolver.result();
  return mesh;
}

}  // namespace limitcheck::data
