// SPDX-License-Identifier: MIT
#include "data/validate.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace limitcheck::data {
namespace {

constexpr std::size_t kMostInMessage = 8;

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

template <class List, class Number>
std::string listed(const List& list, Number number) {
  std::string text;
  for (std::size_t i = 0; i < std::min(list.size(), kMostInMessage); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", number(list[i]));
  return list.size() > kMostInMessage ? text + ", …" : text;
}

class Validator {
 public:
  Validator(const ControlMesh& mesh, Scheme scheme, const Numbering& numbering)
      : mesh_(mesh),
        scheme_(scheme),
        numbering_(numbering),
        triangles_(mesh.faces.are_triangles()),
        vertices_(mesh.positions.size()),
        used_(vertices_, false),
        tainted_(vertices_, false),
        removed_(mesh.faces.size(), false) {
    if (triangles_) return;
    face_of_.reserve(mesh.faces.corners().size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      face_of_.insert(face_of_.end(), mesh.faces[f].size(), static_cast<std::int32_t>(f));
  }

  std::vector<MeshFinding> run() {
    check_positions();
    check_indices();
    check_duplicates();
    check_edges();
    check_fans();
    check_isolated();
    check_tags();
    check_holes();
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
  bool is_vertex(std::int64_t v) const { return v >= 0 && static_cast<std::size_t>(v) < vertices_; }
  template <class List>
  std::string faces(const List& list) const {
    return listed(list, [&](std::int64_t f) { return face(f); });
  }

  void report(MeshFault fault, std::vector<std::int64_t> elements, std::string message, std::int64_t face,
              std::int64_t vertex = -1) {
    findings_.push_back({fault, std::move(elements), std::move(message), face, vertex});
  }

  // The vertices of a face left out have lost part of their surroundings: no verdict on their fans.
  void remove(std::size_t face) {
    removed_[face] = true;
    for (const std::int32_t v : mesh_.faces[face])
      if (is_vertex(v)) tainted_[v] = true;
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
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const auto t = mesh_.faces[f];
      const auto at = static_cast<std::int64_t>(f);
      const auto wrong = std::find_if(t.begin(), t.end(), [&](std::int32_t v) { return !is_vertex(v); });
      for (const std::int32_t v : t)
        if (is_vertex(v)) used_[v] = true;
      if (wrong != t.end()) {
        report(MeshFault::kIndexOutOfRange, {at, *wrong},
               fmt::format("face {} names vertex {}, the mesh has {}", face(at), vertex(*wrong), vertices_),
               at);
        remove(f);
      } else if (const auto twice = repeated(t, at); twice >= 0) {
        report(MeshFault::kDegenerateFace, {at, twice},
               fmt::format("face {} names vertex {} twice", face(at), vertex(twice)), at);
        remove(f);
      } else if (t.size() < 3) {
        report(MeshFault::kDegenerateFace, {at, t.empty() ? -1 : t[0]},
               fmt::format("face {} has {} corners", face(at), t.size()), at);
        remove(f);
      } else if (t.size() > 3 && scheme_ == Scheme::kLoop) {
        report(MeshFault::kPolygon, {at},
               fmt::format("face {} has {} corners; Loop's scheme takes triangles only", face(at), t.size()),
               at);
      }
    }
  }

  // A vertex that a face names twice, or -1.
  std::int64_t repeated(std::span<const std::int32_t> corners, std::int64_t face) {
    if (last_face_.empty()) last_face_.assign(vertices_, -1);
    for (const std::int32_t v : corners) {
      if (last_face_[v] == face) return v;
      last_face_[v] = face;
    }
    return -1;
  }

  // The corners from the smallest on, towards the smaller of its neighbours: the same for a face and for the
  // same face turned over.
  std::vector<std::int32_t> canonical(std::int32_t face) const {
    const auto corners = mesh_.faces[face];
    const std::size_t n = corners.size();
    const auto smallest =
        static_cast<std::size_t>(std::min_element(corners.begin(), corners.end()) - corners.begin());
    const bool backwards = corners[(smallest + n - 1) % n] < corners[(smallest + 1) % n];
    std::vector<std::int32_t> turned(n);
    for (std::size_t k = 0; k < n; ++k) turned[k] = corners[(smallest + (backwards ? n - k : k)) % n];
    return turned;
  }

  void check_duplicates() {
    std::vector<std::int32_t> faces, smallest(mesh_.faces.size(), 0);
    faces.reserve(mesh_.faces.size());
    std::vector<std::int32_t> faces_at(vertices_, 0);
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      if (removed_[f]) continue;
      faces.push_back(static_cast<std::int32_t>(f));
      const auto corners = mesh_.faces[f];
      smallest[f] = *std::min_element(corners.begin(), corners.end());
      for (const std::int32_t v : corners) ++faces_at[v];
    }
    sort_by(faces, vertices_, [&](std::int32_t f) { return smallest[f]; });
    // Few faces share their smallest corner, but for those of a hub.
    std::vector<std::pair<std::vector<std::int32_t>, std::int32_t>> group;
    for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
      while (end < faces.size() && smallest[faces[end]] == smallest[faces[begin]]) ++end;
      if (end - begin == 1) continue;
      group.clear();
      for (std::size_t i = begin; i < end; ++i) group.emplace_back(canonical(faces[i]), faces[i]);
      std::sort(group.begin(), group.end());
      for (std::size_t i = 1, first = 0; i < group.size(); ++i) {
        if (group[i].first != group[first].first) {
          first = i;
          continue;
        }
        report_same_corners(group[first].second, group[i].second, faces_at);
        remove(group[i].second);
      }
    }
  }

  // Two faces back to back are all there is at an interior vertex of valence 2; elsewhere the later one
  // is a duplicate.
  void report_same_corners(std::int32_t first, std::int32_t later,
                           const std::vector<std::int32_t>& faces_at) {
    const auto a = mesh_.faces[first], b = mesh_.faces[later];
    const auto at = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
    const bool back_to_back = a[1] == b[(at + b.size() - 1) % b.size()];
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
           fmt::format("face {} has the vertices of face {} ({})", face(later), face(first),
                       listed(b, [&](std::int64_t v) { return vertex(v); })),
           later);
  }

