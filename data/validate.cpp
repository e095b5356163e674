// SPDX-License-Identifier: MIT
#include "data/validate.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace limitcheck::data {
namespace {

constexpr std::size_t kMostFacesInMessage = 8;

// A stable counting sort of `items` by key(item) in 0..keys-1: linear where std::sort is not, for a hub of
// any valence.
template <class Key>
void sort_by(std::vector<std::int32_t>& items, std::size_t keys, Key key) {
  std::vector<std::int32_t> start(keys + 1, 0);
  for (const std::int32_t item : items) ++start[key(item) + 1];
  for (std::size_t k = 0; k < keys; ++k) start[k + 1] += start[k];
  std::vector<std::int32_t> sorted(items.size());
  for (const std::int32_t item : items) sorted[start[key(item)]++] = item;
  items.swap(sorted);
}

std::string listed(const std::vector<std::int64_t>& faces) {
  std::string text;
  for (std::size_t i = 0; i < std::min(faces.size(), kMostFacesInMessage); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ", ", faces[i]);
  }
  if (faces.size() > kMostFacesInMessage) text += ", …";
  return text;
}

class Validator {
 public:
  Validator(const ControlMesh& mesh, const Numbering& numbering)
      : mesh_(mesh),
        numbering_(numbering),
        vertices_(mesh.positions.size()),
        used_(vertices_, false),
        tainted_(vertices_, false),
        removed_(mesh.triangles.size(), false) {}

  std::vector<MeshFinding> run() {
    check_positions();
    check_indices();
    check_duplicates();
    check_edges();
    check_fans();
    check_isolated();
    std::stable_sort(findings_.begin(), findings_.end(),
                     [](const MeshFinding& a, const MeshFinding& b) { return a.fault < b.fault; });
    return std::move(findings_);
  }

 private:
  // Vertices and faces as messages number them.
  std::int64_t vertex(std::int64_t v) const { return v + numbering_.first; }
  std::int64_t face(std::int64_t f) const {
    return (numbering_.face.empty() ? f : numbering_.face[f]) + numbering_.first;
  }
  template <class Faces>
  std::string faces(const Faces& list) const {
    std::vector<std::int64_t> numbers;
    for (const auto f : list) numbers.push_back(face(f));
    return listed(numbers);
  }

  void report(MeshFault fault, std::vector<std::int64_t> elements, std::string message, std::int64_t face,
              std::int64_t vertex = -1) {
    findings_.push_back({fault, std::move(elements), std::move(message), face, vertex});
  }

  // The vertices of a face left out have lost part of their surroundings: no verdict on their fans.
  void remove(std::size_t face) {
    removed_[face] = true;
    for (const std::int32_t v : mesh_.triangles[face]) {
      if (v >= 0 && static_cast<std::size_t>(v) < vertices_) tainted_[v] = true;
    }
  }

