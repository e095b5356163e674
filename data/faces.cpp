// SPDX-License-Identifier: MIT
// What is done with lists of faces: they grow (faces.h), are cut out (cut_out.h), are cut into triangles
// (triangulate.h).
#include "data/faces.h"

#include <limits>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "data/cut_out.h"
#include "data/triangulate.h"

namespace limitcheck::data {
namespace {

// Sets that grow together: corners of faces that are one vertex. Each is known by its lowest corner.
class Union {
 public:
  explicit Union(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::size_t find(std::size_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

std::uint64_t edge(std::int32_t from, std::int32_t to) {
  return static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint32_t>(to);
}

double squared_distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

// The corner from which the fan of a face starts.
std::size_t apex(const ControlMesh& mesh, std::span<const std::int32_t> face, Triangulation rule) {
  if (rule != Triangulation::kShortestDiagonal || face.size() != 4) return 0;
  const auto& p = mesh.positions;
  for (const std::int32_t v : face)
    if (v < 0 || static_cast<std::size_t>(v) >= p.size()) return 0;
  return squared_distance(p[face[1]], p[face[3]]) < squared_distance(p[face[0]], p[face[2]]) ? 1 : 0;
}

}  // namespace

void Faces::push_back(std::span<const std::int32_t> face) {
  if (face.size() > std::numeric_limits<std::int32_t>::max() - corners_.size())
    throw ArgumentError("the faces have more than 2^31 - 1 corners");
  corners_.insert(corners_.end(), face.begin(), face.end());
  ends_.push_back(static_cast<std::int32_t>(corners_.size()));
  triangles_ += face.size() == 3 ? 1 : 0;
}

std::vector<std::int32_t> split_fans(Faces& faces, std::size_t vertex_count) {
  // Corners at the same end of an edge of two faces are one vertex.
  const std::size_t count = faces.corners().size();
  struct Side {
    std::size_t from, to;  // corners
  };
  Union corners(count);
  std::unordered_map<std::uint64_t, Side> starts;  // of a directed edge: its corners
  starts.reserve(count);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto face = faces[f];
    const std::size_t first = faces.first_corner(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::size_t next = (k + 1) % face.size();
      starts[edge(face[k], face[next])] = {first + k, first + next};
      const auto other = starts.find(edge(face[next], face[k]));
      if (other == starts.end()) continue;
      corners.join(first + next, other->second.from);
      corners.join(first + k, other->second.to);
    }
  }

  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> fan_of(vertex_count, kNone);  // the first fan of a vertex
  std::vector<std::int32_t> vertex_of(count, -1), copies;
  for (std::size_t f = 0, c = 0; c < count; ++c) {
    while (c >= faces.first_corner(f + 1)) ++f;
    std::int32_t& v = faces[f][c - faces.first_corner(f)];
    const std::size_t fan = corners.find(c);
    std::size_t& first = fan_of[v];
    if (first == kNone) first = fan;
    if (first == fan) continue;
    if (vertex_of[fan] < 0) {
      vertex_of[fan] = static_cast<std::int32_t>(vertex_count + copies.size());
      copies.push_back(v);
    }
    v = vertex_of[fan];
  }
  return copies;
}

Sharpness CutOut::of(const Sharpness& whole) const {
  Sharpness part;
  part.boundary = whole.boundary;
  part.creasing = whole.creasing;
  part.triangles = whole.triangles;
  if (!whole.edges.empty()) {
    std::unordered_map<std::uint64_t, float> sharp;
    for (const SharpEdge& e : whole.edges) sharp[edge(std::min(e.a, e.b), std::max(e.a, e.b))] = e.sharpness;
    std::unordered_set<std::uint64_t> seen;
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t k = 0; k < faces[f].size(); ++k) {
        const auto [a, b] = std::minmax(faces[f][k], faces[f][(k + 1) % faces[f].size()]);
        const auto found =
            sharp.find(edge(std::min(vertices[a], vertices[b]), std::max(vertices[a], vertices[b])));
        if (found != sharp.end() && seen.insert(edge(a, b)).second)
          part.edges.push_back({a, b, found->second});
      }
  }
  if (!whole.vertices.empty()) {
    std::unordered_map<std::int32_t, float> sharp;
    for (const SharpVertex& v : whole.vertices) sharp[v.vertex] = v.sharpness;
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (const auto found = sharp.find(vertices[v]); found != sharp.end())
        part.vertices.push_back({static_cast<std::int32_t>(v), found->second});
  }
  return part;
}

CutOut cut_out(const Faces& whole, std::span<const std::int32_t> faces) {
  CutOut part;
  part.faces.reserve(faces.size());
  std::unordered_map<std::int32_t, std::int32_t> number;
  std::vector<std::int32_t> face;
  for (const std::int32_t f : faces) {
    face.assign(whole[f].begin(), whole[f].end());
    for (std::int32_t& v : face) {
      const auto [entry, is_new] = number.try_emplace(v, static_cast<std::int32_t>(part.vertices.size()));
      if (is_new) part.vertices.push_back(v);
      v = entry->second;
    }
    part.faces.push_back(face);
  }
  for (const std::int32_t v : split_fans(part.faces, part.vertices.size()))
    part.vertices.push_back(part.vertices[v]);
  return part;
}

Triangulated triangulate(const ControlMesh& mesh, Triangulation rule) {
  Triangulated result;
  result.faces.reserve(mesh.faces.size());
  result.face.reserve(mesh.faces.size());
  for (const Channel& c : mesh.channels)
    result.channels.push_back({c.name, c.components, c.values, {}, c.rule});
  std::vector<std::int32_t> face;
  // A face of some corners of face f.
  const auto put = [&](std::size_t f, std::span<const std::size_t> corners) {
    face.clear();
    for (const std::size_t k : corners) face.push_back(mesh.faces[f][k]);
    result.faces.push_back(face);
    result.face.push_back(static_cast<std::int64_t>(f));
    for (std::size_t c = 0; c < result.channels.size(); ++c)
      for (const std::size_t k : corners)
        result.channels[c].corners.push_back(mesh.channels[c].corners[mesh.faces.first_corner(f) + k]);
  };
  std::vector<std::size_t> all;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const std::size_t n = mesh.faces[f].size();
    if (n <= 3 || rule == Triangulation::kKeep) {
      all.resize(n);
      std::iota(all.begin(), all.end(), std::size_t{0});
      put(f, all);
      continue;
    }
    ++result.cut;
    const std::size_t first = apex(mesh, mesh.faces[f], rule);
    for (std::size_t k = 1; k + 1 < n; ++k) put(f, std::array{first, (first + k) % n, (first + k + 1) % n});
  }
  return result;
}

}  // namespace limitcheck::data