  // Half-edges are numbered like the corners that they leave.
  std::int32_t face_of(std::int32_t h) const { return triangles_ ? h / 3 : face_of_[h]; }
  std::int32_t next(std::int32_t h) const {
    if (triangles_) return h % 3 == 2 ? h - 2 : h + 1;
    const auto f = static_cast<std::size_t>(face_of_[h]);
    return static_cast<std::size_t>(h) + 1 == mesh_.faces.first_corner(f + 1)
               ? static_cast<std::int32_t>(mesh_.faces.first_corner(f))
               : h + 1;
  }
  std::int32_t previous(std::int32_t h) const {
    if (triangles_) return h % 3 == 0 ? h + 2 : h - 1;
    const auto f = static_cast<std::size_t>(face_of_[h]);
    return static_cast<std::size_t>(h) == mesh_.faces.first_corner(f)
               ? static_cast<std::int32_t>(mesh_.faces.first_corner(f + 1)) - 1
               : h - 1;
  }
  std::int32_t from(std::int32_t h) const { return mesh_.faces.corners()[h]; }
  std::int32_t to(std::int32_t h) const { return from(next(h)); }

  std::pair<std::int32_t, std::int32_t> edge(std::int32_t h) const { return std::minmax({from(h), to(h)}); }

  // Groups the half-edges by edge.
  void check_edges() {
    // All sides by their smaller vertex; those of one are few, but for a hub.
    struct Side {
      std::int32_t larger, half_edge;
    };
    std::vector<std::int32_t> start(vertices_ + 1, 0);
    const auto for_each_half_edge = [&](auto what) {
      for (std::size_t c = 0; c < mesh_.faces.corners().size(); ++c)
        if (const auto h = static_cast<std::int32_t>(c); !removed_[face_of(h)]) what(h, edge(h));
    };
    for_each_half_edge([&](std::int32_t, const auto& ends) { ++start[ends.first + 1]; });
    for (std::size_t v = 0; v < vertices_; ++v) start[v + 1] += start[v];
    std::vector<Side> sides(start.back());
    std::vector<std::int32_t> place(start.begin(), start.end() - 1);
    for_each_half_edge([&](std::int32_t h, const auto& ends) {
      sides[place[ends.first]++] = {ends.second, h};
    });
    twin_.assign(mesh_.faces.corners().size(), -1);
    for (std::size_t v = 0; v < vertices_; ++v) {
      const auto end = sides.begin() + start[v + 1];
      std::sort(sides.begin() + start[v], end, [](const Side& a, const Side& b) {
        return a.larger != b.larger ? a.larger < b.larger : a.half_edge < b.half_edge;
      });
      for (auto one = sides.begin() + start[v]; one != end;) {
        const auto next = std::find_if(one, end, [&](const Side& s) { return s.larger != one->larger; });
        look_at_edge(static_cast<std::int32_t>(v), one->larger, std::span(one, next));
        one = next;
      }
    }
  }

