// SPDX-License-Identifier: MIT
#include "fast/adjacency.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace limitcheck::fast {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("control mesh: " + what);
}

std::string edge_name(std::int32_t a, std::int32_t b) {
  return "edge " + std::to_string(std::min(a, b)) + "-" + std::to_string(std::max(a, b));
}

std::string two_faces(std::int32_t h, std::int32_t g) {
  return "(faces " + std::to_string(std::min(h, g) / 3) + ", " + std::to_string(std::max(h, g) / 3) + ")";
}

}  // namespace

Adjacency::Adjacency(const data::ControlMesh& mesh) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  if (mesh.triangles.size() > kMost / 3 || mesh.positions.size() > kMost)
    refuse("too many faces or vertices");

  const auto vertices = static_cast<std::int32_t>(mesh.positions.size());
  origin_.resize(3 * mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& t = mesh.triangles[f];
    for (int k = 0; k < 3; ++k) {
      if (t[k] < 0 || t[k] >= vertices) {
        refuse("face " + std::to_string(f) + " names vertex " + std::to_string(t[k]) + " of " +
               std::to_string(vertices));
      }
      origin_[3 * f + k] = t[k];
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      refuse("face " + std::to_string(f) + " repeats a vertex");
  }
  outgoing_.assign(mesh.positions.size(), -1);
  valence_.assign(mesh.positions.size(), 0);
  match_twins();
  choose_outgoing();
}

// Half-edges are sorted by the smaller vertex of their edge (counting sort); within one such bucket the
// larger vertex indexes a slot. O(n) whatever the valence, no hashing.
void Adjacency::match_twins() {
  const auto half_edges = static_cast<std::int32_t>(origin_.size());
  twin_.assign(origin_.size(), -1);

  std::vector<std::int32_t> first(outgoing_.size() + 1, 0);
  for (std::int32_t h = 0; h < half_edges; ++h) ++first[std::min(origin(h), target(h)) + 1];
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<std::int32_t> sorted(origin_.size());
  std::vector<std::int32_t> cursor(first.begin(), first.end() - 1);
  for (std::int32_t h = 0; h < half_edges; ++h) sorted[cursor[std::min(origin(h), target(h))]++] = h;

  std::vector<std::int32_t>& slot = cursor;  // no longer needed: reuse
  std::fill(slot.begin(), slot.end(), -1);
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    for (std::int32_t i = first[v]; i < first[v + 1]; ++i) {
      const std::int32_t h = sorted[i];
      std::int32_t& seen = slot[std::max(origin(h), target(h))];
      if (seen < 0) {
        seen = h;
      } else if (twin_[seen] >= 0) {
        refuse(edge_name(origin(h), target(h)) + " has more than two faces " + two_faces(seen, h));
      } else if (origin(seen) == origin(h)) {
        refuse(edge_name(origin(h), target(h)) + " runs the same way in two faces " + two_faces(seen, h));
      } else {
        twin_[seen] = h;
        twin_[h] = seen;
      }
    }
    for (std::int32_t i = first[v]; i < first[v + 1]; ++i) {
      slot[std::max(origin(sorted[i]), target(sorted[i]))] = -1;
    }
  }
}

void Adjacency::choose_outgoing() {
  const auto half_edges = static_cast<std::int32_t>(origin_.size());
  for (std::int32_t h = 0; h < half_edges; ++h) {
    const std::int32_t v = origin(h);
    ++valence_[v];  // faces, for now
    std::int32_t& chosen = outgoing_[v];
    if (chosen < 0) {
      chosen = h;
    } else if (twin(h) < 0) {
      if (twin(chosen) < 0) refuse("vertex " + std::to_string(v) + " joins two fans " + two_faces(chosen, h));
      chosen = h;
    }
  }

  // One walk per vertex must meet every face it has.
  for (std::int32_t v = 0; v < vertex_count(); ++v) {
    const std::int32_t start = outgoing(v);
    if (start < 0) continue;
    int faces = 0;
    std::int32_t h = start;
    do {
      ++faces;
      h = rotate(h);
    } while (h >= 0 && h != start);
    if (faces != valence_[v]) refuse("vertex " + std::to_string(v) + " joins two fans");
    if (h < 0) {
      ++valence_[v];
    } else if (faces < 3) {
      refuse("interior vertex " + std::to_string(v) + " has valence " + std::to_string(faces));
    }
    max_valence_ = std::max(max_valence_, valence_[v]);
  }
}

}  // namespace limitcheck::fast
