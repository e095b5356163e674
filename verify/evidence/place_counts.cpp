// SPDX-License-Identifier: MIT
#include "verify/evidence/place_counts.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

namespace limitcheck::verify {

Places::Places(const Lattice& lattice) : lattice_(lattice) {
  const data::ControlMesh& mesh = lattice.mesh();
  const std::size_t vertices = mesh.positions.size();
  const bool loop = lattice.scheme() == data::Scheme::kLoop;

  // Round each vertex.
  std::vector<int> faces(vertices, 0), sharp_edges(vertices, 0);
  std::vector<bool> boundary(vertices, false), sharp(vertices, false), quads(vertices, true);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const std::int32_t v : mesh.faces[f]) {
      ++faces[v];
      if (!loop && mesh.faces[f].size() != 4) quads[v] = false;
    }
  std::set<std::pair<std::int32_t, std::int32_t>> tagged;
  for (const data::SharpEdge& s : mesh.sharpness.edges)
    if (s.sharpness > 0) tagged.emplace(std::min(s.a, s.b), std::max(s.a, s.b));
  for (const data::SharpVertex& s : mesh.sharpness.vertices) sharp[s.vertex] = s.sharpness > 0;
  sharp_edge_.resize(lattice.edges().size());
  for (std::size_t k = 0; k < lattice.edges().size(); ++k) {
    const Lattice::Edge& e = lattice.edges()[k];
    sharp_edge_[k] = !e.on_boundary() && tagged.contains({e.a, e.b});
    for (const std::int32_t v : {e.a, e.b}) {
      if (e.on_boundary()) boundary[v] = true;
      if (sharp_edge_[k]) ++sharp_edges[v];
    }
  }
  if (mesh.sharpness.boundary == data::Boundary::kEdgeAndCorner)
    for (std::size_t v = 0; v < vertices; ++v)
      if (boundary[v] && faces[v] == 1) sharp[v] = true;

  const int regular = loop ? 6 : 4;
  for (std::size_t v = 0; v < vertices; ++v) {
    PlaceCount& place = vertex_.emplace_back();
    const int count = sharp_edges[v] + (boundary[v] && sharp_edges[v] > 0 ? 2 : 0);
    place.kind = sharp[v] || count > 2 ? PlaceKind::kCorner
                 : count == 2          ? PlaceKind::kCrease
                 : count == 1          ? PlaceKind::kDart
                 : boundary[v]         ? PlaceKind::kBoundaryVertex
                 : !quads[v]           ? PlaceKind::kPolygonVertex
                 : faces[v] != regular ? PlaceKind::kExtraordinaryVertex
                                       : PlaceKind::kRegularVertex;
    if (place.kind == PlaceKind::kBoundaryVertex || place.kind == PlaceKind::kExtraordinaryVertex)
      place.faces = faces[v];
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    PlaceKind kind = !loop && mesh.faces[f].size() != 4 ? PlaceKind::kIrregularFace : PlaceKind::kRegularFace;
    for (const std::int32_t v : mesh.faces[f]) {
      const PlaceKind at = vertex_[v].kind;
      kind = std::max(kind, at >= PlaceKind::kDart             ? PlaceKind::kSharpFace
                            : at == PlaceKind::kBoundaryVertex ? PlaceKind::kBoundaryFace
                            : at == PlaceKind::kRegularVertex  ? PlaceKind::kRegularFace
                                                               : PlaceKind::kIrregularFace);
    }
    face_.push_back(kind);
  }
}

PlaceCount Places::of(Lattice::Id id) const {
  if (lattice_.is_vertex(id)) return vertex_[id];
  if (!lattice_.is_shared(id)) return {face_[lattice_.place(id).face], 0, 0, 0};
  const std::size_t k = lattice_.edge_of(id);
  if (sharp_edge_[k]) return {PlaceKind::kSharpEdge, 0, 0, 0};
  const Lattice::Edge& edge = lattice_.edges()[k];
  PlaceKind kind = face_[edge.face[0]];
  if (!edge.on_boundary()) kind = std::max(kind, face_[edge.face[1]]);
  return {kind, 0, 0, 0};
}

void count_places(Result& row, const Lattice& lattice, std::size_t count,
                  const std::function<Lattice::Id(std::size_t)>& id,
                  const std::function<int(std::size_t)>& state) {
  if (!is_bad(row)) return;
  const Places places(lattice);
  std::map<std::pair<PlaceKind, std::int32_t>, PlaceCount> counts;
  for (std::size_t k = 0; k < count; ++k) {
    const int wrong = state(k);
    const Lattice::Id point = wrong < 0 ? Lattice::kNone : id(k);
    if (point == Lattice::kNone) continue;
    const PlaceCount at = places.of(point);
    PlaceCount& sum = counts.try_emplace({at.kind, at.faces}, at).first->second;
    sum.bad += wrong;
    ++sum.of;
  }
  row.places.clear();
  for (const auto& [key, sum] : counts) row.places.push_back(sum);
}

}  // namespace limitcheck::verify