  // Pairs the two half-edges of an edge; anything but one, or two that run opposite ways, is a fault.
  template <class Sides>
  void look_at_edge(std::int32_t v0, std::int32_t v1, const Sides& its) {
    if (its.size() < 2) return;
    const std::int32_t a = its[0].half_edge, b = its[1].half_edge;
    if (its.size() == 2 && from(a) == to(b)) {
      twin_[a] = b;
      twin_[b] = a;
      return;
    }
    std::vector<std::int64_t> elements = {v0, v1};
    for (const auto& side : its) elements.push_back(face_of(side.half_edge));
    const std::vector<std::int64_t> at(elements.begin() + 2, elements.end());
    tainted_[v0] = tainted_[v1] = true;
    if (its.size() == 2)
      report(MeshFault::kOrientationClash, std::move(elements),
             fmt::format("faces {} and {} both run from {} to {}", face(at[0]), face(at[1]), vertex(from(a)),
                         vertex(to(a))),
             at[1]);
    else
      report(MeshFault::kNonmanifoldEdge, std::move(elements),
             fmt::format("edge {}–{} has {} faces ({})", vertex(v0), vertex(v1), at.size(), faces(at)),
             at[2]);
  }

  // Walks round every vertex from its first corner; a corner that no walk reached belongs to another fan.
  void check_fans() {
    std::vector<bool> reached(twin_.size(), false);
    std::vector<std::int32_t> first_face(vertices_, -1);
    std::vector<std::int32_t> finding_of(vertices_, -1);
    for (std::size_t corner = 0; corner < twin_.size(); ++corner) {
      const auto h = static_cast<std::int32_t>(corner);
      if (removed_[face_of(h)] || reached[h]) continue;
      const std::int32_t v = from(h);
      if (tainted_[v]) continue;
      if (walk(h, reached) == 2 && first_face[v] < 0)  // closed: two faces that share both edges at v
        report(MeshFault::kLowValence, {v},
               fmt::format("interior vertex {} has valence 2 (faces {}, {})", vertex(v), face(face_of(h)),
                           face(face_of(twin_[h]))),
               std::max(face_of(h), face_of(twin_[h])), v);
      if (first_face[v] < 0) {
        first_face[v] = face_of(h);
        continue;
      }
      if (finding_of[v] < 0) {
        finding_of[v] = static_cast<std::int32_t>(findings_.size());
        report(MeshFault::kBowtieVertex, {v, first_face[v]}, "", face_of(h), v);
      }
      findings_[finding_of[v]].elements.push_back(face_of(h));
    }
    for (MeshFinding& finding : findings_) {
      if (finding.fault != MeshFault::kBowtieVertex) continue;
      const std::vector<std::int32_t> fans(finding.elements.begin() + 1, finding.elements.end());
      finding.message = fmt::format("vertex {} joins {} fans (of faces {})", vertex(finding.vertex),
                                    fans.size(), faces(fans));
    }
  }

  // Marks the corners of one fan, both ways round from the corner at h. Returns the number of faces of a
  // closed one, 0 of an open one.
  int walk(std::int32_t start, std::vector<bool>& reached) const {
    int count = 0;
    for (std::int32_t h = start; h >= 0; h = twin_[previous(h)]) {
      if (reached[h]) return count;  // all the way round
      reached[h] = true;
      ++count;
    }
    for (std::int32_t t = twin_[start]; t >= 0 && !reached[next(t)]; t = twin_[next(t)])
      reached[next(t)] = true;
    return 0;
  }

  void check_isolated() {
    for (std::size_t v = 0; v < vertices_; ++v) {
      const auto at = static_cast<std::int64_t>(v);
      if (!used_[v])
        report(MeshFault::kIsolatedVertex, {at}, fmt::format("no face names vertex {}", vertex(at)), -1, at);
    }
  }