  void check_positions() {
    for (std::size_t v = 0; v < vertices_; ++v) {
      const auto& p = mesh_.positions[v];
      if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) continue;
      const auto at = static_cast<std::int64_t>(v);
      report(MeshFault::kNotFinite, {at},
             fmt::format("vertex {} lies at ({}, {}, {})", vertex(at), p[0], p[1], p[2]), -1, at);
    }
  }

  void check_indices() {
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      const auto& t = mesh_.triangles[f];
      const auto at = static_cast<std::int64_t>(f);
      const auto wrong = std::find_if(t.begin(), t.end(), [&](std::int32_t v) {
        return v < 0 || static_cast<std::size_t>(v) >= vertices_;
      });
      for (const std::int32_t v : t) {
        if (v >= 0 && static_cast<std::size_t>(v) < vertices_) used_[v] = true;
      }
      if (wrong != t.end()) {
        report(MeshFault::kIndexOutOfRange, {at, *wrong},
               fmt::format("face {} names vertex {}, the mesh has {}", face(at), vertex(*wrong), vertices_),
               at);
        remove(f);
      } else if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
        const std::int32_t twice = t[0] == t[1] ? t[0] : t[2];
        report(MeshFault::kDegenerateFace, {at, twice},
               fmt::format("face {} names vertex {} twice", face(at), vertex(twice)), at);
        remove(f);
      }
    }
  }

  std::array<std::int32_t, 3> sorted_corners(std::int32_t face) const {
    auto t = mesh_.triangles[face];
    std::sort(t.begin(), t.end());
    return t;
  }

  void check_duplicates() {
    std::vector<std::int32_t> faces;
    faces.reserve(mesh_.triangles.size());
    std::vector<std::int32_t> faces_at(vertices_, 0);
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      if (removed_[f]) continue;
      faces.push_back(static_cast<std::int32_t>(f));
      for (const std::int32_t v : mesh_.triangles[f]) ++faces_at[v];
    }
    for (const int corner : {2, 1, 0}) {
      sort_by(faces, vertices_, [&](std::int32_t f) { return sorted_corners(f)[corner]; });
    }
    for (std::size_t i = 1, first = 0; i < faces.size(); ++i) {
      if (sorted_corners(faces[i]) != sorted_corners(faces[first])) {
        first = i;
        continue;
      }
      report_same_corners(faces[first], faces[i], faces_at);
      remove(faces[i]);
    }
  }

  // Two faces back to back are all there is at an interior vertex of valence 2; elsewhere the later one
  // is a duplicate.
  void report_same_corners(std::int32_t first, std::int32_t later,
                           const std::vector<std::int32_t>& faces_at) {
    const auto& a = mesh_.triangles[first];
    const auto& b = mesh_.triangles[later];
    const auto at = std::find(b.begin(), b.end(), a[0]) - b.begin();
    const bool back_to_back = a[1] == b[(at + 2) % 3];
    bool low = false;
    for (const std::int32_t v : b) {
      if (!back_to_back || faces_at[v] != 2) continue;
      report(MeshFault::kLowValence, {v},
             fmt::format("interior vertex {} has valence 2 (faces {}, {} back to back)", vertex(v),
                         face(first), face(later)),
             later, v);
      low = true;
    }
    if (low) return;
    report(MeshFault::kDuplicateFace, {first, later},
           fmt::format("face {} has the vertices of face {} ({}, {}, {})", face(later), face(first),
                       vertex(b[0]), vertex(b[1]), vertex(b[2])),
           later);
  }

  std::int32_t from(std::int32_t h) const { return mesh_.triangles[h / 3][h % 3]; }
  std::int32_t to(std::int32_t h) const { return mesh_.triangles[h / 3][(h % 3 + 1) % 3]; }

  std::pair<std::int32_t, std::int32_t> edge(std::int32_t h) const { return std::minmax({from(h), to(h)}); }

  // Groups the half-edges 3 * face + corner by edge, and pairs the two of an edge in `twin_`.
  void check_edges() {
    std::vector<std::int32_t> half_edges;
    half_edges.reserve(3 * mesh_.triangles.size());
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      if (removed_[f]) continue;
      for (std::size_t k = 0; k < 3; ++k) half_edges.push_back(static_cast<std::int32_t>(3 * f + k));
    }
    sort_by(half_edges, vertices_, [&](std::int32_t h) { return edge(h).second; });
    sort_by(half_edges, vertices_, [&](std::int32_t h) { return edge(h).first; });

    twin_.assign(3 * mesh_.triangles.size(), -1);
    for (std::size_t begin = 0, end = 0; begin < half_edges.size(); begin = end) {
      const auto [v0, v1] = edge(half_edges[begin]);
      while (end < half_edges.size() && edge(half_edges[end]) == std::pair(v0, v1)) ++end;
      const std::int32_t a = half_edges[begin];
      if (end - begin == 2) {
        const std::int32_t b = half_edges[begin + 1];
        if (from(a) == to(b)) {
          twin_[a] = b;
          twin_[b] = a;
          continue;
        }
        report(MeshFault::kOrientationClash, {v0, v1, a / 3, b / 3},
               fmt::format("faces {} and {} both run from {} to {}", face(a / 3), face(b / 3),
                           vertex(from(a)), vertex(to(a))),
               b / 3);
        tainted_[v0] = tainted_[v1] = true;
      } else if (end - begin > 2) {
        report_nonmanifold(v0, v1, std::vector(half_edges.begin() + begin, half_edges.begin() + end));
        tainted_[v0] = tainted_[v1] = true;
      }
    }
  }

  void report_nonmanifold(std::int32_t v0, std::int32_t v1, std::vector<std::int32_t> at_edge) {
    for (std::int32_t& h : at_edge) h /= 3;
    std::vector<std::int64_t> elements = {v0, v1};
    elements.insert(elements.end(), at_edge.begin(), at_edge.end());
    report(
        MeshFault::kNonmanifoldEdge, std::move(elements),
        fmt::format("edge {}–{} has {} faces ({})", vertex(v0), vertex(v1), at_edge.size(), faces(at_edge)),
        at_edge[2]);
  }

  // Walks round every vertex from its first corner; a corner that no walk reached belongs to another fan.
  void check_fans() {
    std::vector<bool> reached(twin_.size(), false);
    std::vector<std::int32_t> first_face(vertices_, -1);
    std::vector<std::int32_t> finding_of(vertices_, -1);
    for (std::size_t corner = 0; corner < twin_.size(); ++corner) {
      const auto h = static_cast<std::int32_t>(corner);
      if (removed_[h / 3] || reached[h]) continue;
      const std::int32_t v = from(h);
      if (tainted_[v]) continue;
      walk(h, reached);
      if (first_face[v] < 0) {
        first_face[v] = h / 3;
        continue;
      }
      if (finding_of[v] < 0) {
        finding_of[v] = static_cast<std::int32_t>(findings_.size());
        report(MeshFault::kBowtieVertex, {v, first_face[v]}, "", h / 3, v);
      }
      findings_[finding_of[v]].elements.push_back(h / 3);
    }
    for (MeshFinding& finding : findings_) {
      if (finding.fault != MeshFault::kBowtieVertex) continue;
      const std::vector<std::int32_t> fans(finding.elements.begin() + 1, finding.elements.end());
      finding.message = fmt::format("vertex {} joins {} fans (of faces {})", vertex(finding.vertex),
                                    fans.size(), faces(fans));
    }
  }

  // Marks the corners of one fan, both ways round from the corner at h.
  void walk(std::int32_t start, std::vector<bool>& reached) const {
    const auto next = [](std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; };
    const auto previous = [](std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; };
    for (std::int32_t h = start; h >= 0 && !reached[h]; h = twin_[previous(h)]) reached[h] = true;
    for (std::int32_t t = twin_[start]; t >= 0 && !reached[next(t)]; t = twin_[next(t)])
      reached[next(t)] = true;
  }

  void check_isolated() {
    for (std::size_t v = 0; v < vertices_; ++v) {
      const auto at = static_cast<std::int64_t>(v);
      if (!used_[v])
        report(MeshFault::kIsolatedVertex, {at}, fmt::format("no face names vertex {}", vertex(at)), -1, at);
    }
  }

  const ControlMesh& mesh_;
  Numbering numbering_;
  std::size_t vertices_;
  std::vector<bool> used_;     // by a face, even a refused one
  std::vector<bool> tainted_;  // vertices on which no verdict is possible
  std::vector<bool> removed_;  // faces already refused
  std::vector<std::int32_t> twin_;
  std::vector<MeshFinding> findings_;
};

}  // namespace

