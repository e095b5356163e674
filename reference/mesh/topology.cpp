// SPDX-License-Identifier: MIT
#include "reference/mesh/topology.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>

namespace limitcheck::reference {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw std::invalid_argument("control mesh: " + why);
}

/// Directed edge from -> to, the side k of a face.
struct HalfEdge {
  std::int32_t low, high, face, k;
};

}  // namespace

Topology::Topology(std::size_t vertex_count, std::span<const Triangle> triangles)
    : triangles_(triangles.begin(), triangles.end()) {
  const std::size_t faces = triangles_.size();
  for (std::size_t f = 0; f < faces; ++f) {
    const Triangle& t = triangles_[f];
    for (const std::int32_t v : t)
      if (v < 0 || static_cast<std::size_t>(v) >= vertex_count)
        refuse("face " + std::to_string(f) + " names vertex " + std::to_string(v));
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      refuse("face " + std::to_string(f) + " repeats a vertex");
  }

  // Bucket the sides by their smaller vertex, then sort the small buckets: sides of one edge become
  // neighbours. O(n)
  std::vector<std::size_t> start(vertex_count + 1, 0);
  for (const Triangle& t : triangles_)
    for (std::size_t k = 0; k < 3; ++k) ++start[static_cast<std::size_t>(std::min(t[k], t[(k + 1) % 3])) + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) start[v + 1] += start[v];
  std::vector<HalfEdge> sides(3 * faces);
  auto fill = start;
  for (std::size_t f = 0; f < faces; ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles_[f][k], triangles_[f][(k + 1) % 3]);
      sides[fill[static_cast<std::size_t>(low)]++] = {low, high, static_cast<std::int32_t>(f),
                                                      static_cast<std::int32_t>(k)};
    }
  for (std::size_t v = 0; v < vertex_count; ++v)
    std::sort(sides.begin() + static_cast<std::ptrdiff_t>(start[v]),
              sides.begin() + static_cast<std::ptrdiff_t>(start[v + 1]),
              [](const HalfEdge& a, const HalfEdge& b) {
                return std::tie(a.high, a.face) < std::tie(b.high, b.face);
              });

  // Pair the sides into edges.
  face_edges_.resize(faces);
  sectors_.resize(faces);
  const auto corner = [&](const HalfEdge& s, std::int32_t offset) {
    return triangles_[static_cast<std::size_t>(s.face)][static_cast<std::size_t>((s.k + offset) % 3)];
  };
  for (std::size_t i = 0; i < sides.size();) {
    const HalfEdge& s = sides[i];
    Edge e{corner(s, 0), corner(s, 1), corner(s, 2), -1};
    const auto id = static_cast<std::int32_t>(edges_.size());
    face_edges_[static_cast<std::size_t>(s.face)][static_cast<std::size_t>(s.k)] = id;
    std::size_t next = i + 1;
    if (next < sides.size() && sides[next].low == s.low && sides[next].high == s.high) {
      const HalfEdge& t = sides[next];
      if (corner(t, 0) != e.b)
        refuse("faces " + std::to_string(s.face) + " and " + std::to_string(t.face) +
               " clash in orientation");
      e.right = corner(t, 2);
      face_edges_[static_cast<std::size_t>(t.face)][static_cast<std::size_t>(t.k)] = id;
      ++next;
    }
    if (next < sides.size() && sides[next].low == s.low && sides[next].high == s.high)
      refuse("edge " + std::to_string(s.low) + "-" + std::to_string(s.high) + " has more than two faces");
    edges_.push_back(e);
    i = next;
  }

  // The faces round each vertex, unordered, as 3 * face + corner.
  std::vector<std::size_t> corner_start(vertex_count + 1, 0);
  for (const Triangle& t : triangles_)
    for (const std::int32_t v : t) ++corner_start[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) corner_start[v + 1] += corner_start[v];
  std::vector<std::int32_t> corners(3 * faces);
  fill = corner_start;
  for (std::size_t f = 0; f < faces; ++f)
    for (std::size_t k = 0; k < 3; ++k)
      corners[fill[static_cast<std::size_t>(triangles_[f][k])]++] = static_cast<std::int32_t>(3 * f + k);

  // Faces over an edge, to walk round the vertices: `across[3 f + k]` is 3 g + m, the side of the other face.
  std::vector<std::int32_t> across(3 * faces, -1), first_side(edges_.size(), -1);
  for (std::size_t h = 0; h < 3 * faces; ++h) {
    auto& first = first_side[static_cast<std::size_t>(face_edges_[h / 3][h % 3])];
    if (first < 0) {
      first = static_cast<std::int32_t>(h);
    } else {
      across[h] = first;
      across[static_cast<std::size_t>(first)] = static_cast<std::int32_t>(h);
    }
  }
  const auto before = [](std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; };

  ring_start_.assign(1, 0);
  boundary_.assign(vertex_count, 0);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const std::size_t count = corner_start[v + 1] - corner_start[v];
    if (count > 0) {
      // Begin at the side that leaves v along the boundary, if there is one.
      std::int32_t begin = corners[corner_start[v]];
      for (std::size_t i = corner_start[v]; i < corner_start[v + 1]; ++i)
        if (across[static_cast<std::size_t>(corners[i])] < 0) {
          begin = corners[i];
          boundary_[v] = 1;
          break;
        }
      // Counter-clockwise: over the side that comes back to v.
      std::size_t walked = 0;
      for (std::int32_t h = begin; walked < count;) {
        const auto f = static_cast<std::size_t>(h / 3), k = static_cast<std::size_t>(h % 3);
        sectors_[f][k] = static_cast<std::int32_t>(walked++);
        ring_.push_back(triangles_[f][(k + 1) % 3]);
        spokes_.push_back(face_edges_[f][k]);
        faces_.push_back(static_cast<std::int32_t>(f));
        const std::int32_t back = before(h);
        h = across[static_cast<std::size_t>(back)];
        if (h < 0) {
          ring_.push_back(triangles_[f][(k + 2) % 3]);
          spokes_.push_back(face_edges_[f][(k + 2) % 3]);
          faces_.push_back(-1);
          break;
        }
        if (h == begin) break;
      }
      if (walked != count) refuse("vertex " + std::to_string(v) + " joins two fans of faces");
      if (!boundary_[v] && count < 3)
        refuse("interior vertex " + std::to_string(v) + " has valence " + std::to_string(count));
    }
    ring_start_.push_back(ring_.size());
  }
}

}  // namespace limitcheck::reference
