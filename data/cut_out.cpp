// SPDX-License-Identifier: MIT
#include "data/cut_out.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

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

}  // namespace

std::vector<std::int32_t> split_fans(std::vector<std::array<std::int32_t, 3>>& triangles,
                                     std::size_t vertex_count) {
  // Corners at the same end of an edge of two faces are one vertex.
  const auto corner = [](std::size_t face, std::size_t k) { return 3 * face + k % 3; };
  Union corners(3 * triangles.size());
  std::unordered_map<std::uint64_t, std::size_t> starts;  // of a directed edge: its first corner
  starts.reserve(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const auto& t = triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = t[k], b = t[(k + 1) % 3];
      starts[edge(a, b)] = corner(f, k);
      const auto other = starts.find(edge(b, a));
      if (other == starts.end()) continue;
      const std::size_t g = other->second / 3, j = other->second % 3;
      corners.join(corner(f, k + 1), corner(g, j));
      corners.join(corner(f, k), corner(g, j + 1));
    }
  }

  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> fan_of(vertex_count, kNone);  // the first fan of a vertex
  std::vector<std::int32_t> vertex_of(3 * triangles.size(), -1), copies;
  for (std::size_t c = 0; c < 3 * triangles.size(); ++c) {
    std::int32_t& v = triangles[c / 3][c % 3];
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

CutOut cut_out(std::span<const std::array<std::int32_t, 3>> whole, std::span<const std::int32_t> faces) {
  CutOut part;
  part.triangles.reserve(faces.size());
  std::unordered_map<std::int32_t, std::int32_t> number;
  for (const std::int32_t f : faces) {
    auto t = whole[f];
    for (std::int32_t& v : t) {
      const auto [entry, is_new] = number.try_emplace(v, static_cast<std::int32_t>(part.vertices.size()));
      if (is_new) part.vertices.push_back(v);
      v = entry->second;
    }
    part.triangles.push_back(t);
  }
  for (const std::int32_t v : split_fans(part.triangles, part.vertices.size()))
    part.vertices.push_back(part.vertices[v]);
  return part;
}

}  // namespace limitcheck::data