std::string_view code(MeshFault fault) {
  switch (fault) {
    case MeshFault::kEmpty:
      return "MESH_EMPTY";
    case MeshFault::kTooLarge:
      return "MESH_TOO_LARGE";
    case MeshFault::kIndexOutOfRange:
      return "MESH_INDEX_OUT_OF_RANGE";
    case MeshFault::kNotFinite:
      return "MESH_NOT_FINITE";
    case MeshFault::kDegenerateFace:
      return "MESH_DEGENERATE_FACE";
    case MeshFault::kDuplicateFace:
      return "MESH_DUPLICATE_FACE";
    case MeshFault::kNonmanifoldEdge:
      return "MESH_NONMANIFOLD_EDGE";
    case MeshFault::kOrientationClash:
      return "MESH_ORIENTATION_CLASH";
    case MeshFault::kBowtieVertex:
      return "MESH_BOWTIE_VERTEX";
    case MeshFault::kLowValence:
      return "MESH_LOW_VALENCE";
    case MeshFault::kIsolatedVertex:
      return "MESH_ISOLATED_VERTEX";
  }
  return "MESH_UNKNOWN";
}

std::vector<MeshFinding> validate_counts(std::int64_t vertices, std::int64_t faces) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (vertices == 0 || faces == 0) {
    return {{MeshFault::kEmpty, {}, fmt::format("{} vertices and {} faces", vertices, faces)}};
  }
  if (vertices > most || faces > most / 3) {
    return {
        {MeshFault::kTooLarge,
         {vertices, faces},
         fmt::format("{} vertices and {} faces; the most are {} and {}", vertices, faces, most, most / 3)}};
  }
  return {};
}

std::vector<MeshFinding> validate(const ControlMesh& mesh, const Numbering& numbering) {
  auto findings = validate_counts(static_cast<std::int64_t>(mesh.positions.size()),
                                  static_cast<std::int64_t>(mesh.triangles.size()));
  return findings.empty() ? Validator(mesh, numbering).run() : findings;
}

}  // namespace limitcheck::data
