// SPDX-License-Identifier: MIT
#include "data/summary.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "data/bounding_box.h"
#include "data/building_blocks.h"

namespace limitcheck::data {
namespace {

using Point = std::array<double, 3>;

constexpr double kFewSteps = 16;

// Which elements belong together.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t of(std::int32_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(std::int32_t a, std::int32_t b) { parent_[of(a)] = of(b); }
  // Groups with a member among those flagged.
  std::int64_t count(const std::vector<bool>& flagged) {
    std::vector<bool> seen(parent_.size(), false);
    std::int64_t groups = 0;
    for (std::size_t k = 0; k < parent_.size(); ++k) {
      if (!flagged[k]) continue;
      const std::size_t root = of(static_cast<std::int32_t>(k));
      groups += !seen[root];
      seen[root] = true;
    }
    return groups;
  }

 private:
  std::vector<std::int32_t> parent_;
};

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

bool has_no_area(const Point& a, const Point& b, const Point& c) {
  // Scaled to size 1, so that tiny faces are not taken for flat ones.
  const double size = std::max({distance(a, b), distance(b, c), distance(c, a)});
  if (size == 0) return true;
  Point u{}, v{};
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = (b[k] - a[k]) / size;
    v[k] = (c[k] - a[k]) / size;
  }
  return u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0];
}

}  // namespace

MeshSummary summarise(const ControlMesh& mesh) {
  MeshSummary s;
  const std::size_t n = mesh.positions.size();
  s.vertices = static_cast<std::int64_t>(n);
  s.faces = static_cast<std::int64_t>(mesh.faces.size());

  // Faces.
  Groups components(n);
  std::vector<bool> used(n, false);
  std::vector<int> faces_at(n, 0), edges_at(n, 0);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    bool flat = true;
    for (std::size_t k = 0; k < face.size(); ++k) {
      used[face[k]] = true;
      ++faces_at[face[k]];
      components.join(face[0], face[k]);
      if (k >= 2)
        flat = flat &&
               has_no_area(mesh.positions[face[0]], mesh.positions[face[k - 1]], mesh.positions[face[k]]);
    }
    s.zero_area_faces += flat;
  }
  s.unused_vertices = std::count(used.begin(), used.end(), false);
  s.components = components.count(used);

  // Edges and boundaries.
  for (const Point& p : mesh.positions)
    for (const double x : p) s.largest = std::max(s.largest, std::abs(x));
  if (s.largest > 0) s.float_step = std::ldexp(1.0, std::ilogb(s.largest) - 23);
  const std::vector<std::int32_t> place = first_at_place(mesh.positions);
  const std::vector<VertexPair> list = sides_of(mesh.faces);
  std::vector<bool> on_boundary(n, false);
  std::map<VertexPair, std::int64_t> boundary_at;  // by the places of both ends
  Groups loops(n);
  for (std::size_t begin = 0, end = 0; begin < list.size(); begin = end) {
    const auto [a, b] = list[begin];
    while (end < list.size() && list[end] == list[begin]) ++end;
    ++s.edges;
    ++edges_at[a];
    ++edges_at[b];
    const double length = distance(mesh.positions[a], mesh.positions[b]);
    if (length > 0 && (s.shortest_edge == 0 || length < s.shortest_edge)) s.shortest_edge = length;
    s.edges_lost_in_float += length < kFewSteps * s.float_step;
    if (end - begin != 1) continue;
    ++s.boundary_edges;
    on_boundary[a] = on_boundary[b] = true;
    loops.join(a, b);
    ++boundary_at[std::minmax(place[a], place[b])];
  }
  s.boundary_loops = loops.count(on_boundary);
  for (const auto& [ends, count] : boundary_at)
    if (count > 1) s.coincident_boundary_edges += count;

  // Vertices.
  for (std::size_t v = 0; v < n; ++v) {
    s.coincident_vertices += place[v] != static_cast<std::int32_t>(v);
    if (!used[v]) continue;
    ++(on_boundary[v] ? s.boundary_faces[faces_at[v]] : s.valence[edges_at[v]]);
  }
  s.euler = s.vertices - s.unused_vertices - s.edges + s.faces;
  s.diagonal = n > 0 ? box_diagonal(mesh) : 0;
  return s;
}

}  // namespace limitcheck::data