  // Sharp edges and vertices: tags of no edge or vertex, below 0, or of which two disagree.
  void check_tags() {
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();  // until a tag has been seen
    struct Tagged {
      bool exists = false;
      float sharpness = kNone;
    };
    std::map<std::pair<std::int32_t, std::int32_t>, Tagged> edges;
    for (const SharpEdge& e : mesh_.sharpness.edges) edges[std::minmax(e.a, e.b)];
    for (std::int32_t h = 0; !edges.empty() && h < std::ssize(mesh_.faces.corners()); ++h)
      if (!removed_[face_of(h)])
        if (const auto at = edges.find(edge(h)); at != edges.end()) at->second.exists = true;
    std::int64_t tag = 0;
    const auto look = [&](const std::string& what, std::vector<std::int64_t> elements, Tagged& before,
                          float value) {
      std::string fault;
      if (!before.exists)
        fault = fmt::format("{} has a sharpness and is none", what);
      else if (!(value >= 0))
        fault = fmt::format("{} has the sharpness {}", what, value);
      else if (before.sharpness != value && !std::isnan(before.sharpness))
        fault = fmt::format("{} has the sharpness {} and {}", what, before.sharpness, value);
      else
        before.sharpness = value;
      if (!fault.empty()) {
        report(MeshFault::kSharpness, std::move(elements), std::move(fault), -1);
        findings_.back().tag = tag;
      }
      ++tag;
    };
    for (const SharpEdge& e : mesh_.sharpness.edges)
      look(fmt::format("edge {}–{}", vertex(e.a), vertex(e.b)), {e.a, e.b}, edges[std::minmax(e.a, e.b)],
           e.sharpness);
    std::map<std::int32_t, Tagged> vertices;
    for (const SharpVertex& v : mesh_.sharpness.vertices) {
      Tagged& before = vertices[v.vertex];
      before.exists = is_vertex(v.vertex);
      look(fmt::format("vertex {}", vertex(v.vertex)), {v.vertex}, before, v.sharpness);
    }
  }

  void check_holes() {
    std::int32_t before = -1;
    for (const std::int32_t f : mesh_.holes) {
      if (f < 0 || static_cast<std::size_t>(f) >= mesh_.faces.size())
        report(MeshFault::kHole, {f}, fmt::format("the hole {} is no face", f + numbering_.first), -1);
      else if (f <= before)
        report(MeshFault::kHole, {f}, fmt::format("the hole {} is out of order", f + numbering_.first), f);
      before = f;
    }
  }

  const ControlMesh& mesh_;
  Scheme scheme_;
  Numbering numbering_;
  bool triangles_;  // only: then no table is needed to go from a corner to its face and on
  std::size_t vertices_;
  std::vector<bool> used_;               // by a face, even a refused one
  std::vector<bool> tainted_;            // vertices on which no verdict is possible
  std::vector<bool> removed_;            // faces already refused
  std::vector<std::int32_t> face_of_;    // of each corner; empty if all are triangles
  std::vector<std::int64_t> last_face_;  // that named the vertex
  std::vector<std::int32_t> twin_;
  std::vector<MeshFinding> findings_;
};

}  // namespace

std::string_view code(MeshFault fault) {
  constexpr std::array<std::string_view, 14> kCodes{"MESH_EMPTY",
                                                    "MESH_TOO_LARGE",
                                                    "MESH_INDEX_OUT_OF_RANGE",
                                                    "MESH_NOT_FINITE",
                                                    "MESH_DEGENERATE_FACE",
                                                    "MESH_DUPLICATE_FACE",
                                                    "MESH_NONMANIFOLD_EDGE",
                                                    "MESH_ORIENTATION_CLASH",
                                                    "MESH_BOWTIE_VERTEX",
                                                    "MESH_LOW_VALENCE",
                                                    "MESH_POLYGON",
                                                    "MESH_ISOLATED_VERTEX",
                                                    "MESH_SHARPNESS",
                                                    "MESH_HOLE"};
  static_assert(kCodes.size() == static_cast<std::size_t>(MeshFault::kHole) + 1);
  return kCodes[static_cast<std::size_t>(fault)];
}

std::vector<MeshFinding> validate_counts(std::int64_t vertices, std::int64_t faces, std::int64_t corners) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (vertices == 0 || faces == 0) {
    return {{MeshFault::kEmpty,
             {},
             faces > 0 || vertices == 0 ? fmt::format("{} vertices and {} faces", vertices, faces)
                                        : fmt::format("a point cloud: {} vertices and no faces", vertices)}};
  }
  if (vertices > most || corners > most) {
    return {
        {MeshFault::kTooLarge,
         {vertices, faces},
         fmt::format("{} vertices and {} faces with {} corners; the most are {} vertices and as many corners",
                     vertices, faces, corners, most)}};
  }
  return {};
}

std::vector<MeshFinding> validate(const ControlMesh& mesh, Scheme scheme, const Numbering& numbering) {
  auto findings = validate_counts(static_cast<std::int64_t>(mesh.positions.size()),
                                  static_cast<std::int64_t>(mesh.faces.size()),
                                  static_cast<std::int64_t>(mesh.faces.corners().size()));
  return findings.empty() ? Validator(mesh, scheme, numbering).run() : findings;
}

std::vector<MeshFinding> validate(const ControlMesh& mesh, const Numbering& numbering) {
  return validate(mesh, natural_scheme(mesh), numbering);
}

}  // namespace limitcheck::data
