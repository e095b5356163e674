// SPDX-License-Identifier: MIT
#include "fast/mesh/adjacency.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "data/error.h"

namespace limitcheck::fast {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw data::ArgumentError("control mesh: " + what);
}

std::string two_faces(std::int32_t h, std::int32_t g) {
  return "(faces " + std::to_string(std::min(h, g) / 3) + ", " + std::to_string(std::max(h, g) / 3) + ")";
}

}  // namespace

Adjacency::Adjacency(const data::ControlMesh& mesh) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  if (mesh.faces.size() > kMost / 3 || mesh.positions.size() > kMost) refuse("too many faces or vertices");
  outgoing_.assign(mesh.positions.size(), -1);
  read_faces(mesh);
  sort_by_origin();
  link();
}

void Adjacency::read_faces(const data::ControlMesh& mesh) {
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const data::Triangles triangles = triangles_of(mesh);
  origin_.resize(3 * triangles.size());
  bool bad = false;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const auto& t = triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      bad |= static_cast<std::uint32_t>(t[k]) >= vertices;
      origin_[3 * f + k] = t[k];
    }
    bad |= t[0] == t[1];
    bad |= t[1] == t[2];
    bad |= t[2] == t[0];
  }
  for (std::size_t f = 0; bad && f < triangles.size(); ++f) {
    const auto& t = triangles[f];
    for (const std::int32_t v : t) {
      if (static_cast<std::uint32_t>(v) >= vertices) {
        refuse("face " + std::to_string(f) + " names vertex " + std::to_string(v) + " of " +
               std::to_string(vertices));
      }
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      refuse("face " + std::to_string(f) + " repeats a vertex");
  }
}

// Counting sort of the half-edges by origin; those of one vertex stay in order. As 4 face + corner, which
// spares link() most divisions by 3.
void Adjacency::sort_by_origin() {
  first_.assign(outgoing_.size() + 2, 0);
  std::int32_t* cursor = first_.data() + 2;
  for (const std::int32_t v : origin_) ++cursor[v];
  for (std::size_t v = 2; v < first_.size(); ++v) first_[v] += first_[v - 1];
  --cursor;  // the start of each vertex; its end, the next one's start, after all are placed
  fan_.resize(origin_.size());
  for (std::size_t f = 0; 3 * f < origin_.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k)
      fan_[cursor[origin_[3 * f + k]]++] = static_cast<std::int32_t>(static_cast<std::uint32_t>(4 * f + k));
  }
  first_.pop_back();
}

// Chains the corners of each vertex: the next one counter-clockwise is that whose half-edge goes where the
// last one's face comes from, and the two half-edges there are twins.
void Adjacency::link() {
  struct FaceCorner {  // of a face: the half-edge into the vertex, the one out of it, the next corner
    std::int32_t in, out, next;
  };
  twin_.resize(origin_.size());
  std::int32_t most = 0;
  for (std::size_t v = 0; v < outgoing_.size(); ++v) most = std::max(most, first_[v + 1] - first_[v]);
  std::vector<FaceCorner> corner(static_cast<std::size_t>(most));
  // Per vertex: which one last had it for a target (upper half), and in which of its corners (lower half).
  std::vector<std::uint64_t> seen(outgoing_.size(), ~std::uint64_t{0});

  for (std::int32_t v = 0; v < vertex_count(); ++v) {
    const std::int32_t n = first_[v + 1] - first_[v];
    if (n == 0) continue;
    std::int32_t* fan = fan_.data() + first_[v];
    const std::uint64_t stamp = static_cast<std::uint64_t>(v) << 32;
    bool good = true;
    for (std::int32_t i = 0; i < n; ++i) {
      constexpr std::int32_t kNext[3] = {1, 1, -2}, kPrev[3] = {2, -1, -1};
      const auto packed = static_cast<std::uint32_t>(fan[i]), k = packed & 3;
      const auto h = static_cast<std::int32_t>(packed - (packed >> 2));
      corner[i] = {h + kPrev[k], h, -1};
      std::uint64_t& entry = seen[origin_[h + kNext[k]]];
      good &= (entry ^ stamp) >> 32 != 0;
      entry = stamp | static_cast<std::uint64_t>(i);
    }
    std::int64_t unreached = std::int64_t{n} * (n - 1) / 2;  // in an open fan: the number of the first corner
    std::int32_t ends = 0;
    for (std::int32_t i = 0; i < n; ++i) {
      const std::uint64_t entry = seen[origin_[corner[i].in]];
      const bool found = (entry ^ stamp) >> 32 == 0;
      const std::int32_t j = found ? static_cast<std::int32_t>(entry) : -1;
      corner[i].next = j;
      twin_[corner[i].in] = found ? corner[j].out : -1;
      unreached -= found ? j : 0;
      ends += found ? 0 : 1;
    }
    if (!good || ends > 1 || (ends == 1 && (unreached < 0 || unreached >= n))) diagnose(v, false);
    const std::int32_t start = ends == 0 ? 0 : static_cast<std::int32_t>(unreached);
    std::int32_t met = 0, i = start;
    do {
      fan[met++] = corner[i].out;
      i = corner[i].next;
    } while (i >= 0 && i != start && met < n);
    const bool closed = ends == 0 && i == start;
    if (met != n || !(closed ? n >= 3 : i < 0)) diagnose(v, closed && met == n);
    outgoing_[v] = fan[0];
    max_valence_ = std::max(max_valence_, n + ends);
  }
}

// What is wrong, now that something is: the edges first, for their faults show at vertices too.
void Adjacency::diagnose(std::int32_t v, bool closed) const {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int32_t>> edges;
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(origin_.size()); ++h)
    edges[std::minmax({origin(h), target(h)})].push_back(h);
  for (const auto& [edge, half_edges] : edges) {
    const std::string name = "edge " + std::to_string(edge.first) + "-" + std::to_string(edge.second);
    if (half_edges.size() > 2)
      refuse(name + " has more than two faces " + two_faces(half_edges[0], half_edges[2]));
    if (half_edges.size() == 2 && origin(half_edges[0]) == origin(half_edges[1]))
      refuse(name + " runs the same way in two faces " + two_faces(half_edges[0], half_edges[1]));
  }
  if (closed) refuse("interior vertex " + std::to_string(v) + " has valence 2");
  refuse("vertex " + std::to_string(v) + " joins two fans");
}

}  // namespace limitcheck::fast
