// SPDX-License-Identifier: MIT
#include "data/generators/surgery.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "data/building_blocks.h"
#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

using Face = std::vector<std::int32_t>;
constexpr int kAttempts = 50;  // to find two faces for a tube

VertexPair between(std::int32_t a, std::int32_t b) {
  return std::minmax(a, b);
}

std::vector<Face> faces_of(const ControlMesh& mesh) {
  std::vector<Face> faces;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto corners = mesh.faces[f];
    faces.emplace_back(corners.begin(), corners.end());
  }
  return faces;
}

ControlMesh with_faces(ControlMesh mesh, const std::vector<Face>& faces) {
  mesh.faces.clear();
  mesh.channels.clear();  // their corners are those of other faces
  for (const Face& f : faces) mesh.faces.push_back(f);
  return mesh;
}

template <class Do>
void for_each_side(const Face& face, Do&& what) {
  for (std::size_t k = 0; k < face.size(); ++k) what(face[k], face[(k + 1) % face.size()]);
}

// The edge between two faces: a -> b is a side of `left`, b -> a one of `right`.
struct InnerEdge {
  std::int32_t a, b;
  std::size_t left, right;
};

std::vector<InnerEdge> inner_edges(const Triangles& triangles) {
  std::map<VertexPair, std::size_t> face_of;  // of each directed edge
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
    Face &p = polygons_[left], &q = polygons_[right];
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
    for (const Face& p : polygons_)
      if (!p.empty()) faces.push_back(p);
    return faces;
  }

 private:
  std::size_t face(std::size_t f) {
    while (into_[f] != f) f = into_[f] = into_[into_[f]];
    return f;
  }

  std::vector<Face> polygons_;               // empty where one went into another
  std::vector<std::size_t> into_;            // where each face went
  std::vector<int> faces_at_, least_faces_;  // of each vertex
};

}  // namespace

ControlMesh with_handles(ControlMesh mesh, int count, std::uint64_t seed) {
  require(count >= 0 && count <= 1000, "handles: 0 to 1000");
  const bool triangles = mesh.faces.are_triangles();
  std::vector<Face> faces = faces_of(mesh);
  const std::vector<VertexPair> sides = sides_of(mesh.faces);
  std::set<VertexPair> edges(sides.begin(), sides.end());
  const auto apart = [&](const Face& f, const Face& g) {
    return std::all_of(f.begin(), f.end(), [&](std::int32_t a) {
      return std::all_of(g.begin(), g.end(),
                         [&](std::int32_t b) { return a != b && !edges.contains(between(a, b)); });
    });
  };
  SplitMix64 random(seed);
  // Holes are named by number: faces beside them are taken, and they keep theirs.
  std::vector<bool> fixed(faces.size(), false);
  for (const std::int32_t f : mesh.holes) fixed[f] = true;
  for (int attempt = 0; attempt < kAttempts * count && count > 0; ++attempt) {
    const std::size_t f = random.next() % faces.size(), g = random.next() % faces.size();
    if (f == g || fixed[f] || fixed[g] || faces[f].size() != faces[g].size() || !apart(faces[f], faces[g]))
      continue;
    const Face a = faces[f], b(faces[g].rbegin(), faces[g].rend());
    std::vector<Face> tube;
    for (std::size_t k = 0; k < a.size(); ++k) {
      const std::size_t next = (k + 1) % a.size();
      edges.insert(between(a[k], b[k]));
      if (!triangles) {
        tube.push_back({a[k], a[next], b[next], b[k]});
        continue;
      }
      edges.insert(between(a[k], b[next]));
      tube.push_back({a[k], a[next], b[next]});
      tube.push_back({a[k], b[next], b[k]});
    }
    faces[f] = tube[0], faces[g] = tube[1];
    faces.insert(faces.end(), tube.begin() + 2, tube.end());
    fixed.resize(faces.size(), false);
    --count;
  }
  return with_faces(std::move(mesh), faces);
}

ControlMesh with_turned_edges(ControlMesh mesh, std::uint64_t seed) {
  std::vector<Face> faces = faces_of(mesh);
  std::map<VertexPair, std::vector<std::size_t>> of_edge;
  std::vector<int> count(mesh.positions.size(), 0), least(mesh.positions.size(), 3);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const std::int32_t v : faces[f]) ++count[v];
    for_each_side(faces[f], [&](std::int32_t a, std::int32_t b) { of_edge[between(a, b)].push_back(f); });
  }
  std::set<VertexPair> fixed;
  for (const SharpEdge& e : mesh.sharpness.edges) fixed.insert(between(e.a, e.b));
  std::vector<VertexPair> inner;
  for (const auto& [edge, its] : of_edge) {
    if (its.size() < 2) least[edge.first] = least[edge.second] = 1;
    if (its.size() == 2 && !fixed.contains(edge)) inner.push_back(edge);
  }
  SplitMix64 random(seed);
  for (std::size_t turns = inner.size() / 4 + 1; turns > 0 && !inner.empty(); --turns) {
    const VertexPair edge = inner[random.next() % inner.size()];
    const std::uint64_t where = random.next();
    const auto at = of_edge.find(edge);
    if (at == of_edge.end() || count[edge.first] <= least[edge.first] ||
        count[edge.second] <= least[edge.second])
      continue;
    const std::size_t left = at->second[0], right = at->second[1];
    Face &p = faces[left], &q = faces[right];
    // The faces as one, p from behind the edge on: a .. b of p, then b .. a of q.
    const auto begin = std::find_if(p.begin(), p.end(), [&](const std::int32_t& v) {
      const std::int32_t before = &v == p.data() ? p.back() : *(&v - 1);
      return between(before, v) == edge;
    });
    std::rotate(p.begin(), begin, p.end());
    std::rotate(q.begin(), std::find(q.begin(), q.end(), p.back()), q.end());
    const Face both = [&] {
      Face all = p;
      all.insert(all.end(), q.begin() + 1, q.end() - 1);
      return all;
    }();
    const std::size_t n = both.size();
    if (std::set<std::int32_t>(both.begin(), both.end()).size() != n) continue;
    const std::size_t first = where % n, steps = 2 + where / n % (n - 3);
    const VertexPair turned = between(both[first], both[(first + steps) % n]);
    if (of_edge.contains(turned)) continue;
    Face one, other;
    for (std::size_t k = 0; k <= steps; ++k) one.push_back(both[(first + k) % n]);
    for (std::size_t k = steps; k <= n; ++k) other.push_back(both[(first + k) % n]);
    for (const std::size_t f : {left, right})
      for_each_side(faces[f], [&](std::int32_t a, std::int32_t b) {
        auto& its = of_edge[between(a, b)];
        its.erase(std::find(its.begin(), its.end(), f));
      });
    of_edge.erase(edge);
    p = one, q = other;
    for (const std::size_t f : {left, right})
      for_each_side(faces[f], [&](std::int32_t a, std::int32_t b) { of_edge[between(a, b)].push_back(f); });
    --count[edge.first], --count[edge.second];
    ++count[turned.first], ++count[turned.second];
    inner.push_back(turned);
  }
  return with_faces(std::move(mesh), faces);
}

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
