// SPDX-License-Identifier: MIT
#include "verify/evidence/sides.h"

#include <algorithm>
#include <set>
#include <utility>

namespace limitcheck::verify {
namespace {

std::set<std::pair<std::int32_t, std::int32_t>> lasting_edges(const data::ControlMesh& mesh) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const data::SharpEdge& e : mesh.sharpness.edges)
    if (e.sharpness >= data::kInfiniteSharpness) edges.insert(std::minmax(e.a, e.b));
  return edges;
}

}  // namespace

Sides::Sides(const Lattice& lattice) : lattice_(lattice) {
  const auto lasting = lasting_edges(lattice.mesh());
  if (lasting.empty()) return;

  // Around a vertex, faces are of one sector that meet in an edge which does not stay sharp.
  const auto stays_sharp = [&](const Lattice::Edge& e) { return lasting.contains({e.a, e.b}); };
  sector_ = fans_of_corners(
      lattice, [&](const Lattice::Edge& e) { return !stays_sharp(e); }, [](std::int32_t) { return true; });
  of_edge_.assign(lattice.edges().size(), -1);
  for (std::size_t k = 0; k < lattice.edges().size(); ++k) {
    const Lattice::Edge& e = lattice.edges()[k];
    if (e.on_boundary() || !stays_sharp(e) || lattice.n() == 1) continue;
    of_edge_[k] = size();
    for (Lattice::Id i = 0; i < lattice.n() - 1; ++i)
      others_.push_back({lattice.first_on_edge(k) + i, e.face[1]});
  }

  // The first face of each sector after that which has the id of the vertex.
  std::vector<std::vector<std::int32_t>> first_face(lattice.mesh().positions.size());
  for (std::int32_t f = 0; f < lattice.face_count(); ++f)
    for (int k = 0; k < lattice.domain(f).corners(); ++k) {
      auto& met = first_face[lattice.vertex(f, k)];
      if (sector_[lattice.corner_number(f, k)] > std::ssize(met)) met.push_back(f);
    }
  of_vertex_.assign(first_face.size(), -1);
  for (std::size_t v = 0; v < first_face.size(); ++v) {
    if (first_face[v].empty()) continue;
    of_vertex_[v] = size();
    for (const std::int32_t f : first_face[v]) others_.push_back({static_cast<Lattice::Id>(v), f});
  }
}

Sides::Id Sides::first_other(Lattice::Id point) const {
  if (none() || !lattice_.is_shared(point)) return -1;
  if (lattice_.is_vertex(point)) return of_vertex_[point];
  const std::size_t edge = lattice_.edge_of(point);
  return of_edge_[edge] < 0 ? -1 : of_edge_[edge] + point - lattice_.first_on_edge(edge);
}

Sides::Id Sides::of(Lattice::Id point, std::int32_t face) const {
  const Id first = first_other(point);
  if (first < 0) return point;
  if (!lattice_.is_vertex(point))
    return lattice_.edges()[lattice_.edge_of(point)].face[1] == face ? first : point;
  const auto k = lattice_.corner_of(face, point);
  const std::int32_t sector = k ? sector_[lattice_.corner_number(face, *k)] : 0;
  return sector == 0 ? point : first + sector - 1;
}

Place Sides::place(Id side) const {
  if (side < lattice_.size()) return lattice_.place(side);
  const Other& other = others_[side - lattice_.size()];
  return lattice_.place(other.face, *lattice_.in_face(other.point, other.face));
}

}  // namespace limitcheck::verify
